// Slopes: derivatives of the inverse functions and of lengths, and the reciprocals of the real waves.

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

/// x/r for r = hypot(x, y), and 0 at the origin. Error: 2.5 ulp.
fn real_direction(x: f32, y: f32, r: f32) -> f32 {
    return real_direction3(x, y, 0.0, r);
}

/// x/r for r = |(x, y, z)|, and 0 at the origin. Where r overflows, that of a quarter of the point. Error: 2.5 ulp.
fn real_direction3(x: f32, y: f32, z: f32, r: f32) -> f32 {
    if bitcast<u32>(r) - 1u < 0x7f7fffffu { // neither 0 nor infinite nor NaN, nor negative
        return x / r;
    }
    return direction3_at_ends(x, y, z, r);
}

/// `real_direction3` where r is 0, infinite or NaN. Error: 2.5 ulp.
fn direction3_at_ends(x: f32, y: f32, z: f32, r: f32) -> f32 {
    if is_infinite(r) && is_finite(x) && is_finite(y) && is_finite(z) {
        return 0.25 * x / scaled_hypot3(0.25 * x, 0.25 * y, 0.25 * z);
    }
    return select(x / r, 0.0, r == 0.0);
}

/// 1/(1 + z²). Error: 6 ulp of the norm.
fn complex_atan_slope(z: vec2f) -> vec2f {
    return complex_atanh_slope(complex_mul_i(z));
}

/// 1/(1 - z²), of z scaled by a power of two so that no square overflows; 1 - x² + y² is summed in pairs, so that each
/// component has its digits. Error: 6 ulp of the norm.
fn complex_atanh_slope(z: vec2f) -> vec2f {
    if complex_is_infinite(z) {
        return vec2f(0.0, 0.0);
    }
    let e = max(complex_exponent(z), 0);
    let zero = hidden_zero(z.x);
    let v = z * power_of_two(-e);
    let one = select(0.0, power_of_two(-2 * min(e, 63)), e < 64);
    let xx = two_product(v.x, v.x, zero);
    let yy = two_product(v.y, v.y, zero);
    let s = two_sum(yy.x, -xx.x, zero);
    let t = two_sum(s.x, one, zero);
    let re = t.x + ((t.y + s.y) + (yy.y - xx.y));
    let inverse = complex_inverse(vec2f(re, -2.0 * v.x * v.y));
    return vec2f(times_wide_power_of_two(inverse.x, -2 * e), times_wide_power_of_two(inverse.y, -2 * e));
}

/// x y / v by a quotient that does not overflow where v is more than a trifle of `other`; else `other`, which then has
/// not cancelled.
fn part_of_root(x: f32, y: f32, v: f32, other: f32) -> f32 {
    return select(other, x / v * y, magnitude(v) > 1e-9 * magnitude(other));
}

/// 1/(√(1 - z) √(1 + z)). Of the product s one component is a sum of terms of one sign, and the other follows from
/// s² = 1 - z². Error: 6 ulp of the norm.
fn complex_asin_slope(z: vec2f) -> vec2f {
    let below = complex_sqrt(vec2f(1.0 - z.x, flip_sign(z.y, 0x80000000u)));
    let above = complex_sqrt(vec2f(1.0 + z.x, z.y));
    let re = below.x * above.x + magnitude(below.y * above.y);
    let im = below.x * above.y + below.y * above.x;
    return complex_inverse(vec2f(re, part_of_root(-z.x, z.y, re, im)));
}

/// 1/(√(1 + i z) √(1 - i z)). Error: 6 ulp of the norm.
fn complex_asinh_slope(z: vec2f) -> vec2f {
    return complex_asin_slope(complex_mul_i(z));
}

/// 1/(√(z - 1) √(z + 1)), likewise. Error: 6 ulp of the norm.
fn complex_acosh_slope(z: vec2f) -> vec2f {
    let below = complex_sqrt(vec2f(z.x - 1.0, z.y));
    let above = complex_sqrt(vec2f(z.x + 1.0, z.y));
    let re = below.x * above.x - below.y * above.y;
    let im = below.x * above.y + below.y * above.x;
    return complex_inverse(vec2f(part_of_root(z.x, z.y, im, re), im));
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
