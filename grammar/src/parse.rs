//! Text to syntax tree.

use crate::ast::{File, MAX_SOURCE_BYTES};
use crate::cursor::Parser;
use crate::diagnostic::limit;
use crate::layout::{Layout, layout};
use crate::paste::translate;
use crate::scope::Scope;
use crate::stray::join_pairs;
use crate::token::{Token, tokenize};
use crate::{Diagnostic, Span};

/// A syntax tree and every problem of its text.
#[derive(Clone, Debug, Default)]
pub struct Parsed {
    /// The tree; [`Expr::Error`](crate::ast::Expr::Error) stands where the text could not be read.
    pub file: File,
    /// The problems, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
}

impl Parsed {
    /// Whether the text has no meaning as it is.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }
}

/// Reads a file. `is_function` says which names are builtin functions; those that the file defines are found here.
///
/// Never fails: what cannot be read is left out of the tree and reported. Time and memory are linear in the length.
///
/// ```
/// let parsed = pullback_grammar::parse("2x sin(x) + (y", &|name| name == "sin");
/// assert_eq!(parsed.diagnostics[0].code, "missing-closing");
/// assert_eq!(pullback_grammar::print(&parsed.file), "2 x sin(x) + y\n");
/// ```
#[must_use]
pub fn parse(text: &str, is_function: &dyn Fn(&str) -> bool) -> Parsed {
    read(text, is_function).parsed
}

/// A syntax tree with the tokens that it was read from.
#[derive(Default)]
pub(crate) struct Reading {
    pub(crate) parsed: Parsed,
    /// The tokens in this language.
    pub(crate) tokens: Vec<Token>,
    pub(crate) layout: Layout,
    /// What was written in another notation, in the order of the text.
    pub(crate) foreign: Vec<Span>,
}

/// Reads a file and keeps its tokens.
pub(crate) fn read(text: &str, is_function: &dyn Fn(&str) -> bool) -> Reading {
    if text.len() > MAX_SOURCE_BYTES {
        return Reading {
            parsed: too_large(text.len()),
            ..Reading::default()
        };
    }
    let (tokens, mut diagnostics) = tokenize(text);
    let mut pasted = translate(text, tokens);
    diagnostics.append(&mut pasted.diagnostics);
    let tokens = pasted.tokens;
    let layout = layout(&tokens);
    if layout.statements.is_empty() && diagnostics.is_empty() {
        diagnostics.push(
            Diagnostic::error("empty-source", Span::default(), "there is no formula")
                .with_label("nothing but blanks and comments")
                .with_hint("write a formula, such as `x^2 + y^2 - 1`"),
        );
    }
    let scope = Scope::new(is_function);
    let mut parser = Parser::new(text, &tokens, &pasted.spellings, &layout, scope);
    parser.collect_definitions();
    let items = parser.file();
    diagnostics.append(&mut parser.diagnostics);
    diagnostics.sort_by_key(|diagnostic| diagnostic.span.start);
    join_pairs(text, &mut diagnostics);
    limit(&mut diagnostics);
    let mut foreign = pasted.foreign;
    foreign.append(&mut parser.foreign);
    foreign.sort_unstable();
    let file = File {
        items,
        exprs: parser.exprs,
    };
    Reading {
        parsed: Parsed { file, diagnostics },
        tokens,
        layout,
        foreign,
    }
}

/// Reads a file that may not be text.
///
/// The place of a complaint about bytes that are not UTF-8 is the empty span at the first of them.
#[must_use]
pub fn parse_bytes(bytes: &[u8], is_function: &dyn Fn(&str) -> bool) -> Parsed {
    if bytes.len() > MAX_SOURCE_BYTES {
        return too_large(bytes.len());
    }
    let error = match std::str::from_utf8(bytes) {
        Ok(text) => return parse(text, is_function),
        Err(error) => error,
    };
    let at = error.valid_up_to();
    let offset = u32::try_from(at).unwrap_or(u32::MAX);
    let hint = if matches!(bytes, [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..]) {
        "the file begins as UTF-16 does; save it as UTF-8"
    } else {
        "save the file as UTF-8"
    };
    let value = bytes.get(at).copied().unwrap_or(0);
    only(
        Diagnostic::error(
            "not-utf8",
            Span::new(offset, offset),
            format!("the file is not UTF-8: byte {value:#04x} at offset {at}"),
        )
        .with_hint(hint),
    )
}

/// A file that is refused unread.
fn too_large(length: usize) -> Parsed {
    let message = format!("the file has {length} bytes");
    only(
        Diagnostic::error("source-too-large", Span::default(), message)
            .with_label(format!("at most {MAX_SOURCE_BYTES} bytes are read"))
            .with_hint("split it, or give a smaller file"),
    )
}

/// No tree and one problem.
fn only(diagnostic: Diagnostic) -> Parsed {
    Parsed {
        diagnostics: vec![diagnostic],
        ..Parsed::default()
    }
}
