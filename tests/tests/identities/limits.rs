//! Limits of complex functions where a component is infinite (C99 Annex G), and of their derivatives.

use std::f64::consts::{FRAC_PI_2, PI};

use pullback_compiler::What;
use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::error::Judge;

use super::{machines, run};

#[test]
fn complex_limits_at_infinity_are_reached() {
    let up = f64::INFINITY;
    let limits: [(&str, [f64; 2], [f64; 2]); 30] = [
        ("exp", [-up, 1.0], [0.0, 0.0]),
        ("exp", [up, 0.0], [up, 0.0]),
        ("exp", [up, 1.0], [up, up]),
        ("exp", [up, 2.0], [-up, up]),
        ("log", [up, 1.0], [up, 0.0]),
        ("log", [-up, 1.0], [up, PI]),
        ("log", [-up, -1.0], [up, -PI]),
        ("log", [1.0, up], [up, FRAC_PI_2]),
        ("sqrt", [up, 1.0], [up, 0.0]),
        ("sqrt", [-up, 1.0], [0.0, up]),
        ("sqrt", [-up, -1.0], [0.0, -up]),
        ("sinh", [up, 0.0], [up, 0.0]),
        ("sinh", [-up, 0.0], [-up, 0.0]),
        ("cosh", [-up, 1.0], [up, -up]),
        ("tanh", [up, 1.0], [1.0, 0.0]),
        ("tanh", [-up, 1.0], [-1.0, 0.0]),
        ("tan", [1.0, up], [0.0, 1.0]),
        ("tan", [1.0, -up], [0.0, -1.0]),
        ("sin", [1.0, up], [up, up]),
        ("cos", [1.0, up], [up, -up]),
        ("asin", [up, 1.0], [FRAC_PI_2, up]),
        ("asin", [-up, -1.0], [-FRAC_PI_2, -up]),
        ("acos", [up, 1.0], [0.0, -up]),
        ("acos", [-up, 1.0], [PI, -up]),
        ("atan", [up, 1.0], [FRAC_PI_2, 0.0]),
        ("atan", [1.0, -up], [FRAC_PI_2, 0.0]),
        ("asinh", [up, 1.0], [up, 0.0]),
        ("acosh", [-up, 1.0], [up, PI]),
        ("atanh", [up, 1.0], [0.0, FRAC_PI_2]),
        ("atanh", [1.0, up], [0.0, FRAC_PI_2]),
    ];
    let mut wrong = Vec::new();
    for machine in &machines() {
        let near = |got: f64, limit: f64| {
            got == limit || (got - limit).abs() <= 4.0 * machine.format().unit(limit)
        };
        for group in limits.chunk_by(|a, b| a.0 == b.0) {
            let name = group[0].0;
            let points: Vec<Vec<f64>> = group.iter().map(|(_, at, _)| at.to_vec()).collect();
            let source = format!("f(z: complex) = {name}(z)\n");
            let rows = run(machine, &source, What::Value, &points);
            for ((_, at, limit), got) in group.iter().zip(&rows) {
                if !(near(got[0], limit[0]) && near(got[1], limit[1])) {
                    wrong.push(format!(
                        "{}: {name}({at:?}) = {got:?}, not {limit:?}",
                        machine
                    ));
                }
            }
        }
        // quotients and powers that vanish, and derivatives that flatten out
        for (text, at, limit) in [
            ("1/z", [up, 1.0], [0.0, 0.0]),
            ("z^-3", [-up, 0.0], [0.0, 0.0]),
            ("diff(exp(z), z)", [-up, 1.0], [0.0, 0.0]),
            ("diff(log(z), z)", [up, 1.0], [0.0, 0.0]),
            ("diff(atan(z), z)", [up, 1.0], [0.0, 0.0]),
        ] {
            let source = format!("f(z: complex) = {text}\n");
            let got = &run(machine, &source, What::Value, &[at.to_vec()])[0];
            if !(near(got[0], limit[0]) && near(got[1], limit[1])) {
                wrong.push(format!("{}: {text} at {at:?} is {got:?}", machine));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// 1/cosh and its like vanish far out, and so do their slopes, also where cosh overflows.
#[test]
fn reciprocals_of_what_overflows_vanish_with_their_slopes() {
    let real = ["1/cosh(x)", "-2/sinh(x)", "sech(x)", "csch(x)"];
    let complex = ["1/cosh(z)", "3/sinh(z)", "1/cos(i z)", "1/sin(i z)"];
    for machine in machines().iter().skip(1) {
        for text in real {
            let source = format!("f(x: real) = {text}\n");
            let points = [vec![100.0], vec![-100.0], vec![1e4], vec![-1e30]];
            let rows = run(machine, &source, What::Gradient, &points);
            let small = |v: &f64| v.abs() < 1e-40;
            assert!(
                rows.iter().flatten().all(small),
                "{}: {text}: {rows:?}",
                machine
            );
        }
        if machine.precision() == Some(Precision::Extended) {
            continue; // complex ones take a shader compiler long
        }
        for text in complex {
            let source = format!("f(z: complex) = {text}\n");
            let points = [vec![100.0, 1.0], vec![-1e4, 2.0]];
            let rows = run(machine, &source, What::Derivative, &points);
            let small = |v: &f64| v.abs() < 1e-40;
            assert!(
                rows.iter().flatten().all(small),
                "{}: {text}: {rows:?}",
                machine
            );
        }
    }
}

/// Far left of 0 the reflection term π²/sin² πz of ψ′ is small, and more than all the rest; beside a pole it is all.
/// References by mpmath, from the series of ψ′(1 - z).
#[test]
fn polygammas_are_reflected_far_left_of_zero() {
    let machines = machines();
    let some = machines
        .iter()
        .filter(|m| [None, Some(Precision::Accurate)].contains(&m.precision()));
    for machine in some {
        let run_one = |name: &str, at: [f64; 2]| {
            let source = format!("f(z: complex) = {name}(z)\n");
            run(machine, &source, What::Value, &[at.to_vec()]).remove(0)
        };
        let far = f64::from(-1e20_f32);
        // at multiples of ¼ below 2²² single precision has the point itself
        for (at, exact) in [
            ([far, 5.5], -3.874_538_284_592_621e-14),
            ([-1_000_000.25, 6.0], -9.999_992_499_644_792e-7),
        ] {
            let got = run_one("trigamma", at)[0];
            let unit = machine.format().unit(exact);
            assert!((got - exact).abs() < 64.0 * unit, "{}: {got:e}", machine);
        }
        // ψ ≈ log|z| - 1/(i y), with digits that a rounded ⌊x + ½⌋ has not
        let beside = run_one("digamma", [-8_886_501.0, f64::from(3.0e-30_f32)]);
        assert!(
            (beside[0] - 16.000_043_997_977_535).abs() < 1e-5,
            "{beside:?}"
        );
        assert!(
            (beside[1] * f64::from(3.0e-30_f32) - 1.0).abs() < 1e-6,
            "{beside:?}"
        );
    }
}
