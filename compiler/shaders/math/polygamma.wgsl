// Derivatives of digamma from the second to the fifth, by Hurwitz' zeta function: ψ⁽ⁿ⁾(z) = (-1)ⁿ⁺¹ n! ζ(n + 1, z) (DLMF
// 25.11.12), its asymptotic series from |z| ≥ 8 on (25.11.43), the recurrence (25.11.3), reflection (5.15.6).

/// (-1)ⁿ⁺¹ n!
fn polygamma_scale(n: i32) -> f32 {
    var product = select(1.0, -1.0, (n & 1) == 0);
    for (var k = 2; k <= n; k++) {
        product *= f32(k);
    }
    return product;
}

/// rⁿ for 0 ≤ n ≤ 6.
fn small_power(r: f32, n: i32) -> f32 {
    var product = 1.0;
    for (var k = 0; k < n; k++) {
        product *= r;
    }
    return product;
}

/// Factors of an asymptotic series.
struct ZetaFactors {
    /// Of 1, w and w².
    low: vec3f,
    /// Of w³, w⁴ and w⁵.
    high: vec3f,
}

/// B(2k)/(2k)! s (s + 1) … (s + 2k - 2) with s = n + 1, k = 1 … 6.
fn zeta_factors(n: i32) -> ZetaFactors {
    let s = f32(n) + 1.0;
    let second = s * (s + 1.0) * (s + 2.0);
    let third = second * (s + 3.0) * (s + 4.0);
    let fourth = third * (s + 5.0) * (s + 6.0);
    let fifth = fourth * (s + 7.0) * (s + 8.0);
    let sixth = fifth * (s + 9.0) * (s + 10.0);
    return ZetaFactors(
        vec3f(0.083333333, -0.0013888889, 3.3068783e-5) * vec3f(s, second, third),
        vec3f(-8.2671958e-7, 2.0876757e-8, -5.2841901e-10) * vec3f(fourth, fifth, sixth),
    );
}

/// ζ(n + 1, x + first) for x ≥ 0.
fn real_zeta(n: i32, x: f32, first: f32) -> f32 {
    var sum = 0.0;
    var steps = first;
    // ends: x is not negative; NaN is not less
    while x + steps < 8.0 {
        sum += small_power(1.0 / (x + steps), n + 1);
        steps += 1.0;
    }
    let r = 1.0 / (x + steps);
    let w = r * r;
    let c = zeta_factors(n);
    let series = c.low.x + w * (c.low.y + w * (c.low.z + w * (c.high.x + w * (c.high.y + w * c.high.z))));
    return sum + small_power(r, n) * (1.0 / f32(n) + r * (0.5 + r * series));
}

/// ψ⁽ⁿ⁾(x), 2 ≤ n ≤ 5: at the poles ∞ for odd n, NaN for even n but at ±0. Absolute accuracy left of 0 for even n.
fn real_polygamma(x: f32, n: i32) -> f32 {
    let odd = (n & 1) == 1;
    if is_nan(x) || is_infinite(x) && sign_is_set(x) {
        return make_nan(x);
    }
    if magnitude(x) < 1.1754944e-38 {
        return make_infinity(select(flip_sign(x, 0x80000000u), 1.0, odd));
    }
    if is_infinite(x) {
        return select(-0.0, 0.0, odd);
    }
    if is_gamma_pole(x) {
        if odd {
            return make_infinity(1.0);
        }
        return make_nan(x);
    }
    let scale = polygamma_scale(n);
    if x > 0.0 {
        return scale * real_zeta(n, x, 0.0);
    }
    let wave = sincos_pi(x);
    let ratio = 3.1415927 / wave.x;
    let cot = ratio * wave.y;
    let square = ratio * ratio;
    let cc = cot * cot;
    var reflected = square * (16.0 * square * square + 88.0 * square * cc + 16.0 * cc * cc);
    if n == 2 {
        reflected = 2.0 * cot * square;
    } else if n == 3 {
        reflected = square * (2.0 * square + 4.0 * cc);
    } else if n == 4 {
        reflected = cot * square * (16.0 * square + 8.0 * cc);
    }
    return select(-reflected, reflected, odd) - magnitude(scale) * real_zeta(n, -x, 1.0);
}

/// zⁿ for 1 ≤ n ≤ 6.
fn complex_small_power(z: vec2f, n: i32) -> vec2f {
    var product = z;
    for (var k = 1; k < n; k++) {
        product = complex_mul(product, z);
    }
    return product;
}

/// Whether the series may be used as it stands.
fn is_zeta_far(z: vec2f) -> bool {
    return magnitude(z.y) >= 8.0 || z.x >= 8.0;
}

/// ζ(n + 1, z + first).
fn complex_zeta(n: i32, z: vec2f, first: f32) -> vec2f {
    var sum = vec2f(0.0, 0.0);
    var steps = first;
    // ends: z is finite and not left of 0
    while !is_zeta_far(z + vec2f(steps, 0.0)) {
        sum += complex_small_power(complex_inverse(z + vec2f(steps, 0.0)), n + 1);
        steps += 1.0;
    }
    let r = complex_inverse(z + vec2f(steps, 0.0));
    let w = complex_square(r);
    let c = zeta_factors(n);
    var series = vec2f(c.high.y, 0.0) + w * c.high.z;
    series = vec2f(c.high.x, 0.0) + complex_mul(w, series);
    series = vec2f(c.low.z, 0.0) + complex_mul(w, series);
    series = vec2f(c.low.y, 0.0) + complex_mul(w, series);
    series = vec2f(c.low.x, 0.0) + complex_mul(w, series);
    let near = vec2f(1.0 / f32(n), 0.0) + complex_mul(r, vec2f(0.5, 0.0) + complex_mul(r, series));
    return sum + complex_mul(complex_small_power(r, n), near);
}

/// ψ⁽ⁿ⁾(z), 2 ≤ n ≤ 5. Error: 40 ulp of the largest term.
fn complex_polygamma(z: vec2f, n: i32) -> vec2f {
    let odd = (n & 1) == 1;
    if z.y == 0.0 {
        return vec2f(real_polygamma(z.x, n), select(z.y, -z.y, odd));
    }
    if !is_finite(z.x) || !is_finite(z.y) {
        return select(vec2f(0.0, 0.0), vec2f(make_nan(z.x), make_nan(z.y)), complex_has_nan(z));
    }
    let scale = polygamma_scale(n);
    if !is_reflected(z) {
        return scale * complex_zeta(n, z, 0.0);
    }
    let square = complex_square(3.1415927 * complex_inverse(complex_sin_pi(z)));
    let cot = complex_pi_cot_pi(z);
    let cc = complex_square(cot);
    var reflected = complex_mul(square, 16.0 * complex_square(square) + 88.0 * complex_mul(square, cc)
        + 16.0 * complex_square(cc));
    if n == 2 {
        reflected = 2.0 * complex_mul(cot, square);
    } else if n == 3 {
        reflected = complex_mul(square, 2.0 * square + 4.0 * cc);
    } else if n == 4 {
        reflected = complex_mul(complex_mul(cot, square), 16.0 * square + 8.0 * cc);
    }
    return select(-reflected, reflected, odd) - magnitude(scale) * complex_zeta(n, -z, 1.0);
}
