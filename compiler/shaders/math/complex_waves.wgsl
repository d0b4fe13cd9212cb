// Complex trigonometric and hyperbolic functions and their inverses. The trigonometric ones are the hyperbolic ones
// turned by i, as C99 Annex G specifies them.

/// (sinh x, cosh x) / 2^n and n, so that products with them overflow only where they must.
struct ScaledWaves {
    sinh: f32,
    cosh: f32,
    exponent: i32,
}

fn scaled_sinhcosh(x: f32) -> ScaledWaves {
    let a = magnitude(x);
    if a < 20.0 || is_nan(x) {
        let w = real_sinhcosh(x);
        return ScaledWaves(w.x, w.y, 0);
    }
    let s = split_exponent(min(a, 240.0));
    let e = 0.5 + 0.5 * expm1_polynomial(s.x);
    return ScaledWaves(flip_sign(e, sign_bit(x)), e, i32(s.y));
}

/// sinh z = sinh x cos y + i cosh x sin y (C99 G.6.2.5).
/// Error: 3.5 ulp each component.
fn complex_sinh(z: vec2f) -> vec2f {
    if magnitude(z.y) == 0.0 {
        return vec2f(real_sinh(z.x), z.y);
    }
    if !is_finite(z.y) {
        let keep = magnitude(z.x) == 0.0 || is_infinite(z.x);
        return vec2f(select(make_nan(z.x), z.x, keep), make_nan(z.y));
    }
    let wave = real_sincos(z.y);
    if is_infinite(z.x) {
        return vec2f(flip_sign(z.x, sign_bit(wave.y)), make_infinity(wave.x));
    }
    let h = scaled_sinhcosh(z.x);
    let re = times_wide_power_of_two(magnitude(h.sinh) * magnitude(wave.y), h.exponent);
    return vec2f(flip_sign(re, sign_bit(z.x) ^ sign_bit(wave.y)), times_wide_power_of_two(h.cosh * wave.x, h.exponent));
}

/// cosh z = cosh x cos y + i sinh x sin y (C99 G.6.2.4).
/// Error: 3.5 ulp each component.
fn complex_cosh(z: vec2f) -> vec2f {
    if magnitude(z.y) == 0.0 {
        return vec2f(real_cosh(z.x), flip_sign(z.y, sign_bit(z.x)));
    }
    if !is_finite(z.y) {
        if magnitude(z.x) == 0.0 {
            return vec2f(make_nan(z.y), z.x);
        }
        return vec2f(select(make_nan(z.x), magnitude(z.x), is_infinite(z.x)), make_nan(z.y));
    }
    let wave = real_sincos(z.y);
    if is_infinite(z.x) {
        return vec2f(make_infinity(wave.y), flip_sign(z.x, sign_bit(wave.x)));
    }
    let h = scaled_sinhcosh(z.x);
    let im = times_wide_power_of_two(magnitude(h.sinh) * magnitude(wave.x), h.exponent);
    return vec2f(times_wide_power_of_two(h.cosh * wave.y, h.exponent), flip_sign(im, sign_bit(z.x) ^ sign_bit(wave.x)));
}

/// sin z = -i sinh(i z).
/// Error: 3.5 ulp each component.
fn complex_sin(z: vec2f) -> vec2f {
    return complex_div_i(complex_sinh(complex_mul_i(z)));
}

/// cos z = cosh(i z).
/// Error: 3.5 ulp each component.
fn complex_cos(z: vec2f) -> vec2f {
    return complex_cosh(complex_mul_i(z));
}

/// log |2 z| for a large, possibly infinite z.
fn log_twice(z: vec2f) -> f32 {
    return log_hypot(z.x, z.y) + 0.6931472;
}

