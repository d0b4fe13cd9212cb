// Derivatives of digamma from the second to the fifth, by Hurwitz' zeta function: ψ⁽ⁿ⁾(z) = (-1)ⁿ⁺¹ n! ζ(n + 1, z) (DLMF
// 25.11.12), its asymptotic series from |z| ≥ 15 on (25.11.43), the recurrence (25.11.3), reflection (5.15.6).

/// n!
fn polygamma_scale(n: i32) -> f32 {
    var product = 1.0;
    for (var k = 2; k <= n; k++) {
        product *= f32(k);
    }
    return product;
}

/// rⁿ for 0 ≤ n ≤ 6.
fn small_power(r: real, n: i32) -> real {
    var product = num(1.0);
    for (var k = 0; k < n; k++) {
        product = real_mul(product, r);
    }
    return product;
}

/// B(2k + 2) / (2k + 2)!, k = 0 … 9 (DLMF 24.2).
fn zeta_coefficient(k: i32) -> real {
    switch k {
        case 0: { return lit(0.083333336, -2.483527e-09, 7.401487e-17); }
        case 1: { return lit(-0.0013888889, 3.3631094e-11, -1.4648776e-18); }
        case 2: { return lit(3.3068784e-05, -4.5426613e-13, -9.006335e-21); }
        case 3: { return lit(-8.267196e-07, 2.2725337e-14, 5.639716e-22); }
        case 4: { return lit(2.0876756e-08, 6.6419474e-16, -7.82479e-24); }
        case 5: { return lit(-5.2841903e-10, 1.688543e-17, 1.0691468e-25); }
        case 6: { return lit(1.3382536e-11, 1.3219727e-19, 3.2028906e-27); }
        case 7: { return lit(-3.3896803e-13, 4.447471e-22, -1.4986928e-29); }
        case 8: { return lit(8.586062e-15, -6.894736e-23, 2.5501912e-30); }
        case 9: { return lit(-2.1748687e-16, -3.6361624e-24, -1.9690286e-32); }
        default: { return num(0.0); }
    }
}

/// s (s + 1) … (s + 2k), the factor of the coefficient k, exact as f32 or two.
fn zeta_rising(s: i32, k: i32) -> real {
    var product = num(f32(s));
    for (var j = 1; j <= 2 * k; j++) {
        product = mul32(product, f32(s + j));
    }
    return product;
}

/// Whether the series may be used as it stands.
fn is_zeta_far(z: Complex) -> bool {
    return !is_below(real_abs(z.im), 15.0) || !is_below(z.re, 15.0);
}

/// ζ(n + 1, x + first) for x ≥ 0.
fn real_zeta(n: i32, x: real, first: i32) -> real {
    let steps = max(select(i32(ceil(15.0 - real_to_f32(x))), 0, is_above(x, 15.0)), first);
    let r = real_div(num(1.0), add32(x, f32(steps)));
    let w = real_square(r);
    var series = num(0.0);
    for (var k = 9; k >= 0; k--) {
        series = real_add(real_mul(zeta_coefficient(k), zeta_rising(n + 1, k)), real_mul(w, series));
    }
    let near = real_add(real_div(num(1.0), num(f32(n))), real_mul(r, real_add(num(0.5), real_mul(r, series))));
    var sum = real_mul(small_power(r, n), near);
    for (var k = steps - 1; k >= first; k--) {
        sum = real_add(sum, small_power(real_div(num(1.0), add32(x, f32(k))), n + 1));
    }
    return sum;
}

/// ψ⁽ⁿ⁾ at its poles and where x is not finite.
fn polygamma_at_end(x: real, odd: bool) -> real {
    if is_nan(x) || is_infinite(x) && sign_is_set(x) {
        return make_nan(x);
    }
    if is_infinite(x) {
        return flip_if(num(0.0), !odd);
    }
    let even = choose(is_zero(x), make_infinity(real_neg(x)), make_nan(x));
    return choose(odd, make_infinity(num(1.0)), even);
}

