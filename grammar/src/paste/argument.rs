//! The argument of a LaTeX function without brackets: `\sin 2x`.
//!
//! It is the product without signs that follows, as books have it. Where something follows that some would take in
//! and some not, nothing is guessed.

use super::Translator;
use super::command::Meaning;
use crate::Span;
use crate::token::TokenKind;

impl Translator<'_> {
    /// The argument here, in brackets; nothing where none begins.
    pub(super) fn bare(&mut self, span: Span, name: &str) {
        let signs = usize::from(self.kind() == TokenKind::Minus);
        let takes_list = matches!(name, "min" | "max");
        if takes_list || !(self.factor_begins(signs) || self.function_begins(signs)) {
            return;
        }
        let first = self.out.len() + 1;
        self.emit(TokenKind::LParen, span);
        self.deeper(|this| {
            if signs > 0 {
                this.pass();
            }
            if this.function_begins(0) {
                this.item();
                return;
            }
            while this.factor_begins(0) && !this.statement_begins() {
                this.factor();
                this.skip_spacing();
            }
        });
        let end = self.last_span();
        self.emit(TokenKind::RParen, end);
        let has_variable = self.has_variable(first);
        if self.is_unclear(has_variable) {
            let written = self.out.get(first..self.out.len() - 1).unwrap_or_default();
            let argument = self.shown(written);
            self.complain_unclear(span.join(end), &format!("{name}("), &argument);
        }
    }

    /// Whether a factor of a product without signs is `n` places on.
    fn factor_begins(&self, n: usize) -> bool {
        match self.ahead(n) {
            TokenKind::Number | TokenKind::Imaginary => true,
            TokenKind::Name => {
                let is_call = self.ahead(n + 1) == TokenKind::LParen && self.touches(n);
                !is_call && !self.is_differential(n) && self.ahead(n + 1) != TokenKind::Equals
            }
            TokenKind::Command => {
                matches!(
                    self.meaning_ahead(n),
                    Some(
                        Meaning::Name(_)
                            | Meaning::Fraction
                            | Meaning::Root
                            | Meaning::Accent(_)
                            | Meaning::Font
                            | Meaning::Opening(..)
                    )
                ) && !self.is_differential(n)
            }
            _ => false,
        }
    }

    fn function_begins(&self, n: usize) -> bool {
        matches!(
            self.meaning_ahead(n),
            Some(Meaning::Function(_) | Meaning::Operator)
        )
    }

    /// A factor with its powers, factorials and components.
    fn factor(&mut self) {
        self.item();
        loop {
            match self.kind() {
                TokenKind::Superscript | TokenKind::Bang | TokenKind::Prime => self.pass(),
                TokenKind::Dot => {
                    self.item();
                    if self.kind() == TokenKind::Name {
                        self.pass();
                    }
                }
                TokenKind::Caret => {
                    self.item();
                    if self.last == TokenKind::Caret && self.kind() == TokenKind::Minus {
                        self.pass();
                    }
                    let is_open = matches!(self.last, TokenKind::Caret | TokenKind::Minus);
                    if is_open && (self.factor_begins(0) || self.kind() == TokenKind::LParen) {
                        self.deeper(Self::item);
                    }
                }
                _ => return,
            }
        }
    }

    /// Whether a variable is among the tokens written from `first` on.
    fn has_variable(&self, first: usize) -> bool {
        let written = self.out.get(first..).unwrap_or_default();
        written.iter().any(|token| {
            let word = token.span.text(self.text);
            token.kind == TokenKind::Name
                && !matches!(word, "pi" | "π" | "\\pi" | "e" | "i" | "\\tau" | "τ")
        })
    }

    /// Whether what follows a bare argument might belong to it.
    fn is_unclear(&self, has_variable: bool) -> bool {
        if self.kind() == TokenKind::End || self.statement_begins() || self.closes() {
            return false;
        }
        match self.kind() {
            TokenKind::LParen | TokenKind::LBrace | TokenKind::LSquare | TokenKind::Slash => true,
            TokenKind::Name => self.touches(0) && self.ahead(1) == TokenKind::LParen,
            TokenKind::Bar => self.level.bars == 0,
            TokenKind::Star => !has_variable,
            TokenKind::Command => match self.meaning() {
                Some(Meaning::Token(TokenKind::Slash) | Meaning::OpeningBar(_)) => true,
                Some(Meaning::Token(TokenKind::Star)) => !has_variable,
                Some(Meaning::Function(_) | Meaning::Operator) => !has_variable,
                Some(Meaning::Sizing) => self.word_ahead(0) != "\\right",
                Some(Meaning::Brace) => matches!(self.word_ahead(0), "\\{" | "\\lbrace"),
                _ => false,
            },
            _ => false,
        }
    }
}
