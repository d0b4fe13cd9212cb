//! Closed forms of integrals along rays beside the march and beside the rule of Gauss and Legendre that are as right:
//! how long a frame of rays takes.

pub mod densities;
pub mod quadrature;
mod rays;
mod shaders;

use pullback_compiler::compile;
use pullback_compiler::formula::Formula;

use super::canvas::{Canvas, Stage};
use super::statistics::median;
use crate::{Error, Frame, Gpu, Pipeline, Size, View};
use densities::Density;
use quadrature::Exact;
use rays::{Ray, Reference, rays};
use shaders::{Method, module};

/// The frame whose rays are judged, of which every so manyth is.
pub const FRAME: Size = Size {
    width: 640,
    height: 360,
};
/// Most steps of a march.
pub const STEPS: u32 = 4096;
/// March and Gauss quadrature need not be better than this, as a part of ∫ |f|: what closed forms are held to.
pub const FLOOR: f64 = 1e-6;
/// Orders of the rule of Gauss and Legendre.
pub const ORDERS: [u32; 10] = [2, 4, 6, 8, 12, 16, 24, 32, 48, 64];

/// How to measure.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// Errors are those of the rays of every so manyth pixel of a row, and row: a divisor of 40.
    pub stride: u32,
    /// The others need not be better than this, as a part of ∫ |f|.
    pub floor: f64,
    /// Seconds of timed turns of a density, more or less.
    pub seconds: f64,
}

/// A method beside the closed form.
#[derive(Clone, Copy, Debug)]
pub struct Rival {
    /// Steps or nodes: the least that are as right as the closed form, or the most that are tried.
    pub order: u32,
    /// Whether that is right enough.
    pub reached: bool,
    /// Its error.
    pub error: f64,
    /// The median of the ratios of its time to that of the closed form.
    pub ratio: f64,
}

/// What was measured of a density.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// Error of the closed form: 99.9 % of the rays are within this, as a part of ∫ |f|.
    pub error: f64,
    /// Seconds of a frame of it.
    pub seconds: f64,
    /// The march.
    pub march: Rival,
    /// Gauss and Legendre.
    pub gauss: Rival,
}

/// How many rays of a side of a pixel are timed: so many that a frame takes longer than it takes to begin one.
#[must_use]
pub fn fineness(gpu: &Gpu) -> u32 {
    if gpu.adapter().is_software() { 1 } else { 4 }
}

/// The samples of a frame, with their integrals in f64.
struct Samples<'a> {
    gpu: &'a Gpu,
    formula: &'a Formula,
    size: Size,
    stride: u32,
    rays: Vec<(Ray, Exact)>,
    /// The least ∫ |f| that counts.
    least: f64,
}

/// Measures one density.
///
/// # Errors
/// The device's, and [`Error::Invalid`] where the density does not compile.
pub fn measure(density: &Density, gpu: &Gpu, plan: &Plan) -> Result<Measured, Error> {
    let text = format!("f(x, y, z) = {}\nshow additive(f)", density.formula);
    let program = compile(&text).program;
    let program = program.ok_or(Error::Invalid { reason: text })?;
    let formula = &program.pictures()[0].formula;
    let mut samples = Samples::new(gpu, formula, plan.stride)?;
    let error = samples.error(Method::Closed)?;
    let target = error.max(plan.floor);
    let steps = std::iter::successors(Some(1), |n| Some(2 * n)).take_while(|&n| n <= STEPS);
    let (march, march_error) = samples.least(steps.map(Method::March), target)?;
    let (gauss, gauss_error) = samples.least(ORDERS.into_iter().map(Method::Gauss), target)?;
    let [seconds, march_ratio, gauss_ratio] = times(gpu, formula, [march, gauss], plan.seconds)?;
    let rival = |method, error, ratio| Rival {
        order: match method {
            Method::Closed => 0,
            Method::March(order) | Method::Gauss(order) => order,
        },
        reached: error <= target,
        error,
        ratio,
    };
    Ok(Measured {
        error,
        seconds,
        march: rival(march, march_error, march_ratio),
        gauss: rival(gauss, gauss_error, gauss_ratio),
    })
}

