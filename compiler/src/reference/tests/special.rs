//! Annex G: signed zeros, infinities, NaN, the sides of the cuts.

use crate::reference::{Complex, real};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

const INF: f64 = f64::INFINITY;
const NAN: f64 = f64::NAN;

fn c(re: f64, im: f64) -> Complex {
    Complex { re, im }
}

/// Equal bits, or both NaN, or within 2 ulp.
fn same(a: f64, b: f64) -> bool {
    (a.is_nan() && b.is_nan())
        || (a == b && a.is_sign_negative() == b.is_sign_negative())
        || (a - b).abs() <= 2.0 * f64::EPSILON * b.abs() && b != 0.0
}

#[track_caller]
fn check(name: &str, f: fn(Complex) -> Complex, rows: &[(f64, f64, f64, f64)]) {
    for &(x, y, re, im) in rows {
        let got = f(c(x, y));
        assert!(
            same(got.re, re) && same(got.im, im),
            "{name}({x}, {y}) = {got:?}, not ({re}, {im})"
        );
        let got = f(c(x, -y));
        let im_ok = same(got.im, -im);
        assert!(
            same(got.re, re) && im_ok,
            "{name}({x}, {}) = {got:?}, not ({re}, {})",
            -y,
            -im
        );
    }
}

#[test]
fn exponential_logarithm_root() {
    check(
        "exp",
        Complex::exp,
        &[
            (0.0, 0.0, 1.0, 0.0),
            (-0.0, 0.0, 1.0, 0.0),
            (1.0, INF, NAN, NAN),
            (INF, 0.0, INF, 0.0),
            (-INF, 1.0, 0.0, 0.0),
            (-INF, 2.0, -0.0, 0.0),
            (INF, 2.0, -INF, INF),
            (INF, INF, INF, NAN),
            (NAN, 0.0, NAN, 0.0),
            (NAN, 1.0, NAN, NAN),
        ],
    );
    check(
        "log",
        Complex::log,
        &[
            (-0.0, 0.0, -INF, PI),
            (0.0, 0.0, -INF, 0.0),
            (1.0, INF, INF, FRAC_PI_2),
            (1.0, NAN, NAN, NAN),
            (-INF, 1.0, INF, PI),
            (INF, 1.0, INF, 0.0),
            (-INF, INF, INF, 3.0 * FRAC_PI_4),
            (INF, INF, INF, FRAC_PI_4),
            (INF, NAN, INF, NAN),
            (NAN, INF, INF, NAN),
            (-1.0, 0.0, 0.0, PI),
            (1.0, 0.0, 0.0, 0.0),
        ],
    );
    check(
        "sqrt",
        Complex::sqrt,
        &[
            (0.0, 0.0, 0.0, 0.0),
            (-0.0, 0.0, 0.0, 0.0),
            (1.0, INF, INF, INF),
            (NAN, INF, INF, INF),
            (-INF, 1.0, 0.0, INF),
            (INF, 1.0, INF, 0.0),
            (INF, NAN, INF, NAN),
            (NAN, 1.0, NAN, NAN),
            (-4.0, 0.0, 0.0, 2.0),
            (
                1e308,
                1e308,
                1.098_684_113_467_81e154,
                4.550_898_605_622_274e153,
            ),
            (5e-324, 0.0, 2.222_758_749_485_077_5e-162, 0.0),
        ],
    );
}

/// e^710 overflows, its product with cos π/4 does not.
#[test]
fn no_spurious_overflow() {
    let w = c(710.0, FRAC_PI_4).exp();
    assert!(w.is_finite() && w.re > 1.57e308 && w.im > 1.57e308, "{w:?}");
    assert!(c(710.0, FRAC_PI_4).sinh().is_finite() && c(FRAC_PI_4, 710.0).cos().is_finite());
    assert!(c(1e308, 1e308).log().is_finite() && c(1e200, 1e200).asin().is_finite());
}

