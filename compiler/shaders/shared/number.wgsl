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

// Whether a sum of squares is between 2^-90 and 2^100: then no square that counts in it has overflowed or underflowed.
// One comparison of integers, false for 0, infinity and NaN, too.
fn is_moderate(square: f32) -> bool {
    return (bitcast<u32>(square) - 0x12800000u) < 0x5f000000u;
}

// Euclidean length without overflow or underflow; infinite where a component is. No NaN may come in.
fn length2_safe(v: vec2f) -> f32 {
    let square = dot(v, v);
    if is_moderate(square) {
        return sqrt(square);
    }
    return scaled_length(vec3f(v, 0.0));
}

// Length of a gradient, at most 1e37; -1 where it is not known (NaN).
fn gradient_length(v: vec2f) -> f32 {
    let square = dot(v, v);
    if is_moderate(square) {
        return sqrt(square);
    }
    if is_nan(v.x) || is_nan(v.y) {
        return -1.0;
    }
    return min(length2_safe(v), 1e37);
}

fn length3_safe(v: vec3f) -> f32 {
    let square = dot(v, v);
    if is_moderate(square) {
        return sqrt(square);
    }
    return scaled_length(v);
}

// The length of a vector of any size, in units of its greatest component.
fn scaled_length(v: vec3f) -> f32 {
    let size = max(abs(v.x), max(abs(v.y), abs(v.z)));
    if size == 0.0 || is_inf(size) {
        return size;
    }
    return size * length(v / size);
}

// Unit vector along `v`, or `fallback` where `v` has no direction (zero, infinite or NaN components).
fn direction_or(v: vec3f, fallback: vec3f) -> vec3f {
    let square = dot(v, v);
    if is_moderate(square) {
        return v * inverseSqrt(square);
    }
    return scaled_direction(v, fallback);
}

// The direction of a vector of any size, by way of one of about 1.
fn scaled_direction(v: vec3f, fallback: vec3f) -> vec3f {
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
