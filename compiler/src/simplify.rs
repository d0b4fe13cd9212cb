//! Building nodes: typing, constant folding and the rewrites that hold bit for bit.
//!
//! Every rewrite stands under its equation. All of them are exact in IEEE 754 arithmetic for every argument,
//! NaN, infinities and signed zeros included; what is not (x + 0 = x fails for -0, x - x = 0 for ∞, x·0 = 0 for
//! NaN) is not here.

use crate::ir::{Graph, Id, Op, Prim, Ty};
use crate::reference::complex::complex;
use crate::table::{self, Number};

impl Graph {
    /// The node that applies `prim` to `args`, simplified. Real operands of a complex operation are widened
    /// where the operation has no mixed form. Operand types must be those that the operator table admits;
    /// otherwise the result is NaN (the checker has reported the mistake before).
    pub fn apply(&mut self, prim: Prim, args: &[Id]) -> Id {
        let row = table::row(prim);
        let mut args: smallvec::SmallVec<[Id; 3]> = args.into();
        let any_complex = args.iter().any(|&a| self.ty(a) == Ty::Complex);
        let always = matches!(row.typing, table::Typing::Complex(_));
        if always || any_complex && !row.typing.mixes_real_and_complex() {
            for arg in &mut args {
                *arg = self.widen(*arg);
            }
        }
        if let Some(id) = self.rewrite(prim, &args) {
            return id;
        }
        if let Some(id) = self.fold(prim, &args) {
            return id;
        }
        let tys: smallvec::SmallVec<[Ty; 3]> = args.iter().map(|&a| self.ty(a)).collect();
        match row.typing.result(&tys) {
            Some(ty) => self.intern(Op::Apply(prim), ty, &args),
            None => self.real(f64::NAN),
        }
    }

    /// `a + b`
    pub fn add(&mut self, a: Id, b: Id) -> Id {
        self.apply(Prim::Add, &[a, b])
    }

    /// `a - b`
    pub fn sub(&mut self, a: Id, b: Id) -> Id {
        self.apply(Prim::Sub, &[a, b])
    }

    /// `a · b`
    pub fn mul(&mut self, a: Id, b: Id) -> Id {
        self.apply(Prim::Mul, &[a, b])
    }

    /// `a / b`
    pub fn div(&mut self, a: Id, b: Id) -> Id {
        self.apply(Prim::Div, &[a, b])
    }

    /// `-a`
    pub fn neg(&mut self, a: Id) -> Id {
        self.apply(Prim::Neg, &[a])
    }

    /// A real as the complex number with imaginary part +0; anything else as it is.
    pub fn widen(&mut self, a: Id) -> Id {
        if self.ty(a) != Ty::Real {
            return a;
        }
        let zero = self.real(0.0);
        self.intern(Op::Apply(Prim::Complex), Ty::Complex, &[a, zero])
    }

    fn args_of(&self, id: Id, prim: Prim) -> Option<smallvec::SmallVec<[Id; 3]>> {
        let node = self.node(id);
        (node.op == Op::Apply(prim)).then(|| node.args.clone())
    }

    fn is_real(&self, id: Id, value: f64) -> bool {
        self.as_real(id)
            .is_some_and(|v| v.to_bits() == value.to_bits())
    }

    fn rewrite(&mut self, prim: Prim, args: &[Id]) -> Option<Id> {
        match (prim, args) {
            (Prim::Neg, &[x]) => self.rewrite_neg(x),
            (Prim::Add, &[x, y]) => self.rewrite_add(x, y),
            (Prim::Sub, &[x, y]) => self.rewrite_sub(x, y),
            (Prim::Mul, &[x, y]) => self.rewrite_mul(x, y),
            (Prim::Div, &[x, y]) => self.rewrite_div(x, y),
            (Prim::Pow, &[x, y]) => self.rewrite_pow(x, y),
            (Prim::PowInt(n), &[x]) => self.rewrite_pow_int(x, n),
            (Prim::Re | Prim::Im | Prim::Conj, &[x]) => self.rewrite_part(prim, x),
            (Prim::Abs, &[x]) => self.rewrite_abs(x),
            // arg x = atan2(+0, x) for real x
            (Prim::Arg, &[x]) if self.ty(x) == Ty::Real => {
                let zero = self.real(0.0);
                Some(self.apply(Prim::Atan2, &[zero, x]))
            }
            (Prim::Select, &[c, a, b]) => self.rewrite_select(c, a, b),
            (Prim::And | Prim::Or, &[a, b]) => self.rewrite_logic(prim, a, b),
            (Prim::Not, &[a]) => Some(self.args_of(a, Prim::Not)?[0]),
            _ => None,
        }
    }

    fn rewrite_neg(&mut self, x: Id) -> Option<Id> {
        // -(-x) = x
        Some(self.args_of(x, Prim::Neg)?[0])
    }

