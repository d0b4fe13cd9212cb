// Integrals of rational functions over [0, 1]: arctangent and logarithm divided by their argument, and what their
// derivatives need. Continued fraction: Gauss' for F(1, b/2; b/2 + 1; -z) (Cuyt, Petersen, Verdonk, Waadeland, Jones,
// "Handbook of Continued Fractions for Special Functions", 2008, section 15.3).

/// How many levels are enough: two gain a factor of (u + √(u² - 1))² with u = |1 + 2/z|.
fn fraction_levels(z: f32) -> i32 {
    let u = abs(1.0 + 2.0 / select(z, 1e-4, magnitude(z) < 1e-4));
    return clamp(i32(18.0 / log(u + sqrt(max(u * u - 1.0, 0.0)))) + 3, 4, 32);
}

/// ∫₀¹ s^(b-1) / (1 + z s²) ds = 1/(b + b² z/(b + 2 + 2² z/(b + 4 + (b + 2)² z/(b + 6 + 4² z/(b + 8 + …))))),
/// -0.9 ≤ z ≤ 3.
fn moment_fraction(b: f32, z: f32) -> f32 {
    let levels = fraction_levels(z);
    var value = b + 2.0 * f32(levels);
    for (var k = levels - 1; k >= 0; k--) {
        let root = select(f32(k) + 1.0, b + f32(k), (k & 1) == 0);
        value = b + 2.0 * f32(k) + root * root * z / value;
    }
    return 1.0 / value;
}

/// The first of these integrals, b = 1, for |z| ≤ 1/2 as a polynomial in z/(2 + z); coefficients.py, atan_quotient.
fn first_atan_quotient(x: f32) -> f32 {
    let z = x / (2.0 + x);
    return 1.0 + z * (-0.66666675 + z * (0.13333191 + z * (-0.20950903 + z * (0.08268822 + z * (-0.1224063 + z * (
        0.054721456 + z * (-0.08051514 + z * 0.1149793)))))));
}

/// The second, b = 3, for -3/4 ≤ z ≤ 2 as a polynomial in z/(1.8 + z); coefficients.py, atan_quotient1.
fn second_atan_quotient(x: f32) -> f32 {
    let z = x / (1.8 + x);
    return 0.33333334 + z * (-0.36000004 + z * (0.10285736 + z * (-0.08228277 + z * (0.03888929 + z * (-0.032846894 + z * (
        0.017614495 + z * (-0.014670463 + z * (0.00755642 + z * (-0.011968321 + z * (0.0070181745 + z * (0.006768418 +
        z * (-8.082127e-05 + z * -0.014927694))))))))))));
}

/// ∫₀¹ s^2n / (1 + z s²) ds: for n = 0 atan(√z)/√z, continued through 0 to artanh(√-z)/√-z; ∞ at -1, NaN below.
fn real_atan_quotient(z: f32, n: i32) -> f32 {
    if is_nan(z) || z < -1.0 {
        return make_nan(z);
    }
    if z == -1.0 {
        return make_infinity(1.0);
    }
    if is_infinite(z) {
        return 0.0;
    }
    if n == 1 && z > -0.75 && z < 2.0 {
        return second_atan_quotient(z);
    }
    if n > 1 && z > -0.9 && z < 3.0 {
        return moment_fraction(2.0 * f32(n) + 1.0, z);
    }
    let root = sqrt(magnitude(z));
    var value = 0.0;
    if magnitude(z) < 0.5 {
        value = first_atan_quotient(z);
    } else if z > 0.0 {
        value = real_atan(root) / root;
    } else {
        // log((1 + r)/√(1 - r²))
        value = (real_log1p(root) - 0.5 * real_log1p(z)) / root;
    }
    for (var k = 0; k < n; k++) {
        value = (1.0 / (2.0 * f32(k) + 1.0) - value) / z;
    }
    return value;
}

/// a + b - s exactly, where s is near the sum; 0 where that is no number.
fn real_sum_rest(a: f32, b: f32, s: f32) -> f32 {
    let zero = hidden_zero_of(a, b);
    let sum = two_sum(opaque(a, zero), opaque(b, zero), zero);
    let rest = opaque(sum.x - s, zero) + sum.y;
    return select(0.0, rest, is_finite(rest));
}

/// a b - p exactly, where p is near the product and nothing underflows; 0 where that is no number.
fn real_product_rest(a: f32, b: f32, p: f32) -> f32 {
    let zero = hidden_zero_of(a, b);
    let product = opaque(a * b, zero);
    let rest = opaque(product - p, zero) + rest_of_product(a, b, product, zero);
    return select(0.0, rest, is_finite(rest));
}

/// a b + c - s exactly, where s is near that; 0 where that is no number.
fn real_mul_add_rest(a: f32, b: f32, c: f32, s: f32) -> f32 {
    let zero = hidden_zero_of(a, b);
    let product = opaque(a * b, zero);
    let sum = two_sum(product, opaque(c, zero), zero);
    let rest = opaque(sum.x - s, zero) + (sum.y + rest_of_product(a, b, product, zero));
    return select(0.0, rest, is_finite(rest));
}

