//! Identities that hold whatever the reference says: symmetries bit for bit, inverse functions, limits. Tolerances are
//! made of declared bounds. Random points are the same in every run.

mod inverses;
mod limits;
mod periodicity;
mod slopes;

use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use pullback_compiler::What;
use pullback_compiler::lower::Precision;
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

/// The same at two sets of points, by one shader: compiling it is what takes time.
fn run_twice(
    machine: &Machine,
    source: &str,
    what: What,
    first: &[Vec<f64>],
    second: &[Vec<f64>],
) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let mut here = run(machine, source, what, &[first, second].concat());
    let there = here.split_off(first.len());
    (here, there)
}

/// The declared bounds of a function's value and derivative, in units in the last place; 0 where none is needed.
fn units(word: &str, domain: Domain, machine: &Machine) -> (f64, f64) {
    let all = subjects();
    let mut found = all.iter().filter(|s| s.word == word);
    let subject = found.find(|s| s.domain == domain).expect(word);
    let bounds = declared(subject, machine).expect(word);
    let derivative = bounds.derivative.map_or(0.0, |b| b.units);
    (bounds.value.expect(word).units, derivative)
}

/// The declared bound of a real function, in units in the last place.
fn bound(word: &str, machine: &Machine) -> f64 {
    units(word, Domain::Real, machine).0
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
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
            let (here, there) = run_twice(machine, &source, What::Value, &points, &images);
            for ((point, a), b) in points.iter().zip(&here).zip(&there) {
                let equal = a
                    .iter()
                    .zip(turned)
                    .zip(b)
                    .all(|((a, s), b)| same(a * s, *b));
                if !equal {
                    wrong.push(format!("{}: {name} at {point:?}: {a:?}, {b:?}", machine));
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
                machine
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
                machine,
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
                        machine
                    );
                    assert!(
                        pair[0][1] >= 0.0,
                        "{}: {name}′ at {at:?} is {}",
                        machine,
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
            assert!(within, "{}: {name}({at}) = {got}, not {limit}", machine);
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
            assert!(got == 0.0, "{}: {name}′({at}) = {got}", machine);
        }
    }
}

/// The slopes of x/|p| are (h/|p|)²/|p| and -(x/|p|)(y/|p|)/|p|, h the length of the other coordinates: 1 - (x/|p|)² has
/// no digits where x dominates.
#[test]
fn directions_have_slopes_that_do_not_cancel() {
    let plane = "f(x, y) = normalize(vec2(x, y)).x";
    let space = "f(x, y, z) = normalize(vec3(x, y, z)).y";
    let four = "f(x, y, z) = normalize(vec4(x, y, z, 2)).z";
    let points = [
        [1.0, 1e-4, -1e-6],
        [1e-3, 1e4, 2e-5],
        [-3e15, 2e-3, 7.0],
        [0.25, -3.0, 1e6],
        [1e-15, 2e-15, -3e-15],
    ];
    for machine in &machines() {
        for (source, count, of, last) in [(plane, 2, 0, 0.0), (space, 3, 1, 0.0), (four, 3, 2, 2.0)]
        {
            let args: Vec<Vec<f64>> = points
                .iter()
                .map(|p| {
                    p[..count]
                        .iter()
                        .map(|&x: &f64| f64::from(x as f32))
                        .collect()
                })
                .collect();
            let rows = run(machine, source, What::Gradient, &args);
            for (point, row) in args.iter().zip(&rows) {
                let rest = |skip: usize| {
                    let others = point.iter().enumerate().filter(|(k, _)| *k != skip);
                    others.map(|(_, x)| x * x).sum::<f64>() + last * last
                };
                let r = rest(usize::MAX).sqrt();
                let mut exact = vec![point[of] / r];
                exact.extend((0..count).map(|k| {
                    if k == of {
                        rest(of) / r / r / r
                    } else {
                        -(point[of] / r) * (point[k] / r) / r
                    }
                }));
                for (got, exact) in row.iter().zip(&exact) {
                    let unit = machine.format().unit(*exact);
                    // a quotient, two products, and roundings of the two lengths in them
                    assert!(
                        (got - exact).abs() <= 12.0 * unit || exact.abs() < 2f64.powi(-80),
                        "{}: {source} at {point:?}: {row:?}, not {exact:e}",
                        machine
                    );
                }
            }
        }
    }
}

#[test]
fn directions_are_known_where_lengths_overflow() {
    let args = vec![vec![f64::from(3e38_f32), f64::from(-2e38_f32)]];
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    let exact = args[0][0] / args[0][0].hypot(args[0][1]);
    for source in [
        "f(x, y) = normalize(vec2(x, y)).x",
        "f(x, y) = diff(hypot(x, y), x)",
    ] {
        let got = run(&machine, source, What::Value, &args)[0][0];
        assert!((got - exact).abs() < 2e-7, "{source}: {got}, not {exact}");
    }
    // and there is none at the origin
    let origin = run(
        &machine,
        "f(x, y) = normalize(vec2(x, y)).x",
        What::Value,
        &[vec![0.0, 0.0]],
    );
    assert!(origin[0][0].is_nan());
}

/// A power whose base or exponent is a constant, or both the same: what a shader compiler knows of them must not undo the
/// sums of two floats. All constants are float32 numbers.
#[test]
fn powers_with_constants_keep_their_digits() {
    let Some(gpu) = suite_gpu() else { return };
    let accurate = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    let args: Vec<Vec<f64>> = numbers(400, 6.0)
        .into_iter()
        .filter(|x| *x != 0.0)
        .map(|x| vec![x.abs()])
        .collect();
    let bound = bound("pow", &accurate);
    // with the bound of each: the power, and what is done to it
    for (source, more) in [
        ("x^2.75", 0.0),
        ("2.5*x^1.5", 1.0),
        ("diff(x^1.5, x)", 1.0),
        ("diff(x^-0.625, x)", 1.0),
        ("1.125^x", 0.0),
        ("diff(1.125^x, x)", 2.0),
        ("x^x", 0.0),
        ("x^-x", 0.0),
        ("re(complex(x, 0.5)^2.75)", 2.0),
        ("re(complex(1.5, 0.5)^x)", 2.0),
    ] {
        let source = format!("f(x: real) = {source}");
        let exact = run(&Machine::Reference, &source, What::Value, &args);
        let got = run(&accurate, &source, What::Value, &args);
        for ((x, e), g) in args.iter().zip(&exact).zip(&got) {
            let (e, g) = (e[0], g[0]);
            if e.abs() > 3e38 || e.abs() < 2e-38 {
                continue;
            }
            // the real part of a complex power is good to its modulus
            let size = if source.contains("complex") {
                let modulus = if source.contains("0.5)^2") {
                    x[0].hypot(0.5).powf(2.75)
                } else {
                    1.5_f64.hypot(0.5).powf(x[0])
                };
                e.abs().max(modulus)
            } else {
                e.abs()
            };
            assert!(
                (g - e).abs() <= (bound + more) * accurate.format().unit(size),
                "{source} at {x:?}: {g:e}, not {e:e}"
            );
        }
    }
}
