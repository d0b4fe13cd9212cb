// Real functions of both wide formats, pairs of f32 and native f64: rounding, remainders, roots, exponential,
// logarithmic and hyperbolic functions. What differs between the formats stands in pair.wgsl and double.wgsl.

/// ⌈a⌉
fn real_ceil(a: real) -> real {
    return real_neg(real_floor(real_neg(a)));
}

/// a towards 0.
fn real_trunc(a: real) -> real {
    return with_sign(real_floor(real_abs(a)), a);
}

/// a to the nearest integer, halves away from zero.
/// Error: none.
fn real_round(a: real) -> real {
    let b = real_abs(a);
    let t = real_floor(b);
    let up = real_less_equal(num(0.5), real_sub(b, t));
    return with_sign(choose(up, add32(t, 1.0), t), a);
}

/// a - ⌊a⌋, in [0, 1): where that rounds to 1 the largest number below. NaN of infinities.
fn real_fract(a: real) -> real {
    if !is_finite(a) {
        return make_nan(a);
    }
    let f = real_sub(a, real_floor(a));
    return choose(real_less(f, below_one()), f, below_one());
}

/// -1, 0 or 1; 0 for both zeros.
/// Error: none.
fn real_sign(a: real) -> real {
    if is_nan(a) {
        return a;
    }
    return choose(is_zero(a), num(0.0), with_sign(num(1.0), a));
}

/// The smaller; the other where one is NaN.
fn real_min(a: real, b: real) -> real {
    return choose(is_nan(b) || real_less(a, b), a, b);
}

/// The larger; the other where one is NaN.
fn real_max(a: real, b: real) -> real {
    return choose(is_nan(b) || real_less(b, a), a, b);
}

/// √(x² + y²) without spurious overflow or underflow; infinite when an argument is.
fn real_hypot(x: real, y: real) -> real {
    return real_hypot3(x, y, num(0.0));
}

/// √(x² + y² + z²) without spurious overflow or underflow; infinite when an argument is.
fn real_hypot3(x: real, y: real, z: real) -> real {
    if is_infinite(x) || is_infinite(y) || is_infinite(z) {
        return make_infinity(num(1.0));
    }
    let a = real_abs(x);
    let b = real_abs(y);
    let c = real_abs(z);
    let largest = real_max(real_max(a, b), c);
    if is_zero(largest) || is_nan(x) || is_nan(y) || is_nan(z) {
        return real_add(real_add(a, b), c);
    }
    let e = exponent_of(largest);
    let squares = real_add(real_square(scale(a, -e)), real_square(scale(b, -e)));
    return scale(real_sqrt(real_add(squares, real_square(scale(c, -e)))), e);
}

/// The real cube root, odd. One step of third order (Halley) from the cube root of the leading word, which is found by
/// Newton's iteration from a third of its exponent (Kahan).
fn real_cbrt(x: real) -> real {
    if is_zero(x) || !is_finite(x) {
        return x;
    }
    // |x| = 8^k m, 1 ≤ m < 8
    let e = exponent_of(x);
    let k = (e - ((e % 3) + 3) % 3) / 3;
    let m = scale(real_abs(x), -3 * k);
    let m32 = real_to_f32(m);
    var t = bitcast<f32>(bitcast<u32>(m32) / 3u + 709958130u);
    for (var i = 0; i < 3; i++) {
        t += (m32 / (t * t) - t) * 0.33333334;
    }
    // t (m - t³) / (2 t³ + m) more
    let start = real_from_f32(t);
    let cube = mul32(real_square(start), t);
    let rest = real_sub(m, rounded(cube));
    let step = real_div(mul32(rest, t), real_add(scale(cube, 1), m));
    return with_sign(scale(real_add(start, step), k), x);
}

/// A 64-bit integer (high, low) shifted left by n, 0 ≤ n < 64.
fn shift_left(v: vec2u, n: u32) -> vec2u {
    let m = n & 31u;
    let high = (v.x << m) | ((v.y >> 1u) >> (31u - m));
    return select(vec2u(high, v.y << m), vec2u(v.y << m, 0u), n >= 32u);
}

/// A 64-bit integer (high, low) shifted right by n, 0 ≤ n < 64.
fn shift_right(v: vec2u, n: u32) -> vec2u {
    let m = n & 31u;
    let low = (v.y >> m) | ((v.x << 1u) << (31u - m));
    return select(vec2u(v.x >> m, low), vec2u(0u, v.x >> m), n >= 32u);
}

fn integer_less(a: vec2u, b: vec2u) -> bool {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
}

fn integer_sub(a: vec2u, b: vec2u) -> vec2u {
    return vec2u(a.x - b.x - select(0u, 1u, a.y < b.y), a.y - b.y);
}

