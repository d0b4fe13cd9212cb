//! Identities that hold whatever the reference says: symmetries bit for bit, inverse functions, limits. Tolerances are
//! made of declared bounds. Random points are the same in every run.

use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use pullback_compiler::What;
use pullback_compiler::lower::{Format, Precision};
use pullback_tests::accuracy::bounds::declared;
use pullback_tests::accuracy::error::Judge;
use pullback_tests::accuracy::evaluators::{Machine, Point, suite_gpu};
use pullback_tests::accuracy::subjects::{formula, subjects};
use pullback_tests::accuracy::tables::Domain;

/// Every machine that the identities are asked of. Further tiers are further entries.
fn machines() -> Vec<Machine> {
    let mut machines = vec![Machine::Reference];
    if let Some(gpu) = suite_gpu() {
        for tier in [Precision::Accurate, Precision::Extended, Precision::Double] {
            machines.push(Machine::Gpu(Box::new(gpu.clone()), tier));
        }
    }
    machines
}

/// What a machine is called in a message.
fn label(machine: &Machine) -> String {
    match machine {
        Machine::Reference => "f64 reference".to_owned(),
        Machine::Gpu(gpu, tier) => format!("{} ({})", gpu.adapter().name, tier.name()),
    }
}

/// float32 numbers of every size within 2^±exponent, of either sign, and both zeros.
fn numbers(count: usize, exponent: f64) -> Vec<f64> {
    let sign = prop::sample::select(vec![1.0, -1.0]);
    let size = prop_oneof![1 => Just(0.0), 20 => (-exponent..exponent).prop_map(f64::exp2)];
    let one = (sign, size).prop_map(|(sign, size): (f64, f64)| f64::from((sign * size) as f32));
    let mut runner = TestRunner::new_with_rng(
        Config::default(),
        TestRng::deterministic_rng(RngAlgorithm::ChaCha),
    );
    (0..count)
        .map(|_| one.new_tree(&mut runner).expect("a number").current())
        .collect()
}

fn run(machine: &Machine, source: &str, what: What, args: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let points: Vec<Point> = args
        .iter()
        .map(|args| Point {
            args: args.clone(),
            params: Vec::new(),
        })
        .collect();
    machine.run(&formula(source), what, &points).expect(source)
}

