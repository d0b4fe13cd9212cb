// Spherical Bessel functions and the modified ones, of all orders that the operator table has (DLMF 10.47 - 10.53).

/// xⁿ/(2n + 1)!! Σ (sign x²/2)ᵏ / (k! (2n + 3)(2n + 5)…) (DLMF 10.53), |x| ≤ 2 √(n + 1.5).
fn spherical_series(x: f32, n: i32, sign: f32) -> f32 {
    var first = 1.0;
    for (var k = 1; k <= n; k++) {
        first *= x / (2.0 * f32(k) + 1.0);
    }
    let step = sign * 0.5 * x * x;
    var sum = 1.0;
    for (var k = 16; k > 0; k--) {
        sum = 1.0 + step / f32(k * (2 * (n + k) + 1)) * sum;
    }
    return first * sum;
}

/// The spherical Bessel function of order n: the series where it does not cancel, from x = 1.3 n on the recurrence (DLMF
/// 10.51.1) upwards, between the two downwards (Miller's algorithm, DLMF 3.6.ii).
fn real_spherical_j(x: f32, n: i32) -> f32 {
    if is_nan(x) {
        return x;
    }
    let a = magnitude(x);
    let flips = select(0u, sign_bit(x), (n & 1) == 1);
    if n > 0 && a * a < f32(2 * n + 3) {
        return flip_sign(spherical_series(a, n, -1.0), flips);
    }
    let zeroth = real_sinc(a);
    if n == 0 || is_infinite(a) {
        return flip_sign(zeroth, flips);
    }
    let first = (zeroth - real_cos(a)) / a;
    let inverse = 1.0 / a;
    var value = first;
    if a >= 1.3 * f32(n) {
        var last = zeroth;
        for (var k = 1; k < n; k++) {
            let next = f32(2 * k + 1) * inverse * value - last;
            last = value;
            value = next;
        }
        return flip_sign(value, flips);
    }
    var above = 0.0;
    var wanted = 0.0;
    value = 1e-30;
    for (var k = n + n / 2 + 15; k >= 0; k--) {
        let next = f32(2 * k + 3) * inverse * value - above;
        above = value;
        value = next;
        if k == n {
            wanted = value;
        }
    }
    if magnitude(value) > magnitude(above) {
        return flip_sign(wanted / value * zeroth, flips);
    }
    return flip_sign(wanted / above * first, flips);
}

/// Σ c (-r)ᵏ with c = (n + k)!/(k! (n - k)!) (DLMF 10.49.1).
fn spherical_sum(n: i32, r: f32) -> f32 {
    var sum = 1.0;
    for (var k = n - 1; k >= 0; k--) {
        sum = 1.0 - f32((n + k + 1) * (n - k)) / f32(k + 1) * r * sum;
    }
    return sum;
}

/// e^-|x| times the modified spherical Bessel function of the first kind of order n: the series, which does not cancel, for
/// small x; the finite sum of DLMF 10.49.8 where its terms fall; between the two the recurrence downwards.
fn real_spherical_i_scaled(x: f32, n: i32) -> f32 {
    if is_nan(x) {
        return x;
    }
    let a = magnitude(x);
    let zeroth = real_exprel(-2.0 * a);
    if n == 0 || is_infinite(a) {
        return zeroth;
    }
    let flips = select(0u, sign_bit(x), (n & 1) == 1);
    if a * a < f32(4 * n + 6) {
        return flip_sign(spherical_series(a, n, 1.0) * real_exp(-a), flips);
    }
    let inverse = 1.0 / a;
    if a > f32(n * (n + 1)) {
        let r = 0.5 * inverse;
        let falling = exp_scaled(-2.0 * min(a, 70.0), 0) * spherical_sum(n, -r);
        return flip_sign((spherical_sum(n, r) + select(falling, -falling, (n & 1) == 0)) * r, flips);
    }
    var value = 1e-30;
    var above = 0.0;
    var wanted = 0.0;
    for (var k = i32(sqrt(f32(n * n) + 20.0 * a)) + 6; k >= 0; k--) {
        let next = f32(2 * k + 3) * inverse * value + above;
        above = value;
        value = next;
        if k == n {
            wanted = value;
        }
        if value > 1e25 {
            value *= 1e-30;
            above *= 1e-30;
            wanted *= 1e-30;
        }
    }
    return flip_sign(wanted / value * zeroth, flips);
}
