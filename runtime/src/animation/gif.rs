//! GIF: the best 256 colours of each frame, and error diffusion between them.

use std::io::Write;

use color_quant::NeuQuant;
use gif::{Encoder, EncodingError, Frame, Repeat};

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
        let colours = NeuQuant::new(stride(pixels.len() / 4), COLOURS, &pixels);
        let indices = diffuse(&pixels, usize::from(width), &colours);
        let palette = colours.color_map_rgb();
        let mut frame = Frame::from_palette_pixels(width, height, indices, palette, None);
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

/// The nearest colour of each pixel, after what its neighbours lack has been added: 7/16 of it to the next pixel, 3/16,
/// 5/16 and 1/16 to those below (R. W. Floyd, L. Steinberg, "An adaptive algorithm for spatial greyscale", 1976).
fn diffuse(rgba: &[u8], width: usize, colours: &NeuQuant) -> Vec<u8> {
    let mut indices = Vec::with_capacity(rgba.len() / 4);
    // one place more at either end takes what falls off the sides
    let mut lacking = vec![[0.0_f32; 3]; width + 2];
    let mut below = lacking.clone();
    for row in rgba.chunks_exact(4 * width) {
        for (x, pixel) in row.as_chunks::<4>().0.iter().enumerate() {
            let mut wanted = [0.0; 3];
            for c in 0..3 {
                wanted[c] = (f32::from(pixel[c]) + lacking[x + 1][c]).clamp(0.0, 255.0);
            }
            let [r, g, b] = wanted.map(|value| value.round() as u8);
            let index = colours.index_of(&[r, g, b, 255]);
            indices.push(index as u8);
            let found = colours.lookup(index).unwrap_or_default();
            for c in 0..3 {
                let error = wanted[c] - f32::from(found[c]);
                lacking[x + 2][c] += error * (7.0 / 16.0);
                below[x][c] += error * (3.0 / 16.0);
                below[x + 1][c] += error * (5.0 / 16.0);
                below[x + 2][c] += error * (1.0 / 16.0);
            }
        }
        std::mem::swap(&mut lacking, &mut below);
        below.fill([0.0; 3]);
    }
    indices
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
