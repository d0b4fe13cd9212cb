//! Random arguments, the same ones in every run.

/// Xorshift (G. Marsaglia, "Xorshift RNGs", 2003).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Default for Random {
    fn default() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }
}

/// Where random arguments lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// Every size that float32 has.
    Sizes,
    /// Up to 8.
    Ordinary,
    /// Close to whole and half numbers, where zeros, poles and branch points are.
    Halves,
}

impl Spread {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Sizes, Self::Ordinary, Self::Halves];
}

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// In [0, 1).
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A normal float32.
    pub fn single(&mut self, spread: Spread) -> f64 {
        let sign = if self.next() >> 63 == 0 { 1.0 } else { -1.0 };
        let size = match spread {
            Spread::Sizes => 2f64.powf(self.unit() * 253.0 - 126.0),
            Spread::Ordinary => 8.0 * self.unit(),
            Spread::Halves => {
                (self.unit() * 9.0).floor() / 2.0 + 2f64.powf(-24.0 * self.unit()) * 0.5
            }
        };
        f64::from((sign * size.max(f64::from(f32::MIN_POSITIVE))) as f32)
    }

    /// The sum of two float32, the lower one below half an ulp of the upper one: a pair of the tier `extended`.
    pub fn pair(&mut self, spread: Spread) -> f64 {
        let high = self.single(spread);
        // a lower half that could be subnormal is none: adapters may flush it
        if high.abs() < 2f64.powi(-76) {
            return high;
        }
        let half = high.abs() * 2f64.powi(-25);
        let low = (2.0 * self.unit() - 1.0) * half;
        high + f64::from(low as f32)
    }
}
