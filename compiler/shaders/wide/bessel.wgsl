// Spherical Bessel functions and the modified ones, of all orders that the operator table has (DLMF 10.47 - 10.53).

/// xⁿ/(2n + 1)!! Σ (± x²/2)ᵏ / (k! (2n + 3)(2n + 5)…) (DLMF 10.53), |x| ≤ 2 √(n + 1.5).
fn spherical_series(x: real, n: i32, alternates: bool) -> real {
    var first = num(1.0);
    for (var k = 1; k <= n; k++) {
        first = real_mul(first, real_div(x, num(f32(2 * k + 1))));
    }
    let step = flip_if(scale(real_square(x), -1), alternates);
    var sum = num(1.0);
    for (var k = 26; k > 0; k--) {
        sum = add32(real_mul(real_div(step, num(f32(k * (2 * (n + k) + 1)))), sum), 1.0);
    }
    return real_mul(first, sum);
}

/// The spherical Bessel function of order n: the series where it does not cancel, from x = 1.3 n on the recurrence (DLMF
/// 10.51.1) upwards, between the two downwards (Miller's algorithm, DLMF 3.6.ii).
fn real_spherical_j(x: real, n: i32) -> real {
    if is_nan(x) {
        return x;
    }
    let a = real_abs(x);
    let flips = (n & 1) == 1 && sign_is_set(x);
    if n > 0 && is_below(real_square(a), f32(2 * n + 3)) {
        return flip_if(spherical_series(a, n, true), flips);
    }
    let zeroth = real_sinc(a);
    if n == 0 || is_infinite(a) {
        return flip_if(zeroth, flips);
    }
    let inverse = real_div(num(1.0), a);
    let first = real_mul(real_sub(zeroth, real_cos(a)), inverse);
    let grows = !is_below(a, 1.3 * f32(n));
    // upwards from the orders 0 and 1, or downwards
    var value = choose(grows, first, num(1e-30));
    var last = choose(grows, zeroth, num(0.0));
    var wanted = value;
    let steps = select(n + n / 2 + 28, n - 1, grows);
    for (var k = 0; k < steps; k++) {
        let order = select(steps - 1 - k, k, grows);
        let next = real_sub(real_mul(mul32(inverse, f32(2 * order + 3)), value), last);
        last = value;
        value = next;
        if !grows && order == n {
            wanted = value;
        }
    }
    if grows {
        return flip_if(value, flips);
    }
    let from_zeroth = real_less(real_abs(last), real_abs(value));
    let ratio = real_div(wanted, choose(from_zeroth, value, last));
    return flip_if(real_mul(ratio, choose(from_zeroth, zeroth, first)), flips);
}

/// Σ c (-r)ᵏ with c = (n + k)!/(k! (n - k)!) (DLMF 10.49.1).
fn spherical_sum(n: i32, r: real) -> real {
    var sum = num(1.0);
    for (var k = n - 1; k >= 0; k--) {
        let factor = real_div(mul32(r, f32((n + k + 1) * (n - k))), num(f32(k + 1)));
        sum = add32(real_neg(real_mul(factor, sum)), 1.0);
    }
    return sum;
}

/// e^-|x| times the modified spherical Bessel function of the first kind of order n: the series, which does not cancel, for
/// small x; the finite sum of DLMF 10.49.8 where its terms fall; between the two the recurrence downwards.
fn real_spherical_i_scaled(x: real, n: i32) -> real {
    if is_nan(x) {
        return x;
    }
    let a = real_abs(x);
    let zeroth = real_exprel(real_neg(twice(a)));
    if n == 0 || is_infinite(a) {
        return zeroth;
    }
    let flips = (n & 1) == 1 && sign_is_set(x);
    if is_below(real_square(a), f32(4 * n + 6)) {
        return flip_if(real_mul(spherical_series(a, n, false), real_exp(real_neg(a))), flips);
    }
    let inverse = real_div(num(1.0), a);
    if is_above(a, f32(n * (n + 1))) {
        let r = scale(inverse, -1);
        let falling = real_mul(real_exp(real_neg(twice(a))), spherical_sum(n, real_neg(r)));
        let sum = real_add(spherical_sum(n, r), flip_if(falling, (n & 1) == 0));
        return flip_if(real_mul(sum, r), flips);
    }
    var value = num(1e-30);
    var above = num(0.0);
    var wanted = value;
    for (var k = i32(sqrt(f32(n * n) + 40.0 * real_to_f32(a))) + 10; k >= 0; k--) {
        let next = real_add(real_mul(mul32(inverse, f32(2 * k + 3)), value), above);
        above = value;
        value = next;
        if k == n {
            wanted = value;
        }
        if is_above(value, 1e20) {
            value = scale(value, -80);
            above = scale(above, -80);
            wanted = scale(wanted, -80);
        }
    }
    return flip_if(real_mul(real_div(wanted, value), zeroth), flips);
}