/// -b/a, 0 where a is next to nothing or the quotient is no number of moderate size.
fn real_foot(a: f32, b: f32) -> f32 {
    let place = -b / a;
    return select(0.0, place, magnitude(a) > 1e-30 && magnitude(place) < 1e30);
}

/// ∫ du/(u² + p) from x to ∞: atan2(√p, x)/√p, continued through p = 0; ∞ where the pole is at the end, NaN beyond.
fn real_atan2_quotient(p: f32, x: f32) -> f32 {
    if is_nan(p) || is_nan(x) {
        return make_nan(p);
    }
    if x > 0.0 && is_infinite(x) || p > 0.0 && is_infinite(p) {
        return 0.0;
    }
    if p > 0.0 && !(x > 0.0 && p / x < x) {
        let root = sqrt(p);
        return rounded(real_atan2(root, x)) / root;
    }
    // the function of (4ᵏ p, 2ᵏ x) is 2⁻ᵏ times that of (p, x): with 1 ≤ x < 2 no square overflows
    let size = magnitude(x);
    if !(x > 0.0) || size < 1.1754944e-38 {
        return select(make_nan(p), make_infinity(1.0), p == 0.0);
    }
    let k = 127 - i32(bitcast<u32>(size) >> 23u);
    let y = times_power_of_two(x, k);
    let q = times_wide_power_of_two(p, 2 * k);
    let t = rounded(q / y) / y;
    if t > -0.5 {
        return times_power_of_two(real_atan_quotient(t, 0) / y, k);
    }
    let zero = hidden_zero(y);
    let square = two_product(y, y, zero);
    let rest = opaque(square.x + q, zero) + square.y;
    if rest <= 0.0 || !is_finite(q) {
        return select(make_nan(p), make_infinity(1.0), rest == 0.0);
    }
    let root = sqrt(-q);
    return times_power_of_two(real_log((y + root) / sqrt(rest)) / root, k);
}

/// ∫₀¹ (1 - t)ⁿ / (1 + x t) dt for -0.6 ≤ x ≤ 3, by the fraction of F(1, 1; n + 2; -x):
/// 1/(n + 1 + (n + 1) x/(n + 2 + (n + 1) x/(n + 3 + 2 (n + 2) x/(n + 4 + 2 (n + 2) x/(n + 5 + …))))).
fn falling_fraction(n: f32, x: f32) -> f32 {
    let levels = fraction_levels(x);
    var value = n + 1.0 + f32(levels);
    for (var k = levels - 1; k >= 0; k--) {
        let m = f32(k / 2 + 1);
        value = n + 1.0 + f32(k) + m * (n + m) * x / value;
    }
    return 1.0 / value;
}

/// ∫₀¹ sⁿ / (1 + x s)^(n+1) ds, n ≤ 7: for n = 0 log(1 + x)/x. The derivative is -(n + 1) times the next one.
/// It is (1 + x)^-n ∫₀¹ (1 - t)ⁿ / (1 + x t) dt (DLMF 15.8.1), and x times that integral is 1 + x times the one of n - 1, less
/// 1/n.
fn real_log1prel(x: f32, n: i32) -> f32 {
    if is_nan(x) || x < -1.0 {
        return make_nan(x);
    }
    if x == -1.0 {
        return make_infinity(1.0);
    }
    if is_infinite(x) {
        return 0.0;
    }
    let base = 1.0 + x;
    var value = 1.0;
    if n > 0 && x > -0.6 && x < 3.0 {
        value = falling_fraction(f32(n), x);
    } else if magnitude(x) > 1e-9 {
        value = real_log1p(x) / x;
        for (var k = 1; k <= n; k++) {
            value = (base * value - 1.0 / f32(k)) / x;
        }
    }
    for (var k = 0; k < n; k++) {
        value /= base;
    }
    return value;
}

/// The fraction on complex numbers, |z| < 1, re z > -0.6.
fn complex_fraction(n: f32, z: vec2f) -> vec2f {
    var value = vec2f(n + 19.0, 0.0);
    for (var k = 17; k >= 0; k--) {
        let m = f32(k / 2 + 1);
        value = vec2f(n + 1.0 + f32(k), 0.0) + m * (n + m) * complex_div(z, value);
    }
    return complex_inverse(value);
}

/// The same on complex numbers, with the cut of the logarithm.
fn complex_log1prel(z: vec2f, n: i32) -> vec2f {
    if magnitude(z.y) == 0.0 && z.x >= -1.0 {
        return vec2f(real_log1prel(z.x, n), -z.y);
    }
    if n == 0 && max(magnitude(z.x), magnitude(z.y)) < 1e-5 {
        return vec2f(1.0 - 0.5 * z.x, z.y * (0.6666667 * z.x - 0.5));
    }
    let base = vec2f(1.0 + z.x, z.y);
    var value = vec2f(0.0);
    if n > 0 && z.x > -0.6 && dot(z, z) < 1.0 {
        value = complex_fraction(f32(n), z);
    } else {
        value = complex_div(complex_log1p(z), z);
        for (var k = 1; k <= n; k++) {
            value = complex_div(complex_mul(base, value) - vec2f(1.0 / f32(k), 0.0), z);
        }
    }
    for (var k = 0; k < n; k++) {
        value = complex_div(value, base);
    }
    return value;
}
