//! Missing and mistaken operators.

use crate::ast::{CompareOp, Expr};
use crate::cursor::{Node, Parser};
use crate::token::TokenKind;
use crate::{Diagnostic, Span};

impl Parser<'_> {
    #[cold]
    pub(crate) fn complain_missing_operator(&mut self) {
        if self.is_hushed() {
            return;
        }
        let (before, here) = (self.last_span(), self.kind());
        let (lhs, rhs) = (self.short(before), self.short(self.span()));
        let is_number = |kind| matches!(kind, TokenKind::Number | TokenKind::Imaginary);
        let (message, hint) = if is_number(here) && is_number(self.behind()) {
            (
                "two numbers stand side by side".to_owned(),
                format!("write `{lhs} * {rhs}` for a product"),
            )
        } else if is_number(here) && self.behind() == TokenKind::Name {
            (
                format!("a number stands behind `{lhs}`"),
                format!("write `{rhs} {lhs}` for a product, `{lhs}^{rhs}` for a power"),
            )
        } else if is_number(here) {
            (
                format!("a number stands behind `{lhs}`"),
                format!("write `* {rhs}` for a product, `^{rhs}` for a power"),
            )
        } else if here == TokenKind::LBrace {
            (
                "missing operator before `{`".to_owned(),
                "write `*` before the cases; a conditional is `if c then a else b`".to_owned(),
            )
        } else if here == TokenKind::Not {
            (
                "missing operator before `not`".to_owned(),
                "write `and not`, or `!=` for unequal".to_owned(),
            )
        } else {
            (
                format!("missing operator before `{rhs}`"),
                format!("write `* ({rhs} …)` for a product"),
            )
        };
        let span = before.join(self.span());
        self.complain(
            Diagnostic::error("missing-operator", span, message)
                .with_label("an operator is missing between these")
                .with_hint(hint),
        );
    }

    /// Takes back the last complaint if it is a missing operator behind `start`, and returns its place: a word or
    /// sign that is missing there explains it better.
    pub(crate) fn retract_missing_operator(&mut self, start: Span) -> Option<Span> {
        let last = self.diagnostics.last()?;
        let is_it = last.code == "missing-operator" && last.span.start >= start.start;
        is_it.then(|| self.take_back()).flatten()
    }

    /// Reads `=` between operands as a comparison; `=<` and `=>` as what they were meant to be.
    #[cold]
    pub(crate) fn complain_equals(&mut self, lhs: Node) -> CompareOp {
        let next = self.span_ahead(1);
        let touches = next.start == self.span().end;
        let (twin, op) = match self.ahead(1) {
            TokenKind::Less if touches => ("<=", CompareOp::LessEqual),
            TokenKind::Greater if touches => (">=", CompareOp::GreaterEqual),
            _ => ("==", CompareOp::Equal),
        };
        let mut span = self.span();
        if twin != "==" {
            span = span.join(next);
        }
        let updates = matches!(self.exprs[lhs.id], Expr::Member { .. });
        let hint = if twin == "==" && self.is_bare_equation(lhs) && updates {
            let lhs = self.short(lhs.span);
            format!("write `==` to compare; components are replaced in `… where {lhs} = …`")
        } else if twin == "==" && self.is_bare_equation(lhs) {
            let lhs = self.short(lhs.span);
            format!(
                "write `==` to compare; for the curve where both sides agree write `{lhs} - (…)`"
            )
        } else {
            format!("write `{twin}` to compare")
        };
        let message = format!("{} inside of an expression", self.quote(span));
        self.complain(
            Diagnostic::error("equals-in-expression", span, message)
                .with_label("defines a name only at the beginning of a statement")
                .with_hint(hint),
        );
        if twin != "==" {
            self.bump();
        }
        op
    }

    /// Reports a problem at the place of a token that has been passed.
    #[cold]
    pub(crate) fn complain_stray_prime(&mut self) {
        let place = self.last_span().join(self.span());
        self.complain_prime_at(place);
        while self.eat(TokenKind::Prime) {}
    }

    fn complain_prime_at(&mut self, place: Span) {
        self.complain(
            Diagnostic::error(
                "stray-prime",
                place,
                "a prime stands behind what is no function",
            )
            .with_label("only a function has a derivative")
            .with_hint("write `f'(x)`, or `diff(expr, x)`"),
        );
    }
}
