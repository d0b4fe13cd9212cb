// Real powers: the logarithm in two floats, so that the error of y log x stays below the last place.

/// log2 x of a positive finite x as an unevaluated sum, relative error about 2^-31.
fn log2_pair(x: f32, zero: u32) -> vec2f {
    let s = split_logarithm(x);
    let f = s.x;
    // q + p = f / (2 + f), the quotient of log((1 + s)/(1 - s)); q and 1 + m short, so that their product is exact
    let m = 1.0 + f;
    let g = 2.0 + f;
    let q = bitcast<f32>(bitcast<u32>(f / g) & 0xffffe000u);
    let mh = bitcast<f32>(bitcast<u32>(m) & 0xffffe000u);
    let ml = opaque(m - mh, zero);
    let r = opaque(f - opaque(q * opaque(mh + 1.0, zero), zero), zero);
    let p = (r - q * ml) / g;
    let t = q + p;
    let z = t * t;
    let tail = t * z * (0.3333333 + z * (0.2000017 + z * (0.1426846 + z * 0.11795005)));
    // times 2 / log 2 = 2.8847656 + 6.24456778e-4
    let head = opaque(q * 2.884765625, zero);
    let low = q * 0.00062445678 + (p + tail) * 2.88539;
    let sum = two_sum(s.y, head, zero);
    let hi = opaque(sum.x + (sum.y + low), zero);
    return vec2f(hi, (opaque(sum.x - hi, zero) + sum.y) + low);
}

/// 2^(a + b) for a pair, b small beside a.
fn exp2_pair(a: f32, b: f32, zero: u32) -> f32 {
    if a > 140.0 {
        return make_infinity(1.0);
    }
    if a < -160.0 {
        return 0.0;
    }
    let n = floor(a + 0.5);
    return times_power_of_two(exp2_polynomial(opaque(a - n, zero) + b), i32(n));
}

/// x^(y + y2) for a positive finite x and finite y; y2 is a small correction of y.
fn power_of_positive(x: f32, y: f32, y2: f32) -> f32 {
    let zero = hidden_zero_of(x, y);
    let l = log2_pair(x, zero);
    if magnitude(y) > 1e12 {
        let direction = y * l.x; // the nearest powers to 1 are those of 1 ± 2^-24
        return select(select(1.0, 0.0, direction < 0.0), make_infinity(1.0), direction > 0.0);
    }
    let p = two_product(y, l.x, zero);
    return exp2_pair(p.x, p.y + (y * l.y + y2 * l.x), zero);
}

/// Whether y is an odd integer.
fn is_odd(y: f32) -> bool {
    let a = magnitude(y);
    return a < 16777216.0 && floor(a) == a && (u32(a) & 1u) == 1u;
}

/// x^y as C99 F.9.4.4: x^0 = 1^y = 1; a negative x has powers for integer y only.
/// Error: 3 ulp over the whole range.
fn real_pow(x: f32, y: f32) -> f32 {
    if magnitude(y) == 0.0 || x == 1.0 {
        return 1.0;
    }
    if is_nan(x) || is_nan(y) {
        return make_nan(x);
    }
    let a = magnitude(x);
    let sign = select(0u, sign_bit(x), is_odd(y));
    if a == 0.0 || is_infinite(x) || is_infinite(y) || a == 1.0 {
        let grows = (a > 1.0) == (y > 0.0);
        let r = select(select(0.0, make_infinity(1.0), grows), 1.0, a == 1.0);
        if sign_is_set(x) && a == 1.0 && floor(y) != y {
            return make_nan(x);
        }
        return flip_sign(r, sign);
    }
    if sign_is_set(x) && floor(y) != y {
        return make_nan(x);
    }
    return flip_sign(power_of_positive(a, y, 0.0), sign);
}

/// x^(y + c) for a small whole c, the sum exact in two floats.
/// Error: 3 ulp over the whole range.
fn real_pow_shift(x: f32, y: f32, c: f32) -> f32 {
    let s = two_sum(y, c, hidden_zero_of(x, y));
    let a = magnitude(x);
    if !is_finite(y) || s.y == 0.0 || a == 0.0 || !is_finite(x) {
        return real_pow(x, s.x);
    }
    if sign_is_set(x) && floor(y) != y {
        return make_nan(x);
    }
    let odd = is_odd(y) != is_odd(c);
    return flip_sign(power_of_positive(a, s.x, s.y), select(0u, sign_bit(x), odd));
}

/// f x^(y + c) for a small whole c, where the power alone may leave the range: the derivative y x^(y-1).
/// Error: 2 ulp over the whole range.
fn real_scaled_power(x: f32, y: f32, c: f32, f: f32) -> f32 {
    let zero = hidden_zero_of(x, y);
    let s = two_sum(y, c, zero);
    let a = magnitude(x);
    let size = magnitude(f);
    let plain = !(size > 1.2e-38) || is_infinite(f) || magnitude(y) > 1e12 || is_nan(y);
    if plain || a == 0.0 || !is_finite(x) || (sign_is_set(x) && floor(y) != y) {
        return f * real_pow_shift(x, y, c);
    }
    let l = log2_pair(a, zero);
    let p = two_product(s.x, l.x, zero);
    let low = p.y + (s.x * l.y + s.y * l.x);
    let e = i32(bitcast<u32>(size) >> 23u) - 127;
    let m = bitcast<f32>((bitcast<u32>(f) & 0x807fffffu) | 0x3f000000u); // f = m 2^(e + 1)
    let exponent = clamp(p.x, -320.0, 320.0);
    let n = floor(exponent + 0.5);
    let power = exp2_polynomial(opaque(exponent - n, zero) + select(0.0, low, exponent == p.x));
    let r = times_wide_power_of_two(opaque(m * power, zero), clamp(i32(n) + e + 1, -360, 360));
    let odd = is_odd(y) != is_odd(c);
    return flip_sign(r, select(0u, sign_bit(x), odd));
}

/// x^n for every integer n: up to 5 factors by multiplication, more by logarithms in two floats. x^0 = 1.
/// Error: 3.2 ulp.
fn real_powi(x: f32, n: i32) -> f32 {
    let count = u32(abs(n)); // 2^31 for the least i32
    if count <= select(5u, 4u, n < 0) {
        let x2 = x * x;
        let x4 = x2 * x2;
        var p = select(1.0, x, (count & 1u) == 1u);
        p *= select(1.0, x2, (count & 2u) == 2u);
        p *= select(1.0, x4, (count & 4u) == 4u);
        if n >= 0 {
            return p;
        }
        let q = magnitude(p);
        if n == -1 || (q > 1e-37 && q < 1e37) {
            return 1.0 / p;
        }
    }
    let sign = select(0u, sign_bit(x), (count & 1u) == 1u);
    let a = magnitude(x);
    if a == 0.0 || !is_finite(x) || a == 1.0 {
        if is_nan(x) {
            return x;
        }
        let r = select(select(0.0, make_infinity(1.0), (a > 1.0) == (n > 0)), 1.0, a == 1.0);
        return flip_sign(r, sign);
    }
    let high = count & 0xffffff00u;
    let y = select(f32(high), -f32(high), n < 0);
    let y2 = select(f32(count - high), -f32(count - high), n < 0);
    // a long exponent keeps its last bits as a correction; a short one is exact at once
    let short = count < 16777216u;
    return flip_sign(power_of_positive(a, select(y, f32(n), short), select(y2, 0.0, short)), sign);
}
