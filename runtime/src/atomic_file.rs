//! Files that appear under their name only when they are complete.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// A file that appears under its name only when it is complete.
#[derive(Debug)]
pub struct AtomicFile {
    output: Output,
}

#[derive(Debug)]
enum Output {
    /// Renamed to the path at the end.
    Temporary(BufWriter<NamedTempFile>, PathBuf),
    /// A device or a pipe: nothing to replace.
    Direct(BufWriter<File>),
    Stdout(BufWriter<io::Stdout>),
}

impl AtomicFile {
    /// Begins a file that will be at `path`; `-` is the standard output.
    ///
    /// # Errors
    /// If the folder cannot be written.
    pub fn create(path: &Path) -> io::Result<Self> {
        if path == Path::new("-") {
            return Ok(Self {
                output: Output::Stdout(BufWriter::new(io::stdout())),
            });
        }
        // A link stays a link.
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let existing = fs::metadata(&path).ok();
        if let Some(existing) = &existing
            && !existing.is_file()
        {
            if existing.is_dir() {
                return Err(io::Error::new(
                    io::ErrorKind::IsADirectory,
                    "is a directory",
                ));
            }
            let file = File::options().write(true).open(&path)?;
            return Ok(Self {
                output: Output::Direct(BufWriter::new(file)),
            });
        }
        let folder = match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".pullback-").suffix(".part");
        let permissions = existing.map(|existing| existing.permissions());
        if permissions.as_ref().is_some_and(fs::Permissions::readonly) {
            return Err(io::ErrorKind::PermissionDenied.into());
        }
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As for any new file; the user's mask applies.
            builder.permissions(permissions.unwrap_or(fs::Permissions::from_mode(0o666)));
        }
        let file = builder.tempfile_in(folder)?;
        Ok(Self {
            output: Output::Temporary(BufWriter::with_capacity(1 << 18, file), path),
        })
    }

    /// Gives the complete file its name.
    ///
    /// # Errors
    /// If the rest cannot be written or the name cannot be given; nothing is left behind then.
    pub fn commit(self) -> io::Result<()> {
        match self.output {
            Output::Temporary(buffer, path) => {
                let file = buffer
                    .into_inner()
                    .map_err(io::IntoInnerError::into_error)?;
                file.persist(path).map_err(|error| error.error)?;
                Ok(())
            }
            Output::Direct(mut buffer) => buffer.flush(),
            Output::Stdout(mut buffer) => buffer.flush(),
        }
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.output {
            Output::Temporary(buffer, _) => buffer.write(bytes),
            Output::Direct(buffer) => buffer.write(bytes),
            Output::Stdout(buffer) => buffer.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.output {
            Output::Temporary(buffer, _) => buffer.flush(),
            Output::Direct(buffer) => buffer.flush(),
            Output::Stdout(buffer) => buffer.flush(),
        }
    }
}

/// Puts a text at `path`: all of it, or nothing where that fails.
///
/// # Errors
/// If the folder cannot be written, or the file is read-only.
pub fn write_text(path: &Path, text: &str) -> io::Result<()> {
    let mut file = AtomicFile::create(path)?;
    file.write_all(text.as_bytes())?;
    file.commit()
}
