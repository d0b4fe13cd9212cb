//! The project's own benchmarks: the compiler's stages and their growth, operations of derivatives, gradients and integrals
//! beside other ways to find them, frames beside programs that are written by hand, and whether one run is slower than
//! another.

pub mod canvas;
pub mod gradients;
pub mod growth;
pub mod marches;
pub mod operations;
mod stages;
mod statistics;
pub mod twins;
pub mod wgsl;

pub use stages::{STAGES, stages};
pub use statistics::{Ratio, calibration, median, ratio};
