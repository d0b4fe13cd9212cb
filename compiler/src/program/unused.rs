//! Functions that nothing shows or calls: they are checked all the same.

use super::checker::Checker;
use super::subject::declared;
use crate::check::Builder;
use crate::formula::{argument_value, scalar_types};
use crate::types::Type;
use pullback_grammar::Diagnostic;
use pullback_grammar::ast::{Function, Item};

/// Types that are tried for the parameters of a function that nothing calls.
const GENERIC: [Type; 5] = [
    Type::Real,
    Type::Complex,
    Type::Vector(2),
    Type::Vector(3),
    Type::Vector(4),
];

/// Greatest number of times that functions which nothing uses are built, all together; what is beyond is not checked.
pub const MAX_UNUSED: usize = 2000;

impl<'a> Checker<'a> {
    /// Checks functions that nothing calls. Where parameters have no fixed type, types are looked for with which
    /// the function makes sense; if there are none, what is wrong with it for reals is reported.
    pub(super) fn unused_functions(&mut self) {
        let mut attempts = MAX_UNUSED;
        let functions = self.file.items.iter().filter_map(|item| match item {
            Item::Function(function) => Some(function),
            _ => None,
        });
        for function in functions {
            let is_current = self
                .symbols
                .functions
                .get(function.name.text.as_str())
                .is_some_and(|f| std::ptr::eq(*f, function));
            if is_current
                && !self.called.contains(function.name.text.as_str())
                && !self.has_error_in(function.span)
            {
                self.unused_function(function, &mut attempts);
            }
        }
    }

    pub(super) fn unused_function(&mut self, function: &'a Function, attempts: &mut usize) {
        let declared = declared(function);
        let is_plain_z = matches!(declared.as_slice(), [("z", None)]);
        let fixed: Vec<Option<Type>> = declared
            .iter()
            .map(|d| d.1.or(is_plain_z.then_some(Type::Complex)))
            .collect();
        let open = fixed.iter().filter(|t| t.is_none()).count();
        if open > 2 {
            return;
        }
        let mut of_reals = None;
        for first in GENERIC {
            for second in GENERIC {
                if *attempts == 0 {
                    return;
                }
                *attempts -= 1;
                let mut choices = [first, second].into_iter();
                let types: Vec<Type> = fixed
                    .iter()
                    .map(|t| t.or_else(|| choices.next()).unwrap_or(first))
                    .collect();
                let mut builder = self.attempt(function, &types);
                // a large function counts as many
                *attempts = attempts.saturating_sub(builder.graph.nodes().len() / 200);
                let spent = usize::try_from(builder.spent() / 2000).unwrap_or(usize::MAX);
                *attempts = attempts.saturating_sub(spent);
                if builder.graph.budget().is_err() {
                    return;
                }
                if !builder.diagnostics.iter().any(Diagnostic::is_error) {
                    if open > 0 {
                        // a warning may be due to the types that were tried
                        builder.diagnostics.clear();
                    }
                    self.finish(&mut builder);
                    return;
                }
                let found = std::mem::take(&mut builder.diagnostics);
                self.called.extend(builder.called());
                of_reals.get_or_insert(found);
                if open < 2 {
                    break;
                }
            }
            if open == 0 {
                break;
            }
        }
        let found = of_reals.unwrap_or_default();
        let too_deep = |d: &Diagnostic| d.code == "too-deep";
        if !(found.iter().any(too_deep) && self.diagnostics.iter().any(too_deep)) {
            self.diagnostics.extend(found);
        }
    }

    pub(super) fn attempt(&self, function: &'a Function, types: &[Type]) -> Builder<'a> {
        let mut builder = self.builder();
        let mut values = Vec::new();
        let mut first = 0;
        for &ty in types {
            values.push(argument_value(&mut builder.graph, first, ty));
            first += scalar_types(ty).len();
        }
        builder.call_function(function, values, &[], function.name.span);
        builder
    }
}
