//! How a real number is held in a shader.

/// The format that a tier computes in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Format {
    /// One `f32`; a complex number is a `vec2<f32>`.
    #[default]
    Single,
    /// An unevaluated sum of two `f32`, the greater first, about 48 bits; a complex number is a structure.
    Pair,
    /// One `f64`; a complex number is a structure.
    Double,
}

impl Format {
    /// Bits of the significand: the greatest relative error of a rounding is two to minus this.
    #[must_use]
    pub fn bits(self) -> u32 {
        match self {
            Self::Single => 24,
            Self::Pair => 48,
            Self::Double => 53,
        }
    }

    /// Whether numbers are held in more than one `f32`.
    #[must_use]
    pub fn is_wide(self) -> bool {
        self != Self::Single
    }

    /// The number nearest to `x` as the two words that a wide shader takes: the bits of both parts of a pair, or the
    /// lower and the upper half of a `f64`. A single is the first word.
    #[must_use]
    pub fn words(self, x: f64) -> [u32; 2] {
        if self == Self::Double {
            let bits = x.to_bits();
            return [low_word(bits), low_word(bits >> 32)];
        }
        let high = to_single(x);
        let rest = x - f64::from(high);
        let low = if self == Self::Pair && rest.is_finite() {
            to_single(rest)
        } else {
            0.0
        };
        [high.to_bits(), low.to_bits()]
    }

    /// The number that two words stand for; exact.
    #[must_use]
    pub fn from_words(self, [first, second]: [u32; 2]) -> f64 {
        let high = f64::from(f32::from_bits(first));
        match self {
            Self::Single => high,
            // the low part of an infinity is 0, but -0 is -0 alone
            Self::Pair if second << 1 == 0 => high,
            Self::Pair => high + f64::from(f32::from_bits(second)),
            Self::Double => f64::from_bits(u64::from(second) << 32 | u64::from(first)),
        }
    }
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "rounding to the shader's format is meant"
)]
fn to_single(x: f64) -> f32 {
    x as f32
}

#[allow(clippy::cast_possible_truncation, reason = "the lower half is meant")]
fn low_word(bits: u64) -> u32 {
    bits as u32
}

#[cfg(test)]
mod tests {
    use super::Format;

    const SPECIAL: [f64; 10] = [
        0.0,
        -0.0,
        1.0,
        -2.5,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        3e38,
        1e-30,
        -7e20,
    ];

    #[test]
    fn words_give_the_number_back() {
        for x in SPECIAL {
            assert_eq!(
                Format::Double.from_words(Format::Double.words(x)).to_bits(),
                x.to_bits()
            );
            let back = Format::Pair.from_words(Format::Pair.words(x));
            assert!(back == x || (back - x).abs() <= 2f64.powi(-48) * x.abs() || x.is_nan());
            assert_eq!(back.is_sign_negative(), x.is_sign_negative(), "{x}");
        }
        assert_eq!(
            Format::Pair.from_words(Format::Pair.words(1e300)),
            f64::INFINITY
        );
    }

    #[test]
    fn a_pair_is_as_near_as_48_bits() {
        let mut x = 0.1_f64;
        for _ in 0..1000 {
            x = (x * 1.37).rem_euclid(1000.0) + 1e-3;
            let back = Format::Pair.from_words(Format::Pair.words(x));
            assert!((back - x).abs() <= 2f64.powi(-48) * x);
        }
    }
}
