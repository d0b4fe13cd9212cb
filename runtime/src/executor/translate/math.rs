//! Built-in functions.

use naga::{Expression, Handle, MathFunction};

use super::body::Body;
use super::{Parts, Translator};
use crate::executor::code::{Float1, Float2, Float3, Form, Int1, Int2, Op};
use crate::executor::fault::Fault;
use crate::executor::lanes::Slot;

impl<'m> Translator<'m> {
    pub(super) fn math(
        &mut self,
        body: &mut Body<'m>,
        fun: MathFunction,
        first: Handle<Expression>,
        rest: [Option<Handle<Expression>>; 3],
    ) -> Result<Parts, Fault> {
        let form = self.form(body, first)?;
        let mut arguments = vec![self.value(body, first)?];
        for argument in rest.into_iter().flatten() {
            arguments.push(self.value(body, argument)?);
        }
        if let Some(value) = self.geometry(fun, form, &arguments)? {
            return Ok(value);
        }
        if let Some(value) = self.packing(fun, form, &arguments)? {
            return Ok(value);
        }
        let count = arguments.iter().map(Vec::len).max().unwrap_or(0);
        let mut parts = Vec::with_capacity(count);
        for k in 0..count {
            let at = |parts: &Parts| parts[if parts.len() == 1 { 0 } else { k }];
            let operands: Vec<Slot> = arguments.iter().map(at).collect();
            parts.push(self.component(fun, form, &operands)?);
        }
        Ok(parts)
    }

    /// A function that works on each component alone.
    fn component(&mut self, fun: MathFunction, form: Form, a: &[Slot]) -> Result<Slot, Fault> {
        let unknown = || Fault::unsupported(format!("the function {fun:?} of these types"));
        match (form.is_float(), a) {
            (true, &[x]) => {
                let fun = float1(fun).ok_or_else(unknown)?;
                self.unary(Op::Float1(form, fun), x)
            }
            (true, &[x, y]) => {
                let fun = float2(fun).ok_or_else(unknown)?;
                self.binary(Op::Float2(form, fun), x, y)
            }
            (true, &[x, y, z]) => {
                let fun = float3(fun).ok_or_else(unknown)?;
                self.ternary(Op::Float3(form, fun), x, y, z)
            }
            (false, &[x]) => {
                let fun = int1(fun).ok_or_else(unknown)?;
                self.unary(Op::Int1(form, fun), x)
            }
            (false, &[x, y]) => {
                let fun = int2(fun).ok_or_else(unknown)?;
                self.binary(Op::Int2(form, fun), x, y)
            }
            (false, &[x, low, high]) if fun == MathFunction::Clamp => {
                let above = self.binary(Op::Int2(form, Int2::Max), x, low)?;
                self.binary(Op::Int2(form, Int2::Min), above, high)
            }
            _ => Err(unknown()),
        }
    }

    /// Functions of whole vectors, in terms of sums and products in the order of the components.
    fn geometry(
        &mut self,
        fun: MathFunction,
        form: Form,
        a: &[Parts],
    ) -> Result<Option<Parts>, Fault> {
        Ok(Some(match (fun, a) {
            (MathFunction::Dot, [x, y]) => vec![self.dot(form, x, y)?],
            (MathFunction::Length, [x]) => vec![self.length(form, x)?],
            (MathFunction::Distance, [x, y]) => {
                let difference = self.each(form, Float2::Sub, x, y)?;
                vec![self.length(form, &difference)?]
            }
            (MathFunction::Normalize, [x]) => {
                let length = vec![self.length(form, x)?];
                self.each(form, Float2::Div, x, &length)?
            }
            (MathFunction::Cross, [x, y]) => self.cross(form, x, y)?,
            (MathFunction::Reflect, [e, n]) => {
                // e - 2 (n · e) n
                let along = self.dot(form, n, e)?;
                let two = self.number(form, 2.0);
                let twice = vec![self.float2(form, Float2::Mul, two, along)?];
                let part = self.each(form, Float2::Mul, &twice, n)?;
                self.each(form, Float2::Sub, e, &part)?
            }
            _ => return Ok(None),
        }))
    }

    fn each(&mut self, form: Form, fun: Float2, a: &Parts, b: &Parts) -> Result<Parts, Fault> {
        let at = |parts: &Parts, k: usize| parts[if parts.len() == 1 { 0 } else { k }];
        (0..a.len().max(b.len()))
            .map(|k| self.float2(form, fun, at(a, k), at(b, k)))
            .collect()
    }

    fn dot(&mut self, form: Form, a: &Parts, b: &Parts) -> Result<Slot, Fault> {
        let (mul, add) = if form.is_float() {
            (Op::Float2(form, Float2::Mul), Op::Float2(form, Float2::Add))
        } else {
            (Op::Int2(form, Int2::Mul), Op::Int2(form, Int2::Add))
        };
        let mut sum = None;
        for (&x, &y) in a.iter().zip(b) {
            let term = self.binary(mul, x, y)?;
            sum = Some(match sum {
                None => term,
                Some(sum) => self.binary(add, sum, term)?,
            });
        }
        sum.ok_or_else(|| Fault::unsupported("a product of nothing"))
    }

