//! Rows that are hard to get right: pseudo-random, the same every time.

use super::format::Format;

/// Pairs of which a fifth each is: of about the same size; of sizes far apart; nearly opposite; with a quotient next to the
/// midpoint of two neighbours; and with a root of the first next to one.
pub(super) fn pairs<F: Format>(count: usize) -> Vec<[F; 2]> {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    (0..count).map(|i| pair(i % 5, &mut random)).collect()
}

fn pair<F: Format>(kind: usize, random: &mut Random) -> [F; 2] {
    let a: F = random.number(-8, 8);
    match kind {
        0 => [a, random.number(-8, 8)],
        1 => [a, random.number(-26, 14)],
        2 => {
            // The same but for the last bits and the sign.
            let last = F::of(2f64.powi(12 - F::DIGITS));
            [a, -(a + a * last * F::of((random.next() & 15) as f64))]
        }
        3 => {
            let b: F = random.positive(-8, 8);
            let quotient: F = random.positive(0, 1);
            [midpoint(quotient, b), b]
        }
        _ => {
            let root: F = random.positive(-4, 4);
            [midpoint(root, root), random.positive(-8, 8)]
        }
    }
}

/// The rounded product of b and the midpoint above `q`; of the midpoint and itself if b is q.
fn midpoint<F: Format>(q: F, b: F) -> F {
    let half = ulp(q) * F::of(0.5);
    if q.bits() == b.bits() {
        // (q + h)² = q² + 2 q h + h²
        return q.fma(q, (q + q) * half);
    }
    q.fma(b, half * b)
}

/// The unit in the last place of a normal number, as a number of its format.
pub(super) fn ulp<F: Format>(x: F) -> F {
    let shift = F::DIGITS - 1;
    let exponent = (x.bits() << 1 << (64 - 32 * F::WORDS as u32)) >> (64 - exponent_bits::<F>());
    let bias = (1 << (exponent_bits::<F>() - 1)) - 1;
    F::of(2f64.powi(exponent as i32 - bias - shift))
}

fn exponent_bits<F: Format>() -> u32 {
    32 * F::WORDS as u32 - F::DIGITS as u32
}

/// Xorshift (G. Marsaglia, "Xorshift RNGs", 2003).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 >> 8
    }

    /// A number with an exponent in [low, high).
    fn positive<F: Format>(&mut self, low: i32, high: i32) -> F {
        let exponent = low + (self.next() % (high - low) as u64) as i32;
        F::assemble(false, exponent, self.next())
    }

    /// Likewise, of either sign.
    fn number<F: Format>(&mut self, low: i32, high: i32) -> F {
        let number: F = self.positive(low, high);
        if self.next() & 1 == 1 {
            -number
        } else {
            number
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<F: Format>() {
        let rows = pairs::<F>(5000);
        for (i, [a, b]) in rows.iter().enumerate() {
            // Errors of products must be normal numbers, and sums must not overflow.
            let sizes = [a.to_f64().abs(), b.to_f64().abs()];
            assert!(
                sizes.iter().all(|x| (1e-9..1e5).contains(x)),
                "{i}: {sizes:?}"
            );
        }
        // Quotients within a twentieth of an ulp of a midpoint are among them, and so are roots.
        let near = |x: F, error: f64| ((error / ulp(x).to_f64()).abs() - 0.5).abs() < 0.05;
        let quotients = rows.iter().skip(3).step_by(5).filter(|&&[a, b]| {
            let q = a / b;
            near(q, q.fma(b, -a).to_f64() / b.to_f64())
        });
        assert!(quotients.count() > 20);
        let roots = rows.iter().skip(4).step_by(5).filter(|&&[a, _]| {
            let r = a.root();
            near(r, r.fma(r, -a).to_f64() / (2.0 * r.to_f64()))
        });
        assert!(roots.count() > 20);
    }

    #[test]
    fn rows_are_hard_and_of_modest_size() {
        check::<f32>();
        check::<f64>();
    }

    #[test]
    fn units_in_the_last_place() {
        assert_eq!(ulp(1f32), f32::EPSILON);
        assert_eq!(ulp(-3f32), 2.0 * f32::EPSILON);
        assert_eq!(ulp(0.75f64), f64::EPSILON / 2.0);
    }
}
