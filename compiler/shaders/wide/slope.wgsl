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
    return real_direction3(x, y, num(0.0), r);
}

/// x/r in space. Where r overflows, that of a quarter of the point.
fn real_direction3(x: real, y: real, z: real, r: real) -> real {
    var part = x;
    var whole = r;
    if is_infinite(r) && is_finite(x) && is_finite(y) && is_finite(z) {
        part = scale(x, -2);
        whole = real_hypot3(part, scale(y, -2), scale(z, -2));
    }
    return choose(is_zero(r), num(0.0), real_div(part, whole));
}

/// 1/(1 + z²).
fn complex_atan_slope(z: Complex) -> Complex {
    return complex_atanh_slope(complex_mul_i(z));
}

/// 1/(1 - z²), of a z scaled by a power of two where its square would overflow. Error: 8 u each component.
fn complex_atanh_slope(z: Complex) -> Complex {
    let top = complex_exponent(z);
    let e = select(0, top, top > 30);
    let v = complex_scale(z, -e);
    let re = sum_of_products(real_neg(v.re), v.re, v.im, v.im, scale(num(1.0), -2 * e));
    let im = real_neg(twice(real_mul(v.re, v.im)));
    return complex_scale(complex_inverse(Complex(re, im)), -2 * e);
}

/// 1/(√(1 - z) √(1 + z)), whose cuts are those of arcsin (Kahan 1987). The real part of the product of the roots is a sum
/// of terms of one sign, and the product of both parts is -x y. Error: 12 u each component.
fn complex_asin_slope(z: Complex) -> Complex {
    let roots = roots_of_sides(z.re, z.im);
    let minus = roots.first;
    let plus = roots.second;
    let re = real_add(real_mul(minus.re, plus.re), real_abs(real_mul(minus.im, plus.im)));
    let plain = real_add(real_mul(minus.re, plus.im), real_mul(minus.im, plus.re));
    return complex_inverse(Complex(re, other_part(real_neg(z.re), z.im, re, plain)));
}

/// A part of a product of roots, as a sum of two terms and as x y / part: the sum where it is the greater part, for then
/// little of it cancels, else the quotient.
fn other_part(x: real, y: real, part: real, sum: real) -> real {
    return choose(real_less(real_abs(part), real_abs(sum)), sum, real_mul(x, real_div(y, part)));
}

/// 1/(√(1 + i z) √(1 - i z)), whose cuts are those of arsinh. Error: 12 u each component.
fn complex_asinh_slope(z: Complex) -> Complex {
    return complex_asin_slope(complex_mul_i(z));
}

/// 1/(√(z - 1) √(z + 1)), whose cut is that of arcosh: the imaginary part of the product is a sum of terms of one sign.
/// Error: 12 u each component.
fn complex_acosh_slope(z: Complex) -> Complex {
    let roots = roots_of_sides(z.re, z.im);
    let plus = roots.second;
    // √(z - 1) = ±i √(1 - z), the sign that of the imaginary part of z
    let below = complex_choose(sign_is_set(z.im), complex_div_i(roots.first), complex_mul_i(roots.first));
    let im = real_add(real_mul(below.re, plus.im), real_mul(below.im, plus.re));
    let plain = real_sub(real_mul(below.re, plus.re), real_mul(below.im, plus.im));
    return complex_inverse(Complex(other_part(z.re, z.im, im, plain), im));
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
