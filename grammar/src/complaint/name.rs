//! Names where names are wanted, and the signs behind them.

use crate::Diagnostic;
use crate::Span;
use crate::ast::Name;
use crate::cursor::Parser;
use crate::stray::shorten;
use crate::token::TokenKind;

impl Parser<'_> {
    #[cold]
    pub(crate) fn complain_reserved(&mut self) {
        let message = format!("{} is a reserved word", self.describe());
        self.complain(
            Diagnostic::error("reserved-word", self.span(), message)
                .with_label("cannot be a name")
                .with_hint("choose another name"),
        );
    }

    /// A name that stands for one that is missing.
    fn no_name(&mut self) -> Name {
        let end = self.last_span().end;
        Name {
            text: String::new(),
            span: Span::new(end, end),
        }
    }

    /// The name that a statement defines.
    pub(crate) fn name_to_define(&mut self) -> Name {
        self.skip_strays();
        let name = if self.at(TokenKind::Name) {
            self.bump_name()
        } else if self.kind().is_keyword() {
            self.complain_reserved();
            self.bump_name()
        } else {
            let message = format!("missing name before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-name", span, message)
                    .with_label("expected a name")
                    .with_hint("write `param name = value`"),
            );
            self.no_name()
        };
        let place = self.span();
        if self.primes() > 0 {
            let span = place.join(self.last_span());
            self.diagnostics.push(
                Diagnostic::error(
                    "primes-in-definition",
                    span,
                    "a derivative cannot be defined",
                )
                .with_label("a prime is no part of a name")
                .with_hint(format!(
                    "define `{0}`; its derivative `{0}'` follows",
                    shorten(&name.text)
                )),
            );
        }
        name
    }

    /// The `=` of a definition.
    pub(crate) fn expect_equals(&mut self) {
        if self.at(TokenKind::Colon) && self.ahead(1) == TokenKind::Equals {
            // `:=` of other languages
            self.bump();
        }
        if !self.eat(TokenKind::Equals) {
            let message = format!("missing `=` before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-equals", span, message)
                    .with_label("expected `=`")
                    .with_hint("write `name = value`"),
            );
        }
    }

    /// The name of a formal parameter.
    pub(crate) fn expect_parameter(&mut self) -> Option<Name> {
        match self.kind() {
            TokenKind::Name => return Some(self.bump_name()),
            TokenKind::Error => {
                self.skip_strays();
                return None;
            }
            kind if kind.is_keyword() => self.complain_reserved(),
            _ => {
                let message = format!("a parameter is a name, not {}", self.describe());
                let span = self.span();
                self.complain(
                    Diagnostic::error("bad-parameter", span, message)
                        .with_label("expected a name")
                        .with_hint("write `f(x) = …`"),
                );
            }
        }
        None
    }

    /// The annotation of a formal parameter.
    pub(crate) fn expect_type(&mut self) -> Option<Name> {
        if self.at(TokenKind::Name) {
            return Some(self.bump_type());
        }
        let message = format!("missing type before {}", self.describe());
        let span = self.span();
        self.complain(
            Diagnostic::error("missing-type", span, message)
                .with_label("expected a type")
                .with_hint("write `real`, `complex`, `vec2`, `vec3`, `vec4` or `bool`"),
        );
        None
    }

    /// The letters behind a point.
    pub(crate) fn expect_component(&mut self) -> Option<Name> {
        if self.at(TokenKind::Name) {
            return Some(self.bump_name());
        }
        let point = self.last_span();
        let before = self.behind_by(1);
        let diagnostic = if matches!(before, TokenKind::Number | TokenKind::Imaginary) {
            Diagnostic::error("missing-digits", point, "missing digits after the point")
                .with_label("expected a digit")
                .with_hint("write `2.0` or `2`")
        } else {
            let message = format!("missing component before {}", self.describe());
            Diagnostic::error("missing-component", point, message)
                .with_label("expected a component")
                .with_hint("write `p.x` for a component, `*` for a product")
        };
        self.complain(diagnostic);
        None
    }

    /// `name =` of a local.
    pub(crate) fn expect_local(&mut self) -> Option<Name> {
        self.skip_strays();
        if self.at(TokenKind::Name) {
            if self.ahead(1) == TokenKind::Equals {
                let name = self.bump_name();
                self.bump();
                return Some(name);
            }
            if self.ahead(1) == TokenKind::LParen {
                return self.no_local_function();
            }
        }
        if self.kind().is_keyword() && self.ahead(1) == TokenKind::Equals {
            self.complain_reserved();
            self.bump();
            self.bump();
            self.disjunction();
            return None;
        }
        let message = format!("missing definition after {}", self.quote(self.last_span()));
        let span = if self.at(TokenKind::End) {
            self.last_span()
        } else {
            self.span()
        };
        self.complain(
            Diagnostic::error("missing-local", span, message)
                .with_label("expected `name = value`")
                .with_hint("write `… where a = value, b = value`"),
        );
        if self.eat(TokenKind::Name) && !matches!(self.kind(), TokenKind::End | TokenKind::Comma) {
            self.disjunction();
        }
        None
    }

    /// `where g(t) = …`
    fn no_local_function(&mut self) -> Option<Name> {
        let name = self.short(self.span());
        let span = self.span();
        self.complain(
            Diagnostic::error("local-function", span, "a local is a value, not a function")
                .with_label("has parameters")
                .with_hint(format!("define `{name}(…) = …` in a statement of its own")),
        );
        self.bump();
        self.bump();
        loop {
            self.skip_to_separator();
            if !self.eat(TokenKind::Comma) {
                break;
            }
        }
        self.eat(TokenKind::RParen);
        if self.eat(TokenKind::Equals) {
            self.disjunction();
        }
        None
    }

    /// Whether another local follows; the comma of an enclosing list is left alone.
    pub(crate) fn another_local(&mut self) -> bool {
        let begins = |at: usize, parser: &Self| {
            (parser.ahead(at) == TokenKind::Name || parser.ahead(at).is_keyword())
                && parser.ahead(at + 1) == TokenKind::Equals
        };
        if begins(0, self) {
            let message = format!("missing `,` before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-comma", span, message)
                    .with_label("expected `,`")
                    .with_hint("write `… where a = value, b = value`"),
            );
            return true;
        }
        let is_outside = self.open_parens == 0 && self.open_braces == 0;
        if self.at(TokenKind::Comma) && (is_outside || begins(1, self)) {
            self.bump();
            return true;
        }
        false
    }

    /// Whether a setting follows without a comma; complains about that.
    pub(crate) fn missing_comma(&mut self) -> bool {
        let found = self.at(TokenKind::Name) && self.ahead(1) == TokenKind::Equals;
        if found {
            let message = format!("missing `,` before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-comma", span, message)
                    .with_label("expected `,`")
                    .with_hint("write `,` between settings"),
            );
        }
        found
    }

    /// Whether a parameter follows without a comma; complains about that.
    pub(crate) fn missing_comma_between_parameters(&mut self) -> bool {
        let found = self.at(TokenKind::Name);
        if found {
            let message = format!("missing `,` before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-comma", span, message)
                    .with_label("expected `,`")
                    .with_hint("write `,` between parameters"),
            );
        }
        found
    }

    /// `name =` of a setting.
    pub(crate) fn expect_setting(&mut self) -> Option<Name> {
        self.skip_strays();
        if self.at(TokenKind::Name) {
            let name = self.bump_name();
            if self.at(TokenKind::Equals) {
                self.bump();
                return Some(name);
            }
            let message = format!("missing `=` before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-equals", span, message)
                    .with_label("expected `=`")
                    .with_hint(format!("write `{} = value`", shorten(&name.text))),
            );
            if self.eat(TokenKind::Colon) {
                return Some(name);
            }
            return None;
        }
        if self.kind().is_keyword() {
            self.complain_reserved();
        } else {
            let message = format!("a setting begins with its name, not {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-name", span, message)
                    .with_label("expected a name")
                    .with_hint("write `{ name = value, name = lo..hi }`"),
            );
        }
        None
    }

    /// `then`
    pub(crate) fn expect_then(&mut self, opening: Span) {
        if !self.eat(TokenKind::Then) {
            self.complain_conditional("missing-then", "then", opening);
        }
    }

    /// `else`; false where it is missing.
    pub(crate) fn expect_else(&mut self, opening: Span) -> bool {
        let found = self.eat(TokenKind::Else);
        if !found {
            self.complain_conditional("missing-else", "else", opening);
        }
        found
    }

    #[cold]
    fn complain_conditional(&mut self, code: &'static str, word: &str, opening: Span) {
        if let Some(place) = self.retract_missing_operator(opening) {
            self.diagnostics.push(
                Diagnostic::error(code, place, format!("missing `{word}`"))
                    .with_label(format!("expected `{word}` between these"))
                    .with_related(opening, "the conditional begins here")
                    .with_hint("write `if c then a else b`"),
            );
            self.mark_complained();
            return;
        }
        let message = format!("missing `{word}` before {}", self.describe());
        self.complain(
            Diagnostic::error(code, self.span(), message)
                .with_label(format!("expected `{word}`"))
                .with_related(opening, "the conditional begins here")
                .with_hint("write `if c then a else b`"),
        );
    }
}
