//! A statement as nested runs of tokens, with the blanks between them and the comments before them.

use std::cell::Cell;
use std::collections::HashSet;

use super::blanks::{Place, blank_between, even_out_division};
use crate::Span;
use crate::ast::{Expr, Exprs, UnaryOp};
use crate::layout::StatementKind;
use crate::token::{Token, TokenKind};

/// A comment inside of a statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Note<'a> {
    /// Its text.
    pub(super) text: &'a str,
    /// Whether it shares its first line with the token before it.
    pub(super) is_behind: bool,
}

/// A token, or a pair of brackets or bars with what is inside.
#[derive(Debug)]
pub(super) struct Piece<'a> {
    /// Kind of the token, or of the opening bracket.
    pub(super) kind: TokenKind,
    /// Text of the token, or of the opening bracket.
    pub(super) text: &'a str,
    /// Whether a blank stands before it on its line.
    pub(super) blank: bool,
    /// Whether it stands between two operands.
    pub(super) is_infix: bool,
    /// The comments before it.
    pub(super) notes: Vec<Note<'a>>,
    /// What is inside of the brackets.
    pub(super) group: Option<Box<Group<'a>>>,
    /// Columns on one line, without the blank before it.
    pub(super) width: usize,
    /// Whether the brackets cannot stand on one line, or the locals of a `where` on one with what is before them.
    /// Braces and locals that are broken are so for good: the author may have done it.
    pub(super) must_break: Cell<bool>,
}

impl Piece<'_> {
    /// Whether it cannot be written on one line, even where a line has just begun.
    pub(super) fn breaks(&self) -> bool {
        self.must_break.get() || !self.notes.is_empty()
    }

    /// Takes back the line breaks of the author in a run: bars are written on one line.
    fn join(run: &[Piece<'_>]) {
        for piece in run {
            if let Some(group) = &piece.group {
                Self::join(&group.run);
                let has_notes = group.run.iter().any(Piece::breaks) || !group.notes.is_empty();
                piece.must_break.set(has_notes);
            } else {
                piece.must_break.set(false);
            }
        }
    }

    /// Passes on to the brackets in a run what must break inside of them.
    pub(super) fn settle(run: &[Piece<'_>]) {
        for piece in run {
            if let Some(group) = &piece.group {
                Self::settle(&group.run);
                let must_break = piece.must_break.get() || group.run.iter().any(Piece::breaks);
                piece.must_break.set(must_break);
            }
        }
    }
}

/// What is inside of a pair of brackets or bars.
#[derive(Debug)]
pub(super) struct Group<'a> {
    /// The tokens, commas among them.
    pub(super) run: Vec<Piece<'a>>,
    /// The closing bracket.
    pub(super) close: &'a str,
    /// The comments before the closing bracket.
    pub(super) notes: Vec<Note<'a>>,
}

impl Group<'_> {
    /// Whether blanks stand inside of the brackets: of braces.
    pub(super) fn is_padded(&self) -> bool {
        self.close == "}" && !self.run.is_empty()
    }
}

/// What the tree tells about the tokens of a text, by their places.
pub(super) struct Roles {
    callees: HashSet<u32>,
    opening_bars: HashSet<u32>,
}

impl Roles {
    /// The roles in a tree without errors.
    pub(super) fn of(exprs: &Exprs) -> Self {
        let mut roles = Self {
            callees: HashSet::new(),
            opening_bars: HashSet::new(),
        };
        for (_, expr, span) in exprs.iter() {
            match expr {
                Expr::Call { callee, .. } => {
                    roles.callees.insert(callee.span.start);
                }
                Expr::Series { .. } | Expr::Iterate { .. } | Expr::Integral { .. } => {
                    roles.callees.insert(span.start);
                }
                Expr::Unary {
                    op: UnaryOp::Abs, ..
                } => {
                    roles.opening_bars.insert(span.start);
                }
                _ => {}
            }
        }
        roles
    }
}

/// A text with what is needed to take its statements apart.
pub(super) struct Source<'a> {
    /// The text.
    pub(super) text: &'a str,
    /// What its tokens are.
    pub(super) roles: Roles,
}

/// An open bracket.
struct Open<'a> {
    piece: Piece<'a>,
    outer: Vec<Piece<'a>>,
    is_expanded: bool,
}

