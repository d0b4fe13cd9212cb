//! Complex numbers of two f64: arithmetic, exponential, logarithm, powers.
//!
//! Sources: C99 Annex G (special values); Kahan, "Branch Cuts for Complex Elementary Functions" (1987); Jeannerod,
//! Louvet, Muller, "Further analysis of Kahan's algorithm for the accurate computation of 2 × 2 determinants" (2013).

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A complex number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Complex {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

/// re + i im.
pub const fn complex(re: f64, im: f64) -> Complex {
    Complex { re, im }
}

/// a b + c d with an error of 1.5 ulp (Kahan; Jeannerod, Louvet, Muller 2013), however much cancels.
pub fn sum_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let cd = c * d;
    let plain = a.mul_add(b, cd);
    if !plain.is_finite() || !cd.is_finite() {
        return a * b + cd;
    }
    let rest = c.mul_add(d, -cd);
    if rest == 0.0 { plain } else { plain + rest } // keeps a negative zero
}

/// e with |v| in [2^e, 2^(e+1)); 0 where v is 0, infinite or NaN.
fn exponent(v: f64) -> i32 {
    let field = |v: f64| ((v.to_bits() >> 52) & 0x7ff) as i32;
    if v == 0.0 || !v.is_finite() {
        0
    } else if field(v) == 0 {
        field(v * 2f64.powi(54)) - 1023 - 54
    } else {
        field(v) - 1023
    }
}

/// v 2^n in steps that neither overflow nor lose bits before the last.
fn times_power_of_two(mut v: f64, mut n: i32) -> f64 {
    while n.abs() > 1000 {
        let step = 1000 * n.signum();
        v *= 2f64.powi(step);
        n -= step;
    }
    v * 2f64.powi(n)
}

impl Add for Complex {
    type Output = Self;
    fn add(self, w: Self) -> Self {
        complex(self.re + w.re, self.im + w.im)
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, w: Self) -> Self {
        complex(self.re - w.re, self.im - w.im)
    }
}

impl Neg for Complex {
    type Output = Self;
    fn neg(self) -> Self {
        complex(-self.re, -self.im)
    }
}

impl Mul for Complex {
    type Output = Self;
    /// Each component to 1.5 ulp; an infinite factor gives an infinite product (C99 G.5.1).
    fn mul(self, w: Self) -> Self {
        let product = complex(
            sum_of_products(self.re, w.re, -self.im, w.im),
            sum_of_products(self.re, w.im, self.im, w.re),
        );
        if product.re.is_nan() && product.im.is_nan() {
            mul_infinite(self, w).unwrap_or(product)
        } else {
            product
        }
    }
}

/// The recovery of C99 G.5.1: infinities where the plain product was NaN + i NaN.
fn mul_infinite(z: Complex, w: Complex) -> Option<Complex> {
    let overflowed = [z.re * w.re, z.im * w.im, z.re * w.im, z.im * w.re]
        .iter()
        .any(|p| p.is_infinite());
    if !(z.is_infinite() || w.is_infinite() || overflowed) {
        return None;
    }
    let (mut z, mut w) = (z, w);
    if z.is_infinite() {
        (z, w) = (z.boxed(), w.without_nan());
    }
    if w.is_infinite() {
        (w, z) = (w.boxed(), z.without_nan());
    }
    (z, w) = (z.without_nan(), w.without_nan());
    Some(complex(
        f64::INFINITY * (z.re * w.re - z.im * w.im),
        f64::INFINITY * (z.re * w.im + z.im * w.re),
    ))
}

impl Div for Complex {
    type Output = Self;
    /// Operands scaled by powers of two (Priest 2004), numerators by `sum_of_products`; special values after C99 G.5.1.
    fn div(self, w: Self) -> Self {
        let exponent_w = exponent(w.re.abs().max(w.im.abs()));
        let exponent_z = exponent(self.re.abs().max(self.im.abs()));
        let (c, d) = (
            times_power_of_two(w.re, -exponent_w),
            times_power_of_two(w.im, -exponent_w),
        );
        let (a, b) = (
            times_power_of_two(self.re, -exponent_z),
            times_power_of_two(self.im, -exponent_z),
        );
        let norm = c * c + d * d;
        let re = sum_of_products(a, c, b, d) / norm;
        let im = sum_of_products(b, c, -a, d) / norm;
        if re.is_nan() && im.is_nan() {
            return div_special(self, w, norm);
        }
        let undo = exponent_z - exponent_w;
        complex(times_power_of_two(re, undo), times_power_of_two(im, undo))
    }
}

