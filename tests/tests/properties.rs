//! Random formulas: what every pass must keep. Deterministic: the same formulas in every run.

mod support;

use proptest::prelude::*;
use pullback_compiler::derive::{forward, reverse};
use pullback_compiler::eval::{Leaves, Tape};
use pullback_compiler::formula::Formula;
use pullback_compiler::ir::{Graph, Id, NO_CALLS, Ty, expand_powers, parse_text, to_text, verify};
use pullback_compiler::lower::Precision;
use pullback_compiler::table::Number;
use pullback_compiler::{EmitWhat, Program, Target, What, compile};
use pullback_tests::holds;
use support::formulas::{any_real, holomorphic, samples, smooth};

/// Points at which formulas are compared.
const POINTS: [[f64; 2]; 4] = [[0.37, -1.21], [1.9, 0.53], [-0.71, -0.29], [-2.3, 1.7]];

fn program(text: &str) -> Program {
    let answer = compile(text);
    holds::compilation(text, &answer).unwrap_or_else(|e| panic!("{text}: {e}"));
    answer
        .program
        .unwrap_or_else(|| panic!("{text}: {:?}", answer.diagnostics))
}

fn formula(text: &str) -> Formula {
    program(text).pictures()[0].formula.clone()
}

fn values(graph: &Graph, roots: &[Id], point: [f64; 2]) -> Vec<Number> {
    let inputs = point.map(Number::Real);
    let leaves = Leaves {
        inputs: &inputs,
        params: &[],
        time: 0.0,
        pixel: 0.01,
    };
    let mut out = Vec::new();
    Tape::new(graph, roots).run(&leaves, |value| out.push(value));
    out
}