    fn rewrite_add(&mut self, x: Id, y: Id) -> Option<Id> {
        // x + (-0) = x
        if self.is_real(y, -0.0) {
            return Some(x);
        }
        if self.is_real(x, -0.0) {
            return Some(y);
        }
        // x + (-y) = x - y
        if let Some(inner) = self.args_of(y, Prim::Neg) {
            return Some(self.sub(x, inner[0]));
        }
        // (-x) + y = y - x
        if let Some(inner) = self.args_of(x, Prim::Neg) {
            return Some(self.sub(y, inner[0]));
        }
        None
    }

    fn rewrite_sub(&mut self, x: Id, y: Id) -> Option<Id> {
        // x - (+0) = x
        if self.is_real(y, 0.0) {
            return Some(x);
        }
        // x - (-y) = x + y
        let inner = self.args_of(y, Prim::Neg)?;
        Some(self.add(x, inner[0]))
    }

    fn rewrite_mul(&mut self, x: Id, y: Id) -> Option<Id> {
        for (x, y) in [(x, y), (y, x)] {
            // 1·y = y
            if self.is_real(x, 1.0) {
                return Some(y);
            }
            // (-1)·y = -y
            if self.is_real(x, -1.0) {
                return Some(self.neg(y));
            }
        }
        // (-x)·(-y) = x·y and (-x)·y = -(x·y), reals only: a complex product rounds its parts alike, but
        // 0·∞ in one of them would change the sign of a NaN-free zero.
        if self.ty(x) == Ty::Real && self.ty(y) == Ty::Real {
            if let Some(inner) = self.args_of(x, Prim::Neg) {
                let product = self.mul(inner[0], y);
                return Some(self.neg(product));
            }
            if let Some(inner) = self.args_of(y, Prim::Neg) {
                let product = self.mul(x, inner[0]);
                return Some(self.neg(product));
            }
        }
        None
    }

    fn rewrite_div(&mut self, x: Id, y: Id) -> Option<Id> {
        // x / 1 = x
        if self.is_real(y, 1.0) {
            return Some(x);
        }
        // x / (-1) = -x
        if self.is_real(y, -1.0) {
            return Some(self.neg(x));
        }
        // (-x) / y = -(x / y), reals only
        if self.ty(x) == Ty::Real && self.ty(y) == Ty::Real {
            let inner = self.args_of(x, Prim::Neg)?;
            let quotient = self.div(inner[0], y);
            return Some(self.neg(quotient));
        }
        None
    }

    fn rewrite_pow(&mut self, x: Id, y: Id) -> Option<Id> {
        let exponent = match self.as_complex(y) {
            Some((re, 0.0)) => re,
            Some(_) => return None,
            None => self.as_real(y)?,
        };
        // x^n is a product for a constant integer n (C99 7.12.7.4: exact cases agree)
        if exponent.fract() == 0.0 && exponent.abs() <= f64::from(1 << 16) {
            #[allow(clippy::cast_possible_truncation, reason = "bounded just above")]
            return Some(self.apply(Prim::PowInt(exponent as i32), &[x]));
        }
        None
    }

    fn rewrite_pow_int(&mut self, x: Id, n: i32) -> Option<Id> {
        match n {
            // x^0 = 1, NaN^0 = 1 (C99 F.9.4.4)
            0 => Some(if self.ty(x) == Ty::Complex {
                self.complex(1.0, 0.0)
            } else {
                self.real(1.0)
            }),
            // x^1 = x
            1 => Some(x),
            // x^-1 = 1/x
            -1 => {
                let one = self.real(1.0);
                Some(self.div(one, x))
            }
            // (-x)^(2k) = x^(2k)
            _ if n % 2 == 0 && self.ty(x) == Ty::Real => {
                let inner = self.args_of(x, Prim::Neg)?;
                Some(self.apply(Prim::PowInt(n), &[inner[0]]))
            }
            _ => None,
        }
    }

    fn rewrite_part(&mut self, prim: Prim, x: Id) -> Option<Id> {
        // re x = x and conj x = x for real x; im x = 0 is exact as well
        if self.ty(x) == Ty::Real {
            return Some(if prim == Prim::Im { self.real(0.0) } else { x });
        }
        match prim {
            // re(a + b i) = a, im(a + b i) = b
            Prim::Re => Some(self.args_of(x, Prim::Complex)?[0]),
            Prim::Im => Some(self.args_of(x, Prim::Complex)?[1]),
            // conj(conj x) = x
            _ => Some(self.args_of(x, Prim::Conj)?[0]),
        }
    }

    fn rewrite_abs(&mut self, x: Id) -> Option<Id> {
        // |-x| = |x|, |conj x| = |x|
        for prim in [Prim::Neg, Prim::Conj] {
            if let Some(inner) = self.args_of(x, prim) {
                return Some(self.apply(Prim::Abs, &[inner[0]]));
            }
        }
        // ||x|| = |x|
        self.args_of(x, Prim::Abs).map(|_| x)
    }

