//! Pictures one after another: what changes between them, and the files that hold them.

mod apng;
mod gif;
mod numbered;
mod sweep;

use std::path::Path;

pub use numbered::frame_path;
pub use sweep::{Sweep, part};

use crate::{Error, Size};

/// Most frames of an animation.
pub const MAX_FRAMES: u32 = 100_000;

/// A file that holds all frames, by the end of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Container {
    /// Graphics Interchange Format 89a: 256 colours in each frame, shown everywhere.
    Gif,
    /// Animated PNG (PNG, third edition, W3C 2025): all colours.
    Apng,
}

impl Container {
    /// The container that a file's name asks for; none for a still picture's.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        match extension.to_ascii_lowercase().as_str() {
            "gif" => Some(Self::Gif),
            "apng" => Some(Self::Apng),
            _ => None,
        }
    }
}

/// What an animated file is told of itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clip {
    /// Of each frame.
    pub size: Size,
    /// How many frames there are.
    pub frames: u32,
    /// Frames in a second.
    pub rate: f64,
}

/// Writes an animation that runs forever at `path`. `draw` gives the pixels of a frame, 8-bit sRGB with alpha from top to
/// bottom; without all frames there will be no file.
///
/// # Errors
/// Those of `draw`, [`Error::Io`], and [`Error::Invalid`] for what the container cannot hold.
pub fn write(
    path: &Path,
    container: Container,
    clip: Clip,
    draw: &mut dyn FnMut(u32) -> Result<Vec<u8>, Error>,
) -> Result<(), Error> {
    let mut file = crate::AtomicFile::create(path)?;
    match container {
        Container::Gif => gif::encode(&mut file, clip, draw)?,
        Container::Apng => apng::encode(&mut file, clip, draw)?,
    }
    file.commit()?;
    Ok(())
}

#[cfg(test)]
mod tests;