/// The recovery of C99 G.5.1 for quotients.
fn div_special(z: Complex, w: Complex, norm: f64) -> Complex {
    if norm == 0.0 && !(z.re.is_nan() && z.im.is_nan()) {
        let inf = f64::INFINITY.copysign(w.re);
        return complex(inf * z.re, inf * z.im);
    }
    if z.is_infinite() && w.is_finite() {
        let z = z.boxed();
        return complex(
            f64::INFINITY * (z.re * w.re + z.im * w.im),
            f64::INFINITY * (z.im * w.re - z.re * w.im),
        );
    }
    if w.is_infinite() && z.is_finite() {
        let w = w.boxed();
        return complex(
            0.0 * (z.re * w.re + z.im * w.im),
            0.0 * (z.im * w.re - z.re * w.im),
        );
    }
    complex(f64::NAN, f64::NAN)
}

impl Complex {
    /// 0.
    pub const ZERO: Self = complex(0.0, 0.0);
    /// 1.
    pub const ONE: Self = complex(1.0, 0.0);
    /// The imaginary unit.
    pub const I: Self = complex(0.0, 1.0);

    /// Whether a component is infinite (then the number is, whatever the other is: C99 G.3).
    pub fn is_infinite(self) -> bool {
        self.re.is_infinite() || self.im.is_infinite()
    }

    /// Whether both components are finite.
    pub fn is_finite(self) -> bool {
        self.re.is_finite() && self.im.is_finite()
    }

    /// Infinite components become ±1, others ±0 (the boxing of C99 G.5.1).
    fn boxed(self) -> Self {
        let unit = |v: f64| {
            if v.is_infinite() {
                1.0_f64.copysign(v)
            } else {
                0.0_f64.copysign(v)
            }
        };
        complex(unit(self.re), unit(self.im))
    }

    /// NaN components become ±0.
    fn without_nan(self) -> Self {
        let zero = |v: f64| if v.is_nan() { 0.0_f64.copysign(v) } else { v };
        complex(zero(self.re), zero(self.im))
    }

    /// The product with a real number.
    pub fn scale(self, s: f64) -> Self {
        complex(self.re * s, self.im * s)
    }

    /// The complex conjugate.
    pub fn conj(self) -> Self {
        complex(self.re, -self.im)
    }

    /// i z, exactly.
    pub fn mul_i(self) -> Self {
        complex(-self.im, self.re)
    }

    /// -i z, exactly.
    pub fn div_i(self) -> Self {
        complex(self.im, -self.re)
    }

    /// |z| without spurious overflow; infinite when a component is.
    pub fn abs(self) -> f64 {
        self.re.hypot(self.im)
    }

    /// The phase in [-pi, pi], continuous from above on the cut for im = +0, from below for -0.
    pub fn arg(self) -> f64 {
        self.im.atan2(self.re)
    }

    /// z².
    pub fn square(self) -> Self {
        let re = (self.re - self.im) * (self.re + self.im);
        let im = 2.0 * self.re * self.im;
        if re.is_nan() && !(self.re.is_nan() && self.im.is_nan()) {
            self * self
        } else {
            complex(re, im)
        }
    }

    /// 1 / z = z̄ / |z|²: below the real axis for +0, which the quotient 1 / z loses.
    pub fn inverse(self) -> Self {
        if self.is_infinite() {
            return complex(0.0_f64.copysign(self.re), 0.0_f64.copysign(-self.im));
        }
        let e = exponent(self.re.abs().max(self.im.abs()));
        let z = complex(
            times_power_of_two(self.re, -e),
            times_power_of_two(self.im, -e),
        );
        let norm = z.re * z.re + z.im * z.im;
        if norm == 0.0 {
            return Self::ONE / self;
        }
        complex(
            times_power_of_two(z.re / norm, -e),
            times_power_of_two(-z.im / norm, -e),
        )
    }

    /// e^z (C99 G.6.3.1).
    pub fn exp(self) -> Self {
        if self.im == 0.0 {
            return complex(self.re.exp(), self.im);
        }
        if self.re == f64::NEG_INFINITY {
            return if self.im.is_finite() {
                complex(0.0 * self.im.cos(), 0.0 * self.im.sin())
            } else {
                Self::ZERO
            };
        }
        if self.re == f64::INFINITY && !self.im.is_finite() {
            return complex(f64::INFINITY, f64::NAN);
        }
        let (sin, cos) = self.im.sin_cos();
        if self.re.abs() < 700.0 || self.re.is_infinite() {
            let r = self.re.exp();
            return complex(r * cos, r * sin);
        }
        let half = (0.5 * self.re).exp(); // e^x may overflow where e^x cos y does not
        complex(half * cos * half, half * sin * half)
    }

