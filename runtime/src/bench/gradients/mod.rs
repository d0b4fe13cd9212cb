//! Exact gradients beside those by hand and beside finite differences: time of a point on a device, and error.

pub mod formulas;

use std::fmt::Write as _;

use pullback_compiler::formula::Formula;
use pullback_compiler::lower::Precision;
use pullback_compiler::{Evaluator, What, compile};

use super::canvas::{Canvas, Stage};
use super::statistics::median;
use super::wgsl::numbers_of_pixels;
use crate::{Error, Frame, Gpu, Pipeline, Size, View};
use formulas::Gradient;

/// Points of a layer.
const LAYER: Size = Size {
    width: 512,
    height: 512,
};
/// Layers of a timed dispatch.
const ROUNDS: u32 = 16;
/// Errors are those of every so manyth point of a layer.
const STRIDE: usize = 11;
/// The step of differences. About the root of what a float32 number is rounded by, which is best for forward ones.
const STEP: &str = "0.001";

/// How a value, or a value and its gradient, are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The value alone, by the compiler.
    Value,
    /// The compiler's gradient.
    Exact,
    /// The gradient that is derived and written by hand.
    Hand,
    /// Differences with the value: four evaluations.
    Forward,
    /// Differences around the point: seven evaluations.
    Central,
}

impl Method {
    /// All of them, in the order of what is measured.
    pub const ALL: [Self; 5] = [
        Self::Value,
        Self::Exact,
        Self::Hand,
        Self::Forward,
        Self::Central,
    ];

    /// The body of the function that is timed.
    fn body(self, gradient: &Gradient) -> String {
        let at = |sign: char, axis: &str| format!("field(p {sign} H * vec3f({axis}))");
        let axes = ["1.0, 0.0, 0.0", "0.0, 1.0, 0.0", "0.0, 0.0, 1.0"];
        match self {
            Self::Value => "return vec4f(0.0, 0.0, 0.0, field(p));".to_owned(),
            Self::Exact => "return field_grad(p);".to_owned(),
            Self::Hand => gradient.by_hand.to_owned(),
            Self::Forward => {
                let parts = axes.map(|axis| format!("({} - v) / H", at('+', axis)));
                format!("let v = field(p); return vec4f({}, v);", parts.join(", "))
            }
            Self::Central => {
                let parts =
                    axes.map(|axis| format!("({} - {}) / (2.0 * H)", at('+', axis), at('-', axis)));
                format!("return vec4f({}, field(p));", parts.join(", "))
            }
        }
    }

    /// The shader that adds components of what is found at the points of some layers.
    fn text(self, gradient: &Gradient, rounds: u32, parts: [u8; 4]) -> String {
        let mut text = format!("const H: f32 = {STEP};\nconst ROUNDS: u32 = {rounds}u;\n");
        let parts = parts.map(|part| format!("{part}.0")).join(", ");
        let _ = writeln!(text, "const PARTS: vec4f = vec4f({parts});");
        text += include_str!("points.wgsl");
        text + &format!(
            "\nfn found(p: vec3f) -> vec4f {{\n{}\n}}\n",
            self.body(gradient)
        )
    }
}

/// What was measured of a formula.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// Seconds of a point's value.
    pub value: f64,
    /// Medians of ratios of the turns, of the other methods in their order: a point's value and gradient to its value alone.
    pub ratios: [f64; 4],
    /// Errors of gradients by the other methods, relative to the length of the exact gradient: 99.9 % are within these.
    pub errors: [f64; 4],
}

