//! A function of its inverse is its argument, and has the slope 1. What the rounding of the inverse does to either is a
//! condition number, which stands beside each pair; the rest are declared bounds.

use pullback_compiler::What;
use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::error::Judge;
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::accuracy::tables::Domain;

use super::{machines, numbers, run, units};

/// f(g(x)) = x for x in a range.
struct Inverse {
    f: &'static str,
    g: &'static str,
    range: (f64, f64),
    /// g(x), in f64
    inner: fn(f64) -> f64,
    /// f′ at g(x)
    slope: fn(f64) -> f64,
    /// f″/f′ at g(x)
    bend: fn(f64) -> f64,
}

const INVERSES: [Inverse; 8] = [
    Inverse {
        f: "exp",
        g: "log",
        range: (1e-30, 1e30),
        inner: f64::ln,
        slope: |x| x,
        bend: |_| 1.0,
    },
    Inverse {
        f: "expm1",
        g: "log1p",
        range: (-0.9, 1e20),
        inner: f64::ln_1p,
        slope: |x| 1.0 + x,
        bend: |_| 1.0,
    },
    Inverse {
        f: "tan",
        g: "atan",
        range: (-1e5, 1e5),
        inner: f64::atan,
        slope: |x| 1.0 + x * x,
        bend: |x| 2.0 * x,
    },
    Inverse {
        f: "sinh",
        g: "asinh",
        range: (-1e20, 1e20),
        inner: f64::asinh,
        slope: |x| 1.0_f64.hypot(x),
        bend: |x| x / 1.0_f64.hypot(x),
    },
    Inverse {
        f: "cosh",
        g: "acosh",
        range: (1.01, 1e20),
        inner: f64::acosh,
        slope: |x| (x - 1.0).sqrt() * (x + 1.0).sqrt(),
        bend: |x| x / ((x - 1.0).sqrt() * (x + 1.0).sqrt()),
    },
    Inverse {
        f: "tanh",
        g: "atanh",
        range: (-0.99, 0.99),
        inner: f64::atanh,
        slope: |x| 1.0 - x * x,
        bend: |x| -2.0 * x,
    },
    Inverse {
        f: "sin",
        g: "asin",
        range: (-0.99, 0.99),
        inner: f64::asin,
        slope: |x| (1.0 - x * x).sqrt(),
        bend: |x| -x / (1.0 - x * x).sqrt(),
    },
    Inverse {
        f: "cos",
        g: "acos",
        range: (-0.99, 0.99),
        inner: f64::acos,
        slope: |x| -(1.0 - x * x).sqrt(),
        bend: |x| x / (1.0 - x * x).sqrt(),
    },
];

/// No inverse: what is no identity must be seen.
const CONTROL: Inverse = Inverse {
    f: "cos",
    g: "asin",
    range: (-0.99, 0.99),
    inner: f64::asin,
    slope: |x| (1.0 - x * x).sqrt(),
    bend: |_| 1.0,
};

/// The first place at which a pair is further from the identity than it may be.
fn fault(inverse: &Inverse, machine: &Machine, points: &[f64]) -> Option<String> {
    let Inverse { f, g, range, .. } = inverse;
    let xs: Vec<Vec<f64>> = points
        .iter()
        .filter(|x| **x > range.0 && **x < range.1 && **x != 0.0)
        .map(|x| vec![*x])
        .collect();
    assert!(xs.len() > 100, "{f}");
    let (of_f, slope_of_f) = units(f, Domain::Real, machine);
    let (of_g, slope_of_g) = units(g, Domain::Real, machine);
    let unit = |v: f64| machine.format().unit(v);
    let rows = run(
        machine,
        &format!("f(x: real) = {f}({g}(x))\n"),
        What::Gradient,
        &xs,
    );
    xs.iter().zip(&rows).find_map(|(x, row)| {
        let x = x[0];
        let inner = of_g.max(0.5) * unit((inverse.inner)(x));
        let moved = inner * (inverse.slope)(x).abs() + of_f.max(0.5) * unit(x);
        // second order, where the first is large
        let bend = inner * (inverse.bend)(x).abs();
        let value = moved * (1.0 + bend);
        let slope = bend * (1.0 + bend) + (slope_of_f + slope_of_g + 1.0) * unit(1.0);
        let wrong = (row[0] - x).abs() > value * (1.0 + 1e-6) || (row[1] - 1.0).abs() > slope;
        wrong.then(|| {
            format!(
                "{}: {f}({g}({x:e})) = {:e} with the slope {}; allowed {value:e} and {slope:e}",
                machine, row[0], row[1]
            )
        })
    })
}

