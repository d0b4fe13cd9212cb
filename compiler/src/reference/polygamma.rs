//! Derivatives of digamma from the second on, by Hurwitz' zeta function: ψ⁽ⁿ⁾(z) = (-1)ⁿ⁺¹ n! ζ(n + 1, z) (DLMF
//! 25.11.12), whose asymptotic series (25.11.43), recurrence (25.11.3), and the reflection of ψ⁽ⁿ⁾ (5.15.6).

use super::complex::{Complex, complex};
use super::gamma::{cot_pi, is_far, is_pole, is_reflected, sin_cos_pi, sin_pi};
use std::f64::consts::PI;

/// From here on the series with ten terms is exact to working precision for n ≤ 5.
const FAR: f64 = 15.0;

/// B(2k) / (2k)!, k = 1.. (DLMF 24.2).
const SERIES: [f64; 10] = [
    1.0 / 12.0,
    -1.0 / 720.0,
    1.0 / 30_240.0,
    -1.0 / 1_209_600.0,
    1.0 / 47_900_160.0,
    -5.284_190_138_687_493e-10,
    1.338_253_653_068_467_9e-11,
    -3.389_680_296_322_582_7e-13,
    8.586_062_056_277_845e-15,
    -2.174_868_698_558_062e-16,
];

fn factorial(n: u8) -> f64 {
    (1..=n).map(f64::from).product()
}

/// t^(s-1) ζ(s, t) - 1/(s - 1) for t ≥ 15, s = n + 1, from r = 1/t: r/2 + Σ B(2k)/(2k)! s … (s + 2k - 2) r^2k.
fn tail_factors(n: u8) -> [f64; 10] {
    let s = f64::from(n) + 1.0;
    let mut rising = s;
    let mut k = 0.0;
    SERIES.map(|b| {
        let factor = b * rising;
        k += 2.0;
        rising *= (s + k - 1.0) * (s + k);
        factor
    })
}

/// ζ(n + 1, x + first) for x ≥ 0.
fn zeta(n: u8, x: f64, first: f64) -> f64 {
    let mut sum = 0.0;
    let (mut top, mut steps) = (x + first, first);
    while top < FAR {
        sum += top.recip().powi(i32::from(n) + 1);
        steps += 1.0;
        top = x + steps;
    }
    let r = 1.0 / top;
    let factors = tail_factors(n);
    let series = factors.iter().rev().fold(0.0, |sum, c| sum * r * r + c);
    sum + r.powi(n.into()) * (1.0 / f64::from(n) + r * (0.5 + r * series))
}

/// πⁿ⁺¹ pₙ(cos πx) / sinⁿ⁺¹ πx, (-1)ⁿ of the n-th derivative of π cot πx, from π cot πx and π²/sin² πx.
fn reflected<T: Copy + std::ops::Add<Output = T> + std::ops::Mul<Output = T>>(
    n: u8,
    cot: T,
    square: T,
    scale: impl Fn(f64, T) -> T,
) -> T {
    let cc = cot * cot;
    match n {
        2 => scale(2.0, cot * square),
        3 => square * (scale(2.0, square) + scale(4.0, cc)),
        4 => cot * square * (scale(16.0, square) + scale(8.0, cc)),
        _ => {
            square
                * (scale(16.0, square * square) + scale(88.0, square * cc) + scale(16.0, cc * cc))
        }
    }
}

/// ψ⁽ⁿ⁾(x), 2 ≤ n ≤ 5: at the poles +∞ for odd n, NaN for even n but at ±0. Absolute accuracy left of 0 for even n,
/// where it has zeros.
pub fn polygamma(n: u8, x: f64) -> f64 {
    let odd = n % 2 == 1;
    if x.is_nan() || x == f64::NEG_INFINITY {
        return f64::NAN;
    }
    if x == 0.0 || x == f64::INFINITY {
        let power = x.recip();
        return if odd { power.abs() } else { -power };
    }
    if is_pole(x) {
        return if odd { f64::INFINITY } else { f64::NAN };
    }
    if x > 0.0 {
        let size = factorial(n) * zeta(n, x, 0.0);
        return if odd { size } else { -size };
    }
    let (sin, cos) = sin_cos_pi(x);
    let ratio = PI / sin;
    let wave = reflected(n, ratio * cos, ratio * ratio, |c, t| c * t);
    let regular = factorial(n) * zeta(n, -x, 1.0);
    if odd { wave - regular } else { -wave - regular }
}

impl Complex {
    /// ψ⁽ⁿ⁾(z), 2 ≤ n ≤ 5.
    pub fn polygamma(self, n: u8) -> Self {
        let odd = n % 2 == 1;
        if self.im == 0.0 {
            let sign = if odd { -self.im } else { self.im };
            return complex(polygamma(n, self.re), sign);
        }
        if !self.is_finite() {
            return if self.re.is_nan() || self.im.is_nan() {
                complex(f64::NAN, f64::NAN)
            } else {
                Self::ZERO
            };
        }
        if is_reflected(self) {
            let ratio = complex(PI, 0.0) / sin_pi(self);
            let wave = reflected(n, cot_pi(self).scale(PI), ratio.square(), |c, t| t.scale(c));
            let regular = (-self).zeta(n, 1.0).scale(factorial(n));
            return if odd { wave - regular } else { -wave - regular };
        }
        let size = self.zeta(n, 0.0).scale(factorial(n));
        if odd { size } else { -size }
    }

    /// ζ(n + 1, z + first).
    fn zeta(self, n: u8, first: f64) -> Self {
        let mut sum = Self::ZERO;
        let (mut top, mut steps) = (complex(self.re + first, self.im), first);
        while !is_far(top) {
            sum = sum + top.inverse().powi(i32::from(n) + 1);
            steps += 1.0;
            top.re = self.re + steps;
        }
        let r = top.inverse();
        let w = r.square();
        let factors = tail_factors(n);
        let series = factors.iter().rev().fold(Self::ZERO, |sum, &c| {
            let p = sum * w;
            complex(p.re + c, p.im)
        });
        let near = r * (complex(0.5, 0.0) + r * series);
        sum + r.powi(n.into()) * (complex(1.0 / f64::from(n), 0.0) + near)
    }
}
