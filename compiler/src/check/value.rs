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

    /// The IR nodes of the value, those of a record's members included.
    #[must_use]
    pub fn all_ids(&self) -> SmallVec<[Id; 4]> {
        let Self::Record(record) = self else {
            return self.ids();
        };
        let members = record.members.iter().map(|member| &member.1);
        let values = record.value.iter().chain(members);
        values.flat_map(Self::all_ids).collect()
    }

    /// A value of the same form whose nodes are others: `new` gives them in the order of [`Self::all_ids`].
    #[must_use]
    pub fn map(&self, new: &mut impl FnMut(Id) -> Id) -> Self {
        match self {
            Self::Scalar(id) => Self::Scalar(new(*id)),
            Self::Vector(items) => Self::Vector(items.iter().map(|&id| new(id)).collect()),
            Self::Record(record) => {
                let value = record.value.as_ref().map(|value| value.map(new));
                let members = record.members.iter();
                let members = members
                    .map(|(name, member)| (name.clone(), member.map(new)))
                    .collect();
                Self::Record(Box::new(Record { value, members }))
            }
            Self::Error => Self::Error,
        }
    }

    /// A number or vector of the same form with other nodes.
    #[must_use]
    pub fn with_ids(&self, ids: &[Id]) -> Self {
        match (self, ids) {
            (Self::Scalar(_), &[id]) => Self::Scalar(id),
            (Self::Vector(items), _) if items.len() == ids.len() => {
                Self::Vector(SmallVec::from_slice(ids))
            }
            (Self::Record(record), _) => {
                let value = record.value.as_ref();
                value.map_or(Self::Error, |value| value.with_ids(ids))
            }
            _ => Self::Error,
        }
    }
}
