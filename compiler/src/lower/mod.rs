//! From the IR to a naga function.

mod body;
mod exactness;
mod function;
mod identifier;
mod repeat;
mod types;

pub use exactness::Exactness;
pub use function::{Argument, Interface, Leaves, Output, lower};
pub use identifier::identifier;
pub use types::NagaTypes;

use crate::link::LinkError;

/// What precision the shader computes in: which form of each function is called.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Precision {
    /// The built-ins of the graphics API where there is one.
    Fast,
    /// The functions of our math library.
    #[default]
    Accurate,
}

/// A function could not be lowered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LowerError {
    /// An operation has no form on the type that it is used with.
    NoForm(&'static str),
    /// A derivative that the template asks for does not exist.
    NoDerivative(crate::derive::NoDerivative),
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
