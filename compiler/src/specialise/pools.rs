//! The parts of a module that its functions share.

use naga::{
    Arena, ArraySize, Constant, Expression, Handle, Literal, Module, Scalar, ScalarKind, Span,
    Type, TypeInner, UniqueArena, VectorSize,
};
use rustc_hash::FxHashMap;

use super::known::{Key, Known};

/// Longest array that is looked into as a known value.
const MAX_ELEMENTS: u32 = 64;

/// Types and constants of the module that is being made.
pub struct Pools<'a> {
    types: &'a mut UniqueArena<Type>,
    constants: &'a mut Arena<Constant>,
    expressions: &'a mut Arena<Expression>,
    made: FxHashMap<Key, Handle<Constant>>,
}

impl<'a> Pools<'a> {
    pub fn new(module: &'a mut Module) -> Self {
        Self {
            types: &mut module.types,
            constants: &mut module.constants,
            expressions: &mut module.global_expressions,
            made: FxHashMap::default(),
        }
    }

    pub fn inner(&self, ty: Handle<Type>) -> &TypeInner {
        &self.types[ty].inner
    }

    /// The type of a number.
    pub fn scalar(&mut self, scalar: Scalar) -> Handle<Type> {
        let inner = TypeInner::Scalar(scalar);
        self.types
            .insert(Type { name: None, inner }, Span::UNDEFINED)
    }

    /// The vector of these numbers; `None` if they are none, or of different kinds.
    pub fn vector(&mut self, parts: Vec<Known>) -> Option<Known> {
        let size = match parts.len() {
            2 => VectorSize::Bi,
            3 => VectorSize::Tri,
            4 => VectorSize::Quad,
            _ => return None,
        };
        let scalar = parts.first()?.literal()?.scalar();
        let is_it = |part: &Known| part.literal().is_some_and(|x| x.scalar() == scalar);
        if !parts.iter().all(is_it) {
            return None;
        }
        let inner = TypeInner::Vector { size, scalar };
        let ty = self
            .types
            .insert(Type { name: None, inner }, Span::UNDEFINED);
        Some(Known::Composite(ty, parts))
    }

    /// The value as one of the type that its components say: after an operation whose result is of another type.
    pub fn retyped(&mut self, known: Known) -> Option<Known> {
        match known {
            Known::Scalar(_) => Some(known),
            Known::Composite(_, parts) => self.vector(parts),
        }
    }

    /// A value of a type whose parts are read one after the other, at offsets in bytes; `None` where one is not known, or for
    /// an array.
    pub fn read(
        &self,
        ty: Handle<Type>,
        offset: u32,
        word: &impl Fn(u32, ScalarKind) -> Option<Literal>,
    ) -> Option<Known> {
        match self.inner(ty) {
            TypeInner::Scalar(scalar) if scalar.width == 4 => {
                word(offset, scalar.kind).map(Known::Scalar)
            }
            TypeInner::Vector { size, scalar } if scalar.width == 4 => {
                let parts = (0..*size as u32)
                    .map(|k| word(offset + 4 * k, scalar.kind).map(Known::Scalar))
                    .collect::<Option<_>>()?;
                Some(Known::Composite(ty, parts))
            }
            TypeInner::Struct { members, .. } => {
                let parts = members
                    .iter()
                    .map(|m| self.read(m.ty, offset + m.offset, word))
                    .collect::<Option<_>>()?;
                Some(Known::Composite(ty, parts))
            }
            _ => None,
        }
    }

    /// Zero of a type.
    pub fn zero(&self, ty: Handle<Type>) -> Option<Known> {
        let (part, count) = match self.inner(ty) {
            TypeInner::Scalar(scalar) => return Literal::zero(*scalar).map(Known::Scalar),
            TypeInner::Vector { size, scalar } => (zero(*scalar)?, *size as usize),
            TypeInner::Array {
                base,
                size: ArraySize::Constant(count),
                ..
            } if count.get() <= MAX_ELEMENTS => (self.zero(*base)?, count.get() as usize),
            TypeInner::Struct { members, .. } => {
                let parts = members.iter().map(|m| self.zero(m.ty));
                return Some(Known::Composite(ty, parts.collect::<Option<_>>()?));
            }
            _ => return None,
        };
        Some(Known::Composite(ty, vec![part; count]))
    }

    /// The value of a constant; `None` for what is too large to be looked into.
    pub fn value(&mut self, constant: Handle<Constant>) -> Option<Known> {
        self.global(self.constants[constant].init)
    }

    fn global(&mut self, handle: Handle<Expression>) -> Option<Known> {
        match self.expressions[handle].clone() {
            Expression::Literal(literal) => Some(Known::Scalar(literal)),
            Expression::Constant(constant) => self.value(constant),
            Expression::ZeroValue(ty) => self.zero(ty),
            Expression::Splat { size, value } => {
                let part = self.global(value)?;
                self.vector(vec![part; size as usize])
            }
            Expression::Compose { ty, components } => self.composed(ty, |pools| {
                components
                    .iter()
                    .map(|&part| pools.global(part))
                    .collect::<Option<_>>()
            }),
            _ => None,
        }
    }

    /// The composite of parts. Vectors may be made of shorter ones.
    pub fn composed(
        &mut self,
        ty: Handle<Type>,
        parts: impl FnOnce(&mut Self) -> Option<Vec<Known>>,
    ) -> Option<Known> {
        match self.inner(ty) {
            TypeInner::Array {
                size: ArraySize::Constant(count),
                ..
            } if count.get() <= MAX_ELEMENTS => {}
            TypeInner::Vector { .. } => {
                let parts = parts(self)?.into_iter().flat_map(|part| match part {
                    Known::Composite(_, parts) => parts,
                    number @ Known::Scalar(_) => vec![number],
                });
                return Some(Known::Composite(ty, parts.collect()));
            }
            TypeInner::Matrix { .. } | TypeInner::Struct { .. } => {}
            _ => return None,
        }
        parts(self).map(|parts| Known::Composite(ty, parts))
    }

    /// The module's constant of a value.
    pub fn constant(&mut self, known: &Known, ty: Handle<Type>) -> Handle<Constant> {
        let key = known.key();
        if let Some(&made) = self.made.get(&key) {
            return made;
        }
        let init = self.expression(known);
        let constant = Constant {
            name: None,
            ty,
            init,
        };
        let made = self.constants.append(constant, Span::UNDEFINED);
        self.made.insert(key, made);
        made
    }

    fn expression(&mut self, known: &Known) -> Handle<Expression> {
        let expression = match known {
            Known::Scalar(literal) => Expression::Literal(*literal),
            Known::Composite(ty, parts) => Expression::Compose {
                ty: *ty,
                components: parts.iter().map(|part| self.expression(part)).collect(),
            },
        };
        self.expressions.append(expression, Span::UNDEFINED)
    }
}

fn zero(scalar: Scalar) -> Option<Known> {
    Literal::zero(scalar).map(Known::Scalar)
}
