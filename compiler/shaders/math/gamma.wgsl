// The gamma function and its logarithmic derivatives of a real argument. Stirling's series (DLMF 5.11.1-2), the
// recurrence (DLMF 5.5.1-2), reflection (DLMF 5.5.3-4); the polynomials are fits of coefficients.py.

/// (sin πx, cos πx), reduced exactly.
fn sincos_pi(x: f32) -> vec2f {
    let a = magnitude(x);
    let n = round(a); // not ⌊a + ½⌋: that sum is rounded from 2²³ on
    let f = a - n; // exact, in [-1/2, 1/2]
    let outer = magnitude(f) > 0.25;
    let g = select(magnitude(f), 0.5 - magnitude(f), outer);
    let z = g * g;
    // π = 3.1415927 - 8.742278e-8; coefficients.py, sinpi and cospi
    let s = g * 3.1415927 + g * (z * (-5.1677127 + z * (2.5501628 + z * (-0.5992052 + z * 0.081022955))) - 8.742278e-8);
    let c = 1.0 + z * (-4.934802 + z * (4.0587077 + z * (-1.3350499 + z * 0.23135775)));
    let odd = select(0u, 0x80000000u, n * 0.5 != floor(n * 0.5));
    return vec2f(flip_sign(select(s, c, outer), odd ^ sign_bit(x) ^ sign_bit(f)), flip_sign(select(c, s, outer), odd));
}

/// Whether Γ has a pole at x.
fn is_gamma_pole(x: f32) -> bool {
    return x <= 0.0 && floor(x) == x;
}

/// 1 / Γ(1 + t), |t| ≤ 1/2; coefficients.py, rgamma.
fn rgamma_polynomial(t: f32) -> f32 {
    return 1.0 + t * (0.5772157 + t * (-0.6558781 + t * (-0.042004284 + t * (0.16654077 + t * (-0.04217406 + t * (
        -0.009643311 + t * (0.0070938193 + t * -0.0010776047)))))));
}

/// log Γ(x) - (x - 1/2) log x + x - log(2π)/2 for x > 3.5; coefficients.py, stirling.
fn stirling_series(x: f32) -> f32 {
    let r = 1.0 / x;
    let w = r * r;
    return r * (0.083333306 + w * (-0.00277489 + w * 0.00071935874));
}

/// Γ(x) for |x| < 3.5, not a pole: 1/Γ(1 + t) and at most four exact factors (DLMF 5.5.1).
fn gamma_of_small(x: f32) -> f32 {
    let n = i32(floor(x + 0.5));
    let t = x - f32(n);
    var above = 1.0;
    var below = rgamma_polynomial(t);
    for (var k = 1; k < n; k++) {
        above *= x - f32(k);
    }
    for (var k = 0; k <= -n; k++) {
        below *= x + f32(k);
    }
    return above / below;
}

/// Γ(x) for x > 3.5 by Stirling's series in two floats.
fn gamma_of_large(x: f32) -> f32 {
    if x > 36.0 {
        return make_infinity(1.0);
    }
    // log2 Γ = (x - 1/2) log2 x - x log2 e + log2(2π)/2 + log2 e series
    let zero = hidden_zero(x);
    let l = log2_pair(x, zero);
    let h = x - 0.5;
    let p = two_product(h, l.x, zero);
    let q = two_product(x, 1.442695, zero);
    let s = two_sum(p.x, -q.x, zero);
    let t = two_sum(s.x, 1.325748, zero);
    let low = (s.y + t.y) + ((p.y - q.y) + (h * l.y - x * 1.925963e-8)) + (stirling_series(x) * 1.442695 + 9.79698e-8);
    let a = opaque(t.x + low, zero);
    return exp2_pair(a, opaque(t.x - a, zero) + low, zero);
}

/// Γ(x); NaN at the negative integers, ±∞ at ±0. Left of 0 by Γ(-y) = -π / (y sin πy Γ(y)).
/// Error: 4 ulp for x > -34, 5 ulp below.
fn real_gamma(x: f32) -> f32 {
    let y = magnitude(x);
    if y < 1e-8 {
        return select(1.0 / x, make_infinity(x), y == 0.0);
    }
    if is_gamma_pole(x) || is_nan(x) {
        return make_nan(x);
    }
    if y < 3.5 {
        return gamma_of_small(x);
    }
    if x > 0.0 {
        return gamma_of_large(x);
    }
    if is_infinite(x) {
        return make_nan(x);
    }
    let r = -3.1415927 / (y * sincos_pi(y).x);
    if y < 34.0 {
        return r / gamma_of_large(y);
    }
    // Γ(y) overflows, and its reciprocal flushes, before the result underflows
    return opaque(r / ((y - 1.0) * (y - 2.0) * (y - 3.0)), hidden_zero(x)) / gamma_of_large(y - 3.0);
}

