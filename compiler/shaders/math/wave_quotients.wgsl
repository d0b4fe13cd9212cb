// Tangents and reciprocals of the complex waves: quotients of products of real waves by |cosh z|² or |sinh z|², in which nothing
// cancels (after Kahan 1987). Their many roundings would add up to 8 ulp, so each real wave is carried with what its
// rounding leaves, and the inverse of the norm is corrected by its residual.

/// A sine and a cosine, circular or hyperbolic, as rounded numbers and what is left of them (to 2^-26).
struct WavePair {
    sine: vec2f,
    cosine: vec2f,
}

/// The moduli of a sine and a cosine, and their signs.
struct SignedWaves {
    size: WavePair,
    sine_sign: u32,
    cosine_sign: u32,
}

fn flip_pair(p: vec2f, sign: u32) -> vec2f {
    return vec2f(flip_sign(p.x, sign), flip_sign(p.y, sign));
}

/// The circular pair of finite y, by the polynomials of `real_sincos`, whose leading terms are kept apart.
fn circular_pair(y: f32) -> SignedWaves {
    let zero = hidden_zero(y);
    let turns = quarter_turns(magnitude(y));
    let r = turns.rest;
    let z = opaque(r * r, zero);
    let s = fast_two_sum(r, r * z * (-0.16666655 + z * (0.008332158 + z * -0.00019514958)) + turns.low * (1.0 - 0.5 * z), zero);
    let lead = fast_two_sum(1.0, -0.5 * z, zero);
    let tail = z * z * (0.041666646 + z * (-0.0013887365 + z * 2.4438128e-05)) - r * turns.low;
    let c = fast_two_sum(lead.x, lead.y + tail, zero);
    let odd = (turns.count & 1u) == 1u;
    let sine = select(s, c, odd);
    let cosine = select(c, s, odd);
    let half_turn = (turns.count & 2u) << 30u;
    let turn = ((turns.count + 1u) & 2u) << 30u;
    let sine_sign = sign_bit(sine.x);
    let cosine_sign = sign_bit(cosine.x);
    return SignedWaves(
        WavePair(flip_pair(sine, sine_sign), flip_pair(cosine, cosine_sign)),
        sine_sign ^ half_turn ^ sign_bit(y),
        cosine_sign ^ turn,
    );
}

/// The hyperbolic pair for 0 ≤ a ≤ 12: polynomials below 1 (coefficients.py, sinh and cosh), (e^a ± e^-a)/2 beyond.
fn hyperbolic_pair(a: f32) -> WavePair {
    let zero = hidden_zero(a);
    let t = min(a, 1.0);
    let z = opaque(t * t, zero);
    let near_sine = fast_two_sum(t, t * z * (0.16666667 + z * (0.00833335 + z * (0.0001983616 + z * 2.816952e-06))), zero);
    let lead = fast_two_sum(1.0, 0.5 * z, zero);
    let tail = z * z * (0.041666746 + z * (0.0013884959 + z * 2.539039e-05));
    let near_cosine = fast_two_sum(lead.x, lead.y + tail, zero);
    // e^a/2 = 2^(n - 1) (1 + r + r² P(r)), r in two floats
    let n = floor(a * 1.442695 + 0.5);
    let u = opaque(a - n * 0.693145751953125, zero);
    let r = fast_two_sum(u, opaque(n * -1.428606765330187e-06, zero), zero);
    let one = fast_two_sum(1.0, r.x, zero);
    let rest = r.x * r.x * (0.5 + r.x * (0.16666667 + r.x * (0.041666325 + r.x * (0.008333219 + r.x * (
        0.001394331 + r.x * 0.0001996244)))));
    let e = fast_two_sum(one.x, one.y + (r.y + rest), zero) * power_of_two(i32(n) - 1);
    let rough = 0.25 / e.x;
    let i = rough - 4.0 * rough * rough * e.y;
    let far_sine = fast_two_sum(e.x, e.y - i, zero);
    let far_cosine = fast_two_sum(e.x, e.y + i, zero);
    let near = a < 1.0;
    return WavePair(select(far_sine, near_sine, near), select(far_cosine, near_cosine, near));
}

/// 1/(p² + q²) as a quotient and its correction.
fn inverse_norm(p: vec2f, q: vec2f) -> vec2f {
    let zero = hidden_zero_of(p.x, q.x);
    let norm = two_sum(opaque(p.x * p.x, zero), opaque(q.x * q.x, zero), zero);
    let low = norm.y + 2.0 * (p.x * p.y + q.x * q.y);
    let i = opaque(1.0 / norm.x, zero);
    let back = two_product(i, norm.x, zero);
    return vec2f(i, i * (((1.0 - back.x) - back.y) - i * low));
}

/// p q times the inverse of a norm.
fn times_inverse(p: vec2f, q: vec2f, inverse: vec2f) -> f32 {
    let high = p.x * q.x;
    return high * inverse.x + (high * inverse.y + (p.x * q.y + p.y * q.x) * inverse.x);
}

/// From where on sinh and cosh are equal, and 1 is nothing beside their squares.
const FAR_OUT = 12.0;

/// c 2 e^-a for |c| ≤ 1 and a ≥ 0, both components.
fn far_reciprocal(c: vec2f, a: f32) -> vec2f {
    let s = split_exponent(-min(a, 240.0));
    let r = 1.0 + expm1_polynomial(s.x);
    let n = i32(s.y) + 1;
    return vec2f(times_wide_power_of_two(r * c.x, n), times_wide_power_of_two(r * c.y, n));
}

