//! The gamma function and its logarithmic derivatives, real and complex.
//!
//! Stirling's series (DLMF 5.11.1-2) where |z| is large, the recurrence (DLMF 5.5.1-2) to get there, reflection
//! (DLMF 5.5.3-4) on the left. Measured against the 60-digit tables in `tests`.

use super::complex::{Complex, complex};
use std::f64::consts::PI;

use smallvec::SmallVec;

/// From here on Stirling's series with ten terms is exact to working precision.
const FAR: f64 = 15.0;
const HALF_LOG_TAU: f64 = 0.918_938_533_204_672_8;
const EULER: f64 = 0.577_215_664_901_532_9;

/// B(2n) / (2n (2n - 1)), n = 1.. (DLMF 5.11.1).
const LOG_GAMMA_SERIES: [f64; 10] = [
    1.0 / 12.0,
    -1.0 / 360.0,
    1.0 / 1260.0,
    -1.0 / 1680.0,
    1.0 / 1188.0,
    -691.0 / 360_360.0,
    1.0 / 156.0,
    -3617.0 / 122_400.0,
    43_867.0 / 244_188.0,
    -174_611.0 / 125_400.0,
];

/// B(2n), n = 1.. (DLMF 24.2).
const BERNOULLI: [f64; 10] = [
    1.0 / 6.0,
    -1.0 / 30.0,
    1.0 / 42.0,
    -1.0 / 30.0,
    5.0 / 66.0,
    -691.0 / 2730.0,
    7.0 / 6.0,
    -3617.0 / 510.0,
    43_867.0 / 798.0,
    -174_611.0 / 330.0,
];

/// zeta(k) - 1 for k = 2.. (DLMF 25.2).
const ZETA_MINUS_1: [f64; 28] = [
    0.644_934_066_848_226_4,
    0.202_056_903_159_594_3,
    0.082_323_233_711_138_19,
    0.036_927_755_143_369_93,
    0.017_343_061_984_449_14,
    0.008_349_277_381_922_827,
    0.004_077_356_197_944_34,
    0.002_008_392_826_082_214_3,
    0.000_994_575_127_818_085_3,
    0.000_494_188_604_119_464_5,
    0.000_246_086_553_308_048_3,
    0.000_122_713_347_578_489_15,
    6.124_813_505_870_483e-5,
    3.058_823_630_702_049e-5,
    1.528_225_940_865_187e-5,
    7.637_197_637_899_763e-6,
    3.817_293_264_999_84e-6,
    1.908_212_716_553_939e-6,
    9.539_620_338_727_962e-7,
    4.769_329_867_878_064e-7,
    2.384_505_027_277_33e-7,
    1.192_199_259_653_110_7e-7,
    5.960_818_905_125_948e-8,
    2.980_350_351_465_228e-8,
    1.490_155_482_836_504_3e-8,
    7.450_711_789_835_43e-9,
    3.725_334_024_788_457e-9,
    1.862_659_723_513_049e-9,
];

/// The zero of digamma on the positive axis, in two parts.
const PSI_ZERO: f64 = 1.461_632_144_968_362_2;
const PSI_ZERO_LOW: f64 = 9.549_995_429_965_697e-17;

/// Taylor coefficients of digamma about its positive zero, from the linear one (mpmath, 50 digits).
const PSI_TAYLOR: [f64; 23] = [
    0.967_672_245_447_621_2,
    -0.442_763_168_983_592_1,
    0.258_499_760_955_651,
    -0.163_942_705_442_406_52,
    0.107_824_050_691_262_37,
    -0.072_199_561_256_454_71,
    0.048_804_288_164_143_11,
    -0.033_161_126_474_847_36,
    0.022_597_648_232_218_104,
    -0.015_424_765_904_948_96,
    0.010_538_791_616_612_175,
    -0.007_204_534_386_356_869,
    0.004_926_781_395_729_853,
    -0.003_369_801_655_439_328,
    0.002_305_126_326_734_928,
    -0.001_576_936_771_430_197_2,
    0.001_078_825_201_916_296_7,
    -0.000_738_070_938_996_005_2,
    0.000_504_953_265_834_602,
    -0.000_345_468_025_106_307_7,
    0.000_236_356_015_640_270_53,
    -0.000_161_706_220_919_748_03,
    0.000_110_633_727_687_474_1,
];

