//! The rays of `tests/marches/rays.wgsl` in f64, and integrals along them by an adaptive rule.

use pullback_compiler::formula::Formula;
use pullback_compiler::{Evaluator, What};
use pullback_runtime::{Error, Size};

/// How far from a tie an end of a ray must be before it is rounded, in 1/1024, so that a device's division does not
/// decide where it goes.
const TIE: f64 = 0.01;
/// Panels of a ray before the rule adapts, so that nothing narrow falls between the nodes.
const PANELS: u32 = 24;
/// How often a panel is halved.
const DEEPEST: u32 = 40;
/// What one panel may be off, as a part of ∫ |f|.
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

/// The 15 nodes of Kronrod on [0, 1): place, weight, and weight in the rule of Gauss with 7 nodes.
///
/// Piessens et al., QUADPACK, 1983, routine QK15.
const KRONROD: [[f64; 3]; 8] = [
    [0.0, 0.209_482_141_084_727_83, 0.417_959_183_673_469_4],
    [0.207_784_955_007_898_47, 0.204_432_940_075_298_89, 0.0],
    [
        0.405_845_151_377_397_17,
        0.190_350_578_064_785_41,
        0.381_830_050_505_118_94,
    ],
    [0.586_087_235_467_691_13, 0.169_004_726_639_267_90, 0.0],
    [
        0.741_531_185_599_394_44,
        0.140_653_259_715_525_92,
        0.279_705_391_489_276_67,
    ],
    [0.864_864_423_359_769_07, 0.104_790_010_322_250_18, 0.0],
    [
        0.949_107_912_342_758_52,
        0.063_092_092_629_978_553,
        0.129_484_966_168_869_69,
    ],
    [0.991_455_371_120_812_64, 0.022_935_322_010_529_225, 0.0],
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

    /// The integral along a ray, by the rule of Gauss and Kronrod on panels that are halved until both agree.
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
            if panel.apart <= TOLERANCE * size || panel.depth == DEEPEST {
                total.value += panel.value;
                total.size += panel.size;
                continue;
            }
            let middle = 0.5 * (panel.from + panel.to);
            open.push(self.panel(ray, panel.from, middle, panel.depth + 1));
            open.push(self.panel(ray, middle, panel.to, panel.depth + 1));
        }
        total
    }

    fn panel(&mut self, ray: &Ray, from: f64, to: f64, depth: u32) -> Panel {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let (mut value, mut size, mut gauss) = (0.0, 0.0, 0.0);
        for (k, [place, kronrod, weight]) in KRONROD.into_iter().enumerate() {
            for side in if k == 0 { &[1.0][..] } else { &[-1.0, 1.0] } {
                let f = self.density(ray, middle + side * half * place);
                value += kronrod * f;
                size += kronrod * f.abs();
                gauss += weight * f;
            }
        }
        Panel {
            from,
            to,
            depth,
            value: half * value,
            size: half * size,
            apart: half * (value - gauss).abs(),
        }
    }

    fn density(&mut self, ray: &Ray, t: f64) -> f64 {
        let at = [0, 1, 2].map(|k| ray.origin[k] + t * ray.direction[k]);
        self.evaluator.eval(&[], 0.0, 0.0, &at, &mut self.out);
        self.out[0]
    }
}
