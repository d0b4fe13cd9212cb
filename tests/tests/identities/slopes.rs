//! Symmetries of derivatives: that of an odd function is even, that of an even one odd, and f′(z̄) is the conjugate of
//! f′(z), number for number. Signs of zeros are not promised of derivatives.

use pullback_compiler::What;

use super::{machines, numbers, run_twice};

/// Whether two derivatives are the same number, zeros of either sign alike.
fn equal(a: f64, b: f64) -> bool {
    a == b || (a.is_nan() && b.is_nan())
}

/// Holds f′(turn z) = turned f′(z) for every function, up to the sign of zeros.
fn symmetric(functions: &[&str], domain: &str, turn: &[f64], turned: &[f64]) {
    let complex = turn.len() == 2;
    let flat = numbers(400 * turn.len(), 20.0);
    let points: Vec<Vec<f64>> = flat.chunks(turn.len()).map(<[f64]>::to_vec).collect();
    let images: Vec<Vec<f64>> = points
        .iter()
        .map(|p| p.iter().zip(turn).map(|(x, s)| x * s).collect())
        .collect();
    let what = if complex {
        What::Derivative
    } else {
        What::Gradient
    };
    let mut wrong = Vec::new();
    for machine in &machines() {
        for name in functions {
            let source = format!("f({domain}) = {name}({})\n", &domain[..1]);
            let (here, there) = run_twice(machine, &source, what, &points, &images);
            for ((point, a), b) in points.iter().zip(&here).zip(&there) {
                let (a, b) = (&a[turned.len()..], &b[turned.len()..]);
                let kept = a
                    .iter()
                    .zip(turned)
                    .zip(b)
                    .all(|((a, s), b)| equal(a * s, *b));
                if !kept {
                    wrong.push(format!("{}: {name}′ at {point:?}: {a:?}, {b:?}", machine));
                    break;
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn slopes_of_odd_functions_are_even() {
    let odd = [
        "sin", "tan", "asin", "atan", "sinh", "tanh", "asinh", "atanh", "cbrt", "csc", "csch",
    ];
    symmetric(&odd, "x: real", &[-1.0], &[1.0]);
}

#[test]
fn slopes_of_even_functions_are_odd() {
    let even = ["cos", "cosh", "sinc", "sec", "sech", "abs"];
    symmetric(&even, "x: real", &[-1.0], &[-1.0]);
}

#[test]
fn slopes_of_complex_odd_functions_are_even() {
    let odd = [
        "sin", "tan", "sinh", "tanh", "asin", "atan", "asinh", "atanh",
    ];
    symmetric(&odd, "z: complex", &[-1.0, -1.0], &[1.0, 1.0]);
}

#[test]
fn conjugates_have_conjugate_slopes() {
    let real_on_the_axis = [
        "exp", "log", "sqrt", "sin", "cos", "tan", "sinh", "cosh", "tanh", "asin", "acos", "atan",
        "asinh", "acosh", "atanh",
    ];
    symmetric(&real_on_the_axis, "z: complex", &[1.0, -1.0], &[1.0, -1.0]);
}
