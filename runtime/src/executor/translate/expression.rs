//! Expressions.

use naga::{Expression, Handle, Literal, TypeInner, VectorSize};

use super::body::{Body, Known};
use super::{Parts, Translator};
use crate::executor::Arithmetic;
use crate::executor::code::{Form, Op};
use crate::executor::fault::Fault;
use crate::executor::lanes::{Slot, TRUE};

impl<'m> Translator<'m> {
    /// What an expression is. Composition, access and swizzles only rename components.
    pub(super) fn expression(
        &mut self,
        body: &mut Body<'m>,
        handle: Handle<Expression>,
    ) -> Result<Known, Fault> {
        let function = body.function;
        let expression = &function.expressions[handle];
        Ok(Known::Value(match expression {
            Expression::Literal(literal) => vec![self.literal(*literal)?],
            Expression::Constant(constant) => {
                let init = self.module.constants[*constant].init;
                self.global_expression(init)?
            }
            Expression::ZeroValue(ty) => self.zeros(*ty)?,
            Expression::FunctionArgument(k) => {
                let argument = body.arguments.get(*k as usize);
                argument
                    .cloned()
                    .ok_or_else(|| Fault::unsupported("an argument that is not given"))?
            }
            Expression::LocalVariable(_) | Expression::GlobalVariable(_) => {
                return self.variable(body, expression).map(Known::Pointer);
            }
            Expression::Access { base, index } if self.is_pointer(body, *base) => {
                let place = self.pointer_element(body, *base, *index)?;
                return Ok(Known::Pointer(place));
            }
            Expression::AccessIndex { base, index } if self.is_pointer(body, *base) => {
                let place = self.pointer_part(body, *base, *index)?;
                return Ok(Known::Pointer(place));
            }
            Expression::Access { base, index } => self.value_element(body, *base, *index)?,
            Expression::AccessIndex { base, index } => {
                let parts = self.value(body, *base)?;
                let (before, count) = self.shapes.part(self.inner(body, *base), *index)?;
                let range = before as usize..(before + count) as usize;
                let part = parts.get(range);
                part.ok_or_else(|| Fault::unsupported("an index beyond the last element"))?
                    .to_vec()
            }
            Expression::Compose { components, .. } => {
                let mut parts = Vec::new();
                for &component in components {
                    parts.extend(self.value(body, component)?);
                }
                parts
            }
            Expression::Splat { size, value } => vec![self.one(body, *value)?; *size as usize],
            Expression::Swizzle {
                size,
                vector,
                pattern,
            } => {
                let parts = self.value(body, *vector)?;
                swizzled(&parts, *size, pattern.map(|c| c as usize))?
            }
            Expression::Load { pointer } => {
                let place = self.pointer(body, *pointer)?;
                self.load(&place)?
            }
            Expression::Unary { op, expr } => self.unary_operator(body, *op, *expr)?,
            Expression::Binary { op, left, right } => {
                self.binary_operator(body, *op, *left, *right)?
            }
            Expression::Select {
                condition,
                accept,
                reject,
            } => self.select(body, *condition, *accept, *reject)?,
            Expression::Relational { fun, argument } => self.relational(body, *fun, *argument)?,
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                arg3,
            } => {
                let rest = [*arg1, *arg2, *arg3];
                self.math(body, *fun, *arg, rest)?
            }
            Expression::As {
                expr,
                kind,
                convert,
            } => self.cast(body, *expr, *kind, *convert)?,
            other => return Err(Fault::unsupported(words(other))),
        }))
    }

    fn is_pointer(&self, body: &Body<'m>, handle: Handle<Expression>) -> bool {
        matches!(
            self.inner(body, handle),
            TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. }
        )
    }

    fn zeros(&mut self, ty: Handle<naga::Type>) -> Result<Parts, Fault> {
        // zero of every type has no bit set
        let count = self.shapes.size(ty)?;
        Ok(vec![self.constant(0); count as usize])
    }

    fn literal(&mut self, literal: Literal) -> Result<Slot, Fault> {
        let word = match literal {
            Literal::F64(x) => x.to_bits(),
            Literal::F32(x) => self.float_word(x.into()),
            Literal::U32(n) => n.into(),
            Literal::I32(n) => n.cast_unsigned().into(),
            Literal::U64(n) => n,
            Literal::I64(n) => n.cast_unsigned(),
            Literal::Bool(true) => TRUE,
            Literal::Bool(false) => 0,
            _ => return Err(Fault::unsupported("a literal of this type")),
        };
        Ok(self.constant(word))
    }

    /// The word of a number of single precision, in the arithmetic.
    fn float_word(&self, x: f64) -> u64 {
        match self.options.arithmetic {
            Arithmetic::Reference => x.to_bits(),
            Arithmetic::Ieee32 => u64::from((x as f32).to_bits()),
        }
    }

    /// A uniform number.
    pub(super) fn number(&mut self, form: Form, x: f64) -> Slot {
        let word = crate::executor::integer::convert(x.to_bits(), Form::F64, form);
        self.constant(word)
    }

    /// A constant of the module.
    fn global_expression(&mut self, handle: Handle<Expression>) -> Result<Parts, Fault> {
        let module = self.module;
        Ok(match &module.global_expressions[handle] {
            Expression::Literal(literal) => vec![self.literal(*literal)?],
            Expression::Constant(constant) => {
                self.global_expression(module.constants[*constant].init)?
            }
            Expression::ZeroValue(ty) => self.zeros(*ty)?,
            Expression::Compose { components, .. } => {
                let mut parts = Vec::new();
                for &component in components {
                    parts.extend(self.global_expression(component)?);
                }
                parts
            }
            Expression::Splat { size, value } => {
                let parts = self.global_expression(*value)?;
                vec![parts[0]; *size as usize]
            }
            other => return Err(Fault::unsupported(words(other))),
        })
    }

    fn select(
        &mut self,
        body: &mut Body<'m>,
        condition: Handle<Expression>,
        accept: Handle<Expression>,
        reject: Handle<Expression>,
    ) -> Result<Parts, Fault> {
        let conditions = self.value(body, condition)?;
        let accept = self.value(body, accept)?;
        let reject = self.value(body, reject)?;
        let mut parts = Vec::with_capacity(accept.len());
        for (k, (&a, &b)) in accept.iter().zip(&reject).enumerate() {
            let condition = conditions[if conditions.len() == 1 { 0 } else { k }];
            parts.push(self.ternary(Op::Select, condition, a, b)?);
        }
        Ok(parts)
    }
}

fn swizzled(parts: &[Slot], size: VectorSize, pattern: [usize; 4]) -> Result<Parts, Fault> {
    let places = pattern.into_iter().take(size as usize);
    let found: Option<Parts> = places.map(|k| parts.get(k).copied()).collect();
    found.ok_or_else(|| Fault::unsupported("a swizzle beyond the last component"))
}

fn words(expression: &Expression) -> &'static str {
    match expression {
        Expression::Override(_) => "an override",
        Expression::ImageSample { .. } => "texture sampling",
        Expression::ImageLoad { .. } | Expression::ImageQuery { .. } => "reading a texture",
        Expression::Derivative { .. } => "a derivative across pixels",
        Expression::AtomicResult { .. } => "an atomic operation",
        Expression::WorkGroupUniformLoadResult { .. } => "workgroup memory",
        Expression::ArrayLength(_) => "the length of a buffer",
        Expression::CallResult(_) => "the result of a call that was not made",
        _ => "an expression of this kind",
    }
}
