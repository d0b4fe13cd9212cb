//! Pictures from linear light: 16 bits of sRGB in a PNG, half or single precision in an OpenEXR file.

use std::io::{self, Cursor, Write};

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec, Text,
    WritableImage, f16,
};

use super::{Alpha, Metadata};
use crate::{Error, RowSink, Size};

/// Most pixels of an OpenEXR picture, which is held in memory: 1 GiB of them.
pub const MAX_LINEAR_PIXELS: u64 = 1 << 26;

/// How precise a number of a picture is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Depth {
    /// 8 bits, from 0 to 1.
    Eight,
    /// 16 bits: whole numbers from 0 to 1 in a PNG, binary16 in an OpenEXR file.
    Sixteen,
    /// binary32; OpenEXR only.
    ThirtyTwo,
}

/// sRGB of linear light in 0..1 (IEC 61966-2-1), in f64 so that 16 bits are right.
pub(crate) fn srgb_encode(linear: f32) -> f64 {
    let x = f64::from(linear);
    if x.is_nan() {
        0.0
    } else if x <= 0.003_130_8 {
        12.92 * x.max(0.0)
    } else {
        1.055 * x.min(1.0).powf(1.0 / 2.4) - 0.055
    }
}

/// sRGB that is not premultiplied, and alpha, of a pixel of linear light that is. Light of more than its alpha is cut off.
fn straight([r, g, b, a]: [f32; 4], alpha: Alpha) -> [f64; 4] {
    let a = match alpha {
        Alpha::LeftOut => 1.0,
        // not a number is no alpha
        Alpha::Kept => a.clamp(0.0, 1.0),
    };
    let part = |x: f32| srgb_encode(if a > 0.0 { x / a } else { 0.0 });
    [part(r), part(g), part(b), f64::from(a)]
}

/// Rows of linear `f32`, premultiplied, on their way to 16 bits of sRGB, not premultiplied, most significant byte first.
pub(super) struct Png16Rows<W: Write> {
    pub(super) stream: W,
    pub(super) alpha: Alpha,
    pub(super) line: Vec<u8>,
}

impl<W: Write> RowSink for Png16Rows<W> {
    fn rows(&mut self, pixels: &[u8]) -> io::Result<()> {
        self.line.clear();
        for pixel in pixels.as_chunks::<16>().0 {
            let numbers = [0, 1, 2, 3].map(|k| f32::from_le_bytes(pixel.as_chunks::<4>().0[k]));
            let straight = straight(numbers, self.alpha);
            for part in &straight[..self.alpha.channels()] {
                let whole = (part * 65535.0).round() as u16;
                self.line.extend(whole.to_be_bytes());
            }
        }
        self.stream.write_all(&self.line)
    }
}

/// The bytes of an OpenEXR file of linear light with alpha, in half or single precision, from the rows that `draw` gives.
///
/// # Errors
/// Those of `draw`, and [`Error::Invalid`] for more pixels than [`MAX_LINEAR_PIXELS`].
pub(super) fn exr(
    size: Size,
    depth: Depth,
    metadata: &Metadata,
    draw: impl FnOnce(&mut dyn RowSink) -> Result<(), Error>,
) -> Result<Vec<u8>, Error> {
    let pixels = u64::from(size.width) * u64::from(size.height);
    if pixels > MAX_LINEAR_PIXELS {
        return Err(Error::Invalid {
            reason: format!(
                "{pixels} pixels of linear light: at most {MAX_LINEAR_PIXELS} are held in memory"
            ),
        });
    }
    let mut rows = Vec::with_capacity(pixels as usize * 16);
    draw(&mut rows)?;
    encode_exr(size, depth, metadata, &rows)
}

