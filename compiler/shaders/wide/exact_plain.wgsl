// Exact steps, first part: sums with nothing hidden, for modules whose every floating-point instruction is decorated
// with SPIR-V's NoContraction before they are loaded. Without the decoration the steps are wrong.

/// The zero that other forms of the steps hide with.
fn hidden_zero(seed: f32) -> u32 {
    return 0u;
}

/// v itself.
fn opaque(v: f32, zero: u32) -> f32 {
    return v;
}

/// a + b exactly where a is zero or |a| ≥ |b| (Dekker, Numer. Math. 18, 1971).
fn quick_two_sum(a: f32, b: f32, zero: u32) -> vec2f {
    let s = a + b;
    return vec2f(s, b - (s - a));
}

/// a + b exactly, as rounded sum and its error (Knuth, TAOCP 2, 4.2.2, theorem B).
fn two_sum(a: f32, b: f32, zero: u32) -> vec2f {
    let s = a + b;
    let t = s - a;
    return vec2f(s, (a - (s - t)) + (b - t));
}
