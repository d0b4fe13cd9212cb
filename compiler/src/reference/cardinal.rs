//! Waves and exponentials divided by their argument: 1 at 0, and finite as long as the quotient is.

use super::complex::{Complex, complex};
use super::real::sinc;

/// Below, two terms of a series are enough.
const SMALL: f64 = 1e-8;
/// From here on e^x swallows what is beside it.
const LARGE: f64 = 20.0;
/// Beyond, a function overflows before its quotient.
const FAR: f64 = 600.0;

/// sinh x / x.
pub fn sinhc(x: f64) -> f64 {
    let a = x.abs();
    if a == 0.0 {
        1.0
    } else if a.is_infinite() {
        a
    } else if a > LARGE {
        let half = (0.5 * a).exp();
        half / a * 0.5 * half
    } else {
        a.sinh() / a
    }
}

/// (e^x - 1)/x.
pub fn exprel(x: f64) -> f64 {
    if x == 0.0 {
        1.0
    } else if x == f64::INFINITY {
        x
    } else if x > FAR {
        let half = (0.5 * x).exp();
        half / x * half
    } else {
        x.exp_m1() / x
    }
}

impl Complex {
    /// sinh z / z.
    pub fn sinhc(self) -> Self {
        let (x, y) = (self.re, self.im);
        if y == 0.0 {
            return complex(sinhc(x), turned(y, x));
        }
        if x == 0.0 {
            // the derivative there is -i sinc' y
            let falls = y.abs() < 1.0 || y.cos() < sinc(y);
            return complex(sinc(y), turned(x, if falls { y } else { -y }));
        }
        if x.is_infinite() {
            return complex(x.abs(), turned(y, x)).sinh();
        }
        if x.abs().max(y.abs()) < SMALL {
            return complex(1.0 + (x - y) * (x + y) / 6.0, x * y / 3.0);
        }
        if x.abs() > FAR {
            let half = complex(0.5 * x, 0.5 * y);
            return half.sinh() / half * half.cosh();
        }
        self.sinh() / self
    }

    /// sin z / z = sinh(i z) / (i z).
    pub fn sinc(self) -> Self {
        self.mul_i().sinhc()
    }

    /// (e^z - 1)/z.
    pub fn exprel(self) -> Self {
        let (x, y) = (self.re, self.im);
        if y == 0.0 {
            return complex(exprel(x), y);
        }
        if x == f64::INFINITY {
            return self.exp();
        }
        if x > FAR {
            let half = complex(0.5 * x, 0.5 * y).exp();
            return half * (half / self);
        }
        self.expm1() / self
    }
}

/// v with its sign turned where s is negative.
fn turned(v: f64, s: f64) -> f64 {
    if s.is_sign_negative() { -v } else { v }
}