/// ψ⁽ⁿ⁾(x), 2 ≤ n ≤ 5: at the poles ∞ for odd n, NaN for even n but at ±0. Absolute accuracy left of 0 for even n.
fn real_polygamma(x: real, n: i32) -> real {
    let odd = (n & 1) == 1;
    if is_zero(x) || !is_finite(x) || is_gamma_pole(x) {
        return polygamma_at_end(x, odd);
    }
    let size = polygamma_scale(n);
    if !sign_is_set(x) {
        return flip_if(mul32(real_zeta(n, x, 0), size), !odd);
    }
    let wave = sincos_pi(x);
    let ratio = real_div(real_pi(), wave.first);
    let cot = real_mul(ratio, wave.second);
    let square = real_square(ratio);
    let cc = real_square(cot);
    var reflected = real_mul(square, real_add(real_add(mul32(real_square(square), 16.0), mul32(real_mul(square, cc), 88.0)),
        mul32(real_square(cc), 16.0)));
    if n == 2 {
        reflected = twice(real_mul(cot, square));
    } else if n == 3 {
        reflected = real_mul(square, real_add(twice(square), mul32(cc, 4.0)));
    } else if n == 4 {
        reflected = real_mul(real_mul(cot, square), real_add(mul32(square, 16.0), mul32(cc, 8.0)));
    }
    let regular = mul32(real_zeta(n, real_neg(x), 1), size);
    return real_sub(flip_if(reflected, !odd), regular);
}

/// zⁿ for 1 ≤ n ≤ 6.
fn complex_small_power(z: Complex, n: i32) -> Complex {
    var product = z;
    for (var k = 1; k < n; k++) {
        product = plain_product(product, z);
    }
    return product;
}

/// ζ(n + 1, z + first).
fn complex_zeta(n: i32, z: Complex, first: i32) -> Complex {
    let steps = max(select(max(i32(ceil(15.0 - real_to_f32(z.re))), 0), 0, is_zeta_far(z)), first);
    let r = complex_inverse(complex_step(z, steps));
    let w = complex_square(r);
    var series = complex_of_real(num(0.0));
    for (var k = 9; k >= 0; k--) {
        let factor = real_mul(zeta_coefficient(k), zeta_rising(n + 1, k));
        series = complex_add_real(plain_product(w, series), factor);
    }
    let half = complex_add_real(plain_product(r, series), num(0.5));
    let near = complex_add_real(plain_product(r, half), real_div(num(1.0), num(f32(n))));
    var sum = plain_product(complex_small_power(r, n), near);
    for (var k = steps - 1; k >= first; k--) {
        sum = complex_add(sum, complex_small_power(complex_inverse(complex_step(z, k)), n + 1));
    }
    return sum;
}

/// ψ⁽ⁿ⁾(z), 2 ≤ n ≤ 5. Error: 100 u of the largest term.
fn complex_polygamma(z: Complex, n: i32) -> Complex {
    let odd = (n & 1) == 1;
    let flat = is_zero(z.im);
    let im_of_flat = flip_if(z.im, odd);
    if flat && (is_zero(z.re) || !is_finite(z.re) || is_gamma_pole(z.re)) {
        return Complex(polygamma_at_end(z.re, odd), im_of_flat);
    }
    if !complex_is_finite(z) {
        if complex_has_nan(z) {
            return complex_nan(z.re);
        }
        return complex_of_real(num(0.0));
    }
    let left = sign_is_set(z.re) && !is_zeta_far(z);
    let zeta = complex_zeta(n, complex_choose(left, complex_neg(z), z), select(0, 1, left));
    let regular = complex_mul_real(zeta, num(polygamma_scale(n)));
    if !left {
        let far = complex_choose(odd, regular, complex_neg(regular));
        return Complex(far.re, choose(flat, im_of_flat, far.im));
    }
    let waves = waves_of_pi(z);
    let square = complex_square(complex_mul_real(complex_inverse(complex_sin_pi(waves)), real_pi()));
    let cot = complex_pi_cot_pi(z, waves);
    let cc = complex_square(cot);
    var reflected = plain_product(square, cc);
    if n == 2 {
        reflected = complex_scale(plain_product(cot, square), 1);
    } else if n == 3 {
        reflected = plain_product(square, complex_add(complex_scale(square, 1), complex_scale(cc, 2)));
    } else if n == 4 {
        let factor = complex_add(complex_scale(square, 4), complex_scale(cc, 3));
        reflected = plain_product(plain_product(cot, square), factor);
    } else {
        let outer = complex_scale(complex_add(complex_square(square), complex_square(cc)), 4);
        reflected = plain_product(square, complex_add(outer, complex_mul_real(reflected, num(88.0))));
    }
    let r = complex_sub(complex_choose(odd, reflected, complex_neg(reflected)), regular);
    return Complex(r.re, choose(flat, im_of_flat, r.im));
}
