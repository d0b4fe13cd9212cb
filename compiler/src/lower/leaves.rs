//! What a function takes: its arguments, and the uniforms.

use naga::{BinaryOperator, Expression, GlobalVariable, Handle, SwizzleComponent, VectorSize};

use super::LowerError;
use super::function::{Argument, Base, Leaves, Lowering};
use crate::ir::Ty;

type Value = Handle<Expression>;

impl Lowering<'_, '_, '_> {
    pub(super) fn input(&mut self, k: u16, ty: Ty) -> Result<Value, LowerError> {
        let place = self.inputs.get(usize::from(k)).copied();
        match place.ok_or(LowerError::NoForm("an input"))? {
            Argument::Whole(a) => self.whole(a, ty),
            Argument::Component(a, index) => {
                let base = self.argument(a)?;
                let value = self.part(base, index);
                self.received(value)
            }
            Argument::Pair(a, re, im) => {
                let base = self.argument(a)?;
                let (re, im) = (self.part(base, re), self.part(base, im));
                let (re, im) = (self.received(re)?, self.received(im)?);
                Ok(self.complex(re, im))
            }
            Argument::Offset(a, index) => {
                let base = self.argument(a)?;
                let offset = self.part(base, index);
                self.beside_center(offset, index)
            }
            Argument::OffsetPoint(a) => self.point_at_center(a),
        }
    }

    /// An argument that is one number by itself: a real, or a complex number as a vector.
    fn whole(&mut self, a: u32, ty: Ty) -> Result<Value, LowerError> {
        let value = self.argument(a)?;
        if self.wide || !self.format.is_wide() {
            return Ok(value);
        }
        if ty != Ty::Complex {
            return self.widened(value);
        }
        let (re, im) = (self.part(value, 0), self.part(value, 1));
        let (re, im) = (self.widened(re)?, self.widened(im)?);
        Ok(self.complex(re, im))
    }

    /// A number as it came in the arguments, in the tier's format.
    fn received(&mut self, value: Value) -> Result<Value, LowerError> {
        if self.wide {
            Ok(value)
        } else {
            self.widened(value)
        }
    }

    /// A world coordinate: that of the view's centre, which has all digits of the tier, plus an offset.
    fn beside_center(&mut self, offset: Value, index: u32) -> Result<Value, LowerError> {
        match self.leaves {
            Leaves::Words(wide) => {
                let center = self.word_number(wide, "center", index)?;
                self.library("add32", vec![center, offset])
            }
            Leaves::Uniforms { clock, .. } => {
                let pointer = self.member(clock, "center")?;
                let pointer = self.part(pointer, index);
                let center = self.body.emit(Expression::Load { pointer });
                Ok(self.binary(BinaryOperator::Add, center, offset))
            }
            Leaves::Arguments { .. } | Leaves::Structure { .. } => {
                Err(LowerError::NoForm("a view"))
            }
        }
    }

    fn point_at_center(&mut self, a: u32) -> Result<Value, LowerError> {
        let offset = self.argument(a)?;
        if let Leaves::Uniforms { clock, .. } = self.leaves {
            let pointer = self.member(clock, "center")?;
            let center = self.body.emit(Expression::Load { pointer });
            return Ok(self.binary(BinaryOperator::Add, center, offset));
        }
        let (x, y) = (self.part(offset, 0), self.part(offset, 1));
        let (x, y) = (self.beside_center(x, 0)?, self.beside_center(y, 1)?);
        Ok(self.complex(x, y))
    }

    pub(super) fn param(&mut self, k: u16) -> Result<Value, LowerError> {
        let k = u32::from(k);
        match self.leaves {
            Leaves::Arguments { params, .. } => {
                let value = self.argument(params + k)?;
                self.widened(value)
            }
            Leaves::Structure { base, .. } => self.member_of(base, k),
            Leaves::Words(wide) => self.word_number(wide, "params", k),
            Leaves::Uniforms { params, .. } => {
                let base = self.body.declare(Expression::GlobalVariable(params));
                let base = self.part(base, k / 4);
                let pointer = self.part(base, k % 4);
                Ok(self.body.emit(Expression::Load { pointer }))
            }
        }
    }

    /// The clock or the footprint.
    pub(super) fn clock(&mut self, name: &str) -> Result<Value, LowerError> {
        match self.leaves {
            Leaves::Arguments { time, pixel, .. } => {
                let value = self.argument(if name == "time" { time } else { pixel })?;
                self.widened(value)
            }
            Leaves::Structure { base, time, pixel } => {
                self.member_of(base, if name == "time" { time } else { pixel })
            }
            Leaves::Words(wide) => {
                self.word_number(wide, "clock", if name == "time" { 0 } else { 1 })
            }
            Leaves::Uniforms { clock, .. } => {
                let pointer = self.member(clock, name)?;
                Ok(self.body.emit(Expression::Load { pointer }))
            }
        }
    }

    /// A member of a structure of single-precision numbers.
    fn member_of(&mut self, base: Base, member: u32) -> Result<Value, LowerError> {
        let value = match base {
            Base::Uniform(global) => {
                let base = self.body.declare(Expression::GlobalVariable(global));
                let pointer = self.part(base, member);
                self.body.emit(Expression::Load { pointer })
            }
            Base::Argument(k) => {
                let base = self.argument(k)?;
                self.part(base, member)
            }
        };
        self.widened(value)
    }

    /// The k-th number of a member of `wide`: two to a `vec4<u32>`, in a vector or an array of them.
    fn word_number(
        &mut self,
        wide: Handle<GlobalVariable>,
        name: &str,
        k: u32,
    ) -> Result<Value, LowerError> {
        let mut pointer = self.member(wide, name)?;
        if name == "params" {
            pointer = self.part(pointer, k / 2);
        }
        let vector = self.body.emit(Expression::Load { pointer });
        let pattern = if k.is_multiple_of(2) {
            [SwizzleComponent::X, SwizzleComponent::Y]
        } else {
            [SwizzleComponent::Z, SwizzleComponent::W]
        };
        let [first, second] = pattern;
        let words = self.body.emit(Expression::Swizzle {
            size: VectorSize::Bi,
            vector,
            pattern: [first, second, first, first],
        });
        self.library("real_from_words", vec![words])
    }

    /// Pointer to a member of a buffer that is a structure.
    fn member(&mut self, uniform: Handle<GlobalVariable>, name: &str) -> Result<Value, LowerError> {
        let ty = self.linker.out.global_variables[uniform].ty;
        let naga::TypeInner::Struct { members, .. } = &self.linker.out.types[ty].inner else {
            return Err(LowerError::NoForm("a uniform"));
        };
        let found = members.iter().position(|m| m.name.as_deref() == Some(name));
        let index = found.and_then(|i| u32::try_from(i).ok());
        let index = index.ok_or(LowerError::NoForm("a uniform"))?;
        let base = self.body.declare(Expression::GlobalVariable(uniform));
        Ok(self.part(base, index))
    }

    /// Whether format conversions at the function's border are needed.
    pub(super) fn converts(&self) -> bool {
        self.format.is_wide() && !self.wide
    }
}
