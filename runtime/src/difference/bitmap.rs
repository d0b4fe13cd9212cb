//! A picture in memory, as files and renderers give it.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Seek};
use std::path::Path;

use crate::image_file::srgb_encode;
use crate::render::MAX_SIDE;
use crate::{Error, Size};

/// An opaque picture in 8-bit sRGB, rows from top to bottom.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bitmap {
    size: Size,
    rgb: Vec<u8>,
}

impl Bitmap {
    /// The picture of these rows of red, green, blue and an alpha that is left out: what a
    /// [`RowSink`](crate::RowSink) is given.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are not as many bytes as the size says.
    pub fn from_rgba(size: Size, rgba: &[u8]) -> Result<Self, Error> {
        if rgba.len() as u64 != pixels(size) * 4 {
            return Err(Error::Invalid {
                reason: format!(
                    "{} bytes for a picture of {}x{} pixels",
                    rgba.len(),
                    size.width,
                    size.height
                ),
            });
        }
        let rgb = rgba.as_chunks::<4>().0.iter();
        Ok(Self {
            size,
            rgb: rgb.flat_map(|&[r, g, b, _]| [r, g, b]).collect(),
        })
    }

    /// The picture of pixels of linear light, premultiplied by alpha, before black; without dithering.
    ///
    /// # Errors
    /// As [`Self::from_rgba`].
    pub fn from_linear(size: Size, linear: &[[f32; 4]]) -> Result<Self, Error> {
        let byte = |x: f32| (srgb_encode(x) * 255.0).round() as u8;
        let rgba = linear
            .iter()
            .flat_map(|&[r, g, b, _]| [byte(r), byte(g), byte(b), 255]);
        Self::from_rgba(size, &rgba.collect::<Vec<_>>())
    }

    /// The picture as a PNG file.
    ///
    /// # Errors
    /// [`Error::Io`] if the encoder refuses its size.
    pub fn png(&self) -> Result<Vec<u8>, Error> {
        let mut out = Vec::new();
        let mut encoder = png::Encoder::new(&mut out, self.size.width, self.size.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let written = encoder.write_header().and_then(|mut writer| {
            writer.write_image_data(&self.rgb)?;
            writer.finish()
        });
        written.map_err(io::Error::from)?;
        Ok(out)
    }

    /// Reads a PNG file of any kind. 16 bits are cut to 8; colours are taken for sRGB, whatever the file says of them.
    ///
    /// # Errors
    /// [`io::ErrorKind::InvalidData`] if it is no PNG, is damaged, has transparent pixels, or a side longer than
    /// [`MAX_SIDE`]; else the system's.
    pub fn read_png(path: &Path) -> io::Result<Self> {
        Self::decode_png(BufReader::new(File::open(path)?))
    }

    fn decode_png(input: impl BufRead + Seek) -> io::Result<Self> {
        let mut decoder = png::Decoder::new(input);
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().map_err(unreadable)?;
        let size = Size {
            width: reader.info().width,
            height: reader.info().height,
        };
        if size.width > MAX_SIDE || size.height > MAX_SIDE {
            return Err(invalid(format!(
                "a picture of {}x{} pixels: each side may be {MAX_SIDE} at most",
                size.width, size.height
            )));
        }
        let bytes = reader.output_buffer_size();
        let mut data = vec![0; bytes.ok_or_else(|| invalid("the picture is too large".into()))?];
        let frame = reader.next_frame(&mut data).map_err(unreadable)?;
        data.truncate(frame.buffer_size());
        Ok(Self {
            size,
            rgb: opaque(data, frame.color_type.samples())?,
        })
    }

    /// Width and height.
    #[must_use]
    pub fn size(&self) -> Size {
        self.size
    }

    /// Red, green and blue of every pixel.
    #[must_use]
    pub fn pixels(&self) -> &[[u8; 3]] {
        self.rgb.as_chunks::<3>().0
    }

    /// The same, byte by byte, of `count` rows from `top` on; fewer where the picture ends.
    pub(super) fn rows(&self, top: u32, count: u32) -> &[u8] {
        let row = self.size.width as usize * 3;
        let end = top.saturating_add(count).min(self.size.height);
        self.rgb
            .get(top as usize * row..end as usize * row)
            .unwrap_or_default()
    }
}

fn pixels(size: Size) -> u64 {
    u64::from(size.width) * u64::from(size.height)
}

/// Red, green and blue of pixels of so many samples: grey, or colour, and alpha behind that in even numbers.
fn opaque(data: Vec<u8>, samples: usize) -> io::Result<Vec<u8>> {
    if samples.is_multiple_of(2)
        && data
            .chunks_exact(samples)
            .any(|p| p[samples - 1] != u8::MAX)
    {
        return Err(invalid(
            "has transparent pixels; put it on a background first".into(),
        ));
    }
    Ok(match samples {
        3 => data,
        4 => {
            let pixels = data.chunks_exact(4);
            pixels.flat_map(|p| [p[0], p[1], p[2]]).collect()
        }
        _ => {
            let pixels = data.chunks_exact(samples.max(1));
            pixels.flat_map(|p| [p[0]; 3]).collect()
        }
    })
}

fn unreadable(error: png::DecodingError) -> io::Error {
    match error {
        png::DecodingError::IoError(error) if error.kind() != io::ErrorKind::UnexpectedEof => error,
        png::DecodingError::IoError(_) => invalid("the file ends too early".into()),
        other => {
            let reason = other.to_string();
            invalid(format!(
                "not a readable PNG: {}",
                reason.trim_end_matches('.')
            ))
        }
    }
}

fn invalid(reason: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, reason)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Size = Size {
        width: 2,
        height: 1,
    };

