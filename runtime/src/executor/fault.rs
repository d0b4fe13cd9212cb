//! What can go wrong in the executor.

use std::fmt;
use std::ops::Range;

use pullback_compiler::module::DEMANDS;

/// A loop of a module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoopSite {
    /// The function that it is in.
    pub function: String,
    /// Its place in the text that the function is from: the user's of a formula, else that of the shader.
    pub span: Option<Range<usize>>,
    /// What it repeats.
    pub kind: LoopKind,
}

/// What a loop repeats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopKind {
    /// Steps of the formula.
    Formula,
    /// Samples of a pixel.
    Samples,
    /// Something of the scene, or of a library.
    Scene,
}

/// The function of all scenes that takes the samples of a pixel (`shared/entry.wgsl`).
const SAMPLING: &str = "with_samples";

impl LoopSite {
    pub(super) fn new(function: &naga::Function, span: naga::Span) -> Self {
        let span = span.to_range().filter(|span| !span.is_empty());
        let function = function.name.clone().unwrap_or_default();
        let kind = match function.as_str() {
            SAMPLING => LoopKind::Samples,
            "evaluate" => LoopKind::Formula,
            name if DEMANDS.contains(&name) => LoopKind::Formula,
            _ => LoopKind::Scene,
        };
        Self {
            function,
            span,
            kind,
        }
    }

    /// Its place in the user's text, if it comes from the formula.
    #[must_use]
    pub fn in_formula(&self) -> Option<Range<usize>> {
        self.span.clone().filter(|_| self.kind == LoopKind::Formula)
    }
}

impl fmt::Display for LoopSite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.function.as_str() {
            "" => f.write_str("in the entry point"),
            name => write!(f, "in `{name}`"),
        }
    }
}

/// Why a module cannot be run, or a run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The module has something that none of ours has.
    Unsupported {
        /// What it is, such as `texture sampling`.
        construct: String,
        /// The function that has it.
        function: String,
    },
    /// There is no function of this name.
    Missing(String),
    /// The loops of one invocation took more steps than they may.
    Steps {
        /// How many they may take.
        limit: u64,
        /// The loop that took the most of them.
        place: Option<LoopSite>,
    },
    /// A loop went on for longer than it may.
    Turns {
        /// How many steps it may take from when it is entered until it is left.
        limit: u64,
        /// The loop.
        place: Option<LoopSite>,
    },
    /// The run was cancelled.
    Cancelled,
}

impl Fault {
    /// The loop of the formula that is to blame, by its place in the user's text.
    #[must_use]
    pub fn in_formula(&self) -> Option<Range<usize>> {
        match self {
            Self::Steps { place, .. } | Self::Turns { place, .. } => place.as_ref()?.in_formula(),
            _ => None,
        }
    }

    pub(crate) fn unsupported(construct: impl Into<String>) -> Self {
        Self::Unsupported {
            construct: construct.into(),
            function: String::new(),
        }
    }

    /// The fault, in a function unless it is already said which.
    pub(super) fn within(self, name: Option<&str>) -> Self {
        match (self, name) {
            (
                Self::Unsupported {
                    construct,
                    function,
                },
                Some(name),
            ) if function.is_empty() => {
                let function = name.to_owned();
                Self::Unsupported {
                    construct,
                    function,
                }
            }
            (fault, _) => fault,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unsupported {
                construct,
                function,
            } => {
                write!(f, "{construct} cannot be executed on the processor")?;
                if !function.is_empty() {
                    write!(f, "; it is in `{function}`")?;
                }
                Ok(())
            }
            Self::Missing(name) => write!(f, "the shader has no function `{name}`"),
            Self::Steps { limit, place } => {
                write!(f, "the loops of one sample take more than {limit} steps")?;
                if let Some(place) = place {
                    write!(f, ", most of them {place}")?;
                }
                f.write_str("; give them a smaller bound")
            }
            Self::Turns { limit, place } => {
                write!(f, "a loop takes more than {limit} steps at a time")?;
                match place {
                    Some(place) => write!(f, ": {place}"),
                    None => Ok(()),
                }
            }
            Self::Cancelled => f.write_str("cancelled"),
        }
    }
}

impl std::error::Error for Fault {}
