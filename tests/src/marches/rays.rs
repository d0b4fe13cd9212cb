//! The rays of `tests/marches/rays.wgsl` in f64, and integrals along them by an adaptive rule.

use pullback_compiler::formula::Formula;
use pullback_compiler::{Evaluator, What};
use pullback_runtime::{Error, Size};

/// How far from a tie an end of a ray must be before it is rounded, in 1/1024, so that a device's division does not
/// decide where it goes.
const TIE: f64 = 0.01;
/// Panels of a ray before the rule adapts, so that nothing narrow falls between the nodes.
const PANELS: u32 = 32;
/// How often a panel is halved.
const DEEPEST: u32 = 40;
/// How far apart the two rules, and a panel and its halves, may be, as a part of ∫ |f|; what is kept is closer.
const TOLERANCE: f64 = 1e-10;

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

/// An integral, and that of the absolute value.
#[derive(Clone, Copy, Debug)]
pub struct Exact {
    /// ∫ f
    pub value: f64,
    /// ∫ |f|
    pub size: f64,
}

/// Seven nodes of Kronrod's extension of the rule of Lobatto with four, as pairs around the middle, which is the first:
/// place, weight, and weight in the rule of Lobatto. Both ends are nodes: with inner nodes alone a jump near an end would
/// not be seen.
///
/// Gander and Gautschi, "Adaptive quadrature, revisited", BIT 40, 2000.
const NODES: [[f64; 3]; 4] = [
    [0.0, 672.0 / 1470.0, 0.0],
    [0.447_213_595_499_957_9, 625.0 / 1470.0, 5.0 / 6.0],
    [0.816_496_580_927_726, 432.0 / 1470.0, 0.0],
    [1.0, 77.0 / 1470.0, 1.0 / 6.0],
];

struct Panel {
    from: f64,
    to: f64,
    depth: u32,
    value: f64,
    size: f64,
    /// The two rules apart.
    apart: f64,
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

    /// The integral along a ray, by the rules of Lobatto and Kronrod on panels that are halved until both agree, and
    /// their halves with them.
    pub fn integrate(&mut self, ray: &Ray) -> Exact {
        let [a, b] = ray.ends;
        let width = (b - a) / f64::from(PANELS);
        let mut open: Vec<Panel> = (0..PANELS)
            .map(|k| {
                let from = a + f64::from(k) * width;
                self.panel(ray, from, from + width, 0)
            })
            .collect();
        let size: f64 = open.iter().map(|panel| panel.size).sum();
        let mut total = Exact {
            value: 0.0,
            size: 0.0,
        };
        while let Some(panel) = open.pop() {
            let middle = 0.5 * (panel.from + panel.to);
            let halves = [
                self.panel(ray, panel.from, middle, panel.depth + 1),
                self.panel(ray, middle, panel.to, panel.depth + 1),
            ];
            let value = halves[0].value + halves[1].value;
            // beside a kink two rules may agree by chance, where the halves do not
            let apart = panel.apart.max((panel.value - value).abs());
            if apart <= TOLERANCE * size || panel.depth == DEEPEST {
                total.value += value;
                total.size += halves[0].size + halves[1].size;
            } else {
                open.extend(halves);
            }
        }
        total
    }

    fn panel(&mut self, ray: &Ray, from: f64, to: f64, depth: u32) -> Panel {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let (mut value, mut size, mut coarse) = (0.0, 0.0, 0.0);
        for (k, [place, fine, lobatto]) in NODES.into_iter().enumerate() {
            for side in if k == 0 { &[1.0][..] } else { &[-1.0, 1.0] } {
                let f = self.density(ray, middle + side * half * place);
                value += fine * f;
                size += fine * f.abs();
                coarse += lobatto * f;
            }
        }
        Panel {
            from,
            to,
            depth,
            value: half * value,
            size: half * size,
            apart: half * (value - coarse).abs(),
        }
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
