//! Other notations to ours, token by token: what people paste from LaTeX, C, GLSL, WGSL, HLSL, Python and Mathematica.
//!
//! Done between the tokens and the layout. Every token keeps its place in the user's text; where a name is spelt
//! otherwise than its text, [`Spellings`] says how. What is already ours passes unchanged. Each token is taken once,
//! or at most [`MAX_NESTING`] times where the order is changed, so time is linear.

mod alias;
mod argument;
mod cases;
mod choice;
mod code;
mod command;
mod complaint;
mod definition;
mod function;
mod latex;
pub(crate) mod names;
mod series;

use std::collections::HashSet;

use crate::ast::MAX_NESTING;
use crate::layout::{definition_begins, goes_on, wants_more};
use crate::token::{Token, TokenKind, kind_of_word};
use crate::{Diagnostic, Span};

pub(crate) use names::is_conversion;
use names::{function_of, is_namespace, is_type_mark};

/// The tokens of a text in this language.
pub(crate) struct Pasted {
    pub(crate) tokens: Vec<Token>,
    pub(crate) spellings: Spellings,
    /// Tokens that are not passed on as they are.
    pub(crate) foreign: Vec<Span>,
    pub(crate) diagnostics: Vec<Diagnostic>,
}

/// How names and numbers are spelt in this language where their text is another notation.
#[derive(Debug, Default)]
pub(crate) struct Spellings(Vec<(Span, String)>);

impl Spellings {
    /// The spelling of the token at this place, if it is not its text.
    pub(crate) fn get(&self, span: Span) -> Option<&str> {
        let index = self.0.binary_search_by_key(&span, |entry| entry.0).ok()?;
        self.0.get(index).map(|entry| entry.1.as_str())
    }
}

/// Translates the tokens of a text.
pub(crate) fn translate(text: &str, tokens: Vec<Token>) -> Pasted {
    let facts = Facts::of(text, &tokens);
    let mut translator = Translator {
        text,
        out: Vec::with_capacity(tokens.len()),
        tokens,
        facts,
        spellings: Vec::new(),
        foreign: Vec::new(),
        diagnostics: Vec::new(),
        at: 0,
        last: TokenKind::End,
        starts_line: false,
        level: Level::default(),
        closers: Closers::default(),
        depth: 0,
        environments: 0,
        has_given_up: false,
        is_endless: false,
        integrals: 0,
        bracketed: HashSet::new(),
        is_show: false,
        warned: HashSet::new(),
    };
    translator.file();
    translator.spellings.sort();
    Pasted {
        tokens: translator.out,
        spellings: Spellings(translator.spellings),
        foreign: translator.foreign,
        diagnostics: translator.diagnostics,
    }
}

/// What is known of a text before it is translated.
struct Facts {
    /// For each `{`: whether `:` stands between it and its `}`, outside of other brackets, as in our lists of cases.
    cases: HashSet<usize>,
    /// Names such as `f` and `np`, which mean something elsewhere, that stand somewhere else than directly behind a
    /// number: those before a bracket, and others.
    called: HashSet<String>,
    values: HashSet<String>,
    /// Whether every `$` has a partner.
    dollars_pair: bool,
}

impl Facts {
    fn of(text: &str, tokens: &[Token]) -> Self {
        let mut facts = Self {
            cases: HashSet::new(),
            called: HashSet::new(),
            values: HashSet::new(),
            dollars_pair: true,
        };
        // Where it opens, and whether `:` and `?` stand inside.
        let mut open: Vec<(usize, bool, bool)> = Vec::new();
        let mut is_show = false;
        for (at, token) in tokens.iter().enumerate() {
            is_show = token.kind == TokenKind::Show || is_show && !token.starts_line;
            match token.kind {
                TokenKind::Dollar => facts.dollars_pair = !facts.dollars_pair,
                TokenKind::LBrace | TokenKind::LParen => open.push((at, false, false)),
                TokenKind::Colon => open.last_mut().into_iter().for_each(|top| top.1 = true),
                TokenKind::Question => open.last_mut().into_iter().for_each(|top| top.2 = true),
                TokenKind::RBrace | TokenKind::RParen => {
                    if let Some((start, true, false)) = open.pop() {
                        facts.cases.insert(start);
                    }
                }
                TokenKind::Name if !is_show => {
                    let before = [1, 2].map(|n| at.checked_sub(n).and_then(|n| tokens.get(n)));
                    let after = [1, 2].map(|n| tokens.get(at + n).map(|token| token.kind));
                    facts.name(text, before, token, after);
                }
                _ => {}
            }
        }
        facts
    }

