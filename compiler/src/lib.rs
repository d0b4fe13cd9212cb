//! The compiler.

pub mod reference;
