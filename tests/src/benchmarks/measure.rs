//! What a tier loses on a benchmark, with and without rewrites.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use pullback_compiler::formula::Formula;
use pullback_compiler::lower::{Precision, Tier};
use pullback_compiler::{EvalModule, Evaluator, What, compile_function};
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::executor::{Contraction, Rows};
use pullback_runtime::{Capabilities, Gpu, GpuEvaluator};

use super::bits::Exact;
use super::data::{Benchmark, Sample};
use super::rewriting;
use super::store::{Store, key};

/// What computes.
#[derive(Debug)]
pub enum Machine {
    /// The `f64` reference on the CPU, which computes a formula as it is written.
    Reference,
    /// The executor, in exact single precision with products fused into sums as a driver may.
    Contracted(Contraction),
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
    /// Ways that the device refused, and why.
    pub refused: Vec<String>,
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

/// Measures some ways on a benchmark. What the store knows is not computed again. What the device refuses, by a time limit
/// say, is noted, and has no loss.
///
/// # Errors
/// It does not compile; in words.
pub fn measure<'b>(
    benchmark: &'b Benchmark,
    machine: &Machine,
    ways: &[Way],
    store: &Store,
) -> Result<Row<'b>, String> {
    let written = formula(benchmark)?;
    let rewrites = rewriting::count(&written);
    let mut losses = [None; 8];
    let mut refused = Vec::new();
    for &way in ways {
        // what nothing is rewritten in need not be computed again
        let other = Way::new(way.precision, !way.rewrites);
        if rewrites == 0 && losses[other.place()].is_some() {
            losses[way.place()] = losses[other.place()];
            continue;
        }
        let formula = rewriting::with_rewrites(&written, way.rewrites);
        match lost(&formula, machine, way.precision, &benchmark.points, store) {
            Ok(loss) => losses[way.place()] = loss,
            Err(e) => refused.push(format!("{} ({way:?}): {e}", benchmark.id)),
        }
        if rewrites == 0 {
            losses[other.place()] = losses[way.place()];
        }
    }
    Ok(Row {
        benchmark,
        losses,
        rewrites,
        refused,
    })
}

/// Measures benchmarks on several machines at once, one thread each: on a GPU it is the driver's compiler that takes the
/// time. `done` is told how many are finished.
pub fn measure_all<'b>(
    benchmarks: &[&'b Benchmark],
    machines: &[Machine],
    ways: &[Way],
    store: &Store,
    done: &(impl Fn(usize) + Sync),
) -> Vec<Result<Row<'b>, String>> {
    // the longest first, so that no thread ends with one alone
    let mut order: Vec<usize> = (0..benchmarks.len()).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(benchmarks[k].program.len()));
    let (next, finished) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let rows = Mutex::new(Vec::new());
    let work = |machine: &Machine| {
        while let Some(&k) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
            let row = measure(benchmarks[k], machine, ways, store);
            done(1 + finished.fetch_add(1, Ordering::Relaxed));
            if let Ok(mut rows) = rows.lock() {
                rows.push((k, row));
            }
        }
    };
    std::thread::scope(|scope| {
        for machine in machines {
            scope.spawn(|| work(machine));
        }
    });
    let mut rows = rows.into_inner().unwrap_or_default();
    rows.sort_by_key(|(k, _)| *k);
    rows.into_iter().map(|(_, row)| row).collect()
}

/// What a formula loses at the points, or `None` where the machine has no such tier.
fn lost(
    formula: &Formula,
    machine: &Machine,
    precision: Precision,
    points: &[Sample],
    store: &Store,
) -> Result<Option<Loss>, String> {
    let Machine::Gpu(gpu) = machine else {
        let results = results(formula, machine, precision, points)?;
        return Ok(results.map(|results| loss(precision, points, &results)));
    };
    if !gpu.has(precision) {
        return Ok(None);
    }
    let tier = Capabilities::tier(gpu, precision).map_err(|e| e.to_string())?;
    let module = EvalModule::new(formula, What::Value, tier).map_err(|e| format!("{e:?}"))?;
    let key = key(&gpu.adapter().to_string(), &module, points);
    if let Some(known) = store.get(key) {
        return Ok(Some(known));
    }
    let found = loss(precision, points, &computed(gpu, &module, points)?);
    store.put(key, found)?;
    Ok(Some(found))
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
        return match (machine, precision) {
            (Machine::Contracted(contraction), Precision::Accurate) => {
                contracted(formula, *contraction, points).map(Some)
            }
            (Machine::Reference, Precision::Double) => reference(formula, points).map(Some),
            _ => Ok(None),
        };
    };
    if !gpu.has(precision) {
        return Ok(None);
    }
    let tier = Capabilities::tier(gpu, precision).map_err(|e| e.to_string())?;
    let module = EvalModule::new(formula, What::Value, tier).map_err(|e| format!("{e:?}"))?;
    computed(gpu, &module, points).map(Some)
}

/// The values of a module on a GPU.
fn computed(gpu: &Gpu, module: &EvalModule, points: &[Sample]) -> Result<Vec<f64>, String> {
    let mut evaluator = GpuEvaluator::new(gpu, module).map_err(|e| e.to_string())?;
    let rows: Vec<f64> = points
        .iter()
        .flat_map(|p| p.args.iter().map(|&x| f64::from(x)))
        .collect();
    let mut out = Vec::new();
    evaluator
        .eval_exactly(Surroundings::default(), points.len(), &rows, &mut out)
        .map_err(|e| e.to_string())?;
    Ok(out)
}

fn contracted(
    formula: &Formula,
    contraction: Contraction,
    points: &[Sample],
) -> Result<Vec<f64>, String> {
    let tier = Tier::from(Precision::Accurate);
    let module = EvalModule::new(formula, What::Value, tier).map_err(|e| format!("{e:?}"))?;
    let rows = Rows::contracted(&module, contraction).map_err(|e| e.to_string())?;
    let numbers: Vec<f64> = points
        .iter()
        .flat_map(|p| p.args.iter().map(|&x| f64::from(x)))
        .collect();
    let mut out = Vec::new();
    rows.eval(Surroundings::default(), points.len(), &numbers, &mut out)
        .map_err(|e| e.to_string())?;
    Ok(out)
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
