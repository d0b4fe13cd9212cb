// Waves and exponentials divided by their argument: 1 at 0, and finite as long as the quotient is.

/// sinh x / x, 1 at 0; beyond 12 from e^x / 2, scaled down before the division.
/// Error: 2.4 ulp.
fn real_sinhc(x: f32) -> f32 {
    let a = magnitude(x);
    if a < 1.0 {
        let z = a * a;
        return 1.0 + z * (0.16666667 + z * (0.00833335 + z * (0.0001983616 + z * 2.816952e-06)));
    }
    if a > FAR_OUT {
        return select(times_power_of_two(exp_scaled(a, -24) / a, 23), a, is_infinite(a));
    }
    return select(hyperbolic_pair(a).sine.x / a, a, is_nan(a));
}

/// (e^x - 1)/x, 1 at 0, 0 at -∞: near 0 the polynomial of `expm1_polynomial`; beyond 20 from e^x, scaled down before the
/// division.
/// Error: 1.9 ulp.
fn real_exprel(x: f32) -> f32 {
    if magnitude(x) < 0.34 {
        return 1.0 + x * (0.5 + x * (0.16666667 + x * (0.041666325 + x * (0.008333219 + x * (
            0.001394331 + x * 0.0001996244)))));
    }
    if x > 20.0 {
        return select(times_power_of_two(exp_scaled(x, -24) / x, 24), x, is_infinite(x));
    }
    return real_expm1(x) / x;
}

/// sinh z / z = sinh z z̄ / |z|², both of them scaled, so that nothing overflows before the quotient does.
/// Error: 4 ulp of the norm.
fn complex_sinhc(z: vec2f) -> vec2f {
    if magnitude(z.y) == 0.0 {
        return vec2f(real_sinhc(z.x), flip_sign(z.y, sign_bit(z.x)));
    }
    if magnitude(z.x) == 0.0 {
        return vec2f(real_sinc(z.y), flip_sign(z.x, sinc_turns(z.y)));
    }
    if is_infinite(z.x) {
        return complex_sinh(vec2f(magnitude(z.x), flip_sign(z.y, sign_bit(z.x))));
    }
    if max(magnitude(z.x), magnitude(z.y)) < 1e-3 {
        return vec2f(1.0 + (z.x - z.y) * (z.x + z.y) / 6.0, z.x * z.y / 3.0);
    }
    let w = scaled_sinh(z);
    let e = complex_exponent(z);
    let b = z * power_of_two(-e);
    let inverse = inverse_norm(vec2f(b.x, 0.0), vec2f(b.y, 0.0));
    let re = sum_of_products(w.sinh.x, b.x, w.sinh.y, b.y);
    let im = sum_of_products(w.sinh.y, b.x, -w.sinh.x, b.y);
    let n = w.exponent - e;
    return vec2f(
        times_wide_power_of_two(re * inverse.x + re * inverse.y, n),
        times_wide_power_of_two(im * inverse.x + im * inverse.y, n),
    );
}

/// e^z/z where that overflows: an infinity in each part.
fn overflowed_quotient(z: vec2f) -> vec2f {
    let wave = real_sincos(z.y);
    let w = z * (1.0 / max(magnitude(z.x), magnitude(z.y)));
    return make_infinity(1.0) * vec2f(wave.y * w.x + wave.x * w.y, wave.x * w.x - wave.y * w.y);
}

/// The sign bit of -sinc' y.
fn sinc_turns(y: f32) -> u32 {
    let falls = magnitude(y) < 1.0 || real_cos(y) < real_sinc(y);
    return select(0x80000000u, 0u, falls) ^ sign_bit(y);
}

/// sin z / z = sinh(i z) / (i z).
/// Error: 4 ulp of the norm.
fn complex_sinc(z: vec2f) -> vec2f {
    return complex_sinhc(complex_mul_i(z));
}

/// (e^z - 1)/z. Far out e^(z/2) (e^(z/2)/z).
/// Error: 6 ulp of the norm.
fn complex_exprel(z: vec2f) -> vec2f {
    if magnitude(z.y) == 0.0 {
        return vec2f(real_exprel(z.x), z.y);
    }
    if is_infinite(z.x) && z.x > 0.0 {
        return complex_exp(z);
    }
    if max(magnitude(z.x), magnitude(z.y)) < 1e-9 {
        return vec2f(1.0, 0.5 * z.y);
    }
    if z.x > 80.0 {
        let half = complex_exp(0.5 * z);
        if complex_is_infinite(half) {
            return overflowed_quotient(z);
        }
        return complex_mul(half, complex_div(half, z));
    }
    return complex_div(complex_expm1(z), z);
}