/// Measures one formula in `fast`, whose functions are those that all methods call.
///
/// # Errors
/// The device's, and [`Error::Invalid`] where the formula does not compile.
pub fn measure(gradient: &Gradient, gpu: &Gpu, turns: u32) -> Result<Measured, Error> {
    let text = format!("f(x, y, z) = {}", gradient.formula);
    let program = compile(&text)
        .program
        .ok_or(Error::Invalid { reason: text })?;
    let formula = &program.pictures()[0].formula;
    let canvas = canvas(gpu)?;
    let mut stages = Vec::new();
    for method in Method::ALL {
        stages.push(staged(
            &canvas,
            formula,
            &method.text(gradient, ROUNDS, [1; 4]),
        )?);
    }
    let Ok(stages) = <[Stage; 5]>::try_from(stages) else {
        return Err(Error::Invalid {
            reason: "a method is missing".to_owned(),
        });
    };
    let all = canvas.turns(&stages, turns)?;
    let points = f64::from(LAYER.width * LAYER.height * ROUNDS);
    let value: Vec<f64> = all.iter().map(|turn| turn[0] / points).collect();
    let ratio = |k: usize| {
        let ratios: Vec<f64> = all.iter().map(|turn| turn[k] / turn[0]).collect();
        median(&ratios)
    };
    let truth = exact(formula)?;
    let mut errors = [0.0; 4];
    for (error, &method) in errors.iter_mut().zip(&Method::ALL[1..]) {
        *error = self::error(&canvas, formula, gradient, method, &truth)?;
    }
    Ok(Measured {
        value: median(&value),
        ratios: [1, 2, 3, 4].map(ratio),
        errors,
    })
}

fn canvas(gpu: &Gpu) -> Result<Canvas, Error> {
    let frame = Frame {
        view: View {
            center: [0.0, 0.0],
            height: 2.0,
        },
        params: &[],
        settings: &[0; 16],
        size: LAYER,
        samples: 1,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    Canvas::new(gpu, &frame)
}

fn staged(canvas: &Canvas, formula: &Formula, text: &str) -> Result<Stage, Error> {
    let (module, info) = numbers_of_pixels(text, formula, Precision::Fast.into())?;
    canvas.stage(&module, &info)
}

/// Numbers of pixels of the points that are judged.
fn judged() -> impl Iterator<Item = usize> {
    (0..(LAYER.width * LAYER.height) as usize).step_by(STRIDE)
}

/// The gradients at these points in f64.
fn exact(formula: &Formula) -> Result<Vec<[f64; 3]>, Error> {
    let mut evaluator =
        Evaluator::new(formula, What::Gradient).map_err(|error| Error::Invalid {
            reason: format!("{error:?}"),
        })?;
    let mut out = vec![0.0; evaluator.outputs().len()];
    Ok(judged()
        .map(|pixel| {
            let [x, y] = [pixel % LAYER.width as usize, pixel / LAYER.width as usize];
            let layer = (5 * x + 3 * y) % 512;
            let at = [x, y, layer].map(|k| (k as f64 + 0.5 - 256.0) / 128.0);
            evaluator.eval(&[], 0.0, 0.0, &at, &mut out);
            [out[1], out[2], out[3]]
        })
        .collect())
}

/// What 99.9 % of the errors of a method are within.
fn error(
    canvas: &Canvas,
    formula: &Formula,
    gradient: &Gradient,
    method: Method,
    truth: &[[f64; 3]],
) -> Result<f64, Error> {
    let mut squares = vec![0.0_f64; truth.len()];
    for axis in 0..3 {
        let mut parts = [0; 4];
        parts[axis] = 1;
        let stage = staged(canvas, formula, &method.text(gradient, 1, parts))?;
        let bytes = canvas.picture(&stage)?;
        let found = bytes.as_chunks::<4>().0;
        for ((square, pixel), exact) in squares.iter_mut().zip(judged()).zip(truth) {
            *square += (f64::from(f32::from_le_bytes(found[pixel])) - exact[axis]).powi(2);
        }
    }
    let length = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut errors: Vec<f64> = squares
        .iter()
        .zip(truth)
        .map(|(square, exact)| square.sqrt() / length(exact))
        .map(|error| if error.is_nan() { f64::INFINITY } else { error })
        .collect();
    errors.sort_by(f64::total_cmp);
    let rank = errors.len() - errors.len() / 1000;
    Ok(errors.get(rank.saturating_sub(1)).copied().unwrap_or(0.0))
}
