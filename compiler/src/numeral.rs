//! Numbers as they stand in messages.

use std::fmt;

/// Longest form without an exponent.
const MAX_PLAIN: usize = 18;

/// A number as a person would write it: with an exponent where it would be long without. It reads back as the same
/// number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numeral(pub f64);

impl fmt::Display for Numeral {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plain = self.0.to_string();
        if plain.len() <= MAX_PLAIN {
            f.write_str(&plain)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Numeral;

    #[test]
    fn long_numbers_have_an_exponent() {
        let check = |x: f64, text: &str| {
            assert_eq!(Numeral(x).to_string(), text);
            assert_eq!(text.parse(), Ok(x));
        };
        check(0.5, "0.5");
        check(-1200.0, "-1200");
        check(1e308, "1e308");
        check(5e-324, "5e-324");
        check(-1.25e-30, "-1.25e-30");
    }
}
