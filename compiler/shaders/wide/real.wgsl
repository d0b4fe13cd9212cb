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
    return choose(real_less(f, num(1.0)), f, below_one());
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
