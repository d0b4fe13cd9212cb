//! Slopes: derivatives of the inverse functions and of lengths, real and complex, without overflow on the way.

use super::complex::{Complex, complex};

/// 1/(1 + x²).
pub fn atan(x: f64) -> f64 {
    1.0 / (1.0 + x * x)
}

/// 1/(1 - x²).
pub fn atanh(x: f64) -> f64 {
    1.0 / ((1.0 - x) * (1.0 + x))
}

/// 1/√(1 - x²).
pub fn asin(x: f64) -> f64 {
    1.0 / ((1.0 - x) * (1.0 + x)).sqrt()
}

/// 1/√(1 + x²).
pub fn asinh(x: f64) -> f64 {
    1.0 / 1.0_f64.hypot(x)
}

/// 1/√(x² - 1), NaN below 1.
pub fn acosh(x: f64) -> f64 {
    1.0 / ((x - 1.0).sqrt() * (x + 1.0).sqrt())
}

/// x/r for a coordinate x of a point at the distance r from the origin, and 0 there.
pub fn direction(x: f64, r: f64) -> f64 {
    if r == 0.0 { 0.0 } else { x / r }
}

/// 1 - z with the sign of a zero turned, and 1 + z: the sides of the cuts.
fn sides(z: Complex) -> (Complex, Complex) {
    (complex(1.0 - z.re, -z.im), complex(1.0 + z.re, z.im))
}

/// 1/(1 + z²).
pub fn complex_atan(z: Complex) -> Complex {
    complex_atanh(z.mul_i())
}

/// 1/(1 - z²).
pub fn complex_atanh(z: Complex) -> Complex {
    let (below, above) = sides(z);
    below.inverse() * above.inverse()
}

/// 1/(√(1 - z) √(1 + z)), whose cuts are those of arcsin (Kahan 1987).
pub fn complex_asin(z: Complex) -> Complex {
    let (below, above) = sides(z);
    (below.sqrt() * above.sqrt()).inverse()
}

/// 1/(√(1 + i z) √(1 - i z)), whose cuts are those of arsinh.
pub fn complex_asinh(z: Complex) -> Complex {
    complex_asin(z.mul_i())
}

/// 1/(√(z - 1) √(z + 1)), whose cut is that of arcosh.
pub fn complex_acosh(z: Complex) -> Complex {
    let (below, above) = (complex(z.re - 1.0, z.im), complex(z.re + 1.0, z.im));
    (below.sqrt() * above.sqrt()).inverse()
}
