// The error function and its kin. e^(x²) iⁿerfc x (DLMF 7.18) are one family, in which each is a derivative of the one
// before. The mass of a Gaussian in an interval is a difference of two, or a quadrature where that would cancel.

/// e^(-x²), or e^(x²); the rounding of the square does not count. |x| ≤ 30.
fn exp_of_square(x: real, falls: bool) -> real {
    let square = long_product(x, x);
    let e = real_exp(flip_if(square.hi, falls));
    return choose(is_infinite(e), e, real_add(e, real_mul(e, flip_if(square.lo, falls))));
}

/// e^(-x²)
fn real_gauss(x: real) -> real {
    if is_nan(x) {
        return x;
    }
    return exp_of_square(clamped(real_abs(x), 30.0), true);
}

/// e^(x y); the rounding of the product does not count.
fn real_exp_of_product(x: real, y: real) -> real {
    let product = long_product(x, y);
    let e = real_exp(product.hi);
    return choose(is_below(real_abs(product.hi), 88.0), real_add(e, real_mul(e, product.lo)), e);
}

/// e^(-(x + y)²); the rounding of the sum does not count.
fn real_gauss_of_sum(x: real, y: real) -> real {
    let sum = long_sum(x, y);
    let e = real_gauss(sum.hi);
    let correction = twice(real_mul(sum.hi, sum.lo));
    return choose(is_below(real_abs(sum.hi), 29.0), real_sub(e, real_mul(e, correction)), e);
}

/// 2/√π
fn two_by_root_pi() -> real {
    return lit(1.1283792, -5.8635383e-08, -6.5079834e-16);
}

/// √π/2
fn half_root_pi() -> real {
    return lit(0.88622695, -2.66232e-08, -5.9344446e-16);
}

/// erf x for |x| ≤ 1/2 by its power series (DLMF 7.6.1).
fn erf_near(x: real) -> real {
    let z = real_neg(real_square(x));
    var sum = num(1.0);
    for (var k = 14; k > 0; k--) {
        sum = add32(real_mul(real_div(mul32(z, f32(2 * k - 1)), num(f32(k * (2 * k + 1)))), sum), 1.0);
    }
    return real_mul(real_mul(x, two_by_root_pi()), sum);
}

/// erfc x for x ≥ 1/2.
fn erfc_right(x: real) -> real {
    let a = clamped(x, 30.0);
    return real_mul(exp_of_square(a, true), erfcx_right(a));
}

/// erf x.
fn real_erf(x: real) -> real {
    let a = real_abs(x);
    if is_nan(x) {
        return x;
    }
    if is_below(a, 0.5) {
        return erf_near(x);
    }
    return with_sign(add32(real_neg(erfc_right(a)), 1.0), x);
}

/// erfc x = 1 - erf x, to the last digits also where it is small.
fn real_erfc(x: real) -> real {
    if is_nan(x) {
        return x;
    }
    let a = real_abs(x);
    if is_below(a, 0.5) {
        return add32(real_neg(erf_near(x)), 1.0);
    }
    let right = erfc_right(a);
    return choose(sign_is_set(x), add32(real_neg(right), 2.0), right);
}

/// Chebyshev coefficients of (1 + 2 x) e^(x²) erfc x in (x - 3)/(x + 3), the first halved; special.py, erfcx.
fn erfcx_coefficient(k: i32) -> real {
    switch k {
        case 0: { return lit(1.1775626, -2.0217197e-08, -4.723774e-16); }
        case 1: { return lit(0.0053539043, 2.1037536e-10, -1.3681503e-18); }
        case 2: { return lit(-0.0937755, -8.545882e-11, 3.1733135e-19); }
        case 3: { return lit(0.054366525, 2.94849e-10, -8.8486165e-18); }
        case 4: { return lit(-0.018976597, 4.0755224e-10, 3.9680474e-18); }
        case 5: { return lit(0.004453426, -1.6551083e-10, 5.204924e-18); }
        case 6: { return lit(-0.0006335532, 2.3292455e-11, -4.42495e-19); }
        case 7: { return lit(1.766172e-05, -1.6147574e-14, 3.2594998e-22); }
        case 8: { return lit(1.2841533e-05, -2.7057653e-13, -8.890781e-21); }
        case 9: { return lit(-2.0072287e-06, 9.2934185e-14, 2.811839e-22); }
        case 10: { return lit(-1.8075228e-07, 1.656987e-15, -2.4377872e-23); }
        case 11: { return lit(7.5498285e-08, -1.5188697e-15, 2.5673246e-23); }
        case 12: { return lit(1.8856685e-09, 1.3612179e-17, -1.7295883e-25); }
        case 13: { return lit(-2.699519e-09, 2.941765e-18, 8.5890097e-26); }
        case 14: { return lit(-1.4600791e-11, -1.3708855e-19, 1.3844686e-27); }
        case 15: { return lit(1.03616074e-10, 4.0551462e-19, 3.4207578e-27); }
        case 16: { return lit(1.4757159e-12, 5.1296724e-20, 1.20833355e-27); }
        case 17: { return lit(-4.27734e-12, 1.3638427e-19, 4.215559e-27); }
        case 18: { return lit(-2.0792249e-13, -7.0215174e-22, -1.6977605e-29); }
        case 19: { return lit(1.8134502e-13, -4.1433986e-21, -3.109192e-29); }
        case 20: { return lit(1.9734255e-14, 8.2515376e-22, 5.1032908e-30); }
        case 21: { return lit(-7.2879435e-15, -2.6161616e-22, 8.109337e-30); }
        case 22: { return lit(-1.5169878e-15, -3.5489233e-23, -1.3659365e-30); }
        case 23: { return lit(2.351411e-16, 1.1869692e-23, 1.0424417e-31); }
        case 24: { return lit(1.00061114e-16, 3.128323e-24, -7.1604756e-32); }
        case 25: { return lit(-2.0572528e-18, -3.9614046e-26, -2.2671638e-35); }
        case 26: { return lit(-5.6086084e-18, 1.7545616e-25, -3.0413354e-33); }
        default: { return num(0.0); }
    }
}

