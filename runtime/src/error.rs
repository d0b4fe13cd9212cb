//! What can go wrong at run time, as data.

use std::fmt;

use crate::device::{AdapterChoice, AdapterSummary};
use crate::executor::Fault;

/// A failure of the device, of the environment, or of input and output.
#[derive(Debug)]
pub enum Error {
    /// No adapter fits the choice.
    NoAdapter {
        /// What was asked for.
        wanted: AdapterChoice,
        /// What there is.
        found: Vec<AdapterSummary>,
    },
    /// The adapter exists, but gave no device.
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// The driver's reason.
        reason: String,
    },
    /// The device refused or failed an operation.
    Device {
        /// What was being done.
        during: &'static str,
        /// The device's message.
        reason: String,
    },
    /// The device was lost: reset, removed or crashed.
    Lost {
        /// What was being done.
        during: &'static str,
        /// The driver's message; may be empty.
        reason: String,
    },
    /// A submission did not finish in time.
    Timeout {
        /// What was being done.
        during: &'static str,
        /// How long it was waited for.
        seconds: u64,
    },
    /// The adapter ends loops without an error before a picture is done.
    Turns {
        /// The adapter's name.
        adapter: String,
        /// How many turns all loops of an invocation may make together.
        turns: u32,
    },
    /// A request that no device could fulfil, such as a picture without pixels.
    Invalid {
        /// What is wrong with it.
        reason: String,
    },
    /// The processor cannot run the shader, or gave up.
    Executor(Fault),
    /// A file is no mesh that can be drawn.
    Mesh {
        /// The file.
        path: std::path::PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// Reading or writing failed.
    Io(std::io::Error),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAdapter { wanted, found } => {
                match wanted {
                    AdapterChoice::Auto => write!(f, "no graphics adapter")?,
                    AdapterChoice::Gpu => write!(f, "no hardware graphics adapter")?,
                    AdapterChoice::Software => write!(f, "no software graphics adapter")?,
                    AdapterChoice::Named(name) => write!(f, "no graphics adapter called `{name}`")?,
                }
                for (i, adapter) in found.iter().enumerate() {
                    let lead = if i == 0 { "; there is " } else { ", " };
                    write!(f, "{lead}{adapter}")?;
                }
                Ok(())
            }
            Self::NoDevice { adapter, reason } => {
                write!(f, "adapter {adapter} gave no device: {reason}")
            }
            Self::Device { during, reason } => write!(f, "device error during {during}: {reason}"),
            Self::Lost { during, reason } if reason.is_empty() => {
                write!(f, "device lost during {during}")
            }
            Self::Lost { during, reason } => write!(f, "device lost during {during}: {reason}"),
            Self::Timeout { during, seconds } => {
                write!(
                    f,
                    "device did not finish within {seconds} s during {during}"
                )
            }
            Self::Turns { adapter, turns } => write!(
                f,
                "{adapter} ends loops after {turns} turns, and a sample of this picture takes more: it would be wrong; \
                 take fewer steps, or let another adapter or the processor draw it"
            ),
            Self::Invalid { reason } => f.write_str(reason),
            Self::Executor(fault) => fault.fmt(f),
            Self::Mesh { path, reason } => write!(f, "mesh {}: {reason}", path.display()),
            Self::Io(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io(error) => Some(error),
            Self::Executor(fault) => Some(fault),
            _ => None,
        }
    }
}

impl From<Fault> for Error {
    fn from(fault: Fault) -> Self {
        Self::Executor(fault)
    }
}

impl From<std::io::Error> for Error {
    fn from(error: std::io::Error) -> Self {
        Self::Io(error)
    }
}
