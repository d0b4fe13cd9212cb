//! The f64 truth: what each real and complex operator *means*.
//!
//! Pure functions without input, output or panics. Branch cuts, signed zeros and infinities follow Annex G of
//! ISO/IEC 9899 (C99); components are accurate, not only norms. The shader library in `shaders/math` and every
//! other evaluator are judged against this one.

pub mod arc;
pub mod bessel;
pub mod cardinal;
pub mod complex;
pub mod erf;
pub mod gamma;
pub mod hash;
pub mod polygamma;
pub mod rational;
pub mod real;
pub mod slope;
pub mod wave;

pub use complex::Complex;

#[cfg(test)]
mod tests;
