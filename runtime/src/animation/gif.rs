//! GIF: the best 256 colours of each frame, and error diffusion between them.

use std::io::Write;

use color_quant::NeuQuant;
use gif::{Encoder, EncodingError, Frame, Repeat};
use image::imageops::{ColorMap, dither, index_colors};
use image::{Rgba, RgbaImage};

use super::Clip;
use crate::Error;

const COLOURS: usize = 256;
/// About how many pixels are looked at for the palette.
const LOOKED_AT: usize = 200_000;
/// More than every so many pixels the quantiser does not take.
const MAX_STRIDE: usize = 30;

/// Writes all frames.
pub(super) fn encode(
    output: &mut dyn Write,
    clip: Clip,
    draw: &mut dyn FnMut(u32) -> Result<Vec<u8>, Error>,
) -> Result<(), Error> {
    let side = |length: u32| u16::try_from(length).map_err(|_| too_large(clip));
    let (width, height) = (side(clip.size.width)?, side(clip.size.height)?);
    let mut encoder = Encoder::new(output, width, height, &[]).map_err(failure)?;
    encoder.set_repeat(Repeat::Infinite).map_err(failure)?;
    for number in 0..clip.frames {
        let pixels = draw(number)?;
        let colours = Palette(NeuQuant::new(stride(pixels.len() / 4), COLOURS, &pixels));
        let mut picture = RgbaImage::from_raw(clip.size.width, clip.size.height, pixels)
            .ok_or_else(|| too_large(clip))?;
        dither(&mut picture, &colours);
        let indices = index_colors(&picture, &colours);
        let palette = colours.0.color_map_rgb();
        let mut frame =
            Frame::from_palette_pixels(width, height, indices.into_raw(), palette, None);
        frame.delay = delay(clip.rate);
        encoder.write_frame(&frame).map_err(failure)?;
    }
    Ok(())
}

/// Every how many pixels one is looked at for the palette.
fn stride(pixels: usize) -> i32 {
    let stride = pixels.div_ceil(LOOKED_AT).clamp(1, MAX_STRIDE);
    i32::try_from(stride).unwrap_or(1)
}

/// The colours of a frame, as the error diffusion wants them.
struct Palette(NeuQuant);

impl ColorMap for Palette {
    type Color = Rgba<u8>;

    fn index_of(&self, color: &Self::Color) -> usize {
        self.0.index_of(&color.0)
    }

    fn map_color(&self, color: &mut Self::Color) {
        self.0.map_pixel(&mut color.0);
    }
}

/// Hundredths of a second from frame to frame; fewer than two are shown slowly by many programs.
fn delay(rate: f64) -> u16 {
    (100.0 / rate).round().clamp(2.0, f64::from(u16::MAX)) as u16
}

fn too_large(clip: Clip) -> Error {
    Error::Invalid {
        reason: format!(
            "a GIF of {}x{} pixels: each side can be at most 65535",
            clip.size.width, clip.size.height
        ),
    }
}

fn failure(error: EncodingError) -> Error {
    Error::Io(match error {
        EncodingError::Io(error) => error,
        other => std::io::Error::other(other),
    })
}
