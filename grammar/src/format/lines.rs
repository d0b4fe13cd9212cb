//! The pieces of a statement as lines.
//!
//! What fits on a line stands on it. Else the loosest parts are taken apart first: locals, then the arms of a
//! conditional, then operators, each of which begins a line; at last the insides of brackets, one item a line.

use super::pieces::{Group, Note, Piece, width};
use crate::token::TokenKind;

/// Columns of a line.
pub(super) const WIDTH: usize = 100;
/// Columns by which a line that goes on is set in.
const STEP: usize = 2;
/// Columns beyond which nothing is set in, so that deep nesting does not blow up the text.
const MAX_INDENT: usize = 60;
/// Columns of `where` and the blank behind it, under which locals are aligned.
const WHERE: usize = 6;

/// Tells the operators before which a line may be broken.
type Break = fn(&Piece<'_>) -> bool;

/// Where an expression is taken apart, loosest first.
const LEVELS: [Break; 9] = [
    |piece| piece.kind == TokenKind::Until,
    |piece| piece.kind == TokenKind::In,
    |piece| piece.kind == TokenKind::Else,
    |piece| piece.kind == TokenKind::Then,
    |piece| piece.kind == TokenKind::Or,
    |piece| piece.kind == TokenKind::And,
    |piece| piece.kind.is_comparison(),
    |piece| piece.is_infix && matches!(piece.kind, TokenKind::Plus | TokenKind::Minus),
    |piece| matches!(piece.kind, TokenKind::Star | TokenKind::Slash),
];

/// The lines of a statement; nothing where a comment stands at a place where no line can end.
pub(super) fn lines(run: &[Piece<'_>]) -> Option<String> {
    loop {
        let mut writer = Writer {
            out: String::new(),
            column: 0,
            is_fresh: true,
            has_lost: false,
            has_broken: false,
        };
        writer.item(run, 0, 0);
        if writer.has_lost {
            return None;
        }
        if !writer.has_broken {
            return Some(writer.out);
        }
        // Once broken, braces and locals are as if the author had broken them. What is around them may then stand
        // otherwise, and does so at once, so that the canonical text is its own canonical text.
        Piece::settle(run);
    }
}

struct Writer {
    out: String,
    /// Columns of the last line.
    column: usize,
    /// Whether nothing has been written on the last line.
    is_fresh: bool,
    /// Whether a comment had no place.
    has_lost: bool,
    /// Whether braces or locals were broken that had not been so before.
    has_broken: bool,
}

/// Where lines begin that go on: those of operators, and those inside of brackets, relative to these columns.
#[derive(Clone, Copy)]
struct Base {
    operators: usize,
    brackets: usize,
}

impl Base {
    fn at(column: usize) -> Self {
        Self {
            operators: column,
            brackets: column,
        }
    }
}

impl Writer {
    /// A statement, or an item of a list: an expression with its locals. `tail` columns must remain on its last line.
    fn item(&mut self, run: &[Piece<'_>], base: usize, tail: usize) {
        if self.fits(run, tail) {
            return self.flat(run);
        }
        let mut parts = split(run, |piece| piece.kind == TokenKind::Where).peekable();
        if let Some(body) = parts.next() {
            let tail = if parts.peek().is_none() { tail } else { 0 };
            self.definition(body, base, tail);
        }
        while let Some(part) = parts.next() {
            let tail = if parts.peek().is_none() { tail } else { 0 };
            self.locals(part, base, tail);
        }
    }

    /// `where a = …, b = …`
    fn locals(&mut self, part: &[Piece<'_>], base: usize, tail: usize) {
        let Some((word, locals)) = part.split_first() else {
            return;
        };
        if !word.must_break.get() && self.line_closes() && self.fits(part, tail) {
            return self.flat(part);
        }
        self.breaks_for_good(word);
        self.line(base + STEP, &word.notes);
        self.flat(std::slice::from_ref(word));
        let base = base + STEP + WHERE;
        let mut locals = locals.split(|piece| piece.kind == TokenKind::Comma);
        let mut next = locals.next();
        while let Some(local) = next {
            next = locals.next();
            self.definition(local, base, if next.is_some() { 1 } else { tail });
            if let Some(first) = next.and_then(<[Piece]>::first) {
                self.text(",");
                self.line(base, &first.notes);
            }
        }
    }

    /// `head = value`, `condition: value`, or an expression alone.
    fn definition(&mut self, run: &[Piece<'_>], base: usize, tail: usize) {
        let is_sign = |piece: &Piece| matches!(piece.kind, TokenKind::Equals | TokenKind::Colon);
        let sign = run.iter().position(is_sign).unwrap_or(run.len());
        let (head, value) = run.split_at(run.len().min(sign + 1));
        let Some(first) = value.first() else {
            return self.expression(run, 0, Base::at(base), tail);
        };
        if self.fits(run, tail) {
            return self.flat(run);
        }
        self.expression(head, 0, Base::at(base), 0);
        if !first.notes.is_empty() || self.is_better_below(value, base + STEP, tail) {
            self.line(base + STEP, &first.notes);
        }
        self.expression(value, 0, Base::at(base), tail);
    }

    /// Whether the first operand of a value has no place on this line, but on one that begins at `column`.
    fn is_better_below(&self, value: &[Piece<'_>], column: usize, tail: usize) -> bool {
        let breaks = |piece: &Piece<'_>| LEVELS.iter().any(|test| test(piece));
        let mut operands = split(value, breaks);
        let operand = operands.next().unwrap_or_default();
        let tail = if operands.next().is_some() { 0 } else { tail };
        let is_choice = operand.iter().any(|piece| piece.kind == TokenKind::LBrace);
        !is_choice
            && !operand.iter().any(Piece::breaks)
            && !self.fits(operand, tail)
            && column + width(operand) + tail <= WIDTH
    }

    /// An expression without locals, taken apart at operators of this level or tighter ones.
    fn expression(&mut self, run: &[Piece<'_>], level: usize, base: Base, tail: usize) {
        if self.fits(run, tail) {
            return self.flat(run);
        }
        if !self.hugs(run, tail) {
            for (index, test) in LEVELS.iter().enumerate().skip(level) {
                if split(run, test).nth(1).is_some() {
                    return self.operators(run, index, base, tail);
                }
            }
        }
        self.sequence(run, base.brackets, tail);
    }

    /// Operands, each but the first on a line of its own that begins with the operator.
    fn operators(&mut self, run: &[Piece<'_>], level: usize, base: Base, tail: usize) {
        let Some(test) = LEVELS.get(level) else {
            return;
        };
        let column = base.operators + STEP;
        let mut parts = split(run, test).peekable();
        let mut inner = Base {
            operators: column,
            brackets: base.brackets,
        };
        while let Some(part) = parts.next() {
            let tail = if parts.peek().is_none() { tail } else { 0 };
            self.expression(part, level + 1, inner, tail);
            if let Some(operator) = parts.peek().and_then(|part| part.first()) {
                self.line(column, &operator.notes);
            }
            inner = Base::at(column);
        }
    }

    /// Pieces one after another; brackets that do not fit are opened.
    fn sequence(&mut self, run: &[Piece<'_>], base: usize, tail: usize) {
        for (index, piece) in run.iter().enumerate() {
            let Some(group) = &piece.group else {
                self.flat(std::slice::from_ref(piece));
                continue;
            };
            // What stands behind it up to the next bracket has to fit, too.
            let rest = run.get(index + 1..).unwrap_or_default();
            let until = rest.iter().position(|piece| piece.group.is_some());
            let between = rest.get(..until.unwrap_or(rest.len())).unwrap_or_default();
            let behind = width(between) + if until.is_some() { 2 } else { tail };
            if self.fits(std::slice::from_ref(piece), behind) {
                self.flat(std::slice::from_ref(piece));
            } else {
                self.group(piece, group, base);
            }
        }
    }

    /// Brackets with one item a line; bars around an expression.
    fn group(&mut self, piece: &Piece<'_>, group: &Group<'_>, base: usize) {
        self.open(piece);
        if piece.kind == TokenKind::LBrace {
            self.breaks_for_good(piece);
        }
        if piece.kind == TokenKind::Bar {
            self.expression(&group.run, 0, Base::at(base), 1);
            return self.text(group.close);
        }
        let mut items = Items { rest: &group.run };
        let mut next = items.next();
        while let Some(item) = next {
            next = items.next();
            if let Some(first) = item.first() {
                self.line(base + STEP, &first.notes);
            }
            self.item(item, base + STEP, 1);
            if next.is_some() {
                self.text(",");
            }
        }
        self.notes(base + STEP, &group.notes);
        self.begin(base);
        self.text(group.close);
    }

    fn breaks_for_good(&mut self, piece: &Piece<'_>) {
        self.has_broken |= !piece.must_break.replace(true);
    }

    /// Whether these pieces fit on the rest of the line, with `tail` columns behind them.
    fn fits(&self, run: &[Piece<'_>], tail: usize) -> bool {
        let Some((first, others)) = run.split_first() else {
            return true;
        };
        let blank = usize::from(first.blank && !self.is_fresh);
        // The comments before the first of a line have been written.
        let has_notes = !first.notes.is_empty() && !self.is_fresh;
        !(first.must_break.get() || has_notes || others.iter().any(Piece::breaks))
            && self.column + blank + width(run) + tail <= WIDTH
    }

    /// Whether nothing but brackets has to be broken.
    fn hugs(&self, run: &[Piece<'_>], tail: usize) -> bool {
        let mut columns = self.column + tail;
        let mut has_open = false;
        for (index, piece) in run.iter().enumerate() {
            let opens = piece.must_break.get() && piece.group.is_some();
            if index > 0 && !piece.notes.is_empty() {
                return false;
            }
            has_open |= opens;
            columns += usize::from(piece.blank) + if opens { 2 } else { piece.width };
        }
        has_open && columns <= WIDTH
    }

    /// Whether the last line has nothing but the end of a bracket.
    fn line_closes(&self) -> bool {
        let line = self.out.rsplit('\n').next().unwrap_or("");
        line.trim_start() == "}"
    }

    /// Pieces on the rest of the line.
    fn flat(&mut self, run: &[Piece<'_>]) {
        for piece in run {
            self.open(piece);
            let Some(group) = &piece.group else {
                continue;
            };
            let pad = if group.is_padded() { " " } else { "" };
            self.text(pad);
            self.flat(&group.run);
            self.text(pad);
            self.text(group.close);
        }
    }

    /// The token of a piece, or its opening bracket.
    fn open(&mut self, piece: &Piece<'_>) {
        self.has_lost |= !piece.notes.is_empty() && !self.is_fresh;
        if piece.blank && !self.is_fresh {
            self.text(" ");
        }
        self.text(piece.text);
    }

    fn text(&mut self, text: &str) {
        self.out.push_str(text);
        self.column += text.chars().count();
        self.is_fresh &= text.is_empty();
    }

    /// Begins a line, after the comments that stand before what it begins with.
    fn line(&mut self, column: usize, notes: &[Note<'_>]) {
        self.notes(column, notes);
        self.begin(column);
    }

    /// Comments: behind what they are about, or each on a line of its own.
    fn notes(&mut self, column: usize, notes: &[Note<'_>]) {
        for note in notes {
            if note.is_behind && !self.is_fresh {
                self.out.push_str("  ");
            } else {
                self.begin(column);
            }
            self.out.push_str(&super::tidy(note.text));
            self.is_fresh = false;
        }
    }

    fn begin(&mut self, column: usize) {
        let column = column.min(MAX_INDENT);
        self.out.push('\n');
        self.out.extend(std::iter::repeat_n(' ', column));
        self.column = column;
        self.is_fresh = true;
    }
}

/// The run cut before each piece that passes the test, except before the first.
fn split<'r, 'a>(
    run: &'r [Piece<'a>],
    test: impl Fn(&Piece<'a>) -> bool,
) -> impl Iterator<Item = &'r [Piece<'a>]> {
    let mut rest = run;
    std::iter::from_fn(move || {
        let (_, others) = rest.split_first()?;
        let at = others.iter().position(&test);
        let (part, remaining) = rest.split_at(at.map_or(rest.len(), |at| at + 1));
        rest = remaining;
        Some(part)
    })
}

/// The items of a list. A comma before another local of a `where` does not end an item.
struct Items<'r, 'a> {
    rest: &'r [Piece<'a>],
}

impl<'r, 'a> Iterator for Items<'r, 'a> {
    type Item = &'r [Piece<'a>];

    fn next(&mut self) -> Option<Self::Item> {
        self.rest.first()?;
        let mut has_where = false;
        let end = self.rest.iter().enumerate().position(|(at, piece)| {
            match piece.kind {
                TokenKind::Where => has_where = true,
                TokenKind::Colon | TokenKind::Until => has_where = false,
                _ => {}
            }
            let behind = self.rest.get(at + 1..).unwrap_or_default();
            piece.kind == TokenKind::Comma && !(has_where && begins_local(behind))
        });
        let (item, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = rest.get(1..).unwrap_or_default();
        Some(item)
    }
}

/// Whether `name =` or `name.xy =` stands here.
fn begins_local(run: &[Piece<'_>]) -> bool {
    use TokenKind::{Dot, Equals, Name};
    let kind = |at: usize| run.get(at).map(|piece| piece.kind);
    let sign = if kind(1) == Some(Dot) { 3 } else { 1 };
    kind(0) == Some(Name) && kind(sign) == Some(Equals)
}
