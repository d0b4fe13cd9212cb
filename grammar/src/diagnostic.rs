//! Problems found in a program: what, where, why, and what to do about it.

use crate::Span;

/// How serious a [`Diagnostic`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Severity {
    /// The program has no meaning until this is mended.
    Error,
    /// The program has a meaning, perhaps not the intended one.
    Warning,
}

/// One problem, as data. Messages are short, lower case, without a full stop; advice is the hint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Error or warning.
    pub severity: Severity,
    /// A stable kebab-case identifier of the kind of problem, such as `unknown-name`.
    pub code: &'static str,
    /// What is wrong.
    pub message: String,
    /// Where.
    pub span: Span,
    /// Why, written at the place; may be empty.
    pub label: String,
    /// Other places that matter, each with its remark.
    pub related: Vec<(Span, String)>,
    /// What to do.
    pub hint: Option<String>,
}

impl Diagnostic {
    /// An error with no label, no related places and no hint.
    #[must_use]
    pub fn error(code: &'static str, span: Span, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Error,
            code,
            message: bounded(message.into()),
            span,
            label: String::new(),
            related: Vec::new(),
            hint: None,
        }
    }

    /// A warning with no label, no related places and no hint.
    #[must_use]
    pub fn warning(code: &'static str, span: Span, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Warning,
            ..Self::error(code, span, message)
        }
    }

    /// Adds the reason that is written at the place.
    #[must_use]
    pub fn with_label(mut self, label: impl Into<String>) -> Self {
        self.label = bounded(label.into());
        self
    }

    /// Adds the advice.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(bounded(hint.into()));
        self
    }

    /// Adds another place that matters.
    #[must_use]
    pub fn with_related(mut self, span: Span, remark: impl Into<String>) -> Self {
        self.related.push((span, bounded(remark.into())));
        self
    }

    /// Whether this is an error.
    #[must_use]
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

/// Most characters of a message, label, hint or remark.
pub const MAX_TEXT: usize = 300;

/// A text in one line, cut where it is too long. Whoever quotes from a program cuts what he quotes; this is for what
/// many such quotations add up to.
fn bounded(text: String) -> String {
    let is_short = text.len() <= MAX_TEXT || text.chars().nth(MAX_TEXT).is_none();
    if is_short && !text.contains(char::is_control) {
        return text;
    }
    let shown = text
        .chars()
        .take(if is_short { MAX_TEXT } else { MAX_TEXT - 1 });
    let mut out: String = shown
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    if !is_short {
        out.push('…');
    }
    out
}

/// Most errors, and most warnings, that are reported for one file.
pub const MAX_DIAGNOSTICS: usize = 200;

/// Code of the last diagnostic where there are too many.
const TOO_MANY: &str = "too-many-problems";

/// Keeps the first errors and the first warnings, and says at the end where there are more.
pub fn limit(diagnostics: &mut Vec<Diagnostic>) {
    let before: Vec<Diagnostic> = diagnostics.extract_if(.., |d| d.code == TOO_MANY).collect();
    for (severity, noun) in [(Severity::Error, "errors"), (Severity::Warning, "warnings")] {
        let of_kind = |d: &Diagnostic| d.severity == severity && d.code != TOO_MANY;
        if diagnostics.iter().filter(|d| of_kind(d)).count() <= MAX_DIAGNOSTICS {
            diagnostics.extend(before.iter().filter(|d| d.severity == severity).cloned());
            continue;
        }
        let mut kept = 0;
        let mut last = Span::default();
        diagnostics.retain(|diagnostic| {
            if diagnostic.severity != severity {
                return true;
            }
            if !of_kind(diagnostic) || kept == MAX_DIAGNOSTICS {
                return false;
            }
            kept += 1;
            last = diagnostic.span;
            true
        });
        let message = format!("there are more than {MAX_DIAGNOSTICS} {noun}");
        let mut summary = Diagnostic::error(TOO_MANY, last, message)
            .with_label("the last one that is listed")
            .with_hint("mend the first ones, and look again");
        summary.severity = severity;
        diagnostics.push(summary);
    }
}

#[cfg(test)]
mod tests {
    use super::{Diagnostic, MAX_TEXT};
    use crate::Span;

    #[test]
    fn texts_are_lines_of_bounded_length() {
        let length = |text: &str| text.chars().count();
        let long = "`α`, ".repeat(MAX_TEXT);
        let found = Diagnostic::error("code", Span::default(), long.as_str())
            .with_label("a\nb\u{7}c")
            .with_hint("é".repeat(MAX_TEXT))
            .with_related(Span::default(), "é".repeat(MAX_TEXT + 1));
        assert_eq!(length(&found.message), MAX_TEXT);
        assert!(found.message.ends_with('…') && long.starts_with(&found.message[..MAX_TEXT]));
        assert_eq!(found.label, "a b c");
        assert_eq!(found.hint, Some("é".repeat(MAX_TEXT)));
        assert_eq!(length(&found.related[0].1), MAX_TEXT);
    }
}
