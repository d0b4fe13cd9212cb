//! Operators and conversions.

use naga::{
    BinaryOperator, Expression, Handle, RelationalFunction, ScalarKind, TypeInner, UnaryOperator,
};

use super::body::Body;
use super::{Parts, Translator};
use crate::executor::code::{Compare, Float1, Float2, Float3, Form, Int1, Int2, Op};
use crate::executor::fault::Fault;
use crate::executor::lanes::{Slot, TRUE};
use crate::executor::{Arithmetic, Contraction};

impl<'m> Translator<'m> {
    pub(super) fn unary_operator(
        &mut self,
        body: &mut Body<'m>,
        op: UnaryOperator,
        expr: Handle<Expression>,
    ) -> Result<Parts, Fault> {
        let form = self.form(body, expr)?;
        let op = match (op, form) {
            (UnaryOperator::Negate, Form::F32 | Form::F64) => Op::Float1(form, Float1::Neg),
            (UnaryOperator::Negate, _) => Op::Int1(form, Int1::Neg),
            (UnaryOperator::LogicalNot, _) | (UnaryOperator::BitwiseNot, Form::Bool) => Op::Not,
            (UnaryOperator::BitwiseNot, _) => Op::Int1(form, Int1::Not),
        };
        let parts = self.value(body, expr)?;
        parts.into_iter().map(|a| self.unary(op, a)).collect()
    }

    pub(super) fn binary_operator(
        &mut self,
        body: &mut Body<'m>,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Result<Parts, Fault> {
        let form = self.form(body, left)?;
        let (a, b) = (self.value(body, left)?, self.value(body, right)?);
        if op == BinaryOperator::Multiply {
            let (l, r) = (
                self.inner(body, left).clone(),
                self.inner(body, right).clone(),
            );
            if let Some(product) = self.matrix_product(form, (&l, &a), (&r, &b))? {
                return Ok(product);
            }
        }
        if let Some(fused) = self.contracted(body, op, (left, &a), (right, &b))? {
            return Ok(fused);
        }
        let op = operator(op, form);
        let count = a.len().max(b.len());
        // a scalar beside a vector counts for each component
        let at = |parts: &Parts, k: usize| parts[if parts.len() == 1 { 0 } else { k }];
        (0..count)
            .map(|k| match op {
                // hashes are nested in these
                Op::Int2(Form::U32, Int2::Add) => self.remembered(op, at(&a, k), at(&b, k)),
                _ => self.binary(op, at(&a, k), at(&b, k)),
            })
            .collect()
    }

    /// A sum or difference with a product that is not rounded, where the options ask for that and there is one.
    fn contracted(
        &mut self,
        body: &mut Body<'m>,
        op: BinaryOperator,
        (left, a): (Handle<Expression>, &Parts),
        (right, b): (Handle<Expression>, &Parts),
    ) -> Result<Option<Parts>, Fault> {
        let minus = match op {
            BinaryOperator::Add => false,
            BinaryOperator::Subtract => true,
            _ => return Ok(None),
        };
        let sides = match self.options.contraction {
            Contraction::None => return Ok(None),
            Contraction::Left => [true, false],
            Contraction::Right => [false, true],
        };
        let form = self.form(body, left)?;
        for is_left in sides {
            let (product, addend) = if is_left { (left, b) } else { (right, a) };
            let Some((x, y)) = self.lone_product(body, product) else {
                continue;
            };
            let (x, y) = (self.value(body, x)?, self.value(body, y)?);
            let count = a.len().max(b.len());
            let at = |parts: &Parts, k: usize| parts[if parts.len() == 1 { 0 } else { k }];
            let mut out = Parts::new();
            for k in 0..count {
                let (mut x, y, mut z) = (at(&x, k), at(&y, k), at(addend, k));
                let negated = if is_left { &mut z } else { &mut x };
                if minus {
                    *negated = self.unary(Op::Float1(form, Float1::Neg), *negated)?;
                }
                out.push(self.ternary(Op::Float3(form, Float3::Fma), x, y, z)?);
            }
            return Ok(Some(out));
        }
        Ok(None)
    }

    /// The factors of a product of 32-bit numbers, or of vectors of such, that is needed once.
    fn lone_product(
        &self,
        body: &Body<'m>,
        product: Handle<Expression>,
    ) -> Option<(Handle<Expression>, Handle<Expression>)> {
        let &Expression::Binary { op, left, right } = &body.function.expressions[product] else {
            return None;
        };
        let is_matrix = |side| matches!(self.inner(body, side), TypeInner::Matrix { .. });
        let fits = op == BinaryOperator::Multiply
            && body.info[product].ref_count == 1
            && self.form(body, product).ok()? == Form::F32
            && !is_matrix(left)
            && !is_matrix(right);
        fits.then_some((left, right))
    }

