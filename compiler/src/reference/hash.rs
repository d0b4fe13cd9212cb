//! Hashing of lattice points.

/// A permutation of 32-bit words: one step and the output function of PCG-RXS-M-XS-32 (O'Neill, PCG: A Family of
/// Simple Fast Space-Efficient Statistically Good Algorithms for Random Number Generation, 2014).
fn word(v: u32) -> u32 {
    let state = v.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// The word of a coordinate: ⌊x⌋ in two's complement below 2³¹, the bits of the float32 x from there on; nothing
/// for what is not finite as a float32.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the two's complement is meant, and the nearest float32"
)]
fn coordinate(x: f64) -> Option<u32> {
    // ⌊x⌋ by conversions, which are faster than `floor` where that is no instruction
    if (-2_147_483_647.0..2_147_483_648.0).contains(&x) {
        let cut = x as i32;
        return Some((cut - i32::from(f64::from(cut) > x)) as u32);
    }
    let narrow = x as f32;
    narrow.is_finite().then_some(narrow.to_bits())
}

/// [0, 1) from a lattice point, a multiple of 2⁻²⁴; coordinates are rounded down. NaN where one is infinite or NaN.
/// The words are nested, the last innermost (Jarzynski and Olano, Hash Functions for GPU Rendering, Journal of
/// Computer Graphics Techniques 9 (3), 2020).
pub fn hash(coordinates: &[f64]) -> f64 {
    let nested = coordinates.iter().rev().try_fold(0, |inner: u32, &x| {
        Some(word(coordinate(x)?.wrapping_add(inner)))
    });
    nested.map_or(f64::NAN, |word| f64::from(word >> 8) / 16_777_216.0)
}
