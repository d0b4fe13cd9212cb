// Two functions of one argument at the price of little more than one: a function and its derivative are often both
// wanted. Each result is that of the single function, bit for bit.

/// (sinh z, cosh z)
fn complex_sinhcosh(z: Complex) -> ComplexPair {
    if is_zero(z.im) || !is_finite(z.im) || is_infinite(z.re) {
        return ComplexPair(complex_sinh(z), complex_cosh(z));
    }
    let wave = real_sincos(z.im);
    let h = scaled_sinhcosh(z.re);
    return ComplexPair(sinh_of_parts(z, wave, h), cosh_of_parts(z, wave, h));
}

/// (sin z, cos z)
fn complex_sincos(z: Complex) -> ComplexPair {
    let waves = complex_sinhcosh(complex_mul_i(z));
    return ComplexPair(complex_div_i(waves.first), waves.second);
}
