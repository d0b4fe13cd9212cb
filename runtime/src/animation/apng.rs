//! Animated PNG.

use std::io::Write;

use super::Clip;
use crate::Error;
use crate::image_file::io_error;

/// Delays are given as whole numbers over this many parts of a second.
const CLOCK: u16 = 1000;

/// Writes all frames.
pub(super) fn encode(
    output: &mut dyn Write,
    clip: Clip,
    draw: &mut dyn FnMut(u32) -> Result<Vec<u8>, Error>,
) -> Result<(), Error> {
    let mut encoder = png::Encoder::new(output, clip.size.width, clip.size.height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_animated(clip.frames, 0).map_err(io_error)?;
    encoder
        .set_frame_delay(delay(clip.rate), CLOCK)
        .map_err(io_error)?;
    let mut writer = encoder.write_header().map_err(io_error)?;
    for frame in 0..clip.frames {
        writer.write_image_data(&draw(frame)?).map_err(io_error)?;
    }
    writer.finish().map_err(io_error)
}

/// Parts of a second from frame to frame.
fn delay(rate: f64) -> u16 {
    let parts = (f64::from(CLOCK) / rate).round();
    parts.clamp(1.0, f64::from(u16::MAX)) as u16
}
