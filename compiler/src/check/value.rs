//! Values during checking: IR nodes with their type in the language.

use smallvec::SmallVec;

use crate::ir::{Graph, Id, Ty};
use crate::types::Type;

/// A checked value.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Value {
    /// A real, complex or truth value; the type is the node's.
    Scalar(Id),
    /// Components of a vector, all real.
    Vector(SmallVec<[Id; 4]>),
    /// Something that could not be checked; the mistake has been reported.
    Error,
}

impl Value {
    /// The type, or `None` for an error.
    #[must_use]
    pub fn ty(&self, graph: &Graph) -> Option<Type> {
        match self {
            Self::Scalar(id) => Some(match graph.ty(*id) {
                Ty::Loop => return None,
                Ty::Real => Type::Real,
                Ty::Complex => Type::Complex,
                Ty::Bool => Type::Bool,
            }),
            Self::Vector(items) => Some(Type::Vector(u8::try_from(items.len()).unwrap_or(4))),
            Self::Error => None,
        }
    }

    /// The IR nodes of the value.
    #[must_use]
    pub fn ids(&self) -> SmallVec<[Id; 4]> {
        match self {
            Self::Scalar(id) => SmallVec::from_slice(&[*id]),
            Self::Vector(items) => items.clone(),
            Self::Error => SmallVec::new(),
        }
    }

    /// A value of the same form with other nodes.
    #[must_use]
    pub fn with_ids(&self, ids: &[Id]) -> Self {
        match (self, ids) {
            (Self::Scalar(_), &[id]) => Self::Scalar(id),
            (Self::Vector(items), _) if items.len() == ids.len() => {
                Self::Vector(SmallVec::from_slice(ids))
            }
            _ => Self::Error,
        }
    }
}
