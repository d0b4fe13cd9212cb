//! Values that are known before a shader runs.

use naga::{Handle, Literal, Type};

/// A value that does not depend on where the shader runs.
#[derive(Clone, Debug)]
pub enum Known {
    /// A number or a truth value.
    Scalar(Literal),
    /// A vector, matrix, array or structure of this type.
    Composite(Handle<Type>, Vec<Known>),
}

impl Known {
    /// The number, if it is one.
    pub fn literal(&self) -> Option<Literal> {
        match self {
            Self::Scalar(literal) => Some(*literal),
            Self::Composite(..) => None,
        }
    }

    /// The truth value, if it is one.
    pub fn bool(&self) -> Option<bool> {
        match self {
            Self::Scalar(Literal::Bool(value)) => Some(*value),
            _ => None,
        }
    }

    /// A whole number that is no less than 0.
    pub fn index(&self) -> Option<usize> {
        match self {
            Self::Scalar(Literal::U32(k)) => usize::try_from(*k).ok(),
            Self::Scalar(Literal::I32(k)) => usize::try_from(*k).ok(),
            _ => None,
        }
    }

    /// A component.
    pub fn part(&self, index: usize) -> Option<&Self> {
        match self {
            Self::Composite(_, parts) => parts.get(index),
            Self::Scalar(_) => None,
        }
    }

    /// Whether both are the same to the last bit: zeros of different sign are not.
    pub fn is(&self, other: &Self) -> bool {
        self.key() == other.key()
    }

    /// The same for the same values, and only for those.
    pub fn key(&self) -> Key {
        let mut key = Key::default();
        self.add_to(&mut key);
        key
    }

    fn add_to(&self, key: &mut Key) {
        match self {
            Self::Scalar(literal) => key.0.push(bits(*literal)),
            Self::Composite(ty, parts) => {
                key.0.push((u8::MAX, ty.index() as u64));
                parts.iter().for_each(|part| part.add_to(key));
            }
        }
    }
}

/// What tells a value from others.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Key(Vec<(u8, u64)>);

fn bits(literal: Literal) -> (u8, u64) {
    match literal {
        Literal::F64(x) => (0, x.to_bits()),
        Literal::F32(x) => (1, u64::from(x.to_bits())),
        Literal::F16(x) => (2, u64::from(x.to_bits())),
        Literal::U32(x) => (3, u64::from(x)),
        Literal::I32(x) => (4, u64::from(x.cast_unsigned())),
        Literal::U64(x) => (5, x),
        Literal::I64(x) => (6, x.cast_unsigned()),
        Literal::Bool(x) => (7, u64::from(x)),
        Literal::AbstractInt(x) => (8, x.cast_unsigned()),
        Literal::AbstractFloat(x) => (9, x.to_bits()),
        Literal::U16(x) => (10, u64::from(x)),
        Literal::I16(x) => (11, u64::from(x.cast_unsigned())),
    }
}