/// The file of rows of linear `f32`.
fn encode_exr(
    size: Size,
    depth: Depth,
    metadata: &Metadata,
    rows: &[u8],
) -> Result<Vec<u8>, Error> {
    let channel = |name: &str, at: usize| {
        let numbers = rows.as_chunks::<16>().0.iter().map(|pixel| {
            let bytes = pixel.as_chunks::<4>().0[at];
            f32::from_le_bytes(bytes)
        });
        let samples = match depth {
            Depth::ThirtyTwo => FlatSamples::F32(numbers.collect()),
            Depth::Eight | Depth::Sixteen => FlatSamples::F16(numbers.map(f16::from_f32).collect()),
        };
        AnyChannel::new(name, samples)
    };
    let channels: SmallVec<_> = [("A", 3), ("B", 2), ("G", 1), ("R", 0)]
        .into_iter()
        .map(|(name, at)| channel(name, at))
        .collect();
    let mut attributes = LayerAttributes::default();
    let comments: Vec<String> = metadata
        .0
        .iter()
        .map(|(keyword, text)| format!("{keyword}: {text}"))
        .collect();
    // in UTF-8, where the crate's own way takes a letter for a byte and refuses those above 255
    let comments = comments.join("\n");
    attributes.comments = Some(Text::from_slice_unchecked(comments.as_bytes()));
    let layer = Layer::new(
        (size.width as usize, size.height as usize),
        attributes,
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(channels),
    );
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .to_buffered(&mut bytes)
        .map_err(|error| match error {
            exr::error::Error::Io(error) => Error::Io(error),
            other => Error::Io(io::Error::other(other)),
        })?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use exr::prelude::{ReadChannels, ReadLayers, read};

    use super::super::{Alpha, Format, write};
    use super::*;

    const SIZE: Size = Size {
        width: 2,
        height: 2,
    };
    const PIXELS: [[f32; 4]; 4] = [
        [0.0, 0.5, 1.0, 1.0],
        [0.002, 0.25, 7.5, 0.5],
        [-1.0, 1e-3, 0.214_041_14, 1.0],
        [1.0, 2.0, 3.0, 0.0],
    ];

    fn draw(sink: &mut dyn RowSink) -> Result<(), Error> {
        for row in PIXELS.chunks(2) {
            let bytes: Vec<u8> = row
                .as_flattened()
                .iter()
                .flat_map(|x| x.to_le_bytes())
                .collect();
            sink.rows(&bytes)?;
        }
        Ok(())
    }

    fn png_of_16_bits(alpha: Alpha) -> Vec<u16> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        write(
            &path,
            (Format::Png16, alpha),
            SIZE,
            &Metadata::default(),
            draw,
        )
        .unwrap();
        let file = io::BufReader::new(std::fs::File::open(path).unwrap());
        let mut reader = png::Decoder::new(file).read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut bytes).unwrap();
        let pairs = bytes.as_chunks::<2>().0.iter();
        pairs.map(|pair| u16::from_be_bytes(*pair)).collect()
    }

    #[test]
    fn a_png_of_16_bits_holds_srgb() {
        // 65535 times IEC 61966-2-1 of each channel, by another program (Python, decimal arithmetic)
        let expected = [
            [0, 48192, 65535],
            [1693, 35199, 65535],
            [0, 847, 32768],
            [65535, 65535, 65535],
        ];
        assert_eq!(png_of_16_bits(Alpha::LeftOut), expected.as_flattened());
    }

    #[test]
    fn a_png_of_16_bits_holds_colours_that_are_not_premultiplied() {
        // by the same program, of the channels divided by alpha
        let expected = [
            [0, 48192, 65535, 65535],
            [3323, 48192, 65535, 32768],
            [0, 847, 32768, 65535],
            [0, 0, 0, 0],
        ];
        assert_eq!(png_of_16_bits(Alpha::Kept), expected.as_flattened());
    }

    #[test]
    fn an_exr_holds_linear_light() {
        let folder = tempfile::tempdir().unwrap();
        let formula = "x² + π ≤ z̄, 波";
        let metadata = Metadata(vec![("Formula", formula.into()), ("Software", "é".into())]);
        for (format, error) in [(Format::ExrFloat, 0.0), (Format::ExrHalf, 0.5_f32.powi(11))] {
            let path = folder.path().join("a.exr");
            write(&path, (format, Alpha::Kept), SIZE, &metadata, draw).unwrap();
            let image = read()
                .no_deep_data()
                .largest_resolution_level()
                .all_channels()
                .first_valid_layer()
                .all_attributes()
                .from_file(path)
                .unwrap();
            let comments = image.layer_data.attributes.comments.unwrap();
            let told = format!("Formula: {formula}\nSoftware: é");
            assert_eq!(std::str::from_utf8(comments.as_slice()), Ok(told.as_str()));
            let channels = &image.layer_data.channel_data.list;
            let names: Vec<String> = channels.iter().map(|c| c.name.to_string()).collect();
            assert_eq!(names, ["A", "B", "G", "R"]);
            for (channel, at) in channels.iter().zip([3, 2, 1, 0]) {
                let found = channel.sample_data.values_as_f32();
                for (found, pixel) in found.zip(PIXELS) {
                    assert!((found - pixel[at]).abs() <= error * pixel[at].abs());
                }
            }
        }
    }

    #[test]
    fn formats_by_name_and_bits() {
        let format = |name: &str, bits| Format::of(std::path::Path::new(name), bits);
        assert_eq!(format("a.png", None), Ok(Format::Png8));
        assert_eq!(format("a", Some(16)), Ok(Format::Png16));
        assert_eq!(format("a.EXR", None), Ok(Format::ExrFloat));
        assert_eq!(format("a.exr", Some(16)), Ok(Format::ExrHalf));
        assert!(format("a.exr", Some(8)).unwrap_err().contains("16 or 32"));
        assert!(format("a.png", Some(32)).unwrap_err().contains("8 or 16"));
    }
}
