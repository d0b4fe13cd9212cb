//! `1/2x`: a product without a sign behind a division.

use crate::ast::BinaryOp;
use crate::cursor::Parser;
use crate::{Diagnostic, Span};

/// The last division of a chain of products, and what multiplies it without a sign.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Division {
    operands: Option<(Span, Span)>,
    factors: Option<Span>,
}

impl Division {
    /// What has been read so far, if `op` is a division.
    pub(crate) fn of(op: BinaryOp, lhs: Span, rhs: Span) -> Self {
        Self {
            operands: (op == BinaryOp::Div).then_some((lhs, rhs)),
            factors: None,
        }
    }

    /// Takes in a factor without a sign.
    pub(crate) fn multiplied_by(&mut self, factor: Span) {
        self.factors = Some(self.factors.map_or(factor, |factors| factors.join(factor)));
    }
}

impl Parser<'_> {
    /// Shows both readings of a division with factors behind it.
    pub(crate) fn warn_of(&mut self, division: &Division) {
        let (Some((lhs, rhs)), Some(factors)) = (division.operands, division.factors) else {
            return;
        };
        if self.warns_enough() || self.is_spaced_as_read(lhs, rhs, factors) {
            return;
        }
        let (lhs_text, rhs_text, factors_text) =
            (self.short(lhs), self.short(rhs), self.short(factors));
        let read = format!("({lhs_text}/{rhs_text}) {factors_text}");
        let other = format!("{lhs_text}/({rhs_text} {factors_text})");
        let span = lhs.join(factors);
        self.report(
            Diagnostic::warning(
                "ambiguous-division",
                span,
                "a division is followed by a product without a sign",
            )
            .with_label(format!("read as `{read}`"))
            .with_hint(format!("write `{read}`, or `{other}` if that is meant")),
        );
    }

    /// `4/π sin(x)`: the division stands close, the product apart. A line may begin with the `/`.
    fn is_spaced_as_read(&self, lhs: Span, rhs: Span, factors: Span) -> bool {
        let between = |from: Span, to: Span| {
            let start = from.end.min(to.start);
            Span::new(start, to.start).text(self.text)
        };
        let sign = between(lhs, rhs);
        let sign = match sign.rfind(['\n', '\r']) {
            Some(end) => sign.get(end..).unwrap_or_default().trim_start(),
            None => sign,
        };
        !sign.contains(char::is_whitespace) && between(rhs, factors).contains(char::is_whitespace)
    }
}