/// Σ c[n] w^n by Horner's rule.
fn horner(c: &[f64], w: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * w + c)
}

fn horner_complex(c: &[f64], w: Complex) -> Complex {
    c.iter().rev().fold(Complex::ZERO, |sum, &c| {
        let p = sum * w;
        complex(p.re + c, p.im)
    })
}

/// sin πx and cos πx with an exact reduction; both are exact zeros where they vanish.
pub(super) fn sin_cos_pi(x: f64) -> (f64, f64) {
    let n = x.round();
    let f = x - n;
    let (sin, cos) = if f.abs() > 0.25 {
        let (cos, sin) = ((0.5 - f.abs()) * PI).sin_cos();
        (sin.copysign(f), cos)
    } else {
        (f * PI).sin_cos()
    };
    if n % 2.0 == 0.0 {
        (sin, cos)
    } else {
        (-sin, -cos)
    }
}

/// A pole: NaN where the two sides disagree, as `tgamma` at the negative integers (C99 F.9.5.4).
pub(super) fn is_pole(x: f64) -> bool {
    x <= 0.0 && x == x.round()
}

/// Γ(x): NaN at the negative integers, ±∞ at ±0.
pub fn gamma(x: f64) -> f64 {
    if x == 0.0 {
        return 1.0 / x;
    }
    if is_pole(x) || x.is_nan() {
        return f64::NAN;
    }
    if x > 0.0 {
        return gamma_positive(x);
    }
    let y = -x; // Γ(-y) = -π / (y sin πy Γ(y))
    if y > 190.0 {
        return 0.0_f64.copysign(-sin_cos_pi(y).0);
    }
    if y < 1e-17 {
        return 1.0 / x;
    }
    let shift = if y > 168.0 { 40.0 } else { 0.0 };
    // Γ(y) overflows before the result underflows: divide the factors (y-1)…(y-40) out one at a time
    let mut r = -PI / (y * sin_cos_pi(y).0) / gamma_positive(y - shift);
    for k in 1..=(shift as i32) {
        r /= y - f64::from(k);
    }
    r
}

fn gamma_positive(x: f64) -> f64 {
    if x > 171.7 {
        return f64::INFINITY;
    }
    if x < FAR || x <= 24.0 && x == x.round() {
        return gamma_near(x);
    }
    let top = x;
    // √τ top^(top - 1/2) e^-top e^series
    let w = 1.0 / (top * top);
    let series = horner(&LOG_GAMMA_SERIES, w) / top;
    let half_power = top.powf(0.5 * top - 0.25);
    let root_tau = 2.506_628_274_631_000_5;
    let stirling = half_power * (-top).exp() * root_tau;
    (stirling + stirling * series.exp_m1()) * half_power
}

/// Γ(x) for positive x that are not large, by the recurrence from beside 2 (DLMF 5.5.1), where log Γ is small. Each step down
/// is exact, so that only the products round.
fn gamma_near(x: f64) -> f64 {
    if x < 0.5 {
        return log_gamma_near_2(x).exp() / (x * (1.0 + x));
    }
    if x < 1.5 {
        return log_gamma_near_2(x - 1.0).exp() / x;
    }
    let (mut product, mut top) = (1.0, x);
    while top >= 2.5 {
        top -= 1.0;
        product *= top;
    }
    product * log_gamma_near_2(top - 2.0).exp()
}

/// log |Γ(x)|: +∞ at the poles. Relative accuracy near its zeros at 1 and 2; absolute at those left of 0.
pub fn lgamma(x: f64) -> f64 {
    if x.is_nan() {
        return x;
    }
    if is_pole(x) || x.is_infinite() {
        return f64::INFINITY;
    }
    if x < 0.0 {
        let y = -x;
        if y < 1e-17 {
            return -y.ln();
        }
        return (PI / (y * sin_cos_pi(y).0).abs()).ln() - lgamma(y);
    }
    if x < 0.5 {
        return log_gamma_near_2(x) - x.ln_1p() - x.ln();
    }
    if x < 1.5 {
        return log_gamma_near_2(x - 1.0) - (x - 1.0).ln_1p();
    }
    if x < 2.5 {
        return log_gamma_near_2(x - 2.0);
    }
    if x < FAR {
        return gamma_positive(x).ln();
    }
    let series = horner(&LOG_GAMMA_SERIES, 1.0 / (x * x)) / x;
    (x - 0.5) * (x.ln() - 1.0) + (HALF_LOG_TAU - 0.5 + series)
}

