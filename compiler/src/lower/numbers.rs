//! Arithmetic in the number format of the tier: operators where the format has them, library functions elsewhere.

use naga::{BinaryOperator, Expression, Handle, Literal, MathFunction, UnaryOperator};

use super::function::Lowering;
use super::{Format, LowerError};

type Value = Handle<Expression>;

impl Lowering<'_, '_, '_> {
    /// A finite constant in the tier's format; `None` where it is NaN or beyond the range.
    pub(super) fn constant(&mut self, value: f64) -> Option<Value> {
        match self.format {
            Format::Single => Some(self.body.literal(finite(value)?)),
            Format::Double => value
                .is_finite()
                .then(|| self.body.declare(Expression::Literal(Literal::F64(value)))),
            Format::Pair => {
                finite(value)?;
                let parts = self.format.words(value).map(f32::from_bits);
                let components = parts.map(|part| self.body.literal(part)).into();
                let ty = self.numbers.real;
                Some(self.body.emit(Expression::Compose { ty, components }))
            }
        }
    }

    /// A single-precision number in the tier's format.
    pub(super) fn widened(&mut self, value: Value) -> Result<Value, LowerError> {
        if self.format.is_wide() {
            self.library("real_from_f32", vec![value])
        } else {
            Ok(value)
        }
    }

    /// The nearest single-precision number.
    pub(super) fn narrowed(&mut self, value: Value) -> Result<Value, LowerError> {
        if self.format.is_wide() {
            self.library("real_to_f32", vec![value])
        } else {
            Ok(value)
        }
    }

    /// An operator on reals or truth values; comparisons with NaN hold as IEEE 754 has it.
    pub(super) fn operator(
        &mut self,
        op: BinaryOperator,
        a: Value,
        b: Value,
    ) -> Result<Value, LowerError> {
        if self.format == Format::Pair {
            if op == BinaryOperator::Multiply && a == b {
                return self.library("real_square", vec![a]);
            }
            if let Some(name) = operator_name(op) {
                return self.library(name, vec![a, b]);
            }
        }
        if op == BinaryOperator::NotEqual {
            // naga writes an ordered comparison in SPIR-V, by which NaN differs from nothing
            let equal = self.binary(BinaryOperator::Equal, a, b);
            return Ok(self.unary(UnaryOperator::LogicalNot, equal));
        }
        Ok(self.binary(op, a, b))
    }

    /// A built-in function that is exact in every format.
    pub(super) fn builtin(
        &mut self,
        fun: MathFunction,
        args: &[Value],
    ) -> Result<Value, LowerError> {
        match builtin_name(fun) {
            Some(name) if self.format.is_wide() || self.linker.offers(name) => {
                self.library(name, args.to_vec())
            }
            _ => Ok(self.math(fun, args)),
        }
    }

    /// A complex number of two reals.
    pub(super) fn complex(&mut self, re: Value, im: Value) -> Value {
        self.body.emit(Expression::Compose {
            ty: self.numbers.complex,
            components: vec![re, im],
        })
    }

    pub(super) fn complex_negated(&mut self, z: Value) -> Value {
        if !self.format.is_wide() {
            return self.unary(UnaryOperator::Negate, z);
        }
        let parts = [0, 1].map(|k| {
            let part = self.part(z, k);
            self.unary(UnaryOperator::Negate, part)
        });
        self.complex(parts[0], parts[1])
    }

    pub(super) fn complex_sum(
        &mut self,
        op: BinaryOperator,
        a: Value,
        b: Value,
    ) -> Result<Value, LowerError> {
        if !self.format.is_wide() {
            return Ok(self.binary(op, a, b));
        }
        self.by_parts(|lowering, k| {
            let (a, b) = (lowering.part(a, k), lowering.part(b, k));
            lowering.operator(op, a, b)
        })
    }

    /// A product or quotient of a complex number and a real one.
    pub(super) fn complex_scaled(
        &mut self,
        op: BinaryOperator,
        z: Value,
        x: Value,
    ) -> Result<Value, LowerError> {
        if self.format.is_wide() {
            return self.by_parts(|lowering, k| {
                let part = lowering.part(z, k);
                lowering.operator(op, part, x)
            });
        }
        if op == BinaryOperator::Multiply {
            return Ok(self.binary(op, z, x));
        }
        let size = naga::VectorSize::Bi;
        let x = self.body.emit(Expression::Splat { size, value: x });
        Ok(self.binary(op, z, x))
    }

    pub(super) fn complex_select(&mut self, args: &[Value]) -> Result<Value, LowerError> {
        if !self.format.is_wide() {
            return Ok(self.select(args));
        }
        let (condition, a, b) = (args[0], args[1], args[2]);
        self.by_parts(|lowering, k| {
            let (a, b) = (lowering.part(a, k), lowering.part(b, k));
            Ok(lowering.select(&[condition, a, b]))
        })
    }

    fn by_parts(
        &mut self,
        mut part: impl FnMut(&mut Self, u32) -> Result<Value, LowerError>,
    ) -> Result<Value, LowerError> {
        let re = part(self, 0)?;
        let im = part(self, 1)?;
        Ok(self.complex(re, im))
    }
}

/// The value as a finite `f32`, or `None` where it is NaN or beyond its range.
fn finite(value: f64) -> Option<f32> {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "rounding to the shader's format is meant"
    )]
    let value = value as f32;
    value.is_finite().then_some(value)
}

/// The library function of an operator that a pair does not have.
fn operator_name(op: BinaryOperator) -> Option<&'static str> {
    Some(match op {
        BinaryOperator::Add => "real_add",
        BinaryOperator::Subtract => "real_sub",
        BinaryOperator::Multiply => "real_mul",
        BinaryOperator::Divide => "real_div",
        BinaryOperator::Less => "real_less",
        BinaryOperator::LessEqual => "real_less_equal",
        BinaryOperator::Equal => "real_equal",
        BinaryOperator::NotEqual => "real_not_equal",
        _ => return None,
    })
}

/// The library function of a built-in, in the wide formats.
fn builtin_name(fun: MathFunction) -> Option<&'static str> {
    Some(match fun {
        MathFunction::Abs => "real_abs",
        MathFunction::Floor => "real_floor",
        MathFunction::Ceil => "real_ceil",
        MathFunction::Trunc => "real_trunc",
        MathFunction::Sqrt => "real_sqrt",
        MathFunction::Min => "real_min",
        MathFunction::Max => "real_max",
        MathFunction::Fma => "real_mul_add",
        _ => return None,
    })
}