    fn rewrite_select(&mut self, c: Id, a: Id, b: Id) -> Option<Id> {
        match self.node(c).op {
            Op::Truth(true) => Some(a),
            Op::Truth(false) => Some(b),
            _ if a == b => Some(a),
            _ => None,
        }
    }

    fn rewrite_logic(&mut self, prim: Prim, a: Id, b: Id) -> Option<Id> {
        for (a, b) in [(a, b), (b, a)] {
            if let Op::Truth(value) = self.node(a).op {
                // true and b = b, false and b = false; and the duals
                return Some(if value == (prim == Prim::And) { b } else { a });
            }
        }
        (a == b).then_some(a)
    }

    /// Computes an operation on constants in `f64`.
    fn fold(&mut self, prim: Prim, args: &[Id]) -> Option<Id> {
        if prim == Prim::Complex || prim == Prim::Select || args.is_empty() {
            return None;
        }
        let mut values: smallvec::SmallVec<[Number; 3]> = smallvec::SmallVec::new();
        for &arg in args {
            values.push(if let Some(re) = self.as_real(arg) {
                Number::Real(re)
            } else if let Some((re, im)) = self.as_complex(arg) {
                Number::Complex(complex(re, im))
            } else if let Op::Truth(value) = self.node(arg).op {
                Number::Truth(value)
            } else {
                return None;
            });
        }
        Some(match table::row(prim).evaluate(prim, &values)? {
            Number::Real(x) => self.real(x),
            Number::Complex(z) => self.complex(z.re, z.im),
            Number::Truth(value) => self.truth(value),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eval::{Leaves, Tape};

    const SPECIAL: [f64; 12] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        2.0,
        -3.5,
        0.1,
        1e308,
        -5e-324,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];

    /// Operations whose rewrites claim to hold bit for bit.
    const PRIMS: [Prim; 15] = [
        Prim::Neg,
        Prim::Add,
        Prim::Sub,
        Prim::Mul,
        Prim::Div,
        Prim::Abs,
        Prim::PowInt(0),
        Prim::PowInt(1),
        Prim::PowInt(2),
        Prim::PowInt(4),
        Prim::Re,
        Prim::Conj,
        Prim::Min,
        Prim::Max,
        Prim::Floor,
    ];

    /// Builds the same random tree twice, node by node as it is and simplified, and compares at special values.
    #[test]
    fn rewrites_hold_bit_for_bit() {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let mut next = |n: usize| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            usize::try_from(state >> 33).unwrap_or(0) % n
        };
        let mut rewritten = 0;
        for _ in 0..4000 {
            let (mut plain, mut simple) = (Graph::new(), Graph::new());
            let mut pairs: Vec<(Id, Id)> = (0..2)
                .map(|k| {
                    (
                        plain.leaf(Op::Input(k), Ty::Real),
                        simple.leaf(Op::Input(k), Ty::Real),
                    )
                })
                .collect();
            for _ in 0..2 {
                let value = SPECIAL[next(SPECIAL.len())];
                pairs.push((plain.real(value), simple.real(value)));
            }
            for _ in 0..6 {
                let prim = PRIMS[next(PRIMS.len())];
                let args: Vec<(Id, Id)> = (0..table::row(prim).typing.arity())
                    .map(|_| pairs[next(pairs.len())])
                    .collect();
                let (a, b): (Vec<Id>, Vec<Id>) = args.into_iter().unzip();
                pairs.push((
                    plain.intern(Op::Apply(prim), Ty::Real, &a),
                    simple.apply(prim, &b),
                ));
            }
            let (a, b) = pairs[pairs.len() - 1];
            rewritten += usize::from(
                plain.compacted(&[a]).0.nodes().len() > simple.compacted(&[b]).0.nodes().len(),
            );
            assert_same(&plain, a, &simple, b);
        }
        assert!(rewritten > 1000, "only {rewritten} trees became smaller");
    }

    fn assert_same(plain: &Graph, a: Id, simple: &Graph, b: Id) {
        let (mut plain_tape, mut simple_tape) = (Tape::new(plain, &[a]), Tape::new(simple, &[b]));
        for x in SPECIAL {
            for y in SPECIAL {
                let inputs = [Number::Real(x), Number::Real(y)];
                let leaves = Leaves {
                    inputs: &inputs,
                    params: &[],
                    time: 0.0,
                    pixel: 0.0,
                };
                let run = |tape: &mut Tape| {
                    let mut bits = 0;
                    tape.run(&leaves, |v| {
                        if let Number::Real(v) = v {
                            bits = if v.is_nan() {
                                f64::NAN.to_bits()
                            } else {
                                v.to_bits()
                            };
                        }
                    });
                    bits
                };
                let (want, got) = (run(&mut plain_tape), run(&mut simple_tape));
                assert_eq!(
                    f64::from_bits(want).to_bits(),
                    got,
                    "at ({x:?}, {y:?}):\n{}\nbecame\n{}",
                    crate::ir::to_text(plain, &[a]),
                    crate::ir::to_text(simple, &[b])
                );
            }
        }
    }
}
