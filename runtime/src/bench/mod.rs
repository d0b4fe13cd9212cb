//! Times of the compiler's stages and of pictures, and whether one run is slower than another.

mod stages;
mod statistics;

pub use stages::{STAGES, stages};
pub use statistics::{Ratio, calibration, median, ratio};
