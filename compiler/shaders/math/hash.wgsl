// Hashing of lattice points. Integers only, so that every adapter has the bits of the reference.

/// A permutation of 32-bit words: one step and the output function of PCG-RXS-M-XS-32 (O'Neill, PCG: A Family of Simple
/// Fast Space-Efficient Statistically Good Algorithms for Random Number Generation, 2014).
fn hash_word(v: u32) -> u32 {
    let state = v * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

/// The word of a coordinate: ⌊x⌋ in two's complement below 2^31, the bits of x from there on.
fn hash_coordinate(x: f32) -> u32 {
    let bits = bitcast<u32>(x);
    let large = (bits & 0x7fffffffu) >= 0x4f000000u;
    let whole = bitcast<u32>(i32(select(floor(x), 0.0, large)));
    // a negative subnormal may count as 0 for floor
    let below = select(whole, 0xffffffffu, bits - 0x80000001u < 0x7fffffu);
    return select(below, bits, large);
}

/// [0, 1) from a lattice point, a multiple of 2^-24; coordinates are rounded down. NaN where one is infinite or NaN.
/// The words are nested, the last innermost, so that neighbours along x share most of the work (Jarzynski and Olano,
/// Hash Functions for GPU Rendering, Journal of Computer Graphics Techniques 9 (3), 2020).
/// Error: none.
fn real_hash(x: f32, y: f32, z: f32, w: f32) -> f32 {
    let inner = hash_word(hash_coordinate(z) + hash_word(hash_coordinate(w)));
    let word = hash_word(hash_coordinate(x) + hash_word(hash_coordinate(y) + inner));
    let value = f32(word >> 8u) * 5.9604645e-8;
    // without a branch, so that what neighbours share is computed once
    let finite = is_finite(x) & is_finite(y) & is_finite(z) & is_finite(w);
    return select(make_nan(x), value, finite);
}

/// Digits of the hashes at the eight corners of a cell of the lattice: on its lower and on its upper face across z the corners
/// (x, y), (x + 1, y), (x, y + 1) and (x + 1, y + 1).
struct LatticeCell {
    low: vec4f,
    high: vec4f,
}

/// ⌊2^(32 - shift) h⌋ for the hashes h at the corners of the cell from (x, y, z), whole numbers, to (x + 1, y + 1, z + 1), for
/// 8 ≤ shift < 32. NaN where a coordinate is infinite or NaN. What corners have in common is computed once.
/// Error: none.
fn lattice_cell(x: f32, y: f32, z: f32, w: f32, shift: u32) -> LatticeCell {
    let largest = max(max(bitcast<u32>(x) & 0x7fffffffu, bitcast<u32>(y) & 0x7fffffffu), bitcast<u32>(z) & 0x7fffffffu);
    // below 2^23 the next number is the next integer, too
    let near = (largest < 0x4b000000u) & is_finite(w);
    var x0 = bitcast<u32>(i32(x));
    var y0 = bitcast<u32>(i32(y));
    var z0 = bitcast<u32>(i32(z));
    var x1 = x0 + 1u;
    var y1 = y0 + 1u;
    var z1 = z0 + 1u;
    if !near {
        x0 = hash_coordinate(x);
        y0 = hash_coordinate(y);
        z0 = hash_coordinate(z);
        x1 = hash_coordinate(x + 1.0);
        y1 = hash_coordinate(y + 1.0);
        z1 = hash_coordinate(z + 1.0);
    }
    let inner = hash_word(hash_coordinate(w));
    let cell = LatticeCell(
        lattice_face(x0, x1, y0, y1, hash_word(z0 + inner), shift),
        lattice_face(x0, x1, y0, y1, hash_word(z1 + inner), shift),
    );
    if !near {
        if !(is_finite(x) && is_finite(y) && is_finite(z) && is_finite(w)) {
            let nan = vec4f(make_nan(x));
            return LatticeCell(nan, nan);
        }
    }
    return cell;
}

/// The face of a cell at a word of the coordinate across.
fn lattice_face(x0: u32, x1: u32, y0: u32, y1: u32, inner: u32, shift: u32) -> vec4f {
    let low = hash_word(y0 + inner);
    let high = hash_word(y1 + inner);
    return vec4f(
        f32(hash_word(x0 + low) >> shift),
        f32(hash_word(x1 + low) >> shift),
        f32(hash_word(x0 + high) >> shift),
        f32(hash_word(x1 + high) >> shift),
    );
}
