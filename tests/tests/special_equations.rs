//! Functional equations of the special functions that are defined in the language, at random points, in `f64`.
//!
//! Each states a residual and what it is measured by: the sum of the sizes of its terms, times how much an argument of
//! one rounding moves them, in the units of binary64.

use pullback_compiler::compile;
use pullback_compiler::eval::{Leaves, Tape};
use pullback_compiler::table::Number;

/// Largest residual, in units of the scale.
const MOST: f64 = 8.0;
/// Points of each equation.
const POINTS: usize = 60;

/// An equation of x and y: its residual, its scale, and where x and y lie.
struct Equation {
    residual: &'static str,
    scale: &'static str,
    x: (f64, f64),
    y: (f64, f64),
}

const fn equation(
    residual: &'static str,
    scale: &'static str,
    x: (f64, f64),
    y: (f64, f64),
) -> Equation {
    Equation {
        residual,
        scale,
        x,
        y,
    }
}

const ANY: (f64, f64) = (0.0, 1.0);

/// DLMF 10.5.2, 10.28.2, 10.6.1, 10.29.1, 10.12.3.
const BESSEL: [Equation; 9] = [
    equation(
        "besselj(1, x) bessely(0, x) - besselj(0, x) bessely(1, x) - 2/(pi x)",
        "(1 + x) / x",
        (0.01, 60.0),
        ANY,
    ),
    equation(
        "besselj(8, x) bessely(7, x) - besselj(7, x) bessely(8, x) - 2/(pi x)",
        "(8 + x) / x",
        (0.5, 60.0),
        ANY,
    ),
    equation(
        "besseli(0, x) besselk(1, x) + besseli(1, x) besselk(0, x) - 1/x",
        "(1 + x) / x",
        (0.01, 60.0),
        ANY,
    ),
    equation(
        "besseli(6, x) besselk(7, x) + besseli(7, x) besselk(6, x) - 1/x",
        "(8 + x) / x",
        (0.1, 60.0),
        ANY,
    ),
    equation(
        "besselj(round(y) - 1, x) + besselj(round(y) + 1, x) - 2 round(y)/x besselj(round(y), x)",
        "(1 + x + y) (|besselj(round(y) - 1, x)| + |besselj(round(y) + 1, x)|)",
        (0.1, 80.0),
        (1.0, 45.0),
    ),
    equation(
        "besseli(round(y) - 1, x) - besseli(round(y) + 1, x) - 2 round(y)/x besseli(round(y), x)",
        "(1 + x + y) (besseli(round(y) - 1, x) + besseli(round(y) + 1, x))",
        (0.1, 60.0),
        (1.0, 45.0),
    ),
    equation(
        "cos(x sin(y)) - besselj(0, x) - 2 sum(k in 1..25, besselj(2 k, x) cos(2 k y))",
        "2 + x",
        (0.0, 20.0),
        (0.0, 6.0),
    ),
    equation(
        "|besselj(2, x + i y) + besselj(4, x + i y) - 6/(x + i y) besselj(3, x + i y)|",
        "(4 + |x + i y|) (|besselj(2, x + i y)| + |besselj(4, x + i y)|)",
        (-30.0, 30.0),
        (-30.0, 30.0),
    ),
    equation(
        "|besselj(1, x + 0i) - besselj(1, x)|",
        "(1 + |x|) (|besselj(1, x)| + |besselj(0, x)|)",
        (-40.0, 40.0),
        ANY,
    ),
];

/// DLMF 6.2.4, 6.5.5-6, 6.2.8, 6.2.1 and 6.2.9 as integrals, 7.5.8, 5.12.1, 5.5.4.
const INTEGRALS: [Equation; 11] = [
    equation(
        "|e1(x + i y) + ei(-x - i y) + i pi|",
        "(1 + |x + i y|) (1 + |e1(x + i y)|)",
        (-30.0, 30.0),
        (0.01, 30.0),
    ),
    equation(
        "e1(x) - e1(x + y) - quadrature(exp(-t)/t, t, x, x + y)",
        "4 (1 + x) e1(x)",
        (2.0, 20.0),
        (0.1, 0.5),
    ),
    equation(
        "|e1(i x) + ci(x) - i (si(x) - pi/2)|",
        "4",
        (0.1, 60.0),
        ANY,
    ),
    equation(
        "si(x + y) - si(x) - quadrature(sin(t)/t, t, x, x + y)",
        "4",
        (-20.0, 20.0),
        (0.1, 2.0),
    ),
    equation(
        "li(exp(x)) - ei(x)",
        "(1 + |x|) (1 + |ei(x)|)",
        (-8.0, 30.0),
        ANY,
    ),
    equation(
        "|fresnel_c(x + i y) + i fresnel_s(x + i y) - complex(1/2, 1/2) erf(0.886226925452758014 (1 - i) (x + i y))|",
        "(1 + |x + i y|^2) (1 + |exp(pi x y)| + |exp(-pi x y)|)",
        (-2.5, 2.5),
        (-2.5, 2.5),
    ),
    equation(
        "fresnel_s(x + y) - fresnel_s(x) - quadrature(sin(pi t²/2), t, x, x + y)",
        "4",
        (-3.0, 3.0),
        (0.1, 0.5),
    ),
    equation(
        "beta(x + 1, y) + beta(x, y + 1) - beta(x, y)",
        "(1 + x + y) beta(x, y)",
        (0.05, 40.0),
        (0.05, 40.0),
    ),
    equation(
        "beta(x, x) - 2^(1 - 2 x) beta(x, 1/2)",
        "(1 + x) beta(x, x)",
        (0.05, 60.0),
        ANY,
    ),
    equation(
        "|beta(x + i y, 1.5) gamma(x + 1.5 + i y) - gamma(x + i y) gamma(1.5)|",
        "(4 + |x + i y|) |gamma(x + i y)|",
        (-4.0, 8.0),
        (0.3, 9.0),
    ),
    equation(
        "trigamma(x) + trigamma(1 - x) - (pi csc(pi x))^2",
        "4 (pi csc(pi x))^2",
        (0.05, 0.95),
        ANY,
    ),
];

