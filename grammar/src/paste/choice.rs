//! Choices as C, JavaScript and Python write them, and the `||` of C.

use super::Translator;
use crate::Span;
use crate::token::{Token, TokenKind};

impl Translator<'_> {
    /// `c ? a : b` as `if c then a else b`: `if` goes to the beginning of the condition.
    pub(super) fn question(&mut self) {
        if !self.is_behind_operand() {
            self.stray();
            return;
        }
        self.insert_if();
        let span = self.bump();
        self.emit(TokenKind::Then, span);
        self.follow(TokenKind::Then);
        self.level.choices += 1;
    }

    /// The `:` of such a choice.
    pub(super) fn otherwise(&mut self) {
        let span = self.bump();
        self.emit(TokenKind::Else, span);
        self.follow(TokenKind::Else);
        self.level.choices -= 1;
    }

    /// Writes `if` where the expression that is being read begins.
    fn insert_if(&mut self) {
        let start = self.level.start.min(self.out.len());
        let mut starts_line = false;
        let mut place = 0;
        if let Some(first) = self.out.get_mut(start) {
            starts_line = std::mem::take(&mut first.starts_line);
            place = first.span.start;
        }
        let token = Token {
            kind: TokenKind::If,
            span: Span::new(place, place),
            starts_line,
        };
        self.out.insert(start, token);
    }

    /// `a if c else b` as `if c then a else b`.
    pub(super) fn python_choice(&mut self) {
        let start = self.level.start.min(self.out.len());
        if start == self.out.len() || self.level.choices > 0 {
            self.pass();
            return;
        }
        let mut value = self.out.split_off(start);
        let level = self.level;
        let word = self.bump();
        let mut condition = self.capture(|this| {
            this.until(|this| {
                matches!(
                    this.kind(),
                    TokenKind::Else
                        | TokenKind::Then
                        | TokenKind::If
                        | TokenKind::Comma
                        | TokenKind::Equals
                        | TokenKind::Where
                        | TokenKind::Semicolon
                        | TokenKind::Question
                )
            });
        });
        self.level = level;
        if self.kind() != TokenKind::Else || condition.is_empty() {
            // not this form: the order stays
            self.out.append(&mut value);
            self.emit(TokenKind::If, word);
            self.level.start = self.out.len();
            self.paste(condition);
            return;
        }
        if let (Some(old), Some(new)) = (value.first_mut(), condition.first_mut()) {
            let starts_line = std::mem::take(&mut old.starts_line);
            new.starts_line = false;
            self.out.push(Token {
                kind: TokenKind::If,
                span: Span::new(old.span.start, old.span.start),
                starts_line,
            });
        }
        self.paste(condition);
        self.emit(TokenKind::Then, word);
        self.paste(value);
        let span = self.bump();
        self.emit(TokenKind::Else, span);
        self.follow(TokenKind::Else);
    }

    /// Whether a condition stands behind the two bars here: a comparison, before the next bar.
    fn compares_ahead(&self) -> bool {
        const FARTHEST: usize = 64;
        let kinds = (2..FARTHEST).map(|n| self.ahead(n));
        kinds
            .take_while(|kind| {
                !matches!(
                    kind,
                    TokenKind::Bar | TokenKind::Question | TokenKind::Semicolon | TokenKind::End
                )
            })
            .any(|kind| kind.is_comparison())
    }

    /// A bar; two side by side between conditions are `or`.
    pub(super) fn bar(&mut self) {
        let is_or = self.ahead(1) == TokenKind::Bar
            && self.touches(0)
            && self.level.compares
            && self.is_behind_operand()
            && self.level.bars == 0
            && self.compares_ahead();
        if !is_or {
            self.pass();
            return;
        }
        let first = self.bump();
        let span = first.join(self.bump());
        self.emit(TokenKind::Or, span);
        self.level.compares = false;
    }
}
