// The gamma function and its logarithmic derivatives of a complex argument: Stirling's series from Re z ≥ 10 or |Im z|
// ≥ 10 on (DLMF 5.11.1-2), the recurrence to get there (DLMF 5.5.1-2), reflection on the left (DLMF 5.5.3-4).

/// Whether the series may be used as they stand.
fn is_gamma_far(z: Complex) -> bool {
    return !is_below(real_abs(z.im), 10.0) || !is_below(z.re, 10.0);
}

/// The steps from Re z ≥ -1/2 up to where the series may be used.
fn steps_to_far(z: Complex) -> i32 {
    return select(max(i32(ceil(10.0 - real_to_f32(z.re))), 0), 0, is_gamma_far(z));
}

/// z + k.
fn complex_step(z: Complex, k: i32) -> Complex {
    return Complex(add32(z.re, f32(k)), z.im);
}

/// Σ c(k) w^k for a real polynomial of degree 9 (Knuth, TAOCP 2, 4.6.4, equation 3): `family` 0 Stirling's, 1 of ψ,
/// 2 of ψ′.
fn complex_series(w: Complex, family: i32) -> Complex {
    let r = twice(w.re);
    let s = real_add(real_square(w.re), real_square(w.im));
    var first = num(0.0);
    var second = num(0.0);
    for (var k = 9; k > 0; k--) {
        let next = real_sub(real_add(series_coefficient(k, family), real_mul(r, first)), real_mul(s, second));
        second = first;
        first = next;
    }
    let constant = real_sub(series_coefficient(0, family), real_mul(s, second));
    return complex_add_real(complex_mul_real(w, first), constant);
}

fn series_coefficient(k: i32, family: i32) -> real {
    if family == 0 {
        return stirling_coefficient(k);
    }
    if family == 1 {
        return digamma_coefficient(k);
    }
    return bernoulli_number(k);
}

/// (sinh πy, cosh πy) for |y| ≤ 16: πy in a long number, for the error of its first part would come out multiplied.
fn sinhcosh_pi(y: real) -> RealPair {
    let angle = long_mul(long_lit(3.1415927, -8.742278e-08, -3.430249e-15, 2.1125998e-23, 1.6956855e-31), y);
    let h = real_sinhcosh(angle.hi);
    return RealPair(
        real_add(h.first, real_mul(angle.lo, h.second)),
        real_add(h.second, real_mul(angle.lo, h.first)),
    );
}

/// sin πx, cos πx, sinh πy, cosh πy of z = x + i y, |y| ≤ 16, the turns of x reduced exactly.
struct PiWaves {
    circular: RealPair,
    hyperbolic: RealPair,
}

fn waves_of_pi(z: Complex) -> PiWaves {
    return PiWaves(sincos_pi(z.re), sinhcosh_pi(z.im));
}

/// sin πz.
fn complex_sin_pi(w: PiWaves) -> Complex {
    return Complex(
        real_mul(w.circular.first, w.hyperbolic.second),
        real_mul(w.circular.second, w.hyperbolic.first),
    );
}

/// π cot πz = π (sin πx cos πx - i sinh πy cosh πy) / (sin² πx + sinh² πy): no part cancels.
fn complex_pi_cot_pi(z: Complex, w: PiWaves) -> Complex {
    let e = select(0, -40, is_above(real_abs(z.im), 6.0)); // the squares may overflow
    let sine = scale(w.circular.first, e);
    let sinh = scale(w.hyperbolic.first, e);
    let norm = real_add(real_square(sine), real_square(sinh));
    if is_below(norm, 1e-20) { // beside a pole, where the squares may underflow: 1/z
        let part = nearest_fraction(real_abs(z.re)).part;
        return complex_inverse(Complex(flip_if(part, sign_is_set(z.re)), z.im));
    }
    let ratio = real_div(real_pi(), norm);
    return Complex(
        real_mul(real_mul(sine, scale(w.circular.second, e)), ratio),
        real_neg(real_mul(real_mul(sinh, scale(w.hyperbolic.second, e)), ratio)),
    );
}

/// A quotient of complex numbers.
struct ComplexRatio {
    n: Complex,
    d: Complex,
}

/// Γ / 2^down for Re z ≥ -1/2 or |Im z| ≥ 10.
fn gamma_of_right(z: Complex, down: i32) -> ComplexRatio {
    let steps = steps_to_far(z);
    var product = complex_of_real(num(1.0));
    for (var k = 0; k < steps; k++) {
        product = plain_product(product, complex_step(z, k));
    }
    // z + steps = top + lost, top - 1/2 = power + low
    let sum = long_sum(z.re, num(f32(steps)));
    let top = Complex(sum.hi, z.im);
    let power = long_sum(sum.hi, num(-0.5));
    let r = complex_inverse(top);
    // z^(z - 1/2) e^-z √(2π) e^s, |s| < 1/100
    let s = plain_product(r, complex_add_real(complex_series(complex_square(r), 0), mul32(sum.lo, -0.5)));
    let shift = LongComplex(
        long_add(long_half_log_tau(), long_sum(real_neg(top.re), s.re)),
        long_sum(real_neg(top.im), s.im),
    );
    let w = Complex(power.hi, z.im);
    return ComplexRatio(power_and_exp(top, w, real_add(power.lo, sum.lo), shift, down), product);
}

