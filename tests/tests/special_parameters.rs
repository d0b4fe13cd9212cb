//! Derivatives of special functions by their parameters: what they are is held to tables by the suite `special`; here are
//! their equations, and what is said where there are none.

use pullback_compiler::eval::{Leaves, Tape};
use pullback_compiler::lower::Precision;
use pullback_compiler::table::Number;
use pullback_compiler::{EmitWhat, Target, compile};

/// The value of a program f(x, y), in `f64`.
fn value(body: &str, x: f64, y: f64) -> f64 {
    let text = format!("f(x, y) = {body}\n");
    let answer = compile(&text);
    let program = answer
        .program
        .unwrap_or_else(|| panic!("{text}: {:?}", answer.diagnostics));
    let formula = &program.pictures()[0].formula;
    let inputs = [Number::Real(x), Number::Real(y)];
    let leaves = Leaves {
        inputs: &inputs,
        params: &[],
        time: 0.0,
        pixel: 0.0,
    };
    let mut found = f64::NAN;
    Tape::new(&formula.graph, &formula.value).run(&leaves, |value| {
        if let Number::Real(value) = value {
            found = value;
        }
    });
    found
}

/// The derivative by a parameter is the integral of its own derivative by the argument, which has a formula of its own; from where
/// it is known.
#[test]
fn derivatives_by_parameters_grow_as_their_own_derivatives_say() {
    let functions = [
        ("jacobi_sn(T, y)", "0"),
        ("jacobi_cn(T, y)", "0"),
        ("jacobi_dn(T, y)", "0"),
        ("hypergeometric(y, 0.75, 1.25, T/4)", "0"),
        ("hypergeometric(0.75, y, 1.25, T/4)", "0"),
        ("hypergeometric(0.75, 1.25, y + 3, T/4)", "0"),
        ("gegenbauer_c(5, y, T)", "diff(gegenbauer_c(5, y, 0 x), y)"),
        ("laguerre_l(5, y, T)", "diff(laguerre_l(5, y, 0 x), y)"),
    ];
    for (function, start) in functions {
        let slope = format!("diff({}, y)", function.replace('T', "x"));
        let grown = format!(
            "quadrature(diff({}, y, t), t, 0, x)",
            function.replace('T', "t")
        );
        for (x, y) in [(0.75, 0.5), (-1.25, 0.25), (0.5, -1.5), (0.375, 1.75)] {
            let left = value(&slope, x, y);
            let right = value(&format!("{start} + {grown} + 0 x + 0 y"), x, y);
            assert!(
                (left - right).abs() < 1e-11 * (1.0 + left.abs()),
                "{slope} at {x}, {y}: {left}, {right}"
            );
            assert!(left.abs() > 1e-4, "{slope} at {x}, {y}: {left}");
        }
    }
}

/// The second derivative by a parameter is the integral of its own derivative by the argument.
#[test]
fn second_derivatives_by_parameters_grow_as_their_own_derivatives_say() {
    let functions = [
        ("jacobi_sn(T, y)", "0"),
        ("jacobi_cn(T, y)", "0"),
        ("jacobi_dn(T, y)", "0"),
        ("hypergeometric(y, 0.75, 1.25, T/4)", "0"),
        ("hypergeometric(y, y + 1, 1.25, T/4)", "0"),
        ("hypergeometric(0.75, y, y + 3, T/4)", "0"),
        ("hypergeometric(0.75, 1.25, y + 3, T/4)", "0"),
        (
            "gegenbauer_c(5, y, T)",
            "diff(gegenbauer_c(5, y, 0 x), y, 2)",
        ),
        ("laguerre_l(5, y, T)", "diff(laguerre_l(5, y, 0 x), y, 2)"),
    ];
    for (function, start) in functions {
        let curve = format!("diff({}, y, 2)", function.replace('T', "x"));
        let grown = format!(
            "quadrature(diff(diff({}, y, 2), t), t, 0, x)",
            function.replace('T', "t")
        );
        for (x, y) in [(0.75, 0.25), (-0.5, 1.75)] {
            let left = value(&curve, x, y);
            let right = value(&format!("{start} + {grown} + 0 x + 0 y"), x, y);
            assert!(
                (left - right).abs() < 1e-11 * (1.0 + left.abs()),
                "{curve} at {x}, {y}: {left}, {right}"
            );
            assert!(left.abs() > 1e-6, "{curve} at {x}, {y}: {left}");
        }
    }
}