/// e^(x²) erfc x for x ≥ 0 by Clenshaw's recurrence (the form of Shepherd and Laframboise, "Chebyshev approximation of
/// (1 + 2x) exp(x²) erfc x", Math. Comp. 36, 1981).
fn erfcx_right(x: real) -> real {
    if is_above(x, 1e10) {
        return real_div(lit(0.5641896, -2.9317691e-08, -3.2539917e-16), x);
    }
    let y = real_div(add32(x, -3.0), add32(x, 3.0));
    let double = twice(y);
    var sum = num(0.0);
    var last = num(0.0);
    for (var k = 26; k > 0; k--) {
        let next = real_add(real_sub(real_mul(double, sum), last), erfcx_coefficient(k));
        last = sum;
        sum = next;
    }
    let p = real_add(real_sub(real_mul(y, sum), last), erfcx_coefficient(0));
    return real_div(p, add32(twice(x), 1.0));
}

/// e^(x²) iⁿerfc x, n ≤ 7: for n = 0 the scaled complementary error function. From n = 1, x = 1 on by the continued fraction of
/// the recurrence DLMF 7.18.7, downwards, else by the recurrence upwards.
fn real_erfcx(x: real, n: i32) -> real {
    if is_nan(x) {
        return x;
    }
    if n > 0 && !is_below(x, 1.0) {
        return repeated_right(x, n);
    }
    let a = real_abs(x);
    var value = erfcx_right(a);
    if sign_is_set(x) {
        if is_above(a, 30.0) {
            return make_infinity(num(1.0));
        }
        value = real_sub(twice(exp_of_square(a, false)), value);
    }
    var last = two_by_root_pi();
    for (var k = 0; k < n; k++) {
        let next = real_div(real_sub(last, twice(real_mul(x, value))), num(f32(2 * k + 2)));
        last = value;
        value = next;
    }
    return value;
}

/// The same for x ≥ 1: f(k)/f(k-1) = 1/(2 x + 2 (k + 1) f(k+1)/f(k)), from an index where it hardly matters.
fn repeated_right(x: real, n: i32) -> real {
    if is_above(x, 1e9) {
        // the first term of the asymptotic series (DLMF 7.18.14)
        return real_mul(two_by_root_pi(), small_power(real_div(num(0.5), x), n + 1));
    }
    let y32 = real_to_f32(x);
    let end = n + 20 + i32(180.0 / (y32 * y32));
    var ratio = num(1.0 / (y32 + sqrt(y32 * y32 + 2.0 * f32(end))));
    var value = two_by_root_pi();
    for (var k = end - 1; k >= 0; k--) {
        ratio = real_div(num(0.5), real_add(x, mul32(ratio, f32(k + 1))));
        if k <= n {
            value = real_mul(value, ratio);
        }
    }
    return value;
}

/// Nodes and weights on the right of Gauss and Legendre's rule of 12 points (DLMF 3.5.v); special.py, gauss_node.
fn gauss_node(k: i32) -> RealPair {
    switch k {
        case 0: { return RealPair(lit(0.98156065, -1.3240921e-08, 1.1815649e-16), lit(0.047175337, -2.4264046e-10, -7.5018614e-18)); }
        case 1: { return RealPair(lit(0.9041172, 2.9769827e-08, 3.9199004e-16), lit(0.10693932, 2.7488394e-09, 1.8194954e-17)); }
        case 2: { return RealPair(lit(0.76990265, 2.7652709e-08, 6.606364e-16), lit(0.16007833, -3.2847711e-09, -2.250098e-17)); }
        case 3: { return RealPair(lit(0.58731794, 1.0713619e-08, 7.539047e-17), lit(0.20316742, 3.117147e-09, 5.249505e-17)); }
        case 4: { return RealPair(lit(0.3678315, 6.137045e-10, 9.618137e-18), lit(0.23349254, -1.7945844e-09, 3.0807875e-17)); }
        default: { return RealPair(lit(0.12523341, -3.2774714e-09, -1.08832133e-16), lit(0.24914704, 3.1813e-09, -7.149504e-17)); }
    }
}

