//! Source text to canonical text, with its comments.

use crate::Span;
use crate::parse::parse;
use crate::printer::print_item;
use crate::token::comments;

/// The canonical text of a file with its comments and single blank lines; nothing where the file has errors.
///
/// A statement with a comment inside is kept as it was written.
#[must_use]
pub fn format(text: &str, is_function: &dyn Fn(&str) -> bool) -> Option<String> {
    let parsed = parse(text, is_function);
    if parsed.has_errors() {
        return None;
    }
    let comments = comments(text);
    let mut comments = comments.iter().peekable();
    let mut page = Page {
        text,
        out: String::new(),
        read: 0,
        statement: None,
    };
    for item in &parsed.file.items {
        let span = item.span();
        while let Some(comment) = comments.next_if(|comment| comment.start < span.start) {
            page.comment(*comment);
        }
        let mut is_commented = false;
        while comments
            .next_if(|comment| comment.start < span.end)
            .is_some()
        {
            is_commented = true;
        }
        let line = if is_commented {
            span.text(text).to_owned()
        } else {
            print_item(&parsed.file.exprs, item)
        };
        page.statement(&line, span);
    }
    comments.for_each(|comment| page.comment(*comment));
    if !page.out.is_empty() {
        page.out.push('\n');
    }
    Some(page.out)
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
    /// Writes a statement on a line of its own.
    fn statement(&mut self, line: &str, span: Span) {
        if line.starts_with(['-', '−'])
            && let Some(end) = self.statement
        {
            // Else the line would go on with the statement before.
            self.out.insert(end, ';');
        }
        self.begin_line(span);
        self.out.push_str(line);
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
        self.out.push_str(comment.text(self.text).trim_end());
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
        let gap = self.text.get(self.read..next.start as usize);
        gap.unwrap_or("").matches('\n').count()
    }
}
