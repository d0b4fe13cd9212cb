//! The colour scale of a picture that does not state one.

use glam::DVec3;
use pullback_compiler::module::{Evaluator, What};
use pullback_compiler::scene::Space;
use pullback_compiler::{Picture, SettingValue};

use crate::render::{Size, View};

/// Samples along each side of the view.
const SAMPLES: usize = 33;
/// Samples along each side of a box.
const SPACE_SAMPLES: usize = 15;
/// The share of the view whose values stay below the scale, and the share whose values stay below four times the
/// scale: a function that is small in most of the view still shows its peaks.
const SHARES: (f64, f64) = (0.6, 0.95);
/// Level lines from 0 to the scale, as the template draws them.
const LINES: f64 = 4.0;

/// The share of the view whose values stay between the middle stripes, and how many those are to each side.
const STRIPES: (f64, f64) = (0.9, 4.0);

/// Settings of scenes of the plane that are automatic where they are 0, and what they become from sorted sizes of values.
type Rule = fn(&[f64]) -> f64;
const AUTOMATIC: [(&str, Rule); 2] = [("color_scale", color_scale), ("period", period)];

fn color_scale(sizes: &[f64]) -> f64 {
    let scale = share(sizes, SHARES.0).max(share(sizes, SHARES.1) / 4.0);
    LINES * round_number(scale / LINES)
}

fn period(sizes: &[f64]) -> f64 {
    round_number(share(sizes, STRIPES.0) / STRIPES.1)
}

/// Sets an automatic `color_scale` or `period` from the values that the formula takes in what is seen, in f64, such that level
/// lines and edges of stripes stand at round values.
pub fn fill_in_scale(
    settings: &mut [SettingValue],
    picture: &Picture,
    view: &View,
    size: Size,
    params: &[f64],
    time: f64,
) {
    let points = points(settings, picture, view, size);
    let automatic = settings.iter_mut().find_map(|setting| {
        let (_, rule) = AUTOMATIC.into_iter().find(|a| a.0 == setting.spec.name)?;
        (setting.value[0] == 0.0).then_some((setting, rule))
    });
    let Some((setting, rule)) = automatic.filter(|_| !points.is_empty()) else {
        return;
    };
    let Ok(mut evaluator) = Evaluator::new(&picture.formula, What::Value) else {
        return;
    };
    let pixel = view.height / f64::from(size.height);
    let inputs = evaluator.inputs().len().min(3);
    let mut sizes = Vec::with_capacity(points.len());
    for point in points {
        let mut value = [f64::NAN];
        evaluator.eval(params, time, pixel, &point[..inputs], &mut value);
        if value[0].is_finite() {
            sizes.push(value[0].abs());
        }
    }
    sizes.retain(|s| *s > 0.0);
    sizes.sort_by(f64::total_cmp);
    setting.value = DVec3::splat(rule(&sizes));
}

/// Where values are taken: a grid of the view, or of the box of a scene of space; complex scenes need no scale.
fn points(settings: &[SettingValue], picture: &Picture, view: &View, size: Size) -> Vec<[f64; 3]> {
    let vector = |name: &str| {
        let found = settings.iter().find(|s| s.spec.name == name);
        found.map_or(DVec3::ZERO, |s| s.value)
    };
    let (center, half, counts) = match picture.scene.space {
        Space::Plane => {
            let width = view.height * f64::from(size.width) / f64::from(size.height);
            let half = 0.5 * DVec3::new(width, view.height, 0.0);
            let [x, y] = view.center;
            (DVec3::new(x, y, 0.0), half, [SAMPLES, SAMPLES, 1])
        }
        Space::Space => (vector("center"), vector("box"), [SPACE_SAMPLES; 3]),
        Space::Complex => return Vec::new(),
    };
    let [columns, rows, layers] = counts;
    let place = |k: usize, count: usize| (2.0 * k as f64 + 1.0) / count as f64 - 1.0;
    let at = |k: usize| {
        let (x, y, z) = (k % columns, k / columns % rows, k / columns / rows);
        let part = DVec3::new(place(x, columns), place(y, rows), place(z, layers));
        (center + half * part).to_array()
    };
    (0..columns * rows * layers).map(at).collect()
}

/// The size below which a share of the sorted sizes lies; 1 where there are none.
fn share(sizes: &[f64], share: f64) -> f64 {
    let place = (sizes.len() as f64 * share) as usize;
    sizes.get(place).copied().unwrap_or(1.0)
}

/// The greatest of 1, 2, 5 times a power of ten that is not above `x`, kept within what f32 holds.
fn round_number(x: f64) -> f64 {
    let x = x.clamp(1e-30, 1e30);
    let decade = 10f64.powf(x.log10().floor());
    let steps = [5.0, 2.0, 1.0];
    steps
        .into_iter()
        .map(|s| s * decade)
        .find(|s| *s <= x * 1.000_001)
        .unwrap_or(decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_numbers() {
        for (x, want) in [
            (1.0, 1.0),
            (0.23, 0.2),
            (7.0, 5.0),
            (99.0, 50.0),
            (1000.0, 1000.0),
        ] {
            assert!((round_number(x) / want - 1.0).abs() < 1e-9, "{x}");
        }
    }

    #[test]
    fn share_of_sizes() {
        assert_eq!(share(&[], 0.6), 1.0);
        let sizes: Vec<f64> = (1..=10).map(f64::from).collect();
        assert_eq!((share(&sizes, 0.6), share(&sizes, 0.95)), (7.0, 10.0));
    }
}
