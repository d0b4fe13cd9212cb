//! PNG and OpenEXR files, complete or not at all, with a note of how the picture came about.

mod linear;

pub use linear::MAX_LINEAR_PIXELS;
pub(crate) use linear::srgb_encode;

use std::io::{self, Write};
use std::path::Path;

use linear::{Depth, Png16Rows};

use crate::{AtomicFile, Error, RowSink, Size};

/// Bytes of compressed data in a chunk.
const CHUNK: usize = 1 << 16;
/// Pictures of more pixels are compressed quickly rather than well.
const QUICK_FROM: u64 = 4_000_000;

/// What a picture file says of itself: keywords and texts, in order.
///
/// Keywords are Latin-1 of at most 79 characters; texts any Unicode. Put no names of files in here.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Metadata(pub Vec<(&'static str, String)>);

/// What a picture's file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// PNG, 8 bits of sRGB.
    Png8,
    /// PNG, 16 bits of sRGB.
    Png16,
    /// OpenEXR, linear light and alpha in binary16.
    ExrHalf,
    /// OpenEXR, linear light and alpha in binary32.
    ExrFloat,
}

impl Format {
    /// The format that a file's name and the wanted bits of a number ask for.
    ///
    /// # Errors
    /// The file cannot hold numbers of so many bits.
    pub fn of(path: &Path, bits: Option<u32>) -> Result<Self, String> {
        let is_exr = path
            .extension()
            .is_some_and(|extension| extension.eq_ignore_ascii_case("exr"));
        match (is_exr, bits) {
            (false, None | Some(8)) => Ok(Self::Png8),
            (false, Some(16)) => Ok(Self::Png16),
            (true, Some(16)) => Ok(Self::ExrHalf),
            (true, None | Some(32)) => Ok(Self::ExrFloat),
            (false, Some(bits)) => Err(format!("a PNG has numbers of 8 or 16 bits, not {bits}")),
            (true, Some(bits)) => Err(format!(
                "an OpenEXR file has numbers of 16 or 32 bits, not {bits}"
            )),
        }
    }

    /// Whether it is made from rows of linear `f32`; 8 bits of sRGB otherwise.
    #[must_use]
    pub fn is_linear(self) -> bool {
        self != Self::Png8
    }
}

/// Whether a PNG holds alpha. An OpenEXR file always does; its colours are premultiplied, as its specification says, those
/// of a PNG are not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alpha {
    /// The picture is opaque: alpha is left out.
    LeftOut,
    /// Something may shine through.
    Kept,
}

impl Alpha {
    /// Channels of a pixel of a PNG.
    fn channels(self) -> usize {
        match self {
            Self::LeftOut => 3,
            Self::Kept => 4,
        }
    }
}

/// Writes a picture at `path` with the rows that `draw` gives; without all of them there will be no file.
///
/// # Errors
/// Those of `draw`, [`Error::Io`], and [`Error::Invalid`] for more than [`MAX_LINEAR_PIXELS`] in an OpenEXR file.
pub fn write(
    path: &Path,
    (format, alpha): (Format, Alpha),
    size: Size,
    metadata: &Metadata,
    draw: impl FnOnce(&mut dyn RowSink) -> Result<(), Error>,
) -> Result<(), Error> {
    let bytes = match format {
        Format::Png8 | Format::Png16 => {
            let depth = match format {
                Format::Png8 => Depth::Eight,
                _ => Depth::Sixteen,
            };
            let mut file = AtomicFile::create(path)?;
            encode_png(&mut file, size, (depth, alpha), metadata, draw)?;
            file.commit()?;
            return Ok(());
        }
        Format::ExrHalf => linear::exr(size, Depth::Sixteen, metadata, draw)?,
        Format::ExrFloat => linear::exr(size, Depth::ThirtyTwo, metadata, draw)?,
    };
    let mut file = AtomicFile::create(path)?;
    file.write_all(&bytes)?;
    file.commit()?;
    Ok(())
}