    /// Takes in a name and its neighbours: two before it, the nearer first, and the kinds of two behind it.
    fn name(
        &mut self,
        text: &str,
        before: [Option<&Token>; 2],
        name: &Token,
        after: [Option<TokenKind>; 2],
    ) {
        let word = name.span.text(text);
        if !(is_type_mark(word, false) || is_namespace(word)) {
            return;
        }
        let is_number = |token: Option<&Token>| token.is_some_and(|t| t.kind == TokenKind::Number);
        let is_suffix = match before[0] {
            Some(before) if before.span.end == name.span.start => {
                matches!(before.kind, TokenKind::Number | TokenKind::Dot)
            }
            // a component; but `2. x` is a product
            Some(point) => point.kind == TokenKind::Dot && !is_number(before[1]),
            None => false,
        };
        if is_suffix {
            return;
        }
        let found = match after {
            [Some(TokenKind::LParen), _] => &mut self.called,
            [Some(TokenKind::Dot), _] | [Some(TokenKind::Colon), Some(TokenKind::Colon)] => return,
            _ => &mut self.values,
        };
        if !found.contains(word) {
            found.insert(word.to_owned());
        }
    }
}

/// What has been read of the innermost bracket.
#[derive(Clone, Copy, Debug, Default)]
struct Level {
    /// Where in the output the expression that is being read begins.
    start: usize,
    /// Choices `c ? a : b` whose `:` is still to come.
    choices: usize,
    /// Whether the expression compares something.
    compares: bool,
    /// Bars that are open.
    bars: usize,
    /// Whether the last bar has closed.
    has_closed: bool,
}

/// Brackets open around a place, by kind: a closing one that fits none is left to the complaints of the parser.
#[derive(Clone, Copy, Debug, Default)]
struct Closers {
    parens: usize,
    braces: usize,
    squares: usize,
    /// Opened by commands such as `\left(`.
    commands: usize,
}

struct Translator<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    facts: Facts,
    out: Vec<Token>,
    spellings: Vec<(Span, String)>,
    foreign: Vec<Span>,
    diagnostics: Vec<Diagnostic>,
    at: usize,
    /// Kind of the token written last.
    last: TokenKind,
    /// Whether a line break lies before the next token to be written.
    starts_line: bool,
    level: Level,
    closers: Closers,
    depth: usize,
    /// Environments such as `aligned` open here, in which `&` and `\\` are layout.
    environments: usize,
    /// Whether something in this statement was too deep.
    has_given_up: bool,
    /// Whether no `\end` is to come.
    is_endless: bool,
    /// Integrals whose `dx` is still to come.
    integrals: usize,
    /// Functions that are defined as `f[x_] := …`.
    bracketed: HashSet<String>,
    /// Whether the statement is a `show`: its settings are no definitions.
    is_show: bool,
    /// Habits that have been remarked on.
    warned: HashSet<&'static str>,
}