fn integer_add(a: vec2u, b: vec2u) -> vec2u {
    let low = a.y + b.y;
    return vec2u(a.x + b.x + select(0u, 1u, low < b.y), low);
}

/// v 2^n; 0 where that is below 1.
fn integer_at(v: u32, n: i32) -> vec2u {
    if n >= 0 {
        return shift_left(vec2u(0u, v), u32(min(n, 63)));
    }
    return vec2u(0u, select(v >> u32(min(-n, 31)), 0u, n < -31));
}

/// |a| / 2^e as an integer.
fn integer_of(a: real, e: i32) -> vec2u {
    let p = pieces_of(a);
    let high = integer_at(p.high, p.high_exponent - e);
    let low = integer_at(p.low, p.low_exponent - e);
    if p.low_is_negative {
        return integer_sub(high, low);
    }
    return integer_add(high, low);
}

/// v 2^e
fn real_from_integer64(v: vec2u, e: i32) -> real {
    if v.x == 0u && v.y == 0u {
        return num(0.0);
    }
    let lead = select(countLeadingZeros(v.x), 32u + countLeadingZeros(v.y), v.x == 0u);
    let top = shift_left(v, lead);
    return real_from_integer(top.x, top.y, e - i32(lead));
}

/// a mod b for finite a ≥ 0, b > 0, exactly: long division of 62-bit significands, a bit a step. With `complement` b
/// minus that unless it is 0: exact for a ≥ b, else rounded and below b.
fn remainder_of_magnitudes(a: real, b: real, complement: bool) -> real {
    if real_less(a, b) {
        if !complement || is_zero(a) {
            return a;
        }
        let difference = real_sub(b, a);
        return choose(real_less(difference, b), difference, real_mul(b, below_one()));
    }
    let eb = exponent_of(b) - 61;
    let ea = exponent_of(a) - 61;
    let divisor = integer_of(b, eb);
    var rest = integer_of(a, ea);
    if !integer_less(rest, divisor) {
        rest = integer_sub(rest, divisor);
    }
    for (var left = ea - eb; left > 0 && (rest.x | rest.y) != 0u; left--) {
        rest = shift_left(rest, 1u);
        if !integer_less(rest, divisor) {
            rest = integer_sub(rest, divisor);
        }
    }
    if complement && (rest.x | rest.y) != 0u {
        rest = integer_sub(divisor, rest);
    }
    return real_from_integer64(rest, eb);
}

/// x - y ⌊x / y⌋, exact but for one rounding: the sign of y, |result| < |y|. NaN for y = 0.
fn real_mod(x: real, y: real) -> real {
    if !is_finite(x) || is_nan(y) || is_zero(y) {
        return make_nan(x);
    }
    let opposite = sign_is_set(x) != sign_is_set(y);
    if is_infinite(y) {
        return choose(is_zero(x), with_sign(num(0.0), y), choose(opposite, y, x));
    }
    return with_sign(remainder_of_magnitudes(real_abs(x), real_abs(y), opposite), y);
}

/// x = n log 2 + r, |r| ≤ log(2)/2.
struct SplitExponent {
    rest: real,
    count: i32,
}

/// For |x| ≤ EXP_END (Cody and Waite: n times the first part of log 2 is exact).
fn split_exponent(x: real) -> SplitExponent {
    let n = floor(real_to_f32(x) * 1.442695 + 0.5);
    let t = rounded(real_sub(x, mul32(num(0.693145751953125), n)));
    return SplitExponent(real_sub(t, mul32(lit(1.4286068e-06, 5.497923e-14, -1.2939574e-21), n)), i32(n));
}

/// x within [-limit, limit]
fn clamped(x: real, limit: f32) -> real {
    return choose(real_less(num(limit), real_abs(x)), with_sign(num(limit), x), x);
}

/// e^r - 1, |r| ≤ log(2)/2.
fn expm1_polynomial(r: real) -> real {
    return real_add(r, real_mul(real_square(r), exp_tail(r)));
}

/// A number as value 2^exponent.
struct Scaled {
    value: real,
    exponent: i32,
}

/// e^x of no NaN with the value in [0.7, 1.42], so that products with it overflow only where they must: beyond EXP_END
/// as there, 2^-60 of which still is 0 or infinite.
fn exp_of_parts(x: real) -> Scaled {
    let s = split_exponent(clamped(x, EXP_END));
    return Scaled(add32(expm1_polynomial(s.rest), 1.0), s.count);
}

/// e^x.
fn real_exp(x: real) -> real {
    if is_nan(x) {
        return x;
    }
    let s = exp_of_parts(x);
    return scale(s.value, s.exponent);
}

