//! Functions of the language that are written in the language itself.

use std::sync::OnceLock;

use pullback_grammar::ast::{File, Function, Item};
use rustc_hash::FxHashMap;

use super::builtins;
use crate::table;

/// A function of `library.pull`.
#[derive(Debug)]
pub struct LibraryFunction {
    /// Its name.
    pub name: &'static str,
    /// One line: the comment above its definition.
    pub doc: &'static str,
    /// How it is written.
    pub usage: &'static str,
    /// Its definition as text.
    pub definition: &'static str,
    /// Its definition in [`file`].
    pub function: &'static Function,
}

const SOURCE: &str = include_str!("library.pull");

/// The parsed library.
pub fn file() -> &'static File {
    static FILE: OnceLock<File> = OnceLock::new();
    FILE.get_or_init(|| {
        let known =
            |name: &str| table::by_name(name).is_some() || builtins::by_name(name).is_some();
        pullback_grammar::parse(SOURCE, &known).file
    })
}

/// Every function of the library, in the order of its text. Vector arguments are taken by components where the
/// definition does not say `vec`.
pub fn library_functions() -> &'static [LibraryFunction] {
    static FUNCTIONS: OnceLock<Vec<LibraryFunction>> = OnceLock::new();
    FUNCTIONS.get_or_init(|| {
        let mut functions = Vec::new();
        for item in &file().items {
            let Item::Function(function) = item else {
                continue;
            };
            let definition = function.span.text(SOURCE);
            let usage = definition.split('=').next().unwrap_or("").trim();
            let before = SOURCE.get(..function.span.start as usize).unwrap_or("");
            let comment = before.trim_end().lines().last().unwrap_or("");
            functions.push(LibraryFunction {
                name: &function.name.text,
                doc: comment.trim_start_matches('/').trim(),
                usage,
                definition,
                function,
            });
        }
        functions
    })
}

/// The library function of this name.
pub fn by_name(name: &str) -> Option<&'static LibraryFunction> {
    static INDEX: OnceLock<FxHashMap<&'static str, &'static LibraryFunction>> = OnceLock::new();
    let index = INDEX.get_or_init(|| library_functions().iter().map(|f| (f.name, f)).collect());
    index.get(name).copied()
}
