// Complex trigonometric and hyperbolic functions and their inverses. The trigonometric ones are the hyperbolic ones
// turned by i, as C99 Annex G specifies them.

/// (sinh x, cosh x) / 2^exponent, so that products with them overflow only where they must.
struct ScaledWaves {
    sinh: real,
    cosh: real,
    exponent: i32,
}

fn scaled_sinhcosh(x: real) -> ScaledWaves {
    let a = real_abs(x);
    if !is_above(a, 40.0) {
        let w = real_sinhcosh(x);
        return ScaledWaves(w.first, w.second, 0);
    }
    let s = exp_apart(Long(a, num(0.0)));
    let e = mul32(s.value, 0.5);
    return ScaledWaves(flip_if(e, sign_is_set(x)), e, s.exponent);
}

fn sinh_of_parts(z: Complex, wave: RealPair, h: ScaledWaves) -> Complex {
    let re = scale(real_mul(real_abs(h.sinh), real_abs(wave.second)), h.exponent);
    return Complex(flip_if(re, signs_differ(z.re, wave.second)), scale(real_mul(h.cosh, wave.first), h.exponent));
}

fn cosh_of_parts(z: Complex, wave: RealPair, h: ScaledWaves) -> Complex {
    let im = scale(real_mul(real_abs(h.sinh), real_abs(wave.first)), h.exponent);
    return Complex(scale(real_mul(h.cosh, wave.second), h.exponent), flip_if(im, signs_differ(z.re, wave.first)));
}

/// sinh z = sinh x cos y + i cosh x sin y (C99 G.6.2.5).
/// Error: 6 u each component.
fn complex_sinh(z: Complex) -> Complex {
    if is_zero(z.im) {
        return Complex(real_sinh(z.re), z.im);
    }
    if !is_finite(z.im) {
        let keep = is_zero(z.re) || is_infinite(z.re);
        return Complex(choose(keep, z.re, make_nan(z.re)), make_nan(z.im));
    }
    let wave = real_sincos(z.im);
    if is_infinite(z.re) {
        return Complex(flip_if(z.re, sign_is_set(wave.second)), make_infinity(wave.first));
    }
    return sinh_of_parts(z, wave, scaled_sinhcosh(z.re));
}

/// cosh z = cosh x cos y + i sinh x sin y (C99 G.6.2.4).
/// Error: 6 u each component.
fn complex_cosh(z: Complex) -> Complex {
    if is_zero(z.im) {
        return Complex(real_cosh(z.re), flip_if(z.im, sign_is_set(z.re)));
    }
    if !is_finite(z.im) {
        if is_zero(z.re) {
            return Complex(make_nan(z.im), z.re);
        }
        return Complex(choose(is_infinite(z.re), real_abs(z.re), make_nan(z.re)), make_nan(z.im));
    }
    let wave = real_sincos(z.im);
    if is_infinite(z.re) {
        return Complex(make_infinity(wave.second), flip_if(z.re, sign_is_set(wave.first)));
    }
    return cosh_of_parts(z, wave, scaled_sinhcosh(z.re));
}

/// tanh z = (sinh x cosh x + i sin y cos y) / (sinh² x + cos² y): no term cancels (after Kahan 1987; C99 G.6.2.6).
/// Error: 8 u each component.
fn complex_tanh(z: Complex) -> Complex {
    if is_infinite(z.re) {
        var below = sign_is_set(z.im);
        if is_finite(z.im) {
            let wave = real_sincos(z.im);
            below = signs_differ(wave.first, wave.second);
        }
        return Complex(with_sign(num(1.0), z.re), flip_if(num(0.0), below));
    }
    if is_zero(z.im) {
        return Complex(real_tanh(z.re), z.im);
    }
    if !is_finite(z.im) || is_nan(z.re) {
        return Complex(choose(is_zero(z.re), z.re, make_nan(z.re)), make_nan(z.im));
    }
    let wave = real_sincos(z.im);
    let a = real_abs(z.re);
    if is_above(a, 20.0) { // 1 is tanh x, and sinh² x + cos² y is e^2x / 4, to working precision
        let e = mul32(real_exp(mul32(a, -2.0)), 4.0);
        return Complex(with_sign(num(1.0), z.re), real_mul(real_mul(wave.first, wave.second), e));
    }
    let h = real_sinhcosh(a);
    let norm = real_add(real_square(h.first), real_square(wave.second));
    return Complex(
        with_sign(real_div(real_mul(h.first, h.second), norm), z.re),
        real_div(real_mul(wave.first, wave.second), norm),
    );
}

/// sin z = -i sinh(i z).
/// Error: 6 u each component.
fn complex_sin(z: Complex) -> Complex {
    return complex_div_i(complex_sinh(complex_mul_i(z)));
}

/// cos z = cosh(i z).
/// Error: 6 u each component.
fn complex_cos(z: Complex) -> Complex {
    return complex_cosh(complex_mul_i(z));
}

/// tan z = -i tanh(i z).
/// Error: 8 u each component.
fn complex_tan(z: Complex) -> Complex {
    return complex_div_i(complex_tanh(complex_mul_i(z)));
}

/// log 2 and π/2.
fn real_log_of_2() -> real {
    return lit(0.6931472, -1.9046542e-09, -8.783184e-17);
}

