//! Functions of one affine form that change at constants: how many operations their integrals are, and their values on
//! rays where the form stands still, stands on a cut, or passes all of them.

use pullback_compiler::What;
use pullback_compiler::integrate::{Otherwise, explain, field_integral};
use pullback_compiler::lower::Precision;
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::Machine;

use super::{formula, points};

/// At most 1.5 times the operations of the formula as it is derived by hand: 22 for a linear falloff, 24 for a
/// quadratic one.
#[test]
fn falloffs_are_short() {
    for (text, most) in [
        ("clamp(y, 0, 1)", 33),
        ("clamp(1 - y, 0, 1)", 33),
        ("clamp(1 - 0.2 y, 0, 1)", 33),
        ("clamp(y, 0, 1)^2", 36),
        ("clamp(1 - y, 0, 1)^2", 36),
        ("max(0, 1 - y)", 33),
        ("abs(y)", 33),
    ] {
        let told = explain(&formula(text), &[]).unwrap();
        assert!(told.operations <= most, "{text}: {}", told.operations);
        assert!(told.numerical.is_empty() && told.pieces, "{text}");
    }
}

/// y at t = 0, its slope, a, b, and the integral as it follows by hand.
type Line = (f64, f64, f64, f64, f64);

fn check(text: &str, lines: &[Line]) {
    let of = formula(text);
    let integral = field_integral(&of, Otherwise::Refuse)
        .unwrap()
        .into_formula(&of);
    let at = points(
        lines
            .iter()
            .map(|&(y, slope, a, b, _)| vec![7.0, y, -2.0, 0.3, slope, 0.0, a, b]),
    );
    for (machine, tolerance) in [
        (Machine::Reference, 1e-14),
        (
            Machine::Processor(Arithmetic::Ieee32, Precision::Accurate),
            4e-7,
        ),
    ] {
        let values = machine.run(&integral, What::Value, &at).unwrap();
        for (line, value) in lines.iter().zip(values) {
            let (value, exact) = (value[0], line.4);
            let error = (value - exact).abs();
            // what is below the least normal number of binary32 may be 0 there
            let allowed = tolerance * exact.abs() + if tolerance > 1e-10 { 1e-37 } else { 0.0 };
            assert!(error <= allowed, "{text} on {line:?}: {value:e}");
        }
    }
}

/// 2⁻²⁰
const SLOW: f64 = 1.0 / 1_048_576.0;

#[test]
fn clamps_on_every_line() {
    check(
        "clamp(y, 0, 1)",
        &[
            // the form stands still: between the cuts, on them, and outside
            (0.25, 0.0, 0.0, 4.0, 1.0),
            (0.25, -0.0, 0.0, 4.0, 1.0),
            (0.0, 0.0, 0.0, 4.0, 0.0),
            (-0.0, -0.0, 0.0, 4.0, 0.0),
            (1.0, 0.0, 0.0, 4.0, 4.0),
            (1.0, -0.0, 4.0, 0.0, -4.0),
            (-3.0, 0.0, 0.0, 4.0, 0.0),
            (3.0, 0.0, 0.0, 4.0, 4.0),
            // it moves by tiny steps
            (0.0, 1e-40, 0.0, 4.0, 8e-40),
            (0.0, 1e-30, 0.0, 4.0, 8e-30),
            (0.0, -1e-30, 4.0, -4.0, -8e-30),
            (1.0, 1e-20, 0.0, 4.0, 4.0),
            (0.5, -1e-8, 0.0, 4.0, 2.0 - 8e-8),
            // it passes both cuts, one, or none, either way
            (-1.0, 1.0, 0.0, 4.0, 2.5),
            (-1.0, 1.0, 4.0, 0.0, -2.5),
            (2.0, -1.0, 0.0, 4.0, 1.5),
            (2.0, -1.0, 4.0, 0.0, -1.5),
            (0.25, 0.125, 0.0, 4.0, 2.0),
            (5.0, 1.0, 0.0, 4.0, 4.0),
            (-9.0, 1.0, 0.0, 4.0, 0.0),
            (1e4, -1.0, 0.0, 2e4, 9999.5),
            // an empty interval
            (0.5, 1.0, 2.0, 2.0, 0.0),
        ],
    );
    check(
        "clamp(1 - y, 0, 1)^2",
        &[
            (0.5, 0.0, 0.0, 4.0, 1.0),
            (1.0, -0.0, 0.0, 4.0, 0.0),
            (-1.0, 1.0, 0.0, 4.0, 4.0 / 3.0),
            (-1.0, 1.0, 4.0, 0.0, -4.0 / 3.0),
            (2.0, -1.0, 0.0, 4.0, 7.0 / 3.0),
            // slowly, from the cut
            (1.0, -SLOW, 0.0, 4.0, 64.0 / 3.0 * SLOW * SLOW),
        ],
    );
}

/// Where the form stands on a cut, the integral is the value there times the length.
#[test]
fn jumps_on_every_line() {
    let crossing = (-0.5, 0.5, 0.0, 4.0, 2.0 + 3.0 * 2.0);
    let on = |exact| (0.5, 0.0, 0.0, 4.0, exact);
    check("if y < 0.5 then 1 else 3", &[crossing, on(12.0)]);
    check("if y <= 0.5 then 1 else 3", &[crossing, on(4.0)]);
    check(
        "if y == 0.5 then 1 else 3",
        &[on(4.0), (0.0, 1.0, 0.0, 4.0, 12.0)],
    );
    check(
        "sign(y - 0.5) + 2",
        &[crossing, on(8.0), (4.5, -1.0, 8.0, 0.0, -16.0)],
    );
}

/// Several cuts, written in any order, and the zeros of a quadratic.
#[test]
fn many_cuts_are_in_order() {
    check(
        "max(abs(y), abs(y - 1)) + min(2, abs(y + 2))",
        &[
            // y = -4 … 4: ∫ max = 12.375 + 7.875, ∫ min = 4 + 8
            (-4.0, 1.0, 0.0, 8.0, 32.25),
            (4.0, -1.0, 0.0, 8.0, 32.25),
        ],
    );
    check(
        "max(0, 1 - y^2)",
        &[(-4.0, 2.0, 0.0, 4.0, 2.0 / 3.0), (0.0, 0.0, 1.0, 3.0, 2.0)],
    );
}