    fn length(&mut self, form: Form, a: &Parts) -> Result<Slot, Fault> {
        if let &[x] = a.as_slice() {
            return self.unary(Op::Float1(form, Float1::Abs), x);
        }
        let square = self.dot(form, a, a)?;
        self.unary(Op::Float1(form, Float1::Sqrt), square)
    }

    fn cross(&mut self, form: Form, a: &Parts, b: &Parts) -> Result<Parts, Fault> {
        let mut parts = Vec::with_capacity(3);
        for (i, j) in [(1, 2), (2, 0), (0, 1)] {
            let first = self.float2(form, Float2::Mul, a[i], b[j])?;
            let second = self.float2(form, Float2::Mul, a[j], b[i])?;
            parts.push(self.float2(form, Float2::Sub, first, second)?);
        }
        Ok(parts)
    }

    /// Colours as bytes: ⌊1/2 + 255 min(max(e, 0), 1)⌋ each, the first lowest.
    fn packing(
        &mut self,
        fun: MathFunction,
        form: Form,
        a: &[Parts],
    ) -> Result<Option<Parts>, Fault> {
        let (MathFunction::Pack4x8unorm, [bytes]) = (fun, a) else {
            return Ok(None);
        };
        let (scale, half) = (self.number(form, 255.0), self.number(form, 0.5));
        let mut word = self.constant(0);
        for (k, &part) in (0..).zip(bytes) {
            let part = self.unary(Op::Float1(form, Float1::Saturate), part)?;
            let part = self.float2(form, Float2::Mul, part, scale)?;
            let part = self.float2(form, Float2::Add, part, half)?;
            let byte = self.unary(Op::Convert(form, Form::U32), part)?;
            let places = self.constant(8 * k);
            let byte = self.binary(Op::Int2(Form::U32, Int2::ShiftLeft), byte, places)?;
            word = self.binary(Op::Or, word, byte)?;
        }
        Ok(Some(vec![word]))
    }
}

fn float1(fun: MathFunction) -> Option<Float1> {
    use MathFunction as M;
    Some(match fun {
        M::Abs => Float1::Abs,
        M::Floor => Float1::Floor,
        M::Ceil => Float1::Ceil,
        M::Round => Float1::Round,
        M::Trunc => Float1::Trunc,
        M::Fract => Float1::Fract,
        M::Sqrt => Float1::Sqrt,
        M::InverseSqrt => Float1::InverseSqrt,
        M::Sign => Float1::Sign,
        M::Saturate => Float1::Saturate,
        M::Sin => Float1::Sin,
        M::Cos => Float1::Cos,
        M::Tan => Float1::Tan,
        M::Asin => Float1::Asin,
        M::Acos => Float1::Acos,
        M::Atan => Float1::Atan,
        M::Sinh => Float1::Sinh,
        M::Cosh => Float1::Cosh,
        M::Tanh => Float1::Tanh,
        M::Asinh => Float1::Asinh,
        M::Acosh => Float1::Acosh,
        M::Atanh => Float1::Atanh,
        M::Exp => Float1::Exp,
        M::Exp2 => Float1::Exp2,
        M::Log => Float1::Log,
        M::Log2 => Float1::Log2,
        M::Radians => Float1::Radians,
        M::Degrees => Float1::Degrees,
        _ => return None,
    })
}

fn float2(fun: MathFunction) -> Option<Float2> {
    use MathFunction as M;
    Some(match fun {
        M::Min => Float2::Min,
        M::Max => Float2::Max,
        M::Pow => Float2::Pow,
        M::Atan2 => Float2::Atan2,
        M::Step => Float2::Step,
        _ => return None,
    })
}

fn float3(fun: MathFunction) -> Option<Float3> {
    use MathFunction as M;
    Some(match fun {
        M::Fma => Float3::Fma,
        M::Clamp => Float3::Clamp,
        M::Mix => Float3::Mix,
        M::SmoothStep => Float3::SmoothStep,
        _ => return None,
    })
}

fn int1(fun: MathFunction) -> Option<Int1> {
    use MathFunction as M;
    Some(match fun {
        M::Abs => Int1::Abs,
        M::Sign => Int1::Sign,
        M::CountLeadingZeros => Int1::CountLeadingZeros,
        M::CountTrailingZeros => Int1::CountTrailingZeros,
        M::CountOneBits => Int1::CountOneBits,
        M::ReverseBits => Int1::ReverseBits,
        M::FirstLeadingBit => Int1::FirstLeadingBit,
        M::FirstTrailingBit => Int1::FirstTrailingBit,
        _ => return None,
    })
}

fn int2(fun: MathFunction) -> Option<Int2> {
    use MathFunction as M;
    Some(match fun {
        M::Min => Int2::Min,
        M::Max => Int2::Max,
        _ => return None,
    })
}
