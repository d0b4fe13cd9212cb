// Slopes: derivatives of the inverse functions and of lengths, and the reciprocals of the waves.

/// 1/(1 + x²). Error: 2 ulp.
fn real_atan_slope(x: f32) -> f32 {
    return 1.0 / (1.0 + x * x);
}

/// 1/(1 - x²). Error: 2 ulp.
fn real_atanh_slope(x: f32) -> f32 {
    return 1.0 / ((1.0 - x) * (1.0 + x));
}

/// 1/√(1 - x²). Error: 2 ulp.
fn real_asin_slope(x: f32) -> f32 {
    return 1.0 / sqrt((1.0 - x) * (1.0 + x));
}

/// 1/√(1 + x²). Error: 2 ulp.
fn real_asinh_slope(x: f32) -> f32 {
    return 1.0 / real_hypot(1.0, x);
}

/// 1/√(x² - 1), NaN below 1. Error: 3 ulp.
fn real_acosh_slope(x: f32) -> f32 {
    return 1.0 / (sqrt(x - 1.0) * sqrt(x + 1.0));
}

/// x/r for a coordinate x of a point at the distance r from the origin, and 0 there.
fn real_direction(x: f32, y: f32, r: f32) -> f32 {
    return select(x / r, 0.0, r == 0.0);
}

/// x/r in space.
fn real_direction3(x: f32, y: f32, z: f32, r: f32) -> f32 {
    return select(x / r, 0.0, r == 0.0);
}

/// 1/(1 + z²) by factors, which do not overflow. Error: 5 ulp of the norm.
fn complex_atan_slope(z: vec2f) -> vec2f {
    return complex_atanh_slope(complex_mul_i(z));
}

/// 1/(1 - z²). Error: 5 ulp of the norm.
fn complex_atanh_slope(z: vec2f) -> vec2f {
    return complex_mul(complex_inverse(vec2f(1.0 - z.x, -z.y)), complex_inverse(vec2f(1.0 + z.x, z.y)));
}

/// 1/(√(1 - z) √(1 + z)). Error: 4 ulp of the norm.
fn complex_asin_slope(z: vec2f) -> vec2f {
    let below = vec2f(1.0 - z.x, flip_sign(z.y, 0x80000000u));
    return complex_inverse(complex_mul(complex_sqrt(below), complex_sqrt(vec2f(1.0 + z.x, z.y))));
}

/// 1/(√(1 + i z) √(1 - i z)). Error: 4 ulp of the norm.
fn complex_asinh_slope(z: vec2f) -> vec2f {
    return complex_asin_slope(complex_mul_i(z));
}

/// 1/(√(z - 1) √(z + 1)). Error: 4 ulp of the norm.
fn complex_acosh_slope(z: vec2f) -> vec2f {
    return complex_inverse(complex_mul(complex_sqrt(vec2f(z.x - 1.0, z.y)), complex_sqrt(vec2f(z.x + 1.0, z.y))));
}

/// 1/cos x. Error: 2.5 ulp.
fn real_sec(x: f32) -> f32 {
    return 1.0 / real_cos(x);
}

/// 1/sin x. Error: 2.5 ulp.
fn real_csc(x: f32) -> f32 {
    return 1.0 / real_sin(x);
}

/// 1/cosh x. Error: 2.5 ulp.
fn real_sech(x: f32) -> f32 {
    return 1.0 / real_cosh(x);
}

/// 1/sinh x. Error: 2.5 ulp.
fn real_csch(x: f32) -> f32 {
    return 1.0 / real_sinh(x);
}

/// 1/cos z. Error: 5 ulp of the norm.
fn complex_sec(z: vec2f) -> vec2f {
    return complex_inverse(complex_cos(z));
}

/// 1/sin z. Error: 5 ulp of the norm.
fn complex_csc(z: vec2f) -> vec2f {
    return complex_inverse(complex_sin(z));
}

/// 1/cosh z. Error: 5 ulp of the norm.
fn complex_sech(z: vec2f) -> vec2f {
    return complex_inverse(complex_cosh(z));
}

/// 1/sinh z. Error: 5 ulp of the norm.
fn complex_csch(z: vec2f) -> vec2f {
    return complex_inverse(complex_sinh(z));
}
