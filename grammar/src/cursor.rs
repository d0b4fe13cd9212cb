//! What the productions stand on: a place in the tokens of one statement, the arena, and the complaints so far.

use crate::ast::{Expr, ExprId, Exprs, MAX_NESTING};
use crate::diagnostic::MAX_DIAGNOSTICS;
use crate::layout::{Layout, Statement, StatementKind};
use crate::paste::Spellings;
use crate::scope::Scope;
use crate::token::{Token, TokenKind};
use crate::{Diagnostic, Span};

/// The state of parsing. The productions are methods in `parser/`, the complaints in `complaint/`.
pub(crate) struct Parser<'a> {
    pub(crate) text: &'a str,
    pub(crate) layout: &'a Layout,
    pub(crate) scope: Scope<'a>,
    pub(crate) exprs: Exprs,
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// Names of other notations that have been read as ours.
    pub(crate) foreign: Vec<Span>,
    /// Bars open in the innermost bracket: whether the next `|` closes.
    pub(crate) bars: u32,
    /// What is being read.
    pub(crate) statement: StatementKind,
    /// Whether the condition of an `if` is being read, outside of brackets in it.
    pub(crate) in_condition: bool,
    /// Whether an argument may be the bare name of a function.
    pub(crate) takes_functions: bool,
    /// Parentheses and braces open, so that a wrong closing one is left to whom it belongs.
    pub(crate) open_parens: usize,
    pub(crate) open_braces: usize,
    /// Whether a bracket of the statement is wrong, or it has a `?`: closing brackets, commas and colons that fit
    /// nowhere are then consequences.
    pub(crate) is_broken: bool,
    tokens: &'a [Token],
    spellings: &'a Spellings,
    at: usize,
    /// Kind of the token at `at`.
    here: TokenKind,
    start: usize,
    end: usize,
    /// Nesting of each expression in the arena, left operands not counted; at most [`MAX_NESTING`].
    heights: Vec<u8>,
    depth: usize,
    /// The token at which a problem has been reported: a second one there would be its consequence.
    complained_at: Option<usize>,
    abandoned: bool,
    errors: usize,
    warnings: usize,
    /// Whether the statements before have as many errors, or warnings, as are listed.
    is_full: bool,
    warns_enough: bool,
}

/// Most errors, and most warnings, that are kept of one statement: more than are listed, as they are not found quite
/// in the order of the text.
const MAX_KEPT: usize = 20 * MAX_DIAGNOSTICS;

/// An expression that has been read, with the span that includes its brackets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) id: ExprId,
    pub(crate) span: Span,
}

impl<'a> Parser<'a> {
    pub(crate) fn new(
        text: &'a str,
        tokens: &'a [Token],
        spellings: &'a Spellings,
        layout: &'a Layout,
        scope: Scope<'a>,
    ) -> Self {
        Self {
            text,
            layout,
            scope,
            // there is hardly more than one expression for each token
            exprs: Exprs::with_capacity(tokens.len()),
            diagnostics: Vec::new(),
            foreign: Vec::new(),
            bars: 0,
            statement: StatementKind::Formula,
            in_condition: false,
            takes_functions: false,
            open_parens: 0,
            open_braces: 0,
            is_broken: false,
            tokens,
            spellings,
            at: 0,
            here: TokenKind::End,
            start: 0,
            end: 0,
            heights: Vec::with_capacity(tokens.len()),
            depth: 0,
            complained_at: None,
            abandoned: false,
            errors: 0,
            warnings: 0,
            is_full: false,
            warns_enough: false,
        }
    }

    /// Goes to the beginning of a statement.
    pub(crate) fn enter(&mut self, statement: &Statement) {
        self.start = statement.start;
        self.end = statement.end.min(self.tokens.len());
        self.go_to(statement.start);
        self.statement = statement.kind;
        self.depth = 0;
        self.bars = 0;
        self.open_parens = 0;
        self.open_braces = 0;
        self.is_broken = false;
        self.takes_functions = false;
        self.in_condition = false;
        self.complained_at = None;
        self.abandoned = false;
        self.is_full = self.errors > MAX_DIAGNOSTICS;
        self.warns_enough = self.warnings > MAX_DIAGNOSTICS;
    }

    /// Goes to the token with this index.
    fn go_to(&mut self, at: usize) {
        self.at = at;
        self.here = self.ahead(0);
    }

    /// Index of the first token of the statement.
    pub(crate) fn start(&self) -> usize {
        self.start
    }