/// ∫ e^(-u²) du over [c - w, c + w], over the greatest value of e^(-u²) there, 0 ≤ w ≤ c. Where the ends differ enough the
/// difference of erfcx, else Gauss and Legendre's rule: u² - (c - w)² = (u - c + w)(u + c - w).
fn tail_mass(c: real, w: real) -> real {
    let steepness = scale(real_mul(c, w), 2);
    if is_above(steepness, 2.0) {
        let far = real_mul(real_exp(real_neg(steepness)), erfcx_right(real_add(c, w)));
        return real_mul(half_root_pi(), real_sub(erfcx_right(real_sub(c, w)), far));
    }
    var sum = num(0.0);
    for (var k = 0; k < 12; k++) {
        let node = gauss_node(k >> 1u);
        let s = flip_if(node.first, (k & 1) == 0);
        let first = real_mul(w, add32(s, 1.0));
        let second = real_add(twice(c), real_mul(w, add32(s, -1.0)));
        sum = real_add(sum, real_mul(node.second, real_exp(real_neg(real_mul(first, second)))));
    }
    return real_mul(w, sum);
}

/// ∫ tᵏ e^(-t² - 2 a t) dt over [0, 2 |w|] with a = |c| - |w|, for |w| ≤ |c| and k ≤ 3. Where the exponent changes enough the
/// integral over all t > 0, which is √π/2 k! e^(a²) iᵏerfc a (DLMF 7.18.2), less that from 2 |w| on.
fn real_gauss_mass_moment(centre: real, width: real, k: i32) -> real {
    let c = real_abs(centre);
    let w = real_abs(width);
    if is_nan(c) || is_nan(w) || real_less(c, w) {
        return make_nan(c);
    }
    let steepness = scale(real_mul(c, w), 2);
    let a = real_sub(c, w);
    if !is_above(steepness, 2.0 + f32(k)) {
        var sum = num(0.0);
        for (var i = 0; i < 12; i++) {
            let node = gauss_node(i >> 1u);
            let t = real_mul(w, add32(flip_if(node.first, (i & 1) == 0), 1.0));
            let e = real_exp(real_neg(real_mul(t, real_add(twice(a), t))));
            sum = real_add(sum, real_mul(real_mul(node.second, small_power(t, k)), e));
        }
        return real_mul(w, sum);
    }
    // the member at the near end, less a binomial sum of those at the far one
    let fall = real_exp(real_neg(steepness));
    var factor = num(1.0);
    var sum = num(0.0);
    for (var j = k + 1; j >= 0; j--) {
        let is_near = j > k;
        let member = real_erfcx(choose(is_near, a, real_add(c, w)), min(j, k));
        if is_near {
            sum = member;
        } else {
            sum = real_sub(sum, real_mul(real_mul(factor, fall), member));
            factor = real_div(real_mul(factor, twice(w)), num(f32(k - j + 1)));
        }
    }
    return real_mul(half_root_pi(), mul32(sum, select(f32(k * (k - 1)), 1.0, k < 2)));
}

/// x² + p, rounded once.
fn real_square_plus(x: real, p: real) -> real {
    if !is_below(real_abs(x), 1e18) || !is_below(real_abs(p), 1e37) {
        return real_add(real_square(x), p);
    }
    return long_add_real(long_product(x, x), p).hi;
}

/// The integral of e^(-u²) over the interval with centre c and half-width w. Odd in w.
fn real_gauss_mass(c: real, w: real) -> real {
    let a = real_abs(c);
    let b = real_abs(w);
    if is_nan(c) || is_nan(w) || real_less(a, b) {
        return real_gauss_mass_scaled(c, w);
    }
    return with_sign(real_mul(tail_mass(a, b), real_gauss_of_sum(a, real_neg(b))), w);
}

/// The same, divided by the greatest value of e^(-u²) in the interval.
fn real_gauss_mass_scaled(c: real, w: real) -> real {
    let a = real_abs(c);
    let b = real_abs(w);
    if is_nan(c) || is_nan(w) || is_infinite(c) && is_infinite(w) {
        return make_nan(c);
    }
    if !real_less(a, b) {
        return with_sign(tail_mass(a, b), w);
    }
    return with_sign(real_mul(half_root_pi(), real_add(real_erf(real_add(b, a)), real_erf(real_sub(b, a)))), w);
}

/// log(1 + e^x) without overflow: x + log1p(e^-x) right of 0.
fn real_log1pexp(x: real) -> real {
    let rest = real_log1p(real_exp(real_neg(real_abs(x))));
    return choose(sign_is_set(x), rest, real_add(x, rest));
}
