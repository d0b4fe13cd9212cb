// The error function and its kin. e^(x²) iⁿerfc x (DLMF 7.18) are one family, in which each is a derivative of the one
// before. The mass of a Gaussian in an interval is a difference of two, or a quadrature where that would cancel.

/// e^(x + low), where low is what the rounding of x left.
fn exp_of_pair(x: f32, low: f32) -> f32 {
    let s = split_exponent(clamp(x, -150.0, 150.0));
    return times_power_of_two(1.0 + expm1_polynomial(s.x + low), i32(s.y));
}

/// e^(-x²); the rounding of the square does not count.
/// Error: 1 ulp.
fn real_gauss(x: f32) -> f32 {
    if is_nan(x) {
        return x;
    }
    let a = min(magnitude(x), 12.0);
    let square = two_product(a, a, hidden_zero(a));
    return exp_of_pair(-square.x, -square.y);
}

/// e^(x y); the rounding of the product does not count.
fn real_exp_of_product(x: f32, y: f32) -> f32 {
    let product = two_product(x, y, hidden_zero_of(x, y));
    let e = exp_scaled(product.x, 0);
    return select(e, e + e * product.y, magnitude(product.x) < 88.7);
}

/// e^(-(x + y)²); the rounding of the sum does not count.
fn real_gauss_of_sum(x: f32, y: f32) -> f32 {
    let zero = hidden_zero_of(x, y);
    let sum = two_sum(x, y, zero);
    if is_nan(sum.x) || magnitude(sum.x) > 12.0 {
        return select(0.0, sum.x, is_nan(sum.x));
    }
    let square = two_product(sum.x, sum.x, zero);
    return exp_of_pair(-square.x, -(square.y + 2.0 * sum.x * sum.y));
}

/// erf x = x (2/√π + z P(z)), z = x², |x| ≤ 1; coefficients.py, erf.
fn erf_near(x: f32) -> f32 {
    let z = x * x;
    let rest = -5.8635383e-08 + z * (-0.3761263 + z * (0.112836175 + z * (-0.026854916 + z * (0.005190162 + z * (
        -0.0008024816 + z * 7.8986865e-05)))));
    return select(x * 1.1283792 + x * rest, x * 1.1283792, z == 0.0);
}

/// erf x.
fn real_erf(x: f32) -> f32 {
    let a = magnitude(x);
    if a < 1.0 {
        return erf_near(x);
    }
    if is_nan(x) {
        return x;
    }
    return flip_sign(1.0 - real_gauss(a) * erfcx_right(a), sign_bit(x));
}

/// erfc x = 1 - erf x, to the last digits also where it is small.
fn real_erfc(x: f32) -> f32 {
    if is_nan(x) {
        return x;
    }
    if magnitude(x) < 0.5 {
        return 1.0 - erf_near(x);
    }
    let a = magnitude(x);
    let right = real_gauss(a) * erfcx_right(a);
    return select(right, 2.0 - right, sign_is_set(x));
}

/// e^(x²) erfc x for x ≥ 0: (1 + 2 x) times that as a polynomial in (x - 3)/(x + 3) (after Shepherd and Laframboise,
/// "Chebyshev approximation of (1 + 2x) exp(x²) erfc x", Math. Comp. 36, 1981); coefficients.py, erfcx.
fn erfcx_right(x: f32) -> f32 {
    if x > 1e8 {
        return 0.5641896 / x;
    }
    if x < 0.5 {
        return exp_scaled(x * x, 0) * (1.0 - erf_near(x));
    }
    let y = (x - 3.0) / (x + 3.0);
    let p = 1.253008 + y * (-0.13562106 + y * (-0.047562186 + y * (0.12964386 + y * (-0.11927503 + y * (0.06831814 + y * (
        -0.02376432 + y * (0.0024952737 + y * (0.0018759916 + y * (-0.0007223943 + y * (-9.293236e-05
        + y * 7.576549e-05))))))))));
    return p / (1.0 + 2.0 * x);
}

/// e^(x²) iⁿerfc x, n ≤ 7: for n = 0 the scaled complementary error function. From n = 1, x = 1/2 on by the continued fraction of
/// the recurrence DLMF 7.18.7, downwards, else by the recurrence upwards.
fn real_erfcx(x: f32, n: i32) -> f32 {
    if is_nan(x) {
        return x;
    }
    if n > 0 && x >= 0.5 {
        return repeated_right(x, n);
    }
    let a = magnitude(x);
    var value = erfcx_right(a);
    if sign_is_set(x) {
        let square = two_product(a, a, hidden_zero(a));
        if a > 10.0 || square.x > 88.72 {
            return make_infinity(1.0);
        }
        let e = exp_scaled(square.x, 0);
        value = 2.0 * (e + e * square.y) - value;
    }
    var last = 1.1283792;
    for (var k = 0; k < n; k++) {
        let next = (last - 2.0 * x * value) / (2.0 * f32(k) + 2.0);
        last = value;
        value = next;
    }
    return value;
}

/// The same for x ≥ 1/2: f(k)/f(k-1) = 1/(2 x + 2 (k + 1) f(k+1)/f(k)), from an index where it hardly matters.
fn repeated_right(x: f32, n: i32) -> f32 {
    if x > 1e6 {
        // the first term of the asymptotic series (DLMF 7.18.14)
        return 1.1283792 * small_power(0.5 / x, n + 1);
    }
    let end = n + 10 + i32(24.0 / (x * x));
    var ratio = 1.0 / (x + sqrt(x * x + 2.0 * f32(end)));
    var value = 1.1283792;
    for (var k = end - 1; k >= 0; k--) {
        ratio = 0.5 / (x + f32(k + 1) * ratio);
        if k <= n {
            value *= ratio;
        }
    }
    return value;
}

