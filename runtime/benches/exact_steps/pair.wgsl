// Arithmetic of pairs as the library does it (M. Joldes, J.-M. Muller, V. Popescu, "Tight and rigorous error bounds for
// basic building blocks of double-word arithmetic", ACM TOMS 44, 2017: AccurateDWPlusDW, DWTimesDW1).

alias real = vec2f;
fn from_f32(x: f32) -> real { return vec2f(x, 0.0); }
fn to_pair(x: real) -> vec2f { return x; }
fn plus(a: real, b: real) -> real {
    let zero = hidden_zero(a.x);
    let s = two_sum(a.x, b.x, zero);
    let t = two_sum(a.y, b.y, zero);
    let v = quick_two_sum(s.x, opaque(s.y + t.x, zero), zero);
    return quick_two_sum(v.x, opaque(t.y + v.y, zero), zero);
}
fn minus(a: real, b: real) -> real { return plus(a, -b); }
fn times(a: real, b: real) -> real {
    let zero = hidden_zero(a.x);
    let p = two_product(a.x, b.x, zero);
    return quick_two_sum(p.x, opaque(p.y + (a.x * b.y + a.y * b.x), zero), zero);
}