/// Γ(z); NaN where a component is not finite. Error: 40 u of the norm for |z| < 100.
fn complex_gamma(z: Complex) -> Complex {
    let flat = is_zero(z.im);
    let right = is_above(z.re, 1.0) && !sign_is_set(beyond_digamma_zero(z.re));
    let im_of_flat = flip_if(z.im, !right);
    if flat {
        let known = known_gamma(z.re);
        if known.is_known {
            return Complex(known.value, im_of_flat);
        }
    }
    if !complex_is_finite(z) {
        return complex_nan(z.re);
    }
    if is_below(real_abs(z.re), 1e-9) && is_below(real_abs(z.im), 1e-9) { // DLMF 5.7.1
        let slope = complex_mul_real(z, lit(0.989056, 4.155182e-09, 5.1778575e-17));
        let r = complex_add(complex_inverse(z), complex_add_real(slope, real_neg(lit(0.5772157, -6.637774e-09, 1.0607939e-16))));
        return Complex(r.re, choose(flat, im_of_flat, r.im));
    }
    if is_above(real_abs(z.im), 1e3) && is_below(z.re, 100.0) { // |Γ| falls as e^(-π|y|/2)
        return complex_of_real(num(0.0));
    }
    let reflected = is_below(z.re, 0.5) && !is_gamma_far(z);
    let start = complex_choose(reflected, complex_neg(z), z);
    let size = real_to_f32(start.re);
    if reflected && size > 0.3 * EXP_END { // below all numbers, also beside a pole
        let sign = choose(flat, sincos_pi(z.re).first, num(1.0));
        return Complex(signed_zero(sign), choose(flat, im_of_flat, num(0.0)));
    }
    let down = select(0, i32(4.0 * size), reflected && size > 20.0); // Γ(-z) may overflow
    let ratio = gamma_of_right(start, down);
    var r = ratio.n;
    if reflected { // Γ(z) = -π / (z sin πz Γ(-z))
        let below = plain_product(plain_product(z, complex_sin_pi(waves_of_pi(z))), ratio.n);
        r = complex_mul_real(ratio.d, real_neg(real_pi()));
        r = complex_scale(plain_product(r, complex_inverse(below)), -down);
    } else if !is_gamma_far(z) {
        r = plain_product(r, complex_inverse(ratio.d));
    }
    return Complex(r.re, choose(flat, im_of_flat, r.im));
}

/// ψ(z) = Γ′(z)/Γ(z). Error: 40 u of max(|ψ|, 1).
fn complex_digamma(z: Complex) -> Complex {
    if is_zero(z.im) {
        return Complex(real_digamma(z.re), z.im);
    }
    if !complex_is_finite(z) {
        return complex_log(z);
    }
    let left = sign_is_set(z.re) && !is_gamma_far(z);
    let start = complex_choose(left, complex_neg(z), z);
    var sum = complex_of_real(num(0.0));
    if left { // ψ(z) = ψ(-z) - 1/z - π cot πz
        sum = complex_add(complex_inverse(z), complex_pi_cot_pi(z, waves_of_pi(z)));
    }
    let steps = steps_to_far(start);
    for (var k = 0; k < steps; k++) {
        sum = complex_add(sum, complex_inverse(complex_step(start, k)));
    }
    let top = complex_step(start, steps);
    let r = complex_inverse(top);
    let w = complex_square(r);
    let series = plain_product(w, complex_series(w, 1));
    let half = complex_scale(r, -1);
    return complex_sub(complex_sub(complex_log(top), complex_add(half, series)), sum);
}

/// ψ′(z). Error: 40 u of the largest term, |1/z²| or |π²/sin² πz|.
fn complex_trigamma(z: Complex) -> Complex {
    let flat = is_zero(z.im);
    if flat && is_gamma_pole(z.re) {
        return Complex(make_infinity(num(1.0)), real_neg(z.im));
    }
    if !complex_is_finite(z) {
        if complex_has_nan(z) || flat && sign_is_set(z.re) {
            return Complex(make_nan(z.re), choose(flat, real_neg(z.im), make_nan(z.im)));
        }
        return Complex(num(0.0), choose(flat, real_neg(z.im), num(0.0)));
    }
    let left = sign_is_set(z.re) && !is_gamma_far(z);
    let start = complex_choose(left, complex_neg(z), z);
    // ψ′(z) = π² / sin² πz - ψ′(1 - z)
    let first = select(0, 1, left);
    let steps = max(steps_to_far(start), first);
    let top = complex_step(start, steps);
    let r = complex_inverse(top);
    let w = complex_square(r);
    let series = complex_add_real(plain_product(r, complex_series(w, 2)), num(0.5));
    var far = complex_add(r, plain_product(w, series));
    for (var k = steps - 1; k >= first; k--) {
        far = complex_add(far, complex_square(complex_inverse(complex_step(start, k))));
    }
    if left {
        let ratio = complex_mul_real(complex_inverse(complex_sin_pi(waves_of_pi(z))), real_pi());
        far = complex_sub(complex_square(ratio), far);
    }
    return Complex(far.re, choose(flat, real_neg(z.im), far.im));
}
