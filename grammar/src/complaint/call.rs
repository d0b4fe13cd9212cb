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
        let opens = (0..4).find(|&n| self.ahead(n) == TokenKind::LParen);
        // the brackets of LaTeX are made: they have the place of what is inside
        let arguments = opens
            .and_then(|n| self.brackets_ahead(n))
            .filter(|span| span.start >= place.end && span.text(self.text).starts_with('('));
        let shown = arguments.map_or_else(|| "(…)".to_owned(), |span| self.short(span));
        let hint = match inverse {
            Some(inverse) => format!(
                "write `{inverse}{shown}` for the inverse function, `1/{name}{shown}` for one over the value"
            ),
            None => format!("write `1/{name}{shown}` for one over the value"),
        };
        let whole = callee.span.join(place);
        self.complain(
            Diagnostic::error(
                "inverse-or-reciprocal",
                arguments.map_or(whole, |span| whole.join(span)),
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
        if let Some(form) = self.scope.form(&callee.text) {
            let hint = format!("write `{name}({})`", form.example());
            return self.complain_no_argument(callee.span, &name, hint);
        }
        let raised = self.at(TokenKind::Caret);
        let brackets = raised && matches!(self.ahead(1), TokenKind::LParen | TokenKind::LBrace);
        let argument = self
            .bare_argument(if raised { 2 } else { 0 })
            .filter(|_| !brackets);
        let Some(argument) = argument else {
            let hint = format!("write `{name}(…)`, with its argument in brackets");
            return self.complain_no_argument(callee.span, &name, hint);
        };
        let shown = self.short(argument);
        let before = self.behind_by(1 + primes as usize);
        let joins = matches!(
            callee.text.as_str(),
            "mod" | "fmod" | "dot" | "cross" | "min" | "max"
        ) && matches!(before, TokenKind::Name | TokenKind::Number);
        let (span, hint) = if joins {
            let first = self.span_behind(1 + primes as usize);
            let call = format!("{name}({}, {shown})", self.short(first));
            (first.join(argument), format!("write `{call}`"))
        } else if raised {
            let exponent = self.short(self.span_ahead(1));
            let call = format!("{name}({shown})^{exponent}");
            let hint = format!("write `{call}`, which is a power of the value");
            (callee.span.join(argument), hint)
        } else {
            let hint = format!("write `{name}({shown})`");
            (callee.span.join(argument), hint)
        };
        let message = format!("the argument of `{name}` has no brackets");
        self.complain(
            Diagnostic::error("function-without-call", span, message)
                .with_label("brackets are missing")
                .with_hint(hint),
        );
    }

    /// The function is not called at all.
    #[cold]
    fn complain_no_argument(&mut self, place: Span, name: &str, hint: String) {
        let message = format!("the function `{name}` without arguments");
        self.complain(
            Diagnostic::error("function-without-call", place, message)
                .with_label("a function is not a value")
                .with_hint(hint),
        );
    }

    /// The operand without brackets that stands `at` places on, as the argument of a function: `x`, `2x`, `3πx`.
    fn bare_argument(&self, at: usize) -> Option<Span> {
        let is_operand = |at: usize| {
            use TokenKind::{Imaginary, Name, Number};
            matches!(self.ahead(at), Name | Number | Imaginary)
        };
        if !is_operand(at) || at == 0 && self.starts_line() {
            return None;
        }
        let mut span = self.span_ahead(at);
        let mut next = at + 1;
        while is_operand(next) && self.span_ahead(next).start == span.end && next < at + 6 {
            span = span.join(self.span_ahead(next));
            next += 1;
        }
        Some(span)
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
                .with_hint(format!("write `{name}`")),
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
                .with_hint(format!("its derivative is `diff({name}(…), x)`")),
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
                .with_hint(
                    "a derivative is `f'(x)` of a function, `diff(x^2, x)` of an expression",
                ),
        );
    }
}
