// Integrals of rational functions over [0, 1]: arctangent and logarithm divided by their argument, and what their
// derivatives need. Continued fraction: Gauss' for F(1, b/2; b/2 + 1; -z) (Cuyt, Petersen, Verdonk, Waadeland, Jones,
// "Handbook of Continued Fractions for Special Functions", 2008, section 15.3).

/// ∫₀¹ s^(b-1) / (1 + z s²) ds = 1/(b + b² z/(b + 2 + 2² z/(b + 4 + (b + 2)² z/(b + 6 + 4² z/(b + 8 + …))))),
/// -0.9 ≤ z ≤ 3. Each level gains a factor of √(1 + 1/|z|) + √(1/|z|) or so.
fn moment_fraction(b: f32, z: f32) -> f32 {
    let x = abs(1.0 + 2.0 / select(z, 1e-4, magnitude(z) < 1e-4));
    let levels = clamp(i32(18.0 / log(x + sqrt(max(x * x - 1.0, 0.0)))) + 3, 4, 32);
    var value = b + 2.0 * f32(levels);
    for (var k = levels - 1; k >= 0; k--) {
        let root = select(f32(k) + 1.0, b + f32(k), (k & 1) == 0);
        value = b + 2.0 * f32(k) + root * root * z / value;
    }
    return 1.0 / value;
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
    if magnitude(z) < 0.5 || n > 0 && z > -0.9 && z < 3.0 {
        return moment_fraction(2.0 * f32(n) + 1.0, z);
    }
    let root = sqrt(magnitude(z));
    var value = 0.0;
    if z > 0.0 {
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

/// ∫₀¹ sⁿ / (1 + x s)^(n+1) ds, n ≤ 5: for n = 0 log(1 + x)/x. The derivative is -(n + 1) times the next one.
/// It is (1 + x)^(-n-1) ∫₀¹ tⁿ / (1 + y t) dt with y = -x/(1 + x).
fn real_log1prel(x: f32, n: i32) -> f32 {
    if magnitude(x) < 1e-9 {
        return 1.0 / (f32(n) + 1.0);
    }
    if is_nan(x) || x < -1.0 {
        return make_nan(x);
    }
    if x == -1.0 {
        return make_infinity(1.0);
    }
    if is_infinite(x) {
        return 0.0;
    }
    if n == 0 {
        return real_log1p(x) / x;
    }
    let base = 1.0 + x;
    let inverse = 1.0 / base;
    let y = -x * inverse;
    var moment = 0.0;
    if y > -0.9 && y < 3.0 {
        moment = 2.0 * moment_fraction(2.0 * f32(n) + 2.0, y);
    } else {
        moment = real_log1p(x) / x * base;
        for (var k = 1; k <= n; k++) {
            moment = (1.0 / f32(k) - moment) / y;
        }
    }
    return moment * inverse * small_power(inverse, n);
}

/// ∫₀¹ tⁿ / (1 + y t) dt by the continued fraction, |y| ≤ 0.8.
fn complex_moment(n: i32, y: vec2f) -> vec2f {
    let b = 2.0 * f32(n) + 2.0;
    let levels = 30;
    var value = vec2f(b + 2.0 * f32(levels), 0.0);
    for (var k = levels - 1; k >= 0; k--) {
        let root = select(f32(k) + 1.0, b + f32(k), (k & 1) == 0);
        value = vec2f(b + 2.0 * f32(k), 0.0) + root * root * complex_div(y, value);
    }
    return 2.0 * complex_inverse(value);
}

/// The same on complex numbers, with the cut of the logarithm.
fn complex_log1prel(z: vec2f, n: i32) -> vec2f {
    if magnitude(z.y) == 0.0 && z.x >= -1.0 {
        return vec2f(real_log1prel(z.x, n), -z.y);
    }
    if n == 0 {
        if max(magnitude(z.x), magnitude(z.y)) < 1e-5 {
            return vec2f(1.0 - 0.5 * z.x, z.y * (0.6666667 * z.x - 0.5));
        }
        return complex_div(complex_log1p(z), z);
    }
    let base = vec2f(1.0 + z.x, z.y);
    let inverse = complex_inverse(base);
    let y = -complex_mul(z, inverse);
    var moment = vec2f(0.0);
    if complex_abs(y) < 0.8 {
        moment = complex_moment(n, y);
    } else {
        moment = complex_mul(complex_div(complex_log1p(z), z), base);
        for (var k = 1; k <= n; k++) {
            moment = complex_div(vec2f(1.0 / f32(k), 0.0) - moment, y);
        }
    }
    for (var k = 0; k <= n; k++) {
        moment = complex_mul(moment, inverse);
    }
    return moment;
}
