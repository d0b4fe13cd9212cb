//! Real functions of f64.
//!
//! Where `std` is good to an ulp over the whole range it is used; the rest is written here. The gamma family is in
//! [`super::gamma`].

pub use super::gamma::{digamma, gamma, lgamma, trigamma};

/// sin x.
pub fn sin(x: f64) -> f64 {
    x.sin()
}

/// cos x.
pub fn cos(x: f64) -> f64 {
    x.cos()
}

/// tan x.
pub fn tan(x: f64) -> f64 {
    x.tan()
}

/// arcsin x, NaN outside [-1, 1].
pub fn asin(x: f64) -> f64 {
    x.asin()
}

/// arccos x, NaN outside [-1, 1].
pub fn acos(x: f64) -> f64 {
    x.acos()
}

/// arctan x.
pub fn atan(x: f64) -> f64 {
    x.atan()
}

/// The angle of (x, y), in [-pi, pi], signed zeros as in C99 F.9.1.4.
pub fn atan2(y: f64, x: f64) -> f64 {
    y.atan2(x)
}

/// sinh x.
pub fn sinh(x: f64) -> f64 {
    x.sinh()
}

/// cosh x.
pub fn cosh(x: f64) -> f64 {
    x.cosh()
}

/// tanh x.
pub fn tanh(x: f64) -> f64 {
    x.tanh()
}

/// arsinh x = sign(x) log1p(|x| + x² / (1 + √(1 + x²))), Kahan 1987.
pub fn asinh(x: f64) -> f64 {
    let a = x.abs();
    let r = if a > 1e9 {
        a.ln() + std::f64::consts::LN_2
    } else {
        (a + a * a / (1.0 + (1.0 + a * a).sqrt())).ln_1p()
    };
    r.copysign(x)
}

/// arcosh x = log1p(t + √(2t + t²)) with t = x - 1, which is exact where it matters; NaN below 1.
pub fn acosh(x: f64) -> f64 {
    if x > 1e9 {
        return x.ln() + std::f64::consts::LN_2;
    }
    let t = x - 1.0;
    if t < 0.0 {
        f64::NAN
    } else {
        (t + (t * (t + 2.0)).sqrt()).ln_1p()
    }
}

/// artanh x = sign(x) log1p(2|x| / (1 - |x|)) / 2, infinite at ±1, NaN beyond.
pub fn atanh(x: f64) -> f64 {
    let a = x.abs();
    (0.5 * (2.0 * a / (1.0 - a)).ln_1p()).copysign(x)
}

/// e^x.
pub fn exp(x: f64) -> f64 {
    x.exp()
}

/// 2^x.
pub fn exp2(x: f64) -> f64 {
    x.exp2()
}

/// e^x - 1 without cancellation.
pub fn expm1(x: f64) -> f64 {
    x.exp_m1()
}

/// log x, NaN below 0.
pub fn log(x: f64) -> f64 {
    x.ln()
}

/// log2 x, NaN below 0.
pub fn log2(x: f64) -> f64 {
    x.log2()
}

/// log10 x, NaN below 0.
pub fn log10(x: f64) -> f64 {
    x.log10()
}

/// log(1 + x) without cancellation, NaN below -1.
pub fn log1p(x: f64) -> f64 {
    x.ln_1p()
}

/// x^y as in C99 F.9.4.4: x^0 = 1 for every x; a negative x has powers for integer y only.
pub fn pow(x: f64, y: f64) -> f64 {
    x.powf(y)
}

/// x^n by the correctly reduced `pow`; the exponent is exact.
pub fn powi(x: f64, n: i32) -> f64 {
    x.powf(f64::from(n))
}

/// log(1 + e^x) without overflow.
pub fn log1pexp(x: f64) -> f64 {
    let rest = (-x.abs()).exp().ln_1p();
    if x > 0.0 { x + rest } else { rest }
}

/// x² + p, rounded once.
pub fn square_plus(x: f64, p: f64) -> f64 {
    x.mul_add(x, p)
}

/// a + b - s exactly, where s is near the sum, 0 where that is no number (Knuth, TAOCP 2, 4.2.2).
pub fn sum_rest(a: f64, b: f64, s: f64) -> f64 {
    let (sum, rest) = super::complex::two_sum(a, b);
    let rest = (sum - s) + rest;
    if rest.is_finite() { rest } else { 0.0 }
}

/// a b + c - s exactly, where s is near that, 0 where that is no number.
pub fn mul_add_rest([a, b, c]: [f64; 3], s: f64) -> f64 {
    let (product, low) = super::complex::two_product(a, b);
    let (sum, rest) = super::complex::two_sum(product, c);
    let rest = (sum - s) + (rest + low);
    if rest.is_finite() { rest } else { 0.0 }
}

/// a b - p exactly, where p is near the product, 0 where that is no number (Dekker 1971).
pub fn product_rest(a: f64, b: f64, p: f64) -> f64 {
    let (product, low) = super::complex::two_product(a, b);
    let rest = (product - p) + low;
    if rest.is_finite() { rest } else { 0.0 }
}

/// √x, NaN below 0.
pub fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

/// The real cube root, odd.
pub fn cbrt(x: f64) -> f64 {
    x.cbrt()
}

/// √(x² + y²) without spurious overflow or underflow.
pub fn hypot(x: f64, y: f64) -> f64 {
    x.hypot(y)
}

/// √(x² + y² + z²) without spurious overflow or underflow.
pub fn hypot3(x: f64, y: f64, z: f64) -> f64 {
    x.hypot(y).hypot(z)
}

/// sin x / x, 1 at 0, 0 at ±∞. Not the normalised sin πx / πx.
pub fn sinc(x: f64) -> f64 {
    if x == 0.0 {
        1.0
    } else if x.is_infinite() {
        0.0
    } else {
        x.sin() / x
    }
}

/// The largest number nearer to 0 than the finite nonzero `x`.
fn shrink(x: f64) -> f64 {
    f64::from_bits(x.to_bits() - 1)
}

/// x - y ⌊x / y⌋: the sign of y, and |result| < |y| even where the exact value rounds to y. NaN for y = 0.
pub fn modulo(x: f64, y: f64) -> f64 {
    let r = x % y; // IEEE remainder towards zero: exact
    if r == 0.0 {
        return 0.0_f64.copysign(y);
    }
    if (r < 0.0) == (y < 0.0) || r.is_nan() {
        return r;
    }
    let sum = r + y;
    if sum.abs() >= y.abs() && y.is_finite() {
        shrink(y)
    } else {
        sum
    }
}

/// x - ⌊x⌋, in [0, 1): a tiny negative x gives the largest number below 1.
pub fn fract(x: f64) -> f64 {
    let r = x - x.floor();
    if r >= 1.0 { shrink(1.0) } else { r }
}

/// x rounded to the nearest integer, halves away from zero.
pub fn round(x: f64) -> f64 {
    x.round()
}

/// -1, 0 or 1; 0 for both zeros; NaN for NaN.
pub fn sign(x: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else if x.is_nan() {
        x
    } else {
        1.0_f64.copysign(x)
    }
}
