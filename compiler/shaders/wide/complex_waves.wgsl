// Complex trigonometric and hyperbolic functions and their inverses. The trigonometric ones are the hyperbolic ones
// turned by i, as C99 Annex G specifies them.

/// (sinh z, cosh z) = (sinh x cos y + i cosh x sin y, cosh x cos y + i sinh x sin y), as C99 G.6.2.4 and 5 have them.
/// Error: 6 u each component.
fn complex_sinhcosh(z: Complex) -> ComplexPair {
    let wave = real_sincos(z.im);
    let h = scaled_sinhcosh(z.re);
    // 2^60 times too large, so that small ones keep their digits
    let high = scale(h.cosh, 60);
    let low = scale(real_abs(h.sinh), 60);
    let e = h.exponent - 60;
    let along = scale(real_mul(low, real_abs(wave.second)), e);
    let across = scale(real_mul(low, real_abs(wave.first)), e);
    var sinh = Complex(flip_if(along, signs_differ(z.re, wave.second)), scale(real_mul(high, wave.first), e));
    var cosh = Complex(scale(real_mul(high, wave.second), e), flip_if(across, signs_differ(z.re, wave.first)));
    if is_zero(z.im) { // of NaN, too
        sinh.im = z.im;
        cosh.im = flip_if(z.im, sign_is_set(z.re));
    }
    if !is_finite(z.im) {
        let on_axis = is_zero(z.re);
        let nan = make_nan(z.im);
        sinh.re = choose(on_axis || is_infinite(z.re), z.re, nan);
        cosh = Complex(choose(is_infinite(z.re), real_abs(z.re), nan), choose(on_axis, z.re, nan));
    }
    return ComplexPair(sinh, cosh);
}

/// sinh z. Error: 6 u each component.
fn complex_sinh(z: Complex) -> Complex {
    return complex_sinhcosh(z).first;
}

/// cosh z. Error: 6 u each component.
fn complex_cosh(z: Complex) -> Complex {
    return complex_sinhcosh(z).second;
}

/// tanh z = (sinh x cosh x + i sin y cos y) / (sinh² x + cos² y): no term cancels (after Kahan 1987; C99 G.6.2.6).
/// Error: 8 u each component.
fn complex_tanh(z: Complex) -> Complex {
    let wave = real_sincos(z.im);
    if is_infinite(z.re) {
        let below = select(sign_is_set(z.im), signs_differ(wave.first, wave.second), is_finite(z.im));
        return Complex(with_sign(num(1.0), z.re), flip_if(num(0.0), below));
    }
    let h = scaled_sinhcosh(real_abs(z.re));
    // far out cos² y is nothing beside sinh² x, which is a multiple of a power of two
    let norm = real_add(real_square(h.sinh), choose(h.exponent == 0, real_square(wave.second), num(0.0)));
    let re = with_sign(real_div(real_mul(h.sinh, h.cosh), norm), z.re);
    let im = scale(real_div(real_mul(wave.first, wave.second), norm), -2 * h.exponent);
    let lost = !is_finite(z.im) || is_nan(z.re);
    return Complex(
        choose(lost, choose(is_zero(z.re), z.re, make_nan(z.re)), re),
        choose(is_zero(z.im), z.im, choose(lost, make_nan(z.im), im)),
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
    let far = is_above(real_max(real_abs(z.re), b), 4294967296.0); // 1 ± z² is ±z² to working precision
    // in the upper half plane
    let roots = roots_of_sides(z.re, b);
    let minus = roots.first;
    let plus = roots.second;
    let cross = real_add(real_abs(real_mul(minus.re, plus.im)), real_abs(real_mul(minus.im, plus.re)));
    let along = real_add(real_mul(minus.re, plus.re), real_abs(real_mul(minus.im, plus.im)));
    let acos = real_atan2(choose(far, b, minus.re), choose(far, z.re, plus.re));
    return Arc(real_atan2(z.re, choose(far, b, along)), choose(far, acos, twice(acos)), height_of_arc(z, cross, far));
}

/// arsinh of the cross product, log |2 z| of far ones.
fn height_of_arc(z: Complex, cross: real, far: bool) -> real {
    if complex_is_infinite(z) {
        return make_infinity(num(1.0));
    }
    if far {
        let e = complex_exponent(z);
        let v = complex_scale(z, -e);
        let split = split_logarithm(real_add(real_square(v.re), real_square(v.im)));
        return scale(log_of_split(split.exponent + 2 * e + 2, split.fraction), -1);
    }
    // as `real_asinh`
    let square = real_square(cross);
    return real_log1p(real_add(cross, real_div(square, add32(real_sqrt(add32(square, 1.0)), 1.0))));
}

/// √(1 - x - i b) and √(1 + x + i b).
fn roots_of_sides(x: real, b: real) -> ComplexPair {
    var roots = ComplexPair(Complex(x, b), Complex(x, b));
    for (var k = 0u; k < 2u; k++) {
        roots.first = roots.second;
        let minus = k == 0u;
        roots.second = complex_sqrt(Complex(add32(flip_if(x, minus), 1.0), flip_if(b, minus)));
    }
    return roots;
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
    let up = real_add(num(1.0), a);
    let e = complex_exponent(Complex(d, b));
    if is_zero(d) && is_zero(b) {
        return Complex(make_infinity(z.re), z.im);
    }
    let im = mul32(real_atan2(twice(b), real_sub(real_mul(d, up), real_square(b))), 0.5);
    // log(|1 + z|² / |1 - z|²) / 4, beside the pole with |1 - z|² = 4^e norm, else as log1p(4 a / |1 - z|²) / 4
    let near = e < -10;
    let f = select(0, e, near);
    let norm = real_add(real_square(scale(d, -f)), real_square(scale(b, -f)));
    let ratio = real_div(choose(near, real_add(real_square(up), real_square(b)), mul32(a, 4.0)), norm);
    let split = split_logarithm(choose(near, ratio, add32(ratio, 1.0)));
    let fraction = choose(near, split.fraction, split_beside_one(ratio, split.exponent));
    let re = mul32(log_of_split(split.exponent - 2 * f, fraction), 0.25);
    return Complex(with_sign(re, z.re), with_sign(im, z.im));
}

/// arctan z = -i artanh(i z), cuts on the imaginary axis outside [-i, i].
/// Error: 8 u each component.
fn complex_atan(z: Complex) -> Complex {
    return complex_div_i(complex_atanh(complex_mul_i(z)));
}
