//! Missing and mistaken operators.

use crate::ast::{CompareOp, Expr};
use crate::cursor::{Node, Parser};
use crate::layout::StatementKind;
use crate::token::TokenKind;
use crate::{Diagnostic, Span};

impl Parser<'_> {
    #[cold]
    pub(crate) fn complain_missing_operator(&mut self) {
        if self.is_hushed() {
            return;
        }
        let (before, here) = (self.last_span(), self.kind());
        if here == TokenKind::LBrace && self.end_of_list(1).is_some() {
            // the braces are complained about
            return;
        }
        let (lhs, rhs) = (self.short(before), self.short(self.span()));
        let is_number = |kind| matches!(kind, TokenKind::Number | TokenKind::Imaginary);
        let is_split = rhs.starts_with('.') && before.end == self.span().start;
        let (message, hint) = if is_number(here) && is_number(self.behind()) && is_split {
            (
                "a number with two points".to_owned(),
                format!("write `{lhs} * {rhs}` for a product, `a..b` for a range"),
            )
        } else if is_number(here) && is_number(self.behind()) {
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
                format!("for a product write `* {rhs}`, for a power `^{rhs}`"),
            )
        } else if here == TokenKind::LBrace {
            (
                "missing operator before `{`".to_owned(),
                "put `*` before the cases; a choice is `if c then a else b`".to_owned(),
            )
        } else if here == TokenKind::Not {
            (
                "missing operator before `not`".to_owned(),
                "for two conditions write `and not`; unequal is `!=`".to_owned(),
            )
        } else {
            (
                format!("missing operator before `{rhs}`"),
                format!(
                    "put an operator between them, or brackets around the second: `* ({rhs} …)`"
                ),
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
            TokenKind::Bang if touches => ("!=", CompareOp::NotEqual),
            TokenKind::Less if touches => ("<=", CompareOp::LessEqual),
            TokenKind::Greater if touches => (">=", CompareOp::GreaterEqual),
            _ => ("==", CompareOp::Equal),
        };
        let mut span = self.span();
        if twin != "==" {
            span = span.join(next);
        }
        let updates = matches!(self.exprs[lhs.id], Expr::Member { .. });
        if twin == ">=" && self.open_parens == 0 && self.statement == StatementKind::Constant {
            let arrow = self.bump();
            self.complain_arrow(arrow);
            return op;
        }
        if twin == "==" && !updates && self.is_equation() {
            self.complain_equation(lhs);
            return op;
        }
        let hint = if twin == "==" && self.is_bare_equation(lhs) && updates {
            let lhs = self.short(lhs.span);
            format!("components are replaced in `… where {lhs} = …`; to compare write `==`")
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

    /// Whether the `=` here stands between the two sides of a statement: outside of brackets, conditions and lists.
    fn is_equation(&self) -> bool {
        let is_inside = self.open_parens + self.open_braces > 0 || self.bars > 0;
        let of_values = matches!(
            self.statement,
            StatementKind::Formula | StatementKind::Function
        );
        of_values && !is_inside && !self.in_condition
    }

    /// An equation is no function: the difference of its sides is, and it is 0 where they agree. The rest of the
    /// statement is left unread.
    #[cold]
    fn complain_equation(&mut self, lhs: Node) {
        if self.is_hushed() {
            self.abandon();
            return;
        }
        let place = self.span();
        self.bump();
        let rhs = self.rest();
        if rhs.start == rhs.end {
            self.complain_missing_operand_behind(place);
            return;
        }
        let is_sum = (0..40).any(|n| matches!(self.ahead(n), TokenKind::Plus | TokenKind::Minus));
        let text = self.short(rhs);
        let is_list = matches!(self.exprs[lhs.id], Expr::Vector(_));
        let difference = match text.as_str() {
            "0" => self.short(lhs.span),
            _ if is_sum => format!("{} - ({text})", self.short(lhs.span)),
            _ => format!("{} - {text}", self.short(lhs.span)),
        };
        let message = "an equation is no function that can be drawn";
        let whole = lhs.span.join(rhs);
        self.report(
            Diagnostic::error("equals-in-expression", whole, message)
                .with_label("two sides, where one expression is expected")
                .with_hint(if is_list {
                    "define each name in a statement of its own: `a = 1`".to_owned()
                } else {
                    format!("write `{difference}`, which is 0 where both sides agree")
                }),
        );
        self.abandon();
    }

    /// `x + y =` and nothing more.
    #[cold]
    fn complain_missing_operand_behind(&mut self, place: Span) {
        self.report(
            Diagnostic::error("missing-operand", place, "nothing stands behind `=`")
                .with_label("an equation has two sides")
                .with_hint("remove it, or write the other side"),
        );
        self.abandon();
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
            .with_hint("a derivative is `f'(x)` of a function, `diff(x^2, x)` of an expression"),
        );
    }
}