/// Writes an opaque PNG in 8-bit sRGB at `path` with the rows that `draw` gives; without all of them there will be no file.
///
/// # Errors
/// Those of `draw`, and [`Error::Io`].
pub fn write_png(
    path: &Path,
    size: Size,
    metadata: &Metadata,
    draw: impl FnOnce(&mut dyn RowSink) -> Result<(), Error>,
) -> Result<(), Error> {
    write(path, (Format::Png8, Alpha::LeftOut), size, metadata, draw)
}

/// The same into any output, from rows of linear `f32` for a depth of 16 bits.
fn encode_png(
    output: &mut dyn Write,
    size: Size,
    kind: (Depth, Alpha),
    metadata: &Metadata,
    draw: impl FnOnce(&mut dyn RowSink) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut output = Watched {
        output,
        failure: None,
    };
    let drawn = encode(&mut output, size, kind, metadata, draw);
    match (drawn, output.failure) {
        // The encoder passes on the text of a failure alone.
        (Err(Error::Io(_)), Some(failure)) => Err(Error::Io(failure)),
        (drawn, _) => drawn,
    }
}

fn encode(
    output: &mut Watched,
    size: Size,
    (depth, alpha): (Depth, Alpha),
    metadata: &Metadata,
    draw: impl FnOnce(&mut dyn RowSink) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut encoder = png::Encoder::new(output, size.width, size.height);
    encoder.set_color(match alpha {
        Alpha::LeftOut => png::ColorType::Rgb,
        Alpha::Kept => png::ColorType::Rgba,
    });
    encoder.set_depth(match depth {
        Depth::Eight => png::BitDepth::Eight,
        Depth::Sixteen | Depth::ThirtyTwo => png::BitDepth::Sixteen,
    });
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    if u64::from(size.width) * u64::from(size.height) > QUICK_FROM {
        encoder.set_compression(png::Compression::Fast);
    }
    for (keyword, text) in &metadata.0 {
        // PNG has no place for NUL in texts.
        let (keyword, text) = ((*keyword).to_owned(), text.replace('\0', "\u{fffd}"));
        if text.is_ascii() {
            encoder.add_text_chunk(keyword, text)
        } else {
            encoder.add_itxt_chunk(keyword, text)
        }
        .map_err(io_error)?;
    }
    let mut writer = encoder.write_header().map_err(io_error)?;
    {
        let mut stream = writer.stream_writer_with_size(CHUNK).map_err(io_error)?;
        let line = Vec::new();
        match depth {
            Depth::Eight => draw(&mut PngRows {
                stream: &mut stream,
                alpha,
                line,
            })?,
            Depth::Sixteen | Depth::ThirtyTwo => draw(&mut Png16Rows {
                stream: &mut stream,
                alpha,
                line,
            })?,
        }
        stream.finish().map_err(io_error)?;
    }
    writer.finish().map_err(io_error)?;
    Ok(())
}

/// An output that remembers its first failure, and writes no more after it.
struct Watched<'a> {
    output: &'a mut dyn Write,
    failure: Option<io::Error>,
}

impl Watched<'_> {
    fn attempt<T>(
        &mut self,
        action: impl FnOnce(&mut dyn Write) -> io::Result<T>,
    ) -> io::Result<T> {
        if let Some(failure) = &self.failure {
            return Err(failure.kind().into());
        }
        action(self.output).map_err(|error| {
            let kind = error.kind();
            if kind != io::ErrorKind::Interrupted {
                self.failure = Some(error);
            }
            kind.into()
        })
    }
}

impl Write for Watched<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.attempt(|output| output.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.attempt(|output| output.flush())
    }
}

pub(crate) fn io_error(error: png::EncodingError) -> Error {
    Error::Io(match error {
        png::EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    })
}

