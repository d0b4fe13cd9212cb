//! Complex inverse trigonometric and hyperbolic functions.
//!
//! Kahan, "Branch Cuts for Complex Elementary Functions, or Much Ado About Nothing's Sign Bit" (1987). In his formulas
//! each product of square roots has components that are sums of terms of one sign, so both components keep their
//! relative accuracy. Special values: C99 G.6.1 and G.6.2.

use super::complex::{Complex, complex};
use super::real;
use std::f64::consts::{FRAC_PI_2, LN_2};

/// Beyond this modulus 1 ± z² is z² to working precision.
const FAR: f64 = 1e17;

/// The square roots of 1 - z and 1 + z.
fn roots(z: Complex) -> (Complex, Complex) {
    (
        complex(1.0 - z.re, -z.im).sqrt(),
        complex(1.0 + z.re, z.im).sqrt(),
    )
}

/// log |2 z| for a large, possibly infinite z.
fn log_twice(z: Complex) -> f64 {
    if z.is_infinite() {
        return f64::INFINITY;
    }
    complex(z.re * 0.25, z.im * 0.25).abs().ln() + 3.0 * LN_2
}

fn is_far(z: Complex) -> bool {
    z.re.abs().max(z.im.abs()) > FAR
}

impl Complex {
    /// arcsin z, cuts on the real axis outside [-1, 1].
    pub fn asin(self) -> Self {
        if self.re.is_nan() || self.im.is_nan() {
            return self.mul_i().asinh().div_i();
        }
        if is_far(self) {
            return complex(
                self.re.atan2(self.im.abs()),
                log_twice(self).copysign(self.im),
            );
        }
        let (minus, plus) = roots(self);
        let re = self.re.atan2(minus.re * plus.re - minus.im * plus.im);
        let im = real::asinh(minus.re * plus.im - minus.im * plus.re);
        complex(re, im.copysign(self.im))
    }

    /// arccos z, cuts on the real axis outside [-1, 1].
    pub fn acos(self) -> Self {
        let (x, y) = (self.re, self.im);
        if x.is_nan() || y.is_nan() {
            let re = if x == 0.0 { FRAC_PI_2 } else { f64::NAN };
            let im = if self.is_infinite() {
                f64::INFINITY
            } else {
                f64::NAN
            };
            return complex(re, if y.is_nan() { im } else { -im.copysign(y) });
        }
        if is_far(self) {
            return complex(y.abs().atan2(x), -log_twice(self).copysign(y));
        }
        let (minus, plus) = roots(self);
        let re = 2.0 * minus.re.atan2(plus.re);
        let im = real::asinh(plus.re * minus.im - plus.im * minus.re);
        complex(re, -im.abs().copysign(y))
    }

    /// arsinh z = -i arcsin(i z), cuts on the imaginary axis outside [-i, i].
    pub fn asinh(self) -> Self {
        let (x, y) = (self.re, self.im);
        if x.is_nan() || y.is_nan() {
            return match (x.is_infinite(), y.is_infinite(), y == 0.0) {
                (true, ..) => complex(x, y),
                (_, true, _) => complex(f64::INFINITY.copysign(x), f64::NAN),
                (.., true) => complex(x, y),
                _ => complex(f64::NAN, f64::NAN),
            };
        }
        self.mul_i().asin().div_i()
    }

    /// arcosh z, cut on the real axis below 1; the real part is never negative.
    pub fn acosh(self) -> Self {
        let w = self.acos();
        complex(w.im.abs(), w.re.copysign(self.im))
    }

    /// artanh z, cuts on the real axis outside [-1, 1].
    pub fn atanh(self) -> Self {
        let (x, y) = (self.re, self.im);
        if x.is_nan() || y.is_nan() {
            return if y.is_infinite() {
                complex(0.0_f64.copysign(x), FRAC_PI_2.copysign(y))
            } else if x.is_infinite() || x == 0.0 {
                complex(0.0_f64.copysign(x), f64::NAN)
            } else {
                complex(f64::NAN, f64::NAN)
            };
        }
        let a = x.abs();
        if is_far(self) {
            // 1/z + O(z^-3)
            let re = if self.is_infinite() {
                0.0
            } else {
                a / self.abs() / self.abs()
            };
            return complex(re.copysign(x), FRAC_PI_2.copysign(y));
        }
        if a == 1.0 && y.abs() < 1e-150 {
            let re = 0.5 * (LN_2 - y.abs().ln());
            let im = if y == 0.0 {
                y
            } else {
                (0.25 * std::f64::consts::PI).copysign(y)
            };
            return complex(re.copysign(x), im);
        }
        let re = 0.25 * (4.0 * a / ((1.0 - a) * (1.0 - a) + y * y)).ln_1p();
        let im = 0.5 * (2.0 * y).atan2((1.0 - a) * (1.0 + a) - y * y);
        complex(re.copysign(x), im)
    }

    /// arctan z = -i artanh(i z), cuts on the imaginary axis outside [-i, i].
    pub fn atan(self) -> Self {
        self.mul_i().atanh().div_i()
    }
}
