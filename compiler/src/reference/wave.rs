//! Complex trigonometric and hyperbolic functions. The trigonometric ones are the hyperbolic ones turned by i, which
//! is how C99 Annex G specifies them.

use super::complex::{Complex, complex};

impl Complex {
    /// sinh z (C99 G.6.2.5).
    pub fn sinh(self) -> Self {
        let (x, y) = (self.re, self.im);
        if y == 0.0 {
            return complex(x.sinh(), y);
        }
        if !y.is_finite() {
            let re = if x == 0.0 || x.is_infinite() {
                x
            } else {
                f64::NAN
            };
            return complex(re, f64::NAN);
        }
        let (sin, cos) = y.sin_cos();
        if x.is_infinite() {
            return complex(x * cos, f64::INFINITY * sin);
        }
        let (re, im) = scaled_waves(x, cos, sin);
        complex(re.copysign(cos * x.signum()), im)
    }

    /// cosh z (C99 G.6.2.4).
    pub fn cosh(self) -> Self {
        let (x, y) = (self.re, self.im);
        if y == 0.0 {
            return complex(x.cosh(), y * 1.0_f64.copysign(x));
        }
        if !y.is_finite() {
            if x == 0.0 {
                return complex(f64::NAN, x);
            }
            return complex(
                if x.is_infinite() {
                    f64::INFINITY
                } else {
                    f64::NAN
                },
                f64::NAN,
            );
        }
        let (sin, cos) = y.sin_cos();
        if x.is_infinite() {
            return complex(f64::INFINITY * cos, x * sin);
        }
        let (im, re) = scaled_waves(x, sin, cos);
        complex(re, im.copysign(sin * x.signum()))
    }

    /// tanh z = (sinh x cosh x + i sin y cos y) / (sinh² x + cos² y): no term cancels (after Kahan 1987; special
    /// values C99 G.6.2.6).
    pub fn tanh(self) -> Self {
        let (x, y) = (self.re, self.im);
        if x.is_infinite() {
            let im = if y.is_finite() { y.sin() * y.cos() } else { y };
            return complex(1.0_f64.copysign(x), 0.0_f64.copysign(im));
        }
        if y == 0.0 {
            return complex(x.tanh(), y);
        }
        if !y.is_finite() || x.is_nan() {
            return complex(if x == 0.0 { x } else { f64::NAN }, f64::NAN);
        }
        let (sin, cos) = y.sin_cos();
        if x.abs() > 22.0 {
            let e = (-x.abs()).exp();
            return complex(1.0_f64.copysign(x), 4.0 * sin * cos * e * e);
        }
        let (sinh, cosh) = (x.sinh(), x.cosh());
        let norm = sinh * sinh + cos * cos;
        complex(sinh * cosh / norm, sin * cos / norm)
    }

    /// sin z = -i sinh(i z).
    pub fn sin(self) -> Self {
        self.mul_i().sinh().div_i()
    }

    /// cos z = cosh(i z).
    pub fn cos(self) -> Self {
        self.mul_i().cosh()
    }

    /// tan z = -i tanh(i z).
    pub fn tan(self) -> Self {
        self.mul_i().tanh().div_i()
    }
}

/// (a sinh x, b cosh x) where the factor may overflow and the product not.
fn scaled_waves(x: f64, a: f64, b: f64) -> (f64, f64) {
    if x.abs() < 700.0 || x.is_nan() {
        return (a * x.sinh(), b * x.cosh());
    }
    let half = (0.5 * x.abs()).exp();
    (0.5 * half * a * half, 0.5 * half * b * half)
}
