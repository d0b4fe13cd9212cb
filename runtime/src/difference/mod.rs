//! How two pictures of one size differ: in numbers, and to the eye.

mod bitmap;
mod linear;
mod numeric;
mod perceptual;

pub use bitmap::Bitmap;
pub use linear::Light;
pub use numeric::{Channel, Numeric, SHARES};
pub use perceptual::{PIXELS_PER_DEGREE, Perceptual, heat_map};

use crate::{Error, Size};

/// Both judgements of two pictures.
#[derive(Clone, Debug)]
pub struct Difference {
    /// Pixels of either picture.
    pub size: Size,
    /// In linear light.
    pub numeric: Numeric,
    /// To the eye.
    pub perceptual: Perceptual,
}

/// Compares two pictures; the first is the one to be compared with.
///
/// # Errors
/// [`Error::Invalid`] if their sizes differ.
pub fn compare(
    truth: &Bitmap,
    test: &Bitmap,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Difference, Error> {
    let [a, b] = [truth.size(), test.size()];
    if a != b {
        return Err(Error::Invalid {
            reason: format!(
                "pictures of {}x{} and {}x{} pixels cannot be compared: their sizes differ",
                a.width, a.height, b.width, b.height
            ),
        });
    }
    Ok(Difference {
        size: a,
        numeric: Numeric::new(truth, test),
        perceptual: Perceptual::new(truth, test, progress)?,
    })
}
