//! What is said about other notations.

use super::Translator;
use crate::diagnostic::MAX_DIAGNOSTICS;
use crate::stray::{complaint, shorten, stands_for};
use crate::token::{Token, TokenKind};
use crate::{Diagnostic, Span};

impl Translator<'_> {
    pub(super) fn complain(
        &mut self,
        code: &'static str,
        span: Span,
        message: impl Into<String>,
        label: &str,
        hint: impl Into<String>,
    ) {
        self.report(
            Diagnostic::error(code, span, message)
                .with_label(label)
                .with_hint(hint),
        );
    }

    /// Adds an error, unless the statement is too deep anyway; what is not listed is not kept.
    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        if !self.has_given_up && self.diagnostics.len() <= MAX_DIAGNOSTICS {
            self.diagnostics.push(diagnostic);
        }
    }

    /// A sign of another notation in a place where it means nothing.
    pub(super) fn stray(&mut self) {
        let span = self.bump();
        if let Some(culprit) = span.text(self.text).chars().next() {
            self.report(complaint(culprit, span));
            self.emit(stands_for(culprit), span);
        }
    }

    /// A remark about a habit, once for a file.
    pub(super) fn warn_once(
        &mut self,
        code: &'static str,
        span: Span,
        message: &str,
        label: &str,
        hint: &str,
    ) {
        if self.warned.insert(code) {
            self.diagnostics.push(
                Diagnostic::warning(code, span, message)
                    .with_label(label)
                    .with_hint(hint),
            );
        }
    }

    /// A command that has no meaning, here or anywhere.
    pub(super) fn complain_command(&mut self, span: Span, hint: &str) {
        let shown = shorten(span.text(self.text));
        let message = format!("`{shown}` has no meaning here");
        self.complain("unknown-command", span, message, "a command of LaTeX", hint);
    }

    /// What is left of a word, or was put together, is not one: `a1b` behind `\frac` is a and 1b.
    pub(super) fn complain_no_name(&mut self, span: Span, word: &str) {
        let shown = shorten(word);
        self.complain(
            "unclear-argument",
            span,
            format!("`{shown}` is no name"),
            "a name begins with a letter",
            "write braces around each argument, and a sign or blank between factors",
        );
    }

    /// A command such as `\frac` without what it is applied to.
    pub(super) fn complain_no_argument(&mut self, span: Span) {
        let is_consequence = self.diagnostics.last().is_some_and(|last| {
            last.code == "missing-closing" && last.span.start >= self.last_span().end
        });
        if is_consequence {
            return;
        }
        let shown = shorten(span.text(self.text));
        self.complain(
            "missing-argument",
            span,
            format!("`{shown}` lacks an argument"),
            "expected `{…}` behind it",
            format!("write `{shown}{{…}}` with all its arguments"),
        );
    }

    /// A group of LaTeX that no `}` ends.
    pub(super) fn complain_open_group(&mut self, opening: Span, close: &str) {
        let here = self.last_span().end;
        let message = format!("missing `{close}`");
        let opened = format!("`{}` opened here", shorten(opening.text(self.text)));
        self.report(
            Diagnostic::error("missing-closing", Span::new(here, here), message)
                .with_label(format!("expected `{close}`"))
                .with_related(opening, opened)
                .with_hint(format!("add `{close}`")),
        );
    }

    /// Tokens of the output as text of this language, short.
    pub(super) fn shown(&self, tokens: &[Token]) -> String {
        use TokenKind::{
            Bang, Caret, Comma, Dot, DotDot, LParen, Name, Number, RParen, Superscript,
        };
        // The spelling is looked up here and not in a sorted table: only a few of the latest are asked for.
        const LIMIT: usize = 24;
        let mut out = String::new();
        let mut before = LParen;
        for (index, token) in tokens.iter().enumerate() {
            if index == LIMIT {
                out.push('…');
                break;
            }
            let tight = matches!(before, LParen | Caret | Dot | DotDot)
                || matches!(
                    token.kind,
                    RParen | Caret | Dot | DotDot | Comma | Bang | Superscript
                )
                || (before == Name && token.kind == LParen)
                || (before == Number && matches!(token.kind, Name | LParen));
            if !tight {
                out.push(' ');
            }
            let recent = self.spellings.iter().rev().take(4 * LIMIT);
            let spelling = recent
                .filter(|_| matches!(token.kind, Name | Number))
                .find(|entry| entry.0 == token.span);
            out.push_str(match (spelling, sign(token.kind)) {
                (Some(entry), _) => &entry.1,
                (None, Some(sign)) => sign,
                (None, None) => token.span.text(self.text),
            });
            before = token.kind;
        }
        shorten(&out)
    }
}

/// How a sign is written here.
fn sign(kind: TokenKind) -> Option<&'static str> {
    Some(match kind {
        TokenKind::LParen => "(",
        TokenKind::RParen => ")",
        TokenKind::LBrace => "{",
        TokenKind::RBrace => "}",
        TokenKind::Plus => "+",
        TokenKind::Minus => "-",
        TokenKind::Star => "*",
        TokenKind::Slash => "/",
        TokenKind::Caret => "^",
        TokenKind::Comma => ",",
        TokenKind::DotDot => "..",
        TokenKind::In => "in",
        TokenKind::If => "if",
        TokenKind::Then => "then",
        TokenKind::Else => "else",
        TokenKind::Bar => "|",
        TokenKind::LessEqual => "<=",
        TokenKind::GreaterEqual => ">=",
        TokenKind::NotEqual => "!=",
        TokenKind::And => "and",
        TokenKind::Or => "or",
        TokenKind::Not => "not",
        TokenKind::Prime => "'",
        _ => return None,
    })
}