/// Rows on their way into the compressor.
struct PngRows<W: Write> {
    stream: W,
    alpha: Alpha,
    line: Vec<u8>,
}

impl<W: Write> RowSink for PngRows<W> {
    fn rows(&mut self, rgba: &[u8]) -> io::Result<()> {
        self.line.clear();
        for pixel in rgba.as_chunks::<4>().0 {
            self.line.extend(&pixel[..self.alpha.channels()]);
        }
        self.stream.write_all(&self.line)
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    const SIZE: Size = Size {
        width: 3,
        height: 2,
    };

    fn draw(sink: &mut dyn RowSink) -> Result<(), Error> {
        let row: Vec<u8> = (0..12).collect();
        sink.rows(&row)?;
        sink.rows(&row)?;
        Ok(())
    }

    fn files(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn pixels_and_texts_come_back() {
        let metadata = Metadata(vec![
            ("Software", "pullback".into()),
            ("Formula", "√x\0 + π".into()),
        ]);
        let mut bytes = Vec::new();
        let kind = (Depth::Eight, Alpha::LeftOut);
        encode_png(&mut bytes, SIZE, kind, &metadata, draw).unwrap();
        let mut reader = png::Decoder::new(io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        let row = [0, 1, 2, 4, 5, 6, 8, 9, 10];
        assert_eq!(pixels, [row, row].concat());
        let info = reader.info();
        assert_eq!(info.srgb, Some(png::SrgbRenderingIntent::Perceptual));
        assert_eq!(info.uncompressed_latin1_text[0].text, "pullback");
        assert_eq!(info.utf8_text[0].get_text().unwrap(), "√x\u{fffd} + π");
    }

    #[test]
    fn a_file_appears_only_when_complete() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let failed = write_png(&path, SIZE, &Metadata::default(), |sink| {
            sink.rows(&[0; 12])?;
            Err(Error::Invalid {
                reason: "a test".into(),
            })
        });
        assert!(matches!(failed, Err(Error::Invalid { .. })));
        assert!(files(folder.path()).is_empty());
        let short = write_png(&path, SIZE, &Metadata::default(), |sink| {
            Ok(sink.rows(&[0; 12])?)
        });
        assert!(matches!(short, Err(Error::Io(_))));
        assert!(files(folder.path()).is_empty());
        write_png(&path, SIZE, &Metadata::default(), draw).unwrap();
        assert_eq!(files(folder.path()), ["a.png"]);
    }

    #[test]
    fn the_kind_of_a_failure_is_kept() {
        struct Closed;
        impl Write for Closed {
            fn write(&mut self, _: &[u8]) -> io::Result<usize> {
                Err(io::ErrorKind::BrokenPipe.into())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        let kind = (Depth::Eight, Alpha::LeftOut);
        let failed = encode_png(&mut Closed, SIZE, kind, &Metadata::default(), draw);
        assert!(
            matches!(failed, Err(Error::Io(error)) if error.kind() == io::ErrorKind::BrokenPipe)
        );
    }

    #[test]
    fn a_folder_is_no_file() {
        let folder = tempfile::tempdir().unwrap();
        assert!(write_png(folder.path(), SIZE, &Metadata::default(), draw).is_err());
        let missing = folder.path().join("none/a.png");
        assert!(write_png(&missing, SIZE, &Metadata::default(), draw).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn links_and_permissions_are_kept() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (target, link) = (folder.path().join("a.png"), folder.path().join("b.png"));
        fs::write(&target, "old").unwrap();
        fs::set_permissions(&target, fs::Permissions::from_mode(0o640)).unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        write_png(&link, SIZE, &Metadata::default(), draw).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert!(fs::read(&target).unwrap().starts_with(b"\x89PNG"));
        assert_eq!(
            fs::metadata(&target).unwrap().permissions().mode() & 0o777,
            0o640
        );
        write_png(Path::new("/dev/null"), SIZE, &Metadata::default(), draw).unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }
}
