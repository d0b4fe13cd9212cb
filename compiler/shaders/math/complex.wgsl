// Complex arithmetic, exponential, logarithm and square root; a number is vec2f(re, im). Branch cuts, signed zeros and
// infinities after C99 Annex G.

/// Whether a component is infinite: then the number is, whatever the other is (C99 G.3).
fn complex_is_infinite(z: vec2f) -> bool {
    return is_infinite(z.x) || is_infinite(z.y);
}

/// Whether a component is NaN.
fn complex_has_nan(z: vec2f) -> bool {
    return is_nan(z.x) || is_nan(z.y);
}

/// i z.
fn complex_mul_i(z: vec2f) -> vec2f {
    return vec2f(flip_sign(z.y, 0x80000000u), z.x);
}

/// -i z.
fn complex_div_i(z: vec2f) -> vec2f {
    return vec2f(z.y, flip_sign(z.x, 0x80000000u));
}

/// z w; an infinite factor gives an infinite product (C99 G.5.1). Error: 1.5 ulp of the norm; a component that cancels
/// has that error, not its own.
fn complex_mul(z: vec2f, w: vec2f) -> vec2f {
    let p = vec2f(z.x * w.x - z.y * w.y, z.x * w.y + z.y * w.x);
    // infinite, too: where a product is fused with the sum, infinity minus a large number hides that both overflowed
    if !(is_finite(p.x) && is_finite(p.y)) {
        return complex_mul_special(z, w, p);
    }
    return p;
}

/// Infinite components become ±1, others ±0 (C99 G.5.1).
fn complex_box(z: vec2f) -> vec2f {
    return vec2f(
        with_sign(select(0.0, 1.0, is_infinite(z.x)), z.x),
        with_sign(select(0.0, 1.0, is_infinite(z.y)), z.y),
    );
}

/// NaN components become 0.
fn complex_without_nan(z: vec2f) -> vec2f {
    return vec2f(select(z.x, 0.0, is_nan(z.x)), select(z.y, 0.0, is_nan(z.y)));
}