#[test]
fn functions_of_their_inverses_are_the_identity_with_slope_one() {
    let mut points = numbers(1500, 60.0);
    points.extend(numbers(1500, 3.0));
    let mut wrong = Vec::new();
    for machine in &machines() {
        wrong.extend(
            INVERSES
                .iter()
                .filter_map(|pair| fault(pair, machine, &points)),
        );
        assert!(fault(&CONTROL, machine, &points).is_some());
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// sin² + cos² has no slope.
#[test]
fn the_circle_has_no_slope() {
    let points: Vec<Vec<f64>> = numbers(2000, 100.0).into_iter().map(|x| vec![x]).collect();
    for machine in &machines() {
        let unit = |v: f64| machine.format().unit(v);
        let (sin, slope_of_sin) = units("sin", Domain::Real, machine);
        let (cos, slope_of_cos) = units("cos", Domain::Real, machine);
        let circle = "f(x: real) = sin(x)^2 + cos(x)^2\n";
        let rows = run(machine, circle, What::Gradient, &points);
        let waves = "f(x: real) = complex(sin(x), cos(x))\n";
        let waves = run(machine, waves, What::Value, &points);
        for ((x, row), wave) in points.iter().zip(&rows).zip(&waves) {
            let (s, c) = (wave[0].abs(), wave[1].abs());
            let off_s = (sin + slope_of_cos) * unit(s);
            let off_c = (cos + slope_of_sin) * unit(c);
            // 2 s s′ + 2 c c′, and the rounding of each product
            let allowed = 2.0 * (off_s * c + off_c * s) + 4.0 * unit(s * c);
            assert!(
                row[1].abs() <= allowed,
                "{}: slope {:e} at {x:?}, above {allowed:e}",
                machine,
                row[1]
            );
            let near = 2.0 * (sin * unit(s) * s + cos * unit(c) * c) + 3.0 * unit(1.0);
            assert!((row[0] - 1.0).abs() <= near * (1.0 + 1e-6));
        }
    }
}

/// exp(log z) = z and √z² = z with the derivative 1, by norm; in pairs without derivatives, whose shaders take long.
#[test]
fn complex_functions_of_their_inverses_are_the_identity() {
    let flat = numbers(1600, 20.0);
    let points: Vec<Vec<f64>> = flat
        .chunks(2)
        .filter(|z| z[0] != 0.0 && z[1] != 0.0)
        .map(<[f64]>::to_vec)
        .collect();
    for machine in &machines() {
        let unit = |v: f64| machine.format().unit(v);
        let is_pair = machine.precision() == Some(Precision::Extended);
        let what = if is_pair {
            What::Value
        } else {
            What::Derivative
        };
        let (exp, slope_of_exp) = units("exp", Domain::Complex, machine);
        let (log, slope_of_log) = units("log", Domain::Complex, machine);
        let (sqrt, slope_of_sqrt) = units("sqrt", Domain::Complex, machine);
        let (square, _) = units("square", Domain::Complex, machine);
        // how much the rounding of the inner function does to the value, relative to it, and the bounds of the outer one
        let logarithm = |z: &[f64]| {
            let size = z[0].hypot(z[1]);
            let angle = z[1].atan2(z[0]);
            log * unit(size.ln()).hypot(unit(angle))
        };
        let root = |z: &[f64]| {
            let size = z[0].hypot(z[1]).sqrt();
            2.0 * 1.42 * sqrt * unit(size) / size
        };
        type Inner<'a> = &'a dyn Fn(&[f64]) -> f64;
        let cases: [(&str, Inner, f64, f64); 2] = [
            ("exp(log(z))", &logarithm, exp, slope_of_exp + slope_of_log),
            ("sqrt(z)^2", &root, square, slope_of_sqrt + 1.5),
        ];
        for (text, inner, outer, slope) in cases {
            let rows = run(machine, &format!("f(z: complex) = {text}\n"), what, &points);
            for (z, row) in points.iter().zip(&rows) {
                let size = z[0].hypot(z[1]);
                let moved = inner(z);
                let allowed = size * moved * (1.0 + moved) + 1.42 * outer * unit(size);
                let error = (row[0] - z[0]).hypot(row[1] - z[1]);
                assert!(
                    error <= allowed * (1.0 + 1e-6),
                    "{}: {text} at {z:?} is {row:?}",
                    machine
                );
                if !is_pair {
                    let error = (row[2] - 1.0).hypot(row[3]);
                    let allowed = moved * (1.0 + moved) + 1.42 * (slope + 3.0) * unit(1.0);
                    assert!(
                        error <= allowed,
                        "{}: slope of {text} at {z:?} is {row:?}",
                        machine
                    );
                }
            }
        }
    }
}
