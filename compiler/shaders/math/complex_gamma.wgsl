// The gamma function and its logarithmic derivatives of a complex argument: Stirling's series from |z| ≥ 5 on (DLMF
// 5.11.1-2), the recurrence to get there (DLMF 5.5.1-2), reflection on the left (DLMF 5.5.3-4).

/// Whether the series may be used as they stand.
fn is_gamma_far(z: vec2f) -> bool {
    return magnitude(z.y) >= 5.0 || z.x >= 5.0;
}

/// Whether a derivative of ψ is reflected: left of 0, as long as π²/sin² πz, which is about 40 e^(-2π|y|), is a number. Far
/// left it is more than all the rest, however small.
fn is_reflected(z: vec2f) -> bool {
    return z.x < 0.0 && magnitude(z.y) < 14.0;
}

/// sin πz, its real part reduced exactly.
fn complex_sin_pi(z: vec2f) -> vec2f {
    let wave = sincos_pi(z.x);
    // πy in two floats: the error of the first part would come out multiplied by |πy|
    let p = two_product(z.y, 3.1415927, hidden_zero(z.y));
    let low = p.y - z.y * 8.742278e-8;
    let h = scaled_sinhcosh(p.x);
    let cosh = h.cosh + low * h.sinh;
    let sinh = h.sinh + low * h.cosh;
    return vec2f(times_wide_power_of_two(wave.x * cosh, h.exponent), times_wide_power_of_two(wave.y * sinh,
        h.exponent));
}

/// π cot πz = π (sin πx cos πx - i sinh πy cosh πy) / (sin² πx + sinh² πy) for |y| ≤ 14: no part cancels.
fn complex_pi_cot_pi(z: vec2f) -> vec2f {
    let wave = sincos_pi(z.x);
    let h = real_sinhcosh(3.1415927 * z.y);
    let norm = wave.x * wave.x + h.x * h.x;
    if norm < 1e-24 { // beside a pole, where the squares may underflow: 1/z
        return complex_inverse(vec2f(z.x - round(z.x), z.y));
    }
    return vec2f(wave.x * wave.y, -h.x * h.y) * (3.1415927 / norm);
}

/// Γ for Re z ≥ -1/2 or |Im z| ≥ 5.
fn gamma_of_right(z: vec2f) -> vec2f {
    var product = vec2f(1.0, 0.0);
    var steps = 0.0;
    // ends: z is finite, and 6 steps to the right of -1/2 at most
    while !is_gamma_far(z + vec2f(steps, 0.0)) {
        product = complex_mul(product, z + vec2f(steps, 0.0));
        steps += 1.0;
    }
    // z + steps = top + lost, top - 1/2 = power + low
    let zero = hidden_zero(z.y);
    let sum = two_sum(z.x, steps, zero);
    let top = vec2f(sum.x, z.y);
    let power = two_sum(sum.x, -0.5, zero);
    let r = complex_inverse(top);
    let w = complex_square(r);
    // B(2n) / (2n (2n - 1)), n = 1 … 4
    var series = vec2f(0.00079365079, 0.0) - 0.00059523810 * w;
    series = vec2f(-0.0027777778, 0.0) + complex_mul(w, series);
    series = vec2f(0.083333333, 0.0) + complex_mul(w, series);
    // z^(z - 1/2) e^-z √(2π) e^s, |s| < 1/50
    let s = complex_mul(r, series - vec2f(0.5 * sum.y, 0.0));
    let exp_s = vec2f(1.0, 0.0) + s + complex_mul(complex_square(s), vec2f(0.5, 0.0) + s * 0.16666667);
    let value = complex_mul(2.5066283 * exp_s, power_and_exp(top, vec2f(power.x, z.y), power.y + sum.y, -top));
    return complex_div(value, product);
}

