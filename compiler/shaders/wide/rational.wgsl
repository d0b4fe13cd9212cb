// Integrals of rational functions over [0, 1]: arctangent and logarithm divided by their argument, and what their
// derivatives need. Continued fraction: Gauss' for F(1, b/2; b/2 + 1; -z) (Cuyt, Petersen, Verdonk, Waadeland, Jones,
// "Handbook of Continued Fractions for Special Functions", 2008, section 15.3).

/// How many levels are enough: two gain a factor of (u + √(u² - 1))² with u = |1 + 2/z|.
fn fraction_levels(z: f32) -> i32 {
    let u = abs(1.0 + 2.0 / select(z, 1e-4, abs(z) < 1e-4));
    return clamp(i32(38.0 / log(u + sqrt(max(u * u - 1.0, 0.0)))) + 3, 4, 64);
}

/// The root of the numerator of a level.
fn moment_root(b: i32, k: i32) -> f32 {
    return f32(select(k + 1, b + k, (k & 1) == 0));
}

/// ∫₀¹ s^(b-1) / (1 + z s²) ds = 1/(b + b² z/(b + 2 + 2² z/(b + 4 + (b + 2)² z/(b + 6 + 4² z/(b + 8 + …))))),
/// -0.9 ≤ z ≤ 3.
fn moment_fraction(b: i32, z: real) -> real {
    let levels = fraction_levels(real_to_f32(z));
    var value = num(f32(b + 2 * levels));
    for (var k = levels - 1; k >= 0; k--) {
        let root = moment_root(b, k);
        value = add32(real_div(mul32(z, root * root), value), f32(b + 2 * k));
    }
    return real_div(num(1.0), value);
}

/// ∫₀¹ s^2n / (1 + z s²) ds: for n = 0 atan(√z)/√z, continued through 0 to artanh(√-z)/√-z; ∞ at -1, NaN below.
fn real_atan_quotient(z: real, n: i32) -> real {
    if is_nan(z) || real_less(z, num(-1.0)) {
        return make_nan(z);
    }
    if real_equal(z, num(-1.0)) {
        return make_infinity(num(1.0));
    }
    if is_infinite(z) {
        return num(0.0);
    }
    if is_below(real_abs(z), 0.1) || n > 0 && is_above(z, -0.9) && is_below(z, 3.0) {
        return moment_fraction(2 * n + 1, z);
    }
    let root = real_sqrt(real_abs(z));
    var value = real_atan(root);
    if sign_is_set(z) {
        // log((1 + r)/√(1 - r²))
        value = real_sub(real_log1p(root), scale(real_log1p(z), -1));
    }
    value = real_div(value, root);
    for (var k = 0; k < n; k++) {
        value = real_div(real_sub(real_div(num(1.0), num(f32(2 * k + 1))), value), z);
    }
    return value;
}

/// a + b - s where s is the sum: what these numbers are rounded by is not looked for.
fn real_sum_rest(a: real, b: real, s: real) -> real {
    return num(0.0);
}

/// The same of a b.
fn real_product_rest(a: real, b: real, p: real) -> real {
    return num(0.0);
}

/// The same of a b + c.
fn real_mul_add_rest(a: real, b: real, c: real, s: real) -> real {
    return num(0.0);
}

/// The same of sin x.
fn real_sine_rest(x: real, s: real) -> real {
    return num(0.0);
}

/// The same of cos x.
fn real_cosine_rest(x: real, s: real) -> real {
    return num(0.0);
}

/// -b/a, 0 where a is next to nothing or the quotient is no number of moderate size.
fn real_foot(a: real, b: real) -> real {
    if is_below(real_abs(a), 1e-30) {
        return num(0.0);
    }
    let place = real_neg(real_div(b, a));
    return choose(is_below(real_abs(place), 1e30), place, num(0.0));
}

/// a b + c, the product not rounded.
fn real_mul_add(a: real, b: real, c: real) -> real {
    if !is_below(real_abs(a), 1e18) || !is_below(real_abs(b), 1e18) || !is_below(real_abs(c), 1e37) {
        return real_add(real_mul(a, b), c);
    }
    return long_add_real(long_product(a, b), c).hi;
}

