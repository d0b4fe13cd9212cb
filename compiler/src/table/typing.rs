//! Operand and result types of the operations.

use crate::ir::Ty;

/// A rule that gives the result type for operand types.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Typing {
    /// Reals, complex numbers, or both mixed without widening (C99 Annex G.5.1); complex if any is.
    Arithmetic(usize),
    /// Reals to a real, complex numbers to a complex number.
    Analytic(usize),
    /// Reals and complex numbers to a complex number; reals count as complex.
    Complex(usize),
    /// Reals to a real.
    Real(usize),
    /// A real or complex number to a real.
    Part,
    /// Two reals to a complex number.
    MakeComplex,
    /// Two reals to a truth value.
    Order,
    /// Two reals or two complex numbers to a truth value.
    Equality,
    /// Truth values to a truth value.
    Logic(usize),
    /// A truth value and two values of one type to a value of that type.
    Select,
}

impl Typing {
    /// Number of operands.
    #[must_use]
    pub fn arity(self) -> usize {
        match self {
            Self::Arithmetic(n)
            | Self::Analytic(n)
            | Self::Complex(n)
            | Self::Real(n)
            | Self::Logic(n) => n,
            Self::Part => 1,
            Self::MakeComplex | Self::Order | Self::Equality => 2,
            Self::Select => 3,
        }
    }

    /// Result type, or `None` where the operands do not fit.
    #[must_use]
    pub fn result(self, operands: &[Ty]) -> Option<Ty> {
        if operands.len() != self.arity() {
            return None;
        }
        let all = |ty| operands.iter().all(|&t| t == ty);
        let numeric = !operands.contains(&Ty::Bool);
        match self {
            Self::Arithmetic(_) if numeric => {
                Some(if all(Ty::Real) { Ty::Real } else { Ty::Complex })
            }
            Self::Analytic(_) if all(Ty::Real) => Some(Ty::Real),
            Self::Analytic(_) if all(Ty::Complex) => Some(Ty::Complex),
            Self::Complex(_) if all(Ty::Complex) => Some(Ty::Complex),
            Self::Real(_) if all(Ty::Real) => Some(Ty::Real),
            Self::Part if numeric => Some(Ty::Real),
            Self::MakeComplex if all(Ty::Real) => Some(Ty::Complex),
            Self::Order if all(Ty::Real) => Some(Ty::Bool),
            Self::Equality if all(Ty::Real) || all(Ty::Complex) => Some(Ty::Bool),
            Self::Logic(_) if all(Ty::Bool) => Some(Ty::Bool),
            Self::Select if operands[0] == Ty::Bool && operands[1] == operands[2] => {
                Some(operands[1])
            }
            _ => None,
        }
    }

    /// Whether real and complex operands may stand side by side.
    #[must_use]
    pub fn mixes_real_and_complex(self) -> bool {
        matches!(self, Self::Arithmetic(_) | Self::Part)
    }
}