fn half_pi() -> real {
    return lit(1.5707964, -4.371139e-08, -1.7151245e-15);
}

/// arcsin z and arccos z for z without NaN.
struct Arc {
    /// Re arcsin z
    asin: real,
    /// Re arccos z
    acos: real,
    /// |Im| of both
    im: real,
}

/// Kahan, "Branch Cuts for Complex Elementary Functions" (1987): each component of the products of √(1 - z) and
/// √(1 + z) is a sum of terms of one sign, so nothing cancels.
fn complex_arc(z: Complex) -> Arc {
    let b = real_abs(z.im);
    if is_above(real_max(real_abs(z.re), b), 4294967296.0) { // 1 ± z² is ±z² to working precision
        let size = real_add(log_hypot(z.re, z.im), real_log_of_2());
        return Arc(real_atan2(z.re, b), real_atan2(b, z.re), size);
    }
    // in the upper half plane
    let minus = complex_sqrt(Complex(real_sub(num(1.0), z.re), real_neg(b)));
    let plus = complex_sqrt(Complex(real_add(num(1.0), z.re), b));
    let cross = real_add(real_abs(real_mul(minus.re, plus.im)), real_abs(real_mul(minus.im, plus.re)));
    let along = real_add(real_mul(minus.re, plus.re), real_abs(real_mul(minus.im, plus.im)));
    return Arc(real_atan2(z.re, along), twice(real_atan2(minus.re, plus.re)), real_asinh(cross));
}

/// arsinh z where a component is NaN (C99 G.6.2.2).
fn asinh_of_nan(z: Complex) -> Complex {
    if is_infinite(z.re) || is_zero(z.im) {
        return z;
    }
    return Complex(choose(is_infinite(z.im), make_infinity(z.re), make_nan(z.re)), make_nan(z.im));
}

/// arcsin z, cuts on the real axis outside [-1, 1].
/// Error: 8 u each component.
fn complex_asin(z: Complex) -> Complex {
    if complex_has_nan(z) {
        return complex_div_i(asinh_of_nan(complex_mul_i(z)));
    }
    // in the right half plane, so that it is odd bit for bit
    let arc = complex_arc(Complex(real_abs(z.re), z.im));
    return Complex(with_sign(arc.asin, z.re), with_sign(arc.im, z.im));
}

/// arccos z, cuts on the real axis outside [-1, 1].
/// Error: 8 u each component.
fn complex_acos(z: Complex) -> Complex {
    if complex_has_nan(z) {
        return Complex(
            choose(is_zero(z.re), half_pi(), make_nan(z.re)),
            choose(complex_is_infinite(z), make_infinity(real_neg(z.im)), make_nan(z.im)),
        );
    }
    let arc = complex_arc(z);
    return Complex(arc.acos, flip_if(arc.im, !sign_is_set(z.im)));
}

/// arsinh z = -i arcsin(i z), cuts on the imaginary axis outside [-i, i].
/// Error: 8 u each component.
fn complex_asinh(z: Complex) -> Complex {
    if complex_has_nan(z) {
        return asinh_of_nan(z);
    }
    return complex_div_i(complex_asin(complex_mul_i(z)));
}

/// arcosh z, cut on the real axis below 1; the real part is never negative.
/// Error: 8 u each component.
fn complex_acosh(z: Complex) -> Complex {
    let w = complex_acos(z);
    return Complex(real_abs(w.im), with_sign(w.re, z.im));
}

/// artanh z, cuts on the real axis outside [-1, 1] (Kahan 1987).
/// Error: 8 u each component.
fn complex_atanh(z: Complex) -> Complex {
    let a = real_abs(z.re);
    let b = real_abs(z.im);
    if complex_has_nan(z) {
        if is_infinite(z.im) {
            return Complex(signed_zero(z.re), with_sign(half_pi(), z.im));
        }
        if is_infinite(z.re) || is_zero(a) {
            return Complex(signed_zero(z.re), make_nan(z.im));
        }
        return complex_nan(z.re);
    }
    if is_above(real_max(a, b), 1e17) { // 1/z + O(z^-3)
        let re = real_abs(complex_inverse(Complex(a, b)).re);
        return Complex(with_sign(re, z.re), with_sign(half_pi(), z.im));
    }
    let d = real_sub(num(1.0), a);
    if is_zero(d) && is_zero(b) {
        return Complex(make_infinity(z.re), z.im);
    }
    let norm = real_add(real_square(d), real_square(b));
    let im = mul32(real_atan2(twice(b), real_sub(real_mul(d, real_add(num(1.0), a)), real_square(b))), 0.5);
    var re = mul32(real_log1p(real_div(mul32(a, 4.0), norm)), 0.25);
    if is_below(norm, 1e-6) { // the squares may underflow
        re = mul32(real_sub(log_hypot(real_add(num(1.0), a), b), log_hypot(d, b)), 0.5);
    }
    return Complex(with_sign(re, z.re), with_sign(im, z.im));
}

/// arctan z = -i artanh(i z), cuts on the imaginary axis outside [-i, i].
/// Error: 8 u each component.
fn complex_atan(z: Complex) -> Complex {
    return complex_div_i(complex_atanh(complex_mul_i(z)));
}
