//! The number types of a module.

use naga::{Handle, Scalar, Span, StructMember, Type, TypeInner, UniqueArena, VectorSize};

use super::Format;

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
    /// Finds or adds the types.
    pub fn insert(types: &mut UniqueArena<Type>, format: Format) -> Self {
        let scalar = match format {
            Format::Single => TypeInner::Scalar(Scalar::F32),
            Format::Pair => vector(VectorSize::Bi),
            Format::Double => TypeInner::Scalar(Scalar::F64),
        };
        let mut add = |name: Option<&str>, inner| {
            let name = name.map(str::to_owned);
            types.insert(Type { name, inner }, Span::UNDEFINED)
        };
        let real = add(None, scalar);
        let complex = match format {
            Format::Single => add(None, vector(VectorSize::Bi)),
            // both formats take 8 bytes
            Format::Pair | Format::Double => {
                let members = [("re", 0), ("im", 8)].map(|(name, offset)| StructMember {
                    name: Some(name.to_owned()),
                    ty: real,
                    binding: None,
                    offset,
                });
                let inner = TypeInner::Struct {
                    members: members.into(),
                    span: 16,
                };
                add(Some("Complex"), inner)
            }
        };
        Self { real, complex }
    }
}

fn vector(size: VectorSize) -> TypeInner {
    TypeInner::Vector {
        size,
        scalar: Scalar::F32,
    }
}
