//! What can go wrong in the executor.

use std::fmt;

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
    },
    /// The run was cancelled.
    Cancelled,
}

impl Fault {
    pub(super) fn unsupported(construct: impl Into<String>) -> Self {
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
            Self::Steps { limit } => write!(
                f,
                "the loops of one pixel take more than {limit} steps; give them a smaller bound"
            ),
            Self::Cancelled => f.write_str("cancelled"),
        }
    }
}

impl std::error::Error for Fault {}
