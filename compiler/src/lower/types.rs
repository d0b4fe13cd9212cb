//! The number types of a module.

use naga::{Handle, Scalar, Span, Type, TypeInner, UniqueArena, VectorSize};

/// Handles of the number types in a module.
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
        let vector = |size| TypeInner::Vector {
            size,
            scalar: Scalar::F32,
        };
        Self {
            real: add(TypeInner::Scalar(Scalar::F32)),
            vec2: add(vector(VectorSize::Bi)),
            vec3: add(vector(VectorSize::Tri)),
            vec4: add(vector(VectorSize::Quad)),
            truth: add(TypeInner::Scalar(Scalar::BOOL)),
        }
    }
}
