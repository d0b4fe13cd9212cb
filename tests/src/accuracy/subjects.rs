//! The functions of the language that have tables, and the formulas of programs.

use pullback_compiler::formula::Formula;
pub use pullback_runtime::accuracy::subjects::Subject;

/// Every operation of the table that can be asked about by itself.
///
/// # Panics
/// A table of references is malformed.
#[must_use]
pub fn subjects() -> Vec<Subject> {
    pullback_runtime::accuracy::subjects::subjects().expect("tables")
}

/// The one formula of a program.
///
/// # Panics
/// The text does not compile.
#[must_use]
pub fn formula(source: &str) -> Formula {
    pullback_runtime::accuracy::subjects::formula(source).expect("a program")
}
