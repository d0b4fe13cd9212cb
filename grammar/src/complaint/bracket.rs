//! Brackets, bars and braces.

use crate::cursor::{Opened, Parser};
use crate::layout::StatementKind;
use crate::token::TokenKind;
use crate::{Diagnostic, Span};

impl Parser<'_> {
    #[cold]
    pub(crate) fn complain_not_closed(&mut self, opened: &Opened) {
        self.is_broken = true;
        if self.is_hushed() {
            return;
        }
        let (open, close) = match opened.kind {
            TokenKind::LParen => ("(", ")"),
            _ => ("{", "}"),
        };
        let span = self.span();
        let diagnostic = if matches!(self.kind(), TokenKind::RParen | TokenKind::RBrace) {
            let message = format!("`{open}` is closed by {}", self.describe());
            Diagnostic::error("mismatched-closing", span, message)
                .with_label(format!("expected `{close}`"))
                .with_hint(format!("write `{close}` here"))
        } else {
            let message = format!("missing `{close}`");
            let before = if self.at(TokenKind::End) {
                ""
            } else {
                "before this"
            };
            Diagnostic::error("missing-closing", span, message)
                .with_label(format!("expected `{close}` {before}").trim_end())
                .with_hint(format!("add `{close}`"))
        };
        self.complain(diagnostic.with_related(opened.span, format!("`{open}` opened here")));
    }

    #[cold]
    pub(crate) fn complain_missing_bar(&mut self, opening: Span) {
        if self.is_hushed() {
            return;
        }
        let doubled = self.text.get(opening.end as usize..);
        let is_doubled = doubled.is_some_and(|rest| rest.starts_with('|'))
            || self
                .text
                .get(..opening.start as usize)
                .is_some_and(|t| t.ends_with('|'));
        let hint = if is_doubled {
            "add `|`, or write `or` between conditions"
        } else {
            "add `|`"
        };
        self.complain(
            Diagnostic::error("missing-closing", self.span(), "missing `|`")
                .with_label("expected `|`")
                .with_related(opening, "`|` opened here")
                .with_hint(hint),
        );
    }

    #[cold]
    pub(crate) fn complain_empty_brackets(&mut self, opening: Span) {
        self.complain(
            Diagnostic::error(
                "empty-brackets",
                opening.join(self.span()),
                "nothing stands between the brackets",
            )
            .with_hint("write an expression, or `(a, b)` for a vector"),
        );
    }

    #[cold]
    pub(crate) fn complain_long_vector(&mut self, span: Span, count: usize) {
        let message = format!("a vector of {count} components");
        self.report(
            Diagnostic::error("long-vector", span, message)
                .with_label("a vector has two to four components")
                .with_hint("write a function's name before the bracket if a call is meant"),
        );
    }

    #[cold]
    pub(crate) fn complain_empty_piecewise(&mut self, opening: Span) {
        self.complain(
            Diagnostic::error(
                "empty-piecewise",
                opening.join(self.span()),
                "nothing stands between the braces",
            )
            .with_hint("write `{ x < 0: -x, else: x }`"),
        );
    }

    /// Braces without a single `:` hold no cases; `{1, 2, 3}` is a list of other languages. What is inside is left
    /// unread where it ends soon.
    pub(crate) fn is_foreign_list(&mut self, opened: &Opened) -> bool {
        let Some(end) = self.end_of_list(0) else {
            return false;
        };
        let whole = opened.span.join(self.span_ahead(end));
        let inside = self.short(self.span().join(self.span_ahead(end.saturating_sub(1))));
        let holds = |kind: TokenKind| (0..end).any(|n| self.ahead(n) == kind);
        let compares = [
            TokenKind::Less,
            TokenKind::LessEqual,
            TokenKind::Greater,
            TokenKind::GreaterEqual,
            TokenKind::EqualEqual,
            TokenKind::NotEqual,
            TokenKind::Equals,
        ];
        if let Some(value) = inside.strip_prefix("return ") {
            let message = "a function is defined by `=`, not by braces";
            self.report(
                Diagnostic::error("foreign-statement", whole, message)
                    .with_label("the body of a function in other languages")
                    .with_hint(format!("write `= {value}`")),
            );
            self.abandon();
            return true;
        }
        let (message, hint) = if holds(TokenKind::If) {
            (
                "these cases have no `:`",
                "write the condition first: `{ x < 0: value, else: value }`".to_owned(),
            )
        } else if !holds(TokenKind::Comma) && compares.into_iter().any(holds) {
            (
                "braces with a condition alone",
                format!("write the value behind it: `{{ {inside}: value }}`"),
            )
        } else if compares.into_iter().any(holds) {
            return false;
        } else {
            (
                "these braces hold no cases",
                format!("write `({inside})`; braces hold cases: `{{ x < 0: -x, else: x }}`"),
            )
        };
        if !self.is_hushed() {
            self.report(
                Diagnostic::error("missing-colon", whole, message)
                    .with_label("no `condition: value`")
                    .with_hint(hint),
            );
        }
        for _ in 0..end {
            self.bump();
        }
        self.close(opened);
        self.mark_complained();
        true
    }

    /// How many tokens stand before the `}` that closes the braces whose inside begins `from` tokens on, if that comes
    /// soon and neither a `:` nor the end of a bracket around them is among them.
    pub(crate) fn end_of_list(&self, from: usize) -> Option<usize> {
        const SOON: usize = 60;
        let mut depth = 0_usize;
        for (n, token) in self.tokens_ahead(from).iter().take(SOON).enumerate() {
            match token.kind {
                TokenKind::RBrace if depth == 0 => return Some(n),
                TokenKind::Colon => return None,
                TokenKind::RParen if depth == 0 => return None,
                TokenKind::LBrace | TokenKind::LParen => depth += 1,
                TokenKind::RBrace | TokenKind::RParen => depth = depth.saturating_sub(1),
                _ => {}
            }
        }
        None
    }

    #[cold]
    pub(crate) fn complain_after_else(&mut self) {
        self.complain(
            Diagnostic::error("else-not-last", self.span(), "a case after `else`")
                .with_label("never reached")
                .with_hint("put `else: …` last"),
        );
    }

    #[cold]
    pub(crate) fn complain_missing_colon(&mut self, is_else: bool, opening: Span) {
        if !is_else && self.at(TokenKind::End) {
            return;
        }
        let statement = self.first_span();
        let follows = self
            .diagnostics
            .last()
            .is_some_and(|last| last.code == "missing-then" && last.span.start >= statement.start);
        if follows && self.at(TokenKind::RBrace) {
            return;
        }
        if let Some(place) = self.retract_missing_operator(opening) {
            self.report(
                Diagnostic::error("missing-colon", place, "missing `:`")
                    .with_label("expected `:` between these")
                    .with_hint("a case is `condition: value`, as in `{ x < 0: -x, else: x }`"),
            );
            self.mark_complained();
            return;
        }
        if self.is_hushed() {
            return;
        }
        let hint = if is_else {
            "a case is `else: value`"
        } else {
            "a case is `condition: value`, as in `{ x < 0: -x, else: x }`"
        };
        let message = format!("missing `:` before {}", self.describe());
        self.complain(
            Diagnostic::error("missing-colon", self.span(), message)
                .with_label("expected `:` and the value of this case")
                .with_hint(hint),
        );
    }

    /// What a comma outside of brackets may have been meant for.
    fn hint_for_comma(&self) -> &'static str {
        let compares = (1..12).any(|n| {
            use TokenKind::{Greater, GreaterEqual, Less, LessEqual, NotEqual};
            let kind = self.ahead(n);
            matches!(kind, Less | LessEqual | Greater | GreaterEqual | NotEqual)
        });
        if self.statement == StatementKind::Show {
            "settings stand in braces: `show levels(f) { height = 2 }`"
        } else if compares {
            "for a condition write `if condition then value else nan`"
        } else if self.first_span().text(self.text) == "param" {
            "write one `param` on each line"
        } else {
            "for a vector write `(a, b)`, in brackets"
        }
    }

    /// Whether a comma stands between digits.
    fn is_decimal_comma(&self) -> bool {
        let (before, after) = (self.last_span(), self.span_ahead(1));
        let touches = before.end == self.span().start && self.span().end == after.start;
        self.behind() == TokenKind::Number && self.ahead(1) == TokenKind::Number && touches
    }

    /// `3,5`: the rest of the statement goes on behind it.
    #[cold]
    fn complain_decimal_comma(&mut self) {
        let (whole, part) = (self.last_span(), self.span_ahead(1));
        let number = format!("{}.{}", self.short(whole), self.short(part));
        self.complain(
            Diagnostic::error(
                "unexpected-token",
                whole.join(part),
                "a comma between the digits of a number",
            )
            .with_label("the decimal point is `.`")
            .with_hint(format!("write `{number}`")),
        );
    }

    /// Complains that nothing readable goes on here; `opened` is the bracket around this place.
    #[cold]
    pub(crate) fn complain_unexpected(&mut self, opened: Option<&Opened>) {
        let kind = self.kind();
        let is_consequence = matches!(
            kind,
            TokenKind::RParen | TokenKind::RBrace | TokenKind::Comma | TokenKind::Colon
        );
        if self.is_broken && is_consequence {
            self.mark_complained();
            return;
        }
        if self.is_hushed() {
            return;
        }
        let quoted = self.describe();
        let defines = kind == TokenKind::Name && self.ahead(1) == TokenKind::Equals;
        let (code, message, hint) = match kind {
            TokenKind::RParen | TokenKind::RBrace => (
                "unmatched-closing",
                format!("{quoted} without an opening bracket"),
                Some("remove it, or open the bracket before it"),
            ),
            TokenKind::Then | TokenKind::Else => (
                "unexpected-token",
                format!("{quoted} without `if`"),
                Some("it belongs to a choice: `if c then a else b`"),
            ),
            TokenKind::In if opened.is_some() => (
                "unexpected-token",
                "`in` outside of a sum, product or integral".to_owned(),
                Some(
                    "for a sum write `sum(k in 1..n, term)`; a condition on a range is `0 <= x <= 1`",
                ),
            ),
            TokenKind::In => (
                "unexpected-token",
                "`in` outside of `param`".to_owned(),
                Some("a range belongs to a slider: `param name = value in lo..hi`"),
            ),
            TokenKind::Until => (
                "unexpected-token",
                "`until` outside of `iterate`".to_owned(),
                Some("write it in the brackets: `iterate(n, z = start, step until condition)`"),
            ),
            TokenKind::DotDot => (
                "unexpected-token",
                format!("{quoted} outside of a range"),
                Some("a range belongs to a slider: `param name = value in lo..hi`"),
            ),
            TokenKind::Where => (
                "unexpected-token",
                "`where` cannot stand here".to_owned(),
                Some("put brackets around the expression with its `where`"),
            ),
            TokenKind::Comma if self.is_decimal_comma() => {
                self.complain_decimal_comma();
                return;
            }
            TokenKind::Comma => (
                "unexpected-token",
                "`,` outside of brackets".to_owned(),
                Some(self.hint_for_comma()),
            ),
            TokenKind::Semicolon => (
                "unexpected-token",
                "`;` inside of brackets".to_owned(),
                Some("write `,`"),
            ),
            TokenKind::Colon => (
                "unexpected-token",
                "`:` outside of a list of cases".to_owned(),
                Some("cases stand in braces: `{ x < 0: -x, else: x }`"),
            ),
            TokenKind::Name if defines && self.statement == StatementKind::Show => (
                "missing-braces",
                format!("setting {quoted} outside of braces"),
                Some("settings stand in braces: `show levels(f) { height = 2 }`"),
            ),
            TokenKind::Name if defines && opened.is_none() => (
                "missing-separator",
                format!("{quoted} begins a definition inside of another statement"),
                Some("put it on a line of its own, or write `;` before it"),
            ),
            TokenKind::Name if defines => (
                "missing-comma",
                format!("missing `,` before {quoted}"),
                Some("put `,` between the items"),
            ),
            _ => (
                "unexpected-token",
                format!("{quoted} cannot stand here"),
                Some("remove it, or write what is missing before it"),
            ),
        };
        let mut diagnostic = Diagnostic::error(code, self.span(), message);
        diagnostic.hint = hint.map(str::to_owned);
        if let Some(opened) = opened {
            diagnostic = diagnostic.with_related(opened.span, "inside of this bracket");
        }
        self.complain(diagnostic);
    }
}
