//! LaTeX: commands, groups, scripts and delimiters.

use super::Translator;
use super::command::{self, Meaning};
use crate::Span;
use crate::layout::goes_on;
use crate::stray::shorten;
use crate::token::{Token, TokenKind, is_name_character};

impl Translator<'_> {
    /// What the command here means.
    pub(super) fn meaning(&self) -> Option<Meaning> {
        self.meaning_ahead(0)
    }

    pub(super) fn meaning_ahead(&self, n: usize) -> Option<Meaning> {
        (self.ahead(n) == TokenKind::Command).then(|| command::meaning(self.word_ahead(n)))?
    }

    /// Whether a command that stands between operands is here.
    pub(super) fn is_infix_command(&self) -> bool {
        matches!(self.meaning(), Some(Meaning::Token(kind)) if goes_on(kind))
    }

    /// A command with what belongs to it.
    pub(super) fn command(&mut self) {
        let meaning = self.meaning();
        let span = self.bump();
        match meaning {
            Some(Meaning::Nothing) => {}
            Some(Meaning::Name(name)) => self.letter(span, name),
            Some(Meaning::Function(name)) => self.function(span, name),
            Some(Meaning::Token(kind)) => {
                if kind == TokenKind::Bar {
                    self.count_bar();
                }
                self.emit(kind, span);
                self.follow(kind);
            }
            Some(Meaning::Fraction) => self.fraction(span),
            Some(Meaning::Root) => self.root(span),
            Some(Meaning::Accent(name)) => {
                self.emit_spelt(TokenKind::Name, span, name);
                self.argument_of_command(span);
            }
            Some(Meaning::Font) => self.font(span),
            Some(Meaning::Operator) => self.operator(span),
            Some(Meaning::Sizing) => self.sizing(span),
            Some(Meaning::Opening(name, close)) => {
                self.emit_spelt(TokenKind::Name, span, name);
                self.enclosed(span, close, false);
            }
            Some(Meaning::OpeningBar(close)) => self.enclosed(span, close, true),
            Some(Meaning::Brace) if matches!(span.text(self.text), "\\{" | "\\lbrace") => {
                self.enclosed(span, "\\}", false);
            }
            Some(Meaning::Series(name)) => self.series(span, name),
            Some(Meaning::Integral) => self.integral(span),
            Some(Meaning::Begin) => self.begin(span),
            Some(Meaning::End) => self.end(span),
            Some(Meaning::Row) => self.next_row(),
            Some(Meaning::Brace | Meaning::Closing) => {
                self.refuse(span, "open the bracket before it, or remove it");
            }
            Some(Meaning::Refused(hint)) => self.refuse(span, hint),
            None => self.refuse(span, "write it with names, numbers and operators"),
        }
    }

    /// Complains of a command, and leaves a gap in its place and that of its scripts and groups.
    pub(super) fn refuse(&mut self, span: Span, hint: &str) {
        self.complain_command(span, hint);
        self.emit(TokenKind::Error, span);
        let count = self.diagnostics.len();
        self.limits(false);
        while self.kind() == TokenKind::LBrace && self.follows() {
            self.capture(Self::group);
        }
        self.diagnostics.truncate(count);
    }

    /// A Greek letter or `\infty`.
    fn letter(&mut self, span: Span, name: &'static str) {
        let has_subscript =
            self.kind() == TokenKind::Name && self.word_ahead(0).starts_with('_') && self.follows();
        let name = if has_subscript {
            in_letters(name)
        } else {
            name
        };
        match name {
            "φ" => self.warn_once(
                "constant-letter",
                span,
                "`φ` is the golden ratio here",
                "1.618…, not a variable",
                "choose another name for a variable, such as `θ`",
            ),
            "τ" => self.warn_once(
                "constant-letter",
                span,
                "`τ` is 2π here",
                "6.283…, not a variable",
                "choose another name for a variable, such as `θ`",
            ),
            _ => {}
        }
        self.named(span, name);
    }

    /// Whether the token here stands directly behind the last one.
    fn follows(&self) -> bool {
        self.last_span().end == self.span().start
    }

    /// Writes a name with the subscript that follows: `x_{12}` is `x_12`.
    pub(super) fn named(&mut self, span: Span, name: &str) {
        let mut spelling = name.to_owned();
        let mut whole = span;
        let follows = self.kind() == TokenKind::Name && self.follows();
        if !spelling.ends_with('_') && follows && self.word_ahead(0).starts_with('_') {
            spelling.push_str(self.word_ahead(0));
            whole = whole.join(self.bump());
        }
        let is_open = spelling.len() > 1 && spelling.ends_with('_') && self.follows();
        if is_open && matches!(self.kind(), TokenKind::LBrace | TokenKind::Command) {
            match self.subscript() {
                Some((text, length)) => {
                    spelling.push_str(&text);
                    for _ in 0..length {
                        whole = whole.join(self.bump());
                    }
                }
                None => {
                    let hint = format!(
                        "write letters and digits behind `_`, as in `{}n1`",
                        shorten(&spelling)
                    );
                    self.complain(
                        "bad-subscript",
                        self.span(),
                        "a subscript is part of a name",
                        "not letters and digits",
                        hint,
                    );
                    if self.kind() == TokenKind::LBrace {
                        self.capture(Self::group);
                    }
                    self.emit(TokenKind::Error, whole);
                    return;
                }
            }
        }
        if spelling == whole.text(self.text) {
            self.emit(TokenKind::Name, whole);
        } else {
            self.emit_spelt(TokenKind::Name, whole, spelling);
        }
    }

    /// The subscript here as text, and how many tokens it has.
    fn subscript(&self) -> Option<(String, usize)> {
        const LONGEST: usize = 6;
        if let Some(Meaning::Name(name)) = self.meaning() {
            return Some((in_letters(name).to_owned(), 1));
        }
        let mut start = 0;
        if self.meaning() == Some(Meaning::Font) {
            start = 1;
        }
        if self.ahead(start) != TokenKind::LBrace {
            return None;
        }
        let mut text = String::new();
        for n in start + 1..start + LONGEST {
            match self.ahead(n) {
                TokenKind::RBrace if text.is_empty() => return None,
                TokenKind::RBrace => return Some((text, n + 1)),
                kind if kind.is_keyword()
                    || matches!(kind, TokenKind::Name | TokenKind::Number) =>
                {
                    let word = self.word_ahead(n);
                    // a fraction, or one of the letters that stand alone
                    if !word.chars().all(is_name_character) {
                        return None;
                    }
                    text.push_str(word);
                }
                TokenKind::Command => match self.meaning_ahead(n)? {
                    Meaning::Name(name) => text.push_str(in_letters(name)),
                    Meaning::Function(_) => {
                        text.push_str(self.word_ahead(n).trim_start_matches('\\'));
                    }
                    _ => return None,
                },
                _ => return None,
            }
        }
        None
    }

    /// `{…}` as brackets.
    pub(super) fn group(&mut self) {
        let opening = self.bump();
        self.emit(TokenKind::LParen, opening);
        self.inside(TokenKind::RBrace);
        if self.kind() == TokenKind::RBrace {
            let closing = self.bump();
            self.emit(TokenKind::RParen, closing);
        } else {
            self.complain_open_group(opening, "}");
            self.emit(TokenKind::RParen, self.last_span());
        }
    }

    /// Goes past spacing.
    pub(super) fn skip_spacing(&mut self) {
        while self.meaning() == Some(Meaning::Nothing) {
            self.bump();
        }
    }

    /// The argument of a command such as `\frac`, in brackets: a group, or the next digit, letter or command.
    pub(super) fn argument_of_command(&mut self, owner: Span) {
        self.skip_spacing();
        if self.kind() == TokenKind::LBrace {
            self.group();
            return;
        }
        let place = self.span();
        match self.kind() {
            _ if self.statement_begins() || self.closes() => return self.no_argument(owner),
            TokenKind::Number | TokenKind::Name => {
                self.emit(TokenKind::LParen, place);
                self.first_character();
            }
            TokenKind::Command => {
                self.emit(TokenKind::LParen, place);
                self.deeper(Self::item);
            }
            _ => self.emit(TokenKind::LParen, owner),
        }
        let end = self.last_span();
        self.emit(TokenKind::RParen, end);
    }

    /// Stands for an argument that is missing.
    fn no_argument(&mut self, owner: Span) {
        self.complain_no_argument(owner);
        self.emit(TokenKind::LParen, owner);
        self.emit(TokenKind::Error, owner);
        self.emit(TokenKind::RParen, owner);
    }

    /// The first digit or letter of the token here; the rest of it stays.
    fn first_character(&mut self) {
        let (kind, span) = (self.kind(), self.span());
        let word = span.text(self.text);
        let mut characters = word.chars();
        let first = characters.next().map_or(0, char::len_utf8);
        let is_whole = match kind {
            TokenKind::Number => !word.chars().all(|c| c.is_ascii_digit()),
            _ => characters
                .next()
                .is_none_or(|c| c == '_' || matches!(c, '₀'..='₉')),
        };
        let middle = span.start + u32::try_from(first).unwrap_or(0);
        if is_whole || middle >= span.end {
            if kind == TokenKind::Name {
                self.name();
            } else {
                self.pass();
            }
            return;
        }
        self.cut(middle);
        self.emit(kind, Span::new(span.start, middle));
    }

    /// Leaves of the name or number here what begins at `middle`; that may be a number, `\frac1x2`, or a word,
    /// `\frac{x}sin`.
    pub(super) fn cut(&mut self, middle: u32) {
        let Some(token) = self.tokens.get_mut(self.at) else {
            return;
        };
        self.starts_line |= std::mem::take(&mut token.starts_line);
        token.span.start = middle;
        let span = token.span;
        let rest = span.text(self.text);
        let is_number = rest.chars().all(|c| c.is_ascii_digit());
        let kind = if is_number {
            TokenKind::Number
        } else {
            self.kind_of_name(span, rest)
        };
        if let Some(token) = self.tokens.get_mut(self.at) {
            token.kind = kind;
        }
    }

    /// `\frac{a}{b}` as `((a)/(b))`
    fn fraction(&mut self, span: Span) {
        self.emit(TokenKind::LParen, span);
        self.argument_of_command(span);
        let is_over = self.kind() != TokenKind::LBrace && self.statement_begins();
        self.emit(TokenKind::Slash, span);
        if is_over {
            self.no_argument(span);
        } else {
            self.argument_of_command(span);
        }
        let end = self.last_span();
        self.emit(TokenKind::RParen, end);
    }

    /// `\sqrt{x}` as `sqrt(x)`, `\sqrt[3]{x}` as `cbrt(x)`, `\sqrt[n]{x}` as `((x)^(1/(n)))`
    fn root(&mut self, span: Span) {
        self.skip_spacing();
        if self.kind() != TokenKind::LSquare {
            self.emit_spelt(TokenKind::Name, span, "sqrt");
            self.argument_of_command(span);
            return;
        }
        let opening = self.bump();
        self.emit(TokenKind::LParen, span);
        let degree = self.capture(|this| this.inside(TokenKind::RSquare));
        if self.kind() == TokenKind::RSquare {
            self.bump();
        } else {
            self.complain_open_group(opening, "]");
        }
        let written = match degree.as_slice() {
            [only] => only.span.text(self.text),
            _ => "",
        };
        if let Some(name) = match written {
            "2" => Some("sqrt"),
            "3" => Some("cbrt"),
            _ => None,
        } {
            self.emit_spelt(TokenKind::Name, span, name);
            self.argument_of_command(span);
        } else {
            self.argument_of_command(span);
            self.emit(TokenKind::Caret, opening);
            self.emit(TokenKind::LParen, opening);
            self.emit_spelt(TokenKind::Number, opening, "1");
            self.emit(TokenKind::Slash, opening);
            self.emit(TokenKind::LParen, opening);
            self.paste(degree);
            self.emit(TokenKind::RParen, opening);
            self.emit(TokenKind::RParen, opening);
        }
        let end = self.last_span();
        self.emit(TokenKind::RParen, end);
    }

    /// `\mathrm{x}`, `\text{x}`: the name, or what else is in the group.
    fn font(&mut self, span: Span) {
        let is_text = matches!(span.text(self.text), "\\text" | "\\textrm" | "\\mbox");
        if self.ahead(1) == TokenKind::Name && self.ahead(2) == TokenKind::RBrace {
            let word = self.word_ahead(1).to_owned();
            self.bump();
            self.bump();
            let whole = span.join(self.bump());
            match command::function(&word) {
                Some(name) => self.function(whole, name),
                None => self.named(whole, &word),
            }
        } else if is_text && self.kind() == TokenKind::LBrace {
            self.complain_command(span, "write conditions with `if c then a else b`");
            let outer = self.capture(Self::group);
            let end = outer.last().map_or(span, |last| last.span);
            self.emit(TokenKind::Error, span.join(end));
        } else if self.kind() == TokenKind::LBrace {
            self.group();
        }
    }

    /// `\operatorname{f}`
    fn operator(&mut self, span: Span) {
        if self.kind() == TokenKind::Star {
            self.bump();
        }
        let is_name = self.kind() == TokenKind::LBrace
            && self.ahead(1) == TokenKind::Name
            && self.ahead(2) == TokenKind::RBrace;
        if !is_name {
            self.refuse(span, "write the name of the function");
            return;
        }
        let word = self.word_ahead(1).to_owned();
        self.bump();
        self.bump();
        let whole = span.join(self.bump());
        let ours = command::function(&word).or_else(|| super::function_of(&word));
        self.function(whole, ours.unwrap_or(&word));
    }

    /// `\left(` and the like: pairs; sizes without a side are nothing.
    fn sizing(&mut self, span: Span) {
        let word = span.text(self.text);
        if word == "\\right" {
            self.refuse(span, "write `\\left` before the bracket that it closes");
            return;
        }
        if word != "\\left" {
            if let Some(token) = self.tokens.get_mut(self.at) {
                token.kind = match token.kind {
                    TokenKind::LSquare => TokenKind::LParen,
                    TokenKind::RSquare => TokenKind::RParen,
                    kind => kind,
                };
            }
            return;
        }
        let meaning = self.meaning();
        match self.kind() {
            TokenKind::LParen | TokenKind::LSquare => self.delimited(span, false),
            TokenKind::Bar => self.delimited(span, true),
            TokenKind::Command => match meaning {
                Some(Meaning::Brace) => self.delimited(span, false),
                Some(Meaning::OpeningBar(_) | Meaning::Token(TokenKind::Bar)) => {
                    self.delimited(span, true);
                }
                Some(Meaning::Opening(name, _)) => {
                    self.emit_spelt(TokenKind::Name, span, name);
                    self.delimited(span, false);
                }
                _ => self.refuse(span, "write a bracket behind it"),
            },
            _ => self.refuse(span, "write a bracket behind it"),
        }
    }

    /// From the delimiter behind `\left` to the one behind `\right`.
    fn delimited(&mut self, left: Span, is_bar: bool) {
        let opening = left.join(self.bump());
        self.enclosed(opening, "\\right", is_bar);
        if self.last_span().text(self.text) == "\\right"
            && matches!(
                self.kind(),
                TokenKind::RParen | TokenKind::RSquare | TokenKind::Bar | TokenKind::Command
            )
        {
            self.bump();
        }
    }

    /// From behind an opening command to a closing one: brackets, with bars inside of them for `|x|`. The brackets
    /// around the bars keep them from being taken for those of other bars.
    fn enclosed(&mut self, opening: Span, close: &str, is_bar: bool) {
        self.emit(TokenKind::LParen, opening);
        if is_bar {
            self.emit(TokenKind::Bar, opening);
            self.emit(TokenKind::LParen, opening);
        }
        let alternative = if close == "\\}" { "\\rbrace" } else { close };
        let is_end = |this: &Self| {
            this.kind() == TokenKind::Command
                && (this.word_ahead(0) == close || this.word_ahead(0) == alternative)
        };
        self.deeper(|this| {
            this.closers.commands += 1;
            this.until(is_end);
            this.closers.commands -= 1;
        });
        let end = if is_end(self) {
            self.bump()
        } else {
            let missing = if close == "\\right" {
                "\\right)"
            } else {
                close
            };
            self.complain_open_group(opening, missing);
            self.last_span()
        };
        if is_bar {
            self.emit(TokenKind::RParen, end);
            self.emit(TokenKind::Bar, end);
        }
        self.emit(TokenKind::RParen, end);
    }

    /// `^`, and the group behind it.
    pub(super) fn caret(&mut self) {
        let is_group = self.ahead(1) == TokenKind::LBrace;
        let inner = usize::from(is_group) + 1;
        match self.meaning_ahead(inner) {
            Some(Meaning::Token(TokenKind::Prime)) => return self.prime(is_group),
            Some(Meaning::Token(TokenKind::Star)) => return self.complain_star(inner, is_group),
            _ => {}
        }
        let is_star = self.ahead(inner) == TokenKind::Star
            && if is_group {
                self.ahead(inner + 1) == TokenKind::RBrace
            } else {
                self.touches(0)
            };
        if is_star {
            return self.complain_star(inner, is_group);
        }
        self.pass();
        if is_group && !self.facts.cases.contains(&self.at) {
            self.exponent();
        }
    }

    /// `{…}` behind `^`: brackets, which a number does without.
    pub(super) fn exponent(&mut self) {
        let signs = usize::from(self.ahead(1) == TokenKind::Minus);
        let is_number = self.ahead(1 + signs) == TokenKind::Number
            && self.ahead(2 + signs) == TokenKind::RBrace;
        if !is_number {
            self.group();
            return;
        }
        self.bump();
        for _ in 0..=signs {
            self.pass();
        }
        self.bump();
    }

    /// `f^{\prime}`
    fn prime(&mut self, is_group: bool) {
        self.bump();
        if is_group {
            self.bump();
        }
        while self.meaning() == Some(Meaning::Token(TokenKind::Prime)) {
            let span = self.bump();
            self.emit(TokenKind::Prime, span);
        }
        if is_group && self.kind() == TokenKind::RBrace {
            self.bump();
        }
    }

    /// `z^*`
    fn complain_star(&mut self, inner: usize, is_group: bool) {
        let name = shorten(self.last_span().text(self.text));
        let (name, mut span) = if name.chars().all(char::is_alphanumeric) {
            (name, self.last_span().join(self.span()))
        } else {
            ("…".to_owned(), self.span())
        };
        for _ in 0..=inner + usize::from(is_group) {
            span = span.join(self.bump());
        }
        self.complain(
            "star-exponent",
            span,
            "a star is no exponent",
            "the conjugate is a function",
            format!("write `conj({name})`"),
        );
    }

    /// `\begin{…}`
    fn begin(&mut self, span: Span) {
        let Some((name, length)) = self.environment() else {
            self.refuse(span, "write the formula itself");
            return;
        };
        let name = name.to_owned();
        let mut whole = span;
        for _ in 0..length {
            whole = whole.join(self.bump());
        }
        match name.as_str() {
            "cases" | "dcases" => self.cases(whole),
            "aligned" | "align" | "equation" | "gathered" | "gather" | "split" | "multline"
            | "displaymath" | "math" => self.environments += 1,
            "pmatrix" | "bmatrix" | "matrix" => self.refuse_environment(
                whole,
                "there are no matrices; write `(a, b)` for a vector, `rotate(p, angle)` for a rotation",
            ),
            _ => self.refuse_environment(whole, "write the formula itself"),
        }
    }

    /// Complains of an environment and leaves it out.
    fn refuse_environment(&mut self, span: Span, hint: &str) {
        let is_end = |token: &Token| {
            token.kind == TokenKind::Command && token.span.text(self.text) == "\\end"
        };
        let rest = self.tokens.get(self.at..).unwrap_or_default();
        let end = (!self.is_endless).then(|| rest.iter().position(is_end));
        match end {
            Some(Some(distance)) => {
                for _ in 0..=distance {
                    self.bump();
                }
                for _ in 0..self.environment().map_or(0, |found| found.1) {
                    self.bump();
                }
            }
            // not looked for again: each search would go to the end of the text
            _ => self.is_endless = true,
        }
        self.refuse(span, hint);
    }

    /// `\end{…}`
    fn end(&mut self, span: Span) {
        let length = self.environment().map_or(0, |found| found.1);
        let mut whole = span;
        for _ in 0..length {
            whole = whole.join(self.bump());
        }
        if self.environments == 0 {
            self.refuse(whole, "write the formula itself");
        } else {
            self.environments -= 1;
        }
    }

    /// The name in braces here, without a star, and the number of tokens.
    pub(super) fn environment(&self) -> Option<(&str, usize)> {
        if self.ahead(0) != TokenKind::LBrace || self.ahead(1) != TokenKind::Name {
            return None;
        }
        let star = usize::from(self.ahead(2) == TokenKind::Star);
        (self.ahead(2 + star) == TokenKind::RBrace).then(|| (self.word_ahead(1), 3 + star))
    }

    /// `\\` ends a line.
    fn next_row(&mut self) {
        if let Some(token) = self.tokens.get_mut(self.at) {
            token.starts_line = true;
        }
    }
}

/// A letter that stands for itself and cannot go on, as the beginning or a part of a longer name: `φ_1` would be two
/// names.
fn in_letters(letter: &'static str) -> &'static str {
    match letter {
        "π" => "pi",
        "φ" => "phi",
        "τ" => "tau",
        "∞" => "inf",
        _ => letter,
    }
}
