// Real exponential, logarithmic and hyperbolic functions, and the small change.

/// x < 0, -0 included.
fn sign_is_set(x: f32) -> bool {
    return sign_bit(x) != 0u;
}

/// e^r = 1 + r + r² P(r), |r| ≤ log(2)/2; coefficients.py, expm1.
fn expm1_polynomial(r: f32) -> f32 {
    return r + r * r * (0.5 + r * (0.16666667 + r * (0.041666325 + r * (0.008333219 + r * (
        0.001394331 + r * 0.0001996244)))));
}

/// x = n log 2 + r: (r, n), for |x| ≤ 200 (Cody and Waite: n times the first part of log 2 is exact).
fn split_exponent(x: f32) -> vec2f {
    let n = floor(x * 1.442695 + 0.5);
    let t = opaque(x - n * 0.693145751953125, hidden_zero(x));
    return vec2f(t - n * 1.428606765330187e-06, n);
}

/// e^x 2^k, with one rounding at the ends of the range; |k| ≤ 40.
fn exp_scaled(x: f32, k: i32) -> f32 {
    if is_nan(x) {
        return x;
    }
    let s = split_exponent(clamp(x, -150.0, 150.0));
    return times_power_of_two(1.0 + expm1_polynomial(s.x), i32(s.y) + k);
}

/// e^x.
/// Error: 1 ulp.
fn real_exp(x: f32) -> f32 {
    return exp_scaled(x, 0);
}

/// 2^r = 1 + r P(r), |r| ≤ 1/2; coefficients.py, exp2.
fn exp2_polynomial(r: f32) -> f32 {
    return 1.0 + r * (0.6931472 + r * (0.2402265 + r * (0.055503264 + r * (0.009618004 + r * (
        0.0013400827 + r * 0.00015476375)))));
}

/// 2^x.
/// Error: 1.3 ulp.
fn real_exp2(x: f32) -> f32 {
    if is_nan(x) {
        return x;
    }
    let a = clamp(x, -200.0, 200.0);
    let n = floor(a + 0.5);
    return times_power_of_two(exp2_polynomial(a - n), i32(n));
}

/// e^x - 1, accurate near 0.
/// Error: 1.5 ulp.
fn real_expm1(x: f32) -> f32 {
    if is_nan(x) {
        return x;
    }
    let a = magnitude(x);
    if a < 0.34 {
        return select(expm1_polynomial(x), x, a < 1e-8);
    }
    let s = split_exponent(clamp(x, -50.0, 150.0));
    let n = i32(s.y);
    let v = expm1_polynomial(s.x);
    if n > 40 {
        return times_power_of_two(1.0 + v, n);
    }
    let t = power_of_two(n);
    return t * v + opaque(t - 1.0, hidden_zero(x));
}

/// A positive number as 2^k (1 + f), √½ ≤ 1 + f < √2: (f, k).
fn split_logarithm(x: f32) -> vec2f {
    var bits = bitcast<u32>(x);
    var k = -127;
    if bits < 0x00800000u { // subnormal, wherever they are not flushed
        bits = bitcast<u32>(f32(bits));
        k -= 149;
    }
    bits += 0x004afb0du; // 1 - √½ in units of the last place
    let m = bitcast<f32>((bits & 0x007fffffu) + 0x3f3504f3u);
    return vec2f(m - 1.0, f32(i32(bits >> 23u) + k));
}

/// log(1 + f) = f + this: -f²/2 + f³ P(f) for √½ ≤ 1 + f ≤ √2; coefficients.py, log.
fn log1p_tail(f: f32) -> f32 {
    let z = f * f;
    return f * z * (0.3333333 + f * (-0.2500082 + f * (0.2000123 + f * (-0.16623364 + f * (0.14201699 + f * (
        -0.13160053 + f * (0.12761931 + f * -0.07635267))))))) - 0.5 * z;
}

/// Whether log x needs no arithmetic: x is ±0, negative, infinite or NaN.
fn log_is_special(x: f32) -> bool {
    return bitcast<u32>(x) - 1u >= 0x7f7fffffu;
}

