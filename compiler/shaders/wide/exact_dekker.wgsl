// Exact steps, second part: products by halves.

/// The upper 12 bits of the significand of x: products of two such are exact, and so is x minus it.
fn exact_upper_half(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) & 0xfffff000u);
}

/// a b exactly, as rounded product and its error, where |a b| ≥ 2^-102 (Dekker 1971; split by masking). Halves have 12
/// bits, so each partial product is exact, and a driver that fuses it with the sum rounds no otherwise.
fn two_product(a: f32, b: f32, zero: u32) -> vec2f {
    let p = opaque(a * b, zero);
    let ah = exact_upper_half(a);
    let bh = exact_upper_half(b);
    let al = opaque(a - ah, zero);
    let bl = opaque(b - bh, zero);
    let e = opaque(ah * bh - p, zero);
    let f = opaque(e + ah * bl, zero);
    let g = opaque(f + al * bh, zero);
    return vec2f(p, opaque(g + al * bl, zero));
}
