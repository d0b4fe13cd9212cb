// Tests and lengths that hold for every f32. Compilers may assume that no NaN exists, so the tests read bits.

fn is_nan(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7fffffffu) > 0x7f800000u;
}

fn is_inf(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7fffffffu) == 0x7f800000u;
}

fn is_finite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7f800000u) != 0x7f800000u;
}

// Whether a sum of squares is so far from the ends of the range, 1e-30 to 1e37, that nothing in it was lost. Bits, which
// tell NaN too.
fn is_moderate(squared: f32) -> bool {
    return bitcast<u32>(squared) - 0x0da24260u < 0x6f4e7b62u;
}

// Euclidean length without overflow or underflow; infinite where a component is. No NaN may come in. Squares are of
// v over its largest component only where they would leave the range.
fn length2_safe(v: vec2f) -> f32 {
    let squared = dot(v, v);
    if is_moderate(squared) {
        return sqrt(squared);
    }
    let size = max(abs(v.x), abs(v.y));
    if size == 0.0 || is_inf(size) {
        return size;
    }
    return size * length(v / size);
}

// Length of a gradient, at most 1e37; -1 where it is not known (NaN).
fn gradient_length(v: vec2f) -> f32 {
    let squared = dot(v, v);
    if is_moderate(squared) {
        return sqrt(squared);
    }
    if is_nan(v.x) || is_nan(v.y) {
        return -1.0;
    }
    return min(length2_safe(v), 1e37);
}

fn length3_safe(v: vec3f) -> f32 {
    let size = max(abs(v.x), max(abs(v.y), abs(v.z)));
    if size == 0.0 || is_inf(size) {
        return size;
    }
    return size * length(v / size);
}

// Unit vector along `v`, or `fallback` where `v` has no direction (zero, infinite or NaN components).
fn direction_or(v: vec3f, fallback: vec3f) -> vec3f {
    let finite = is_finite(v.x) && is_finite(v.y) && is_finite(v.z);
    let size = max(abs(v.x), max(abs(v.y), abs(v.z)));
    if !finite || size == 0.0 {
        return fallback;
    }
    return normalize(v / size);
}

// x · 2^64 for |x| < 2^-60. Subnormals are taken apart as integers, because devices may read them as 0.
fn magnify_tiny(x: f32) -> f32 {
    let bits = bitcast<u32>(x);
    if (bits & 0x7f800000u) != 0u {
        return x * 1.8446744073709552e19;
    }
    let size = f32(bits & 0x007fffffu) * 2.5849394142282115e-26;
    return select(size, -size, (bits & 0x80000000u) != 0u);
}
