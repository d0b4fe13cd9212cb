//! What a tier loses on a benchmark, with and without rewrites.

use pullback_compiler::formula::Formula;
use pullback_compiler::lower::Precision;
use pullback_compiler::{EvalModule, Evaluator, What, compile_function};
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::{Capabilities, Gpu, GpuEvaluator};

use super::bits::Exact;
use super::data::{Benchmark, Sample};
use super::rewriting;

/// What computes.
#[derive(Debug)]
pub enum Machine {
    /// The `f64` reference on the CPU, which computes a formula as it is written.
    Reference,
    /// A GPU.
    Gpu(Box<Gpu>),
}

/// How a formula is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// The tier.
    pub precision: Precision,
    /// Whether it is rewritten for stability first.
    pub rewrites: bool,
}

impl Way {
    /// Every tier, as written and rewritten.
    pub const ALL: [Self; 8] = {
        let mut all = [Self::new(Precision::Fast, false); 8];
        let mut k = 0;
        while k < 8 {
            all[k] = Self::new(Precision::ALL[k / 2], k % 2 == 1);
            k += 1;
        }
        all
    };

    /// A tier with or without rewrites.
    #[must_use]
    pub const fn new(precision: Precision, rewrites: bool) -> Self {
        Self {
            precision,
            rewrites,
        }
    }

    /// Its place in [`Self::ALL`].
    #[must_use]
    pub fn place(self) -> usize {
        Self::ALL.iter().position(|&w| w == self).unwrap_or(0)
    }
}

/// Bits that are lost, a mean over the points of a benchmark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss {
    /// Of the result rounded to `f32`, of 32 at most.
    pub single: f64,
    /// Of the result in the format of its tier: of 48 at most for pairs, of 64 for `f64`.
    pub own: f64,
}

/// A benchmark with what each way loses, in the order of [`Way::ALL`]; `None` where it was not asked for or the device has
/// no such numbers.
#[derive(Clone, Debug)]
pub struct Row<'b> {
    /// The benchmark.
    pub benchmark: &'b Benchmark,
    /// What was lost.
    pub losses: [Option<Loss>; 8],
    /// How many rewrites took place.
    pub rewrites: usize,
}

impl Row<'_> {
    /// What a way lost.
    #[must_use]
    pub fn loss(&self, precision: Precision, rewrites: bool) -> Option<Loss> {
        self.losses[Way::new(precision, rewrites).place()]
    }
}

/// The formula of a benchmark.
///
/// # Errors
/// It does not compile; its diagnostics.
pub fn formula(benchmark: &Benchmark) -> Result<Formula, String> {
    compile_function(&benchmark.program).map_err(|diagnostics| {
        let text = pullback_grammar::render(&diagnostics, &benchmark.id, &benchmark.program, false);
        format!("{}: {text}", benchmark.id)
    })
}

/// Measures some ways on a benchmark.
///
/// # Errors
/// It does not compile, or the device refuses it; in words.
pub fn measure<'b>(
    benchmark: &'b Benchmark,
    machine: &Machine,
    ways: &[Way],
) -> Result<Row<'b>, String> {
    let written = formula(benchmark)?;
    let rewrites = rewriting::count(&written);
    let mut losses = [None; 8];
    for &way in ways {
        let as_written = Way::new(way.precision, false);
        // what nothing is rewritten in need not be computed again
        if way.rewrites && rewrites == 0 && losses[as_written.place()].is_some() {
            losses[way.place()] = losses[as_written.place()];
            continue;
        }
        let formula = rewriting::with_rewrites(&written, way.rewrites);
        let Some(results) = results(&formula, machine, way.precision, &benchmark.points)
            .map_err(|e| format!("{} ({:?}): {e}", benchmark.id, way))?
        else {
            continue;
        };
        losses[way.place()] = Some(loss(way.precision, &benchmark.points, &results));
    }
    Ok(Row {
        benchmark,
        losses,
        rewrites,
    })
}

/// The values at the points, or `None` where the machine has no such tier.
///
/// # Errors
/// The device refuses the formula; in words.
pub fn results(
    formula: &Formula,
    machine: &Machine,
    precision: Precision,
    points: &[Sample],
) -> Result<Option<Vec<f64>>, String> {
    let Machine::Gpu(gpu) = machine else {
        return match precision {
            Precision::Double => reference(formula, points).map(Some),
            _ => Ok(None),
        };
    };
    if !gpu.has(precision) {
        return Ok(None);
    }
    let tier = Capabilities::tier(gpu, precision).map_err(|e| e.to_string())?;
    let module = EvalModule::new(formula, What::Value, tier).map_err(|e| format!("{e:?}"))?;
    let mut evaluator = GpuEvaluator::new(gpu, &module).map_err(|e| e.to_string())?;
    let rows: Vec<f64> = points
        .iter()
        .flat_map(|p| p.args.iter().map(|&x| f64::from(x)))
        .collect();
    let mut out = Vec::new();
    evaluator
        .eval_exactly(Surroundings::default(), points.len(), &rows, &mut out)
        .map_err(|e| e.to_string())?;
    Ok(Some(out))
}

fn reference(formula: &Formula, points: &[Sample]) -> Result<Vec<f64>, String> {
    let mut evaluator = Evaluator::new(formula, What::Value).map_err(|e| format!("{e:?}"))?;
    let mut out = [0.0];
    let value = |point: &Sample| {
        let args: Vec<f64> = point.args.iter().map(|&x| f64::from(x)).collect();
        evaluator.eval(&[], 0.0, 0.0, &args, &mut out);
        out[0]
    };
    Ok(points.iter().map(value).collect())
}

fn loss(precision: Precision, points: &[Sample], results: &[f64]) -> Loss {
    let own = match precision {
        Precision::Fast | Precision::Accurate => Exact::single_error,
        Precision::Extended => Exact::pair_error,
        Precision::Double => Exact::double_error,
    };
    let mean = |error: fn(Exact, f64) -> f64| {
        let total: f64 = points
            .iter()
            .zip(results)
            .map(|(p, &got)| error(p.exact, got))
            .sum();
        total / points.len() as f64
    };
    Loss {
        single: mean(Exact::single_error),
        own: mean(own),
    }
}
