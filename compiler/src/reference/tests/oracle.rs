//! Every function of the tables that is implemented here, component by component.

use crate::reference::{Complex, real};

const REAL: &str = include_str!("../../../../tests/data/oracle/real.tsv");
const COMPLEX: &str = include_str!("../../../../tests/data/oracle/complex.tsv");

/// Name in the table, function, bound in ε.
type RealRow = (&'static str, fn(f64) -> f64, f64);
type ComplexRow = (&'static str, fn(Complex) -> Complex, f64);

fn numbers(line: &str) -> (&str, Vec<f64>) {
    let mut fields = line.split('\t');
    let name = fields.next().unwrap_or_default();
    (name, fields.map(|f| f.parse().expect("a number")).collect())
}

/// |got - want| in units of ε |want|, or of ε `floor` where |want| is below it.
fn error(got: f64, want: f64, floor: f64) -> f64 {
    if got == want {
        0.0
    } else {
        (got - want).abs() / (f64::EPSILON * want.abs().max(floor))
    }
}

/// Worst error of a function over its rows against the bound, in ε; where |want| is below `floor`, absolute.
#[track_caller]
fn check_real(name: &str, arity: usize, bound: f64, floor: f64, f: impl Fn(&[f64]) -> f64) {
    let mut rows = 0;
    let mut worst = (0.0, String::new());
    for (row, v) in REAL.lines().map(numbers) {
        if row != name {
            continue;
        }
        rows += 1;
        let (got, want) = (f(&v[..arity]), v[arity]);
        let e = error(got, want, floor);
        if e.is_nan() || e > worst.0 {
            worst = (
                e,
                format!("{name}{:?} = {got:e}, not {want:e}", &v[..arity]),
            );
        }
        if e.is_nan() {
            break;
        }
    }
    assert!(rows > 20, "no rows for {name}");
    println!("{name:10} {:8.2} of {bound:6} ε  {}", worst.0, worst.1);
    assert!(worst.0 <= bound, "{:.2} ε: {}", worst.0, worst.1);
}

/// As `check_real`, per component; where a component is below `floor` |want|, relative to that.
#[track_caller]
fn check_complex(name: &str, bound: f64, floor: f64, f: impl Fn(Complex) -> Complex) {
    let mut rows = 0;
    let mut worst = (0.0, String::new());
    for (row, v) in COMPLEX.lines().map(numbers) {
        if row != name {
            continue;
        }
        rows += 1;
        let got = f(Complex { re: v[0], im: v[1] });
        let norm = v[2].hypot(v[3]);
        let least = floor * norm;
        for (got, want) in [(got.re, v[2]), (got.im, v[3])] {
            // 60 digits of the whole number: a component 1e-50 times smaller has only ten
            let e = if (got - want).abs() < 1e-58 * norm {
                0.0
            } else {
                error(got, want, least)
            };
            assert!(!e.is_nan(), "{name}{:?}: NaN, not {want:e}", &v[..2]);
            if e > worst.0 {
                worst = (e, format!("{name}{:?} has {got:e}, not {want:e}", &v[..2]));
            }
        }
    }
    assert!(rows > 20, "no rows for {name}");
    println!("{name:10} {:8.2} of {bound:6} ε  {}", worst.0, worst.1);
    assert!(worst.0 <= bound, "{:.2} ε: {}", worst.0, worst.1);
}

#[test]
fn real_functions_of_one_argument() {
    let rows: [RealRow; 23] = [
        ("sin", real::sin, 1.0),
        ("cos", real::cos, 1.0),
        ("tan", real::tan, 1.0),
        ("asin", real::asin, 1.0),
        ("acos", real::acos, 1.0),
        ("atan", real::atan, 1.0),
        ("sinh", real::sinh, 1.5),
        ("cosh", real::cosh, 1.5),
        ("tanh", real::tanh, 1.5),
        ("asinh", real::asinh, 1.5),
        ("acosh", real::acosh, 2.0),
        ("atanh", real::atanh, 1.5),
        ("exp", real::exp, 1.0),
        ("exp2", real::exp2, 1.0),
        ("expm1", real::expm1, 1.0),
        ("log", real::log, 1.0),
        ("log2", real::log2, 1.0),
        ("log10", real::log10, 1.5),
        ("log1p", real::log1p, 1.0),
        ("sqrt", real::sqrt, 0.5),
        ("cbrt", real::cbrt, 1.0),
        ("sinc", real::sinc, 1.5),
        ("gamma", real::gamma, 16.0),
    ];
    for (name, f, bound) in rows {
        check_real(name, 1, bound, 0.0, |v| f(v[0]));
    }
}

#[test]
fn real_functions_of_two_arguments() {
    check_real("atan2", 2, 1.0, 0.0, |v| real::atan2(v[0], v[1]));
    check_real("hypot", 2, 1.0, 0.0, |v| real::hypot(v[0], v[1]));
    check_real("pow", 2, 1.0, 0.0, |v| real::pow(v[0], v[1]));
    check_real("mod", 2, 0.5, 0.0, |v| real::modulo(v[0], v[1]));
}

/// Left of 0 these have a zero between each two poles, where the reflection formula cancels: absolute there.
#[test]
fn logarithms_of_gamma() {
    check_real("lgamma", 1, 30.0, 1.0, |v| real::lgamma(v[0]));
    check_real("digamma", 1, 30.0, 1.0, |v| real::digamma(v[0]));
}

#[test]
fn complex_elementary_functions() {
    let rows: [ComplexRow; 18] = [
        ("exp", Complex::exp, 2.0),
        ("log", Complex::log, 1.0),
        ("sqrt", Complex::sqrt, 2.0),
        ("sin", Complex::sin, 2.0),
        ("cos", Complex::cos, 2.0),
        ("tan", Complex::tan, 4.0),
        ("sinh", Complex::sinh, 2.0),
        ("cosh", Complex::cosh, 2.0),
        ("tanh", Complex::tanh, 4.0),
        ("asin", Complex::asin, 5.0),
        ("acos", Complex::acos, 5.0),
        ("atan", Complex::atan, 4.0),
        ("asinh", Complex::asinh, 5.0),
        ("acosh", Complex::acosh, 5.0),
        ("atanh", Complex::atanh, 4.0),
        ("inverse", Complex::inverse, 2.0),
        ("square", Complex::square, 2.0),
        (
            "abs",
            |z| Complex {
                re: z.abs(),
                im: 0.0,
            },
            1.0,
        ),
    ];
    for (name, f, bound) in rows {
        check_complex(name, bound, 0.0, f);
    }
    check_complex("arg", 1.0, 0.0, |z| Complex {
        re: z.arg(),
        im: 0.0,
    });
}

/// z^7 and Γ have real and imaginary zeros that no product of rounded factors resolves: relative to the modulus.
#[test]
fn complex_powers_and_gamma() {
    check_complex("pow7", 10.0, 1.0, |z| z.powi(7));
    check_complex("pow7", 10.0, 1.0, |z| z.pow(Complex { re: 7.0, im: 0.0 }));
    check_complex("gamma", 90.0, 1.0, Complex::gamma);
    check_complex("digamma", 40.0, 1.0, Complex::digamma);
}

/// ψ′ is not in the tables: its defining recurrence, reflection and a value.
#[test]
fn trigamma_satisfies_its_equations() {
    let near = |a: f64, b: f64| assert!(error(a, b, 0.0) < 20.0, "{a:e} is not {b:e}");
    near(real::trigamma(1.0), std::f64::consts::PI.powi(2) / 6.0);
    near(real::trigamma(0.5), std::f64::consts::PI.powi(2) / 2.0);
    for x in [0.1, 0.7, 1.5, 3.2, 14.9, 40.0, -0.3, -2.7] {
        near(real::trigamma(x), real::trigamma(x + 1.0) + 1.0 / (x * x));
        let z = Complex { re: x, im: 1e-9 };
        near(z.trigamma().re, real::trigamma(x));
        let z = Complex { re: x, im: 0.75 };
        let difference = z.trigamma() - (z + Complex::ONE).trigamma() - z.square().inverse();
        assert!(
            difference.abs() < 1e-14 * z.trigamma().abs().max(1.0),
            "{z:?}"
        );
    }
}