    /// e^z - 1 = expm1(x) cos y - 2 sin²(y/2) + i e^x sin y.
    pub fn expm1(self) -> Self {
        if !self.is_finite() || self.re > 40.0 {
            let e = self.exp();
            return complex(e.re - 1.0, e.im);
        }
        if self.im == 0.0 {
            return complex(self.re.exp_m1(), self.im);
        }
        let (sin, cos) = self.im.sin_cos();
        let half = (0.5 * self.im).sin();
        if self.re == 0.0 {
            return complex(-2.0 * half * half, sin); // an underflow keeps the sign
        }
        complex(
            sum_of_products(self.re.exp_m1(), cos, -2.0 * half, half),
            self.re.exp() * sin,
        )
    }

    /// log z, cut along the negative axis (C99 G.6.3.2). The real part keeps its relative accuracy near |z| = 1.
    pub fn log(self) -> Self {
        complex(log_hypot(self.re, self.im), self.arg())
    }

    /// log(1 + z); the real part is half of log1p(2x + x² + y²).
    pub fn log1p(self) -> Self {
        let (x, y) = (self.re, self.im);
        if !self.is_finite() || x.abs() > 0.5 || y.abs() > 0.5 {
            let w = complex(1.0 + x, y);
            return if x > -2.0 && x < -0.5 {
                w.log()
            } else {
                complex(log_hypot(w.re, y), w.arg())
            };
        }
        if y == 0.0 {
            return complex(x.ln_1p(), y);
        }
        let (xx, ex) = two_product(x, x);
        let (yy, ey) = two_product(y, y);
        let (s, e1) = two_sum(2.0 * x, yy);
        let (s, e2) = two_sum(s, xx);
        let low = e1 + e2 + ex + ey;
        complex(0.5 * ((s + low).ln_1p()), y.atan2(1.0 + x))
    }

    /// The root with positive real part, cut along the negative axis (C99 G.6.4.2; Kahan 1987).
    pub fn sqrt(self) -> Self {
        let (x, y) = (self.re, self.im);
        if y.is_infinite() {
            return complex(f64::INFINITY, y);
        }
        if x.is_nan() {
            return complex(x, x);
        }
        if x.is_infinite() {
            let other = if y.is_nan() { y } else { 0.0_f64.copysign(y) };
            return match (x > 0.0, y.is_nan()) {
                (true, _) => complex(x, other),
                (false, true) => complex(y, f64::INFINITY),
                (false, false) => complex(0.0, f64::INFINITY.copysign(y)),
            };
        }
        if x == 0.0 && y == 0.0 {
            return complex(0.0, y);
        }
        let largest = x.abs().max(y.abs());
        let (scale, undo) = if largest > 1e300 {
            (2f64.powi(-4), 4.0)
        } else if largest < 1e-290 {
            (2f64.powi(120), 2f64.powi(-60))
        } else {
            (1.0, 1.0)
        };
        let (x, y) = (x * scale, y * scale);
        let t = (0.5 * (x.abs() + x.hypot(y))).sqrt();
        let other = 0.5 * (y.abs() / t);
        if self.re >= 0.0 {
            complex(t * undo, (other * undo).copysign(self.im))
        } else {
            complex(other * undo, (t * undo).copysign(self.im))
        }
    }