fn reals(graph: &Graph, roots: &[Id], point: [f64; 2]) -> Vec<f64> {
    let real = |n: Number| match n {
        Number::Real(x) => x,
        other => panic!("{other:?} is no real"),
    };
    values(graph, roots, point).into_iter().map(real).collect()
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

#[test]
fn graphs_are_well_formed_and_their_text_reads_back() {
    for body in samples(400, &prop_oneof![smooth(), any_real()]) {
        let formula = formula(&format!("f(x, y) = {body}"));
        verify(&formula.graph).unwrap_or_else(|e| panic!("{body}: {e:?}"));
        let text = to_text(&formula.graph, &formula.value);
        let (graph, roots) = parse_text(&text).unwrap_or_else(|e| panic!("{body}: {e:?}\n{text}"));
        verify(&graph).unwrap_or_else(|e| panic!("{body}: {e:?}"));
        // names are not read back
        let nameless = |text: &str| {
            text.lines()
                .map(|l| l.split("  ;").next().unwrap_or("").to_owned())
                .collect::<Vec<_>>()
        };
        assert_eq!(
            nameless(&to_text(&graph, &roots)),
            nameless(&text),
            "{body}"
        );
    }
}

#[test]
fn compaction_keeps_values_and_powers_expand_to_products() {
    for body in samples(300, &any_real()) {
        let formula = formula(&format!("f(x, y) = {body}"));
        let (compact, roots) = formula.graph.compacted(&formula.value);
        let (expanded, products) = expand_powers(&formula.graph, &formula.value, &NO_CALLS);
        verify(&expanded).unwrap_or_else(|e| panic!("{body}: {e:?}"));
        for point in POINTS {
            let before = reals(&formula.graph, &formula.value, point)[0];
            assert!(
                same(before, reals(&compact, &roots, point)[0]),
                "{body} at {point:?}"
            );
        }
        // a product is rounded more often than a power; a choice may then fall the other way, so only smooth
        // formulas are compared below
        let _ = products;
    }
    for body in samples(300, &smooth()) {
        let formula = formula(&format!("f(x, y) = {body}"));
        let (expanded, products) = expand_powers(&formula.graph, &formula.value, &NO_CALLS);
        for point in POINTS {
            let before = reals(&formula.graph, &formula.value, point)[0];
            let after = reals(&expanded, &products, point)[0];
            let sensitivity = sensitivity(&formula.graph, &formula.value, point);
            if sensitivity < 1e6 {
                let close =
                    (before - after).abs() <= 1e-13 * (sensitivity + 1.0) * before.abs().max(1.0);
                assert!(
                    close || same(before, after),
                    "{body} at {point:?}: {before} {after}"
                );
            }
        }
    }
}

/// About how much relative errors of the coordinates are magnified: where it is large, rounding decides.
fn sensitivity(graph: &Graph, roots: &[Id], point: [f64; 2]) -> f64 {
    let at = |k: usize, step: f64| {
        let mut moved = point;
        moved[k] *= 1.0 + step;
        reals(graph, roots, moved)[0]
    };
    let here = reals(graph, roots, point)[0];
    let mut worst: f64 = 0.0;
    for k in 0..2 {
        for step in [1e-9, -1e-9] {
            let change = ((at(k, step) - here) / 1e-9).abs() / here.abs().max(1.0);
            worst = worst.max(if change.is_nan() {
                f64::INFINITY
            } else {
                change
            });
        }
    }
    worst
}

/// Whether two derivatives agree, relative to their size and that of the value.
fn close(a: f64, b: f64, value: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * (1.0 + a.abs() + b.abs() + value.abs()) || same(a, b)
}

#[test]
fn forward_and_reverse_mode_agree() {
    let mut compared = 0;
    for body in samples(400, &prop_oneof![smooth(), any_real()]) {
        let formula = formula(&format!("f(x, y) = {body}"));
        let (mut graph, roots) = formula.graph.compacted(&formula.value);
        let leaves = [0, 1].map(|k| Formula::leaf(&mut graph, k, Ty::Real));
        let one = graph.real(1.0);
        let zero = graph.real(0.0);
        let along: Vec<Id> = leaves
            .iter()
            .map(|&leaf| {
                forward(&mut graph, &roots, &[(leaf, one)]).expect("a derivative")[0]
                    .unwrap_or(zero)
            })
            .collect();
        let Some(back) = reverse(&mut graph, roots[0], &leaves).expect("a derivative") else {
            continue;
        };
        verify(&graph).unwrap_or_else(|e| panic!("{body}: {e:?}"));
        for point in POINTS {
            let value = reals(&graph, &roots, point)[0];
            if !value.is_finite() || value.abs() > 1e12 {
                continue;
            }
            for (k, (&f, r)) in along.iter().zip(back.clone()).enumerate() {
                let f = reals(&graph, &[f], point)[0];
                let r = reals(&graph, &[r.unwrap_or(zero)], point)[0];
                if f.abs() < 1e12 {
                    assert!(
                        close(f, r, value, 1e-9),
                        "{body} at {point:?}, by {k}: {f} {r}"
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 1000, "only {compared} comparisons");
}

/// The derivative of a function of one real at 0 by central differences, extrapolated to step 0, with an estimate of
/// its error (C. Ridders, Adv. Eng. Softw. 4, 1982). An independent check, in `f64`; nothing that is shipped does so.
fn ridders(f: &mut dyn FnMut(f64) -> f64) -> (f64, f64) {
    const STEPS: usize = 9;
    let mut table = [[0.0_f64; STEPS]; STEPS];
    let (mut best, mut error) = (f64::NAN, f64::INFINITY);
    let mut step = 0.04;
    for i in 0..STEPS {
        table[0][i] = (f(step) - f(-step)) / (2.0 * step);
        let mut factor = 1.96;
        for j in 1..=i {
            table[j][i] = (table[j - 1][i] * factor - table[j - 1][i - 1]) / (factor - 1.0);
            factor *= 1.96;
            let change = (table[j][i] - table[j - 1][i])
                .abs()
                .max((table[j][i] - table[j - 1][i - 1]).abs());
            if change <= error {
                (best, error) = (table[j][i], change);
            }
        }
        step /= 1.4;
    }
    (best, error)
}

#[test]
fn gradients_are_those_of_the_value() {
    let (mut compared, mut skipped) = (0, 0);
    for body in samples(300, &smooth()) {
        let text = format!("f(x, y) = {body}");
        let mut evaluator = program(&text)
            .evaluator(0, What::Gradient)
            .expect("a gradient");
        let mut eval = |point: [f64; 2]| {
            let mut out = [0.0; 3];
            evaluator.eval(&[], 0.0, 0.01, &point, &mut out);
            out
        };
        for point in POINTS {
            let exact = eval(point);
            for k in 0..2 {
                let (slope, error) = ridders(&mut |step| {
                    let mut moved = point;
                    moved[k] += step;
                    eval(moved)[0]
                });
                let scale = 1.0 + exact[0].abs() + exact[k + 1].abs();
                if !exact[0].is_finite() || error.is_nan() || error > 1e-4 * scale {
                    skipped += 1;
                    continue;
                }
                compared += 1;
                let distance = (exact[k + 1] - slope).abs();
                assert!(
                    distance <= 10.0 * error + 1e-9 * scale,
                    "{text} at {point:?}, by {k}: {} and {slope} ± {error}",
                    exact[k + 1]
                );
            }
        }
    }
    assert!(
        compared > 2 * skipped,
        "{compared} compared, {skipped} skipped"
    );
}

#[test]
fn complex_derivatives_are_those_of_the_value() {
    let (mut compared, mut skipped) = (0, 0);
    for body in samples(250, &holomorphic()) {
        if !body.contains('z') {
            // a constant
            continue;
        }
        let text = format!("f(z) = {body}");
        let mut evaluator = program(&text)
            .evaluator(0, What::Derivative)
            .expect("a derivative");
        let columns = evaluator.outputs().len();
        assert_eq!(
            columns,
            4,
            "{text} is holomorphic: {:?}",
            evaluator.outputs()
        );
        let mut eval = |point: [f64; 2]| {
            let mut out = [0.0; 4];
            evaluator.eval(&[], 0.0, 0.01, &point, &mut out);
            out
        };
        for point in POINTS {
            let [re, im, d_re, d_im] = eval(point);
            let scale = 1.0 + re.abs() + im.abs() + d_re.abs() + d_im.abs();
            // f' = ∂f/∂x, and ∂f/∂y = i f' (Cauchy and Riemann)
            for (axis, part, exact) in [(0, 0, d_re), (0, 1, d_im), (1, 0, -d_im), (1, 1, d_re)] {
                let (slope, error) = ridders(&mut |step| {
                    let mut moved = point;
                    moved[axis] += step;
                    eval(moved)[part]
                });
                if !scale.is_finite() || error.is_nan() || error > 1e-4 * scale {
                    skipped += 1;
                    continue;
                }
                compared += 1;
                assert!(
                    (exact - slope).abs() <= 10.0 * error + 1e-9 * scale,
                    "{text} at {point:?}, part {part} along {axis}: {exact} and {slope} ± {error}"
                );
            }
        }
    }
    assert!(
        compared > 2 * skipped,
        "{compared} compared, {skipped} skipped"
    );
}

#[test]
fn wirtinger_pairs_are_those_of_the_value() {
    let (mut compared, mut skipped) = (0, 0);
    let mixed = (holomorphic(), holomorphic()).prop_flat_map(|(a, b)| {
        prop::sample::select(vec![
            format!("conj({a}) + ({b})"),
            format!("({a}) re({b})"),
            format!("im({a}) + i re({b})"),
            format!("({a}) abs(7 + ({b})^2)"),
            format!("conj(({a}) conj({b}))"),
        ])
    });
    for body in samples(150, &mixed) {
        let text = format!("f(z) = {body}");
        let mut evaluator = program(&text)
            .evaluator(0, What::Derivative)
            .expect("a derivative");
        if evaluator.outputs().len() != 6 {
            // folded to a holomorphic one
            continue;
        }
        let mut eval = |point: [f64; 2]| {
            let mut out = [0.0; 6];
            evaluator.eval(&[], 0.0, 0.01, &point, &mut out);
            out
        };
        for point in POINTS {
            let [re, im, a, b, c, d] = eval(point);
            let scale = 1.0 + [re, im, a, b, c, d].iter().map(|x| x.abs()).sum::<f64>();
            // ∂f/∂x = ∂f + ∂̄f, ∂f/∂y = i (∂f - ∂̄f)
            for (axis, part, exact) in [(0, 0, a + c), (0, 1, b + d), (1, 0, d - b), (1, 1, a - c)]
            {
                let (slope, error) = ridders(&mut |step| {
                    let mut moved = point;
                    moved[axis] += step;
                    eval(moved)[part]
                });
                if !scale.is_finite() || error.is_nan() || error > 1e-4 * scale {
                    skipped += 1;
                    continue;
                }
                compared += 1;
                assert!(
                    (exact - slope).abs() <= 10.0 * error + 1e-9 * scale,
                    "{text} at {point:?}, part {part} along {axis}: {exact} and {slope} ± {error}"
                );
            }
        }
    }
    assert!(
        compared > 2 * skipped && compared > 300,
        "{compared} compared, {skipped} skipped"
    );
}

#[test]
fn random_formulas_become_valid_modules() {
    for (k, body) in samples(60, &any_real()).into_iter().enumerate() {
        let program = program(&format!("f(x, y) = {body}"));
        program
            .scene_module(0, Precision::Accurate)
            .unwrap_or_else(|e| panic!("{body}: {e:?}"));
        let target = Target::ALL[k % Target::ALL.len()];
        for what in [EmitWhat::Value, EmitWhat::Gradient] {
            program
                .emit(0, what, target, Precision::Accurate)
                .unwrap_or_else(|e| panic!("{body}: {e:?}"));
        }
    }
}

/// No program without an error, no error without a reason: random texts made of pieces of programs.
#[test]
fn no_program_without_an_error() {
    use pullback_tests::corpus::all_programs;
    use pullback_tests::mutate::{Random, mutated};
    let corpus = all_programs();
    let mut random = Random::new(7);
    for k in 0..3000 {
        let bytes = mutated(&corpus, &mut random);
        let check = |result: Result<(), String>| {
            result.unwrap_or_else(|e| panic!("{e}\n---\n{}", String::from_utf8_lossy(&bytes)));
        };
        check(holds::parsing(&bytes));
        check(holds::compiling(&bytes, k % 100 == 0));
    }
}