/// 2^x.
fn real_exp2(x: real) -> real {
    if is_nan(x) {
        return x;
    }
    let a = clamped(x, 1.5 * EXP_END);
    let n = floor(real_to_f32(a) + 0.5);
    let r = real_mul(add32(a, -n), lit(0.6931472, -1.9046542e-9, -8.783184e-17));
    return scale(add32(expm1_polynomial(r), 1.0), i32(n));
}

/// e^x - 1, accurate near 0.
fn real_expm1(x: real) -> real {
    if is_nan(x) {
        return x;
    }
    if abs(real_to_f32(x)) < 1e-17 {
        return x;
    }
    let s = split_exponent(clamped(choose(real_less(x, num(-50.0)), num(-50.0), x), EXP_END));
    let v = expm1_polynomial(s.rest);
    if s.count == 0 {
        return v;
    }
    if s.count > 64 {
        return scale(add32(v, 1.0), s.count);
    }
    return expm1_of_parts(v, s.count);
}

/// A positive number as 2^k (1 + f), √½ ≤ 1 + f < √2 about.
struct SplitLogarithm {
    fraction: real,
    exponent: i32,
}

fn split_logarithm(x: real) -> SplitLogarithm {
    let e = exponent_of(x);
    let m = scale(x, -e);
    let up = real_to_f32(m) > 1.4142135;
    return SplitLogarithm(add32(choose(up, scale(m, -1), m), -1.0), e + select(0, 1, up));
}

/// log(1 + f) = f + this, √½ ≤ 1 + f ≤ √2: s (f²/2 + R) - f²/2 for s = f/(2 + f), R = 2 s²/3 + 2 s⁴/5 + … (fdlibm).
fn log1p_tail(f: real) -> real {
    let s = real_div(f, add32(f, 2.0));
    let z = real_square(s);
    let h = scale(real_square(f), -1);
    let r = real_mul(z, real_add(lit(0.6666667, -1.9868216e-8, 5.9211896e-16), real_mul(z, log_rest(z))));
    return real_sub(real_mul(s, real_add(h, r)), h);
}

/// Whether log x needs no arithmetic: x is ±0, negative, infinite or NaN.
fn log_is_special(x: real) -> bool {
    return !is_finite(x) || sign_is_set(x) || is_zero(x);
}

/// The value of a logarithm there: -∞, NaN, ∞ or NaN.
fn log_special(x: real) -> real {
    if is_zero(x) {
        return make_infinity(num(-1.0));
    }
    if is_nan(x) || !sign_is_set(x) {
        return x;
    }
    return make_nan(x);
}

/// k log 2 + log(1 + f)
fn log_of_split(k: i32, f: real) -> real {
    let n = f32(k);
    let low = real_add(log1p_tail(f), mul32(lit(1.4286068e-06, 5.497923e-14, -1.2939574e-21), n));
    return real_add(mul32(num(0.693145751953125), n), real_add(f, low));
}

/// log x; -∞ at ±0, NaN below.
fn real_log(x: real) -> real {
    if log_is_special(x) {
        return log_special(x);
    }
    let s = split_logarithm(x);
    return log_of_split(s.exponent, s.fraction);
}

/// log2 x; -∞ at ±0, NaN below; exact at powers of two.
fn real_log2(x: real) -> real {
    if log_is_special(x) {
        return log_special(x);
    }
    let s = split_logarithm(x);
    let l = real_add(s.fraction, log1p_tail(s.fraction));
    return add32(real_mul(l, lit(1.442695, 1.925963e-08, -4.2373395e-16)), f32(s.exponent));
}

/// log10 x; -∞ at ±0, NaN below.
fn real_log10(x: real) -> real {
    if log_is_special(x) {
        return log_special(x);
    }
    let s = split_logarithm(x);
    let n = f32(s.exponent);
    let l = real_add(s.fraction, log1p_tail(s.fraction));
    // log10 2 = 0.301025390625 + 4.6 … e-6, the first exact times every exponent
    let low = real_add(mul32(lit(4.605039e-06, -8.5323445e-14, 1.6449935e-21), n), real_mul(l, lit(0.4342945, -1.010305e-08, -1.00039104e-16)));
    let r = real_add(mul32(num(0.301025390625), n), low);
    // of a power of ten that the format holds, the whole number itself: ⌊log10 x⌋ counts digits
    let whole = floor(real_to_f32(r) + 0.5);
    if whole < 1.0 || whole > 22.0 || abs(real_to_f32(real_sub(r, num(whole)))) > 1e-10 {
        return r;
    }
    var power = num(1.0);
    for (var k = 0.0; k < whole; k += 1.0) {
        power = mul32(power, 10.0);
    }
    return choose(real_equal(power, x), num(whole), r);
}

