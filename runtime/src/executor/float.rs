//! Floating-point functions of both formats.
//!
//! Sums, products, quotients and square roots are those of IEEE 754, rounded once, and `fma` is fused. What IEEE 754 does not
//! define is computed in `f64` and rounded to the format.

use super::code::{Float1, Float2, Float3};

/// A floating-point format.
pub(super) trait Float:
    Copy
    + PartialOrd
    + std::ops::Add<Output = Self>
    + std::ops::Sub<Output = Self>
    + std::ops::Mul<Output = Self>
    + std::ops::Div<Output = Self>
    + std::ops::Rem<Output = Self>
    + std::ops::Neg<Output = Self>
{
    fn from_word(word: u64) -> Self;
    fn word(self) -> u64;
    /// The nearest number of the format.
    fn nearest(x: f64) -> Self;
    fn double(self) -> f64;
    fn abs(self) -> Self;
    fn floor(self) -> Self;
    fn ceil(self) -> Self;
    fn trunc(self) -> Self;
    fn round_ties_even(self) -> Self;
    fn sqrt(self) -> Self;
    fn mul_add(self, b: Self, c: Self) -> Self;
}

macro_rules! format {
    ($format:ident, $from:expr, $word:expr, $whole:expr) => {
        impl Float for $format {
            #[inline(always)]
            fn from_word(word: u64) -> Self {
                $from(word)
            }
            #[inline(always)]
            fn word(self) -> u64 {
                $word(self)
            }
            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, reason = "rounding is meant")]
            fn nearest(x: f64) -> Self {
                x as $format
            }
            #[inline(always)]
            fn double(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $format::abs(self)
            }
            #[inline(always)]
            fn floor(self) -> Self {
                // without instructions that only newer processors have
                let nearest = self.round_ties_even();
                nearest - if nearest > self { 1.0 } else { 0.0 }
            }
            #[inline(always)]
            fn ceil(self) -> Self {
                -Float::floor(-self)
            }
            #[inline(always)]
            fn trunc(self) -> Self {
                Float::floor($format::abs(self)).copysign(self)
            }
            #[inline(always)]
            fn round_ties_even(self) -> Self {
                // from here on every number is whole
                const WHOLE: $format = $whole;
                let size = $format::abs(self);
                let nearest = (size + WHOLE) - WHOLE;
                if size < WHOLE {
                    nearest.copysign(self)
                } else {
                    self
                }
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $format::sqrt(self)
            }
            #[inline(always)]
            fn mul_add(self, b: Self, c: Self) -> Self {
                $format::mul_add(self, b, c)
            }
        }
    };
}

format!(f64, f64::from_bits, f64::to_bits, 4_503_599_627_370_496.0);
format!(
    f32,
    |word: u64| f32::from_bits(word as u32),
    |x: f32| u64::from(x.to_bits()),
    8_388_608.0
);

/// Whether a function costs so much that lanes which do not run are worth skipping.
pub(super) fn is_costly(fun: Float1) -> bool {
    use Float1 as F;
    !matches!(
        fun,
        F::Neg
            | F::Abs
            | F::Floor
            | F::Ceil
            | F::Round
            | F::Trunc
            | F::Fract
            | F::Sqrt
            | F::InverseSqrt
            | F::Sign
            | F::Saturate
            | F::Radians
            | F::Degrees
    )
}

/// A function without a definition in IEEE 754, as one of `f64`.
pub(super) fn double(fun: Float1) -> fn(f64) -> f64 {
    use Float1 as F;
    match fun {
        F::Sin => f64::sin,
        F::Cos => f64::cos,
        F::Tan => f64::tan,
        F::Asin => f64::asin,
        F::Acos => f64::acos,
        F::Atan => f64::atan,
        F::Sinh => f64::sinh,
        F::Cosh => f64::cosh,
        F::Tanh => f64::tanh,
        F::Asinh => pullback_compiler::reference::real::asinh,
        F::Acosh => pullback_compiler::reference::real::acosh,
        F::Atanh => pullback_compiler::reference::real::atanh,
        F::Exp => f64::exp,
        F::Exp2 => f64::exp2,
        F::Log => f64::ln,
        F::Log2 => f64::log2,
        F::InverseSqrt => |x| 1.0 / x.sqrt(),
        F::Radians => f64::to_radians,
        F::Degrees => f64::to_degrees,
        F::Neg
        | F::Abs
        | F::Floor
        | F::Ceil
        | F::Round
        | F::Trunc
        | F::Fract
        | F::Sqrt
        | F::Sign
        | F::Saturate => |x| x,
    }
}

/// The other operand where one is NaN.
#[inline(always)]
pub(super) fn min<F: Float>(a: F, b: F) -> F {
    // a NaN is unequal to itself
    #[allow(clippy::eq_op, reason = "this is how NaN is told in any format")]
    if b < a || a != a { b } else { a }
}

/// The other operand where one is NaN.
#[inline(always)]
pub(super) fn max<F: Float>(a: F, b: F) -> F {
    #[allow(clippy::eq_op, reason = "this is how NaN is told in any format")]
    if b > a || a != a { b } else { a }
}

/// 1, 0 or -1; a zero and a NaN are their own signs.
#[inline(always)]
pub(super) fn sign<F: Float>(x: F) -> F {
    let zero = F::nearest(0.0);
    if x > zero {
        F::nearest(1.0)
    } else if x < zero {
        F::nearest(-1.0)
    } else {
        x
    }
}

