//! Slopes: derivatives of the inverse functions and of lengths, real and complex, without overflow on the way.

use super::complex::{Complex, complex};
use super::real;

/// x^(y + c) for a whole c: with the rounded sum s and its error e, x^s e^(e log |x|), where |e log |x|| is at most
/// 2⁻⁴³ unless x^s is infinite or 0.
pub fn pow_shift(x: f64, y: f64, c: f64) -> f64 {
    let s = y + c;
    let e = sum_error(y, c, s);
    if !y.is_finite() || e == 0.0 || x == 0.0 || !x.is_finite() {
        return real::pow(x, s);
    }
    if x < 0.0 && y.fract() != 0.0 {
        return f64::NAN;
    }
    // of x = |x|, for s may have another parity than y + c
    let odd = is_odd(y) != is_odd(c);
    let power = real::pow(x.abs(), s) * (1.0 + e * x.abs().ln());
    if odd { power.copysign(x) } else { power }
}

fn is_odd(y: f64) -> bool {
    y.rem_euclid(2.0) == 1.0
}

/// a + b - s exactly for the rounded sum s (Knuth, TAOCP 2, 4.2.2).
fn sum_error(a: f64, b: f64, s: f64) -> f64 {
    let u = s - a;
    (a - (s - u)) + (b - u)
}

/// z^(w + c) for a whole real c, likewise.
pub fn complex_pow_shift(z: Complex, w: Complex, c: Complex) -> Complex {
    let s = complex(w.re + c.re, w.im);
    let e = sum_error(w.re, c.re, s.re);
    let power = z.pow(s);
    if !w.re.is_finite() || e == 0.0 || z == Complex::ZERO || !z.is_finite() {
        return power;
    }
    let log = z.log();
    power * complex(1.0 + e * log.re, e * log.im)
}

/// 1/(1 + x²).
pub fn atan(x: f64) -> f64 {
    1.0 / (1.0 + x * x)
}

/// 1/(1 - x²).
pub fn atanh(x: f64) -> f64 {
    1.0 / ((1.0 - x) * (1.0 + x))
}

/// 1/√(1 - x²).
pub fn asin(x: f64) -> f64 {
    1.0 / ((1.0 - x) * (1.0 + x)).sqrt()
}

/// 1/√(1 + x²).
pub fn asinh(x: f64) -> f64 {
    1.0 / 1.0_f64.hypot(x)
}

/// 1/√(x² - 1), NaN below 1.
pub fn acosh(x: f64) -> f64 {
    1.0 / ((x - 1.0).sqrt() * (x + 1.0).sqrt())
}

/// x/r for r = |(x, y, z)|, and 0 at the origin. Where r overflows, that of a quarter of the point.
pub fn direction(x: f64, y: f64, z: f64, r: f64) -> f64 {
    if r.is_infinite() && x.is_finite() && y.is_finite() && z.is_finite() {
        let (x, y, z) = (0.25 * x, 0.25 * y, 0.25 * z);
        return x / x.hypot(y.hypot(z));
    }
    if r == 0.0 { 0.0 } else { x / r }
}

/// 1 - z with the sign of a zero turned, and 1 + z: the sides of the cuts.
fn sides(z: Complex) -> (Complex, Complex) {
    (complex(1.0 - z.re, -z.im), complex(1.0 + z.re, z.im))
}

/// Of an even function that is real on the real axis, so that it is both bit for bit: a product is not the same in both
/// orders of its factors. f(-z̄) is the conjugate of f(z).
fn in_right_half(z: Complex, f: impl Fn(Complex) -> Complex) -> Complex {
    let value = f(complex(z.re.abs(), z.im));
    if z.re.is_sign_negative() {
        value.conj()
    } else {
        value
    }
}

/// 1/(1 + z²).
pub fn complex_atan(z: Complex) -> Complex {
    complex_atanh(z.mul_i())
}

/// 1/(1 - z²), of a z scaled by a power of two where its square would overflow; 1 - x² + y² is summed with the errors of
/// its terms, so that each component has its digits.
pub fn complex_atanh(z: Complex) -> Complex {
    let size = z.re.abs().max(z.im.abs());
    if !size.is_finite() {
        let (below, above) = sides(z);
        return below.inverse() * above.inverse();
    }
    let scale = if size > 1.0 {
        power_of_two_below(size).recip()
    } else {
        1.0
    };
    let v = z.scale(scale);
    let (xx, yy) = (v.re * v.re, v.im * v.im);
    let lost = v.im.mul_add(v.im, -yy) - v.re.mul_add(v.re, -xx);
    let difference = yy - xx;
    let sum = difference + scale * scale;
    let rest = sum_error(yy, -xx, difference) + sum_error(difference, scale * scale, sum);
    let inverse = complex(sum + (rest + lost), -2.0 * v.re * v.im).inverse();
    inverse.scale(scale).scale(scale)
}

/// The greatest power of two that is not above a number from 1 on.
fn power_of_two_below(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & (0x7ff << 52))
}

/// x y / part by a quotient that does not overflow where the part is more than a trifle of `other`; else `other`, which
/// then has not cancelled.
fn part_of_root(x: f64, y: f64, part: f64, other: f64) -> f64 {
    if part.abs() > 1e-9 * other.abs() {
        x / part * y
    } else {
        other
    }
}

/// 1/(√(1 - z) √(1 + z)), whose cuts are those of arcsin (Kahan 1987). Of the product s one component is a sum of terms of
/// one sign, and the other follows from s² = 1 - z².
pub fn complex_asin(z: Complex) -> Complex {
    in_right_half(z, |z| {
        let (below, above) = sides(z);
        let (below, above) = (below.sqrt(), above.sqrt());
        let re = below.re * above.re + (below.im * above.im).abs();
        let im = below.re * above.im + below.im * above.re;
        complex(re, part_of_root(-z.re, z.im, re, im)).inverse()
    })
}

/// 1/(√(1 + i z) √(1 - i z)), whose cuts are those of arsinh.
pub fn complex_asinh(z: Complex) -> Complex {
    complex_asin(z.mul_i())
}

/// 1/(√(z - 1) √(z + 1)), whose cut is that of arcosh, likewise.
pub fn complex_acosh(z: Complex) -> Complex {
    let (below, above) = (complex(z.re - 1.0, z.im), complex(z.re + 1.0, z.im));
    let (below, above) = (below.sqrt(), above.sqrt());
    let re = below.re * above.re - below.im * above.im;
    let im = below.re * above.im + below.im * above.re;
    complex(part_of_root(z.re, z.im, im, re), im).inverse()
}
