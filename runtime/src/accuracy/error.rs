//! Errors in units of a number format, and the classes of numbers that have none.

pub use pullback_compiler::lower::Format;

use super::tables::Expected;

/// The least value that rounds to an infinity of binary32.
pub const OVERFLOW: f64 = f32::MAX as f64 * (1.0 + 1.0 / (1u64 << 25) as f64);
/// Tables write what is below this as a zero.
const NOTHING: f64 = 1e-46;

/// How results of a format are judged. Of binary32 subnormal results may be zero; a pair of binary32 has a unit of 2⁻⁴⁸ of
/// the result, and may lose what is below 2⁻¹²⁶, also in its lower half; of binary64 only the range of binary32 is judged.
pub trait Judge {
    /// What errors of a number of this size are counted in.
    fn unit(self, size: f64) -> f64;
    /// The unit in words.
    fn unit_words(self) -> &'static str;
    /// How many leading bits of a result are right where its error is this many units.
    fn right_bits(self, units: f64) -> f64;
    /// Error of a result in units of what it should be, or of `size` where that is greater. Infinite where the result
    /// is of the wrong class: a NaN for a number, a wrong infinity, a wrong sign of a zero.
    fn error(self, got: f64, expected: Expected, size: f64) -> f64;
}

impl Judge for Format {
    fn unit(self, size: f64) -> f64 {
        let (digits, least) = match self {
            Self::Single => (23, -149),
            Self::Double => (52, -1074),
            Self::Pair => return (size.abs() * 2f64.powi(-48)).max(2f64.powi(-149)),
        };
        let exponent = ((size.abs().to_bits() >> 52) as i32 - 1023).min(1023);
        2f64.powi((exponent - digits).max(least))
    }

    fn unit_words(self) -> &'static str {
        match self {
            Self::Single => "ulp of float32",
            Self::Pair => "2⁻⁴⁸ of the result",
            Self::Double => "ulp of float64",
        }
    }

    fn right_bits(self, units: f64) -> f64 {
        let all = f64::from(self.bits());
        // an ulp is 2⁻²³ or 2⁻⁵² of a number just above a power of two
        let first = if self == Self::Pair { all } else { all - 1.0 };
        (first - units.log2()).clamp(0.0, all)
    }

    fn error(self, got: f64, expected: Expected, size: f64) -> f64 {
        let Expected::Number {
            value,
            rest,
            signed,
        } = expected
        else {
            return 0.0;
        };
        let wrong = f64::INFINITY;
        if value.is_nan() {
            return if got.is_nan() { 0.0 } else { wrong };
        }
        if got.is_nan() {
            return wrong;
        }
        let same_sign = !signed || got.is_sign_negative() == value.is_sign_negative();
        let vanishes = match self {
            Self::Single | Self::Pair => got == 0.0 && value.abs() < f64::from(f32::MIN_POSITIVE),
            Self::Double => got.abs() < NOTHING && value == 0.0,
        };
        if vanishes {
            return if same_sign { 0.0 } else { wrong };
        }
        if value.is_infinite() {
            let reached = match self {
                Self::Single | Self::Pair => got.is_infinite(),
                Self::Double => got.abs() >= OVERFLOW,
            };
            return if reached && same_sign { 0.0 } else { wrong };
        }
        if got.is_infinite() && self == Self::Double {
            return wrong;
        }
        let top = 2f64.powi(128);
        let got = if got.is_infinite() {
            top.copysign(got)
        } else {
            got
        };
        let size = value.abs().max(size.min(f64::from(f32::MAX)));
        let distance = ((got - value) - rest).abs();
        (distance - slack(self)).max(0.0) / self.unit(size)
    }
}

/// What may be lost below the range of a format.
fn slack(format: Format) -> f64 {
    match format {
        Format::Pair => f64::from(f32::MIN_POSITIVE),
        Format::Single | Format::Double => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(format: Format, got: f64, value: f64) -> f64 {
        format.error(
            got,
            Expected::Number {
                value,
                rest: 0.0,
                signed: true,
            },
            0.0,
        )
    }

    #[test]
    fn classes_are_told_apart() {
        let wrong = [
            (0.0, -0.0),
            (-0.0, 0.0),
            (f64::NAN, 1.0),
            (1.0, f64::NAN),
            (f64::NEG_INFINITY, f64::INFINITY),
            (3e38, f64::INFINITY),
            (0.0, f64::NAN),
        ];
        for (got, value) in wrong {
            for format in [Format::Single, Format::Pair, Format::Double] {
                assert_eq!(error(format, got, value), f64::INFINITY, "{got} {value}");
            }
        }
        assert_eq!(error(Format::Single, f64::NAN, f64::NAN), 0.0);
        assert_eq!(error(Format::Single, -f64::INFINITY, -f64::INFINITY), 0.0);
        assert_eq!(error(Format::Double, 1e300, f64::INFINITY), 0.0);
        assert_eq!(error(Format::Single, 0.0, 1e-39), 0.0);
        assert_eq!(error(Format::Pair, 0.0, 1e-39), 0.0);
        assert!(error(Format::Single, 0.0, 2e-38) > 1e6);
        assert!(error(Format::Pair, 0.0, 2e-38) > 1e6);
        assert!(error(Format::Double, 0.0, 1e-39) > 1e6);
    }

    #[test]
    fn errors_are_counted_in_units_of_the_format() {
        assert_eq!(error(Format::Single, f64::from(1.0f32.next_up()), 1.0), 1.0);
        assert_eq!(error(Format::Double, 1.0f64.next_up(), 1.0), 1.0);
        assert_eq!(error(Format::Pair, 3.0 + 3.0 * 2f64.powi(-44), 3.0), 16.0);
        assert_eq!(error(Format::Single, -1.0, 1.0), 2f64.powi(24));
        let least = f64::from(f32::from_bits(1));
        assert_eq!(error(Format::Single, 3.0 * least, least), 2.0);
        assert!(error(Format::Single, f64::INFINITY, f64::from(f32::MAX)) <= 1.0);
        let zero = Expected::Number {
            value: 0.0,
            rest: 0.0,
            signed: true,
        };
        assert_eq!(Format::Single.error(1.5 * 2f64.powi(-23), zero, 1.0), 1.5);
    }

    /// A reference beyond binary64 tells one ulp from a half.
    #[test]
    fn the_rest_of_a_reference_counts() {
        let between = Expected::Number {
            value: 1.0,
            rest: 2f64.powi(-54),
            signed: true,
        };
        assert_eq!(Format::Double.error(1.0, between, 0.0), 0.25);
        assert_eq!(Format::Double.error(1.0f64.next_up(), between, 0.0), 0.75);
    }

    #[test]
    fn bits_are_those_of_the_worst_case() {
        assert_eq!(Format::Single.right_bits(0.0), 24.0);
        assert_eq!(Format::Single.right_bits(1.0), 23.0);
        assert_eq!(Format::Pair.right_bits(64.0), 42.0);
        assert_eq!(Format::Single.right_bits(1e30), 0.0);
    }
}