/// Γ(z). Error: 12 ulp of the norm for |z| < 12.
fn complex_gamma(z: vec2f) -> vec2f {
    if z.y == 0.0 {
        return vec2f(real_gamma(z.x), flip_sign(z.y, select(0x80000000u, 0u, z.x > 1.4616321)));
    }
    if !is_finite(z.x) || !is_finite(z.y) {
        return vec2f(make_nan(z.x), make_nan(z.y));
    }
    if magnitude(z.x) + magnitude(z.y) < 1e-4 { // DLMF 5.7.1
        return complex_inverse(z) + (vec2f(-0.57721566, 0.0) + 0.98905599 * z);
    }
    if magnitude(z.y) > 1e3 && z.x < 100.0 { // |Γ| falls as e^(-π|y|/2)
        return vec2f(0.0, 0.0);
    }
    let size = max(magnitude(z.x), magnitude(z.y));
    if size > 1e30 && !(z.x < 0.0 && magnitude(z.y) < 5.0) {
        // log|Γ| = |z| (cos φ (log|z| - 1) - φ sin φ): nothing but a zero or an infinity, of a phase that none knows
        let unit = z / size;
        let growth = unit.x * (real_log(size) - 1.0) - unit.y * real_atan2(unit.y, unit.x);
        let infinity = make_infinity(1.0);
        return select(vec2f(0.0, 0.0), vec2f(infinity, flip_sign(infinity, sign_bit(z.y))), growth > 0.0);
    }
    if z.x < 0.5 && !is_gamma_far(z) {
        // Γ(z) = -π / (z sin πz Γ(-z))
        let below = complex_mul(complex_mul(z, complex_sin_pi(z)), gamma_of_right(-z));
        return -3.1415927 * complex_inverse(below);
    }
    return gamma_of_right(z);
}

/// ψ(z) = Γ′(z)/Γ(z). Error: 12 ulp of max(|ψ|, 1).
fn complex_digamma(z: vec2f) -> vec2f {
    if z.y == 0.0 {
        return vec2f(real_digamma(z.x), z.y);
    }
    if !is_finite(z.x) || !is_finite(z.y) {
        return complex_log(z);
    }
    let left = z.x < 0.0 && !is_gamma_far(z);
    var top = select(z, -z, left);
    var sum = vec2f(0.0, 0.0);
    if left { // ψ(z) = ψ(-z) - 1/z - π cot πz
        sum = complex_inverse(z) + complex_pi_cot_pi(z);
    }
    // ends: the real part is finite and at least -1/2 or far
    while !is_gamma_far(top) {
        sum += complex_inverse(top);
        top.x += 1.0;
    }
    let r = complex_inverse(top);
    let w = complex_square(r);
    // B(2n) / (2n), n = 1 … 4
    var series = vec2f(0.0039682540, 0.0) - 0.0041666667 * w;
    series = vec2f(-0.0083333333, 0.0) + complex_mul(w, series);
    series = vec2f(0.083333333, 0.0) + complex_mul(w, series);
    return (complex_log(top) - sum) - (0.5 * r + complex_mul(w, series));
}

/// ψ′(z). Error: 12 ulp of the largest term, |1/z²| or |π²/sin² πz|.
fn complex_trigamma(z: vec2f) -> vec2f {
    if z.y == 0.0 {
        return vec2f(real_trigamma(z.x), -z.y);
    }
    if !is_finite(z.x) || !is_finite(z.y) {
        return select(vec2f(0.0, 0.0), vec2f(make_nan(z.x), make_nan(z.y)), complex_has_nan(z));
    }
    let left = is_reflected(z);
    var top = select(z, -z, left);
    var sum = vec2f(0.0, 0.0);
    if left { // ψ′(z) = π² / sin² πz - (ψ′(-z) - 1/z²)
        top.x += 1.0;
    }
    // ends: the real part is finite and at least -1/2 or far
    while !is_gamma_far(top) {
        sum += complex_square(complex_inverse(top));
        top.x += 1.0;
    }
    let r = complex_inverse(top);
    let w = complex_square(r);
    // B(2n), n = 1 … 4
    var series = vec2f(0.023809524, 0.0) - 0.033333333 * w;
    series = vec2f(-0.033333333, 0.0) + complex_mul(w, series);
    series = vec2f(0.16666667, 0.0) + complex_mul(w, series);
    let far = sum + (r + complex_mul(w, vec2f(0.5, 0.0) + complex_mul(r, series)));
    if left {
        return complex_square(3.1415927 * complex_inverse(complex_sin_pi(z))) - far;
    }
    return far;
}
