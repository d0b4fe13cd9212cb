//! The error function and its kin.
//!
//! e^{x²} iⁿerfc x, the scaled repeated integrals of erfc (DLMF 7.18), are one family: the derivative of each is the next
//! one, so that no derivative cancels. The mass of a Gaussian in an interval is a difference of two of them, or a
//! quadrature where that would cancel.

use std::f64::consts::PI;

/// 2/√π
const TWO_BY_ROOT_PI: f64 = std::f64::consts::FRAC_2_SQRT_PI;
/// √π/2
const HALF_ROOT_PI: f64 = 0.886_226_925_452_758;

/// Chebyshev coefficients of (1 + 2 x) e^{x²} erfc x in (x - 3)/(x + 3), the first halved: the form of Shepherd and
/// Laframboise, "Chebyshev approximation of (1 + 2x) exp(x²) erfc x", Math. Comp. 36 (1981), with another centre;
/// shaders/wide/special.py, erfcx_double.
const ERFCX: [f64; 27] = [
    1.177_562_574_196_56,
    0.005_353_904_539_615_676,
    -0.093_775_503_422_842_09,
    0.054_366_525_557_443_22,
    -0.018_976_596_707_845_208,
    0.004_453_426_061_462_712,
    -0.000_633_553_171_055_314_7,
    1.766_171_952_317_159_3e-5,
    1.284_153_286_405_667_1e-5,
    -2.007_228_565_905_991_3e-6,
    -1.807_522_790_414_837e-7,
    7.549_828_343_825_093e-8,
    1.885_668_523_838_603e-9,
    -2.699_519_049_798_364e-9,
    -1.460_079_119_939_105e-11,
    1.036_160_744_596_948_9e-10,
    1.475_715_976_623_473e-12,
    -4.277_340_064_396_911e-12,
    -2.079_224_928_597_99e-13,
    1.813_450_200_317_696_3e-13,
    1.973_425_574_544_739e-14,
    -7.287_943_737_592_673e-15,
    -1.516_987_869_022_811_6e-15,
    2.351_411_225_878_140_3e-16,
    1.000_611_169_182_166_7e-16,
    -2.057_252_816_953_854_6e-18,
    -5.608_608_218_863_183e-18,
];

/// A value and what its rounding left out.
fn square(x: f64) -> (f64, f64) {
    let high = x * x;
    (high, x.mul_add(x, -high))
}

/// e^{-x²}; the rounding of the square does not count.
pub fn gauss(x: f64) -> f64 {
    if x.abs() > 40.0 {
        return 0.0;
    }
    let (high, low) = square(x);
    let e = (-high).exp();
    e - e * low
}

/// e^{x y}; the rounding of the product does not count.
pub fn exp_of_product(x: f64, y: f64) -> f64 {
    let product = x * y;
    let e = product.exp();
    if product.abs() > 800.0 || e.is_infinite() || e.is_nan() {
        return e;
    }
    e + e * x.mul_add(y, -product)
}

/// e^{-(x + y)²}; the rounding of the sum does not count.
pub fn gauss_of_sum(x: f64, y: f64) -> f64 {
    let sum = x + y;
    if sum.abs() > 40.0 {
        return 0.0;
    }
    let part = sum - x;
    let rest = (x - (sum - part)) + (y - part);
    gauss(sum) * (1.0 - 2.0 * sum * rest)
}

/// e^{x²}
fn inverse_gauss(x: f64) -> f64 {
    if x.abs() > 40.0 {
        return f64::INFINITY;
    }
    let (high, low) = square(x);
    let e = high.exp();
    if e.is_infinite() { e } else { e + e * low }
}

/// erf x: below 1/2 the series of DLMF 7.6.2, whose terms have one sign.
pub fn erf(x: f64) -> f64 {
    let a = x.abs();
    if a >= 0.5 {
        return (1.0 - erfc(a)).copysign(x);
    }
    let z = 2.0 * x * x;
    let series = (1..=16)
        .rev()
        .fold(1.0, |sum, k| 1.0 + z / (2.0 * f64::from(k) + 1.0) * sum);
    TWO_BY_ROOT_PI * x * gauss(x) * series
}

/// erfc x = 1 - erf x, to the last digits also where it is small.
pub fn erfc(x: f64) -> f64 {
    if x.is_nan() {
        x
    } else if x < 0.5 {
        if x > -0.5 {
            1.0 - erf(x)
        } else {
            2.0 - erfc(-x)
        }
    } else {
        gauss(x) * erfcx_right(x)
    }
}

/// e^{x²} erfc x for x ≥ 0, by Clenshaw's recurrence.
fn erfcx_right(x: f64) -> f64 {
    if x > 1e10 {
        return 1.0 / (x * PI.sqrt());
    }
    let y = (x - 3.0) / (x + 3.0);
    let (mut b, mut last) = (0.0, 0.0);
    for c in ERFCX[1..].iter().rev() {
        (b, last) = (2.0 * y * b - last + c, b);
    }
    (y * b - last + ERFCX[0]) / (1.0 + 2.0 * x)
}

/// e^{x²} iⁿerfc x (DLMF 7.18): for n = 0 the scaled complementary error function.
///
/// From 1/2 on by the continued fraction of the recurrence 7.18.7, downwards, else by the recurrence from erfcx, upwards.
pub fn erfcx(n: u8, x: f64) -> f64 {
    if x.is_nan() {
        return x;
    }
    if n > 0 && x >= 0.5 {
        return repeated_right(n, x);
    }
    let first = if x < 0.0 {
        2.0 * inverse_gauss(x) - erfcx_right(-x)
    } else {
        erfcx_right(x)
    };
    let (mut value, mut last) = (first, TWO_BY_ROOT_PI);
    for k in 0..n {
        (value, last) = (
            (last - 2.0 * x * value) / (2.0 * (f64::from(k) + 1.0)),
            value,
        );
    }
    value
}

