//! Series and iterations: their values against closed forms and plain loops, and what is written for them.

use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use pullback_compiler::formula::Formula;
use pullback_compiler::ir::{Op, parse_text, to_text, verify};
use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Evaluator, Program, Target, What, compile};
use pullback_grammar::render;
use pullback_tests::loops::{LOOPS, Looping};

fn program(text: &str) -> Program {
    let answer = compile(text);
    let shown = render(&answer.diagnostics, "loops.pull", text, false);
    answer.program.unwrap_or_else(|| panic!("{shown}"))
}

fn formula(text: &str) -> Formula {
    program(text).pictures()[0].formula.clone()
}

fn reference(formula: &Formula, params: &[f64], args: &[f64]) -> Vec<f64> {
    let mut evaluator = Evaluator::new(formula, What::Value).expect("a value");
    let mut out = vec![0.0; evaluator.outputs().len()];
    evaluator.eval(params, 0.0, 0.0, args, &mut out);
    out
}

/// What is wrong with values, if anything: relative to the greatest component, and NaN where NaN is wanted.
fn complaint(case: &Looping, args: &[f64], got: &[f64], tolerance: f64) -> Option<String> {
    let want = (case.want)(args, case.params);
    let size = want.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    let fits = |(got, want): (&f64, &f64)| {
        (got - want).abs() <= tolerance * size || (got.is_nan() && want.is_nan())
    };
    let agrees = want.len() == got.len() && got.iter().zip(&want).all(fits);
    (!agrees).then(|| format!("{} at {args:?}: {got:?}, not {want:?}", case.name))
}

