//! How far a picture is from the true one, at the parts that are known of it.

use super::layout::Layout;
use crate::Error;
use crate::difference::{self, Bitmap};

/// Errors of the pixels, in numbers and to the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// Greatest difference of red, green and blue in linear light, of 1.
    pub light: Spread,
    /// FLIP, of 1.
    pub seen: Spread,
    /// Standard error of the mean of FLIP, from its means over parts of the picture; 0 where the whole picture is known.
    pub doubt: f64,
}

/// Numbers of many pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Their mean.
    pub mean: f64,
    /// The least that 99.9 % do not exceed.
    pub p999: f64,
    /// The greatest.
    pub max: f64,
}

impl Spread {
    pub(super) fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let count = values.len();
        let rank = (count - count / 1000).saturating_sub(1);
        Self {
            mean: values.iter().sum::<f64>() / count.max(1) as f64,
            p999: values.get(rank).copied().unwrap_or(0.0),
            max: values.last().copied().unwrap_or(0.0),
        }
    }
}

/// A picture in parts, as numbers and as one sees it.
#[derive(Clone, Debug)]
pub(super) struct Parts {
    linear: Vec<Vec<[f32; 4]>>,
    pub(super) seen: Bitmap,
}

impl Parts {
    pub(super) fn new(layout: &Layout, linear: Vec<Vec<[f32; 4]>>) -> Result<Self, Error> {
        Ok(Self {
            seen: Bitmap::from_linear(layout.size(), &layout.joined(&linear))?,
            linear,
        })
    }
}

/// Judges a picture by the true one; also FLIP of every pixel of the picture of parts.
pub(super) fn judge(
    layout: &Layout,
    truth: &Parts,
    picture: &Parts,
) -> Result<(Judgement, Vec<f32>), Error> {
    let light = truth.linear.iter().zip(&picture.linear);
    let light = light.flat_map(|(a, b)| a.iter().zip(b).map(|(a, b)| apart(*a, *b)));
    let found = difference::compare(&truth.seen, &picture.seen, &mut |_, _| ())?;
    let map = found.perceptual.map();
    let part = |k: usize| layout.places(k).map(|place| f64::from(map[place]));
    let seen: Vec<f64> = (0..layout.windows.len()).flat_map(part).collect();
    let means = (0..layout.windows.len()).map(|k| part(k).sum::<f64>() / part(k).count() as f64);
    let doubt = if layout.is_whole() {
        0.0
    } else {
        standard_error(&means.collect::<Vec<_>>())
    };
    let judgement = Judgement {
        light: Spread::of(light.collect()),
        seen: Spread::of(seen),
        doubt,
    };
    Ok((judgement, map.to_vec()))
}

/// The greatest difference of two colours; what is no number in one alone is as far as can be.
fn apart(a: [f32; 4], b: [f32; 4]) -> f64 {
    let one = |k: usize| match (a[k].is_nan(), b[k].is_nan()) {
        (true, true) => 0.0,
        (false, false) => f64::from((a[k].clamp(0.0, 1.0) - b[k].clamp(0.0, 1.0)).abs()),
        _ => 1.0,
    };
    one(0).max(one(1)).max(one(2))
}

fn standard_error(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    if count < 2.0 {
        return f64::INFINITY;
    }
    let mean = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
    (squares / (count - 1.0) / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Size;
    use crate::measure::layout::parts;

    #[test]
    fn one_step_of_eight_bits_is_judged_as_what_it_is() {
        let size = Size {
            width: 64,
            height: 64,
        };
        let layout = Layout::new(parts(size), size);
        let grey = |x: f32| {
            let part = |w: &crate::executor::Window| {
                vec![[x, x, x, 1.0]; (w.size.width * w.size.height) as usize]
            };
            Parts::new(&layout, layout.windows.iter().map(part).collect()).unwrap()
        };
        let (same, _) = judge(&layout, &grey(0.25), &grey(0.25)).unwrap();
        assert_eq!((same.light.max, same.seen.max), (0.0, 0.0));
        let (near, map) = judge(&layout, &grey(0.25), &grey(0.2539)).unwrap();
        assert!((near.light.mean - 0.0039).abs() < 1e-6, "{near:?}");
        assert_eq!(near.light.p999, near.light.max);
        assert!(
            near.seen.mean > 0.0 && near.seen.mean < super::super::SEEN,
            "{near:?}"
        );
        assert_eq!(map.len(), 64 * 64);
        let (far, _) = judge(&layout, &grey(0.0), &grey(1.0)).unwrap();
        assert!(far.seen.mean > 0.5 && far.light.mean == 1.0, "{far:?}");
    }

    #[test]
    fn what_is_no_number_in_one_alone_is_wrong() {
        let nan = [f32::NAN, 0.5, 0.5, 1.0];
        assert_eq!(apart(nan, nan), 0.0);
        assert_eq!(apart(nan, [0.0, 0.5, 0.5, 1.0]), 1.0);
        assert_eq!(apart([2.0, 0.5, 0.5, 1.0], [1.0, 0.25, 0.5, 1.0]), 0.25);
    }

    #[test]
    fn spreads() {
        let values: Vec<f64> = (1..=2000).map(f64::from).collect();
        let spread = Spread::of(values);
        assert_eq!(
            (spread.mean, spread.p999, spread.max),
            (1000.5, 1998.0, 2000.0)
        );
        assert_eq!(Spread::of(Vec::new()), Spread::default());
    }
}