/// The same for x ≥ 1/2: f_k / f_{k-1} = 1/(2 x + 2 (k + 1) f_{k+1}/f_k), from an index where it hardly matters.
fn repeated_right(n: u8, x: f64) -> f64 {
    if x > 1e9 {
        // the first term of the asymptotic series (DLMF 7.18.14)
        return TWO_BY_ROOT_PI * (0.5 / x).powi(i32::from(n) + 1);
    }
    let last = (180.0 / (x * x)).ceil() + f64::from(n) + 20.0;
    let mut ratio = 1.0 / (x + (x * x + 2.0 * last).sqrt());
    let mut value = TWO_BY_ROOT_PI;
    let mut k = last;
    while k > 0.0 {
        k -= 1.0;
        ratio = 1.0 / (2.0 * x + 2.0 * (k + 1.0) * ratio);
        if k <= f64::from(n) {
            value *= ratio;
        }
    }
    value
}

/// Nodes and weights of Gauss and Legendre's rule of 12 points (DLMF 3.5.v), those on the right;
/// shaders/wide/special.py, gauss_node_double.
const NODES: [(f64, f64); 6] = [
    (0.981_560_634_246_719_2, 0.047_175_336_386_511_83),
    (0.904_117_256_370_474_9, 0.106_939_325_995_318_43),
    (0.769_902_674_194_304_7, 0.160_078_328_543_346_24),
    (0.587_317_954_286_617_4, 0.203_167_426_723_065_93),
    (0.367_831_498_998_180_2, 0.233_492_536_538_354_8),
    (0.125_233_408_511_468_9, 0.249_147_045_813_402_8),
];

/// Where the exponent changes by more in an interval, the difference of its ends does not cancel.
const STEEP: f64 = 2.0;

/// ∫ e^{-u²} du over [c - w, c + w], divided by the greatest value of e^{-u²} there, 0 ≤ w ≤ c.
fn tail_mass(c: f64, w: f64) -> f64 {
    let steepness = 4.0 * c * w;
    if steepness > STEEP {
        let far = if steepness > 800.0 {
            0.0
        } else {
            (-steepness).exp() * erfcx_right(c + w)
        };
        return HALF_ROOT_PI * (erfcx_right(c - w) - far);
    }
    // u² - (c - w)² = (u - c + w)(u + c - w)
    let at = |s: f64| (-w * (1.0 + s) * (2.0 * c + w * (s - 1.0))).exp();
    w * NODES
        .iter()
        .map(|&(s, weight)| weight * (at(s) + at(-s)))
        .sum::<f64>()
}

/// ∫ tᵏ e^{-t² - 2 a t} dt over [0, 2 |w|] with a = |c| - |w|, for |w| ≤ |c| and k ≤ 3: the derivatives of the mass that is
/// divided by its greatest value are made of these.
///
/// Where the exponent changes enough ∫ over all t > 0, which is √π/2 k! e^{a²} iᵏerfc a (DLMF 7.18.2), less that from 2 |w| on.
pub fn mass_moment(k: u8, c: f64, w: f64) -> f64 {
    let (c, w) = (c.abs(), w.abs());
    let steepness = 4.0 * c * w;
    if c.is_nan() || w.is_nan() || w > c {
        return f64::NAN;
    }
    if steepness <= STEEP + f64::from(k) {
        let at = |s: f64| {
            let t = w * (1.0 + s);
            t.powi(i32::from(k)) * (-t * (2.0 * c + w * (s - 1.0))).exp()
        };
        let sum = NODES
            .iter()
            .map(|&(s, weight)| weight * (at(s) + at(-s)))
            .sum::<f64>();
        return w * sum;
    }
    let factorial = |n: u8| (1..=n).map(f64::from).product::<f64>();
    // (t + 2w)ᵏ = Σ k!/(j! (k - j)!) tʲ (2w)ᵏ⁻ʲ
    let far = if steepness > 800.0 {
        0.0
    } else {
        let term = |j: u8| (2.0 * w).powi(i32::from(k - j)) / factorial(k - j) * erfcx(j, c + w);
        (-steepness).exp() * (0..=k).map(term).sum::<f64>()
    };
    HALF_ROOT_PI * factorial(k) * (erfcx(k, c - w) - far)
}

/// The mass of e^{-u²} in [c - w, c + w] for w ≥ 0, and whether it is still to be multiplied by e^{-(|c| - w)²}.
fn mass(c: f64, w: f64) -> (f64, bool) {
    if w <= c {
        (tail_mass(c, w), true)
    } else {
        (HALF_ROOT_PI * (erf(w + c) + erf(w - c)), false)
    }
}

/// (√π/2) (erf(c + w) - erf(c - w)): the integral of e^{-u²} over the interval with centre c and half-width w. Odd in w.
pub fn gauss_mass(c: f64, w: f64) -> f64 {
    let (c, width) = (c.abs(), w.abs());
    let (mass, is_scaled) = mass(c, width);
    let size = if is_scaled {
        mass * gauss_of_sum(c, -width)
    } else {
        mass
    };
    size.copysign(w)
}

/// The same divided by the greatest value of e^{-u²} in the interval.
pub fn gauss_mass_scaled(c: f64, w: f64) -> f64 {
    mass(c.abs(), w.abs()).0.copysign(w)
}