/// The value of a logarithm there: -∞, NaN, ∞ or NaN.
fn log_special(x: f32) -> f32 {
    if magnitude(x) == 0.0 {
        return make_infinity(-1.0);
    }
    if is_nan(x) || !sign_is_set(x) {
        return x;
    }
    return make_nan(x);
}

/// log x; -∞ at ±0, NaN below.
/// Error: 0.9 ulp.
fn real_log(x: f32) -> f32 {
    if log_is_special(x) {
        return log_special(x);
    }
    let s = split_logarithm(x);
    return s.y * 0.693145751953125 + (s.x + (s.y * 1.428606765330187e-06 + log1p_tail(s.x)));
}

/// log2 x; -∞ at ±0, NaN below; exact at powers of two.
/// Error: 2.3 ulp.
fn real_log2(x: f32) -> f32 {
    if log_is_special(x) {
        return log_special(x);
    }
    let s = split_logarithm(x);
    return s.y + (s.x + log1p_tail(s.x)) * 1.442695;
}

/// log10 x; -∞ at ±0, NaN below.
/// Error: 2.6 ulp.
fn real_log10(x: f32) -> f32 {
    if log_is_special(x) {
        return log_special(x);
    }
    let s = split_logarithm(x);
    // log10 2 = 0.30078125 + 0.0002487457 …, the first exact times every exponent
    return s.y * 0.30078125 + (s.y * 0.00024874566 + (s.x + log1p_tail(s.x)) * 0.4342945);
}

/// log(1 + x), accurate near 0; -∞ at -1, NaN below.
/// Error: 1.5 ulp.
fn real_log1p(x: f32) -> f32 {
    if magnitude(x) < 1e-8 {
        return x;
    }
    let u = 1.0 + x;
    if log_is_special(u) || x > 1e8 {
        return real_log(select(u, x, x > 1e8));
    }
    // 1 + f = 2^-k (1 + x): neither term rounds where the other does not
    let k = split_logarithm(u).y;
    let t = power_of_two(-i32(k));
    let f = t * x + (t - 1.0);
    return k * 0.693145751953125 + (f + (k * 1.428606765330187e-06 + log1p_tail(f)));
}

/// sinh t = t + t³ P(t²), |t| ≤ 1; coefficients.py, sinh.
fn sinh_polynomial(t: f32) -> f32 {
    let z = t * t;
    return t + t * z * (0.16666667 + z * (0.00833335 + z * (0.0001983616 + z * 2.816952e-06)));
}

/// (sinh x, cosh x).
fn real_sinhcosh(x: f32) -> vec2f {
    let a = magnitude(x);
    let e = exp_scaled(a, -1); // e^a / 2
    let i = 0.25 / e;
    let s = select(e - i, sinh_polynomial(min(a, 1.0)), a < 1.0);
    return vec2f(flip_sign(s, sign_bit(x)), e + i);
}

/// sinh x.
/// Error: 1.7 ulp.
fn real_sinh(x: f32) -> f32 {
    return real_sinhcosh(x).x;
}

/// cosh x.
/// Error: 1.5 ulp.
fn real_cosh(x: f32) -> f32 {
    return real_sinhcosh(x).y;
}

/// tanh x: t + t³ P(t²) below 0.63 (coefficients.py, tanh), then 1 - 2 / (e^2x + 1).
/// Error: 1.4 ulp.
fn real_tanh(x: f32) -> f32 {
    let a = magnitude(x);
    if a < 0.63 {
        let z = a * a;
        return flip_sign(a + a * z * (-0.33333275 + z * (0.13331275 + z * (-0.05372513 + z * (
            0.020589832 + z * -0.005648322)))), sign_bit(x));
    }
    let r = 1.0 - 2.0 / (exp_scaled(2.0 * min(a, 20.0), 0) + 1.0);
    return select(flip_sign(r, sign_bit(x)), x, is_nan(x));
}