impl<'a> Samples<'a> {
    fn new(gpu: &'a Gpu, formula: &'a Formula, stride: u32) -> Result<Self, Error> {
        let size = Size {
            width: FRAME.width / stride,
            height: FRAME.height / stride,
        };
        let mut reference = Reference::new(formula)?;
        let integrated = |ray: Ray| (ray, reference.integrate(&ray));
        let rays: Vec<_> = rays(size, stride).into_iter().map(integrated).collect();
        let greatest = rays.iter().map(|ray| ray.1.size).fold(0.0, f64::max);
        Ok(Self {
            gpu,
            formula,
            size,
            stride,
            rays,
            least: 1e-6 * greatest,
        })
    }

    /// The first of these methods that is right enough, or the last, with its error.
    fn least(
        &mut self,
        methods: impl Iterator<Item = Method>,
        target: f64,
    ) -> Result<(Method, f64), Error> {
        let mut found = (Method::Closed, f64::INFINITY);
        for method in methods {
            found = (method, self.error(method)?);
            if found.1 <= target {
                break;
            }
        }
        Ok(found)
    }

    /// The error that 99.9 % of the rays are within, as a part of ∫ |f|.
    fn error(&mut self, method: Method) -> Result<f64, Error> {
        let (canvas, stage) = staged(
            self.gpu,
            self.formula,
            method,
            f64::from(self.stride),
            self.size,
        )?;
        let bytes = canvas.picture(&stage)?;
        let found = bytes.as_chunks::<4>().0;
        let mut errors: Vec<f64> = self
            .rays
            .iter()
            .map(|(ray, exact)| {
                let found = f32::from_le_bytes(found[ray.pixel]);
                let off = (f64::from(found) - exact.value).abs() / exact.size.max(self.least);
                if off.is_nan() { f64::INFINITY } else { off }
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        let rank = (0.999 * errors.len() as f64).ceil() as usize;
        Ok(errors[rank.max(1) - 1])
    }
}

/// A method on the device, for a picture of rays.
fn staged(
    gpu: &Gpu,
    formula: &Formula,
    method: Method,
    stride: f64,
    size: Size,
) -> Result<(Canvas, Stage), Error> {
    let frame = Frame {
        view: View {
            center: [0.0, 0.0],
            height: 2.0,
        },
        params: &method.params(),
        settings: &[0; 16],
        size,
        samples: 1,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let canvas = Canvas::new(gpu, &frame)?;
    let (module, info) = module(gpu, formula, method, stride)?;
    let stage = canvas.stage(&module, &info)?;
    Ok((canvas, stage))
}

/// Seconds of a frame of the closed form, and the medians of the ratios of the rivals' times to it, all drawn in turns.
fn times(
    gpu: &Gpu,
    formula: &Formula,
    rivals: [Method; 2],
    seconds: f64,
) -> Result<[f64; 3], Error> {
    let fine = fineness(gpu);
    let size = Size {
        width: fine * FRAME.width,
        height: fine * FRAME.height,
    };
    let of = |method| staged(gpu, formula, method, 1.0 / f64::from(fine), size);
    let (_, closed) = of(Method::Closed)?;
    let (_, march) = of(rivals[0])?;
    let (canvas, gauss) = of(rivals[1])?;
    let stages = [closed, march, gauss];
    let first = canvas.turns(&stages, 1)?;
    let once: f64 = first.iter().flatten().sum();
    let turns = (seconds / once.max(1e-6)).clamp(3.0, 15.0) as u32;
    let turns = canvas.turns(&stages, turns)?;
    let ratio = |k: usize| {
        let all: Vec<f64> = turns.iter().map(|turn| turn[k] / turn[0]).collect();
        median(&all)
    };
    let closed: Vec<f64> = turns.iter().map(|turn| turn[0]).collect();
    let closed = median(&closed);
    Ok([closed, ratio(1), ratio(2)])
}