/// log |Γ(x)|: ∞ at the poles. Relative accuracy near its zeros at 1 and 2; at those left of 0 absolute.
/// Error: 3.5 ulp for x > 0; left of 0 4 ulp of max(|result|, 1, log Γ(-x)).
fn real_lgamma(x: f32) -> f32 {
    if is_gamma_pole(x) || is_infinite(x) {
        return make_infinity(1.0);
    }
    if is_nan(x) {
        return x;
    }
    let y = magnitude(x);
    let r = lgamma_of_positive(y);
    if x > 0.0 {
        return r;
    }
    if y < 1e-9 {
        return r;
    }
    return -(real_log(magnitude(sincos_pi(y).x) * 0.31830987 * y) + r);
}

fn lgamma_of_positive(x: f32) -> f32 {
    if x >= 3.5 {
        return (x - 0.5) * (real_log(x) - 1.0) + (0.41893853 + stirling_series(x));
    }
    if x < 1.5 {
        let t = select(x - 1.0, x, x < 0.5);
        let near = t * (-0.5772157 + t * (0.8224669 + t * (-0.40068588 + t * (0.27059442 + t * (-0.20738241 + t * (
            0.16913113 + t * (-0.14391841 + t * (0.13112795 + t * (-0.114556514 + t * (0.06517511 + t * (
            -0.065422155 + t * (0.17993969 + t * -0.15788352))))))))))));
        return select(select(near, 0.0, t == 0.0), near - real_log(x), x < 0.5); // +0 at 1
    }
    let t = select(x - 2.0, x - 3.0, x >= 2.5);
    let near = t * (0.42278433 + t * (0.32246703 + t * (-0.06735222 + t * (0.020581601 + t * (-0.0073874276 + t * (
        0.002879056 + t * (-0.0011778412 + t * (0.0005698234 + t * -0.00026985176))))))));
    return select(near, near + real_log(x - 1.0), x >= 2.5);
}

/// ψ(x) = Γ′(x)/Γ(x): NaN at the negative poles, ∓∞ at ±0 and where it overflows beside. Relative accuracy near the positive zero; at those left of 0 absolute.
/// Error: 2.7 ulp for x > 0; left of 0 4.5 ulp of the larger term.
fn real_digamma(x: f32) -> f32 {
    // ≤ and not <: an adapter that flushes subnormals compares zeros here
    if magnitude(x) <= 2.9387359e-39 {
        return make_infinity(flip_sign(x, 0x80000000u));
    }
    if is_gamma_pole(x) || is_nan(x) || is_infinite(x) && sign_is_set(x) {
        return make_nan(x);
    }
    let y = magnitude(x);
    let r = digamma_of_positive(y);
    if x > 0.0 {
        return r;
    }
    let wave = sincos_pi(y); // ψ(-y) = ψ(y) + 1/y + π cot πy
    return r + (1.0 / y + 3.1415927 * wave.y / wave.x);
}

fn digamma_of_positive(x: f32) -> f32 {
    let r = 1.0 / x;
    if x >= 2.5 {
        let w = r * r;
        return real_log(x) - (0.5 * r + w * (0.08333313 + w * (-0.008321909 + w * (0.0037524463 + w * -0.0023481685))));
    }
    // (x - x0) P(x - 1.75) with the zero x0 = 1.4616321 … in two parts; from below 1 by the recurrence
    let below = x < 1.0;
    let zero = hidden_zero(x);
    let d = opaque(x - select(1.4616321325302124, 0.46163213, below), zero) - select(1.2438150e-8, 1.243815e-8, below);
    let t = x - select(1.75, 0.75, below);
    return d * (0.8581832 + t * (-0.32625458 + t * (0.15712002 + t * (-0.08228821 + t * (0.044802375 + t * (
        -0.024853561 + t * (0.013955669 + t * (-0.00812498 + t * (0.004646169 + t * (-0.0019586775 + t * (
        0.0010654647 + t * (-0.0015830761 + t * 0.0009338293)))))))))))) - select(0.0, r, below);
}

/// ψ′(x): ∞ at the poles. Left of 0 by ψ′(-y) = π² / sin² πy - ψ′(y) + 1/y².
/// Error: 3 ulp for x > 0, 5.5 ulp left of 0.
fn real_trigamma(x: f32) -> f32 {
    // 1/x² overflows
    if magnitude(x) < 5.4e-20 {
        return make_infinity(1.0);
    }
    if is_nan(x) || is_infinite(x) && sign_is_set(x) {
        return make_nan(x);
    }
    if is_gamma_pole(x) {
        return make_infinity(1.0);
    }
    let y = magnitude(x);
    // ψ′(1 + y), then ψ′(y) = ψ′(1 + y) + 1/y²
    var sum = 0.0;
    var top = y;
    // ends: it begins at 0 or more
    while top < 2.5 {
        let r = 1.0 / top;
        sum += select(r * r, 0.0, top == y && x < 0.0);
        top += 1.0;
    }
    let r = 1.0 / top;
    let w = r * r;
    let far = sum + (r + (0.5 * w + w * r * (0.16666548 + w * (-0.033253837 + w * (0.022099642 + w * -0.017265636)))));
    if x > 0.0 {
        return far;
    }
    let ratio = 3.1415927 / sincos_pi(y).x;
    return ratio * ratio - select(far, far - 1.0 / (y * y), y >= 2.5);
}
