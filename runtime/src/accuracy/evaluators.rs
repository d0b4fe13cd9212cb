//! The evaluators that are judged: the `f64` reference, and a GPU by the functions of a tier.

use std::fmt;

use pullback_compiler::formula::Formula;
use pullback_compiler::lower::Precision;
use pullback_compiler::{EvalModule, Evaluator, What};

use super::error::Format;
use crate::evaluate::Surroundings;
use crate::executor::{Arithmetic, Rows};
use crate::{Capabilities, Error, Gpu, GpuEvaluator};

/// Arguments and parameters of one evaluation.
#[derive(Clone, Debug)]
pub struct Point {
    /// The arguments.
    pub args: Vec<f64>,
    /// Values of the program's parameters.
    pub params: Vec<f64>,
}

/// Something that evaluates formulas.
#[derive(Debug)]
pub enum Machine {
    /// The `f64` reference on the CPU.
    Reference,
    /// A GPU, by the functions of a tier.
    Gpu(Box<Gpu>, Precision),
    /// The processor, by the shader of a tier.
    Processor(Arithmetic, Precision),
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reference => f.write_str("f64 reference"),
            Self::Gpu(gpu, tier) => write!(f, "{} ({})", gpu.adapter().name, tier.name()),
            Self::Processor(arithmetic, tier) => {
                write!(f, "{} ({})", arithmetic.name(), tier.name())
            }
        }
    }
}

impl Machine {
    /// The format of its results.
    #[must_use]
    pub fn format(&self) -> Format {
        self.precision().map_or(Format::Double, Precision::format)
    }

    /// Its tier; `None` for what is computed in `f64`.
    #[must_use]
    pub fn precision(&self) -> Option<Precision> {
        match self {
            Self::Reference | Self::Processor(Arithmetic::Reference, _) => None,
            Self::Gpu(_, precision) | Self::Processor(Arithmetic::Ieee32, precision) => {
                Some(*precision)
            }
        }
    }

    /// The columns that are asked for, at every point.
    ///
    /// # Errors
    /// The formula has none of these on this machine; in words.
    pub fn run(
        &self,
        formula: &Formula,
        what: What,
        points: &[Point],
    ) -> Result<Vec<Vec<f64>>, String> {
        match self {
            Self::Reference => {
                let mut evaluator = Evaluator::new(formula, what).map_err(|e| format!("{e:?}"))?;
                let mut out = vec![0.0; evaluator.outputs().len()];
                let row = |point: &Point| {
                    evaluator.eval(&point.params, 0.0, 0.0, &point.args, &mut out);
                    out.clone()
                };
                Ok(points.iter().map(row).collect())
            }
            Self::Gpu(gpu, precision) => {
                let tier = Capabilities::tier(gpu, *precision).map_err(|e| e.to_string())?;
                let module = EvalModule::new(formula, what, tier).map_err(|e| format!("{e:?}"))?;
                on_gpu(gpu, &module, points).map_err(|e| e.to_string())
            }
            Self::Processor(arithmetic, precision) => {
                let module =
                    EvalModule::new(formula, what, *precision).map_err(|e| format!("{e:?}"))?;
                let rows = Rows::new(&module, *arithmetic).map_err(|e| e.to_string())?;
                let width = module.outputs.len();
                by_runs(points, width, |surroundings, count, numbers, results| {
                    rows.eval(surroundings, count, numbers, results)
                })
                .map_err(|e| e.to_string())
            }
        }
    }
}

fn on_gpu(gpu: &Gpu, module: &EvalModule, points: &[Point]) -> Result<Vec<Vec<f64>>, Error> {
    let mut evaluator = GpuEvaluator::new(gpu, module)?;
    by_runs(
        points,
        module.outputs.len(),
        |surroundings, count, numbers, results| {
            evaluator.eval_exactly(surroundings, count, numbers, results)
        },
    )
}

/// One call for each run of points with the same parameters.
fn by_runs(
    points: &[Point],
    width: usize,
    mut eval: impl FnMut(Surroundings, usize, &[f64], &mut Vec<f64>) -> Result<(), Error>,
) -> Result<Vec<Vec<f64>>, Error> {
    let mut out = Vec::new();
    for run in points.chunk_by(|a, b| a.params == b.params) {
        let rows: Vec<f64> = run.iter().flat_map(|p| p.args.iter().copied()).collect();
        let mut results = Vec::new();
        let surroundings = Surroundings {
            params: &run[0].params,
            ..Surroundings::default()
        };
        eval(surroundings, run.len(), &rows, &mut results)?;
        out.extend(results.chunks(width).map(<[f64]>::to_vec));
    }
    Ok(out)
}
