//! What is told to people, on the standard error.

use std::io::{self, Write};

use pullback_grammar::Diagnostic;

/// How to talk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Console {
    /// Whether to colour diagnostics.
    pub(crate) color: bool,
    /// Whether to show progress bars.
    pub(crate) progress: bool,
    /// Whether to keep notes to oneself.
    pub(crate) quiet: bool,
}

impl Console {
    /// Something worth knowing.
    pub(crate) fn note(&self, text: &str) {
        if !self.quiet {
            line(text);
        }
    }

    /// Something that may not be as intended.
    pub(crate) fn warning(&self, text: &str) {
        line(&format!("{} {text}", self.paint("warning:", "33")));
    }

    /// Something that prevented the work.
    pub(crate) fn error(&self, text: &str) {
        line(&format!("{} {text}", self.paint("error:", "31")));
    }

    /// What to do about it.
    pub(crate) fn hint(&self, text: &str) {
        line(&format!("{} {text}", self.paint("hint:", "36")));
    }

    /// The compiler's findings.
    pub(crate) fn diagnostics(&self, diagnostics: &[Diagnostic], name: &str, source: &str) {
        if !diagnostics.is_empty() {
            let text = pullback_grammar::render(diagnostics, name, source, self.color);
            line(text.trim_end_matches('\n'));
        }
    }

    fn paint(&self, word: &str, color: &str) -> String {
        if self.color {
            format!("\x1b[1;{color}m{word}\x1b[0m")
        } else {
            word.to_owned()
        }
    }
}

/// Writes a line to the standard error; if that is closed, nobody wants to know.
fn line(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}
