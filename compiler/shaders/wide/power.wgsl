// Sums of twice the precision, and real powers: the logarithm in such a sum, so that the error of y log x stays below
// the last place.

/// a b
fn long_mul(a: Long, b: real) -> Long {
    let p = long_product(a.hi, b);
    return long_sum(p.hi, real_add(p.lo, real_mul(a.lo, b)));
}

/// a b
fn long_times(a: Long, b: Long) -> Long {
    let p = long_product(a.hi, b.hi);
    return long_sum(p.hi, real_add(p.lo, real_add(real_mul(a.hi, b.lo), real_mul(a.lo, b.hi))));
}

fn long_to_real(a: Long) -> real {
    return real_add(a.hi, a.lo);
}

/// log x of a positive finite x: relative error 2^-52 in pairs, 2^-65 in f64.
fn long_log(x: real) -> Long {
    let split = split_logarithm(x);
    let f = split.fraction;
    // s = f / (2 + f): the logarithm is that of (1 + s)/(1 - s)
    let g = long_sum(num(2.0), f);
    let q = real_div(f, g.hi);
    let p = long_product(q, g.hi);
    let rest = real_sub(real_sub(rounded(real_sub(f, p.hi)), p.lo), real_mul(q, g.lo));
    let s = long_sum(q, real_div(rest, g.hi));
    let l = long_add(Long(scale(s.hi, 1), scale(s.lo, 1)), log_correction(s));
    let n = f32(split.exponent);
    let low = mul32(lit(1.4286068e-06, 5.497923e-14, -1.2939574e-21), n);
    return long_add(long_sum(mul32(num(0.693145751953125), n), low), l);
}

/// e^a
fn exp_of_long(a: Long) -> real {
    if real_less(num(EXP_END), real_abs(a.hi)) {
        return choose(sign_is_set(a.hi), num(0.0), make_infinity(num(1.0)));
    }
    let s = split_exponent(a.hi);
    return scale(add32(expm1_polynomial(real_add(s.rest, a.lo)), 1.0), s.count);
}

/// x^y for a positive finite x and finite y.
fn power_of_positive(x: real, y: real) -> real {
    return exp_of_long(long_mul(long_log(x), y));
}

/// Whether y is an integer.
fn is_integer(y: real) -> bool {
    return real_equal(real_floor(y), y);
}

/// Whether y is an odd integer.
fn is_odd(y: real) -> bool {
    return is_integer(y) && !is_integer(scale(y, -1));
}

/// x^y of ±0, ±1, ±∞ to a y that is not 0 nor NaN, or of any number but 1 to ±∞.
fn power_at_ends(x: real, grows: bool, sign: bool) -> real {
    let r = choose(grows, make_infinity(num(1.0)), num(0.0));
    return flip_if(choose(real_equal(real_abs(x), num(1.0)), num(1.0), r), sign);
}

/// x^y as C99 F.9.4.4: x^0 = 1^y = 1; a negative x has powers for integer y only.
fn real_pow(x: real, y: real) -> real {
    let one = num(1.0);
    if is_zero(y) || real_equal(x, one) {
        return one;
    }
    if is_nan(x) || is_nan(y) {
        return make_nan(x);
    }
    let a = real_abs(x);
    let sign = sign_is_set(x) && is_odd(y);
    if is_zero(a) || is_infinite(x) || is_infinite(y) || real_equal(a, one) {
        if sign_is_set(x) && real_equal(a, one) && !is_integer(y) {
            return make_nan(x);
        }
        return power_at_ends(x, real_less(one, a) != sign_is_set(y), sign);
    }
    if sign_is_set(x) && !is_integer(y) {
        return make_nan(x);
    }
    return flip_if(power_of_positive(a, y), sign);
}

/// x^n for every integer n: up to 5 factors by multiplication, more by logarithms. x^0 = 1.
fn real_powi(x: real, n: i32) -> real {
    let one = num(1.0);
    let count = u32(abs(n)); // 2^31 for the least i32
    if count <= 5u {
        let x2 = real_square(x);
        var p = choose((count & 1u) == 1u, x, one);
        p = choose((count & 2u) == 2u, real_mul(p, x2), p);
        p = choose((count & 4u) == 4u, real_mul(p, real_square(x2)), p);
        if n >= 0 {
            return p;
        }
        let e = select(0, exponent_of(p), is_finite(p) && !is_zero(p));
        if n == -1 || abs(e) < 76 { // else a pair may have lost digits
            return real_div(one, p);
        }
    }
    let sign = sign_is_set(x) && (count & 1u) == 1u;
    let a = real_abs(x);
    if is_zero(a) || !is_finite(x) || real_equal(a, one) {
        if is_nan(x) {
            return x;
        }
        return power_at_ends(x, real_less(one, a) == (n > 0), sign);
    }
    return flip_if(power_of_positive(a, real_from_i32(n)), sign);
}

/// x^(y + c) for a small whole c: with the rounded sum s and its error e, x^s (1 + e log |x|), for e log |x| is tiny.
fn real_pow_shift(x: real, y: real, c: real) -> real {
    let s = long_sum(y, c);
    if !is_finite(y) || is_zero(s.lo) || is_zero(x) || !is_finite(x) {
        return real_pow(x, s.hi);
    }
    let odd = is_odd(y);
    if sign_is_set(x) && !real_equal(real_floor(y), y) {
        return make_nan(x);
    }
    let a = real_abs(x);
    let power = real_mul(real_pow(a, s.hi), real_add(num(1.0), real_mul(s.lo, real_log(a))));
    return flip_if(power, sign_is_set(x) && odd != is_odd(c));
}
