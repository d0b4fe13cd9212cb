//! Integrals: their types.

use pullback_grammar::ast::{ExprId, Range};
use pullback_grammar::{Diagnostic, Span};

use crate::check::{Builder, Value};
use crate::ir::Ty;
use crate::types::Type;

impl<'a> Builder<'a> {
    /// Checks the types of an integral, which is not there yet.
    pub(in crate::check) fn integral(
        &mut self,
        body: ExprId,
        range: &'a Range,
        span: Span,
    ) -> Value {
        let mut fits = true;
        for (end, which) in [(range.lower, "lower"), (range.upper, "upper")] {
            let value = self.expr(end);
            match value.ty(&self.graph) {
                Some(Type::Real) => {}
                Some(found) => {
                    fits = false;
                    let message = format!(
                        "the {which} end of an integral is a real number, and this is {}",
                        found.in_words()
                    );
                    let problem = Diagnostic::error("type-mismatch", self.span(end), message)
                        .with_label(format!("this is {}", found.in_words()));
                    let hint = self.advice_at(found, false, self.span(end));
                    self.report(problem.with_hint(hint));
                }
                None => fits = false,
            }
        }
        let variable = Value::Scalar(self.graph.new_variable(Ty::Real));
        let depth = self.scope.len();
        self.scope.push(&range.name.text, variable);
        let value = self.expr(body);
        self.scope.truncate(depth);
        match value.ty(&self.graph) {
            Some(Type::Bool) => {
                let problem = Diagnostic::error(
                    "type-mismatch",
                    self.span(body),
                    "a condition has no integral",
                );
                let shown =
                    crate::check::shortened(&pullback_grammar::print_expr(&self.file.exprs, body));
                self.report(
                    problem.with_hint(format!("integrate a number: `if {shown} then 1 else 0`")),
                )
            }
            Some(_) if fits => {
                let message = "integrals are not available in this version";
                self.report(
                    Diagnostic::error("not-yet", span, message)
                        .with_label("reserved for a later version")
                        .with_hint("write the integral in closed form"),
                )
            }
            _ => Value::Error,
        }
    }
}
