// Two functions of one argument at the price of little more than one: a function and its derivative are often both
// wanted. Each result is that of the single function, bit for bit.

/// (sinh z, cosh z)
fn complex_sinhcosh(z: vec2f) -> vec4f {
    if magnitude(z.y) == 0.0 || !is_finite(z.y) || is_infinite(z.x) {
        return vec4f(complex_sinh(z), complex_cosh(z));
    }
    let wave = real_sincos(z.y);
    let h = scaled_sinhcosh(z.x);
    let re = times_power_of_two(magnitude(h.sinh) * magnitude(wave.y), h.exponent);
    let im = times_power_of_two(magnitude(h.sinh) * magnitude(wave.x), h.exponent);
    return vec4f(
        flip_sign(re, sign_bit(z.x) ^ sign_bit(wave.y)),
        times_power_of_two(h.cosh * wave.x, h.exponent),
        times_power_of_two(h.cosh * wave.y, h.exponent),
        flip_sign(im, sign_bit(z.x) ^ sign_bit(wave.x)),
    );
}

/// (sin z, cos z)
fn complex_sincos(z: vec2f) -> vec4f {
    let waves = complex_sinhcosh(complex_mul_i(z));
    return vec4f(complex_div_i(waves.xy), waves.zw);
}