/// arsinh x: t + t³ P(t²) below 1/2 (coefficients.py, asinh), then log1p(x + x² / (1 + √(1 + x²))) (Kahan 1987).
/// Error: 1.6 ulp.
fn real_asinh(x: f32) -> f32 {
    let a = magnitude(x);
    if a < 0.5 {
        let z = a * a;
        return flip_sign(a + a * z * (-0.16666643 + z * (0.074986525 + z * (-0.044384517 + z * (
            0.028169118 + z * -0.013237515)))), sign_bit(x));
    }
    if a > 1e8 || is_nan(x) {
        return flip_sign(real_log(a) + 0.6931472, sign_bit(x));
    }
    let z = a * a;
    return flip_sign(real_log1p(a + z / (1.0 + sqrt(1.0 + z))), sign_bit(x));
}

/// arcosh x = log1p(t + √(2t + t²)), t = x - 1; NaN below 1.
/// Error: 2.0 ulp.
fn real_acosh(x: f32) -> f32 {
    if is_nan(x) || x < 1.0 {
        return make_nan(x);
    }
    if x > 1e8 {
        return real_log(x) + 0.6931472;
    }
    let t = x - 1.0;
    return real_log1p(t + sqrt(t * (t + 2.0)));
}

/// artanh x: t + t³ P(t²) below 1/2 (coefficients.py, atanh), then log1p(2x / (1 - x)) / 2; ±∞ at ±1, NaN beyond.
/// Error: 1.1 ulp.
fn real_atanh(x: f32) -> f32 {
    let a = magnitude(x);
    if a < 0.5 {
        let z = x * x;
        return x + x * z * (0.33333302 + z * (0.20002519 + z * (0.14222763 + z * (0.11823733 + z * (
            0.051357966 + z * 0.17669164)))));
    }
    if bitcast<u32>(a) >= 0x3f800000u { // from 1 on, or NaN
        return select(make_nan(x), make_infinity(x), a == 1.0);
    }
    return flip_sign(0.5 * real_log1p(2.0 * a / (1.0 - a)), sign_bit(x));
}

/// √(x² + y²) without spurious overflow or underflow; infinite when an argument is.
/// Error: 1.2 ulp.
fn real_hypot(x: f32, y: f32) -> f32 {
    // only the smaller square is rounded where `fma` is fused; a minimum would lose a NaN
    let swapped = magnitude(x) < magnitude(y);
    let a = select(x, y, swapped);
    let b = select(y, x, swapped);
    let other = b * b;
    let square = fma(a, a, other);
    if bitcast<u32>(square) - 0x12800000u < 0x5f000000u {
        return corrected_root(square, fma(b, b, -other));
    }
    return scaled_hypot3(x, y, 0.0);
}

/// √(x² + y² + z²) without spurious overflow or underflow; infinite when an argument is.
/// Error: 1.5 ulp.
fn real_hypot3(x: f32, y: f32, z: f32) -> f32 {
    let square = x * x + y * y + z * z;
    // from 2^-90 to 2^100, and no NaN: no square that counts has overflowed or underflowed
    if bitcast<u32>(square) - 0x12800000u < 0x5f000000u {
        return sqrt(square);
    }
    return scaled_hypot3(x, y, z);
}

/// √(x² + y² + z²) by way of numbers of about 1, a power of two away.
/// Error: 1.5 ulp.
fn scaled_hypot3(x: f32, y: f32, z: f32) -> f32 {
    let a = magnitude(x);
    let b = magnitude(y);
    let c = magnitude(z);
    if is_infinite(x) || is_infinite(y) || is_infinite(z) {
        return make_infinity(1.0);
    }
    let exponent = clamp(bitcast<u32>(max(max(a, b), c)) >> 23u, 1u, 253u);
    let scale = bitcast<f32>((254u - exponent) << 23u);
    let v = vec3f(a, b, c) * scale;
    return corrected_root(v.x * v.x + v.y * v.y + v.z * v.z, 0.0) * bitcast<f32>(exponent << 23u);
}

/// √(square + rest) for a normal square and a rest that is far smaller. Where `fma` rounds once, `sqrt` may be off by more
/// than an IEEE root, and one step of Newton's mends it; where it rounds twice, there is no telling, and the root stays.
fn corrected_root(square: f32, rest: f32) -> f32 {
    let root = sqrt(square);
    // the square of an odd significand is no float32
    let odd = bitcast<f32>(bitcast<u32>(root) | 1u);
    let is_fused = fma(odd, odd, -(odd * odd)) != 0.0;
    return select(root, fma(fma(-root, root, square) + rest, 0.5 * inverseSqrt(square), root), is_fused);
}

