//! The formula language as text: tokens, syntax tree, spans, diagnostics and their rendering, and the printer.
//!
//! This crate knows nothing of types, shaders or files. [`parse`] never fails: it returns a tree and every
//! diagnostic.

// A library neither prints nor gives up; tests may.
#![cfg_attr(
    not(test),
    warn(
        clippy::expect_used,
        clippy::panic,
        clippy::print_stderr,
        clippy::print_stdout,
        clippy::unreachable,
        clippy::unwrap_used
    )
)]

pub mod ast;
pub mod diagnostic;
pub mod span;
pub mod token;

mod build;
mod complaint;
mod cursor;
mod format;
mod layout;
mod parse;
mod parser;
mod paste;
mod piece;
mod printer;
mod render;
mod same;
mod scope;
mod stray;

pub use diagnostic::{Diagnostic, Severity};
pub use format::format;
pub use parse::{Parsed, parse, parse_bytes};
pub use printer::{print, print_expr, print_item};
pub use render::render;
pub use same::same_tree;
pub use span::Span;
