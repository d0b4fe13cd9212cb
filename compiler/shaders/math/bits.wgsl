// Floating-point numbers as bit patterns, and arithmetic that survives a shader compiler.
//
// Drivers reassociate, contract and assume that NaN does not occur. So NaN is tested for and made by bits, signs are
// moved by bits, and each rounding that a later step relies on is made opaque.
//
// The error bounds in these files are the largest of 3 million arguments and of the 60-digit tables in
// tests/data/oracle, rounded up: lavapipe (Mesa 22.3.6, LLVM 15), where division and square root are correctly rounded.
// Where they are not (an H100: 1 ulp) add one ulp to what divides. Subnormal arguments and results may count as 0.

/// A zero that no compiler can see: an odd square is 1 modulo 8, so bit 2 of it is never set. Xor with it hides where
/// a value comes from, so that no algebra reaches across. One multiplication; make it once and use it often.
fn hidden_zero(seed: f32) -> u32 {
    let odd = bitcast<u32>(seed) | 1u;
    return (odd * odd) & 4u;
}

/// The same of two numbers, one of which may be a constant of the formula, or both the same: of what a compiler knows, it
/// knows the zero, too.
fn hidden_zero_of(a: f32, b: f32) -> u32 {
    return hidden_zero(bitcast<f32>((bitcast<u32>(a) << 1u) ^ bitcast<u32>(b)));
}

/// v itself, cut off from the expression that gave it.
fn opaque(v: f32, zero: u32) -> f32 {
    return bitcast<f32>(bitcast<u32>(v) ^ zero);
}

/// v, which no driver may join with what follows: (a / b) / c computed as a / (b c) overflows early.
fn rounded(v: f32) -> f32 {
    return opaque(v, hidden_zero(v));
}

/// |x|, also of NaN.
fn magnitude(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) & 0x7fffffffu);
}

/// The sign bit of x.
fn sign_bit(x: f32) -> u32 {
    return bitcast<u32>(x) & 0x80000000u;
}

/// v with its sign flipped where `sign` has the sign bit.
fn flip_sign(v: f32, sign: u32) -> f32 {
    return bitcast<f32>(bitcast<u32>(v) ^ sign);
}

/// |v| with the sign of s.
fn with_sign(v: f32, s: f32) -> f32 {
    return bitcast<f32>((bitcast<u32>(v) & 0x7fffffffu) | (bitcast<u32>(s) & 0x80000000u));
}

/// Whether x is NaN, by its bits.
fn is_nan(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7fffffffu) > 0x7f800000u;
}

/// Whether x is infinite, by its bits.
fn is_infinite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7fffffffu) == 0x7f800000u;
}

/// Whether x is neither infinite nor NaN, by its bits.
fn is_finite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7fffffffu) < 0x7f800000u;
}

/// A quiet NaN, whatever the seed: a constant would be folded and rejected.
fn make_nan(seed: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(seed) | 0x7fc00000u);
}

/// The infinity with the sign of the seed.
fn make_infinity(seed: f32) -> f32 {
    return bitcast<f32>((bitcast<u32>(seed) & 0x80000000u) | 0x7f800000u);
}

/// 2^n for n in [-126, 127].
fn power_of_two(n: i32) -> f32 {
    return bitcast<f32>(u32(n + 127) << 23u);
}

/// v 2^n for a normal v of modest size and |n| ≤ 250: overflow and underflow happen once, at the end.
fn times_power_of_two(v: f32, n: i32) -> f32 {
    let first = clamp(n, -100, 100);
    let zero = hidden_zero(v);
    return opaque(v * power_of_two(first), zero) * power_of_two(clamp(n - first, -126, 127));
}

/// v 2^n for |v| ≤ 2, down to the least normal number, and |n| ≤ 360.
fn times_wide_power_of_two(v: f32, n: i32) -> f32 {
    let first = clamp(n, -120, 120);
    return times_power_of_two(opaque(v * power_of_two(first), hidden_zero(v)), n - first);
}

/// The upper 32 bits of a b.
fn multiply_high(a: u32, b: u32) -> u32 {
    let a0 = a & 0xffffu;
    let a1 = a >> 16u;
    let b0 = b & 0xffffu;
    let b1 = b >> 16u;
    let middle = a1 * b0 + ((a0 * b0) >> 16u);
    let other = a0 * b1 + (middle & 0xffffu);
    return a1 * b1 + (middle >> 16u) + (other >> 16u);
}

/// The upper 12 bits of the significand of x: products of two such are exact, and so is x minus it.
fn upper_half(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) & 0xfffff000u);
}

/// a + b exactly, as rounded sum and its error (Knuth, TAOCP 2, 4.2.2).
fn two_sum(a: f32, b: f32, zero: u32) -> vec2f {
    let s = opaque(a + b, zero);
    let t = opaque(s - a, zero);
    let u = opaque(s - t, zero);
    return vec2f(s, opaque(a - u, zero) + opaque(b - t, zero));
}

/// a + b as rounded sum and its error, exactly where |a| ≥ |b| (Dekker 1971).
fn fast_two_sum(a: f32, b: f32, zero: u32) -> vec2f {
    let s = opaque(a + b, zero);
    return vec2f(s, b - opaque(s - a, zero));
}

/// a b exactly, as rounded product and its error, where nothing underflows (Dekker 1971; split by masking).
fn two_product(a: f32, b: f32, zero: u32) -> vec2f {
    let p = opaque(a * b, zero);
    return vec2f(p, rest_by_halves(a, b, p, zero));
}

/// a b - p, where p is the rounded product: by `fma` where that rounds once. Where it is a product and a sum it gives 0, as it seldom does
/// elsewhere, and halves tell.
fn rest_of_product(a: f32, b: f32, p: f32, zero: u32) -> f32 {
    let rest = fma(a, b, -p);
    if rest == 0.0 {
        return rest_by_halves(a, b, p, zero);
    }
    return rest;
}

fn rest_by_halves(a: f32, b: f32, p: f32, zero: u32) -> f32 {
    let ah = upper_half(a);
    let bh = upper_half(b);
    let al = opaque(a - ah, zero);
    let bl = opaque(b - bh, zero);
    let e = opaque(opaque(ah * bh, zero) - p, zero);
    let f = opaque(e + opaque(ah * bl, zero), zero);
    let g = opaque(f + opaque(al * bh, zero), zero);
    return g + al * bl;
}
