//! Functions of LaTeX: their bases, powers, and arguments in brackets.

use super::Translator;
use super::command::Meaning;
use crate::Span;
use crate::stray::shorten;
use crate::token::{Token, TokenKind};

impl Translator<'_> {
    /// A function with its power and its argument, which may stand without brackets.
    pub(super) fn function(&mut self, span: Span, name: &str) {
        self.skip_spacing();
        let is_log = name == "log" && self.kind() == TokenKind::Name;
        if is_log && self.word_ahead(0).starts_with('_') {
            self.logarithm(span);
        } else if name == span.text(self.text) {
            self.emit(TokenKind::Name, span);
            self.applied(span, name);
        } else {
            self.emit_spelt(TokenKind::Name, span, name);
            self.applied(span, name);
        }
    }

    /// `\log_{10} x` as `log10(x)`, `\log_b x` as `(log(x)/log(b))`
    fn logarithm(&mut self, span: Span) {
        let mark = Span::new(self.span().start, self.span().start + 1);
        let base = self.capture(Self::script);
        let written = match base.as_slice() {
            [only] => only.span.text(self.text),
            _ => "",
        };
        let ours = match written {
            "10" => "log10",
            "2" => "log2",
            "e" => "log",
            _ => {
                self.emit(TokenKind::LParen, span);
                self.emit_spelt(TokenKind::Name, span, "log");
                self.applied(span, "log");
                self.emit(TokenKind::Slash, mark);
                self.emit_spelt(TokenKind::Name, mark, "log");
                self.emit(TokenKind::LParen, mark);
                self.paste(base);
                self.emit(TokenKind::RParen, mark);
                self.emit(TokenKind::RParen, self.last_span());
                return;
            }
        };
        self.emit_spelt(TokenKind::Name, span, ours);
        self.applied(span, ours);
    }

    /// What stands behind `_` or `^`, which is here: a group, a number, a name or a command.
    pub(super) fn script(&mut self) {
        let word = self.word_ahead(0);
        if self.kind() == TokenKind::Name && word.len() > 1 {
            // `_10x`: the lexer takes the mark and what follows for one name
            let digits = word.bytes().skip(1).take_while(u8::is_ascii_digit).count();
            let length = if digits > 0 { digits } else { word.len() - 1 };
            let kind = if digits > 0 {
                TokenKind::Number
            } else {
                TokenKind::Name
            };
            let start = self.span().start + 1;
            let end = start + u32::try_from(length).unwrap_or(0);
            if end >= self.span().end {
                self.bump();
            } else {
                self.cut(end);
            }
            self.emit(kind, Span::new(start, end));
            return;
        }
        self.bump();
        match self.kind() {
            TokenKind::LBrace => self.exponent(),
            TokenKind::Number | TokenKind::Name => self.pass(),
            TokenKind::Command => self.deeper(Self::item),
            _ => {}
        }
    }

    /// The power and the argument of a function whose name has been written.
    fn applied(&mut self, span: Span, name: &str) {
        let power = self.power();
        self.skip_spacing();
        while self.is_size() {
            self.bump();
        }
        match self.kind() {
            _ if self.statement_begins() => {}
            TokenKind::LParen => self.item(),
            TokenKind::LBrace => self.group(),
            TokenKind::Bar if self.level.bars == 0 => self.in_bars(span),
            TokenKind::Command if self.opens_bracket(0) => self.item(),
            _ => self.bare(span, name),
        }
        if let Some((caret, exponent)) = power {
            self.emit(TokenKind::Caret, caret);
            self.paste(exponent);
        }
    }

    /// The power behind a function's name: a number is left there, another exponent comes behind the argument.
    fn power(&mut self) -> Option<(Span, Vec<Token>)> {
        while self.kind() == TokenKind::Prime {
            self.pass();
        }
        if self.kind() == TokenKind::Superscript {
            self.pass();
            return None;
        }
        if self.kind() != TokenKind::Caret {
            return None;
        }
        let braces = usize::from(self.ahead(1) == TokenKind::LBrace);
        let sign = usize::from(self.ahead(1 + braces) == TokenKind::Minus);
        let is_number = self.ahead(1 + braces + sign) == TokenKind::Number
            && (braces == 0 || self.ahead(2 + braces + sign) == TokenKind::RBrace);
        if is_number {
            self.caret();
            while braces == 0 && matches!(self.kind(), TokenKind::Minus | TokenKind::Number) {
                self.pass();
            }
            return None;
        }
        let caret = self.span();
        let exponent = self.capture(Self::script);
        Some((caret, exponent))
    }

    /// Whether `\big` or the like is here.
    fn is_size(&self) -> bool {
        self.meaning() == Some(Meaning::Sizing) && self.word_ahead(0) != "\\left"
    }

    /// Whether the command `n` places on begins what is read as brackets.
    fn opens_bracket(&self, n: usize) -> bool {
        match self.meaning_ahead(n) {
            Some(Meaning::Sizing) => {
                self.word_ahead(n) == "\\left"
                    && !matches!(self.meaning_ahead(n + 1), Some(Meaning::Opening(..)))
            }
            Some(Meaning::OpeningBar(_)) => true,
            Some(Meaning::Brace) => matches!(self.word_ahead(n), "\\{" | "\\lbrace"),
            _ => false,
        }
    }

    /// `\ln|x|`
    fn in_bars(&mut self, span: Span) {
        self.emit(TokenKind::LParen, span);
        self.pass();
        self.deeper(|this| this.until(|this| this.kind() == TokenKind::Bar));
        if self.kind() == TokenKind::Bar {
            self.pass();
        } else {
            self.level.bars = self.level.bars.saturating_sub(1);
        }
        self.emit(TokenKind::RParen, self.last_span());
    }

    /// Complains that it is not clear how much belongs to a function or sum: `whole` is what has been read of it,
    /// `call` and `argument` are how it is written here.
    pub(super) fn complain_unclear(&mut self, whole: Span, before: &str, argument: &str) {
        let rest = self.next_words();
        let shown = shorten(whole.text(self.text));
        self.complain(
            "unclear-argument",
            whole.join(self.span()),
            format!("where `{shown}` ends is not clear"),
            "brackets are missing",
            format!("write `{before}{argument}){rest}`, or `{before}{argument}{rest})`"),
        );
    }

    /// The next operator and operand as a hint shows them.
    fn next_words(&self) -> String {
        let sign = match self.kind() {
            TokenKind::Slash => "/",
            TokenKind::Star => " * ",
            TokenKind::Plus => " + ",
            TokenKind::Minus => " - ",
            TokenKind::Command => match self.meaning() {
                Some(Meaning::Token(TokenKind::Slash)) => "/",
                Some(Meaning::Token(_)) => " * ",
                Some(Meaning::Function(name)) => return format!(" {name}(…)"),
                _ => return " (…)".to_owned(),
            },
            _ => return " (…)".to_owned(),
        };
        let operand = match self.ahead(1) {
            TokenKind::Number | TokenKind::Name => shorten(self.word_ahead(1)),
            TokenKind::Command => match self.meaning_ahead(1) {
                Some(Meaning::Name(name)) => name.to_owned(),
                Some(Meaning::Function(name)) => format!("{name}(…)"),
                _ => "(…)".to_owned(),
            },
            _ => "(…)".to_owned(),
        };
        format!("{sign}{operand}")
    }
}