/// sinh z / 2^n and n.
struct ScaledSinh {
    sinh: vec2f,
    exponent: i32,
}

/// sinh z for finite z, to 2 ulp each component, and scaled far out.
fn scaled_sinh(z: vec2f) -> ScaledSinh {
    let wave = circular_pair(z.y);
    let a = magnitude(z.x);
    let across = sign_bit(z.x) ^ wave.cosine_sign;
    if a > FAR_OUT {
        let s = split_exponent(min(a, 240.0));
        let r = 0.5 + 0.5 * expm1_polynomial(s.x);
        let size = r * vec2f(wave.size.cosine.x, wave.size.sine.x);
        return ScaledSinh(vec2f(flip_sign(size.x, across), flip_sign(size.y, wave.sine_sign)), i32(s.y));
    }
    let h = hyperbolic_pair(a);
    let one = vec2f(1.0, 0.0);
    let re = times_inverse(h.sine, wave.size.cosine, one);
    let im = times_inverse(h.cosine, wave.size.sine, one);
    return ScaledSinh(vec2f(flip_sign(re, across), flip_sign(im, wave.sine_sign)), 0);
}

/// tanh z = (sinh x cosh x + i sin y cos y) / (sinh² x + cos² y) (C99 G.6.2.6).
/// Error: 3 ulp each component.
fn complex_tanh(z: vec2f) -> vec2f {
    if magnitude(z.y) == 0.0 {
        return vec2f(real_tanh(z.x), z.y);
    }
    if is_infinite(z.x) && !is_finite(z.y) {
        return vec2f(with_sign(1.0, z.x), with_sign(0.0, z.y));
    }
    if !is_finite(z.y) || is_nan(z.x) {
        return vec2f(select(make_nan(z.x), z.x, magnitude(z.x) == 0.0), make_nan(z.y));
    }
    let wave = circular_pair(z.y);
    let sign = wave.sine_sign ^ wave.cosine_sign;
    let a = magnitude(z.x);
    if a > FAR_OUT {
        let e = exp_scaled(max(-2.0 * a, -150.0), 2);
        return vec2f(with_sign(1.0, z.x), flip_sign(times_inverse(wave.size.sine, wave.size.cosine, vec2f(e, 0.0)), sign));
    }
    let h = hyperbolic_pair(a);
    let inverse = inverse_norm(h.sine, wave.size.cosine);
    return vec2f(
        with_sign(times_inverse(h.sine, h.cosine, inverse), z.x),
        flip_sign(times_inverse(wave.size.sine, wave.size.cosine, inverse), sign),
    );
}

/// tan z = -i tanh(i z).
/// Error: 3 ulp each component.
fn complex_tan(z: vec2f) -> vec2f {
    return complex_div_i(complex_tanh(complex_mul_i(z)));
}

/// 1/cosh z = (cosh x cos y - i sinh x sin y) / (sinh² x + cos² y).
/// Error: 3 ulp each component.
fn complex_sech(z: vec2f) -> vec2f {
    if is_nan(z.x) || !is_finite(z.y) {
        let rest = select(make_nan(z.x), 0.0, is_infinite(z.x));
        return vec2f(rest, rest);
    }
    let wave = circular_pair(z.y);
    let a = magnitude(z.x);
    var size = vec2f(0.0, 0.0);
    if a > FAR_OUT {
        size = far_reciprocal(vec2f(wave.size.cosine.x, wave.size.sine.x), a);
    } else {
        let h = hyperbolic_pair(a);
        let inverse = inverse_norm(h.sine, wave.size.cosine);
        size = vec2f(times_inverse(h.cosine, wave.size.cosine, inverse), times_inverse(h.sine, wave.size.sine, inverse));
    }
    let down = sign_bit(z.x) ^ wave.sine_sign ^ 0x80000000u;
    return vec2f(flip_sign(size.x, wave.cosine_sign), flip_sign(size.y, down));
}

/// 1/sinh z = (sinh x cos y - i cosh x sin y) / (sinh² x + sin² y), and 1/z close to 0.
/// Error: 3 ulp each component.
fn complex_csch(z: vec2f) -> vec2f {
    if is_nan(z.x) || !is_finite(z.y) {
        let rest = select(make_nan(z.x), 0.0, is_infinite(z.x));
        return vec2f(flip_sign(rest, sign_bit(z.x)), rest);
    }
    let a = magnitude(z.x);
    if max(a, magnitude(z.y)) < 1e-5 {
        return complex_inverse(z);
    }
    let wave = circular_pair(z.y);
    var size = vec2f(0.0, 0.0);
    if a > FAR_OUT {
        size = far_reciprocal(vec2f(wave.size.cosine.x, wave.size.sine.x), a);
    } else {
        let h = hyperbolic_pair(a);
        let inverse = inverse_norm(h.sine, wave.size.sine);
        size = vec2f(times_inverse(h.sine, wave.size.cosine, inverse), times_inverse(h.cosine, wave.size.sine, inverse));
    }
    let across = sign_bit(z.x) ^ wave.cosine_sign;
    return vec2f(flip_sign(size.x, across), flip_sign(size.y, wave.sine_sign ^ 0x80000000u));
}

/// 1/cos z = sech(i z).
/// Error: 3 ulp each component.
fn complex_sec(z: vec2f) -> vec2f {
    return complex_sech(complex_mul_i(z));
}

/// 1/sin z = i csch(i z).
/// Error: 3 ulp each component.
fn complex_csc(z: vec2f) -> vec2f {
    return complex_mul_i(complex_csch(complex_mul_i(z)));
}