/// ∫ du/(u² + p) from x to ∞: atan2(√p, x)/√p, continued through p = 0; ∞ where the pole is at the end, NaN beyond.
fn real_atan2_quotient(p: real, x: real) -> real {
    if is_nan(p) || is_nan(x) {
        return make_nan(p);
    }
    let right = !sign_is_set(x);
    if right && is_infinite(x) || !sign_is_set(p) && is_infinite(p) {
        return num(0.0);
    }
    let positive = !sign_is_set(p) && !is_zero(p);
    if positive && (!right || is_zero(x) || !real_less(real_div(p, x), x)) {
        let root = real_sqrt(p);
        return real_div(real_atan2(root, x), root);
    }
    if !right || is_zero(x) || is_infinite(p) {
        return choose(is_zero(p), make_infinity(num(1.0)), make_nan(p));
    }
    // the function of (4ᵏ p, 2ᵏ x) is 2⁻ᵏ times that of (p, x): with 1 ≤ x < 2 no square overflows
    let k = -exponent_of(x);
    let y = scale(x, k);
    let q = scale(scale(p, k), k);
    let t = real_div(real_div(q, y), y);
    if is_above(t, -0.5) {
        return scale(real_div(real_atan_quotient(t, 0), y), k);
    }
    let rest = long_add_real(long_product(y, y), q).hi;
    if sign_is_set(rest) || is_zero(rest) {
        return choose(is_zero(rest), make_infinity(num(1.0)), make_nan(p));
    }
    let root = real_sqrt(real_neg(q));
    return scale(real_div(real_log(real_div(real_add(y, root), real_sqrt(rest))), root), k);
}

/// ∫₀¹ (1 - t)ⁿ / (1 + x t) dt for -0.6 ≤ x ≤ 3, by the fraction of F(1, 1; n + 2; -x):
/// 1/(n + 1 + (n + 1) x/(n + 2 + (n + 1) x/(n + 3 + 2 (n + 2) x/(n + 4 + 2 (n + 2) x/(n + 5 + …))))).
fn falling_fraction(n: i32, x: real) -> real {
    let levels = fraction_levels(real_to_f32(x));
    var value = num(f32(n + 1 + levels));
    for (var k = levels - 1; k >= 0; k--) {
        let m = k / 2 + 1;
        value = add32(real_div(mul32(x, f32(m * (n + m))), value), f32(n + 1 + k));
    }
    return real_div(num(1.0), value);
}

/// ∫₀¹ sⁿ / (1 + x s)^(n+1) ds, n ≤ 7: for n = 0 log(1 + x)/x. The derivative is -(n + 1) times the next one.
/// It is (1 + x)^-n ∫₀¹ (1 - t)ⁿ / (1 + x t) dt (DLMF 15.8.1), and x times that integral is 1 + x times the one of n - 1, less
/// 1/n.
fn real_log1prel(x: real, n: i32) -> real {
    if is_nan(x) || real_less(x, num(-1.0)) {
        return make_nan(x);
    }
    if real_equal(x, num(-1.0)) {
        return make_infinity(num(1.0));
    }
    if is_infinite(x) {
        return num(0.0);
    }
    let base = add32(x, 1.0);
    var value = num(1.0);
    if n > 0 && is_above(x, -0.6) && is_below(x, 3.0) {
        value = falling_fraction(n, x);
    } else if is_above(real_abs(x), 1e-17) {
        value = real_div(real_log1p(x), x);
        for (var k = 1; k <= n; k++) {
            value = real_div(real_sub(real_mul(base, value), real_div(num(1.0), num(f32(k)))), x);
        }
    }
    for (var k = 0; k < n; k++) {
        value = real_div(value, base);
    }
    return value;
}

/// The fraction on complex numbers, |z| < 1, re z > -0.6.
fn complex_fraction(n: i32, z: Complex) -> Complex {
    var value = complex_of_real(num(f32(n + 37)));
    for (var k = 35; k >= 0; k--) {
        let m = k / 2 + 1;
        let rest = complex_div(complex_mul_real(z, num(f32(m * (n + m)))), value);
        value = complex_add_real(rest, num(f32(n + 1 + k)));
    }
    return complex_inverse(value);
}

/// The same on complex numbers, with the cut of the logarithm.
fn complex_log1prel(z: Complex, n: i32) -> Complex {
    if is_zero(z.im) && !real_less(z.re, num(-1.0)) {
        return Complex(real_log1prel(z.re, n), real_neg(z.im));
    }
    if n == 0 && is_below(real_abs(z.re), 1e-10) && is_below(real_abs(z.im), 1e-10) {
        let slope = add32(real_mul(z.re, lit(0.6666667, -1.9868216e-8, 5.9211896e-16)), -0.5);
        return Complex(add32(real_neg(scale(z.re, -1)), 1.0), real_mul(z.im, slope));
    }
    let base = complex_add_real(z, num(1.0));
    var value = z;
    if n > 0 && is_above(z.re, -0.6) && is_below(complex_abs(z), 1.0) {
        value = complex_fraction(n, z);
    } else {
        value = complex_div(complex_log1p(z), z);
        for (var k = 1; k <= n; k++) {
            let step = complex_add_real(complex_mul(base, value), real_neg(real_div(num(1.0), num(f32(k)))));
            value = complex_div(step, z);
        }
    }
    for (var k = 0; k < n; k++) {
        value = complex_div(value, base);
    }
    return value;
}
