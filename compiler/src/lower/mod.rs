//! From the IR to a naga function.

mod beyond;
mod body;
mod branches;
mod defined;
mod exactness;
mod factors;
mod format;
mod function;
mod fused;
mod identifier;
mod lattice;
mod leaves;
mod numbers;
mod place;
mod plain;
mod repeat;
mod scaled;
mod tier;
mod types;

pub use exactness::Exactness;
pub use format::Format;
pub use function::{Argument, Base, Interface, JetNodes, Leaves, Output, lower};
pub use identifier::identifier;
pub use tier::Tier;
pub use types::{NagaTypes, NumberTypes};

use crate::link::LinkError;

/// What precision the shader computes in: which form of each function is called.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Precision {
    /// Single precision, and the built-ins of the graphics API where there is one.
    Fast,
    /// Single precision, and the functions of our math library.
    #[default]
    Accurate,
    /// Pairs of single-precision numbers, about 48 bits.
    Extended,
    /// Native double precision, on adapters that have it.
    Double,
}

impl Precision {
    /// Every tier, from the cheapest to the most exact.
    pub const ALL: [Self; 4] = [Self::Fast, Self::Accurate, Self::Extended, Self::Double];

    /// How the tier holds a number.
    #[must_use]
    pub fn format(self) -> Format {
        match self {
            Self::Fast | Self::Accurate => Format::Single,
            Self::Extended => Format::Pair,
            Self::Double => Format::Double,
        }
    }

    /// Its name on the command line and in programs.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Accurate => "accurate",
            Self::Extended => "extended",
            Self::Double => "double",
        }
    }
}

/// A function could not be lowered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LowerError {
    /// An operation has no form on the type that it is used with.
    NoForm(&'static str),
    /// A derivative that the template asks for does not exist.
    NoDerivative(crate::derive::NoDerivative),
    /// An integral that the template asks for exceeds a bound.
    NoIntegral(crate::integrate::Problem),
    /// The density of the scene's medium has no closed form along rays, and nothing else is wanted.
    NoColumn(crate::integrate::Problem),
    /// The template asks for something that the formula's type does not have.
    Demand(String),
    /// A library function could not be linked.
    Link(Box<LinkError>),
}

impl From<LinkError> for LowerError {
    fn from(error: LinkError) -> Self {
        match error {
            LinkError::Lower(error) => error,
            error => Self::Link(Box::new(error)),
        }
    }
}
