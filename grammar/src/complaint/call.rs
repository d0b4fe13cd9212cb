//! Functions and their arguments.

use crate::Diagnostic;
use crate::Span;
use crate::ast::{ExprId, Name, SeriesKind};
use crate::cursor::Parser;
use crate::scope::{Form, Role};
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
        if self.is_hushed() {
            return;
        }
        let marks = "'".repeat(primes.min(4) as usize);
        let name = format!("{}{marks}", shorten(&callee.text));
        let argument = match self.kind() {
            TokenKind::Name | TokenKind::Number | TokenKind::Imaginary if !self.starts_line() => {
                self.short(self.span())
            }
            _ => "x".to_owned(),
        };
        let form = self.scope.form(&callee.text);
        let hint = if let Some(form) = form {
            format!("write `{name}({})`", form.example())
        } else if self.at(TokenKind::Caret) {
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

    /// The form that a call is; complains where its name is another one.
    pub(crate) fn form_of(&mut self, callee: &Name) -> Option<Form> {
        let form = self.scope.form(&callee.text);
        let has_range = self.ahead(1) == TokenKind::Name && self.ahead(2) == TokenKind::In;
        if form.is_some() || !has_range || self.scope.role(&callee.text) != Role::Unknown {
            return form;
        }
        let meant = Form::meant_by(&callee.text)?;
        let name = if meant == Form::Series(SeriesKind::Sum) {
            "sum"
        } else {
            "product"
        };
        let message = format!("`{}` is no name of a {name}", callee.text);
        self.report(
            Diagnostic::error("foreign-name", callee.span, message)
                .with_label("a name like any other")
                .with_hint(format!("write `{name}({})`", meant.example())),
        );
        Some(meant)
    }

    /// `sum'(…)`
    #[cold]
    pub(crate) fn complain_prime_of_form(&mut self, callee: &Name) {
        let name = shorten(&callee.text);
        let message = format!("a prime stands behind `{name}`");
        self.complain(
            Diagnostic::error("stray-prime", callee.span.join(self.last_span()), message)
                .with_label("only a function of one variable has such a derivative")
                .with_hint(format!("write `diff({name}(…), x)`")),
        );
    }

    /// `log|x|^2`: of the argument or of the value?
    #[cold]
    pub(crate) fn complain_power_of_bars(&mut self, callee: &Name, bars: Span) {
        let (name, arg) = (shorten(&callee.text), self.short(bars));
        let operator = self.short(self.span());
        let power = if self.at(TokenKind::Caret) {
            "^…".to_owned()
        } else {
            operator
        };
        let message = format!("it is not clear what is raised in `{name}{arg}{power}`");
        self.complain(
            Diagnostic::error("ambiguous-power", self.span(), message)
                .with_label("of the argument, or of the value?")
                .with_hint(format!(
                    "write `{name}({arg}{power})` or `{name}({arg}){power}`"
                )),
        );
    }

    /// `grad(f)()`: the brackets of the point are there, the point is not.
    pub(crate) fn check_point(&mut self, callee: &Name, args: &[ExprId]) {
        let [function] = args else { return };
        let function = self.short(self.exprs.span(*function));
        let name = &callee.text;
        self.complain(
            Diagnostic::error(
                "empty-brackets",
                self.last_span(),
                "nothing stands between the brackets",
            )
            .with_label("expected a point")
            .with_hint(format!(
                "write `{name}({function})(x, y)`, or `{name}({function})` at the parameters here"
            )),
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
}