/// min(max(x, low), high)
#[inline(always)]
pub(super) fn clamp<F: Float>(x: F, low: F, high: F) -> F {
    min(max(x, low), high)
}

/// a (1 - t) + b t, as WGSL has it.
#[inline(always)]
pub(super) fn mix<F: Float>(a: F, b: F, t: F) -> F {
    a * (F::nearest(1.0) - t) + b * t
}

/// t² (3 - 2t) for t = clamp((x - low) / (high - low), 0, 1), as WGSL has it.
#[inline(always)]
pub(super) fn smooth_step<F: Float>(low: F, high: F, x: F) -> F {
    let t = clamp((x - low) / (high - low), F::nearest(0.0), F::nearest(1.0));
    t * t * (F::nearest(3.0) - F::nearest(2.0) * t)
}

/// Calls `$run` with the cheap function of one operand.
macro_rules! cheap_function {
    ($fun:expr, $f:ty, $run:ident) => {
        match $fun {
            Float1::Neg => $run!(|x: $f| -x),
            Float1::Abs => $run!(|x: $f| x.abs()),
            Float1::Floor => $run!(|x: $f| Float::floor(x)),
            Float1::Ceil => $run!(|x: $f| Float::ceil(x)),
            Float1::Round => $run!(|x: $f| Float::round_ties_even(x)),
            Float1::Trunc => $run!(|x: $f| Float::trunc(x)),
            Float1::Fract => $run!(|x: $f| x - Float::floor(x)),
            Float1::Sqrt => $run!(|x: $f| x.sqrt()),
            Float1::Sign => $run!(|x: $f| float::sign(x)),
            Float1::Saturate => {
                $run!(|x: $f| float::clamp(x, <$f>::nearest(0.0), <$f>::nearest(1.0)))
            }
            fun => {
                let double = float::double(fun);
                $run!(|x: $f| <$f>::nearest(double(x.double())))
            }
        }
    };
}
pub(super) use cheap_function;

/// The function of two operands that costs much, as one of `f64`.
pub(super) fn double2(fun: Float2) -> Option<fn(f64, f64) -> f64> {
    match fun {
        Float2::Pow => Some(f64::powf),
        Float2::Atan2 => Some(f64::atan2),
        _ => None,
    }
}

/// The value of a function of three operands.
#[inline(always)]
pub(super) fn ternary<F: Float>(fun: Float3, a: F, b: F, c: F) -> F {
    match fun {
        Float3::Fma => a.mul_add(b, c),
        Float3::Clamp => clamp(a, b, c),
        Float3::Mix => mix(a, b, c),
        Float3::SmoothStep => smooth_step(a, b, c),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_keep_every_bit() {
        for x in [0.0f32, -0.0, 1e-45, f32::MAX, f32::NEG_INFINITY] {
            assert_eq!(f32::from_word(x.word()).to_bits(), x.to_bits());
            assert_eq!(<f64 as Float>::from_word(f64::from(x).word()), f64::from(x));
        }
    }

    #[test]
    fn nan_gives_way() {
        assert_eq!(min(f32::NAN, 2.0), 2.0);
        assert_eq!(min(2.0, f32::NAN), 2.0);
        assert_eq!(max(f64::NAN, -1.0), -1.0);
        assert!(sign(f64::NAN).is_nan());
        assert_eq!(sign(-0.0f32).to_bits(), (-0.0f32).to_bits());
    }

    #[test]
    fn formulas_of_wgsl() {
        assert_eq!(mix(1.0f32, 3.0, 0.5), 2.0);
        assert_eq!(smooth_step(0.0, 2.0, 1.0), 0.5);
        assert_eq!(smooth_step(0.0f32, 2.0, 5.0), 1.0);
        assert_eq!(clamp(5.0, 0.0, 1.0), 1.0);
    }

    /// The bits of what the standard library gives, of zeros too.
    #[test]
    fn whole_numbers() {
        let near = |x: f64| [x, x.next_up(), x.next_down(), x + 0.5, x - 0.5];
        let mut all = vec![
            f64::INFINITY,
            f64::MAX,
            f64::MIN_POSITIVE,
            1e-310,
            0.49999999999999994,
        ];
        for k in [
            0.0,
            1.0,
            2.0,
            3.0,
            8_388_607.0,
            8_388_608.0,
            16_777_216.0,
            2f64.powi(51),
            2f64.powi(52),
            2f64.powi(53),
        ] {
            all.extend(near(k));
        }
        for x in all.iter().flat_map(|&x| [x, -x]) {
            let same = |a: f64, b: f64| assert_eq!(a.to_bits(), b.to_bits(), "{x:e}: {a}, not {b}");
            same(Float::floor(x), x.floor());
            same(Float::ceil(x), x.ceil());
            same(Float::trunc(x), x.trunc());
            same(Float::round_ties_even(x), x.round_ties_even());
            let narrow = x as f32;
            let same =
                |a: f32, b: f32| assert_eq!(a.to_bits(), b.to_bits(), "{narrow:e}: {a}, not {b}");
            same(Float::floor(narrow), narrow.floor());
            same(Float::ceil(narrow), narrow.ceil());
            same(Float::trunc(narrow), narrow.trunc());
            same(Float::round_ties_even(narrow), narrow.round_ties_even());
        }
        assert!(Float::floor(f64::NAN).is_nan() && Float::trunc(f32::NAN).is_nan());
    }
}
