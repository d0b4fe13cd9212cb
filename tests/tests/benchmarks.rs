//! The benchmark expressions of FPBench and Herbie: their tables, the `f64` reference, and `accurate` with rewrites.

use pullback_compiler::formula::Formula;
use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::benchmarks::bits::Exact;
use pullback_tests::benchmarks::data::{Benchmark, COLLECTIONS, Sample, collection};
use pullback_tests::benchmarks::dense::{self, Paired};
use pullback_tests::benchmarks::measure::{Machine, Row, formula, measure, results};
use pullback_tests::benchmarks::report::{NOISE, summary, ways, worsened};
use pullback_tests::benchmarks::rewriting::with_rewrites;
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

/// Formulas that a rule once made worse, by 0.003 to 0.06 bits: products where nothing cancels, products as sides of a
/// length, a rounding that two parts of a formula share.
const ONCE_WORSE: [&str; 12] = [
    "fpbench/fptaylor-extra/8",
    "fpbench/fptaylor-tests/2",
    "fpbench/fptaylor-tests/7",
    "fpbench/rosa/6",
    "herbie/graphics/pbrt/1",
    "herbie/graphics/pbrt/25",
    "herbie/mathematics/sarnoff/14",
    "herbie/numerics/conte/2",
    "herbie/numerics/hamming-misc/3",
    "herbie/proj/tmerc/6",
    "herbie/proj/tmerc/11",
    "herbie/proj/tmerc/20",
];

/// Where cancellation dominates, rewrites gain bits; where it does not, they must lose none. Of the others one in three, so
/// that it takes a minute; all by `benchmarks --dense`.
#[test]
fn rewrites_lose_nothing_at_thousands_of_points() {
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu));
    let all = all();
    let is_named = |b: &&Benchmark| ONCE_WORSE.contains(&b.id.as_str());
    let short = |b: &&Benchmark| b.program.len() < 400 && !b.program.contains("iterate");
    let named = all.iter().filter(is_named);
    let others = all
        .iter()
        .filter(|b| !is_named(b) && !b.cancels() && short(b));
    let pairs: Vec<Paired> = named
        .chain(others.step_by(3))
        .filter_map(|b| dense::rewritten(b, &machine).unwrap_or_else(|e| panic!("{e}")))
        .collect();
    println!("{}", dense::table(&pairs));
    assert!(pairs.len() >= 30, "{}", pairs.len());
    let worse: Vec<&Paired> = pairs.iter().filter(|p| p.is_worse()).collect();
    assert!(worse.is_empty(), "{worse:?}");
}

/// A formula with the corners of its domain, as the collections have them.
fn planted(program: &str, domain: &[(f32, f32)]) -> Benchmark {
    let corner = |args: Vec<f32>| Sample {
        args,
        exact: Exact { hi: 0.0, lo: 0.0 },
    };
    let low = domain.iter().map(|column| column.0).collect();
    let high = domain.iter().map(|column| column.1).collect();
    let mut benchmark = Benchmark {
        id: program.to_owned(),
        name: String::new(),
        precondition: "-".to_owned(),
        program: program.to_owned(),
        drawn: 0,
        plain: 0.0,
        points: vec![corner(low), corner(high)],
    };
    let written = formula(&benchmark).unwrap_or_else(|e| panic!("{e}"));
    let points = &benchmark.points;
    let values = results(&written, &Machine::Reference, Precision::Double, points);
    let values = values.unwrap_or_else(|e| panic!("{e}")).unwrap_or_default();
    for (point, value) in benchmark.points.iter_mut().zip(values) {
        point.exact.hi = value;
    }
    benchmark
}

/// The measure sees a rule that is worse by a fraction of a bit, where both forms are good to the last digits.
#[test]
fn rules_that_round_more_are_caught() {
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu));
    let growth = "f(x: real) = 2 * sinh(0.5 * x) * exp(0.5 * x)";
    let cases = [
        (
            "f(x: real) = x^2 - 1",
            "f(x: real) = (x - 1) * (x + 1)",
            (0.001, 1000.0),
        ),
        ("f(x: real) = exp(x) - 1", growth, (2.0, 50.0)),
    ];
    for (written, rule, domain) in cases {
        let benchmark = planted(written, &[domain]);
        let before = formula(&benchmark).unwrap_or_else(|e| panic!("{e}"));
        let after = formula(&planted(rule, &[domain])).unwrap_or_else(|e| panic!("{e}"));
        let points = dense::points(&benchmark, &before).unwrap_or_else(|e| panic!("{e}"));
        let points = points.unwrap_or_else(|| panic!("{written}: no points"));
        let before = with_rewrites(&before, false);
        let compare = |after: &Formula| {
            let forms = [&before, after];
            let pair = dense::compare(written, forms, &machine, &points);
            pair.unwrap_or_else(|e| panic!("{e}")).expect("accurate")
        };
        let bad = compare(&with_rewrites(&after, false));
        println!("{bad:?}");
        assert!(bad.is_worse(), "{bad:?}");
        let own = compare(&with_rewrites(&before, true));
        println!("{own:?}");
        assert!(!own.is_worse(), "{own:?}");
    }
}