#[test]
fn hyperbolic() {
    check(
        "sinh",
        Complex::sinh,
        &[
            (0.0, 0.0, 0.0, 0.0),
            (0.0, INF, 0.0, NAN),
            (1.0, INF, NAN, NAN),
            (INF, 0.0, INF, 0.0),
            (INF, 2.0, -INF, INF),
            (INF, INF, INF, NAN),
            (NAN, 0.0, NAN, 0.0),
            (NAN, 1.0, NAN, NAN),
        ],
    );
    check(
        "cosh",
        Complex::cosh,
        &[
            (0.0, 0.0, 1.0, 0.0),
            (INF, 0.0, INF, 0.0),
            (-INF, 0.0, INF, -0.0),
            (INF, 2.0, -INF, INF),
            (INF, INF, INF, NAN),
            (1.0, INF, NAN, NAN),
            (NAN, 0.0, NAN, 0.0),
        ],
    );
    check(
        "tanh",
        Complex::tanh,
        &[
            (0.0, 0.0, 0.0, 0.0),
            (INF, 1.0, 1.0, 0.0),
            (INF, 2.0, 1.0, -0.0),
            (-INF, 1.0, -1.0, 0.0),
            (INF, INF, 1.0, 0.0),
            (0.0, INF, 0.0, NAN),
            (1.0, INF, NAN, NAN),
            (NAN, 0.0, NAN, 0.0),
            (
                50.0,
                1.0,
                1.0,
                4.0 * 1.0_f64.sin() * 1.0_f64.cos() * (-100.0_f64).exp(),
            ),
        ],
    );
}

#[test]
fn inverse() {
    check(
        "acos",
        Complex::acos,
        &[
            (0.0, 0.0, FRAC_PI_2, -0.0),
            (0.0, NAN, FRAC_PI_2, NAN),
            (1.0, INF, FRAC_PI_2, -INF),
            (-INF, 1.0, PI, -INF),
            (INF, 1.0, 0.0, -INF),
            (-INF, INF, 3.0 * FRAC_PI_4, -INF),
            (INF, INF, FRAC_PI_4, -INF),
            (1.0, 0.0, 0.0, -0.0),
            (2.0, 0.0, 0.0, -1.316_957_896_924_816_6),
        ],
    );
    check(
        "acosh",
        Complex::acosh,
        &[
            (0.0, 0.0, 0.0, FRAC_PI_2),
            (-0.0, 0.0, 0.0, FRAC_PI_2),
            (1.0, INF, INF, FRAC_PI_2),
            (-INF, 1.0, INF, PI),
            (INF, 1.0, INF, 0.0),
            (-INF, INF, INF, 3.0 * FRAC_PI_4),
            (INF, NAN, INF, NAN),
        ],
    );
    check(
        "asinh",
        Complex::asinh,
        &[
            (0.0, 0.0, 0.0, 0.0),
            (-0.0, 0.0, -0.0, 0.0),
            (1.0, INF, INF, FRAC_PI_2),
            (INF, 1.0, INF, 0.0),
            (INF, INF, INF, FRAC_PI_4),
            (INF, NAN, INF, NAN),
            (NAN, 0.0, NAN, 0.0),
            (0.0, 2.0, 1.316_957_896_924_816_6, FRAC_PI_2),
            (-0.0, 2.0, -1.316_957_896_924_816_6, FRAC_PI_2),
        ],
    );
    check(
        "atanh",
        Complex::atanh,
        &[
            (0.0, 0.0, 0.0, 0.0),
            (1.0, INF, 0.0, FRAC_PI_2),
            (INF, 1.0, 0.0, FRAC_PI_2),
            (INF, INF, 0.0, FRAC_PI_2),
            (INF, NAN, 0.0, NAN),
            (0.0, NAN, 0.0, NAN),
            (2.0, 0.0, 0.549_306_144_334_054_8, FRAC_PI_2),
            (1e200, 1.0, 1e-200, FRAC_PI_2),
        ],
    );
    assert!(c(1.0, 0.0).atanh().re == INF);
}