/// log Γ(2 + t) = (1 - γ) t + Σ (ζ(k) - 1) (-t)^k / k for |t| ≤ 1/2 (DLMF 5.7.3).
fn log_gamma_near_2(t: f64) -> f64 {
    let mut sum = 0.0;
    for (i, z) in ZETA_MINUS_1.iter().enumerate().rev() {
        sum = sum * -t + z / (i as f64 + 2.0);
    }
    t * ((1.0 - EULER) + t * sum)
}

/// ψ(x) = Γ′(x)/Γ(x): NaN at the poles. Relative accuracy near the positive zero, absolute at the negative ones.
pub fn digamma(x: f64) -> f64 {
    if x == 0.0 {
        return -1.0 / x;
    }
    if is_pole(x) || x.is_nan() || x == f64::NEG_INFINITY {
        return f64::NAN;
    }
    if x < 0.0 {
        let (sin, cos) = sin_cos_pi(x);
        return digamma(-x) - 1.0 / x - PI * cos / sin;
    }
    let from_zero = (x - PSI_ZERO) - PSI_ZERO_LOW;
    if from_zero.abs() < 0.25 {
        return from_zero * horner(&PSI_TAYLOR, from_zero);
    }
    let (mut sum, mut top) = (0.0, x);
    while top < FAR {
        sum += 1.0 / top;
        top += 1.0;
    }
    let w = 1.0 / (top * top);
    top.ln() - (0.5 / top + w * psi_series(w)) - sum
}

/// Σ B(2n) / (2n) w^(n-1) (DLMF 5.11.2).
fn psi_series(w: f64) -> f64 {
    BERNOULLI
        .iter()
        .enumerate()
        .rev()
        .fold(0.0, |sum, (i, b)| sum * w + b / (2.0 * i as f64 + 2.0))
}

/// ψ′(x): +∞ at the poles.
pub fn trigamma(x: f64) -> f64 {
    if x.is_nan() || x == f64::NEG_INFINITY {
        return f64::NAN;
    }
    if is_pole(x) {
        return f64::INFINITY;
    }
    if x < 0.0 {
        let (sin, _) = sin_cos_pi(x); // ψ′(x) = π² / sin² πx - ψ′(1 - x)
        let ratio = PI / sin;
        return ratio * ratio - (trigamma(-x) - 1.0 / (x * x));
    }
    let (mut sum, mut top) = (0.0, x);
    while top < FAR {
        sum += 1.0 / (top * top);
        top += 1.0;
    }
    let w = 1.0 / (top * top);
    sum + 1.0 / top + w * (0.5 + horner(&BERNOULLI, w) / top)
}

/// Whether Stirling's series may be used as it stands.
pub(super) fn is_far(z: Complex) -> bool {
    z.im.abs() >= FAR || z.re >= FAR
}

/// Whether a derivative of ψ is reflected: left of 0, where π²/sin² πz, about 40 e^(-2π|y|), may be more than all the
/// rest, however small, for the rest is 1/z.
pub(super) fn is_reflected(z: Complex) -> bool {
    z.re < 0.0 && z.im.abs() < 100.0
}

/// cot πz = (sin πx cos πx - i sinh πy cosh πy) / (sin² πx + sinh² πy), where no part cancels, for |y| below 100.
pub(super) fn cot_pi(z: Complex) -> Complex {
    let (sin, cos) = sin_cos_pi(z.re);
    let (sinh, cosh) = ((z.im * PI).sinh(), (z.im * PI).cosh());
    let norm = sin * sin + sinh * sinh;
    if norm < 1e-280 {
        // beside a pole, where the squares may underflow: 1/(πz)
        return complex(z.re - z.re.round(), z.im).scale(PI).inverse();
    }
    complex(sin * cos / norm, -sinh * cosh / norm)
}

/// sin πz with the real part reduced exactly.
pub(super) fn sin_pi(z: Complex) -> Complex {
    let n = z.re.round();
    let s = complex((z.re - n) * PI, z.im * PI).sin();
    if n % 2.0 == 0.0 { s } else { -s }
}

