// Exact steps, first part: sums whose roundings are hidden from a shader compiler that reassociates and contracts.

/// A zero that no compiler can see: an odd square is 1 modulo 8, so bit 2 of it is never set. Xor with it hides where
/// a value comes from, so that no algebra reaches across.
fn hidden_zero(seed: f32) -> u32 {
    let odd = bitcast<u32>(seed) | 1u;
    return (odd * odd) & 4u;
}

/// v itself, cut off from the expression that gave it.
fn opaque(v: f32, zero: u32) -> f32 {
    return bitcast<f32>(bitcast<u32>(v) ^ zero);
}

/// a + b exactly where a is zero or |a| ≥ |b| (Dekker, Numer. Math. 18, 1971).
fn quick_two_sum(a: f32, b: f32, zero: u32) -> vec2f {
    let s = opaque(a + b, zero);
    let t = opaque(s - a, zero);
    return vec2f(s, opaque(b - t, zero));
}

/// a + b exactly, as rounded sum and its error: sorted, for that is three steps less to hide than Knuth's sum has.
fn two_sum(a: f32, b: f32, zero: u32) -> vec2f {
    let ordered = abs(a) >= abs(b);
    return quick_two_sum(select(b, a, ordered), select(a, b, ordered), zero);
}