/// v √π/2
fn times_half_root_pi(v: f32) -> f32 {
    return v * 0.88622695 + v * -2.66232e-08;
}

/// Nodes and weights on the right of Gauss and Legendre's rule of 8 points (DLMF 3.5.v); special.py, gauss_node_single.
fn gauss_node(k: i32) -> vec2f {
    switch k {
        case 0: { return vec2f(0.96028984, 0.101228535); }
        case 1: { return vec2f(0.7966665, 0.22238104); }
        case 2: { return vec2f(0.5255324, 0.31370664); }
        default: { return vec2f(0.18343464, 0.36268377); }
    }
}

/// ∫ e^(-u²) du over [c - w, c + w], over the greatest value of e^(-u²) there, 0 ≤ w ≤ c. Where the ends differ enough the
/// difference of erfcx, else Gauss and Legendre's rule (DLMF 3.5.v): u² - (c - w)² = (u - c + w)(u + c - w).
fn tail_mass(c: f32, w: f32) -> f32 {
    let steepness = 4.0 * c * w;
    if steepness > 1.5 {
        let far = exp_scaled(-min(steepness, 120.0), 0) * erfcx_right(c + w);
        return times_half_root_pi(erfcx_right(c - w) - far);
    }
    var sum = 0.0;
    for (var k = 0; k < 8; k++) {
        let node = gauss_node(k >> 1u);
        let s = select(node.x, -node.x, (k & 1) == 0);
        sum += node.y * exp_scaled(-w * (1.0 + s) * (2.0 * c + w * (s - 1.0)), 0);
    }
    return w * sum;
}

/// ∫ tᵏ e^(-t² - 2 a t) dt over [0, 2 |w|] with a = |c| - |w|, for |w| ≤ |c| and k ≤ 3. Where the exponent changes enough the
/// integral over all t > 0, which is √π/2 k! e^(a²) iᵏerfc a (DLMF 7.18.2), less that from 2 |w| on.
fn real_gauss_mass_moment(centre: f32, width: f32, k: i32) -> f32 {
    let c = magnitude(centre);
    let w = magnitude(width);
    let steepness = 4.0 * c * w;
    if is_nan(c) || is_nan(w) || w > c {
        return make_nan(c);
    }
    var sum = 0.0;
    if steepness <= 1.5 + f32(k) {
        for (var i = 0; i < 8; i++) {
            let node = gauss_node(i >> 1u);
            let t = w * (1.0 + select(node.x, -node.x, (i & 1) == 0));
            sum += node.y * small_power(t, k) * exp_scaled(-t * (2.0 * (c - w) + t), 0);
        }
        return w * sum;
    }
    // Σ k!/j! (2w)^(k - j)/(k - j)! j! iʲerfc
    var factor = 1.0;
    for (var j = k; j >= 0; j--) {
        sum += factor * real_erfcx(c + w, j);
        factor *= 2.0 * w / f32(k - j + 1);
    }
    let near = real_erfcx(c - w, k) - exp_scaled(-min(steepness, 120.0), 0) * sum;
    return times_half_root_pi(select(f32(k * (k - 1)), 1.0, k < 2) * near);
}

/// x² + p, rounded once.
fn real_square_plus(x: f32, p: f32) -> f32 {
    let zero = hidden_zero_of(x, p);
    let square = two_product(x, x, zero);
    if !(square.x < 1e38) || magnitude(p) > 1e38 {
        return square.x + p;
    }
    // no smaller than where a square may be lost
    if square.x < 1e-20 && magnitude(p) < 1e-20 {
        let scaled = x * 4294967296.0;
        let square = two_product(scaled, scaled, zero);
        let sum = two_sum(square.x, p * 18446744073709551616.0, zero);
        return (sum.x + opaque(sum.y + square.y, zero)) * 5.421010862427522e-20;
    }
    let sum = two_sum(square.x, p, zero);
    return sum.x + opaque(sum.y + square.y, zero);
}

/// The integral of e^(-u²) over the interval with centre c and half-width w. Odd in w.
fn real_gauss_mass(c: f32, w: f32) -> f32 {
    let a = magnitude(c);
    let b = magnitude(w);
    if b > a || is_nan(c) || is_nan(w) {
        return real_gauss_mass_scaled(c, w);
    }
    return flip_sign(tail_mass(a, b) * real_gauss_of_sum(a, -b), sign_bit(w));
}

/// The same, divided by the greatest value of e^(-u²) in the interval.
fn real_gauss_mass_scaled(c: f32, w: f32) -> f32 {
    let a = magnitude(c);
    let b = magnitude(w);
    if is_nan(c) || is_nan(w) || is_infinite(c) && is_infinite(w) {
        return make_nan(c);
    }
    if b <= a {
        return flip_sign(tail_mass(a, b), sign_bit(w));
    }
    return flip_sign(times_half_root_pi(real_erf(b + a) + real_erf(b - a)), sign_bit(w));
}

/// log(1 + e^x) without overflow: x + log1p(e^-x) right of 0.
fn real_log1pexp(x: f32) -> f32 {
    return max(x, 0.0) + real_log1p(exp_scaled(-magnitude(x), 0));
}
