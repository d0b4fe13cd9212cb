//! Spherical Bessel functions, the coefficients of waves and exponentials in Legendre polynomials (DLMF 10.60.7-8):
//! ∫ Pₙ(s) e^{iωs} ds = 2 iⁿ jₙ(ω) and ∫ Pₙ(s) e^{βs} ds = 2 iₙ(β) over [-1, 1].

use super::cardinal::exprel;
use super::real::sinc;

/// The highest order.
pub const MAX_SPHERICAL: u8 = 32;

/// xⁿ/(2n + 1)!! Σ (sign x²/2)ᵏ / (k! (2n + 3)(2n + 5)…) (DLMF 10.53).
fn series(n: u8, x: f64, sign: f64) -> f64 {
    let mut first = 1.0;
    for k in 1..=n {
        first *= x / (2.0 * f64::from(k) + 1.0);
    }
    let step = sign * 0.5 * x * x;
    let sum = (1..=40).rev().fold(1.0, |sum, k| {
        let k = f64::from(k);
        1.0 + step / (k * (2.0 * (f64::from(n) + k) + 1.0)) * sum
    });
    first * sum
}

/// jₙ(x): the series where it does not cancel, from x = 1.3 n on the recurrence (DLMF 10.51.1) upwards, between the two
/// downwards (Miller's algorithm, DLMF 3.6.ii).
pub fn spherical_j(n: u8, x: f64) -> f64 {
    let order = f64::from(n);
    if x.is_nan() {
        return x;
    }
    if x.is_infinite() {
        return 0.0;
    }
    let a = x.abs();
    let size = if n == 0 {
        sinc(a)
    } else if a * a < 2.0 * order + 3.0 {
        series(n, a, -1.0)
    } else if a >= 1.3 * order {
        upwards(n, a)
    } else {
        downwards(n, a)
    };
    if x < 0.0 && n % 2 == 1 { -size } else { size }
}

fn first_order(x: f64) -> f64 {
    (sinc(x) - x.cos()) / x
}

fn upwards(n: u8, x: f64) -> f64 {
    let (mut value, mut last) = (first_order(x), sinc(x));
    for k in 1..n {
        (value, last) = ((2.0 * f64::from(k) + 1.0) / x * value - last, value);
    }
    value
}

fn downwards(n: u8, x: f64) -> f64 {
    let (mut value, mut above, mut wanted) = (1e-200, 0.0, 0.0);
    for k in (0..n + n / 2 + 40).rev() {
        // the orders k + 1 and k + 2 give k
        (value, above) = ((2.0 * f64::from(k) + 3.0) / x * value - above, value);
        if k == n {
            wanted = value;
        }
    }
    if value.abs() > above.abs() {
        wanted / value * sinc(x)
    } else {
        wanted / above * first_order(x)
    }
}

/// e^{-|x|} iₙ(x) (DLMF 10.47.7, iₙ⁽¹⁾): the series, which does not cancel, for small x; the finite sum of DLMF 10.49.8
/// where its terms fall; between the two the recurrence downwards.
pub fn spherical_i_scaled(n: u8, x: f64) -> f64 {
    if x.is_nan() {
        return x;
    }
    let order = f64::from(n);
    let a = x.abs();
    let size = if n == 0 {
        exprel(-2.0 * a)
    } else if a * a < 4.0 * order + 6.0 {
        series(n, a, 1.0) * (-a).exp()
    } else if a > 2.0 * order * (order + 1.0) {
        finite_sum(n, a)
    } else {
        modified_downwards(n, a)
    };
    if x < 0.0 && n % 2 == 1 { -size } else { size }
}

/// Σ (-1)ᵏ c (2x)⁻ᵏ ∓ e^{-2x} Σ c (2x)⁻ᵏ, over 2x, with c = (n + k)!/(k! (n - k)!).
fn finite_sum(n: u8, x: f64) -> f64 {
    let order = f64::from(n);
    let sum = |r: f64| {
        (0..n).rev().fold(1.0, |sum, k| {
            let k = f64::from(k);
            1.0 + (order + k + 1.0) * (order - k) / (k + 1.0) * r * sum
        })
    };
    let r = 0.5 / x;
    let falling = (-2.0 * x).exp() * sum(r);
    let rest = if n.is_multiple_of(2) {
        -falling
    } else {
        falling
    };
    if r == 0.0 { 0.0 } else { (sum(-r) + rest) * r }
}

fn modified_downwards(n: u8, x: f64) -> f64 {
    let order = f64::from(n);
    let (mut value, mut above, mut wanted) = (1e-200, 0.0, 0.0);
    let mut k = (order * order + 40.0 * x).sqrt().ceil() + 10.0;
    while k > 0.0 {
        k -= 1.0;
        (value, above) = ((2.0 * k + 3.0) / x * value + above, value);
        if k == order {
            wanted = value;
        }
    }
    wanted / value * exprel(-2.0 * x)
}
