//! Functions and their arguments.

use crate::Diagnostic;
use crate::Span;
use crate::ast::Name;
use crate::cursor::Parser;
use crate::stray::shorten;
use crate::token::TokenKind;

impl Parser<'_> {
    /// `sin^-1(x)`: the inverse function, or one over the value.
    #[cold]
    pub(crate) fn complain_inverse(&mut self, callee: &Name, place: Span) {
        let name = shorten(&callee.text);
        let inverse = match name.as_str() {
            "sin" | "cos" | "tan" | "sinh" | "cosh" | "tanh" => Some(format!("a{name}")),
            "exp" => Some("log".to_owned()),
            "log" | "ln" => Some("exp".to_owned()),
            _ => None,
        };
        let inverse = inverse.filter(|inverse| self.scope.is_builtin(inverse));
        let hint = match inverse {
            Some(inverse) => format!(
                "write `{inverse}(x)` for the inverse function, `1/{name}(x)` for one over the value"
            ),
            None => format!("write `1/{name}(x)` for one over the value"),
        };
        self.complain(
            Diagnostic::error(
                "inverse-or-reciprocal",
                callee.span.join(place),
                "the power -1 of a function has two meanings",
            )
            .with_label("the inverse function, or one over the value")
            .with_hint(hint),
        );
    }

    #[cold]
    pub(crate) fn complain_not_called(&mut self, callee: &Name, primes: u32) {
        let marks = "'".repeat(primes.min(4) as usize);
        let name = format!("{}{marks}", shorten(&callee.text));
        let argument = match self.kind() {
            TokenKind::Name | TokenKind::Number | TokenKind::Imaginary if !self.starts_line() => {
                self.short(self.span())
            }
            _ => "x".to_owned(),
        };
        let hint = if self.at(TokenKind::Caret) {
            let exponent = self.short(self.span_ahead(1));
            format!("write `{name}({argument})^{exponent}` for a power of the value")
        } else {
            format!("write `{name}({argument})`")
        };
        self.complain(
            Diagnostic::error(
                "function-without-call",
                callee.span,
                format!("the function `{name}` without arguments"),
            )
            .with_label("a function is not a value")
            .with_hint(hint),
        );
    }

    #[cold]
    pub(crate) fn complain_no_function(&mut self, name: &Name) {
        let message = format!(
            "a prime stands behind `{}`, which is no function",
            shorten(&name.text)
        );
        self.complain(
            Diagnostic::error("stray-prime", name.span.join(self.last_span()), message)
                .with_label("only a function has a derivative")
                .with_hint("write `f'(x)`, or `diff(expr, x)`"),
        );
    }

    #[cold]
    pub(crate) fn complain_not_yet(&mut self) {
        let place = self.span();
        self.complain(
            Diagnostic::error(
                "not-yet",
                place,
                "sums, products and iterations are not available yet",
            )
            .with_label("an index or state of a loop")
            .with_hint("write the terms out"),
        );
    }
}