/// sn² + cn² = 1 and dn² + m sn² = 1 (DLMF 22.6.1), differentiated by m, also where formulas by m and 1 - m would be 0/0.
#[test]
fn derivatives_by_the_parameter_of_elliptic_functions_keep_their_equations() {
    let sums = [
        "jacobi_sn(x, y) diff(jacobi_sn(x, y), y) + jacobi_cn(x, y) diff(jacobi_cn(x, y), y)",
        "2 jacobi_dn(x, y) diff(jacobi_dn(x, y), y) + jacobi_sn(x, y)^2 + 2 y jacobi_sn(x, y) diff(jacobi_sn(x, y), y)",
    ];
    for sum in sums {
        for y in [
            0.0,
            1e-12,
            0.25,
            0.5,
            0.75,
            1.0 - 1e-12,
            1.0,
            1.0 + 1e-12,
            2.5,
            -7.0,
        ] {
            for x in [1e-6, 0.3, 1.1, -2.3, 4.0] {
                let found = value(sum, x, y);
                assert!(
                    found.abs() < 1e-13 * (1.0 + y.abs()),
                    "{sum} at {x}, {y}: {found}"
                );
            }
        }
    }
    // DLMF 22.10.7-8 at m = 0: (sin u cos u - u) cos u/4
    let u: f64 = 1.25;
    let expected = (u.sin() * u.cos() - u) * u.cos() / 4.0;
    assert!((value("diff(jacobi_sn(x, y), y)", u, 0.0) - expected).abs() < 1e-15);
}

/// A derivative that is not there is an error that names it.
#[test]
fn what_has_no_derivative_says_so() {
    let missing = [
        ("f(z) = jacobi_sn(1/2, z)", "", ""),
        ("f(z) = weierstrass_p_prime(1/4, z)", "", ""),
        (
            "f(z) = weierstrass_p_prime_invariants(1/4, z, 1 - z)",
            "",
            "",
        ),
        ("f(z) = diff(jacobi_sn(1/2, z), z)", "", ""),
        ("f(z) = diff(hypergeometric(z, 1/2, 1 + z, z/4), z)", "", ""),
        (
            "f(x, y) = diff(jacobi_sn(x, y), y, 3)",
            "jacobi_sn",
            "third derivative by m",
        ),
        (
            "f(x, y) = diff(hypergeometric(x, 1, 2, y/4), x, 3)",
            "hypergeometric",
            "third derivative by a, b, c",
        ),
        (
            "f(x, y) = diff(laguerre_l(3, x, y), x, 3)",
            "laguerre_l",
            "third derivative by a",
        ),
        (
            "f(x) = diff(elliptic_e(x), x, 3)",
            "elliptic_k",
            "third derivative",
        ),
        (
            "f(z) = diff(modular_lambda(z), z, 3)",
            "modular_lambda",
            "third derivative",
        ),
        (
            "f(z) = diff(weierstrass_p(1/4, z), z)",
            "weierstrass_p",
            "second derivative by τ",
        ),
        (
            "f(z) = diff(weierstrass_p_invariants(1/4, z, 1), z)",
            "weierstrass_p_invariants",
            "second derivative by g₂ or g₃",
        ),
        (
            "f(z) = diff(hurwitz_zeta(z, 1/2), z, 2)",
            "hurwitz_zeta",
            "third derivative by s",
        ),
        (
            "f(z) = diff(zeta(z), z, 2)",
            "zeta",
            "third derivative by s",
        ),
        (
            "f(z) = diff(dirichlet_beta(z), z, 2)",
            "dirichlet_beta",
            "third derivative by s",
        ),
        (
            "f(z) = diff(dirichlet_eta(z), z)",
            "dirichlet_eta",
            "second derivative by s",
        ),
    ];
    for (text, name, what) in missing {
        let answer = compile(text);
        let said: Vec<String> = match &answer.program {
            None => answer
                .diagnostics
                .iter()
                .map(|d| d.message.clone())
                .collect(),
            Some(program) => {
                let emitted =
                    program.emit(0, EmitWhat::Derivative, Target::Wgsl, Precision::Accurate);
                emitted
                    .err()
                    .into_iter()
                    .flatten()
                    .map(|d| d.message)
                    .collect()
            }
        };
        if what.is_empty() {
            assert!(said.is_empty(), "{text}: {said:?}");
        } else {
            let named = said.iter().any(|m| m.contains(name) && m.contains(what));
            assert!(named, "{text}: {said:?}");
        }
    }
}
