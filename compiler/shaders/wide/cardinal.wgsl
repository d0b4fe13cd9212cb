// Waves and exponentials divided by their argument: 1 at 0, and finite as long as the quotient is.

/// sinh x / x, 1 at 0; beyond 20 from e^x / 2, scaled after the division.
/// Error: 4 u.
fn real_sinhc(x: real) -> real {
    let a = real_abs(x);
    if is_below(a, 1e-12) {
        return num(1.0);
    }
    if is_above(a, EXP_END) {
        return make_infinity(a);
    }
    if is_above(a, 20.0) {
        let e = exp_of_parts(a);
        return scale(real_div(e.value, a), e.exponent - 1);
    }
    return real_div(real_sinh(a), a);
}

/// (e^x - 1)/x, 1 at 0, 0 at -∞; beyond 45, where the 1 is lost in both formats, from e^x, scaled after the division.
/// Error: 4 u.
fn real_exprel(x: real) -> real {
    if is_below(real_abs(x), 1e-17) {
        return num(1.0);
    }
    if is_above(x, EXP_END) {
        return make_infinity(x);
    }
    if is_infinite(x) {
        return num(0.0);
    }
    if is_above(x, 45.0) {
        let e = exp_of_parts(x);
        return scale(real_div(e.value, x), e.exponent);
    }
    return real_div(real_expm1(x), x);
}

/// sinh z / z. Far out by half the argument, whose functions do not overflow before the quotient does.
/// Error: 16 u of the norm.
fn complex_sinhc(z: Complex) -> Complex {
    if is_zero(z.im) {
        return Complex(real_sinhc(z.re), flip_if(z.im, sign_is_set(z.re)));
    }
    if is_zero(z.re) {
        return Complex(real_sinc(z.im), flip_if(z.re, sinc_turns(z.im)));
    }
    if is_infinite(z.re) {
        return complex_sinh(Complex(real_abs(z.re), flip_if(z.im, sign_is_set(z.re))));
    }
    if is_below(real_abs(z.re), 1e-7) && is_below(real_abs(z.im), 1e-7) {
        let square = real_mul(real_sub(z.re, z.im), real_add(z.re, z.im));
        return Complex(
            add32(real_div(square, num(6.0)), 1.0),
            real_div(real_mul(z.re, z.im), num(3.0)),
        );
    }
    if is_above(real_abs(z.re), 80.0) {
        let half = complex_scale(z, -1);
        let sinh = complex_sinh(half);
        if complex_is_infinite(sinh) {
            return overflowed_quotient(Complex(real_abs(z.re), flip_if(z.im, sign_is_set(z.re))));
        }
        return complex_mul(complex_div(sinh, half), complex_cosh(half));
    }
    return complex_div(complex_sinh(z), z);
}

/// e^z/z where that overflows: an infinity in each part.
fn overflowed_quotient(z: Complex) -> Complex {
    let wave = real_sincos(z.im);
    let size = real_max(real_abs(z.re), real_abs(z.im));
    let w = Complex(real_div(z.re, size), real_div(z.im, size));
    let re = real_add(real_mul(wave.second, w.re), real_mul(wave.first, w.im));
    let im = real_sub(real_mul(wave.first, w.re), real_mul(wave.second, w.im));
    return Complex(make_infinity(re), make_infinity(im));
}

/// Whether -sinc' y is negative.
fn sinc_turns(y: real) -> bool {
    let falls = is_below(real_abs(y), 1.0) || real_less(real_cos(y), real_sinc(y));
    return falls == sign_is_set(y);
}

/// sin z / z = sinh(i z) / (i z).
/// Error: 16 u of the norm.
fn complex_sinc(z: Complex) -> Complex {
    return complex_sinhc(complex_mul_i(z));
}

/// (e^z - 1)/z. Far out e^(z/2) (e^(z/2)/z).
/// Error: 16 u of the norm.
fn complex_exprel(z: Complex) -> Complex {
    if is_zero(z.im) {
        return Complex(real_exprel(z.re), z.im);
    }
    if is_infinite(z.re) && !sign_is_set(z.re) {
        return complex_exp(z);
    }
    if is_below(real_abs(z.re), 1e-17) && is_below(real_abs(z.im), 1e-17) {
        return Complex(num(1.0), scale(z.im, -1));
    }
    if is_above(z.re, 80.0) {
        let half = complex_exp(complex_scale(z, -1));
        if complex_is_infinite(half) {
            return overflowed_quotient(z);
        }
        return complex_mul(half, complex_div(half, z));
    }
    return complex_div(complex_expm1(z), z);
}