/// 2^-k (1 + x) - 1 for k = ⌊log2 (1 + x)⌋ or so: neither term rounds where the other does not.
fn split_beside_one(x: real, k: i32) -> real {
    return real_add(scale(x, -k), rounded(add32(scale(num(1.0), -k), -1.0)));
}

/// log(1 + x), accurate near 0; -∞ at -1, NaN below.
fn real_log1p(x: real) -> real {
    if abs(real_to_f32(x)) < 1e-17 {
        return x;
    }
    let u = add32(x, 1.0);
    if log_is_special(u) {
        return log_special(u);
    }
    let k = split_logarithm(u).exponent;
    return log_of_split(k, split_beside_one(x, k));
}

/// e^rest 2^count - 1 for the polynomial e^rest - 1, 0 ≤ count ≤ 64 or count < 0.
fn expm1_of_parts(polynomial: real, count: i32) -> real {
    return real_add(scale(polynomial, count), rounded(add32(scale(num(1.0), count), -1.0)));
}

/// (sinh x, cosh x) / 2^exponent, so that products with them overflow only where they must.
struct ScaledWaves {
    sinh: real,
    cosh: real,
    exponent: i32,
}

/// From E = e^|x| - 1 and q = E / (1 + E): (E + q)/2 and 1 + E q / 2; far out both are e^|x| / 2.
fn scaled_sinhcosh(x: real) -> ScaledWaves {
    if is_nan(x) {
        return ScaledWaves(x, x, 0);
    }
    let a = real_abs(x);
    let s = split_exponent(clamped(a, EXP_END));
    let v = expm1_polynomial(s.rest);
    if real_to_f32(a) > 40.0 {
        let half = scale(add32(v, 1.0), -1);
        return ScaledWaves(with_sign(half, x), half, s.count);
    }
    let e = choose(real_to_f32(a) < 1e-17, a, expm1_of_parts(v, s.count));
    let q = real_div(e, add32(e, 1.0));
    let sinh = scale(real_add(e, q), -1);
    return ScaledWaves(with_sign(sinh, x), add32(scale(real_mul(e, q), -1), 1.0), 0);
}

/// (sinh x, cosh x)
fn real_sinhcosh(x: real) -> RealPair {
    let w = scaled_sinhcosh(x);
    return RealPair(scale(w.sinh, w.exponent), scale(w.cosh, w.exponent));
}

/// sinh x.
fn real_sinh(x: real) -> real {
    return real_sinhcosh(x).first;
}

/// cosh x.
fn real_cosh(x: real) -> real {
    return real_sinhcosh(x).second;
}

/// tanh x = E / (E + 2) for E = e^2x - 1.
fn real_tanh(x: real) -> real {
    if is_nan(x) {
        return x;
    }
    let e = real_expm1(scale(clamped(real_abs(x), 30.0), 1));
    return with_sign(real_div(e, add32(e, 2.0)), x);
}

/// arsinh x = log1p(x + x² / (1 + √(1 + x²))) (Kahan 1987).
fn real_asinh(x: real) -> real {
    let a = real_abs(x);
    if real_to_f32(a) > 1e9 || is_nan(x) {
        return with_sign(real_add(real_log(a), lit(0.6931472, -1.9046542e-9, -8.783184e-17)), x);
    }
    let z = real_square(a);
    let root = real_sqrt(add32(z, 1.0));
    return with_sign(real_log1p(real_add(a, real_div(z, add32(root, 1.0)))), x);
}

/// arcosh x = log1p(t + √(2t + t²)), t = x - 1; NaN below 1.
fn real_acosh(x: real) -> real {
    if is_nan(x) || real_less(x, num(1.0)) {
        return make_nan(x);
    }
    if real_to_f32(x) > 1e9 {
        return real_add(real_log(x), lit(0.6931472, -1.9046542e-9, -8.783184e-17));
    }
    let t = rounded(add32(x, -1.0));
    return real_log1p(real_add(t, real_sqrt(real_mul(t, add32(t, 2.0)))));
}

/// artanh x = log1p(2x / (1 - x)) / 2; ±∞ at ±1, NaN beyond.
fn real_atanh(x: real) -> real {
    let a = real_abs(x);
    if is_nan(x) || !real_less(a, num(1.0)) {
        return choose(real_equal(a, num(1.0)), make_infinity(x), make_nan(x));
    }
    return with_sign(scale(real_log1p(real_div(scale(a, 1), add32(real_neg(a), 1.0))), -1), x);
}