fn complex_mul_special(z: vec2f, w: vec2f, plain: vec2f) -> vec2f {
    let infinite = complex_is_infinite(z) || complex_is_infinite(w);
    if !infinite && (complex_has_nan(z) || complex_has_nan(w)) {
        return plain;
    }
    if !infinite { // the products overflowed: in smaller numbers
        let e = complex_exponent(z);
        let f = complex_exponent(w);
        let c = z * power_of_two(-e);
        let d = w * power_of_two(-f);
        // in pairs, since the rounding of a product that cancels would overflow, too
        return vec2f(
            times_power_of_two(sum_of_products(c.x, d.x, -c.y, d.y), e + f),
            times_power_of_two(sum_of_products(c.x, d.y, c.y, d.x), e + f),
        );
    }
    if !(is_nan(plain.x) && is_nan(plain.y)) {
        return plain;
    }
    var a = z;
    var b = w;
    if complex_is_infinite(a) {
        a = complex_box(a);
        b = complex_without_nan(b);
    }
    if complex_is_infinite(b) {
        b = complex_box(b);
        a = complex_without_nan(a);
    }
    a = complex_without_nan(a) * power_of_two(-complex_exponent(a));
    b = complex_without_nan(b) * power_of_two(-complex_exponent(b));
    return make_infinity(1.0) * vec2f(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

/// z² = (x - y)(x + y) + 2 i x y. Error: 1.5 ulp each component.
fn complex_square(z: vec2f) -> vec2f {
    let xy = z.x * z.y;
    let p = vec2f((z.x - z.y) * (z.x + z.y), xy + xy);
    if !(is_finite(p.x) && is_finite(p.y)) {
        return complex_mul(z, z);
    }
    return p;
}

/// The exponent e of the larger component, 2^e ≤ max(|x|, |y|) < 2^(e+1), held within [-125, 126].
fn complex_exponent(z: vec2f) -> i32 {
    let bits = bitcast<u32>(max(magnitude(z.x), magnitude(z.y)));
    return clamp(i32(bits >> 23u) - 127, -125, 126);
}

/// z / w for |w| ≠ 0: both scaled by powers of two, special values after C99 G.5.1.
/// Error: 3.5 ulp each component, unless one of an argument is below 2^-100 of the other.
fn complex_div(z: vec2f, w: vec2f) -> vec2f {
    // z only as far as it must, lest a small component underflow
    let size = complex_exponent(z);
    let ez = select(select(0, 8, size > 119), -64, size < -30);
    let ew = complex_exponent(w);
    let a = z * power_of_two(-ez);
    let b = w * power_of_two(-ew);
    let norm = b.x * b.x + b.y * b.y;
    let q = vec2f(sum_of_products(a.x, b.x, a.y, b.y), sum_of_products(a.y, b.x, -a.x, b.y)) / norm;
    if is_nan(q.x) || is_nan(q.y) || norm == 0.0 {
        return complex_div_special(z, w);
    }
    let e = ez - ew;
    return vec2f(times_power_of_two(q.x, e), times_power_of_two(q.y, e));
}

fn complex_div_special(z: vec2f, w: vec2f) -> vec2f {
    let infinity = make_infinity(w.x);
    if magnitude(w.x) == 0.0 && magnitude(w.y) == 0.0 {
        return vec2f(infinity * z.x, infinity * z.y);
    }
    if complex_is_infinite(z) && is_finite(w.x) && is_finite(w.y) {
        let a = complex_box(z);
        let b = w * (1.0 / max(magnitude(w.x), magnitude(w.y)));
        return make_infinity(1.0) * vec2f(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y);
    }
    if complex_is_infinite(w) && is_finite(z.x) && is_finite(z.y) {
        let b = complex_box(w);
        return vec2f(with_sign(0.0, z.x * b.x + z.y * b.y), with_sign(0.0, z.y * b.x - z.x * b.y));
    }
    return vec2f(make_nan(z.x), make_nan(z.y));
}

/// 1 / z = z̄ / |z|², of z scaled by a power of two.
/// Error: 2.5 ulp each component.
fn complex_inverse(z: vec2f) -> vec2f {
    let e = complex_exponent(z);
    let a = z * power_of_two(-e);
    let norm = a.x * a.x + a.y * a.y;
    if complex_is_infinite(z) {
        return vec2f(with_sign(0.0, z.x), with_sign(0.0, -z.y));
    }
    if norm == 0.0 || !is_finite(norm) {
        return complex_div_special(vec2f(1.0, 0.0), z);
    }
    let q = vec2f(a.x, -a.y) / norm;
    return q * power_of_two(-e);
}

/// 1 / z² = 1 / (z²) of z scaled by a power of two: the square has accurate components, and nothing cancels in its inverse.
/// Error: 5 ulp each component.
fn complex_inverse_square(z: vec2f) -> vec2f {
    if complex_is_infinite(z) {
        return vec2f(0.0, 0.0);
    }
    let e = complex_exponent(z);
    let inverse = complex_inverse(complex_square(z * power_of_two(-e)));
    return vec2f(times_wide_power_of_two(inverse.x, -2 * e), times_wide_power_of_two(inverse.y, -2 * e));
}

/// |z| without spurious overflow.
/// Error: 1.2 ulp.
fn complex_abs(z: vec2f) -> f32 {
    return real_hypot(z.x, z.y);
}

/// The phase in [-π, π].
/// Error: 2 ulp.
fn complex_arg(z: vec2f) -> f32 {
    return real_atan2(z.y, z.x);
}

/// a b + c d with one rounding or two, however much cancels: both products exact in pairs (Dekker 1971).
fn sum_of_products(a: f32, b: f32, c: f32, d: f32) -> f32 {
    let zero = hidden_zero(a);
    let p = two_product(a, b, zero);
    let q = two_product(c, d, zero);
    let s = two_sum(p.x, q.x, zero);
    let rest = s.y + (p.y + q.y);
    return select(s.x + rest, s.x, rest == 0.0); // keeps a negative zero
}

/// e^z; e^x may overflow where e^x cos y does not.
/// Error: 3.2 ulp each component.
fn complex_exp(z: vec2f) -> vec2f {
    if magnitude(z.y) == 0.0 {
        return vec2f(real_exp(z.x), z.y);
    }
    if !is_finite(z.x) || !is_finite(z.y) {
        return complex_exp_special(z);
    }
    let wave = real_sincos(z.y);
    let s = split_exponent(clamp(z.x, -240.0, 240.0));
    let r = 1.0 + expm1_polynomial(s.x);
    let n = i32(s.y);
    return vec2f(times_wide_power_of_two(r * wave.y, n), times_wide_power_of_two(r * wave.x, n));
}

/// e^z - 1 = expm1 x cos y - 2 sin²(y/2) + i e^x sin y, beside e^x cos y = 1; elsewhere as it is written.
/// Error: 3 ulp of the norm; the real part has its own digits but where both of its terms have lost them.
fn complex_expm1(z: vec2f) -> vec2f {
    if !is_finite(z.x) || !is_finite(z.y) || z.x > 40.0 {
        let e = complex_exp(z);
        return vec2f(e.x - 1.0, e.y);
    }
    if magnitude(z.y) == 0.0 {
        return vec2f(real_expm1(z.x), z.y);
    }
    let wave = real_sincos(z.y);
    let growth = real_exp(z.x);
    let along = growth * wave.y;
    let across = flip_sign(magnitude(growth * wave.x), sign_bit(wave.x));
    if !(along > 0.5 && along < 2.0) { // nothing cancels
        return vec2f(along - 1.0, across);
    }
    let half = real_sin(0.5 * z.y);
    let turned = -2.0 * half * half; // cos y - 1, of which an underflow keeps the sign
    let careful = sum_of_products(real_expm1(z.x), wave.y, -2.0 * half, half);
    return vec2f(select(careful, turned, z.x == 0.0), across);
}

/// log(1 + z), cut along the negative axis left of -1; the real part is half of log1p(2x + x² + y²), summed in pairs.
/// Error: 3 ulp of the norm.
fn complex_log1p(z: vec2f) -> vec2f {
    if !(magnitude(z.x) < 0.5 && magnitude(z.y) < 0.5) {
        return complex_log(vec2f(1.0 + z.x, z.y));
    }
    if magnitude(z.y) == 0.0 {
        return vec2f(real_log1p(z.x), z.y);
    }
    let zero = hidden_zero(z.x);
    let xx = two_product(z.x, z.x, zero);
    let yy = two_product(z.y, z.y, zero);
    let s = two_sum(2.0 * z.x, yy.x, zero);
    let t = two_sum(s.x, xx.x, zero);
    let size = opaque(t.x, zero) + (opaque(t.y + s.y, zero) + (xx.y + yy.y));
    return vec2f(0.5 * real_log1p(size), real_atan2(z.y, 1.0 + z.x));
}

fn complex_exp_special(z: vec2f) -> vec2f {
    if is_infinite(z.x) && sign_is_set(z.x) {
        if !is_finite(z.y) {
            return vec2f(0.0, 0.0);
        }
        let wave = real_sincos(z.y);
        return vec2f(with_sign(0.0, wave.y), with_sign(0.0, wave.x));
    }
    if is_infinite(z.x) {
        if !is_finite(z.y) {
            return vec2f(z.x, make_nan(z.y));
        }
        let wave = real_sincos(z.y);
        return vec2f(make_infinity(wave.y), make_infinity(wave.x));
    }
    return vec2f(make_nan(z.x), make_nan(z.y));
}

/// log z, cut along the negative axis. The real part keeps its relative accuracy near |z| = 1.
/// Error: 2.6 ulp each component.
fn complex_log(z: vec2f) -> vec2f {
    return vec2f(log_hypot(z.x, z.y), real_atan2(z.y, z.x));
}

/// log √(x² + y²). Near the unit circle x² + y² - 1 = 2 d + d² + y² with the exact d = x - 1, summed in pairs (Kahan
/// 1987; Hull, Fairgrieve, Tang 1994).
fn log_hypot(x: f32, y: f32) -> f32 {
    let a = max(magnitude(x), magnitude(y));
    let b = min(magnitude(x), magnitude(y));
    if is_infinite(x) || is_infinite(y) {
        return make_infinity(1.0);
    }
    if is_nan(x) || is_nan(y) {
        return make_nan(x);
    }
    let norm = a * a + b * b;
    if a > 0.5 && a < 1.5 && norm > 0.5 && norm < 2.0 {
        let zero = hidden_zero(x);
        let d = opaque(a - 1.0, zero);
        let dd = two_product(d, d, zero);
        let bb = two_product(b, b, zero);
        let s = two_sum(2.0 * d, bb.x, zero);
        let t = two_sum(s.x, dd.x, zero);
        return 0.5 * real_log1p(opaque(t.x, zero) + (opaque(t.y + s.y, zero) + (bb.y + dd.y)));
    }
    let e = complex_exponent(vec2f(a, b));
    let v = vec2f(a, b) * power_of_two(-e);
    let l = 0.5 * real_log(v.x * v.x + v.y * v.y);
    return f32(e) * 0.693145751953125 + (l + f32(e) * 1.428606765330187e-06);
}

/// The root with positive real part, cut along the negative axis (Kahan 1987; C99 G.6.4.2).
/// Error: 3 ulp each component.
fn complex_sqrt(z: vec2f) -> vec2f {
    if is_infinite(z.y) {
        return vec2f(make_infinity(1.0), z.y);
    }
    if is_nan(z.x) {
        return vec2f(make_nan(z.x), make_nan(z.x));
    }
    if is_infinite(z.x) {
        let other = select(with_sign(0.0, z.y), make_nan(z.y), is_nan(z.y));
        if sign_is_set(z.x) {
            return vec2f(magnitude(other), make_infinity(z.y));
        }
        return vec2f(z.x, other);
    }
    if magnitude(z.x) == 0.0 && magnitude(z.y) == 0.0 {
        return vec2f(0.0, z.y);
    }
    let half = complex_exponent(z) >> 1u; // an even power of two comes out of the root exactly
    let a = vec2f(magnitude(z.x), magnitude(z.y)) * power_of_two(-2 * half);
    let t = sqrt(0.5 * (a.x + sqrt(a.x * a.x + a.y * a.y))) * power_of_two(half);
    let u = 0.5 * magnitude(z.y) / t; // not of the scaled one, which may have underflowed
    let negative = sign_is_set(z.x);
    return vec2f(select(t, u, negative), with_sign(select(u, t, negative), z.y));
}
