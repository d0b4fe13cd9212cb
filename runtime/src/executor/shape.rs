//! How values of naga's types are laid out: component after component, each a word.

use naga::{ArraySize, Handle, Module, Scalar, ScalarKind, Type, TypeInner};

use super::Arithmetic;
use super::code::Form;
use super::fault::Fault;

/// Most components of a type.
const MOST: u32 = 1 << 20;

/// Numbers of components of a module's types.
#[derive(Debug)]
pub(super) struct Shapes<'m> {
    module: &'m Module,
    arithmetic: Arithmetic,
    /// For each type, 0 where it has no fixed number.
    sizes: Vec<u32>,
}

impl<'m> Shapes<'m> {
    pub fn new(module: &'m Module, arithmetic: Arithmetic) -> Self {
        let mut shapes = Self {
            module,
            arithmetic,
            sizes: Vec::with_capacity(module.types.len()),
        };
        // what a type is made of precedes it
        for (_, ty) in module.types.iter() {
            let size = shapes.fixed_size(&ty.inner).unwrap_or(0);
            shapes.sizes.push(size);
        }
        shapes
    }

    fn fixed_size(&self, inner: &TypeInner) -> Option<u32> {
        let known = |ty: Handle<Type>| match self.sizes[ty.index()] {
            0 => None,
            size => Some(size),
        };
        let size = match *inner {
            TypeInner::Scalar(_) => 1,
            TypeInner::Vector { size, .. } => size as u32,
            TypeInner::Matrix { columns, rows, .. } => columns as u32 * rows as u32,
            TypeInner::Array {
                base,
                size: ArraySize::Constant(count),
                ..
            } => known(base)?.checked_mul(count.get())?,
            TypeInner::Struct { ref members, .. } => members
                .iter()
                .try_fold(0u32, |sum, member| sum.checked_add(known(member.ty)?))?,
            _ => return None,
        };
        (size <= MOST).then_some(size)
    }

    /// Components of a type.
    pub fn size(&self, ty: Handle<Type>) -> Result<u32, Fault> {
        match self.sizes[ty.index()] {
            0 => Err(self.unsupported(&self.module.types[ty].inner)),
            size => Ok(size),
        }
    }

    fn unsupported(&self, inner: &TypeInner) -> Fault {
        let words = match inner {
            TypeInner::Array { .. } => "an array of this size as a value",
            TypeInner::Image { .. } => "a texture",
            TypeInner::Sampler { .. } => "a sampler",
            TypeInner::Atomic(_) => "an atomic",
            TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => "a pointer as a value",
            _ => "a type other than numbers and aggregates",
        };
        Fault::unsupported(words)
    }

    /// Components of a type that need not be in the module.
    pub fn inner_size(&self, inner: &TypeInner) -> Result<u32, Fault> {
        self.fixed_size(inner)
            .ok_or_else(|| self.unsupported(inner))
    }

    /// Components before a part of a composite value, and components of the part.
    pub fn part(&self, inner: &TypeInner, index: u32) -> Result<(u32, u32), Fault> {
        Ok(match *inner {
            TypeInner::Vector { .. } => (index, 1),
            TypeInner::Matrix { rows, .. } => (index * rows as u32, rows as u32),
            TypeInner::Array { base, .. } => {
                let size = self.size(base)?;
                (index.saturating_mul(size), size)
            }
            TypeInner::Struct { ref members, .. } => {
                let mut before = 0;
                for member in members.iter().take(index as usize) {
                    before += self.size(member.ty)?;
                }
                let part = members.get(index as usize);
                let part = part.ok_or_else(|| Fault::unsupported("a member beyond the last"))?;
                (before, self.size(part.ty)?)
            }
            _ => return Err(Fault::unsupported("a part of something without parts")),
        })
    }

    /// Elements of what is indexed and components of each; no number of elements for those that the buffer tells.
    pub fn elements(&self, inner: &TypeInner) -> Result<(Option<u32>, u32), Fault> {
        Ok(match *inner {
            TypeInner::Vector { size, .. } => (Some(size as u32), 1),
            TypeInner::Matrix { columns, rows, .. } => (Some(columns as u32), rows as u32),
            TypeInner::Array { base, size, .. } => {
                let count = match size {
                    ArraySize::Constant(count) => Some(count.get()),
                    _ => None,
                };
                (count, self.size(base)?)
            }
            _ => {
                return Err(Fault::unsupported(
                    "an index into something without elements",
                ));
            }
        })
    }

    /// How a scalar's words are read.
    pub fn form(&self, scalar: Scalar) -> Result<Form, Fault> {
        Ok(match (scalar.kind, scalar.width) {
            (ScalarKind::Bool, _) => Form::Bool,
            (ScalarKind::Sint, 4) => Form::I32,
            (ScalarKind::Uint, 4) => Form::U32,
            (ScalarKind::Sint, 8) => Form::I64,
            (ScalarKind::Uint, 8) => Form::U64,
            (ScalarKind::Float, 4) if self.arithmetic == Arithmetic::Ieee32 => Form::F32,
            (ScalarKind::Float, 4 | 8) => Form::F64,
            _ => return Err(Fault::unsupported("a number of this width")),
        })
    }

    /// How each component is read.
    pub fn forms(&self, inner: &TypeInner, out: &mut Vec<Form>) -> Result<(), Fault> {
        // types nest no deeper than their declarations
        match *inner {
            TypeInner::Scalar(scalar) => out.push(self.form(scalar)?),
            TypeInner::Vector { scalar, .. } | TypeInner::Matrix { scalar, .. } => {
                let count = self.inner_size(inner)? as usize;
                out.extend(std::iter::repeat_n(self.form(scalar)?, count));
            }
            TypeInner::Array {
                base,
                size: ArraySize::Constant(count),
                ..
            } => {
                let mut element = Vec::new();
                self.forms(&self.module.types[base].inner, &mut element)?;
                self.inner_size(inner)?;
                for _ in 0..count.get() {
                    out.extend_from_slice(&element);
                }
            }
            TypeInner::Struct { ref members, .. } => {
                for member in members {
                    self.forms(&self.module.types[member.ty].inner, out)?;
                }
            }
            _ => return Err(self.unsupported(inner)),
        }
        Ok(())
    }
}