/// The declared bound of a real function, in units in the last place.
fn bound(word: &str, machine: &Machine) -> f64 {
    let all = subjects();
    let subject = all
        .iter()
        .find(|s| s.word == word && s.domain == Domain::Real)
        .expect(word);
    declared(subject, machine)
        .expect(word)
        .value
        .expect(word)
        .units
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// Whether two numbers are the same; complex numbers of pairs within the bound that is declared for all their functions,
/// because a product of pairs is not the same in both orders of its factors.
fn alike(a: f64, b: f64, machine: &Machine, complex: bool) -> bool {
    let last = complex && machine.format() == Format::Pair;
    same(a, b) || last && (a - b).abs() <= 2f64.powi(-42) * a.abs()
}

/// Holds f(turn(z)) = turned f(z) bit for bit, signs of zeros too, for every function.
fn symmetric(functions: &[&str], domain: &str, turn: &[f64], turned: &[f64]) {
    let flat = numbers(600 * turn.len(), 20.0);
    let points: Vec<Vec<f64>> = flat.chunks(turn.len()).map(<[f64]>::to_vec).collect();
    let images: Vec<Vec<f64>> = points
        .iter()
        .map(|p| p.iter().zip(turn).map(|(x, s)| x * s).collect())
        .collect();
    let mut wrong = Vec::new();
    for machine in &machines() {
        for name in functions {
            let source = format!("f({domain}) = {name}({})\n", &domain[..1]);
            let here = run(machine, &source, What::Value, &points);
            let there = run(machine, &source, What::Value, &images);
            for ((point, a), b) in points.iter().zip(&here).zip(&there) {
                let equal = a
                    .iter()
                    .zip(turned)
                    .zip(b)
                    .all(|((a, s), b)| alike(a * s, *b, machine, turn.len() == 2));
                if !equal {
                    wrong.push(format!(
                        "{}: {name} at {point:?}: {a:?}, {b:?}",
                        label(machine)
                    ));
                    break;
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn odd_functions_are_odd_bit_for_bit() {
    let odd = [
        "sin", "tan", "asin", "atan", "sinh", "tanh", "asinh", "atanh", "cbrt", "csc", "csch",
        "round", "trunc",
    ];
    symmetric(&odd, "x: real", &[-1.0], &[-1.0]);
}

#[test]
fn even_functions_are_even_bit_for_bit() {
    symmetric(
        &["cos", "cosh", "sinc", "sec", "sech", "abs"],
        "x: real",
        &[-1.0],
        &[1.0],
    );
}

#[test]
fn complex_odd_functions_are_odd_bit_for_bit() {
    let odd = [
        "sin", "tan", "sinh", "tanh", "asin", "atan", "asinh", "atanh",
    ];
    symmetric(&odd, "z: complex", &[-1.0, -1.0], &[-1.0, -1.0]);
}

#[test]
fn conjugates_have_conjugate_values_bit_for_bit() {
    let real_on_the_axis = [
        "exp", "log", "sqrt", "sin", "cos", "tan", "sinh", "cosh", "tanh", "asin", "acos", "atan",
        "asinh", "acosh", "atanh",
    ];
    symmetric(&real_on_the_axis, "z: complex", &[1.0, -1.0], &[1.0, -1.0]);
}

#[test]
fn sine_and_cosine_are_on_the_unit_circle() {
    let points: Vec<Vec<f64>> = numbers(2000, 100.0).into_iter().map(|x| vec![x]).collect();
    for machine in &machines() {
        let ulp = |v: f64| machine.format().unit(v);
        let (of_sin, of_cos) = (bound("sin", machine), bound("cos", machine));
        let rows = run(
            machine,
            "f(x: real) = complex(sin(x), cos(x))\n",
            What::Value,
            &points,
        );
        for (point, row) in points.iter().zip(&rows) {
            let (s, c) = (row[0], row[1]);
            // first order, and the three roundings of the test itself
            let allowed =
                2.0 * (of_sin * s.abs() * ulp(s) + of_cos * c.abs() * ulp(c)) * (1.0 + 1e-6)
                    + 3.0 * f64::EPSILON;
            let error = (s * s + c * c - 1.0).abs();
            assert!(
                error <= allowed,
                "{} at {point:?}: {error:e} above {allowed:e}",
                label(machine)
            );
        }
    }
}

#[test]
fn exponentials_undo_logarithms() {
    let points: Vec<Vec<f64>> = numbers(2000, 100.0)
        .into_iter()
        .filter(|x| *x != 0.0)
        .map(|x| vec![x.abs()])
        .collect();
    for machine in &machines() {
        let ulp = |v: f64| machine.format().unit(v);
        // the rounding of the logarithm is multiplied by the exponential
        let log = bound("log", machine).max(0.5);
        let exp = bound("exp", machine).max(0.5);
        let rows = run(machine, "f(x: real) = exp(log(x))\n", What::Value, &points);
        for (point, row) in points.iter().zip(&rows) {
            let x = point[0];
            let moved = x * (log * ulp(x.ln())).exp_m1();
            let allowed = moved + exp * ulp(x + moved);
            assert!(
                (row[0] - x).abs() <= allowed,
                "{}: exp(log({x:e})) = {:e}",
                label(machine),
                row[0]
            );
        }
    }
}

/// Functions that grow: of two arguments far enough apart for the bound, the greater has the greater value; and
/// nowhere is a derivative negative.
#[test]
fn growing_functions_grow() {
    let all = [
        "exp", "exp2", "expm1", "sinh", "tanh", "asinh", "atan", "cbrt",
    ];
    let near_one = ["log", "log2", "log10", "log1p", "sqrt", "acosh"];
    let everywhere: Vec<Vec<f64>> = numbers(1000, 6.0).into_iter().map(|x| vec![x]).collect();
    let beside_one: Vec<Vec<f64>> = (0..1000)
        .map(|k| vec![1.0 + f64::from(k) * f64::from(f32::EPSILON)])
        .collect();
    let below_one: Vec<Vec<f64>> = (1..1000)
        .rev()
        .map(|k| vec![1.0 - f64::from(k) * f64::from(f32::EPSILON) / 2.0])
        .collect();
    let groups = [
        (&all[..], everywhere),
        (&near_one[..], beside_one),
        (&["asin", "atanh"][..], below_one),
    ];
    for machine in &machines() {
        for (names, points) in &groups {
            let mut points = points.clone();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            for name in *names {
                let allowed = 2.0 * bound(name, machine);
                let rows = run(
                    machine,
                    &format!("f(x: real) = {name}(x)\n"),
                    What::Gradient,
                    &points,
                );
                for (pair, at) in rows.windows(2).zip(&points) {
                    let (low, high) = (pair[0][0], pair[1][0]);
                    let fall = if low == high { 0.0 } else { low - high };
                    assert!(
                        fall <= allowed * machine.format().unit(low),
                        "{}: {name} falls after {at:?}",
                        label(machine)
                    );
                    assert!(
                        pair[0][1] >= 0.0,
                        "{}: {name}′ at {at:?} is {}",
                        label(machine),
                        pair[0][1]
                    );
                }
            }
        }
    }
}

#[test]
fn limits_at_infinity_are_reached() {
    let up = f64::INFINITY;
    let half_turn = std::f64::consts::FRAC_PI_2;
    let limits = [
        ("exp", up, up),
        ("exp", -up, 0.0),
        ("expm1", -up, -1.0),
        ("exp2", -up, 0.0),
        ("log", up, up),
        ("sqrt", up, up),
        ("cbrt", -up, -up),
        ("atan", up, half_turn),
        ("atan", -up, -half_turn),
        ("tanh", up, 1.0),
        ("tanh", -up, -1.0),
        ("sinh", -up, -up),
        ("cosh", -up, up),
        ("asinh", -up, -up),
        ("acosh", up, up),
        ("sech", up, 0.0),
        ("csch", up, 0.0),
        ("sinc", up, 0.0),
        ("gamma", up, up),
        ("digamma", up, up),
        ("trigamma", up, 0.0),
        ("log1p", up, up),
    ];
    for machine in &machines() {
        for (name, at, limit) in limits {
            let got = run(
                machine,
                &format!("f(x: real) = {name}(x)\n"),
                What::Value,
                &[vec![at]],
            )[0][0];
            let within = got == limit
                || (got - limit).abs() <= bound(name, machine) * machine.format().unit(limit);
            assert!(
                within,
                "{}: {name}({at}) = {got}, not {limit}",
                label(machine)
            );
        }
        // slopes that flatten out
        for (name, at) in [
            ("exp", -up),
            ("atan", up),
            ("atan", -up),
            ("log", up),
            ("asinh", up),
            ("log1p", up),
            ("tanh", up),
        ] {
            let got = run(
                machine,
                &format!("f(x: real) = {name}(x)\n"),
                What::Gradient,
                &[vec![at]],
            )[0][1];
            assert!(got == 0.0, "{}: {name}′({at}) = {got}", label(machine));
        }
    }
}
