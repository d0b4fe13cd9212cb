//! Decimals as sums of two `f64`, about 106 bits: references must be known better than the formats that they judge.

/// The unevaluated sum of both, with |low| at most half an ulp of high.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Double {
    /// The nearest `f64`.
    pub high: f64,
    /// What is missing.
    pub low: f64,
}

impl Double {
    /// A decimal such as `-1.25e-7`, `inf` or `nan`; of its digits the first 36 count.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let high: f64 = text.parse().ok()?;
        if high == 0.0 || !high.is_finite() {
            return Some(Self { high, low: 0.0 });
        }
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (mut digits, mut count, mut shift) = (0u128, 0, 0);
        let mut point = false;
        for c in mantissa.chars() {
            match c {
                '.' => point = true,
                '0'..='9' if count < 36 => {
                    digits = digits * 10 + u128::from(c as u8 - b'0');
                    count += i32::from(digits > 0);
                    shift -= i32::from(point);
                }
                '0'..='9' => shift += i32::from(!point),
                _ => {}
            }
        }
        let magnitude = Self::whole(digits).times_power_of_ten(exponent + shift);
        let magnitude = if high < 0.0 {
            Self {
                high: -magnitude.high,
                low: -magnitude.low,
            }
        } else {
            magnitude
        };
        // `high` is correctly rounded; what is left over is small, and its own error does not matter
        let low = (magnitude.high - high) + magnitude.low;
        Some(Self {
            high,
            low: if low.is_finite() { low } else { 0.0 },
        })
    }

    fn whole(n: u128) -> Self {
        let high = n as f64;
        // the difference is below 2⁷⁵, and is rounded to 53 bits of its own
        let low = n.wrapping_sub(high as u128) as i128 as f64;
        Self { high, low }
    }

    fn times_power_of_ten(self, exponent: i32) -> Self {
        let mut power = Self {
            high: 1.0,
            low: 0.0,
        };
        let mut square = Self {
            high: 10.0,
            low: 0.0,
        };
        let mut left = exponent.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                power = power.times(square);
            }
            square = square.times(square);
            left >>= 1;
        }
        if exponent < 0 {
            self.over(power)
        } else {
            self.times(power)
        }
    }

    /// The product, to about 2⁻¹⁰² (T. J. Dekker, "A floating-point technique for extending the available precision",
    /// 1971, with a fused multiply-add for the product's error).
    fn times(self, other: Self) -> Self {
        let high = self.high * other.high;
        let error = self.high.mul_add(other.high, -high);
        let low = error + (self.high * other.low + self.low * other.high);
        Self::normal(high, low)
    }

    /// The quotient, likewise.
    fn over(self, other: Self) -> Self {
        let high = self.high / other.high;
        let rest = high.mul_add(-other.high, self.high);
        let low = (rest + self.low - high * other.low) / other.high;
        Self::normal(high, low)
    }

    fn normal(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self {
            high: sum,
            low: low - (sum - high),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_keep_more_digits_than_a_double() {
        let check = |text: &str, high: f64, low: f64| {
            let found = Double::parse(text).unwrap();
            assert_eq!(found.high, high, "{text}");
            assert!(
                (found.low - low).abs() <= 1e-13 * low.abs() + high.abs() * 2f64.powi(-101),
                "{text}: {} for {low}",
                found.low
            );
        };
        check("1", 1.0, 0.0);
        check("-0.5e1", -5.0, 0.0);
        check("inf", f64::INFINITY, 0.0);
        // 0.1 as f64 is 0.1000000000000000055511151231257827…
        check("0.1", 0.1, -5.551115123125783e-18);
        check("-0.10", -0.1, 5.551115123125783e-18);
        check("1e-1", 0.1, -5.551115123125783e-18);
        // π − 3.141592653589793115997963468544…
        check(
            "3.14159265358979323846264338327950288",
            std::f64::consts::PI,
            1.2246467991473532e-16,
        );
        // 1e23 as f64 is 99999999999999991611392
        check("1e23", 1e23, 8388608.0);
        // 3 · 2⁻¹⁰⁰
        check(
            "2.366582715663035416235185695848e-30",
            3.0 * 2f64.powi(-100),
            0.0,
        );
    }

    #[test]
    fn no_text_that_is_no_number() {
        for text in ["", "-", "x", "1e", "±0.0"] {
            assert_eq!(Double::parse(text), None, "{text}");
        }
    }
}
