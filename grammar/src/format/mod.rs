//! Source text to canonical text, with its comments.
//!
//! Tokens stay as they are written (`x²` or `x^2`, `≤` or `<=`, brackets for the reader): what is set is the blanks
//! between them and where lines end. A statement with something in another notation is written anew.

mod blanks;
mod foreign;
mod lines;
mod pieces;

use crate::Span;
use crate::parse::{Reading, read};
use crate::printer::print_item_of;
use crate::token::{TokenKind, comments};
use foreign::Foreign;
use pieces::{Roles, Source};

/// The canonical text of a file with its comments and single blank lines; nothing where the file has errors.
///
/// Each statement begins a line. One that is longer than 100 columns is broken: each local of a `where`, each term of
/// a sum, each item of a list begins a line. A line break that the author has set before `where`, or behind the `{` of
/// choices or settings, stays. A statement with a comment where no line can end is kept as it was written; the
/// comments of one in another notation come before it.
///
/// ```
/// let text = "f( x,y )=2x^2+y ;show levels(f){height=4,}";
/// let formatted = pullback_grammar::format(text, &|_| false);
/// assert_eq!(formatted.as_deref(), Some("f(x, y) = 2x^2 + y\nshow levels(f) { height = 4 }\n"));
/// ```
#[must_use]
pub fn format(text: &str, is_function: &dyn Fn(&str) -> bool) -> Option<String> {
    let reading = read(text, is_function);
    if reading.parsed.has_errors() {
        return None;
    }
    if reading.foreign.is_empty() {
        return Some(write(text, &reading));
    }
    // What is written anew is read again with the whole file around it: its definitions say what calls are.
    let ours = write(text, &reading);
    let reading = read(&ours, is_function);
    if reading.parsed.has_errors() {
        // it has grown beyond what is read
        return Some(ours);
    }
    Some(write(&ours, &reading))
}

/// The canonical text of what has been read. A statement in another notation is written anew, on one line.
fn write(text: &str, reading: &Reading) -> String {
    let source = Source {
        text,
        roles: Roles::of(&reading.parsed.file.exprs),
    };
    let mut foreign = Foreign::new(text, &reading.foreign);
    let comments = comments(text);
    let mut rest = comments.as_slice();
    let mut page = Page {
        text,
        out: String::new(),
        read: 0,
        statement: None,
    };
    let statements = &reading.layout.statements;
    let items = &reading.parsed.file.items;
    for (index, (statement, item)) in statements.iter().zip(items).enumerate() {
        let tokens = reading.tokens.get(statement.start..statement.end);
        let tokens = tokens.unwrap_or_default();
        let Some(first) = tokens.first() else {
            continue;
        };
        let next = statements.get(index + 1).and_then(|next| {
            let token = reading.tokens.get(next.start);
            token.map(|token| token.span.start)
        });
        let spans = tokens.iter().map(|token| token.span);
        let own = spans.reduce(Span::join).unwrap_or_default();
        let converted = foreign.extent(own, next.unwrap_or(u32::MAX));
        let span = converted.unwrap_or(own);
        let before = rest.partition_point(|comment| comment.start < span.start);
        let (outside, others) = rest.split_at(before);
        outside.iter().for_each(|comment| page.comment(*comment));
        let (inside, others) =
            others.split_at(others.partition_point(|comment| comment.start < span.end));
        rest = others;
        if converted.is_some() {
            inside
                .iter()
                .for_each(|comment| page.comment_alone(*comment));
            let lines = print_item_of(text, &reading.parsed.file.exprs, item);
            let has_sign = lines.starts_with(['-', '+']);
            page.statement(&lines, span, has_sign);
            continue;
        }
        let pieces = source.pieces(tokens, statement.kind, inside);
        let lines = pieces.and_then(|pieces| lines::lines(&pieces));
        let has_sign = matches!(first.kind, TokenKind::Minus | TokenKind::Plus);
        page.statement(
            &lines.unwrap_or_else(|| tidy(span.text(text))),
            span,
            has_sign,
        );
    }
    rest.iter().for_each(|comment| page.comment(*comment));
    if !page.out.is_empty() {
        page.out.push('\n');
    }
    page.out
}

/// The lines of a text without blanks at their ends.
fn tidy(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    lines.join("\n")
}

/// What has been written, and up to where the text has been read.
struct Page<'a> {
    text: &'a str,
    out: String,
    read: usize,
    /// End of the last statement in `out`.
    statement: Option<usize>,
}

impl Page<'_> {
    /// Writes a statement on lines of its own.
    fn statement(&mut self, lines: &str, span: Span, has_sign: bool) {
        if has_sign && let Some(end) = self.statement {
            // Else the line would go on with the statement before.
            self.out.insert(end, ';');
        }
        self.begin_line(span);
        self.out.push_str(lines);
        self.read = span.end as usize;
        self.statement = Some(self.out.len());
    }

    /// Writes a comment: behind a statement that it shares the line with, else on a line of its own.
    fn comment(&mut self, comment: Span) {
        if self.breaks_before(comment) == 0 && !self.out.is_empty() {
            self.out.push_str("  ");
        } else {
            self.begin_line(comment);
        }
        self.out.push_str(&tidy(comment.text(self.text)));
        self.read = comment.end as usize;
    }

    /// Writes a comment on a line of its own.
    fn comment_alone(&mut self, comment: Span) {
        self.begin_line(comment);
        self.out.push_str(&tidy(comment.text(self.text)));
        self.read = comment.end as usize;
    }

    /// Ends the line before, with a blank line where the text has one.
    fn begin_line(&mut self, next: Span) {
        if !self.out.is_empty() {
            let blank = self.breaks_before(next) > 1;
            self.out.push_str(if blank { "\n\n" } else { "\n" });
        }
    }

    /// Number of line breaks between what has been read and `next`.
    fn breaks_before(&self, next: Span) -> usize {
        let gap = self.text.get(self.read..next.start as usize).unwrap_or("");
        gap.replace("\r\n", "\n").matches(['\n', '\r']).count()
    }
}
