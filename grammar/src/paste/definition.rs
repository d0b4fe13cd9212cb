//! How definitions begin elsewhere: `float a = …;`, `def f(x): return …`, `float f(vec3 p) { … }`, `f[x_] := …`.

use super::Translator;
use super::names::{is_defining_word, is_function_word, type_of};
use crate::Span;
use crate::layout::definition_begins;
use crate::token::{Token, TokenKind};

/// Most words before a name, such as `static const float`.
const MOST_WORDS: usize = 4;

impl Translator<'_> {
    /// The beginning of a statement.
    pub(super) fn opening(&mut self) {
        if self.kind() != TokenKind::Name {
            return;
        }
        if self.word_ahead(0) == "return" && !definition_begins(&self.tokens, self.at) {
            self.bump();
            return;
        }
        let words = self.words();
        match self.ahead(words + 1) {
            TokenKind::Equals => self.constant(words),
            TokenKind::Colon if words > 0 && self.ahead(words + 3) == TokenKind::Equals => {
                self.skip(words);
                self.pass();
                self.skip(2);
            }
            TokenKind::LParen if words > 0 => self.function_definition(words),
            TokenKind::LSquare if words == 0 => self.bracketed_definition(),
            _ => {}
        }
    }

    fn skip(&mut self, count: usize) {
        for _ in 0..count {
            self.bump();
        }
    }

    /// Number of words before a name that is defined here, on the same line.
    fn words(&self) -> usize {
        let mut count = 0;
        while count < MOST_WORDS
            && self.ahead(count) == TokenKind::Name
            && self.ahead(count + 1) == TokenKind::Name
            && !self.begins_line(count + 1)
            && self.is_word(count)
        {
            count += 1;
        }
        count
    }

    /// Whether the token `n` places on is the first of its line.
    fn begins_line(&self, n: usize) -> bool {
        let token = self.tokens.get(self.at + n);
        token.is_some_and(|token| token.starts_line)
    }

    fn is_word(&self, n: usize) -> bool {
        let word = self.word_ahead(n);
        is_defining_word(word) || is_function_word(word)
    }

    /// `let a = …`, `f = lambda x: …`, `const f = (x) => …`
    fn constant(&mut self, words: usize) {
        let value = words + 2;
        if self.word_ahead(value) == "lambda" && self.ahead(value) == TokenKind::Name {
            if let Some(end) = self.list_end(value + 1, TokenKind::Colon) {
                self.skip(words);
                self.pass();
                let equals = self.bump();
                let lambda = self.bump();
                self.emit(TokenKind::LParen, lambda);
                for _ in value + 1..end {
                    self.pass();
                }
                let colon = self.bump();
                self.emit(TokenKind::RParen, colon);
                self.emit(TokenKind::Equals, equals);
                self.follow(TokenKind::Equals);
            }
            return;
        }
        if words > 0 && self.ahead(value) == TokenKind::LParen {
            let end = self.list_end(value + 1, TokenKind::RParen);
            if let Some(end) = end
                && self.ahead(end + 1) == TokenKind::Equals
                && self.ahead(end + 2) == TokenKind::Greater
                && self.touches(end + 1)
            {
                self.skip(words);
                self.pass();
                self.bump();
                for _ in value..=end {
                    self.pass();
                }
                self.pass();
                self.bump();
                return;
            }
        }
        self.skip(words);
    }

    /// Where a list of names that begins `n` places on ends with this token.
    fn list_end(&self, mut n: usize, close: TokenKind) -> Option<usize> {
        while matches!(self.ahead(n), TokenKind::Name | TokenKind::Comma) {
            n += 1;
        }
        (self.ahead(n) == close).then_some(n)
    }

    /// `def f(x): return …`, `float f(vec3 p) { … }`, `let f(x) = …`
    fn function_definition(&mut self, words: usize) {
        let mut end = words + 2;
        while matches!(
            self.ahead(end),
            TokenKind::Name
                | TokenKind::Comma
                | TokenKind::Colon
                | TokenKind::Less
                | TokenKind::Greater
                | TokenKind::In
        ) {
            end += 1;
        }
        if self.ahead(end) != TokenKind::RParen {
            return;
        }
        let mut body = end + 1;
        if self.ahead(body) == TokenKind::Minus && self.ahead(body + 1) == TokenKind::Greater {
            body += 3;
            if self.ahead(body) == TokenKind::Less {
                body += 3;
            }
        }
        let is_python =
            self.ahead(body) == TokenKind::Colon && self.word_ahead(body + 1) == "return";
        match self.ahead(body) {
            TokenKind::Equals => self.skip(words),
            TokenKind::Colon if is_python => {
                self.heading(words, body);
                let colon = self.bump();
                self.bump();
                self.emit(TokenKind::Equals, colon);
                self.follow(TokenKind::Equals);
            }
            TokenKind::LBrace => {
                self.heading(words, body);
                self.block();
            }
            _ => {}
        }
    }

    /// `name(parameters)` up to the token `end` places on, with types as they are written here.
    fn heading(&mut self, words: usize, end: usize) {
        let end = self.at + end;
        self.skip(words);
        self.pass();
        self.pass();
        loop {
            let start = self.at;
            while !matches!(
                self.kind(),
                TokenKind::Comma | TokenKind::RParen | TokenKind::End
            ) {
                self.bump();
            }
            self.formal(start);
            if self.kind() != TokenKind::Comma {
                break;
            }
            self.pass();
        }
        self.pass();
        while self.at < end {
            self.bump();
        }
        self.starts_line = false;
    }

    /// The parameter whose tokens are those from `start` up to here.
    fn formal(&mut self, start: usize) {
        let tokens = self.tokens.get(start..self.at).unwrap_or_default();
        let names: Vec<Span> = tokens
            .iter()
            .filter(|token| token.kind == TokenKind::Name)
            .map(|token| token.span)
            .collect();
        let is_annotated = tokens.get(1).is_some_and(|t| t.kind == TokenKind::Colon);
        let (name, ty) = match names.as_slice() {
            [] => return,
            [name] => (*name, None),
            [name, ty, ..] if is_annotated => (*name, Some(*ty)),
            [.., ty, name] => (*name, Some(*ty)),
        };
        self.emit(TokenKind::Name, name);
        if let Some(ty) = ty {
            self.emit(TokenKind::Colon, ty);
            match type_of(ty.text(self.text)) {
                Some(ours) => self.emit_spelt(TokenKind::Name, ty, ours),
                None => self.emit(TokenKind::Name, ty),
            }
        }
    }

    /// `{ float a = …; return …; }` as `= … where a = …`
    fn block(&mut self) {
        let opening = self.bump();
        self.emit(TokenKind::Equals, opening);
        self.follow(TokenKind::Equals);
        let mut locals: Vec<Token> = Vec::new();
        let mut value = Vec::new();
        self.deeper(|this| {
            this.closers.braces += 1;
            loop {
                while this.kind() == TokenKind::Semicolon {
                    this.bump();
                }
                if this.word_ahead(0) == "return" {
                    this.bump();
                    value = this.capture(Self::until_semicolon);
                    break;
                }
                if !this.assigns() {
                    break;
                }
                let mut local = this.capture(Self::assignment);
                let separator = if locals.is_empty() {
                    TokenKind::Where
                } else {
                    TokenKind::Comma
                };
                locals.push(Token {
                    kind: separator,
                    span: opening,
                    starts_line: false,
                });
                locals.append(&mut local);
            }
            while this.kind() == TokenKind::Semicolon {
                this.bump();
            }
            this.closers.braces -= 1;
        });
        if self.has_given_up {
            // the parser is about to meet what was too deep
            return;
        }
        if value.is_empty() || self.kind() != TokenKind::RBrace {
            let place = self.span();
            self.complain(
                "foreign-statement",
                place,
                "a function is one expression",
                "expected a definition or `return`",
                "write `name(x) = value where a = …, b = …`, choices as `if c then a else b`",
            );
            self.skip_block();
            self.emit(TokenKind::Error, place);
            return;
        }
        self.bump();
        self.starts_line = false;
        self.paste(on_one_line(value));
        self.paste(on_one_line(locals));
    }

    /// Goes past the `}` of the block that is open here.
    fn skip_block(&mut self) {
        let mut depth = 0_usize;
        while self.kind() != TokenKind::End {
            match self.kind() {
                TokenKind::LBrace => depth += 1,
                TokenKind::RBrace if depth == 0 => {
                    self.bump();
                    break;
                }
                TokenKind::RBrace => depth -= 1,
                _ => {}
            }
            self.bump();
        }
        self.starts_line = false;
    }

    fn until_semicolon(&mut self) {
        self.until(|this| this.kind() == TokenKind::Semicolon);
    }

    /// Whether `[type] name [.xy] [+]= …` is here.
    fn assigns(&self) -> bool {
        let words = self.words();
        let mut n = words + 1;
        if self.ahead(words) != TokenKind::Name {
            return false;
        }
        if self.ahead(n) == TokenKind::Dot {
            n += 2;
        }
        if self.ahead(n) == TokenKind::Colon {
            n += 2;
        }
        self.ahead(n) == TokenKind::Equals
            || is_compound(self.ahead(n)) && self.ahead(n + 1) == TokenKind::Equals
    }

    /// Such a statement as a local: `a += b` is `a = a + (b)`.
    fn assignment(&mut self) {
        self.skip(self.words());
        let name = self.at;
        self.pass();
        if self.kind() == TokenKind::Dot {
            self.pass();
            self.pass();
        }
        let end = self.at;
        if self.kind() == TokenKind::Colon {
            self.skip(2);
        }
        let sign = (self.kind() != TokenKind::Equals).then(|| (self.kind(), self.bump()));
        self.pass();
        let Some((sign, place)) = sign else {
            return self.until_semicolon();
        };
        let target: Vec<Token> = self.tokens.get(name..end).unwrap_or_default().to_vec();
        self.paste(target);
        self.emit(sign, place);
        self.emit(TokenKind::LParen, place);
        self.until_semicolon();
        self.emit(TokenKind::RParen, self.last_span());
    }

    /// `f[x_, y_] := …` as `f(x, y) = …`
    fn bracketed_definition(&mut self) {
        let mut end = 2;
        while matches!(self.ahead(end), TokenKind::Name | TokenKind::Comma) {
            end += 1;
        }
        let colon = usize::from(self.ahead(end + 1) == TokenKind::Colon);
        let is_definition = self.ahead(end) == TokenKind::RSquare
            && self.ahead(end + 1 + colon) == TokenKind::Equals;
        if !is_definition {
            return;
        }
        self.bracketed.insert(self.word_ahead(0).to_owned());
        self.pass();
        let opening = self.bump();
        self.emit(TokenKind::LParen, opening);
        for _ in 2..end {
            let word = self.word_ahead(0);
            match word.split_once('_') {
                Some((name, _)) if !name.is_empty() => {
                    let name = name.to_owned();
                    let span = self.bump();
                    self.emit_spelt(TokenKind::Name, span, name);
                }
                _ => self.pass(),
            }
        }
        let closing = self.bump();
        self.emit(TokenKind::RParen, closing);
        self.skip(colon);
        self.pass();
    }
}

/// Whether `+=` begins with this.
fn is_compound(kind: TokenKind) -> bool {
    matches!(
        kind,
        TokenKind::Plus | TokenKind::Minus | TokenKind::Star | TokenKind::Slash
    )
}

/// The tokens without their line breaks: they are one statement wherever they stood.
fn on_one_line(mut tokens: Vec<Token>) -> Vec<Token> {
    for token in &mut tokens {
        token.starts_line = false;
    }
    tokens
}