/// Σ_{k<n} g(z + k) and z + n, with the least n that makes z + n far.
fn climb(z: Complex, mut g: impl FnMut(Complex)) -> Complex {
    let mut top = z;
    while !is_far(top) {
        g(top);
        top.re += 1.0;
    }
    top
}

impl Complex {
    /// Γ(z); normwise error below 2e-14 for |z| < 10, growing as |z log z| ε beyond.
    pub fn gamma(self) -> Self {
        if self.im == 0.0 {
            let sign = if self.re > PSI_ZERO {
                self.im
            } else {
                -self.im
            };
            return complex(gamma(self.re), sign);
        }
        if !self.is_finite() {
            return if self.re == f64::INFINITY && self.im.is_finite() {
                complex(f64::INFINITY, f64::INFINITY.copysign(self.im))
            } else {
                complex(f64::NAN, f64::NAN)
            };
        }
        if self.re < 0.5 && !is_far(self) {
            // Γ(z) = π / (sin πz Γ(1 - z)) = -π / (z sin πz Γ(-z)): -z is exact
            let below = (-self).gamma_right() * self * sin_pi(self);
            return complex(-PI, 0.0) / below;
        }
        self.gamma_right()
    }

    /// Γ by the recurrence and Stirling's series, for Re z ≥ -1/2 or |Im z| large.
    fn gamma_right(self) -> Self {
        let mut product = Self::ONE;
        let top = climb(self, |z| product = product * z);
        let inverse = top.inverse();
        let log = top.log();
        let series = horner_complex(&LOG_GAMMA_SERIES, inverse.square()) * inverse;
        let power = complex(top.re - 0.5, top.im) * complex(log.re - 1.0, log.im);
        let exponent = power + complex(HALF_LOG_TAU - 0.5, 0.0) + series;
        exponent.exp() / product
    }

    /// ψ(z) = Γ′(z)/Γ(z).
    pub fn digamma(self) -> Self {
        if self.im == 0.0 {
            return complex(digamma(self.re), self.im);
        }
        if !self.is_finite() {
            return if self.re.is_nan() || self.im.is_nan() {
                complex(f64::NAN, f64::NAN)
            } else {
                self.log()
            };
        }
        if self.re < 0.0 && !is_far(self) {
            // ψ(z) = ψ(-z) - 1/z - π cot πz; the first term of the recurrence for ψ(-z) is that 1/z, and left out
            let right = (-self).digamma_right(true);
            return right - cot_pi(self).scale(PI);
        }
        self.digamma_right(false)
    }

    /// ψ by the recurrence and its series, or ψ(z + 1) without forming z + 1, which would be rounded.
    fn digamma_right(self, next: bool) -> Self {
        let mut terms: SmallVec<[Self; 16]> = SmallVec::new();
        let top = climb(self, |z| terms.push(z.inverse()));
        let extra = if !next {
            Self::ZERO
        } else if terms.is_empty() {
            self.inverse()
        } else {
            terms.remove(0);
            Self::ZERO
        };
        // the small ones first
        let sum = terms.iter().rev().fold(Self::ZERO, |sum, &t| sum + t);
        let inverse = top.inverse();
        let w = inverse.square();
        let series = BERNOULLI
            .iter()
            .enumerate()
            .rev()
            .fold(Self::ZERO, |sum, (i, b)| {
                sum * w + complex(b / (2.0 * i as f64 + 2.0), 0.0)
            });
        top.log() - inverse.scale(0.5) - w * series - sum + extra
    }

    /// ψ′(z).
    pub fn trigamma(self) -> Self {
        if self.im == 0.0 {
            return complex(trigamma(self.re), -self.im);
        }
        if !self.is_finite() {
            return if self.re.is_nan() || self.im.is_nan() {
                complex(f64::NAN, f64::NAN)
            } else {
                Self::ZERO
            };
        }
        if is_reflected(self) {
            // ψ′(z) = π² / sin² πz - ψ′(-z) + 1/z²
            let ratio = complex(PI, 0.0) / sin_pi(self);
            return ratio.square() - (-self).trigamma() + self.square().inverse();
        }
        let mut sum = Self::ZERO;
        let top = climb(self, |z| sum = sum + z.square().inverse());
        let inverse = top.inverse();
        let w = inverse.square();
        sum + inverse + w * (complex(0.5, 0.0) + horner_complex(&BERNOULLI, w) * inverse)
    }
}
