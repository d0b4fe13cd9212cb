// Slopes: derivatives of the inverse functions and of lengths, and the reciprocals of the waves.

/// 1/(1 + x²).
fn real_atan_slope(x: real) -> real {
    return real_div(num(1.0), real_add(num(1.0), real_square(x)));
}

/// 1/(1 - x²).
fn real_atanh_slope(x: real) -> real {
    return real_div(num(1.0), one_minus_square(x));
}

/// 1/√(1 - x²).
fn real_asin_slope(x: real) -> real {
    return real_div(num(1.0), real_sqrt(one_minus_square(x)));
}

/// 1/√(1 + x²).
fn real_asinh_slope(x: real) -> real {
    return real_div(num(1.0), real_hypot(num(1.0), x));
}

/// 1/√(x² - 1), NaN below 1.
fn real_acosh_slope(x: real) -> real {
    let below = real_sqrt(real_sub(x, num(1.0)));
    return real_div(num(1.0), real_mul(below, real_sqrt(real_add(x, num(1.0)))));
}

/// x/r for a coordinate x of a point at the distance r from the origin, and 0 there.
fn real_direction(x: real, y: real, r: real) -> real {
    return choose(is_zero(r), num(0.0), real_div(x, r));
}

/// x/r in space.
fn real_direction3(x: real, y: real, z: real, r: real) -> real {
    return choose(is_zero(r), num(0.0), real_div(x, r));
}

/// 1 - z with the sign of a zero turned, and 1 + z: the sides of the cuts.
fn complex_sides(z: Complex) -> ComplexPair {
    return ComplexPair(
        Complex(real_sub(num(1.0), z.re), real_neg(z.im)),
        Complex(real_add(num(1.0), z.re), z.im),
    );
}

/// 1/(1 + z²) by factors, which do not overflow.
fn complex_atan_slope(z: Complex) -> Complex {
    return complex_atanh_slope(complex_mul_i(z));
}

/// 1/(1 - z²). Error: 10 u of the norm.
fn complex_atanh_slope(z: Complex) -> Complex {
    let sides = complex_sides(Complex(real_abs(z.re), z.im));
    let slope = complex_mul(complex_inverse(sides.first), complex_inverse(sides.second));
    return Complex(slope.re, flip_if(slope.im, sign_is_set(z.re)));
}

/// 1/(√(1 - z) √(1 + z)), whose cuts are those of arcsin (Kahan 1987). Error: 12 u of the norm.
fn complex_asin_slope(z: Complex) -> Complex {
    let sides = complex_sides(Complex(real_abs(z.re), z.im));
    let slope = complex_inverse(complex_mul(complex_sqrt(sides.first), complex_sqrt(sides.second)));
    return Complex(slope.re, flip_if(slope.im, sign_is_set(z.re)));
}

/// 1/(√(1 + i z) √(1 - i z)), whose cuts are those of arsinh. Error: 12 u of the norm.
fn complex_asinh_slope(z: Complex) -> Complex {
    return complex_asin_slope(complex_mul_i(z));
}

/// 1/(√(z - 1) √(z + 1)), whose cut is that of arcosh. Error: 12 u of the norm.
fn complex_acosh_slope(z: Complex) -> Complex {
    let below = complex_sqrt(complex_add_real(z, num(-1.0)));
    return complex_inverse(complex_mul(below, complex_sqrt(complex_add_real(z, num(1.0)))));
}

/// 1/cos x.
fn real_sec(x: real) -> real {
    return real_div(num(1.0), real_cos(x));
}

/// 1/sin x.
fn real_csc(x: real) -> real {
    return real_div(num(1.0), real_sin(x));
}

/// 1/cosh x.
fn real_sech(x: real) -> real {
    return real_div(num(1.0), real_cosh(x));
}

/// 1/sinh x.
fn real_csch(x: real) -> real {
    return real_div(num(1.0), real_sinh(x));
}

/// 1/cos z. Error: 10 u each component.
fn complex_sec(z: Complex) -> Complex {
    return complex_inverse(complex_cos(z));
}

/// 1/sin z. Error: 10 u each component.
fn complex_csc(z: Complex) -> Complex {
    return complex_inverse(complex_sin(z));
}

/// 1/cosh z. Error: 10 u each component.
fn complex_sech(z: Complex) -> Complex {
    return complex_inverse(complex_cosh(z));
}

/// 1/sinh z. Error: 10 u each component.
fn complex_csch(z: Complex) -> Complex {
    return complex_inverse(complex_sinh(z));
}
