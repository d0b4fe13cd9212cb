//! The error of a result in bits, as Herbie counts it: log₂(1 + numbers between what came out and what is nearest to the
//! exact value). 0 is the right result, 1 its neighbour; half of the digits lost are 12 bits of 24.

/// An exact value as an unevaluated sum: the nearest `f64`, and what is left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exact {
    /// The nearest `f64`.
    pub hi: f64,
    /// The value less `hi`.
    pub lo: f64,
}

/// What a result that is no number costs, in single precision.
pub const ALL_SINGLE: f64 = 32.0;
/// What a result costs that has no digit right, in pairs: their 48.
pub const ALL_PAIR: f64 = 48.0;
/// What a result that is no number costs, in `f64`.
pub const ALL_DOUBLE: f64 = 64.0;

impl Exact {
    /// The `f32` nearest to the value, ties to even.
    #[must_use]
    pub fn single(self) -> f32 {
        let near = self.hi as f32;
        let rest = (self.hi - f64::from(near)) + self.lo;
        // `hi` may lie halfway between two numbers where the value does not
        let other = if rest > 0.0 {
            near.next_up()
        } else {
            near.next_down()
        };
        let to_other = (f64::from(other) - self.hi) - self.lo;
        if to_other.abs() < rest.abs() {
            other
        } else {
            near
        }
    }

    /// Error of a result, rounded to `f32`.
    #[must_use]
    pub fn single_error(self, got: f64) -> f64 {
        if got.is_nan() {
            return ALL_SINGLE;
        }
        let (got, right) = (place_single(got as f32), place_single(self.single()));
        bits(got.abs_diff(right) as f64)
    }

    /// Error of a result as an `f64`.
    #[must_use]
    pub fn double_error(self, got: f64) -> f64 {
        if got.is_nan() {
            return ALL_DOUBLE;
        }
        bits(place_double(got).abs_diff(place_double(self.hi)) as f64)
    }

    /// Error of a result as a pair: in units of 2⁻⁴⁸ of the value, or of the least subnormal `f32`, below which a pair
    /// holds nothing.
    #[must_use]
    pub fn pair_error(self, got: f64) -> f64 {
        if !got.is_finite() {
            return ALL_PAIR;
        }
        let unit = (self.hi.abs() * 2f64.powi(-48)).max(2f64.powi(-149));
        let off = ((got - self.hi) - self.lo).abs() / unit;
        bits(off).min(ALL_PAIR)
    }
}

fn bits(between: f64) -> f64 {
    between.ln_1p() / std::f64::consts::LN_2
}

/// The place of a number among all `f32`, counted from zero; both zeros are one.
fn place_single(x: f32) -> i64 {
    let size = i64::from(x.to_bits() & 0x7fff_ffff);
    if x.is_sign_negative() { -size } else { size }
}

fn place_double(x: f64) -> i64 {
    let size = (x.to_bits() & 0x7fff_ffff_ffff_ffff) as i64;
    if x.is_sign_negative() { -size } else { size }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(hi: f64, lo: f64) -> Exact {
        Exact { hi, lo }
    }

    #[test]
    fn numbers_between_are_counted() {
        let one = exact(1.0, 0.0);
        assert_eq!(one.single_error(1.0), 0.0);
        assert_eq!(one.single_error(f64::from(1f32.next_up())), 1.0);
        assert_eq!(one.single_error(1.0 - 3.0 * 2f64.powi(-24)), 2.0);
        assert_eq!(one.single_error(f64::NAN), 32.0);
        assert!(one.single_error(-1.0) > 30.9);
        let zero = exact(0.0, 0.0);
        assert_eq!(zero.single_error(-0.0), 0.0);
        assert_eq!(zero.single_error(1e-45), 1.0);
        let top = exact(f64::from(f32::MAX), 0.0);
        assert_eq!(top.single_error(f64::INFINITY), 1.0);
        assert_eq!(one.double_error(1f64.next_down()), 1.0);
        assert_eq!(one.double_error(f64::NAN), 64.0);
    }

    #[test]
    fn a_tie_is_decided_by_the_rest() {
        let half = 1.0 + 2f64.powi(-24);
        let (below, above) = (1f32, 1f32.next_up());
        assert_eq!(exact(half, 0.0).single(), below);
        assert_eq!(exact(half, 1e-20).single(), above);
        assert_eq!(exact(half, -1e-20).single(), below);
        let next = half + 2f64.powi(-23);
        assert_eq!(exact(next, 0.0).single(), above.next_up());
        assert_eq!(exact(next, -1e-20).single(), above);
        assert_eq!(exact(-half, -1e-20).single(), -above);
        assert_eq!(exact(0.0, 0.0).single(), 0.0);
    }

    #[test]
    fn pairs_are_judged_by_their_48_bits() {
        let third = exact(1.0 / 3.0, 1.850_371_7e-17);
        // 1/3 in f64 is 2^-6 units of 2^-48 off
        assert!((third.pair_error(1.0 / 3.0) - 0.0224).abs() < 1e-3);
        assert!((third.pair_error(1.0 / 3.0 + 2f64.powi(-48)) - 2.0).abs() < 0.01);
        assert_eq!(third.pair_error(f64::INFINITY), 48.0);
        assert_eq!(third.pair_error(-1.0), 48.0);
        assert!(exact(1e-60, 0.0).pair_error(0.0) < 1e-10);
    }
}