#[test]
fn loops_have_their_values_in_double_precision() {
    let mut wrong = Vec::new();
    for case in LOOPS {
        let formula = formula(case.text);
        verify(&formula.graph).unwrap_or_else(|e| panic!("{}: {e:?}", case.name));
        for args in case.points {
            let got = reference(&formula, case.params, args);
            wrong.extend(complaint(case, args, &got, 1e-13));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[cfg(feature = "gpu")]
#[test]
fn loops_have_their_values_on_the_gpu() {
    use pullback_tests::accuracy::evaluators::{Machine, Point, suite_gpu};
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    let mut wrong = Vec::new();
    for case in LOOPS {
        let point = |args: &&[f64]| Point {
            args: args.to_vec(),
            params: case.params.to_vec(),
        };
        let points: Vec<Point> = case.points.iter().map(point).collect();
        match machine.run(&formula(case.text), What::Value, &points) {
            Ok(rows) => wrong.extend(
                rows.iter()
                    .zip(case.points)
                    .filter_map(|(got, args)| complaint(case, args, got, 2e-6)),
            ),
            Err(problem) => wrong.push(format!("{}: {problem}", case.name)),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// 100 · 0.29 is below 29 in double precision and 29 in single: both are within what the range states.
#[cfg(feature = "gpu")]
#[test]
fn a_count_at_its_maximum_is_not_beyond_it_by_rounding() {
    use pullback_tests::accuracy::evaluators::{Machine, Point, suite_gpu};
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    let formula = formula("param t = 0.1 in 0..0.29\nf(x, y) = sum(k in 1..100 t, x) + y");
    let point = |t: f64| Point {
        args: vec![1.0, 0.0],
        params: vec![t],
    };
    let rows = machine.run(&formula, What::Value, &[point(0.29), point(0.305)]);
    let rows = rows.expect("values");
    assert_eq!(rows[0], [29.0]);
    assert!(rows[1][0].is_nan());
    assert_eq!(reference(&formula, &[0.29], &[1.0, 0.0]), [28.0]);
}

fn loops_of(formula: &Formula) -> usize {
    let live = formula.graph.reachable(&formula.value);
    let nodes = formula.graph.nodes().iter().zip(live);
    nodes
        .filter(|(node, live)| *live && matches!(node.op, Op::Loop { .. }))
        .count()
}

#[test]
fn constant_loops_are_constants_within_a_budget() {
    for text in [
        "f(x, y) = x + sum(k in 1..1000, 1/k^2)",
        "f(x, y) = x + iterate(50, w = 0, w^2 + 0.1i).count",
        "f(x, y) = x + sum(j in 1..10, product(k in 1..j, k/(k + 1)))",
        "param n = 3 in 1..5\nf(x, y) = x^n + sum(k in 1..1000, 1/k^2)",
    ] {
        assert_eq!(loops_of(&formula(text)), 0, "{text}");
    }
    for text in [
        "f(x, y) = sum(k in 1..1000, x/k^2)",
        "f(x, y) = x + sum(k in 1..10, time)",
        "f(x, y) = x + sum(k in 1..10, pixel)",
        "param n = 3 in 1..5\nf(x, y) = x + sum(k in 1..n, 1/k^2)",
    ] {
        assert_eq!(loops_of(&formula(text)), 1, "{text}");
    }
    // a loop that depends on the one around it goes with that
    assert_eq!(
        loops_of(&formula("f(x, y) = sum(j in 1..10, x sum(k in 1..j, k))")),
        2
    );
    // thirty thousand steps each, with a few operations: some are computed, the others stay
    let terms: Vec<String> = (1..=30)
        .map(|k| format!("sum(k in 1..30000, sin({k} k))"))
        .collect();
    let many = formula(&format!("f(x, y) = x + {}", terms.join(" + ")));
    assert!((1..30).contains(&loops_of(&many)), "{}", loops_of(&many));
}

/// Where a number of steps is certain there is no test of it.
#[test]
fn counts_that_cannot_fail_are_not_tested() {
    let selects = |text: &str| {
        let formula = formula(text);
        let text = to_text(&formula.graph, &formula.value);
        text.matches("= select").count()
    };
    assert_eq!(selects("f(x, y) = sum(k in 1..10, x^k)"), 0);
    assert_eq!(selects("f(x, y) = sum(j in 1..10, k in 0..j, x^k)"), 0);
    assert_eq!(selects("f(x, y) = sum(j in 1..9, k in j..2 j, x^k)"), 0);
    assert_eq!(selects("f(x, y) = sum(k in floor(x)..floor(x) + 3, k)"), 0);
    assert_eq!(selects("f(x, y) = sum(k in 1..min(x, 10), k)"), 0);
    let param = "param n = 3 in 1..5\nf(x, y) = ";
    assert_eq!(selects(&format!("{param}sum(k in 1..n, x^k)")), 1);
    assert_eq!(
        selects(&format!("{param}sum(k in 1..clamp(n, 1, 5), x)")),
        0
    );
}

#[test]
fn products_of_maxima_are_limited_exactly() {
    let compiles = |text: &str| compile(text).program.is_some();
    assert!(compiles("f(x, y) = sum(j in 1..1000, k in 1..100, x)"));
    assert!(!compiles("f(x, y) = sum(j in 1..1000, k in 1..101, x)"));
    // a range is as long as it is, not as its ends suggest
    assert!(compiles("f(x, y) = sum(j in 1..1000, k in j..j + 99, x)"));
    assert!(!compiles("f(x, y) = sum(j in 1..1000, k in j..j + 100, x)"));
    // one after the other is not nested
    assert!(compiles(
        "f(x, y) = sum(j in 1..100000, x j) + sum(j in 1..100000, y j)"
    ));
    // a constant is computed outside of the loop that uses it
    assert!(compiles(
        "c = sum(k in 1..100000, time)\nf(x, y) = sum(j in 1..100000, c x^j)"
    ));
    let nested = |depth: usize| {
        let ranges: Vec<String> = (0..depth).map(|k| format!("k_{k} in 1..2")).collect();
        format!("f(x, y) = sum({}, x)", ranges.join(", "))
    };
    assert!(compiles(&nested(8)));
    assert!(!compiles(&nested(9)));
}

/// The names of states, counts and running variables are seen in what is written.
#[test]
fn an_iteration_reads_well() {
    let text = "param bound = 4 in 2..100
escape(c: complex) = r.count + log(|r.z|) / 64 + s.x where
    r = iterate(100, z = 0, slope = 1, (z^2 + c, 2 z slope + 1) until |z| > bound),
    s = sum(k in 1..bound, (k / 2, re(c) / k))
show domain(escape)";
    let written = program(text)
        .emit(0, EmitWhat::Value, Target::Wgsl, Precision::Fast)
        .expect("WGSL");
    let written = String::from_utf8(written).expect("text");
    let own = written.rfind("fn escape(").map(|at| &written[at..]);
    insta::assert_snapshot!(own.expect("the function"));
}

fn samples<S: Strategy>(count: usize, strategy: &S) -> Vec<S::Value> {
    let mut runner = TestRunner::new_with_rng(
        Config::default(),
        TestRng::deterministic_rng(RngAlgorithm::ChaCha),
    );
    let mut sample = || strategy.new_tree(&mut runner).expect("a loop").current();
    (0..count).map(|_| sample()).collect()
}

/// Expressions in x, y and two further names.
fn body(a: &'static str, b: &'static str) -> BoxedStrategy<String> {
    let leaf = prop_oneof![
        prop::sample::select(vec!["x", "y", a, a, b]).prop_map(str::to_owned),
        (-20_i32..20).prop_map(|k| format!("({:?})", f64::from(k) / 8.0)),
    ];
    leaf.prop_recursive(3, 8, 2, |inner| {
        let two = (inner.clone(), inner.clone());
        prop_oneof![
            two.clone().prop_map(|(a, b)| format!("({a} + {b})")),
            two.clone().prop_map(|(a, b)| format!("({a} - {b})")),
            two.clone().prop_map(|(a, b)| format!("({a}) ({b})")),
            two.clone().prop_map(|(a, b)| format!("({a})/(({b})² + 1)")),
            two.clone().prop_map(|(a, b)| format!("min({a}, {b})")),
            two.prop_map(|(a, b)| format!("(if {a} < {b} then {b} else -({a}))")),
            inner.clone().prop_map(|a| format!("sin({a})")),
            inner.clone().prop_map(|a| format!("floor({a})")),
            inner.prop_map(|a| format!("({a})^3")),
        ]
    })
    .boxed()
}

const POINTS: [[f64; 2]; 3] = [[0.37, -1.21], [1.9, 0.53], [-0.71, 2.29]];

/// A looped and an unrolled program are the same function, bit for bit; and the IR of the loop is well formed and
/// reads back from its text.
fn assert_same(looped: &str, unrolled: &str) {
    let (a, b) = (formula(looped), formula(unrolled));
    verify(&a.graph).unwrap_or_else(|e| panic!("{looped}: {e:?}"));
    let text = to_text(&a.graph, &a.value);
    let (graph, roots) = parse_text(&text).unwrap_or_else(|e| panic!("{looped}: {e:?}\n{text}"));
    verify(&graph).unwrap_or_else(|e| panic!("{looped}: {e:?}"));
    let again = Formula {
        graph,
        value: roots.into(),
        ..a.clone()
    };
    let nameless = |formula: &Formula| {
        let text = to_text(&formula.graph, &formula.value);
        let lines = text.lines().map(|l| l.split("  ;").next().unwrap_or(""));
        lines.collect::<Vec<_>>().join("\n")
    };
    assert_eq!(nameless(&again), nameless(&a), "{looped}");
    for point in POINTS {
        let [one, two, three] = [&a, &b, &again].map(|f| reference(f, &[], &point)[0]);
        let same = |a: f64, b: f64| a == b || (a.is_nan() && b.is_nan());
        assert!(
            same(one, two) && same(one, three),
            "{looped}\n{unrolled}\nat {point:?}: {one} {two} {three}\n{text}"
        );
    }
}

#[test]
fn iterations_are_their_steps_written_out() {
    let parts = (
        1_usize..5,
        [body("a", "b"), body("a", "b"), body("a", "b")],
        prop::option::of(body("b", "a")),
    );
    for (steps, [first, second, value], until) in samples(300, &parts) {
        let ends = until.as_ref().map(|e| format!(" until {e} < 0"));
        let looped = format!(
            "f(x, y) = ({value} where a = r.a, b = r.b) + r.count / 32
            where r = iterate({steps}, a = x, b = 1 + y, ({first}, {second}){})",
            ends.unwrap_or_default()
        );
        let ending = until.map_or("1 < 0".to_owned(), |e| format!("{e} < 0"));
        let mut locals = vec!["a0 = x, b0 = 1 + y, n0 = 0".to_owned()];
        for k in 0..steps {
            let next = k + 1;
            let states = format!("(a{k}, b{k}, x, y)");
            locals.push(format!(
                "go{k} = goes_on{states},
                a{next} = if go{k} == 1 then first{states} else a{k},
                b{next} = if go{k} == 1 then second{states} else b{k},
                n{next} = n{k} + go{k}"
            ));
        }
        let locals = locals.join(",\n");
        let unrolled = format!(
            "first(a, b, x, y) = {first}
            second(a, b, x, y) = {second}
            goes_on(a, b, x, y) = if {ending} then 0 else 1
            value(a, b, x, y) = {value}
            f(x, y) = value(a{steps}, b{steps}, x, y) + n{steps} / 32 where {locals}"
        );
        assert_same(&looped, &unrolled);
    }
}

#[test]
fn series_are_their_terms_written_out() {
    let parts = (
        prop::bool::ANY,
        -3_i32..3,
        0_i32..4,
        0_i32..3,
        body("j", "k"),
    );
    for (is_sum, from, more, inner, term) in samples(300, &parts) {
        let (kind, sign, neutral) = if is_sum {
            ("sum", "+", "0")
        } else {
            ("product", "*", "1")
        };
        let to = from + more - 1;
        let looped = format!("f(x, y) = {kind}(j in {from}..{to}, k in 0..{inner}, {term})");
        let mut total = neutral.to_owned();
        for j in from..=to {
            let mut row = neutral.to_owned();
            for k in 0..=inner {
                row = format!("({row} {sign} g({j}, {k}, x, y))");
            }
            total = format!("({total} {sign} {row})");
        }
        let unrolled = format!("g(j, k, x, y) = {term}\nf(x, y) = {total}");
        assert_same(&looped, &unrolled);
    }
}