impl Translator<'_> {
    /// Kind of the token here, [`TokenKind::End`] at the end of the text.
    fn kind(&self) -> TokenKind {
        self.ahead(0)
    }

    /// Kind of the token `n` places on.
    fn ahead(&self, n: usize) -> TokenKind {
        self.tokens
            .get(self.at + n)
            .map_or(TokenKind::End, |token| token.kind)
    }

    /// Place of the token `n` places on; the empty place at the end of the text if there is none.
    fn span_ahead(&self, n: usize) -> Span {
        let end = self.tokens.last().map_or(0, |last| last.span.end);
        self.tokens
            .get(self.at + n)
            .map_or(Span::new(end, end), |token| token.span)
    }

    fn span(&self) -> Span {
        self.span_ahead(0)
    }

    /// Text of the token `n` places on.
    fn word_ahead(&self, n: usize) -> &str {
        self.span_ahead(n).text(self.text)
    }

    /// Place of the token before this one.
    fn last_span(&self) -> Span {
        let before = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        before.map_or_else(Span::default, |token| token.span)
    }

    /// Whether no blank lies between the tokens `n` and `n + 1` places on.
    fn touches(&self, n: usize) -> bool {
        self.span_ahead(n).end == self.span_ahead(n + 1).start
    }

    /// Goes past a token of another notation and returns its place.
    fn bump(&mut self) -> Span {
        let span = self.advance();
        self.foreign.push(span);
        span
    }

    /// Goes past the token here and returns its place.
    fn advance(&mut self) -> Span {
        let span = self.span();
        if let Some(token) = self.tokens.get(self.at) {
            self.starts_line |= token.starts_line;
            self.at += 1;
        }
        span
    }

    /// Writes a token that has been made of others.
    fn emit(&mut self, kind: TokenKind, span: Span) {
        let kind = match kind {
            TokenKind::Name => self.kind_of_name(span, span.text(self.text)),
            _ => kind,
        };
        self.write(kind, span);
    }

    /// What a word is that is to be a name: that, or a word of the language. What is neither is complained of, so
    /// that no name is passed on that could not be written.
    fn kind_of_name(&mut self, span: Span, word: &str) -> TokenKind {
        match kind_of_word(word) {
            Some(kind) if kind == TokenKind::Name || kind.is_keyword() => kind,
            _ => {
                self.complain_no_name(span, word);
                TokenKind::Error
            }
        }
    }

    /// Writes a token.
    fn write(&mut self, kind: TokenKind, span: Span) {
        self.out.push(Token {
            kind,
            span,
            starts_line: std::mem::take(&mut self.starts_line),
        });
        self.last = kind;
    }

    /// Writes a name or number that is spelt otherwise than its text.
    fn emit_spelt(&mut self, kind: TokenKind, span: Span, spelling: impl Into<String>) {
        let spelling = spelling.into();
        let kind = match kind {
            TokenKind::Name => self.kind_of_name(span, &spelling),
            _ => kind,
        };
        self.spellings.push((span, spelling));
        self.write(kind, span);
    }

    /// Writes the token here as it is.
    fn pass(&mut self) {
        let kind = self.kind();
        if kind == TokenKind::Bar {
            self.count_bar();
        }
        let span = self.advance();
        self.write(kind, span);
        self.follow(kind);
    }

    /// Keeps track of the expression that is being read.
    fn follow(&mut self, kind: TokenKind) {
        use TokenKind::{Colon, Comma, DotDot, Else, Equals, In, Semicolon, Then, Until, Where};
        match kind {
            Comma | Semicolon | Equals | Where | In | DotDot | Colon | Then | Else | Until => {
                self.level = Level {
                    start: self.out.len(),
                    choices: self.level.choices,
                    bars: self.level.bars,
                    ..Level::default()
                };
            }
            _ if kind.is_comparison() => self.level.compares = true,
            _ => {}
        }
    }

    /// A bar is here: it closes where an operator may stand and one is open.
    fn count_bar(&mut self) {
        let closes = self.level.bars > 0 && self.is_behind_operand();
        if closes {
            self.level.bars -= 1;
        } else {
            self.level.bars += 1;
        }
        self.level.has_closed = closes;
    }

    /// What `read` writes, instead of writing it here.
    fn capture(&mut self, read: impl FnOnce(&mut Self)) -> Vec<Token> {
        let outer = std::mem::take(&mut self.out);
        let level = std::mem::take(&mut self.level);
        let last = std::mem::replace(&mut self.last, TokenKind::LParen);
        read(self);
        self.last = last;
        self.level = level;
        std::mem::replace(&mut self.out, outer)
    }

    /// Writes what has been captured.
    fn paste(&mut self, mut captured: Vec<Token>) {
        if let Some(last) = captured.last() {
            self.last = last.kind;
        }
        self.out.append(&mut captured);
    }

    /// Whether the token written last ends an operand.
    fn is_behind_operand(&self) -> bool {
        use TokenKind::{
            Bang, Bar, Imaginary, Name, Number, Prime, RBrace, RParen, RSquare, Superscript,
        };
        match self.last {
            Bar => self.level.has_closed,
            kind => matches!(
                kind,
                Number | Imaginary | Name | RParen | RBrace | RSquare | Superscript | Bang | Prime
            ),
        }
    }

    fn file(&mut self) {
        self.begin_statement();
        while self.kind() != TokenKind::End {
            let here = self.at;
            if self.statement_begins() {
                self.begin_statement();
            }
            if self.at > here {
                // a definition may have been read to its end
                continue;
            }
            self.item();
            if std::mem::take(&mut self.has_given_up) {
                // what was too deep may have been left out: the parser is to meet it all the same
                let place = self.last_span();
                for _ in 0..=MAX_NESTING {
                    self.emit(TokenKind::LParen, place);
                }
            }
        }
    }

    /// A statement begins here.
    fn begin_statement(&mut self) {
        self.level = Level {
            start: self.out.len(),
            ..Level::default()
        };
        self.is_show = self.kind() == TokenKind::Show;
        self.last = TokenKind::End;
        self.opening();
    }

    /// Whether a statement begins at the token here, as far as the line breaks say.
    fn statement_begins(&self) -> bool {
        let Some(token) = self.tokens.get(self.at) else {
            return true;
        };
        if self.last == TokenKind::Semicolon && self.is_outside() {
            return true;
        }
        if !(token.starts_line || self.starts_line) {
            return false;
        }
        if self.is_outside() {
            let is_choice = token.kind == TokenKind::Question
                || token.kind == TokenKind::Colon && self.level.choices > 0;
            let continues = goes_on(token.kind) || is_choice || self.is_infix_command();
            return !continues && !wants_more(self.last);
        }
        !self.is_show
            && !matches!(self.last, TokenKind::Where | TokenKind::Comma)
            && definition_begins(&self.tokens, self.at)
    }

    /// Whether no bracket is open.
    fn is_outside(&self) -> bool {
        let open = &self.closers;
        open.parens + open.braces + open.squares + open.commands == 0
    }

    /// Whether the token here closes a bracket that is open.
    fn closes(&self) -> bool {
        match self.kind() {
            TokenKind::RParen => self.closers.parens > 0,
            TokenKind::RBrace => self.closers.braces > 0,
            TokenKind::RSquare => self.closers.squares > 0,
            _ => false,
        }
    }

    /// Translates up to where `stop` holds, a bracket closes, or a statement begins.
    fn until(&mut self, stop: impl Fn(&Self) -> bool) {
        while self.kind() != TokenKind::End
            && !stop(self)
            && !self.closes()
            && !self.statement_begins()
        {
            self.item();
        }
    }

    /// Translates the inside of a bracket that has been opened, in a level of its own.
    fn inside(&mut self, close: TokenKind) {
        self.deeper(|this| {
            let closers = this.closers;
            match close {
                TokenKind::RParen => this.closers.parens += 1,
                TokenKind::RBrace => this.closers.braces += 1,
                _ => this.closers.squares += 1,
            }
            this.until(|_| false);
            this.closers = closers;
        });
    }

    /// Does something one level deeper. Where that is too deep, the rest of the statement is passed on as it is: the
    /// brackets around it make the parser give it up.
    fn deeper(&mut self, read: impl FnOnce(&mut Self)) {
        if self.depth >= MAX_NESTING {
            self.give_up();
            return;
        }
        self.depth += 1;
        let outer = self.level;
        self.level = Level {
            start: self.out.len(),
            ..Level::default()
        };
        read(self);
        let compares = self.level.compares;
        self.level = Level {
            compares: outer.compares || compares,
            ..outer
        };
        self.depth -= 1;
    }

    /// Passes the rest of the statement on.
    fn give_up(&mut self) {
        self.has_given_up = true;
        self.emit(TokenKind::LParen, self.span());
        while self.kind() != TokenKind::End {
            let starts_line = self.tokens.get(self.at).is_some_and(|t| t.starts_line);
            if starts_line && definition_begins(&self.tokens, self.at) {
                return;
            }
            let kind = match self.kind() {
                TokenKind::Command
                | TokenKind::Dollar
                | TokenKind::Question
                | TokenKind::Ampersand
                | TokenKind::LSquare
                | TokenKind::RSquare => TokenKind::Error,
                kind => kind,
            };
            let span = self.bump();
            self.emit(kind, span);
        }
    }

    /// Translates the token here with what belongs to it; goes on by at least one token.
    fn item(&mut self) {
        match self.kind() {
            TokenKind::Command => self.command(),
            TokenKind::LParen => self.bracket(TokenKind::RParen),
            TokenKind::LBrace => self.bracket(TokenKind::RBrace),
            TokenKind::LSquare => self.square(),
            TokenKind::RSquare => self.stray(),
            TokenKind::Dollar if self.facts.dollars_pair => {
                self.bump();
            }
            TokenKind::Ampersand if self.environments > 0 => {
                self.bump();
            }
            TokenKind::Dollar | TokenKind::Ampersand => self.stray(),
            TokenKind::Question => self.question(),
            TokenKind::Colon if self.ahead(1) == TokenKind::Equals => {
                self.bump();
            }
            TokenKind::Colon if self.level.choices > 0 => self.otherwise(),
            TokenKind::If if self.is_behind_operand() => self.python_choice(),
            TokenKind::Caret => self.caret(),
            TokenKind::Number => self.number(),
            TokenKind::Name => self.name(),
            TokenKind::Bar => self.bar(),
            TokenKind::Dot => self.dot(),
            _ => self.pass(),
        }
    }

    /// A bracket of ours with its contents.
    fn bracket(&mut self, close: TokenKind) {
        self.pass();
        self.inside(close);
        if self.kind() == close {
            self.pass();
        }
    }
}
