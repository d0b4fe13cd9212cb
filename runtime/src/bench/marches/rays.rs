//! The rays of `rays.wgsl` in f64, and integrals along them by an adaptive rule.

use pullback_compiler::formula::Formula;
use pullback_compiler::{Evaluator, What};

use super::quadrature::{Exact, adaptive};
use crate::{Error, Size};

/// How far from a tie an end of a ray must be before it is rounded, in 1/1024, so that a device's division does not
/// decide where it goes.
const TIE: f64 = 0.01;
/// Panels of a ray before the rule adapts, so that nothing narrow falls between the nodes.
const PANELS: u32 = 32;

/// A ray o + t d, from t = a to t = b.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Pixel of the sample, row by row.
    pub pixel: usize,
    origin: [f64; 3],
    direction: [f64; 3],
    ends: [f64; 2],
}

/// The rays of every `stride`-th pixel; those that lie at a tie are left out.
#[must_use]
pub fn rays(size: Size, stride: u32) -> Vec<Ray> {
    let all = (0..size.height).flat_map(|y| (0..size.width).map(move |x| [x, y]));
    all.enumerate()
        .filter_map(|(pixel, place)| {
            ray(
                pixel,
                place.map(|x| (f64::from(x) + 0.5) * f64::from(stride)),
            )
        })
        .collect()
}

fn ray(pixel: usize, [x, y]: [f64; 2]) -> Option<Ray> {
    let [x, y] = [(x - 320.0) / 1024.0, (y - 180.0) / 1024.0];
    let origin = [-3.0, -4.5, 1.5];
    let direction = [
        0.5 + 0.75 * x + 0.125 * y,
        0.75 - 0.5 * x + 0.1875 * y,
        -0.25 + 0.8125 * y,
    ];
    let mut ends = [f64::NEG_INFINITY, f64::INFINITY];
    for (o, d) in origin.into_iter().zip(direction) {
        let far = 2.0 * f64::signum(d);
        ends[0] = ends[0].max((-far - o) / d);
        ends[1] = ends[1].min((far - o) / d);
    }
    let ends = ends.map(|t| t * 1024.0 + 0.5);
    let at_tie = ends.iter().any(|t| (t - t.round()).abs() < TIE);
    (!at_tie).then(|| Ray {
        pixel,
        origin,
        direction,
        ends: ends.map(|t| t.floor() / 1024.0),
    })
}

/// The density in f64.
pub struct Reference {
    evaluator: Evaluator,
    out: Vec<f64>,
}

impl Reference {
    /// Of a density.
    ///
    /// # Errors
    /// It has no evaluator.
    pub fn new(formula: &Formula) -> Result<Self, Error> {
        let evaluator = Evaluator::new(formula, What::Value).map_err(|error| Error::Invalid {
            reason: format!("{error:?}"),
        })?;
        let out = vec![0.0; evaluator.outputs().len()];
        Ok(Self { evaluator, out })
    }

    /// The integral along a ray.
    pub fn integrate(&mut self, ray: &Ray) -> Exact {
        let [a, b] = ray.ends;
        let width = (b - a) / f64::from(PANELS);
        let places: Vec<f64> = (0..PANELS)
            .map(|k| a + f64::from(k) * width)
            .chain([b])
            .collect();
        adaptive(&places, |t| self.density(ray, t))
    }

    fn density(&mut self, ray: &Ray, t: f64) -> f64 {
        let at = [0, 1, 2].map(|k| ray.origin[k] + t * ray.direction[k]);
        self.evaluator.eval(&[], 0.0, 0.0, &at, &mut self.out);
        self.out[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pullback_compiler::compile;

    /// A jump, against the antiderivative between the cuts, and a sine against its own.
    #[test]
    fn integrals_are_those_of_the_antiderivatives() {
        let size = Size {
            width: 640 / 40,
            height: 360 / 40,
        };
        let clamped = |x: f64| x.clamp(-1.0, 1.0);
        let ramp = |z: f64| 0.5 * (clamped(z) + 1.0).powi(2);
        let sine = |z: f64| -(3.0 * z).cos() / 3.0;
        let cases: [(&str, &dyn Fn(f64) -> f64); 2] = [
            ("if 0 < z + 1 and z + 1 < 2 then z + 1 else 0", &ramp),
            ("sin(3 z)", &sine),
        ];
        for (text, antiderivative) in cases {
            let program = compile(&format!("f(x, y, z) = {text}")).program.unwrap();
            let mut reference = Reference::new(&program.pictures()[0].formula).unwrap();
            for ray in rays(size, 40) {
                let [a, b] = ray.ends.map(|t| ray.origin[2] + t * ray.direction[2]);
                let expected = (antiderivative(b) - antiderivative(a)) / ray.direction[2];
                let found = reference.integrate(&ray);
                let off = (found.value - expected).abs() / found.size;
                assert!(off < 1e-9, "{text}: {ray:?}: {found:?}, not {expected}");
            }
        }
    }
}
