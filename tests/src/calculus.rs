//! What the suite of derivatives shares: points, values, and how near they must be.

use pullback_compiler::formula::Formula;
use pullback_compiler::{Evaluator, What, compile};

/// Points at which formulas are compared.
#[derive(Clone, Copy, Debug)]
pub enum Points {
    /// Of the plane; none on an axis or the diagonal.
    Plane,
}

impl Points {
    /// Their coordinates.
    #[must_use]
    pub fn rows(self) -> Vec<Vec<f64>> {
        match self {
            Self::Plane => [
                [0.37, -1.21],
                [1.9, 0.53],
                [-0.71, -0.29],
                [-2.3, 1.7],
                [0.11, 2.9],
            ]
            .iter()
            .map(|p| p.to_vec())
            .collect(),
        }
    }
}

/// The formula that a program shows first.
///
/// # Errors
/// The program is wrong; its diagnostics.
pub fn formula(text: &str) -> Result<(Formula, Vec<f64>), String> {
    let answer = compile(text);
    let Some(program) = answer.program else {
        return Err(pullback_grammar::render(
            &answer.diagnostics,
            "calculus",
            text,
            false,
        ));
    };
    let params = program.params().iter().map(|p| p.default).collect();
    Ok((program.pictures()[0].formula.clone(), params))
}

/// The values of a program's formula at points, in `f64`.
///
/// # Errors
/// The program is wrong.
pub fn values(text: &str, points: Points) -> Result<Vec<Vec<f64>>, String> {
    let (formula, params) = formula(text)?;
    let mut evaluator =
        Evaluator::new(&formula, What::Value).map_err(|e| format!("{text}: {e:?}"))?;
    let mut out = vec![0.0; evaluator.outputs().len()];
    let width = evaluator.inputs().len();
    Ok(points
        .rows()
        .iter()
        .map(|row| {
            evaluator.eval(&params, 0.7, 0.0, &row[..width.min(row.len())], &mut out);
            out.clone()
        })
        .collect())
}

/// The first value that is not as expected, within a bound relative to it and to 1.
#[must_use]
pub fn close_to(found: &[Vec<f64>], expected: &[Vec<f64>], bound: f64) -> Option<String> {
    let pairs = found.iter().flatten().zip(expected.iter().flatten());
    for (k, (f, e)) in pairs.enumerate() {
        // also where either is not a number
        let near = (f - e).abs() <= bound * (1.0 + e.abs());
        if !near {
            return Some(format!("number {k}: {f:?} instead of {e:?}"));
        }
    }
    (found.len() != expected.len()).then(|| "of another number".to_owned())
}

/// Who evaluates.
#[derive(Debug)]
pub enum Device {
    /// The processor, in `f64`.
    Reference,
    /// A GPU, in `f32`.
    #[cfg(feature = "gpu")]
    Gpu(crate::accuracy::evaluators::Machine),
}

impl Device {
    /// The rounding unit of its numbers.
    #[must_use]
    pub fn unit(&self) -> f64 {
        match self {
            Self::Reference => 2.0_f64.powi(-53),
            #[cfg(feature = "gpu")]
            Self::Gpu(_) => 2.0_f64.powi(-24),
        }
    }

    /// For messages.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Reference => "the processor",
            #[cfg(feature = "gpu")]
            Self::Gpu(_) => "the GPU",
        }
    }
}

/// Every device that the suites run on.
#[must_use]
pub fn devices() -> Vec<Device> {
    #[allow(unused_mut, reason = "there may be a GPU")]
    let mut devices = vec![Device::Reference];
    #[cfg(feature = "gpu")]
    if let Some(gpu) = crate::accuracy::evaluators::suite_gpu() {
        use crate::accuracy::evaluators::Machine;
        use pullback_compiler::lower::Precision;
        devices.push(Device::Gpu(Machine::Gpu(
            Box::new(gpu),
            Precision::Accurate,
        )));
    }
    devices
}

/// What is asked of a program's formula at points, a row of columns for each.
///
/// # Panics
/// The program is wrong, or has none of what is asked.
#[must_use]
pub fn columns(device: &Device, text: &str, what: What, points: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let (formula, params) = formula(text).unwrap_or_else(|e| panic!("{e}"));
    match device {
        Device::Reference => {
            let mut evaluator =
                Evaluator::new(&formula, what).unwrap_or_else(|e| panic!("{text}: {e:?}"));
            let mut out = vec![0.0; evaluator.outputs().len()];
            let row = |point: &Vec<f64>| {
                evaluator.eval(&params, 0.0, 0.0, point, &mut out);
                out.clone()
            };
            points.iter().map(row).collect()
        }
        #[cfg(feature = "gpu")]
        Device::Gpu(machine) => {
            let points: Vec<crate::accuracy::evaluators::Point> = points
                .iter()
                .map(|point| crate::accuracy::evaluators::Point {
                    args: point.clone(),
                    params: params.clone(),
                })
                .collect();
            let found = machine.run(&formula, what, &points);
            found.unwrap_or_else(|e| panic!("{text}: {e}"))
        }
    }
}

/// Random numbers, the same in every run.
#[derive(Debug)]
pub struct Noise {
    state: u64,
}

impl Noise {
    /// Numbers that follow from a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// A multiple of 2⁻¹² in -2..2, so that it is the same number in `f32`. Knuth's linear congruential generator.
    fn next(&mut self) -> f64 {
        self.state = self
            .state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let high = u32::try_from(self.state >> 50).unwrap_or(0);
        (f64::from(high) - 8192.0) / 4096.0
    }

    /// Points of which no coordinate is nearer to 0 than `gap`.
    #[must_use]
    pub fn points(&mut self, dimension: usize, count: usize, gap: f64) -> Vec<Vec<f64>> {
        let mut out = Vec::new();
        while out.len() < count {
            let point: Vec<f64> = (0..dimension).map(|_| self.next()).collect();
            if point.iter().all(|x| x.abs() >= gap) {
                out.push(point);
            }
        }
        out
    }
}
