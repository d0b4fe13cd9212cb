//! Rewrites judged at thousands of points: at 64, one that rounds to the neighbour cannot be told from a rule that is worse.
//!
//! Points are uniform among the float32 numbers of the box that the table's points span, the same in every run. The value
//! there is that of the `f64` evaluator, which computes the formula as it is written; only formulas count of which it gives
//! the right float32 at every point of the table, where the exact value is known to 110 bits.

use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash, Hasher};

use pullback_compiler::formula::Formula;
use pullback_compiler::lower::Precision;

use super::bits::Exact;
use super::data::{Benchmark, Sample};
use super::measure::{Machine, formula, results};
use super::rewriting;

/// Points of each formula.
pub const POINTS: usize = 4096;

/// A mean difference of so many of its standard errors is no chance: it would be one of 9,000 formulas that are equal.
pub const SIGMAS: f64 = 3.7;

/// Points that are shown of a formula that is worse, each with other results.
pub const EXAMPLES: usize = 8;

/// What `accurate` loses in two forms of a formula, at the same points.
#[derive(Clone, Debug)]
pub struct Paired {
    /// The formula.
    pub id: String,
    /// How many points.
    pub points: usize,
    /// Bits that the first form loses, a mean.
    pub before: f64,
    /// The mean of what the second loses more.
    pub more: f64,
    /// The standard error of that mean.
    pub error: f64,
    /// Where the second loses the most more, at most [`EXAMPLES`] points.
    pub examples: Vec<Example>,
}

/// A point at which the second form is worse.
#[derive(Clone, Debug)]
pub struct Example {
    /// The arguments.
    pub args: Vec<f32>,
    /// The right value.
    pub exact: f64,
    /// What the two forms give.
    pub got: [f64; 2],
}

impl Paired {
    /// Whether the second form is worse, beyond chance.
    #[must_use]
    pub fn is_worse(&self) -> bool {
        self.more > SIGMAS * self.error
    }

    /// Of the bits that each form loses, point by point.
    #[must_use]
    pub fn new(id: &str, before: &[f64], after: &[f64]) -> Self {
        let count = before.len().max(1) as f64;
        let differences = || before.iter().zip(after).map(|(b, a)| a - b);
        let more = differences().sum::<f64>() / count;
        let variance = differences().map(|d| (d - more).powi(2)).sum::<f64>() / count;
        Self {
            id: id.to_owned(),
            points: before.len(),
            before: before.iter().sum::<f64>() / count,
            more,
            error: (variance / count).sqrt(),
            examples: Vec::new(),
        }
    }
}

/// A formula as it is written against its rewritten form, in `accurate`. `None` where nothing is rewritten, or `f64` does
/// not give the right values.
///
/// # Errors
/// It does not compile, or the device refuses it; in words.
pub fn rewritten(benchmark: &Benchmark, machine: &Machine) -> Result<Option<Paired>, String> {
    let written = formula(benchmark)?;
    if rewriting::count(&written) == 0 {
        return Ok(None);
    }
    let Some(points) = points(benchmark, &written)? else {
        return Ok(None);
    };
    let after = rewriting::with_rewrites(&written, true);
    let before = rewriting::with_rewrites(&written, false);
    compare(&benchmark.id, [&before, &after], machine, &points)
}

/// Two forms of a formula at some points.
///
/// # Errors
/// The device refuses one; in words.
pub fn compare(
    id: &str,
    forms: [&Formula; 2],
    machine: &Machine,
    points: &[Sample],
) -> Result<Option<Paired>, String> {
    let of = |form| results(form, machine, Precision::Accurate, points);
    let (Some(before), Some(after)) = (of(forms[0])?, of(forms[1])?) else {
        return Ok(None);
    };
    let lost = [&before, &after].map(|got| {
        let bits = points.iter().zip(got);
        bits.map(|(p, &x)| p.exact.single_error(x))
            .collect::<Vec<_>>()
    });
    let mut pair = Paired::new(id, &lost[0], &lost[1]);
    if pair.is_worse() {
        pair.examples = examples(points, [&before, &after], &lost);
    }
    Ok(Some(pair))
}

