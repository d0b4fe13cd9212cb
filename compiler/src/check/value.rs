//! Values during checking: IR nodes with their type in the language.

use smallvec::SmallVec;

use super::Record;
use crate::ir::{Graph, Id, Ty};
use crate::types::Type;

/// A checked value.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Value {
    /// A real, complex or truth value; the type is the node's.
    Scalar(Id),
    /// Components of a vector, all real.
    Vector(SmallVec<[Id; 4]>),
    /// Several values, of which one may stand for all.
    Record(Box<Record>),
    /// Something that could not be checked; the mistake has been reported.
    Error,
}

impl Value {
    /// The type, or `None` for an error and for a record of which a member has to be named.
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
            Self::Record(record) => record.value.as_ref()?.ty(graph),
            Self::Error => None,
        }
    }

    /// The IR nodes of the value.
    #[must_use]
    pub fn ids(&self) -> SmallVec<[Id; 4]> {
        match self {
            Self::Scalar(id) => SmallVec::from_slice(&[*id]),
            Self::Vector(items) => items.clone(),
            Self::Record(record) => record.value.as_ref().map(Self::ids).unwrap_or_default(),
            Self::Error => SmallVec::new(),
        }
    }
}