/// The real cube root, odd: the exponent divided by three (Kahan), then Newton's iteration.
/// Error: 0.8 ulp.
fn real_cbrt(x: f32) -> f32 {
    let subnormal = magnitude(x) < 1.1754944e-38;
    let a = select(magnitude(x), magnitude(x) * 16777216.0, subnormal);
    if a == 0.0 || !is_finite(x) {
        return x;
    }
    var t = bitcast<f32>(bitcast<u32>(a) / 3u + 709958130u);
    for (var i = 0; i < 3; i++) {
        t += (a / (t * t) - t) * 0.33333334;
    }
    return flip_sign(select(t, t * 0.00390625, subnormal), sign_bit(x));
}

/// a mod b for finite a ≥ 0, b > 0, exactly: long division of the significands in integers, 8 bits a step. With
/// `complement` b minus that unless it is 0: exact for a ≥ b, else rounded and below b.
fn remainder_of_magnitudes(a: f32, b: f32, complement: bool) -> f32 {
    if a < b {
        let below = bitcast<f32>(bitcast<u32>(b) - 1u);
        return select(a, min(b - a, below), complement && a > 0.0);
    }
    let ua = bitcast<u32>(a);
    let ub = bitcast<u32>(b);
    let divisor = (ub & 0x7fffffu) | 0x800000u;
    var rest = ((ua & 0x7fffffu) | 0x800000u) % divisor;
    var left = (ua >> 23u) - (ub >> 23u);
    // ends: each turn takes up to 8 of 254 bits
    while left > 0u && rest > 0u {
        let step = min(left, 8u);
        rest = (rest << step) % divisor;
        left -= step;
    }
    rest = select(rest, divisor - rest, complement && rest > 0u);
    // rest < 2^24 in units of the last place of b, by bits, for that may be subnormal (a subnormal result is 0)
    let r = bitcast<u32>(f32(rest)) + (((ub >> 23u) - 150u) << 23u);
    // from the least normal number on, and not below 0, which wraps around
    return select(0.0, bitcast<f32>(r), rest > 0u && r - 0x00800000u < 0x7f800000u);
}

/// x - y ⌊x / y⌋, exact but for one rounding: the sign of y, |result| < |y|. NaN for y = 0.
/// Error: 0.5 ulp.
fn real_mod(x: f32, y: f32) -> f32 {
    let b = magnitude(y);
    if !is_finite(x) || is_nan(y) || b == 0.0 {
        return make_nan(x);
    }
    if is_infinite(y) {
        return select(select(y, x, sign_bit(x) == sign_bit(y)), with_sign(0.0, y), x == 0.0);
    }
    return with_sign(remainder_of_magnitudes(magnitude(x), b, sign_bit(x) != sign_bit(y)), y);
}

/// x - ⌊x⌋, in [0, 1): a tiny negative x gives the largest number below 1.
/// Error: 0.5 ulp.
fn real_fract(x: f32) -> f32 {
    if !is_finite(x) {
        return make_nan(x);
    }
    return min(x - floor(x), 0.99999994);
}

/// x to the nearest integer, halves away from zero.
/// Error: none.
fn real_round(x: f32) -> f32 {
    let a = magnitude(x);
    if bitcast<u32>(a) >= 0x4b000000u { // from 2^23 on, or NaN
        return x;
    }
    let t = floor(a);
    return flip_sign(t + select(0.0, 1.0, a - t >= 0.5), sign_bit(x));
}

/// -1, 0 or 1; 0 for both zeros.
/// Error: none.
fn real_sign(x: f32) -> f32 {
    // by bits: neither zero nor NaN, whose squares are 0 and NaN
    let signed = (bitcast<u32>(x) & 0x7fffffffu) - 1u < 0x7f800000u;
    return select(x * x, flip_sign(1.0, sign_bit(x)), signed);
}
