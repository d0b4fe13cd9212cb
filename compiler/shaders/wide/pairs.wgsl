// Two functions of one argument at the price of little more than one: a function and its derivative are often both
// wanted. Each result is that of the single function, bit for bit.

/// (sin z, cos z)
fn complex_sincos(z: Complex) -> ComplexPair {
    let waves = complex_sinhcosh(complex_mul_i(z));
    return ComplexPair(complex_div_i(waves.first), waves.second);
}