    /// z^n for every integer n by repeated squaring: exact where the products are; z^0 = 1 for every z.
    pub fn powi(self, n: i32) -> Self {
        if self.im == 0.0 && n != 0 {
            let flip = (n % 2 == 0 && self.re.is_sign_negative()) != (n < 0);
            return complex(
                self.re.powf(f64::from(n)),
                if flip { -self.im } else { self.im },
            );
        }
        // the powers of two are counted apart, lest a square overflow on the way to a small result
        let normal = |z: Self, e: i64| {
            let shift = exponent(z.re.abs().max(z.im.abs()));
            (
                complex(
                    times_power_of_two(z.re, -shift),
                    times_power_of_two(z.im, -shift),
                ),
                e + i64::from(shift),
            )
        };
        if n == 0 || !self.is_finite() {
            return if n == 0 {
                Self::ONE
            } else {
                self.powi_unscaled(n)
            };
        }
        let mut power: Option<(Self, i64)> = None;
        let mut base = normal(self, 0);
        let mut left = n.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                power = Some(power.map_or(base, |(p, e)| normal(p * base.0, e + base.1)));
            }
            left >>= 1;
            if left > 0 {
                base = normal(base.0.square(), 2 * base.1);
            }
        }
        let (power, exponent) = power.unwrap_or((Self::ONE, 0));
        let (power, exponent) = if n < 0 {
            (power.inverse(), -exponent)
        } else {
            (power, exponent)
        };
        let exponent = exponent.clamp(-5000, 5000) as i32;
        complex(
            times_power_of_two(power.re, exponent),
            times_power_of_two(power.im, exponent),
        )
    }

    fn powi_unscaled(self, n: i32) -> Self {
        let mut power = self;
        for _ in 1..n.unsigned_abs().min(4) {
            power = power * self;
        }
        if n < 0 { power.inverse() } else { power }
    }

    /// z^w on the principal branch: w = 0 gives 1, an integer w gives `powi`, 0^w is 0 for Re w > 0 and infinite
    /// for Re w < 0 (NaN for the other w), and the rest is e^(w log z).
    pub fn pow(self, w: Self) -> Self {
        let integer = w.im == 0.0 && w.re == w.re.round() && w.re.abs() <= 65536.0;
        if integer {
            return self.powi(w.re as i32);
        }
        if self.re == 0.0 && self.im == 0.0 {
            return if w.re > 0.0 {
                Self::ZERO
            } else if w.re < 0.0 {
                complex(f64::INFINITY, if w.im == 0.0 { 0.0 } else { f64::NAN })
            } else {
                complex(f64::NAN, f64::NAN)
            };
        }
        if w.im == 0.0 && self.im == 0.0 && self.re > 0.0 {
            return complex(self.re.powf(w.re), 0.0 * w.re * self.im);
        }
        // quarter turns are counted apart, so that powers of numbers near the axes keep their small component
        let (turns, rest) = self.phase();
        let size = sum_of_products(w.re, log_hypot(self.re, self.im), -w.im, self.arg());
        let counted = w.re * turns;
        let count = counted.round();
        let angle = sum_of_products(w.re, rest, w.im, log_hypot(self.re, self.im));
        let v = complex(
            size,
            (counted - count) * std::f64::consts::FRAC_PI_2 + angle,
        )
        .exp();
        match count.rem_euclid(4.0) as i32 {
            0 => v,
            1 => v.mul_i(),
            2 => -v,
            _ => v.div_i(),
        }
    }

    /// The phase as `turns` π/2 + rest, |rest| ≤ π/4.
    fn phase(self) -> (f64, f64) {
        let (x, y) = (self.re.abs(), self.im.abs());
        let steep = y > x;
        let left = self.re.is_sign_negative();
        let rest = if steep { x.atan2(y) } else { y.atan2(x) };
        let turns: f64 = if steep {
            1.0
        } else if left {
            2.0
        } else {
            0.0
        };
        let rest = if steep == left { rest } else { -rest };
        if self.im.is_sign_negative() {
            (-turns, -rest)
        } else {
            (turns, rest)
        }
    }
}

/// a + b = s + e exactly (Knuth).
pub(super) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let bb = s - a;
    (s, (a - (s - bb)) + (b - bb))
}

/// a b = p + e exactly where nothing underflows.
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    (p, a.mul_add(b, -p))
}

/// log √(x² + y²). Near the unit circle x² + y² - 1 is summed in pairs and goes through log1p, so that the result is
/// accurate relative to itself (Kahan 1987; Hull, Fairgrieve, Tang 1994).
fn log_hypot(x: f64, y: f64) -> f64 {
    let (x, y) = (x.abs(), y.abs());
    if x.is_infinite() || y.is_infinite() {
        return f64::INFINITY;
    }
    let (a, b) = if x < y { (y, x) } else { (x, y) };
    if a > 0.5 && a < 1.5 && a * a + b * b < 3.0 {
        let (aa, ea) = two_product(a, a);
        let (bb, eb) = two_product(b, b);
        let (s, e1) = two_sum(aa, -1.0);
        let (s, e2) = two_sum(s, bb);
        let (e, e3) = two_sum(e1 + e2, ea);
        let t = s + (e + (e3 + eb));
        let rest = (s - t) + (e + (e3 + eb));
        return 0.5 * (t.ln_1p() + rest / (1.0 + t));
    }
    if a < 1e-290 {
        let up = 2f64.powi(200);
        return (a * up).hypot(b * up).ln() - 200.0 * std::f64::consts::LN_2;
    }
    if a > 1e300 {
        return (0.25 * a).hypot(0.25 * b).ln() + 2.0 * std::f64::consts::LN_2;
    }
    a.hypot(b).ln()
}
