//! Why a command did not succeed, and the exit code of it.

use std::io;

use pullback_runtime::{AdapterChoice, Error};

use super::Console;

/// How to get a software adapter.
pub(super) const INSTALL_SOFTWARE: &str = if cfg!(target_os = "linux") {
    "for a software adapter, `apt-get install mesa-vulkan-drivers libvulkan1` (or your distribution's Mesa \
     Vulkan drivers and Vulkan loader)"
} else {
    "update the graphics driver of this machine"
};

/// Why a command did not succeed.
#[derive(Debug)]
pub(super) enum Failure {
    /// The program has errors, which have been told.
    Program,
    /// The command line asks for something that is not to be had.
    Usage {
        message: String,
        hint: Option<String>,
    },
    /// The device or the environment failed.
    Device(Error),
    /// What is named could not be read or written.
    Io { what: String, error: io::Error },
    /// The canonical text of a file would mean something else.
    Unchanged { name: String },
    /// Input data, whose errors have been told, could not be read.
    Data,
}

impl Failure {
    /// A wrong command line.
    pub(super) fn usage(message: impl Into<String>) -> Self {
        Self::Usage {
            message: message.into(),
            hint: None,
        }
    }

    /// A wrong command line, and what to do.
    pub(super) fn usage_hint(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::Usage {
            message: message.into(),
            hint: Some(hint.into()),
        }
    }

    /// For `map_err` on the standard output.
    pub(super) fn stdout(error: io::Error) -> Self {
        Self::Io {
            what: "standard output".into(),
            error,
        }
    }

    /// For `map_err` on what writes `what`.
    pub(super) fn writing(what: &str) -> impl Fn(Error) -> Self {
        let what = what.to_owned();
        move |error| match error {
            Error::Io(error) => Self::Io {
                what: what.clone(),
                error,
            },
            Error::Invalid { reason } => Self::usage(reason),
            Error::Mesh { .. } => Self::usage(error.to_string()),
            error => Self::Device(error),
        }
    }

    /// Tells it; returns the exit code.
    pub(super) fn report(self, console: &Console) -> u8 {
        match self {
            Self::Program => 1,
            Self::Usage { message, hint } => {
                console.error(&message);
                if let Some(hint) = hint {
                    console.hint(&hint);
                }
                2
            }
            Self::Device(error) => {
                console.error(&error.to_string());
                match &error {
                    Error::NoAdapter { wanted, found } => {
                        if found.is_empty() || *wanted == AdapterChoice::Software {
                            console.hint(INSTALL_SOFTWARE);
                        }
                        console.hint("`pullback doctor` lists the adapters");
                    }
                    Error::Invalid { .. } | Error::Io(_) => {}
                    _ => console
                        .hint("`pullback doctor` tests the adapters; choose one with --adapter"),
                }
                3
            }
            // Whoever read the pipe has seen enough.
            Self::Io { error, .. } if error.kind() == io::ErrorKind::BrokenPipe => 0,
            Self::Io { what, error } => {
                console.error(&format!("{what}: {}", plain(&error)));
                4
            }
            Self::Unchanged { name } => {
                console.error(&format!(
                    "{name}: formatting would change the meaning; the file is left as it was"
                ));
                console.hint("this is a mistake in pullback; please report the program");
                1
            }
            Self::Data => 4,
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::writing("output")(error)
    }
}

/// The system's message without its number, in lower case.
fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    let text = text.split(" (os error").next().unwrap_or(&text);
    let mut chars = text.chars();
    match chars.next() {
        Some(first) => first.to_lowercase().chain(chars).collect(),
        None => "unknown error".into(),
    }
}
