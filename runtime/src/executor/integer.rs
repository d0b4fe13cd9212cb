//! Integer functions: two's complement that wraps around, as WGSL has it.

use super::code::{Form, Int1, Int2};
use super::float::Float as _;

/// Words of an integer type.
pub(super) trait Integer: Copy + Ord {
    fn from_word(word: u64) -> Self;
    fn word(self) -> u64;
    fn unary(self, fun: Int1) -> Self;
    fn binary(self, fun: Int2, other: Self) -> Self;
}

macro_rules! integer {
    ($int:ident, $bits:ident, $abs:expr, $sign:expr, $neg:expr, $leading:expr) => {
        impl Integer for $int {
            #[inline(always)]
            fn from_word(word: u64) -> Self {
                word as $bits as $int
            }
            #[inline(always)]
            fn word(self) -> u64 {
                u64::from(self as $bits)
            }
            #[inline(always)]
            fn unary(self, fun: Int1) -> Self {
                match fun {
                    Int1::Neg => $neg(self),
                    Int1::Abs => $abs(self),
                    Int1::Not => !self,
                    Int1::Sign => $sign(self),
                    Int1::CountLeadingZeros => self.leading_zeros() as $int,
                    Int1::CountTrailingZeros => self.trailing_zeros() as $int,
                    Int1::CountOneBits => self.count_ones() as $int,
                    Int1::ReverseBits => self.reverse_bits(),
                    Int1::FirstLeadingBit => {
                        let telling: $bits = $leading(self);
                        // 31 - 32 is -1, all bits set: no bit tells
                        $bits::BITS
                            .wrapping_sub(1)
                            .wrapping_sub(telling.leading_zeros()) as i32 as $int
                    }
                    Int1::FirstTrailingBit if self == 0 => !0,
                    Int1::FirstTrailingBit => self.trailing_zeros() as $int,
                }
            }
            #[inline(always)]
            fn binary(self, fun: Int2, other: Self) -> Self {
                match fun {
                    Int2::Add => self.wrapping_add(other),
                    Int2::Sub => self.wrapping_sub(other),
                    Int2::Mul => self.wrapping_mul(other),
                    // WGSL: x / 0 is x and x % 0 is 0
                    Int2::Div if other == 0 => self,
                    Int2::Div => self.wrapping_div(other),
                    Int2::Rem if other == 0 => 0,
                    Int2::Rem => self.wrapping_rem(other),
                    Int2::Min => self.min(other),
                    Int2::Max => self.max(other),
                    // the amount modulo the width
                    Int2::ShiftLeft => self.wrapping_shl(other as u32),
                    Int2::ShiftRight => self.wrapping_shr(other as u32),
                }
            }
        }
    };
}

integer!(
    i32,
    u32,
    i32::wrapping_abs,
    i32::signum,
    i32::wrapping_neg,
    |x: i32| (x ^ (x >> 31)).cast_unsigned()
);
integer!(
    i64,
    u64,
    i64::wrapping_abs,
    i64::signum,
    i64::wrapping_neg,
    |x: i64| (x ^ (x >> 63)).cast_unsigned()
);
integer!(
    u32,
    u32,
    |x| x,
    |x: u32| u32::from(x > 0),
    u32::wrapping_neg,
    |x| x
);
integer!(
    u64,
    u64,
    |x| x,
    |x: u64| u64::from(x > 0),
    u64::wrapping_neg,
    |x| x
);

/// A number in another form. Floats to integers are cut off and saturate, NaN is 0; integers to floats are rounded to
/// nearest; integers to integers wrap around.
#[inline(always)]
pub(super) fn convert(word: u64, from: Form, to: Form) -> u64 {
    match from {
        Form::Bool => from_integer(u128::from(word & 1).cast_signed(), to),
        Form::I32 => from_integer(i128::from(i32::from_word(word)), to),
        Form::U32 => from_integer(i128::from(u32::from_word(word)), to),
        Form::I64 => from_integer(i128::from(i64::from_word(word)), to),
        Form::U64 => from_integer(i128::from(word), to),
        Form::F32 => from_float(f32::from_word(word).double(), to),
        Form::F64 => from_float(f64::from_bits(word), to),
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "conversions wrap and round as WGSL has it"
)]
fn from_integer(n: i128, to: Form) -> u64 {
    match to {
        Form::Bool => {
            if n == 0 {
                0
            } else {
                super::lanes::TRUE
            }
        }
        Form::I32 | Form::U32 => u64::from(n as u32),
        Form::I64 | Form::U64 => n as u64,
        Form::F32 => (n as f32).word(),
        Form::F64 => (n as f64).to_bits(),
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "conversions saturate as WGSL has it"
)]
fn from_float(x: f64, to: Form) -> u64 {
    match to {
        Form::Bool if x == 0.0 => 0,
        Form::Bool => super::lanes::TRUE,
        Form::I32 => (x as i32).word(),
        Form::U32 => u64::from(x as u32),
        Form::I64 => (x as i64).word(),
        Form::U64 => x as u64,
        Form::F32 => (x as f32).word(),
        Form::F64 => x.to_bits(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges() {
        assert_eq!(i32::MIN.binary(Int2::Div, -1), i32::MIN);
        assert_eq!(i32::MIN.binary(Int2::Rem, -1), 0);
        assert_eq!(7u32.binary(Int2::Div, 0), 7);
        assert_eq!((-8i32).binary(Int2::ShiftRight, 33), -4);
        assert_eq!(0u32.unary(Int1::FirstLeadingBit), u32::MAX);
        assert_eq!((-1i32).unary(Int1::FirstLeadingBit), -1);
        assert_eq!(16u32.unary(Int1::FirstLeadingBit), 4);
        assert_eq!((-9i32).unary(Int1::FirstLeadingBit), 3);
    }

    #[test]
    fn conversions() {
        let float = |x: f32| x.word();
        assert_eq!(convert(float(-1.5), Form::F32, Form::I32), 0xffff_ffff);
        assert_eq!(convert(float(-1.5), Form::F32, Form::U32), 0);
        assert_eq!(convert(float(f32::NAN), Form::F32, Form::I32), 0);
        assert_eq!(convert(float(3e9), Form::F32, Form::I32), 0x7fff_ffff);
        assert_eq!(
            convert(0xffff_ffff, Form::I32, Form::F64),
            (-1.0f64).to_bits()
        );
        assert_eq!(
            convert(16_777_217, Form::U32, Form::F32),
            float(16_777_216.0)
        );
        assert_eq!(
            convert(u64::MAX, Form::U64, Form::F32),
            float(18_446_744_073_709_551_616.0)
        );
    }
}