#[test]
fn arithmetic() {
    assert!((c(INF, NAN) * c(1.0, 1.0)).is_infinite());
    assert!((c(1e300, 1e300) * c(1e300, 1e300)).is_infinite());
    assert!((c(1.0, 1.0) / Complex::ZERO).is_infinite());
    assert_eq!(c(1.0, 1.0) / c(INF, 3.0), Complex::ZERO);
    assert!((c(INF, INF) / c(1.0, 2.0)).is_infinite());
    for k in [-1074, -1040, -700, 0, 700, 1023] {
        let s = 2f64.powf(f64::from(k));
        assert_eq!(c(s, s) / c(s, s), Complex::ONE, "2^{k}");
    }
    assert_eq!(c(3.0, 4.0) * c(3.0, -4.0), c(25.0, 0.0));
    assert_eq!(c(1e-300, 1e-300) / c(1e-300, 0.0), c(1.0, 1.0));
    assert_eq!(c(1e300, 0.0) / c(0.0, 1e-5), c(0.0, -1e305));
}

#[test]
fn powers() {
    assert_eq!(Complex::ZERO.pow(Complex::ZERO), Complex::ONE);
    assert_eq!(Complex::ZERO.pow(c(2.5, 1.0)), Complex::ZERO);
    assert_eq!(c(2.0, 0.0).pow(c(10.0, 0.0)), c(1024.0, 0.0));
    assert_eq!(Complex::I.pow(c(3.0, 0.0)), c(0.0, -1.0));
    assert_eq!(c(0.0, 2.0).powi(-2), c(-0.25, 0.0));
    assert_eq!(c(NAN, 1.0).powi(0), Complex::ONE);
    let w = Complex::I.pow(Complex::I); // e^(-π/2)
    assert!(
        (w.re - (-FRAC_PI_2).exp()).abs() < 1e-16 && w.im == 0.0,
        "{w:?}"
    );
}

#[test]
fn general_powers_agree_with_their_definition() {
    for (x, y) in [
        (0.3, 2.0),
        (2.0, 0.3),
        (-0.3, 2.0),
        (-2.0, 0.3),
        (-2.0, -0.3),
        (0.3, -2.0),
        (1.0, 1.0),
    ] {
        for w in [c(0.5, 0.0), c(2.5, -1.5), c(-1.25, 3.0), c(0.0, 1.0)] {
            let (got, want) = (c(x, y).pow(w), (w * c(x, y).log()).exp());
            assert!(
                (got - want).abs() < 1e-14 * want.abs(),
                "({x}, {y})^{w:?} = {got:?}, not {want:?}"
            );
        }
    }
    assert_eq!(c(-4.0, 0.0).pow(c(0.5, 0.0)), c(0.0, 2.0));
    assert_eq!(c(-4.0, -0.0).pow(c(1.5, 0.0)).re, 0.0);
}

#[test]
fn real_special_values() {
    assert_eq!(real::fract(-1e-30), 1.0 - f64::EPSILON / 2.0);
    assert_eq!(real::modulo(-1e-30, 2.0), 2.0 - f64::EPSILON);
    assert_eq!(real::modulo(-7.0, 3.0), 2.0);
    assert_eq!(real::modulo(7.0, -3.0), -2.0);
    assert_eq!(real::sinc(0.0), 1.0);
    assert_eq!(real::sign(-0.0).to_bits(), 0);
    assert_eq!(real::round(-2.5), -3.0);
    assert_eq!(real::gamma(5.0), 24.0);
    assert_eq!(real::gamma(-0.0), -INF);
    assert!(real::gamma(-3.0).is_nan());
    assert_eq!(real::lgamma(1.0), 0.0);
    assert_eq!(real::lgamma(2.0), 0.0);
    assert_eq!(real::lgamma(-3.0), INF);
    assert!(real::atanh(1.0) == INF && real::atanh(1.5).is_nan() && real::acosh(0.5).is_nan());
    assert!(real::asinh(-0.0).is_sign_negative() && real::atanh(-0.0).is_sign_negative());
}
