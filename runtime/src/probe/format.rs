//! The two formats, as the judge sees them.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A binary format of IEEE 754 whose arithmetic the CPU does by the book.
pub(super) trait Format:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Words of a number.
    const WORDS: usize;
    /// Bits of the significand, with the hidden one.
    const DIGITS: i32;
    const LEAST: Self;
    const LARGEST: Self;
    const INFINITY: Self;
    const NAN: Self;
    /// The format in front of `arithmetic.wgsl`.
    const WGSL: &'static str;

    fn of(x: f64) -> Self;
    fn to_f64(self) -> f64;
    fn bits(self) -> u64;
    fn from_words(words: &[u32]) -> Self;
    /// a b + c, rounded once.
    fn fma(self, b: Self, c: Self) -> Self;
    fn root(self) -> Self;
    /// A number of this sign, exponent of 2, and bits of the significand below the first.
    fn assemble(negative: bool, exponent: i32, bits: u64) -> Self;

    fn push_words(self, words: &mut Vec<u32>) {
        let bits = self.bits();
        words.push(bits as u32);
        if Self::WORDS == 2 {
            words.push((bits >> 32) as u32);
        }
    }

    fn is_nan(self) -> bool {
        self.to_f64().is_nan()
    }
}

impl Format for f32 {
    const WORDS: usize = 1;
    const DIGITS: i32 = 24;
    const LEAST: Self = Self::MIN_POSITIVE;
    const LARGEST: Self = Self::MAX;
    const INFINITY: Self = Self::INFINITY;
    const NAN: Self = Self::NAN;
    const WGSL: &'static str = include_str!("single.wgsl");

    fn of(x: f64) -> Self {
        x as f32
    }
    fn to_f64(self) -> f64 {
        self.into()
    }
    fn bits(self) -> u64 {
        self.to_bits().into()
    }
    fn from_words(words: &[u32]) -> Self {
        Self::from_bits(words[0])
    }
    fn fma(self, b: Self, c: Self) -> Self {
        self.mul_add(b, c)
    }
    fn root(self) -> Self {
        self.sqrt()
    }
    fn assemble(negative: bool, exponent: i32, bits: u64) -> Self {
        let exponent = ((exponent + 127) as u32) << 23;
        Self::from_bits(u32::from(negative) << 31 | exponent | (bits as u32 & 0x7f_ffff))
    }
}

impl Format for f64 {
    const WORDS: usize = 2;
    const DIGITS: i32 = 53;
    const LEAST: Self = Self::MIN_POSITIVE;
    const LARGEST: Self = Self::MAX;
    const INFINITY: Self = Self::INFINITY;
    const NAN: Self = Self::NAN;
    const WGSL: &'static str = include_str!("double.wgsl");

    fn of(x: f64) -> Self {
        x
    }
    fn to_f64(self) -> f64 {
        self
    }
    fn bits(self) -> u64 {
        self.to_bits()
    }
    fn from_words(words: &[u32]) -> Self {
        Self::from_bits(u64::from(words[1]) << 32 | u64::from(words[0]))
    }
    fn fma(self, b: Self, c: Self) -> Self {
        self.mul_add(b, c)
    }
    fn root(self) -> Self {
        self.sqrt()
    }
    fn assemble(negative: bool, exponent: i32, bits: u64) -> Self {
        let exponent = ((exponent + 1023) as u64) << 52;
        Self::from_bits(u64::from(negative) << 63 | exponent | (bits & 0xf_ffff_ffff_ffff))
    }
}
