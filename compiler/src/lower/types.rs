//! The number types of a module.

use naga::{Handle, Scalar, Span, Type, TypeInner, UniqueArena, VectorSize};

use super::Format;
use crate::link::{LinkError, Linker};

/// Handles of the types of single precision in a module.
#[derive(Clone, Copy, Debug)]
pub struct NagaTypes {
    /// `f32`
    pub real: Handle<Type>,
    /// `vec2<f32>`, which also holds a complex number
    pub vec2: Handle<Type>,
    /// `vec3<f32>`
    pub vec3: Handle<Type>,
    /// `vec4<f32>`
    pub vec4: Handle<Type>,
    /// `bool`
    pub truth: Handle<Type>,
}

impl NagaTypes {
    /// Finds or adds the types.
    pub fn insert(types: &mut UniqueArena<Type>) -> Self {
        let mut add = |inner| types.insert(Type { name: None, inner }, Span::UNDEFINED);
        Self {
            real: add(TypeInner::Scalar(Scalar::F32)),
            vec2: add(vector(VectorSize::Bi)),
            vec3: add(vector(VectorSize::Tri)),
            vec4: add(vector(VectorSize::Quad)),
            truth: add(TypeInner::Scalar(Scalar::BOOL)),
        }
    }
}

/// Handles of the types that a tier computes in.
#[derive(Clone, Copy, Debug)]
pub struct NumberTypes {
    /// A real number.
    pub real: Handle<Type>,
    /// A complex number: a vector in single precision, else the structure `Complex` of the wide libraries.
    pub complex: Handle<Type>,
}

impl NumberTypes {
    /// The types of single precision, or those that the wide library calls `real` and `Complex`.
    ///
    /// # Errors
    /// The library is not among the linker's sources.
    pub fn of(linker: &mut Linker, format: Format) -> Result<Self, LinkError> {
        if format.is_wide() {
            return Ok(Self {
                real: linker.type_named("real")?,
                complex: linker.type_named("Complex")?,
            });
        }
        let types = NagaTypes::insert(&mut linker.out.types);
        Ok(Self {
            real: types.real,
            complex: types.vec2,
        })
    }
}

fn vector(size: VectorSize) -> TypeInner {
    TypeInner::Vector {
        size,
        scalar: Scalar::F32,
    }
}
