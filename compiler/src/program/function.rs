//! The formula of a program that need not be drawn.

use pullback_grammar::ast::{Function, Item};
use pullback_grammar::diagnostic::limit;
use pullback_grammar::{Diagnostic, Span};

use super::checker::{Checker, Subject};
use super::subject::declared;
use crate::check::{Symbols, check_names, is_builtin_function};
use crate::formula::Formula;
use crate::types::Type;

/// The function of a program for rows of numbers: that named `f`, or else the last. It may have any inputs, also such as
/// no scene shows; an input without a type is real.
///
/// # Errors
/// The program is wrong, or has no function; its diagnostics.
pub fn compile_function(source: &str) -> Result<Formula, Vec<Diagnostic>> {
    let parsed = pullback_grammar::parse(source, &is_builtin_function);
    let mut diagnostics = parsed.diagnostics;
    let symbols = Symbols::collect(&parsed.file, &mut diagnostics);
    check_names(&parsed.file, &symbols, &mut diagnostics);
    let mut checker = Checker::new(&parsed.file, &symbols, diagnostics);
    checker.params();
    let formula = checker.function_formula();
    let mut diagnostics = checker.diagnostics;
    limit(&mut diagnostics);
    match formula {
        Some(formula) if !diagnostics.iter().any(Diagnostic::is_error) => Ok(formula),
        _ => Err(diagnostics),
    }
}

impl<'a> Checker<'a> {
    fn function_formula(&mut self) -> Option<Formula> {
        let Some(function) = self.default_function() else {
            self.diagnostics.push(
                Diagnostic::error("no-function", Span::default(), "there is no function")
                    .with_hint("write one, such as `f(a, b) = a + b`"),
            );
            return None;
        };
        let inputs = declared(function);
        let real = |(_, ty): &(&str, Option<Type>)| ty.unwrap_or(Type::Real);
        let types = inputs.iter().map(real).collect();
        let subject = Subject::Function(function);
        self.formula_of(subject, &inputs, types, function.name.span)
    }

    /// The function named `f`, or else the last one.
    pub(super) fn default_function(&self) -> Option<&'a Function> {
        let last = || {
            self.file.items.iter().rev().find_map(|item| match item {
                Item::Function(function) => Some(function),
                _ => None,
            })
        };
        self.symbols.functions.get("f").copied().or_else(last)
    }
}