    /// The product of matrices, or of a matrix and a vector: sums over the columns of the left one, in their order.
    fn matrix_product(
        &mut self,
        form: Form,
        (left, a): (&TypeInner, &Parts),
        (right, b): (&TypeInner, &Parts),
    ) -> Result<Option<Parts>, Fault> {
        let shape = |inner: &TypeInner| match *inner {
            TypeInner::Matrix { columns, rows, .. } => Some((columns as usize, rows as usize)),
            _ => None,
        };
        // rows and columns of both; a vector is a row on the left, a column on the right
        let is_scalar = |inner: &TypeInner| matches!(inner, TypeInner::Scalar(_));
        let (l, r) = match (shape(left), shape(right)) {
            (None, None) => return Ok(None),
            _ if is_scalar(left) || is_scalar(right) => return Ok(None),
            (Some(l), Some(r)) => (l, r),
            (Some(l), None) => (l, (1, b.len())),
            (None, Some(r)) => ((a.len(), 1), r),
        };
        let mut out = Vec::new();
        for column in 0..r.0 {
            for row in 0..l.1 {
                let mut sum = None;
                for k in 0..l.0 {
                    let (x, y) = (a[k * l.1 + row], b[column * r.1 + k]);
                    let term = self.binary(Op::Float2(form, Float2::Mul), x, y)?;
                    sum = Some(match sum {
                        None => term,
                        Some(sum) => self.binary(Op::Float2(form, Float2::Add), sum, term)?,
                    });
                }
                out.extend(sum);
            }
        }
        Ok(Some(out))
    }

    pub(super) fn relational(
        &mut self,
        body: &mut Body<'m>,
        fun: RelationalFunction,
        argument: Handle<Expression>,
    ) -> Result<Parts, Fault> {
        let form = self.form(body, argument)?;
        let parts = self.value(body, argument)?;
        let (op, start) = match fun {
            RelationalFunction::All => (Op::And, TRUE),
            RelationalFunction::Any => (Op::Or, 0),
            RelationalFunction::IsNan => {
                let differs = Op::Compare(form, Compare::NotEqual);
                return parts
                    .into_iter()
                    .map(|a| self.binary(differs, a, a))
                    .collect();
            }
            RelationalFunction::IsInf => {
                return Err(Fault::unsupported("a test for infinities"));
            }
        };
        let mut all = self.constant(start);
        for part in parts {
            all = self.binary(op, all, part)?;
        }
        Ok(vec![all])
    }

    /// A conversion, or the same bits as another type.
    pub(super) fn cast(
        &mut self,
        body: &mut Body<'m>,
        expr: Handle<Expression>,
        kind: ScalarKind,
        convert: Option<u8>,
    ) -> Result<Parts, Fault> {
        let from = self.form(body, expr)?;
        let scalar = self.inner(body, expr).scalar();
        let width = scalar.map_or(4, |scalar| scalar.width);
        let to = self.shapes.form(naga::Scalar {
            kind,
            width: convert.unwrap_or(width),
        })?;
        let parts = self.value(body, expr)?;
        let op = match convert {
            // words of the same form are read alike
            _ if from == to => return Ok(parts),
            Some(_) => Op::Convert(from, to),
            None if self.options.arithmetic == Arithmetic::Reference && width == 4 => {
                match (from.is_float(), to.is_float()) {
                    (true, false) => Op::BitsOfNearest,
                    (false, true) => Op::NumberOfBits,
                    _ => return Ok(parts),
                }
            }
            None => return Ok(parts),
        };
        parts.into_iter().map(|a| self.unary(op, a)).collect()
    }

    /// A function of two numbers of a form.
    pub(super) fn float2(
        &mut self,
        form: Form,
        fun: Float2,
        a: Slot,
        b: Slot,
    ) -> Result<Slot, Fault> {
        self.binary(Op::Float2(form, fun), a, b)
    }
}

fn operator(op: BinaryOperator, form: Form) -> Op {
    use BinaryOperator as B;
    let number = |float: Float2, int: Int2| {
        if form.is_float() {
            Op::Float2(form, float)
        } else {
            Op::Int2(form, int)
        }
    };
    match op {
        B::Add => number(Float2::Add, Int2::Add),
        B::Subtract => number(Float2::Sub, Int2::Sub),
        B::Multiply => number(Float2::Mul, Int2::Mul),
        B::Divide => number(Float2::Div, Int2::Div),
        B::Modulo => number(Float2::Rem, Int2::Rem),
        B::Equal => Op::Compare(form, Compare::Equal),
        B::NotEqual => Op::Compare(form, Compare::NotEqual),
        B::Less => Op::Compare(form, Compare::Less),
        B::LessEqual => Op::Compare(form, Compare::LessEqual),
        B::Greater => Op::Compare(form, Compare::Greater),
        B::GreaterEqual => Op::Compare(form, Compare::GreaterEqual),
        B::And | B::LogicalAnd => Op::And,
        B::InclusiveOr | B::LogicalOr => Op::Or,
        B::ExclusiveOr => Op::Xor,
        B::ShiftLeft => Op::Int2(form, Int2::ShiftLeft),
        B::ShiftRight => Op::Int2(form, Int2::ShiftRight),
    }
}
