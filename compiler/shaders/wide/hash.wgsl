// Hashing of lattice points. Integers only, so that every adapter has the bits of the reference.

/// A permutation of 32-bit words: one step and the output function of PCG-RXS-M-XS-32 (O'Neill, PCG: A Family of Simple
/// Fast Space-Efficient Statistically Good Algorithms for Random Number Generation, 2014).
fn hash_word(v: u32) -> u32 {
    let state = v * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

/// The word of a coordinate: ⌊x⌋ in two's complement below 2^31, the bits of the nearest f32 from there on.
fn hash_coordinate(x: real) -> u32 {
    let nearest = bitcast<u32>(real_to_f32(x));
    let whole = real_floor(x);
    if !real_less(real_abs(whole), num(2147483648.0)) {
        return nearest;
    }
    if sign_is_set(x) && !is_zero(x) && (nearest & 0x7fffffffu) < 0x00800000u {
        return 0xffffffffu; // a negative subnormal may count as 0 for floor
    }
    // in two halves, each exact as f32
    let high = real_floor(mul32(whole, 1.52587890625e-5));
    let low = real_sub(whole, mul32(high, 65536.0));
    return (bitcast<u32>(i32(real_to_f32(high))) << 16u) + u32(real_to_f32(low));
}

/// [0, 1) from a lattice point, a multiple of 2^-24; coordinates are rounded down. NaN where one is infinite or NaN as
/// f32. The words are nested, the last innermost, so that neighbours along x share most of the work (Jarzynski and
/// Olano, Hash Functions for GPU Rendering, Journal of Computer Graphics Techniques 9 (3), 2020).
/// Error: none.
fn real_hash(x: real, y: real, z: real, w: real) -> real {
    if !(is_hashable(x) && is_hashable(y) && is_hashable(z) && is_hashable(w)) {
        return make_nan(x);
    }
    let inner = hash_word(hash_coordinate(z) + hash_word(hash_coordinate(w)));
    let word = hash_word(hash_coordinate(x) + hash_word(hash_coordinate(y) + inner));
    return real_from_f32(f32(word >> 8u) * 5.9604644775390625e-8);
}

/// Whether x is finite as f32.
fn is_hashable(x: real) -> bool {
    return is_finite(x) && (bitcast<u32>(real_to_f32(x)) & 0x7fffffffu) < 0x7f800000u;
}