impl<'a> Source<'a> {
    /// The pieces of a statement; nothing where a comment stands in the middle of a line, or before a comma.
    pub(super) fn pieces(
        &self,
        tokens: &[Token],
        kind: StatementKind,
        comments: &[Span],
    ) -> Option<Vec<Piece<'a>>> {
        let mut run: Vec<Piece<'a>> = Vec::new();
        let mut opened: Vec<Open<'a>> = Vec::new();
        let mut comments = comments.iter().copied().peekable();
        // The bracket of a definition or of a `show` belongs to its name.
        let mut calls = matches!(kind, StatementKind::Function | StatementKind::Show);
        let mut before: Option<(Token, Place)> = None;
        for (index, &token) in tokens.iter().enumerate() {
            let mut notes = Vec::new();
            while let Some(comment) = comments.next_if(|c| c.start < token.span.start) {
                let until = comments
                    .peek()
                    .map_or(token.span.start, |next| next.start.min(token.span.start));
                notes.push(self.note(comment, before.map_or(0, |b| b.0.span.end), until)?);
            }
            if token.kind == TokenKind::Comma && !notes.is_empty() {
                return None;
            }
            let place = self.place(token, before, calls);
            calls = match token.kind {
                // the bars of `log|x|` stand for the bracket
                TokenKind::LParen | TokenKind::Bar => false,
                TokenKind::Name if self.roles.callees.contains(&token.span.start) => true,
                _ => calls,
            };
            let gap = before.is_some_and(|b| b.0.span.end < token.span.start);
            let blank = before.is_some_and(|b| blank_between(self.text, b, (token, place), gap));
            before = Some((token, place));
            let next = tokens.get(index + 1);
            let text = token.span.text(self.text);
            if place == Place::Closing {
                let open = opened.pop()?;
                run = close(open, run, text, notes)?;
                continue;
            }
            let ends_line = next.is_some_and(|next| next.starts_line);
            let is_infix = place == Place::Infix;
            let piece = Piece {
                kind: token.kind,
                text,
                blank,
                is_infix,
                must_break: Cell::new(
                    token.kind == TokenKind::Where && (token.starts_line || ends_line),
                ),
                notes,
                group: None,
                width: text.chars().count(),
            };
            if place.opens() {
                opened.push(Open {
                    piece,
                    outer: std::mem::take(&mut run),
                    is_expanded: token.kind == TokenKind::LBrace && ends_line,
                });
            } else {
                run.push(piece);
            }
        }
        even_out_division(&mut run);
        opened.is_empty().then_some(run)
    }

    /// The comment between a token and the next thing; nothing where the line goes on behind it.
    fn note(&self, comment: Span, before: u32, until: u32) -> Option<Note<'a>> {
        let gap = |from: u32, to: u32| self.text.get(from as usize..to as usize);
        let has_break = |text: &str| text.contains(['\n', '\r']);
        let ends_line = gap(comment.end, until).is_some_and(has_break);
        ends_line.then(|| Note {
            text: comment.text(self.text).trim_end(),
            is_behind: !gap(before, comment.start).is_some_and(has_break),
        })
    }

    /// Where the token stands among operands, told from the one before it.
    fn place(&self, token: Token, before: Option<(Token, Place)>, calls: bool) -> Place {
        let behind_operand = before.is_some_and(|(token, place)| match place {
            Place::Closing | Place::Postfix => true,
            Place::Operand => matches!(
                token.kind,
                TokenKind::Name | TokenKind::Number | TokenKind::Imaginary
            ),
            _ => false,
        });
        match token.kind {
            TokenKind::LParen | TokenKind::LBrace => Place::Opening,
            TokenKind::RParen | TokenKind::RBrace => Place::Closing,
            TokenKind::Bar if self.roles.opening_bars.contains(&token.span.start) => Place::Opening,
            TokenKind::Bar => Place::Closing,
            TokenKind::Plus | TokenKind::Minus if !behind_operand => Place::Prefix,
            TokenKind::Not | TokenKind::Root => Place::Prefix,
            TokenKind::Bang | TokenKind::Superscript | TokenKind::Prime => Place::Postfix,
            kind if kind.is_infix() => Place::Infix,
            _ => Place::Operand,
        }
        .in_call(calls)
    }
}

/// Puts what is inside of a bracket into its piece; the run in which that stands.
fn close<'a>(
    open: Open<'a>,
    mut run: Vec<Piece<'a>>,
    text: &'a str,
    notes: Vec<Note<'a>>,
) -> Option<Vec<Piece<'a>>> {
    if text == "}" && run.last().is_some_and(|last| last.kind == TokenKind::Comma) {
        run.pop();
    }
    even_out_division(&mut run);
    let Open {
        mut piece,
        mut outer,
        is_expanded,
    } = open;
    if text == "|" {
        Piece::join(&run);
    }
    let must_break = is_expanded || !notes.is_empty() || run.iter().any(Piece::breaks);
    if run.is_empty() && must_break {
        return None;
    }
    let group = Group {
        close: text,
        notes,
        run,
    };
    piece.must_break.set(must_break);
    piece.width += width(&group.run) + 1 + if group.is_padded() { 2 } else { 0 };
    piece.group = Some(Box::new(group));
    outer.push(piece);
    Some(outer)
}

/// Columns of a run on one line, without the blank before it.
pub(super) fn width(run: &[Piece<'_>]) -> usize {
    let first = run.first().map_or(0, |piece| piece.width);
    let others = run.iter().skip(1);
    first
        + others
            .map(|piece| piece.width + usize::from(piece.blank))
            .sum::<usize>()
}
