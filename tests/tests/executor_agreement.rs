//! The executor against evaluators that share nothing with it: the IR's, tables of 60 digits, and native arithmetic.

mod support;

use pullback_compiler::formula::Formula;
use pullback_compiler::ir::{Graph, Id, Op, SINGLE_CALLS, expand_powers, merge_loops};
use pullback_compiler::lower::Precision;
use pullback_compiler::module::stable_evaluation;
use pullback_compiler::reference::complex::complex;
use pullback_compiler::stable::Rewrites;
use pullback_compiler::table::{Number, row};
use pullback_compiler::{What, compile};
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::{Machine, Point};
use pullback_tests::accuracy::formulas::{MOST, Table, gallery, library};
use support::formulas::{any_real, holomorphic, samples, smooth};

/// Every table within the factor that is allowed to every evaluator.
fn check(tables: &[Table], machine: &Machine) {
    for table in tables {
        let factors = table
            .measure(machine)
            .unwrap_or_else(|reason| panic!("{}: {reason}", table.name));
        let most = factors.value.max(factors.derivative);
        assert!(
            most <= MOST,
            "{}: K = {most}: {}",
            table.name,
            factors.worst
        );
        assert!(
            factors.wrong.is_empty(),
            "{}: {:?}",
            table.name,
            factors.wrong
        );
        assert!(factors.rows >= 20, "{}: {} rows", table.name, factors.rows);
    }
}

#[test]
fn gallery_in_f64_against_60_digits() {
    let machine = Machine::Processor(Arithmetic::Reference, Precision::Double);
    check(&gallery(), &machine);
    check(&library(), &machine);
}

#[test]
fn gallery_in_binary32_against_60_digits() {
    check(
        &gallery(),
        &Machine::Processor(Arithmetic::Ieee32, Precision::Accurate),
    );
}

#[test]
fn gallery_in_pairs_and_doubles_as_written_against_60_digits() {
    for precision in [Precision::Extended, Precision::Double] {
        check(
            &gallery(),
            &Machine::Processor(Arithmetic::Ieee32, precision),
        );
    }
}

/// Evaluates what roots depend on, an operation after the other, and `change`s each result. No loops.
fn evaluate(
    graph: &Graph,
    roots: &[Id],
    inputs: &[Number],
    mut change: impl FnMut(f64) -> f64,
) -> Vec<f64> {
    let mut values: Vec<Number> = Vec::with_capacity(graph.nodes().len());
    for node in graph.nodes() {
        let value = match node.op {
            Op::Const(bits) => Number::Real(f64::from_bits(bits)),
            Op::Truth(truth) => Number::Truth(truth),
            Op::Input(k) => inputs[usize::from(k)],
            Op::Apply(prim) => {
                let operands: Vec<Number> = node.args.iter().map(|a| values[a.index()]).collect();
                row(prim)
                    .evaluate(prim, &operands)
                    .unwrap_or(Number::Real(f64::NAN))
            }
            _ => Number::Real(f64::NAN),
        };
        values.push(match value {
            Number::Real(x) => Number::Real(change(x)),
            Number::Complex(z) => Number::Complex(complex(change(z.re), change(z.im))),
            truth => truth,
        });
    }
    let parts = |root: &Id| match values[root.index()] {
        Number::Real(x) => vec![x],
        Number::Complex(z) => vec![z.re, z.im],
        Number::Truth(truth) => vec![f64::from(u8::from(truth))],
    };
    roots.iter().flat_map(parts).collect()
}

/// The formula of a text, as it is lowered, without rewrites.
fn plain(text: &str) -> Formula {
    let answer = compile(text);
    let program = answer
        .program
        .unwrap_or_else(|| panic!("{text}: {:?}", answer.diagnostics));
    program.with_rewrites(Rewrites::OFF).pictures()[0]
        .formula
        .clone()
}

/// Numbers that a formula is evaluated at.
const POINTS: [[f64; 2]; 5] = [
    [0.37, -1.21],
    [1.9, 0.53],
    [-0.71, -0.29],
    [-2.3, 1.7],
    [0.0, -0.0],
];

/// Runs `check` on formulas, on all cores.
fn on_all_cores(texts: &[String], check: impl Fn(&str) + Sync) {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let size = texts.len().div_ceil(cores).max(1);
    std::thread::scope(|scope| {
        for part in texts.chunks(size) {
            scope.spawn(|| part.iter().for_each(|text| check(text)));
        }
    });
}

/// Results of the executor in `f64`, and the graph that was lowered.
fn executed(formula: &Formula) -> (Graph, Vec<Id>, Vec<Vec<f64>>) {
    let machine = Machine::Processor(Arithmetic::Reference, Precision::Double);
    let points = POINTS.map(|point| Point {
        args: point.to_vec(),
        params: Vec::new(),
    });
    let found = machine.run(formula, What::Value, &points).expect("it runs");
    let lowered = stable_evaluation(formula, What::Value).expect("it is lowered");
    let (graph, roots) = merge_loops(&lowered.graph, &lowered.roots);
    let (graph, roots) = expand_powers(&graph, &roots, &SINGLE_CALLS);
    (graph.as_ref().clone(), roots, found)
}

fn same(a: f64, b: f64) -> bool {
    a == b || a.is_nan() && b.is_nan()
}

#[test]
fn generated_real_programs_in_f64_to_the_last_bit() {
    let mut texts: Vec<String> = samples(4500, &smooth());
    texts.extend(samples(4000, &any_real()));
    on_all_cores(&texts, |body| {
        let formula = plain(&format!("f(x, y) = {body}"));
        let (graph, roots, found) = executed(&formula);
        for (point, found) in POINTS.iter().zip(found) {
            let expected = evaluate(&graph, &roots, &point.map(Number::Real), |x| x);
            let all = expected.iter().zip(&found).all(|(a, b)| same(*a, *b));
            assert!(all, "{body} at {point:?}: {found:?}, not {expected:?}");
        }
    });
}

/// Lowering squares, inverts and scales complex numbers where the IR multiplies and divides: a few roundings more. The
/// scale of an error is what results move by if each operation's result moves by a rounding, one way or the other.
#[test]
fn generated_complex_programs_in_f64_to_a_few_roundings() {
    const TRIALS: u64 = 12;
    let texts = samples(1500, &holomorphic());
    on_all_cores(&texts, |body| {
        let formula = plain(&format!("f(z) = {body}"));
        let (graph, roots, found) = executed(&formula);
        for (point, found) in POINTS.iter().zip(found) {
            let z = [Number::Complex(complex(point[0], point[1]))];
            let expected = evaluate(&graph, &roots, &z, |x| x);
            let mut scale = 0.0f64;
            for seed in 0..TRIALS {
                let mut random = pullback_tests::mutate::Random::new(seed);
                let moved = evaluate(&graph, &roots, &z, |x| {
                    let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
                    x * (1.0 + sign * f64::EPSILON)
                });
                let moves = moved.iter().zip(&expected).map(|(a, b)| (a - b).abs());
                scale = moves.filter(|m| m.is_finite()).fold(scale, f64::max);
            }
            for (a, b) in expected.iter().zip(&found) {
                let near = (a - b).abs() <= MOST * scale;
                assert!(
                    same(*a, *b) || near,
                    "{body} at {point:?}: {found:?}, not {expected:?} ± {scale:e}"
                );
            }
        }
    });
}