    fn encoded(color: png::ColorType, depth: png::BitDepth, data: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, SIZE.width, SIZE.height);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if color == png::ColorType::Indexed {
            encoder.set_palette(vec![9, 8, 7, 1, 2, 3]);
        }
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(data).unwrap();
        writer.finish().unwrap();
        bytes
    }

    #[test]
    fn every_kind_of_file_becomes_rgb() {
        use png::BitDepth::{Eight, One, Sixteen};
        use png::ColorType::{Grayscale, GrayscaleAlpha, Indexed, Rgb, Rgba};
        let check = |color, depth, data: &[u8], expected: [[u8; 3]; 2]| {
            let found = Bitmap::decode_png(io::Cursor::new(encoded(color, depth, data))).unwrap();
            assert_eq!(found.pixels(), expected, "{color:?} {depth:?}");
            assert_eq!(found.size(), SIZE);
        };
        check(Rgb, Eight, &[1, 2, 3, 4, 5, 6], [[1, 2, 3], [4, 5, 6]]);
        check(
            Rgba,
            Eight,
            &[1, 2, 3, 255, 4, 5, 6, 255],
            [[1, 2, 3], [4, 5, 6]],
        );
        check(Grayscale, Eight, &[7, 9], [[7; 3], [9; 3]]);
        check(GrayscaleAlpha, Eight, &[7, 255, 9, 255], [[7; 3], [9; 3]]);
        check(Grayscale, Sixteen, &[7, 200, 9, 0], [[7; 3], [9; 3]]);
        check(Indexed, One, &[0b0100_0000], [[9, 8, 7], [1, 2, 3]]);
    }

    #[test]
    fn what_cannot_be_compared_is_refused() {
        let check = |bytes: Vec<u8>, expected: &str| {
            let found = Bitmap::decode_png(io::Cursor::new(bytes)).unwrap_err();
            assert_eq!(found.kind(), io::ErrorKind::InvalidData);
            assert!(found.to_string().contains(expected), "{found}");
        };
        let whole = encoded(png::ColorType::Rgb, png::BitDepth::Eight, &[0; 6]);
        check(b"no picture".to_vec(), "PNG");
        check(Vec::new(), "ends too early");
        check(whole[..whole.len() / 2].to_vec(), "");
        let mut huge = whole.clone();
        huge[16..20].copy_from_slice(&1_000_000u32.to_be_bytes());
        check(huge, "");
        let glass = [0, 0, 0, 255, 0, 0, 0, 254];
        check(
            encoded(png::ColorType::Rgba, png::BitDepth::Eight, &glass),
            "transparent",
        );
    }

    #[test]
    fn rows_beyond_the_end_are_left_out() {
        let picture = Bitmap::from_rgba(SIZE, &[1, 2, 3, 255, 4, 5, 6, 255]).unwrap();
        assert_eq!(picture.rows(0, 9), [1, 2, 3, 4, 5, 6]);
        assert!(picture.rows(1, 1).is_empty());
        assert!(Bitmap::from_rgba(SIZE, &[0; 7]).is_err());
    }
}
