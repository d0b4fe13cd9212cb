//! Hashing of lattice points, as `pullback_compiler::reference::hash` has it, in parts that neighbours share: words of
//! coordinates, the innermost permuted first, each sum of a coordinate's word and the permuted word of those inside of it.
//!
//! There is no branch in it, so that lanes go through it side by side.

use super::float::Float;

/// Set in the word of what is not finite as an f32, and in all words that come of it.
const UNDEFINED: u64 = 1 << 63;
/// What counts of the other words.
const WORD: u64 = 0xffff_ffff;
/// 1.5 · 2⁵²: the last bits of its sum with a whole number are that number's in two's complement.
const TELLING: f64 = 6_755_399_441_055_744.0;
/// 2⁵², the bits of whose sum with a lesser whole number are those of both.
const WHOLE: f64 = 4_503_599_627_370_496.0;

/// The word of a coordinate: ⌊x⌋ in two's complement below 2³¹, the bits of the float32 x from there on.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    reason = "the last bits and the nearest float32 are meant"
)]
pub(super) fn lattice_word(x: f64) -> u64 {
    let whole = (Float::floor(x) + TELLING).to_bits() & WORD;
    let nearest = x as f32;
    let small = (-2_147_483_647.0..2_147_483_648.0).contains(&x);
    let word = if small {
        whole
    } else {
        nearest.to_bits().into()
    };
    word | if nearest.abs() < f32::INFINITY {
        0
    } else {
        UNDEFINED
    }
}

/// The permuted sum of two words: one step and the output function of PCG-RXS-M-XS-32 (O'Neill, PCG: A Family of Simple Fast
/// Space-Efficient Statistically Good Algorithms for Random Number Generation, 2014).
#[inline(always)]
pub(super) fn hash_words(a: u64, b: u64) -> u64 {
    let sum = a.wrapping_add(b) & WORD;
    let state = (sum * 747_796_405 + 2_891_336_453) & WORD;
    let word = (((state >> ((state >> 28) + 4)) ^ state) * 277_803_737) & WORD;
    (word >> 22) ^ word | (a | b) & UNDEFINED
}

/// The number in [0, 1) of a permuted word, a multiple of 2⁻²⁴; NaN of one that is undefined.
#[inline(always)]
pub(super) fn hash_number(word: u64) -> f64 {
    let number = f64::from_bits(WHOLE.to_bits() | (word & WORD) >> 8) - WHOLE;
    if word & UNDEFINED == 0 {
        number / 16_777_216.0
    } else {
        f64::NAN
    }
}

#[cfg(test)]
mod tests {
    use pullback_compiler::reference::hash::hash;

    use super::*;

    fn in_parts(coordinates: [f64; 4]) -> f64 {
        let words = coordinates.iter().rev().map(|&x| lattice_word(x));
        hash_number(words.fold(0, |inner, word| hash_words(word, inner)))
    }

    #[test]
    fn parts_make_the_hash() {
        let mut all = vec![f64::NAN, f64::INFINITY, f64::MAX, 1e39, 3.4e38, 1e-310, 0.0];
        let edge = 2_147_483_648.0_f64;
        for x in [
            0.5,
            1.0,
            2.0,
            1e3,
            1e9,
            edge,
            edge - 1.0,
            edge - 2.0,
            2.0 * edge,
            1e12,
            1e30,
        ] {
            all.extend([x, x.next_up(), x.next_down(), x + 0.5]);
        }
        let signed: Vec<f64> = all.into_iter().flat_map(|x| [x, -x]).collect();
        for (k, &x) in signed.iter().enumerate() {
            for (l, &y) in signed.iter().enumerate() {
                let at = [x, y, (k * l) as f64, -(l as f64) / 4.0];
                for at in [at, [at[3], at[2], at[1], at[0]]] {
                    let (expected, actual) = (hash(&at), in_parts(at));
                    assert_eq!(
                        actual.to_bits(),
                        expected.to_bits(),
                        "{at:?}: {actual}, not {expected}"
                    );
                }
            }
        }
    }
}