/// arcsin z and arccos z for z without NaN: (Re arcsin, Re arccos, |Im| of both).
/// Kahan, "Branch Cuts for Complex Elementary Functions" (1987): each component of the products of √(1 - z) and
/// √(1 + z) is a sum of terms of one sign, so nothing cancels.
fn complex_arc(z: vec2f) -> vec3f {
    let a = magnitude(z.x);
    let b = magnitude(z.y);
    if max(a, b) > 1e9 {
        return vec3f(real_atan2(z.x, b), real_atan2(b, z.x), log_twice(z));
    }
    // in the upper half plane
    let minus = complex_sqrt(vec2f(1.0 - z.x, flip_sign(b, 0x80000000u)));
    let plus = complex_sqrt(vec2f(1.0 + z.x, b));
    let cross = magnitude(minus.x * plus.y) + magnitude(minus.y * plus.x);
    return vec3f(
        real_atan2(z.x, minus.x * plus.x + magnitude(minus.y * plus.y)),
        2.0 * real_atan2(minus.x, plus.x),
        real_asinh(cross),
    );
}

/// arsinh z where a component is NaN (C99 G.6.2.2).
fn asinh_of_nan(z: vec2f) -> vec2f {
    if is_infinite(z.x) || magnitude(z.y) == 0.0 {
        return z;
    }
    return vec2f(select(make_nan(z.x), make_infinity(z.x), is_infinite(z.y)), make_nan(z.y));
}

/// arcsin z, cuts on the real axis outside [-1, 1].
/// Error: 4.5 ulp each component.
fn complex_asin(z: vec2f) -> vec2f {
    if complex_has_nan(z) {
        return complex_div_i(asinh_of_nan(complex_mul_i(z)));
    }
    let r = complex_arc(z);
    return vec2f(r.x, with_sign(r.z, z.y));
}

/// arccos z, cuts on the real axis outside [-1, 1].
/// Error: 4.2 ulp each component.
fn complex_acos(z: vec2f) -> vec2f {
    if complex_has_nan(z) {
        let re = select(make_nan(z.x), 1.5707964, magnitude(z.x) == 0.0);
        let im = select(make_nan(z.y), make_infinity(-z.y), complex_is_infinite(z));
        return vec2f(re, im);
    }
    let r = complex_arc(z);
    return vec2f(r.y, flip_sign(r.z, sign_bit(z.y) ^ 0x80000000u));
}

/// arsinh z = -i arcsin(i z), cuts on the imaginary axis outside [-i, i].
/// Error: 4.5 ulp each component.
fn complex_asinh(z: vec2f) -> vec2f {
    if complex_has_nan(z) {
        return asinh_of_nan(z);
    }
    return complex_div_i(complex_asin(complex_mul_i(z)));
}

/// arcosh z, cut on the real axis below 1; the real part is never negative.
/// Error: 4.2 ulp each component.
fn complex_acosh(z: vec2f) -> vec2f {
    let w = complex_acos(z);
    return vec2f(magnitude(w.y), with_sign(w.x, z.y));
}

/// artanh z, cuts on the real axis outside [-1, 1] (Kahan 1987).
/// Error: 3.6 ulp each component.
fn complex_atanh(z: vec2f) -> vec2f {
    let a = magnitude(z.x);
    let b = magnitude(z.y);
    if complex_has_nan(z) {
        if is_infinite(z.y) {
            return vec2f(with_sign(0.0, z.x), with_sign(1.5707964, z.y));
        }
        if is_infinite(z.x) || a == 0.0 {
            return vec2f(with_sign(0.0, z.x), make_nan(z.y));
        }
        return vec2f(make_nan(z.x), make_nan(z.y));
    }
    if max(a, b) > 1e9 { // 1/z + O(z^-3)
        let re = magnitude(complex_inverse(vec2f(a, b)).x);
        return vec2f(with_sign(re, z.x), with_sign(1.5707964, z.y));
    }
    if a == 1.0 && b < 1e-18 {
        let re = select(0.5 * (0.6931472 - real_log(b)), make_infinity(1.0), b == 0.0);
        return vec2f(with_sign(re, z.x), with_sign(select(0.7853982, 0.0, b == 0.0), z.y));
    }
    let d = 1.0 - a;
    let re = 0.25 * real_log1p(4.0 * a / (d * d + b * b));
    let im = 0.5 * real_atan2(2.0 * b, d * (1.0 + a) - b * b);
    return vec2f(with_sign(re, z.x), with_sign(im, z.y));
}

/// arctan z = -i artanh(i z), cuts on the imaginary axis outside [-i, i].
/// Error: 3.5 ulp each component.
fn complex_atan(z: vec2f) -> vec2f {
    return complex_div_i(complex_atanh(complex_mul_i(z)));
}
