//! Integrals of rational functions over [0, 1] that are 1 or near it at 0, where the quotients that they are written as
//! have 0/0: arctangent and logarithm, each divided by its argument, and what their derivatives need.

use super::complex::{Complex, complex};

/// ∫₀¹ s^{b-1} / (1 + z s²) ds by Gauss' continued fraction, -0.9 ≤ z ≤ 3:
/// 1/(b + b² z/(b + 2 + 2² z/(b + 4 + (b + 2)² z/(b + 6 + 4² z/(b + 8 + …))))). (Cuyt, Petersen, Verdonk, Waadeland,
/// Jones, "Handbook of Continued Fractions for Special Functions", 2008, section 15.3, for F(1, b/2; b/2 + 1; -z).)
fn moment_fraction(b: f64, z: f64) -> f64 {
    const LEVELS: i32 = 64;
    let mut value = b + 2.0 * f64::from(LEVELS);
    for k in (0..LEVELS).rev() {
        // level k has the numerator (b + k)² for even k, (k + 1)² for odd
        let root = if k % 2 == 0 {
            b + f64::from(k)
        } else {
            f64::from(k) + 1.0
        };
        value = b + 2.0 * f64::from(k) + root * root * z / value;
    }
    1.0 / value
}

/// Whether the continued fraction is quick.
fn is_moderate(z: f64) -> bool {
    (-0.9..3.0).contains(&z)
}

/// -b/a, 0 where a is next to nothing or the quotient is no number of moderate size.
pub fn foot(a: f64, b: f64) -> f64 {
    let place = -b / a;
    let is_moderate = a.abs() > 1e-30 && place.abs() < 1e30;
    if is_moderate { place } else { 0.0 }
}

/// ∫₀¹ s^{2n} / (1 + z s²) ds: for n = 0 atan(√z)/√z, continued through 0 to artanh(√-z)/√-z. Infinite at -1, NaN below.
pub fn atan_quotient(n: u8, z: f64) -> f64 {
    if z.is_nan() || z < -1.0 {
        return f64::NAN;
    }
    if z == -1.0 || z == f64::INFINITY {
        return if z < 0.0 { f64::INFINITY } else { 0.0 };
    }
    let b = 2.0 * f64::from(n) + 1.0;
    if n > 0 && is_moderate(z) {
        return moment_fraction(b, z);
    }
    (0..n).fold(first_moment(z), |value, k| {
        (1.0 / (2.0 * f64::from(k) + 1.0) - value) / z
    })
}

/// atan(√z)/√z for z > -1.
fn first_moment(z: f64) -> f64 {
    let root = z.abs().sqrt();
    if z.abs() < 1e-17 {
        1.0
    } else if z > 0.0 {
        root.atan() / root
    } else if z > -0.25 {
        root.atanh() / root
    } else {
        // log((1 + r)/√(1 - r²))
        (root.ln_1p() - 0.5 * z.ln_1p()) / root
    }
}

/// ∫ₓ^∞ du/(u² + p) = atan2(√p, x)/√p: for x > 0 atan_quotient(0, p/x²)/x, for x ≤ 0 and p > 0 beyond a quarter turn.
/// Infinite where the pole is at the end, NaN where the integral has none.
pub fn atan2_quotient(p: f64, x: f64) -> f64 {
    if p.is_nan() || x.is_nan() {
        return f64::NAN;
    }
    if x == f64::INFINITY || p == f64::INFINITY {
        return 0.0;
    }
    if x > 0.0 && p < x * x && p > -0.5 * x * x {
        return atan_quotient(0, p / x / x) / x;
    }
    if p > 0.0 {
        let root = p.sqrt();
        return root.atan2(x) / root;
    }
    let edge = (-p).sqrt();
    if x <= 0.0 {
        // at a double root the integrand has one sign
        return if p == 0.0 { f64::INFINITY } else { f64::NAN };
    }
    let rest = x.mul_add(x, p);
    if rest < 0.0 {
        f64::NAN
    } else if rest == 0.0 {
        f64::INFINITY
    } else {
        ((x + edge) / rest.sqrt()).ln() / edge
    }
}

/// ∫₀¹ (1 - t)ⁿ / (1 + x t) dt for -0.6 ≤ x ≤ 3 by Gauss' continued fraction (section 15.3, for F(1, 1; n + 2; -x)):
/// 1/(n + 1 + (n + 1) x/(n + 2 + (n + 1) x/(n + 3 + 2 (n + 2) x/(n + 4 + 2 (n + 2) x/(n + 5 + …))))).
fn falling_fraction(n: f64, x: f64) -> f64 {
    const LEVELS: i32 = 48;
    let mut value = n + 1.0 + f64::from(LEVELS);
    for k in (0..LEVELS).rev() {
        let m = f64::from(k / 2 + 1);
        value = n + 1.0 + f64::from(k) + m * (n + m) * x / value;
    }
    1.0 / value
}

/// ∫₀¹ sⁿ / (1 + x s)^{n+1} ds: for n = 0 log(1 + x)/x. The derivative is -(n + 1) times the next one.
///
/// It is (1 + x)^{-n} ∫₀¹ (1 - t)ⁿ / (1 + x t) dt (DLMF 15.8.1), and x times that integral is 1 + x times the one of n - 1,
/// less 1/n.
pub fn log1prel(n: u8, x: f64) -> f64 {
    if x.is_nan() || x < -1.0 {
        return f64::NAN;
    }
    if x == -1.0 || x == f64::INFINITY {
        return if x < 0.0 { f64::INFINITY } else { 0.0 };
    }
    let base = 1.0 + x;
    let integral = if n > 0 && (-0.6..3.0).contains(&x) {
        falling_fraction(n.into(), x)
    } else if x == 0.0 {
        1.0
    } else {
        (1..=n).fold(x.ln_1p() / x, |value, k| {
            (base * value - 1.0 / f64::from(k)) / x
        })
    };
    (0..n).fold(integral, |value, _| value / base)
}

impl Complex {
    /// log(1 + z)/z, and its kin as for reals, with the cut of the logarithm.
    pub fn log1prel(self, n: u8) -> Self {
        let (x, y) = (self.re, self.im);
        if y == 0.0 && x >= -1.0 {
            // the derivative is negative
            return complex(log1prel(n, x), -y);
        }
        if n == 0 && x.abs().max(y.abs()) < 1e-9 {
            return complex(1.0 - 0.5 * x, -0.5 * y);
        }
        let base = complex(1.0 + x, y);
        let integral = if n > 0 && x > -0.6 && self.abs() < 1.0 {
            complex_fraction(n.into(), self)
        } else {
            (1..=n).fold(self.log1p() / self, |value, k| {
                (base * value - complex(1.0 / f64::from(k), 0.0)) / self
            })
        };
        (0..n).fold(integral, |value, _| value / base)
    }
}

/// The continued fraction on complex numbers.
fn complex_fraction(n: f64, z: Complex) -> Complex {
    const LEVELS: i32 = 40;
    let mut value = complex(n + 1.0 + f64::from(LEVELS), 0.0);
    for k in (0..LEVELS).rev() {
        let m = f64::from(k / 2 + 1);
        let rest = z.scale(m * (n + m)) / value;
        value = complex(n + 1.0 + f64::from(k) + rest.re, rest.im);
    }
    value.inverse()
}
