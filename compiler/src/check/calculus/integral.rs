//! Integrals: `integral(e, t, a, b)` in closed form, `quadrature(e, t, a, b)` numerically.

use pullback_grammar::ast::{ExprId, Method, Range};
use pullback_grammar::{Diagnostic, Span, print_expr};
use smallvec::SmallVec;

use crate::check::{Builder, Value, shortened};
use crate::integrate::{MAX_PANELS, Otherwise, Path, Problem, improper, integrate, quadrature};
use crate::ir::{Id, Prim, Ty};
use crate::types::Type;

/// Number of steps that an integral counts as among nested loops: about as many as a quadrature takes panels.
const STEPS: u32 = 32;

/// Greatest number of integrals of a program.
pub const MAX_INTEGRALS: usize = 100;

/// An integral as it is written.
#[derive(Clone, Copy)]
struct Written<'a> {
    method: Method,
    body: ExprId,
    range: &'a Range,
    span: Span,
}

impl<'a> Builder<'a> {
    /// The value of a definite integral. The integrand is a number or a vector; ends are real.
    pub(in crate::check) fn integral(
        &mut self,
        method: Method,
        body: ExprId,
        range: &'a Range,
        span: Span,
    ) -> Value {
        let written = Written {
            method,
            body,
            range,
            span,
        };
        let ends = self.ends(range, method);
        let leaf = self.graph.new_variable(Ty::Real);
        self.graph.set_name(leaf, &range.name.text);
        let before = self.nesting.enter(STEPS);
        let depth = self.scope.len();
        self.scope.push(&range.name.text, Value::Scalar(leaf));
        let value = self.expr(body);
        self.scope.truncate(depth);
        self.nesting.leave(STEPS, before);
        match (value.ty(&self.graph), ends) {
            (Some(Type::Bool), _) => self.no_condition(body),
            (Some(_), Some(ends)) => self.integral_of(written, &value, leaf, ends),
            _ => Value::Error,
        }
    }

    /// The ends, where both are real numbers.
    fn ends(&mut self, range: &Range, method: Method) -> Option<(Id, Id)> {
        let mut found: SmallVec<[Id; 2]> = SmallVec::new();
        for (end, which) in [(range.lower, "lower"), (range.upper, "upper")] {
            let value = self.expr(end);
            match (value.ty(&self.graph), &value) {
                (Some(Type::Real), Value::Scalar(id)) => found.push(*id),
                (Some(other), _) => {
                    let message = format!(
                        "the {which} end of an integral is a real number, and this is {}",
                        other.in_words()
                    );
                    let problem = Diagnostic::error("type-mismatch", self.span(end), message)
                        .with_label(format!("this is {}", other.in_words()));
                    let hint = self.advice_at(other, false, self.span(end));
                    self.report(problem.with_hint(hint));
                }
                (None, _) => {}
            }
        }
        for (&id, end) in found.iter().zip([range.lower, range.upper]) {
            if method == Method::Quadrature && self.is_infinite(id) {
                self.no_infinite_end(end);
                return None;
            }
        }
        match *found.as_slice() {
            [a, b] => Some((a, b)),
            _ => None,
        }
    }

    fn no_infinite_end(&mut self, end: ExprId) {
        let problem = Diagnostic::error(
            "no-closed-form",
            self.span(end),
            "a quadrature to infinity is not available",
        )
        .with_label("infinite")
        .with_hint(
            "take a finite end beyond which the integrand does not count, such as 30 for exp(-t)",
        );
        self.report(problem);
    }

    fn no_condition(&mut self, body: ExprId) -> Value {
        let problem = Diagnostic::error(
            "type-mismatch",
            self.span(body),
            "a condition has no integral",
        );
        let shown = shortened(&print_expr(&self.file.exprs, body));
        self.report(problem.with_hint(format!("integrate a number: `if {shown} then 1 else 0`")))
    }

    fn integral_of(&mut self, written: Written, value: &Value, leaf: Id, ends: (Id, Id)) -> Value {
        self.integrals += 1;
        if self.integrals > MAX_INTEGRALS {
            let message =
                format!("more than {MAX_INTEGRALS} integrals, those of called functions each time");
            return self.report(Diagnostic::error("too-large", written.span, message));
        }
        let mut results: SmallVec<[Id; 4]> = SmallVec::new();
        for id in value.ids() {
            let result = if self.graph.ty(id) == Ty::Complex {
                let parts = [Prim::Re, Prim::Im].map(|part| self.graph.apply(part, &[id]));
                let re = self.real_integral(written, parts[0], (leaf, ends));
                let im = re
                    .and_then(|re| Ok((re, self.real_integral(written, parts[1], (leaf, ends))?)));
                im.map(|(re, im)| self.graph.apply(Prim::Complex, &[re, im]))
            } else {
                self.real_integral(written, id, (leaf, ends))
            };
            match result {
                Ok(result) => results.push(result),
                Err(problem) => return self.no_closed_form(written, ends, &problem),
            }
        }
        let steps = match written.method {
            Method::Closed => STEPS * 2,
            Method::Quadrature => MAX_PANELS,
        };
        if let Some(constants) = self.folding.fold(&mut self.graph, &results, steps.into()) {
            results = constants;
        }
        value.with_ids(&results)
    }

    fn is_infinite(&self, id: Id) -> bool {
        self.graph.as_real(id).is_some_and(f64::is_infinite)
    }

    fn real_integral(
        &mut self,
        written: Written,
        root: Id,
        (leaf, ends): (Id, (Id, Id)),
    ) -> Result<Id, Problem> {
        if self.is_infinite(ends.0) || self.is_infinite(ends.1) {
            return improper(&mut self.graph, root, leaf, [ends.0, ends.1]).map(|i| i.value);
        }
        let path = &Path::of_variable(&mut self.graph, leaf, ends.0, ends.1);
        match written.method {
            Method::Closed => {
                integrate(&mut self.graph, root, path, Otherwise::Refuse).map(|i| i.value)
            }
            Method::Quadrature => quadrature(&mut self.graph, root, path),
        }
    }

    fn no_closed_form(&mut self, written: Written, ends: (Id, Id), problem: &Problem) -> Value {
        let Range { name, lower, upper } = written.range;
        let exprs = &self.file.exprs;
        let [body, a, b] = [written.body, *lower, *upper].map(|e| shortened(&print_expr(exprs, e)));
        let mut diagnostic = problem.diagnostic(written.span);
        let is_finite = !self.is_infinite(ends.0) && !self.is_infinite(ends.1);
        if written.method == Method::Closed && is_finite {
            let call = format!("quadrature({body}, {}, {a}, {b})", shortened(&name.text));
            diagnostic = diagnostic.with_hint(format!("`{call}` computes it numerically"));
        } else if !is_finite {
            diagnostic = diagnostic.with_hint("take finite ends");
        }
        self.report(diagnostic)
    }
}