/// DLMF 18.5.1-2, 18.18.40, 18.12.11 squared for the sum of products of Legendre's, 14.18.2, and 14.30.9.
const POLYNOMIALS: [Equation; 8] = [
    equation(
        "chebyshev_t(round(y), cos(x)) - cos(round(y) x)",
        "4 + 4 y^2",
        (0.0, 3.2),
        (0.0, 40.0),
    ),
    equation(
        "sin(x) chebyshev_u(round(y), cos(x)) - sin((round(y) + 1) x)",
        "4 + 4 y^2",
        (0.0, 3.2),
        (0.0, 40.0),
    ),
    equation(
        "sum(k in 0..min(round(y), 12), legendre_p(k, x) legendre_p(round(y) - k, x)) - chebyshev_u(round(y), x)",
        "4 + y^2",
        (-1.0, 1.0),
        (0.0, 12.0),
    ),
    equation(
        "sum(k in 0..min(round(y), 12), laguerre_l(k, x)) - laguerre_l(round(y), 1, x)",
        "(1 + y) exp(x/2)",
        (0.0, 10.0),
        (0.0, 12.0),
    ),
    equation(
        "hermite_h(round(y), x) - 2 x hermite_h(round(y) - 1, x) + 2 (round(y) - 1) hermite_h(round(y) - 2, x)",
        "(1 + y) (|hermite_h(round(y), x)| + 2 y |hermite_h(round(y) - 2, x)|)",
        (-4.0, 4.0),
        (2.0, 12.0),
    ),
    equation(
        "sum(m in 0..10, spherical_harmonic(5, m - 5, x, y, 0.4)^2) - 11/(4 pi)",
        "16",
        (-1.0, 1.0),
        (-1.0, 1.0),
    ),
    equation(
        "sum(m in 0..6, spherical_harmonic(3, m - 3, x, y, 0.4) spherical_harmonic(3, m - 3, 0.6, 0, -0.8))
           - 7/(4 pi) legendre_p(3, (0.6 x - 0.32)/length((x, y, 0.4)))",
        "16",
        (-1.0, 1.0),
        (-1.0, 1.0),
    ),
    equation(
        "laplacian(length((x, y, z))^4 spherical_harmonic(4, -3, x, y, z), x, y, z) where z = 0.7",
        "64",
        (-1.0, 1.0),
        (-1.0, 1.0),
    ),
];

/// Numbers in [0, 1), the same in every run (Marsaglia, Xorshift RNGs, J. Stat. Softw. 8, 2003).
fn uniform(state: &mut u64) -> f64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    f64::from(u32::try_from(*state >> 32).unwrap_or(0)) / 2f64.powi(32)
}

fn real(body: &str, x: f64, y: f64) -> f64 {
    value(&mut tape(body), x, y)
}

fn tape(body: &str) -> Tape {
    let text = format!("f(x, y) = {body}\n");
    let answer = compile(&text);
    let program = answer
        .program
        .unwrap_or_else(|| panic!("{text}: {:?}", answer.diagnostics));
    let formula = &program.pictures()[0].formula;
    Tape::new(&formula.graph, &formula.value)
}

fn value(tape: &mut Tape, x: f64, y: f64) -> f64 {
    let inputs = [Number::Real(x), Number::Real(y)];
    let leaves = Leaves {
        inputs: &inputs,
        params: &[],
        time: 0.0,
        pixel: 0.0,
    };
    let mut found = f64::NAN;
    tape.run(&leaves, |value| {
        if let Number::Real(value) = value {
            found = value;
        }
    });
    found
}

