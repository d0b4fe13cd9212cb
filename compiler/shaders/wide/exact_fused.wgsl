// Exact steps, second part: products by `fma`, where the adapter rounds that once.

/// a b exactly, as rounded product and its error, where |a b| ≥ 2^-102.
fn two_product(a: f32, b: f32, zero: u32) -> vec2f {
    let p = opaque(a * b, zero);
    return vec2f(p, opaque(fma(a, b, -p), zero));
}
