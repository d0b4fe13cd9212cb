//! `\begin{cases} a & c \\ b & \text{otherwise} \end{cases}` as `{ c: a, else: b }`.

use super::Translator;
use super::command::Meaning;
use crate::Span;
use crate::token::{Token, TokenKind};

impl Translator<'_> {
    /// The rows and the `\end`; `\begin{cases}` has been read.
    pub(super) fn cases(&mut self, opening: Span) {
        self.emit(TokenKind::LBrace, opening);
        self.deeper(|this| {
            this.closers.commands += 1;
            loop {
                this.row();
                if this.meaning() != Some(Meaning::Row) {
                    break;
                }
                let mark = this.bump();
                if this.meaning() == Some(Meaning::End) {
                    break;
                }
                this.emit(TokenKind::Comma, mark);
            }
            this.closers.commands -= 1;
        });
        let end = if self.meaning() == Some(Meaning::End) {
            let mut end = self.bump();
            let length = self.environment().map_or(0, |found| found.1);
            for _ in 0..length {
                end = end.join(self.bump());
            }
            end
        } else {
            self.complain_open_group(opening, "\\end{cases}");
            self.last_span()
        };
        self.emit(TokenKind::RBrace, end);
    }

    /// A value and its condition, the condition first.
    fn row(&mut self) {
        let mut value = self.capture(|this| {
            this.until(|this| this.kind() == TokenKind::Ampersand || this.ends_row());
        });
        if value
            .last()
            .is_some_and(|last| last.kind == TokenKind::Comma)
        {
            value.pop();
        }
        let mark = self.span();
        if self.kind() != TokenKind::Ampersand {
            self.complain(
                "missing-condition",
                mark,
                "a case without a condition",
                "expected `&` and a condition",
                "write `{ condition: value, else: value }`",
            );
            self.emit(TokenKind::Error, mark);
            self.emit(TokenKind::Colon, mark);
            self.paste(value);
            return;
        }
        self.bump();
        self.skip_words();
        if self.is_otherwise() {
            let span = self.bump_word();
            self.emit(TokenKind::Else, span);
        } else {
            let condition = self.capture(|this| this.until(Self::ends_row));
            self.paste(as_condition(condition));
        }
        self.emit(TokenKind::Colon, mark);
        self.paste(value);
    }

    fn ends_row(&self) -> bool {
        matches!(self.meaning(), Some(Meaning::Row | Meaning::End))
    }

    /// The single word in a `\text{…}` here.
    fn text_word(&self) -> Option<&str> {
        let is_text = self.meaning() == Some(Meaning::Font)
            && self.ahead(1) == TokenKind::LBrace
            && self.ahead(3) == TokenKind::RBrace;
        is_text.then(|| self.word_ahead(2))
    }

    /// Goes past `\text{if}` and spacing.
    fn skip_words(&mut self) {
        loop {
            self.skip_spacing();
            match self.text_word() {
                Some("if" | "for" | "when" | "falls" | "wenn" | "für" | "si") => {
                    self.bump_word();
                }
                _ if matches!(self.kind(), TokenKind::If) => {
                    self.bump();
                }
                _ => return,
            }
        }
    }

    fn is_otherwise(&self) -> bool {
        let is_it = |word: &str| matches!(word, "otherwise" | "else" | "elsewhere" | "sonst");
        self.text_word().is_some_and(is_it)
            || is_it(self.word_ahead(0)) && matches!(self.kind(), TokenKind::Name | TokenKind::Else)
    }

    fn bump_word(&mut self) -> Span {
        let length = if self.kind() == TokenKind::Command {
            4
        } else {
            1
        };
        let mut span = self.span();
        for _ in 0..length {
            span = span.join(self.bump());
        }
        span
    }
}

/// `=` compares in a condition.
fn as_condition(mut tokens: Vec<Token>) -> Vec<Token> {
    for token in &mut tokens {
        if token.kind == TokenKind::Equals {
            token.kind = TokenKind::EqualEqual;
        }
    }
    if tokens
        .last()
        .is_some_and(|last| last.kind == TokenKind::Comma)
    {
        tokens.pop();
    }
    tokens
}
