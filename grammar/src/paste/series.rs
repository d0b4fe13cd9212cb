//! `\sum_{k=1}^{n}`, `\prod` and `\int_a^b … dx`.

use super::Translator;
use super::command::Meaning;
use crate::Span;
use crate::token::{Token, TokenKind};

/// What stands at a big operator.
#[derive(Default)]
pub(super) struct Limits {
    /// Name of the index.
    index: Option<Span>,
    lower: Vec<Token>,
    upper: Vec<Token>,
}

impl Translator<'_> {
    /// A sum or product, as `sum(k in 1..n, term)`.
    pub(super) fn series(&mut self, span: Span, name: &'static str) {
        let limits = self.limits(true);
        let (Some(index), false, false) = (
            limits.index,
            limits.lower.is_empty(),
            limits.upper.is_empty(),
        ) else {
            let hint = format!("write `{name}(k in 1..n, term)`");
            self.refuse_limits(
                span,
                "it is not clear what the index runs through",
                "expected `_{k=1}^{n}`",
                hint,
            );
            return;
        };
        if let [only] = limits.upper.as_slice()
            && matches!(only.span.text(self.text), "\\infty" | "∞")
        {
            let hint =
                format!("end it where the terms no longer matter: `{name}(k in 1..100, term)`");
            let whole = span.join(only.span);
            self.refuse_limits(whole, "infinitely many terms", "has no end", hint);
            // the index in the term has no meaning now
            self.capture(|this| this.deeper(|this| this.until(Self::term_ends)));
            return;
        }
        self.emit_spelt(TokenKind::Name, span, name);
        self.emit(TokenKind::LParen, span);
        let first = self.out.len();
        self.emit(TokenKind::Name, index);
        self.emit(TokenKind::In, index);
        self.paste(limits.lower);
        self.emit(TokenKind::DotDot, index);
        self.paste(limits.upper);
        self.emit(TokenKind::Comma, self.last_span());
        let term = self.at;
        self.deeper(|this| {
            let closers = this.closers;
            this.until(Self::term_ends);
            this.closers = closers;
        });
        let end = self.last_span();
        self.emit(TokenKind::RParen, end);
        let is_sum = matches!(self.kind(), TokenKind::Plus | TokenKind::Minus);
        if is_sum && !self.statement_begins() && !self.is_one_bracket(term) {
            let written = self.out.get(first..self.out.len() - 1).unwrap_or_default();
            let argument = self.shown(written);
            self.complain_unclear(span.join(end), &format!("{name}("), &argument);
        }
    }

    /// Complains of what stands at a big operator, and leaves a gap in its place.
    fn refuse_limits(&mut self, span: Span, message: &str, label: &str, hint: String) {
        self.complain("bad-limits", span, message, label, hint);
        self.emit(TokenKind::Error, span);
    }

    /// Whether the tokens from `start` up to here are one bracket.
    fn is_one_bracket(&self, start: usize) -> bool {
        let read = self.tokens.get(start..self.at).unwrap_or_default();
        let mut depth = 0_usize;
        for (n, token) in read.iter().enumerate() {
            match token.kind {
                TokenKind::LParen => depth += 1,
                TokenKind::RParen => depth = depth.saturating_sub(1),
                TokenKind::Command if token.span.text(self.text) == "\\left" => {}
                TokenKind::Command if token.span.text(self.text) == "\\right" => {}
                _ if depth == 0 => return false,
                _ => {}
            }
            if depth == 0 && token.kind == TokenKind::RParen {
                return n + 1 == read.len();
            }
        }
        false
    }

    /// Whether what is here is no factor of the term of a sum.
    fn term_ends(&self) -> bool {
        use TokenKind::{
            Ampersand, And, Colon, Comma, Dollar, DotDot, Else, Equals, Minus, Or, Plus, Question,
            Semicolon, Then, Until, Where,
        };
        let kind = match self.meaning() {
            Some(Meaning::Token(kind)) => kind,
            Some(Meaning::Closing | Meaning::End | Meaning::Row) => return true,
            Some(Meaning::Brace) => return !matches!(self.word_ahead(0), "\\{" | "\\lbrace"),
            Some(Meaning::Sizing) => return self.word_ahead(0) == "\\right",
            _ => self.kind(),
        };
        let is_sign = matches!(kind, Plus | Minus)
            && !matches!(
                self.last,
                TokenKind::Comma | TokenKind::Caret | TokenKind::Star | TokenKind::Slash
            );
        is_sign
            || kind.is_comparison()
            || (kind == TokenKind::Name && self.is_differential(0))
            || (kind == TokenKind::Bar && self.level.bars > 0)
            || matches!(
                kind,
                Ampersand
                    | And
                    | Colon
                    | Comma
                    | Dollar
                    | DotDot
                    | Else
                    | Equals
                    | Or
                    | Question
                    | Semicolon
                    | Then
                    | Until
                    | Where
            )
    }

    /// `_{k=1}^{n}`, in either order.
    pub(super) fn limits(&mut self, has_index: bool) -> Limits {
        let mut limits = Limits::default();
        loop {
            self.skip_spacing();
            if self.kind() == TokenKind::Caret && limits.upper.is_empty() {
                limits.upper = self.capture(Self::script);
            } else if self.kind() == TokenKind::Name
                && self.word_ahead(0).starts_with('_')
                && limits.lower.is_empty()
            {
                let is_indexed = has_index
                    && self.ahead(1) == TokenKind::LBrace
                    && self.ahead(2) == TokenKind::Name
                    && self.ahead(3) == TokenKind::Equals;
                if is_indexed {
                    limits.index = Some(self.span_ahead(2));
                    self.bump();
                    let opening = self.bump();
                    self.bump();
                    self.bump();
                    limits.lower = self.capture(|this| {
                        this.emit(TokenKind::LParen, opening);
                        this.inside(TokenKind::RBrace);
                        let end = this.span();
                        this.emit(TokenKind::RParen, end);
                    });
                    if let [_, only, _] = limits.lower.as_slice() {
                        limits.lower = vec![*only];
                    }
                    if self.kind() == TokenKind::RBrace {
                        self.bump();
                    } else {
                        self.complain_open_group(opening, "}");
                    }
                } else {
                    limits.lower = self.capture(Self::script);
                }
            } else {
                return limits;
            }
        }
    }

    /// Whether `dx` of an integral is `n` places on.
    pub(super) fn is_differential(&self, n: usize) -> bool {
        self.integrals > 0 && self.differential(n).is_some()
    }

    /// The variable of `dx`, `d x` or `\mathrm{d}x` that is `n` places on, and the number of tokens.
    fn differential(&self, n: usize) -> Option<(Span, usize)> {
        let span = self.span_ahead(n);
        match self.ahead(n) {
            TokenKind::Name => {
                let rest = span.text(self.text).strip_prefix('d')?;
                let is_variable = rest.chars().next().is_some_and(char::is_alphabetic)
                    && (rest.chars().count() == 1 || rest.contains('_'));
                if is_variable {
                    return Some((Span::new(span.start + 1, span.end), 1));
                }
                (rest.is_empty() && self.is_variable(n + 1)).then(|| (self.span_ahead(n + 1), 2))
            }
            TokenKind::Command => {
                let is_d = self.meaning_ahead(n) == Some(Meaning::Font)
                    && self.ahead(n + 1) == TokenKind::LBrace
                    && self.word_ahead(n + 2) == "d"
                    && self.ahead(n + 3) == TokenKind::RBrace
                    && self.is_variable(n + 4);
                is_d.then(|| (self.span_ahead(n + 4), 5))
            }
            _ => None,
        }
    }

    fn is_variable(&self, n: usize) -> bool {
        self.ahead(n) == TokenKind::Name || matches!(self.meaning_ahead(n), Some(Meaning::Name(_)))
    }

    /// `\int_a^b f\,dx` as `integral(f, x, a, b)`
    pub(super) fn integral(&mut self, span: Span) {
        const USUAL: &str = "write `integral(expr, t, a, b)`";
        let limits = self.limits(false);
        if limits.lower.is_empty() || limits.upper.is_empty() {
            let message = "an integral without ends";
            self.refuse_limits(span, message, "expected `_a^b`", USUAL.to_owned());
            return;
        }
        self.emit_spelt(TokenKind::Name, span, "integral");
        self.emit(TokenKind::LParen, span);
        self.deeper(|this| {
            this.integrals += 1;
            this.until(|this| this.is_differential(0) || this.ends_integrand());
            this.integrals -= 1;
        });
        let Some((variable, length)) = self.differential(0) else {
            self.complain(
                "missing-differential",
                span,
                "the variable of an integral is missing",
                "no `dx` ends it",
                USUAL,
            );
            self.emit(TokenKind::RParen, self.last_span());
            return;
        };
        let letter = match self.meaning_ahead(length - 1) {
            Some(Meaning::Name(name)) => Some(name),
            _ => None,
        };
        for _ in 0..length {
            self.bump();
        }
        let end = self.last_span();
        self.emit(TokenKind::Comma, end);
        match letter {
            Some(name) => self.emit_spelt(TokenKind::Name, variable, name),
            None => self.emit(TokenKind::Name, variable),
        }
        self.emit(TokenKind::Comma, end);
        self.paste(limits.lower);
        self.emit(TokenKind::Comma, end);
        self.paste(limits.upper);
        self.emit(TokenKind::RParen, end);
    }

    fn ends_integrand(&self) -> bool {
        matches!(
            self.kind(),
            TokenKind::Comma | TokenKind::Equals | TokenKind::Semicolon | TokenKind::Dollar
        ) || matches!(
            self.meaning(),
            Some(Meaning::Closing | Meaning::End | Meaning::Row)
        ) || self.word_ahead(0) == "\\right"
    }
}
