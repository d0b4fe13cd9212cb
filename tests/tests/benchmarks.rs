//! The benchmark expressions of FPBench and Herbie: their tables, the `f64` reference, and `accurate` with rewrites.

use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::benchmarks::data::{Benchmark, COLLECTIONS, collection};
use pullback_tests::benchmarks::measure::{Machine, Row, formula, measure, results};
use pullback_tests::benchmarks::report::{NOISE, summary, ways, worsened};
use pullback_tests::benchmarks::store::Store;

fn all() -> Vec<Benchmark> {
    COLLECTIONS
        .into_iter()
        .flat_map(|name| collection(name).unwrap_or_else(|e| panic!("{name}: {e}")).0)
        .collect()
}

#[test]
fn every_expression_is_listed_once_with_points_or_a_reason() {
    for (name, total) in [("fpbench", 136), ("herbie", 718)] {
        let (fits, unfit) = collection(name).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(fits.len() + unfit.len(), total, "{name}");
        assert!(fits.len() * 10 >= total * 9, "{name}: few fit");
        for benchmark in &fits {
            assert!(!benchmark.points.is_empty(), "{}", benchmark.id);
            assert!(benchmark.points.len() <= 64, "{}", benchmark.id);
            for point in &benchmark.points {
                let exact = point.exact;
                assert!(exact.hi.is_finite(), "{}", benchmark.id);
                let most = exact.hi.abs() * 2f64.powi(-52) + f64::from_bits(1);
                assert!(exact.lo.abs() <= most, "{}", benchmark.id);
            }
        }
        for other in &unfit {
            assert!(!other.reason.is_empty(), "{}", other.id);
        }
    }
}

/// Its exponentials of distances leave the range of `f64` at most of its points, which have no bounds.
const OVERFLOWS: [&str; 1] = ["herbie/graphics/fidget/bear/1"];

/// 29 bits separate `f64` from 24: what loses little there has a right `f32` here. This holds our translation, the exact
/// values and the reference evaluator against one another, and every expression compiles.
#[test]
fn the_reference_is_right_where_rounding_loses_little() {
    let mut wrong = Vec::new();
    for benchmark in &all() {
        let formula = formula(benchmark).unwrap_or_else(|e| panic!("{e}"));
        let points = &benchmark.points;
        assert_eq!(
            formula.columns().len(),
            points[0].args.len(),
            "{}",
            benchmark.id
        );
        let got = results(&formula, &Machine::Reference, Precision::Double, points)
            .unwrap_or_else(|e| panic!("{}: {e}", benchmark.id))
            .unwrap_or_default();
        if benchmark.plain > 2.0 || OVERFLOWS.contains(&benchmark.id.as_str()) {
            continue;
        }
        // some points overflow on their way, and at some rounding decides a comparison: not at most of them
        let lost = points.iter().zip(&got).filter(|(_, x)| x.is_finite());
        let median = summary(lost.map(|(p, &x)| p.exact.single_error(x))).median;
        if median > 1.0 {
            wrong.push(format!("{}: {median:.2} bits", benchmark.id));
        }
    }
    assert_eq!(wrong, [] as [String; 0]);
}

/// One expression in eight, and of those on which cancellation dominates one in two, so that it takes seconds.
fn subset(all: &[Benchmark]) -> Vec<&Benchmark> {
    let (cancelling, other): (Vec<_>, Vec<_>) = all.iter().partition(|b| b.cancels());
    let some = cancelling.into_iter().step_by(2);
    some.chain(other.into_iter().step_by(8)).collect()
}

#[test]
fn rewrites_halve_what_cancellation_loses_and_make_nothing_worse() {
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu));
    let all = all();
    let ways = ways(&[Precision::Accurate]);
    let rows: Vec<Row> = subset(&all)
        .into_iter()
        .map(|b| measure(b, &machine, &ways, &Store::default()).unwrap_or_else(|e| panic!("{e}")))
        .collect();
    let refused: Vec<&String> = rows.iter().flat_map(|r| &r.refused).collect();
    assert!(refused.is_empty(), "{refused:?}");
    let median = |rewrites| {
        let cancelling = rows.iter().filter(|r| r.benchmark.cancels());
        let lost = cancelling.filter_map(|r| Some(r.loss(Precision::Accurate, rewrites)?.single));
        summary(lost).median
    };
    let (before, after) = (median(false), median(true));
    println!("median of cancelling expressions: {before:.2} bits, {after:.2} with rewrites");
    assert!(before > 4.0, "{before}");
    assert!(after <= before / 2.0, "{before} to {after}");
    let worse: Vec<String> = worsened(&rows, Precision::Accurate, NOISE)
        .iter()
        .map(|(row, before, after)| format!("{}: {before:.2} to {after:.2}", row.benchmark.id))
        .collect();
    assert_eq!(worse, [] as [String; 0], "worse by more than {NOISE} bits");
}
