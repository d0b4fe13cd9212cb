//! Frames as files of their own.

use std::path::{Path, PathBuf};

/// The file of a frame: its number, counted from 1 and filled with zeros to the length of the last one, stands before
/// the end of the name. `wave.png` becomes `wave-001.png`.
#[must_use]
pub fn frame_path(path: &Path, frame: u32, frames: u32) -> PathBuf {
    let digits = frames.to_string().len();
    let number = format!("{:0digits$}", frame + 1);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let name = match path.extension() {
        Some(extension) => format!("{stem}-{number}.{}", extension.to_string_lossy()),
        None => format!("{stem}-{number}"),
    };
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_sort_as_text() {
        let name = |path: &str, frame, frames| {
            frame_path(Path::new(path), frame, frames)
                .to_string_lossy()
                .into_owned()
        };
        assert_eq!(name("out/wave.png", 0, 120), "out/wave-001.png");
        assert_eq!(name("out/wave.png", 119, 120), "out/wave-120.png");
        assert_eq!(name("a.b.png", 4, 9), "a.b-5.png");
    }
}