    /// Index of the token here.
    pub(crate) fn position(&self) -> usize {
        self.at
    }

    /// Kind of the token here, [`TokenKind::End`] at the end of the statement.
    pub(crate) fn kind(&self) -> TokenKind {
        self.here
    }

    /// Kind of the token `n` places on.
    pub(crate) fn ahead(&self, n: usize) -> TokenKind {
        let at = self.at.saturating_add(n);
        if at >= self.end {
            return TokenKind::End;
        }
        self.tokens.get(at).map_or(TokenKind::End, |t| t.kind)
    }

    /// The tokens of the statement that are `from` places on, and those behind them.
    pub(crate) fn tokens_ahead(&self, from: usize) -> &'a [Token] {
        let start = self.at.saturating_add(from).min(self.end);
        self.tokens.get(start..self.end).unwrap_or_default()
    }

    /// Kind of the token before this one, [`TokenKind::End`] at the beginning of the statement.
    pub(crate) fn behind(&self) -> TokenKind {
        self.last().map_or(TokenKind::End, |t| t.kind)
    }

    /// Kind of the token `n` places before the last one.
    pub(crate) fn behind_by(&self, n: usize) -> TokenKind {
        match self.at.checked_sub(n + 1) {
            Some(at) if at >= self.start => self.tokens.get(at).map_or(TokenKind::End, |t| t.kind),
            _ => TokenKind::End,
        }
    }

    /// Place of the token `n` places before the last one; empty where there is none.
    pub(crate) fn span_behind(&self, n: usize) -> Span {
        let at = self.at.checked_sub(n + 1).filter(|&at| at >= self.start);
        at.and_then(|at| self.tokens.get(at))
            .map_or_else(Span::default, |token| token.span)
    }

    /// Place of the brackets that open `at` places on, with what is inside of them, where they end soon.
    pub(crate) fn brackets_ahead(&self, at: usize) -> Option<Span> {
        const FAR: usize = 40;
        let opening = self.ahead(at);
        let closing = match opening {
            TokenKind::LParen => TokenKind::RParen,
            TokenKind::LBrace => TokenKind::RBrace,
            _ => return None,
        };
        let mut depth = 0_usize;
        for n in at..at + FAR {
            let kind = self.ahead(n);
            depth += usize::from(kind == opening);
            depth -= usize::from(kind == closing);
            if depth == 0 {
                return Some(self.span_ahead(at).join(self.span_ahead(n)));
            }
        }
        None
    }

    /// Place of the rest of the statement; empty at its end.
    pub(crate) fn rest(&self) -> Span {
        match self
            .end
            .checked_sub(1)
            .and_then(|last| self.tokens.get(last))
        {
            Some(last) if self.at < self.end => self.span().join(last.span),
            _ => self.span(),
        }
    }

    /// Whether a token of this kind is here.
    pub(crate) fn at(&self, kind: TokenKind) -> bool {
        self.here == kind
    }

    /// Place of the token here; the empty place behind the last token at the end of the statement.
    pub(crate) fn span(&self) -> Span {
        if self.at < self.end
            && let Some(token) = self.tokens.get(self.at)
        {
            return token.span;
        }
        let end = self.last_span().end;
        Span::new(end, end)
    }

    /// Place of the token `n` places on, or of the one here if there is none.
    pub(crate) fn span_ahead(&self, n: usize) -> Span {
        let at = self.at.saturating_add(n);
        match self.tokens.get(at) {
            Some(token) if at < self.end => token.span,
            _ => self.span(),
        }
    }

    /// Place of the token before this one; the empty place at the beginning of the statement.
    pub(crate) fn last_span(&self) -> Span {
        if let Some(token) = self.last() {
            return token.span;
        }
        let start = self.first_span().start;
        Span::new(start, start)
    }

    /// Place of the first token of the statement.
    pub(crate) fn first_span(&self) -> Span {
        self.tokens
            .get(self.start)
            .map_or_else(Span::default, |t| t.span)
    }

    fn last(&self) -> Option<&Token> {
        if self.at <= self.start {
            return None;
        }
        self.tokens.get(self.at - 1)
    }

    /// The place of all tokens of a statement: those of other notations may have changed their order.
    pub(crate) fn spread(&self, statement: &Statement) -> Span {
        let range = statement.start..statement.end.min(self.tokens.len());
        let tokens = self.tokens.get(range).unwrap_or_default();
        let spans = tokens.iter().map(|token| token.span);
        spans.reduce(Span::join).unwrap_or_default()
    }

    /// Whether the token here stands first on its line.
    pub(crate) fn starts_line(&self) -> bool {
        self.at < self.end && self.tokens.get(self.at).is_some_and(|t| t.starts_line)
    }

    /// The text of a token by its index in the file.
    pub(crate) fn token_text(&self, index: usize) -> &'a str {
        self.tokens
            .get(index)
            .map_or("", |token| self.spelling(token.span))
    }

    /// The text of a name or number in this language, whatever the notation it was written in.
    pub(crate) fn spelling(&self, span: Span) -> &'a str {
        self.spellings
            .get(span)
            .unwrap_or_else(|| span.text(self.text))
    }

    /// Goes past the token here and returns its place.
    pub(crate) fn bump(&mut self) -> Span {
        let span = self.span();
        if self.at < self.end {
            self.go_to(self.at + 1);
        }
        span
    }

    /// Goes past the token here if it is of this kind.
    pub(crate) fn eat(&mut self, kind: TokenKind) -> bool {
        let found = self.at(kind);
        if found {
            self.bump();
        }
        found
    }

    /// Goes past tokens that have been complained about by the lexer; what follows from them is not reported.
    pub(crate) fn skip_strays(&mut self) {
        while self.at(TokenKind::Error) {
            let place = self.bump();
            self.is_broken |= place.text(self.text) == "?";
            self.complained_at = Some(self.at);
        }
    }

    /// Adds an expression to the arena, unless it is nested too deeply.
    pub(crate) fn node(&mut self, expr: Expr, mut span: Span) -> Node {
        let mut height = 0_u8;
        let lhs = match expr {
            Expr::Binary { op, lhs, .. } if op != crate::ast::BinaryOp::Pow => Some(lhs),
            _ => None,
        };
        expr.for_each_child(|child| {
            let below = self.heights.get(child.index()).copied().unwrap_or(0);
            height = height.max(below.saturating_add(u8::from(Some(child) != lhs)));
            // the tokens of other notations may have changed their order
            span = span.join(self.exprs.span(child));
        });
        if let Expr::Where { locals, .. } = &expr {
            let names = locals.iter().map(|local| local.name.span);
            span = names.fold(span, Span::join);
        }
        if usize::from(height) > MAX_NESTING {
            self.complain_too_deep(span);
            return self.error_node(span);
        }
        self.heights.push(height);
        Node {
            id: self.exprs.push(expr, span),
            span,
        }
    }

    /// Adds a stand-in for what could not be read.
    pub(crate) fn error_node(&mut self, span: Span) -> Node {
        self.heights.push(0);
        Node {
            id: self.exprs.push(Expr::Error, span),
            span,
        }
    }

    /// Reads one level deeper, or gives the statement up where that is too deep.
    #[inline(always)]
    pub(crate) fn nested(&mut self, production: fn(&mut Self) -> Node) -> Node {
        if !self.descend() {
            let span = self.span();
            self.complain_too_deep(span);
            return self.missing_node();
        }
        let node = production(self);
        self.ascend();
        node
    }

    /// Goes one level deeper; false where that is too deep.
    pub(crate) fn descend(&mut self) -> bool {
        let may = self.depth < MAX_NESTING;
        self.depth += usize::from(may);
        may
    }

    /// Comes back from a level.
    pub(crate) fn ascend(&mut self) {
        self.depth = self.depth.saturating_sub(1);
    }

    /// Leaves the rest of the statement unread.
    pub(crate) fn abandon(&mut self) {
        self.go_to(self.end);
        self.complained_at = Some(self.end);
        self.abandoned = true;
    }

    /// Whether the rest of the statement is left unread.
    pub(crate) fn is_abandoned(&self) -> bool {
        self.abandoned
    }

    /// Reports a problem at the token here, unless it follows from one that has been reported.
    pub(crate) fn complain(&mut self, diagnostic: Diagnostic) {
        if self.complained_at != Some(self.at) {
            self.complained_at = Some(self.at);
            self.report(diagnostic);
        }
    }

    /// Adds a problem, unless it would not be listed.
    pub(crate) fn report(&mut self, diagnostic: Diagnostic) {
        let (count, is_full) = if diagnostic.is_error() {
            (&mut self.errors, self.is_full)
        } else {
            (&mut self.warnings, self.warns_enough)
        };
        if !is_full && *count < MAX_KEPT {
            *count += 1;
            let is_last = diagnostic.is_error() && *count == MAX_KEPT;
            self.diagnostics.push(diagnostic);
            if is_last {
                // nothing more would be listed
                self.abandon();
            }
        }
    }

    /// Removes the last problem, an error, and returns its place.
    pub(crate) fn take_back(&mut self) -> Option<Span> {
        self.errors = self.errors.saturating_sub(1);
        self.diagnostics.pop().map(|last| last.span)
    }

    /// Whether an error at the token here would not be listed, so that its text need not be made: it follows from one
    /// that has been reported, or there are too many before.
    pub(crate) fn is_hushed(&mut self) -> bool {
        let is_hushed =
            self.complained_at == Some(self.at) || self.is_full || self.errors >= MAX_KEPT;
        if is_hushed {
            self.complained_at = Some(self.at);
        }
        is_hushed
    }

    /// Whether a warning would not be listed.
    pub(crate) fn warns_enough(&self) -> bool {
        self.warns_enough || self.warnings >= MAX_KEPT
    }

    /// A problem at the token here has been reported.
    pub(crate) fn mark_complained(&mut self) {
        self.complained_at = Some(self.at);
    }

    /// Goes to the next comma or closing bracket of the list that is being read.
    pub(crate) fn skip_to_separator(&mut self) {
        let mut depth = 0_usize;
        loop {
            match self.kind() {
                TokenKind::End => return,
                TokenKind::Comma if depth == 0 => return,
                TokenKind::RParen | TokenKind::RBrace if depth == 0 => return,
                TokenKind::RParen | TokenKind::RBrace => depth -= 1,
                TokenKind::LParen | TokenKind::LBrace => depth += 1,
                _ => {}
            }
            self.bump();
        }
    }

    /// Goes past an opening bracket; the bars around it do not count inside.
    pub(crate) fn open(&mut self) -> Opened {
        let kind = self.kind();
        if kind == TokenKind::LParen {
            self.open_parens += 1;
        } else {
            self.open_braces += 1;
        }
        Opened {
            kind,
            bars: std::mem::take(&mut self.bars),
            takes_functions: std::mem::take(&mut self.takes_functions),
            in_condition: std::mem::take(&mut self.in_condition),
            span: self.bump(),
        }
    }

    /// After an element of a list: goes past a comma (true, another follows) or the closing bracket (false).
    pub(crate) fn separator(&mut self, opened: &Opened) -> bool {
        if self.eat(TokenKind::Comma) {
            return true;
        }
        if !self.at(opened.closing()) && !self.is_foreign_closing(opened) {
            self.complain_unexpected(Some(opened));
            if self.eat(TokenKind::Semicolon) {
                return true;
            }
            self.skip_to_separator();
            if self.eat(TokenKind::Comma) {
                return true;
            }
        }
        self.close(opened);
        false
    }

    /// Goes past the closing bracket, or complains that there is none.
    pub(crate) fn close(&mut self, opened: &Opened) {
        if opened.kind == TokenKind::LParen {
            self.open_parens = self.open_parens.saturating_sub(1);
        } else {
            self.open_braces = self.open_braces.saturating_sub(1);
        }
        self.bars = opened.bars;
        self.takes_functions = opened.takes_functions;
        self.in_condition = opened.in_condition;
        if self.eat(opened.closing()) {
            return;
        }
        self.complain_not_closed(opened);
        let other = match self.kind() {
            TokenKind::RParen => self.open_parens,
            TokenKind::RBrace => self.open_braces,
            _ => return,
        };
        if other == 0 {
            self.bump();
        }
    }

    /// Whether the token here closes, but not this bracket.
    fn is_foreign_closing(&self, opened: &Opened) -> bool {
        let kind = self.kind();
        match kind {
            TokenKind::End => true,
            TokenKind::RParen | TokenKind::RBrace => kind != opened.closing(),
            // the `:` of a case: its condition has ended
            TokenKind::Colon => opened.kind == TokenKind::LParen && self.open_braces > 0,
            _ => false,
        }
    }
}

/// An opening bracket that has been read, and what it hides until it is closed.
pub(crate) struct Opened {
    pub(crate) kind: TokenKind,
    pub(crate) span: Span,
    bars: u32,
    takes_functions: bool,
    in_condition: bool,
}

impl Opened {
    /// What closes it.
    pub(crate) fn closing(&self) -> TokenKind {
        if self.kind == TokenKind::LParen {
            TokenKind::RParen
        } else {
            TokenKind::RBrace
        }
    }
}
