//! Operands that must be whole numbers.

use pullback_grammar::{Diagnostic, Span};

use super::Builder;
use crate::ir::{Id, Prim, Ty};
use crate::numeral::Numeral;
use crate::table;

impl Builder<'_> {
    /// What is wrong with an operand that is constant and must be a whole number.
    pub(super) fn not_whole(&self, prim: Prim, ids: &[Id], span: Span) -> Option<Diagnostic> {
        let complex = ids.iter().any(|&id| self.graph.ty(id) == Ty::Complex);
        let whole = table::whole(prim, complex)?;
        let value = self.graph.as_real(*ids.get(whole.place)?)?;
        let fits = value.fract() == 0.0
            && (f64::from(whole.least)..=f64::from(whole.most)).contains(&value);
        if fits {
            return None;
        }
        let row = table::row(prim);
        let numbers = if complex { "complex numbers" } else { "reals" };
        let problem = Diagnostic::error(
            "not-whole",
            span,
            format!(
                "the {} of `{}` is {}",
                whole.what,
                row.sign(),
                Numeral(value)
            ),
        );
        Some(problem.with_hint(format!(
            "of {numbers} it is a whole number from {} to {}, and `{}` is how it is written",
            whole.least, whole.most, row.usage
        )))
    }
}