/// The largest residual in units of the scale; infinite where it is no number.
fn largest(residual: &str, scale: &str, equation: &Equation) -> f64 {
    let (mut residual, mut scale) = (tape(residual), tape(scale));
    let mut state = 0x9e37_79b9_7f4a_7c15;
    let mut worst = 0.0_f64;
    for _ in 0..POINTS {
        let (x, y) = (uniform(&mut state), uniform(&mut state));
        let x = equation.x.0 + (equation.x.1 - equation.x.0) * x;
        let y = equation.y.0 + (equation.y.1 - equation.y.0) * y;
        let found = value(&mut residual, x, y).abs() / (f64::EPSILON * value(&mut scale, x, y));
        worst = if found.is_nan() {
            f64::INFINITY
        } else {
            worst.max(found)
        };
    }
    worst
}

fn check(equations: &[Equation]) {
    let mut wrong = Vec::new();
    for equation in equations {
        let worst = largest(equation.residual, equation.scale, equation);
        println!("{worst:.2}: {}", equation.residual);
        if worst > MOST {
            wrong.push(format!("{worst:.1}: {}", equation.residual));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn bessel_functions_keep_their_equations() {
    check(&BESSEL);
}

#[test]
fn integrals_and_beta_keep_their_equations() {
    check(&INTEGRALS);
}

#[test]
fn polynomials_and_harmonics_keep_their_equations() {
    check(&POLYNOMIALS);
}

/// A part in 10¹² is seen.
#[test]
fn wrong_values_are_caught() {
    let wronskian = &BESSEL[0];
    let wrong = wronskian
        .residual
        .replacen("besselj(1, x)", "besselj(1, x) (1 + 2^-40)", 1);
    assert!(largest(&wrong, wronskian.scale, wronskian) > MOST);
}

/// What lies outside of the domain is not a number, at the ends of the domain it is what the limit is.
#[test]
fn outside_of_the_domain_there_is_no_number() {
    let outside = [
        "besselj(x, 2)",
        "besselj(x, 2 + i y) == besselj(x, 2 + i y)",
        "bessely(1, -x)",
        "besselk(0, -x)",
        "besseli(60 + 20 x, 1)",
        "e1(-x)",
        "ci(-x)",
        "li(-x)",
        "beta(-40 x, 2)",
        "beta(-2, x)",
        "legendre_p(x, 1/2)",
        "hermite_h(-3 + 0 y, x)",
        "laguerre_l(80 + 0 y, x)",
        "spherical_harmonic(2, 1, 0 x, 0, 0)",
    ];
    for body in outside {
        let body = if body.contains("==") {
            format!("if {body} then 1 else nan")
        } else {
            body.to_owned()
        };
        if ["-3 + 0 y", "80 + 0 y"].iter().any(|n| body.contains(n)) {
            // constants are an error; so that they are none, they hang on y
            let body = body.replace("0 y", "round(y)");
            assert!(real(&body, 0.9, 0.2).is_nan(), "{body}");
        } else {
            assert!(real(&body, 0.9, 0.2).is_nan(), "{body}");
        }
    }
    let limits = [
        ("besselj(0, x)", 0.0, 1.0),
        ("besselj(3, x)", 0.0, 0.0),
        ("besselj(2, x)", f64::INFINITY, 0.0),
        ("bessely(0, x)", 0.0, f64::NEG_INFINITY),
        ("bessely(2, x)", f64::INFINITY, 0.0),
        ("besseli(1, x)", f64::INFINITY, f64::INFINITY),
        ("besselk(1, x)", 0.0, f64::INFINITY),
        ("besselk(1, x)", f64::INFINITY, 0.0),
        ("e1(x)", 0.0, f64::INFINITY),
        ("e1(x)", f64::INFINITY, 0.0),
        ("ei(x)", 0.0, f64::NEG_INFINITY),
        ("ei(x)", f64::NEG_INFINITY, 0.0),
        ("ei(x)", f64::INFINITY, f64::INFINITY),
        ("si(x)", f64::INFINITY, std::f64::consts::FRAC_PI_2),
        ("ci(x)", f64::INFINITY, 0.0),
        ("ci(x)", 0.0, f64::NEG_INFINITY),
        ("li(x)", 0.0, 0.0),
        ("li(x)", 1.0, f64::NEG_INFINITY),
        ("fresnel_s(x)", f64::INFINITY, 0.5),
        ("fresnel_c(x)", f64::NEG_INFINITY, -0.5),
        ("beta(x, 2)", 0.0, f64::INFINITY),
        ("beta(x, 0.5)", -0.5, 0.0),
    ];
    for (body, x, expected) in limits {
        assert_eq!(
            real(&format!("{body} + 0 y"), x, 0.0),
            expected,
            "{body} at {x}"
        );
    }
}
