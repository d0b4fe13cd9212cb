//! Library functions whose meaning is an instruction or a few: those run on all lanes side by side, where a call takes one
//! lane after another.

use pullback_compiler::ir::Prim;
use pullback_compiler::table::Meaning;

use super::{Parts, Translator};
use crate::executor::code::{Compare, Float1, Float2, Form, Op};
use crate::executor::fault::Fault;
use crate::executor::lanes::Slot;
use crate::executor::library::{Operand, Stand};

impl Translator<'_> {
    /// The one word of a function's result, if instructions give the same bits as its definition.
    pub(super) fn native(
        &mut self,
        stand: Stand,
        operands: &[Operand],
    ) -> Result<Option<Parts>, Fault> {
        let one = |operand: &Operand| match operand {
            Operand::Real(parts) => <[Slot; 1]>::try_from(parts.as_slice()).ok(),
            _ => None,
        };
        let Some(words) = operands.iter().map(one).collect::<Option<Vec<_>>>() else {
            return Ok(None);
        };
        let words = words.concat();
        let value = match (stand, words.as_slice()) {
            (Stand::Number(Meaning::Operation(Prim::Hash)), _) => self.lattice_hash(&words)?,
            (Stand::Number(Meaning::Square), &[x]) => self.binary(real2(Float2::Mul), x, x)?,
            (Stand::Number(Meaning::Operation(prim)), &[x]) => match one_operand(prim) {
                Some(op) => self.unary(op, x)?,
                None => return Ok(None),
            },
            (Stand::Number(Meaning::Operation(prim)), &[x, y]) => match two_operands(prim) {
                Some(op) => self.binary(op, x, y)?,
                None => return Ok(None),
            },
            (Stand::IsNan, &[x]) => self.binary(test(Compare::NotEqual), x, x)?,
            (Stand::IsFinite, &[x]) => self.beside_infinity(Compare::Less, x)?,
            (Stand::IsInfinite, &[x]) => self.beside_infinity(Compare::Equal, x)?,
            (Stand::MagnifyTiny, &[x]) => {
                let factor = self.number(Form::F64, 18_446_744_073_709_551_616.0);
                self.binary(real2(Float2::Mul), x, factor)?
            }
            _ => return Ok(None),
        };
        Ok(Some(vec![value]))
    }

    fn beside_infinity(&mut self, how: Compare, x: Slot) -> Result<Slot, Fault> {
        let size = self.unary(Op::Float1(Form::F64, Float1::Abs), x)?;
        let infinity = self.number(Form::F64, f64::INFINITY);
        self.binary(test(how), size, infinity)
    }

    /// The hash of a lattice point. Points that differ in the first coordinates only share what the others give.
    fn lattice_hash(&mut self, coordinates: &[Slot]) -> Result<Slot, Fault> {
        let zero = self.constant(0);
        let mut inner = zero;
        for &x in coordinates.iter().rev() {
            let word = self.remembered(Op::LatticeWord, x, zero)?;
            inner = self.remembered(Op::HashWords, word, inner)?;
        }
        self.unary(Op::HashNumber, inner)
    }
}

fn real2(fun: Float2) -> Op {
    Op::Float2(Form::F64, fun)
}

fn test(how: Compare) -> Op {
    Op::Compare(Form::F64, how)
}

fn one_operand(prim: Prim) -> Option<Op> {
    let fun = match prim {
        Prim::Neg => Float1::Neg,
        Prim::Abs => Float1::Abs,
        Prim::Floor => Float1::Floor,
        Prim::Ceil => Float1::Ceil,
        Prim::Trunc => Float1::Trunc,
        Prim::Sqrt => Float1::Sqrt,
        _ => return None,
    };
    Some(Op::Float1(Form::F64, fun))
}

fn two_operands(prim: Prim) -> Option<Op> {
    Some(match prim {
        Prim::Add => real2(Float2::Add),
        Prim::Sub => real2(Float2::Sub),
        Prim::Mul => real2(Float2::Mul),
        Prim::Div => real2(Float2::Div),
        Prim::Min => real2(Float2::Min),
        Prim::Max => real2(Float2::Max),
        Prim::Less => test(Compare::Less),
        Prim::LessEqual => test(Compare::LessEqual),
        Prim::Equal => test(Compare::Equal),
        Prim::NotEqual => test(Compare::NotEqual),
        _ => return None,
    })
}