/// The points at which the second form loses the most more.
fn examples(points: &[Sample], got: [&[f64]; 2], lost: &[Vec<f64>; 2]) -> Vec<Example> {
    let more = |k: usize| lost[1][k] - lost[0][k];
    let mut order: Vec<usize> = (0..points.len()).filter(|&k| more(k) > 0.0).collect();
    order.sort_by(|&a, &b| more(b).total_cmp(&more(a)));
    let at = |k: usize| Example {
        args: points[k].args.clone(),
        exact: points[k].exact.hi,
        got: got.map(|of| of[k]),
    };
    let mut seen = HashSet::new();
    order.retain(|&k| seen.insert(got.map(|of| of[k].to_bits())));
    order.into_iter().take(EXAMPLES).map(at).collect()
}

/// Points with their values, or `None` where `f64` does not give the right ones.
///
/// # Errors
/// The formula has no value in `f64`; in words.
pub fn points(benchmark: &Benchmark, written: &Formula) -> Result<Option<Vec<Sample>>, String> {
    let table = &benchmark.points;
    let known = reference(written, table)?;
    let right = |(p, &x): (&Sample, &f64)| p.exact.single_error(x) == 0.0;
    if !table.iter().zip(&known).all(right) {
        return Ok(None);
    }
    let mut drawn = drawn(benchmark);
    let values = reference(written, &drawn)?;
    for (point, value) in drawn.iter_mut().zip(values) {
        point.exact.hi = value;
    }
    drawn.retain(|p| p.exact.hi.abs() <= f64::from(f32::MAX));
    Ok((drawn.len() >= POINTS / 8).then_some(drawn))
}

fn reference(formula: &Formula, points: &[Sample]) -> Result<Vec<f64>, String> {
    Ok(results(formula, &Machine::Reference, Precision::Double, points)?.unwrap_or_default())
}

/// Points without values.
fn drawn(benchmark: &Benchmark) -> Vec<Sample> {
    let columns = benchmark.points.first().map_or(0, |p| p.args.len());
    let column = |k: usize| benchmark.points.iter().map(move |p| place(p.args[k]));
    let boxes: Vec<(i64, i64)> = (0..columns)
        .filter_map(|k| Some((column(k).min()?, column(k).max()?)))
        .collect();
    let mut digest = DefaultHasher::new();
    benchmark.id.hash(&mut digest);
    let mut state = digest.finish();
    let mut argument = |&(low, high): &(i64, i64)| {
        let span = (high - low + 1).unsigned_abs();
        number(low + (next(&mut state) % span) as i64)
    };
    let mut sample = || Sample {
        args: boxes.iter().map(&mut argument).collect(),
        exact: Exact { hi: 0.0, lo: 0.0 },
    };
    (0..POINTS).map(|_| sample()).collect()
}

/// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
fn next(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The place of a number among all `f32`, counted from zero.
fn place(x: f32) -> i64 {
    let size = i64::from(x.to_bits() & 0x7fff_ffff);
    if x.is_sign_negative() { -size } else { size }
}

/// The number at a place.
fn number(place: i64) -> f32 {
    let size = f32::from_bits(place.unsigned_abs() as u32);
    if place < 0 { -size } else { size }
}

/// All pairs as a table, those that are worst first.
#[must_use]
pub fn table(pairs: &[Paired]) -> String {
    let mut sorted: Vec<&Paired> = pairs.iter().collect();
    sorted.sort_by(|a, b| b.more.total_cmp(&a.more));
    let mut out = String::from("# id\tpoints\tbits before\tmore after\tstandard error\tverdict\n");
    for pair in &sorted {
        let verdict = if pair.is_worse() { "worse" } else { "-" };
        out += &format!(
            "{}\t{}\t{:.4}\t{:.4}\t{:.4}\t{verdict}\n",
            pair.id, pair.points, pair.before, pair.more, pair.error
        );
        for Example { args, exact, got } in &pair.examples {
            let [before, after] = got;
            out += &format!("#   at {args:?}: {exact:e}, before {before:e}, after {after:e}\n");
        }
    }
    let worse = pairs.iter().filter(|p| p.is_worse()).count();
    let above = pairs.iter().filter(|p| p.more > 0.0).count();
    out + &format!(
        "# {} formulas, {worse} worse, {above} with a mean above 0\n",
        pairs.len()
    )
}
