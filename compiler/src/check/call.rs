//! Calls: of the program's functions, of the library's, and of builtins.

use pullback_grammar::ast::{ExprId, Function, Name};
use pullback_grammar::{Diagnostic, Span};
use smallvec::SmallVec;

use super::builder::Known;
use super::builtins::advice;
use super::names::signature;
use super::scope::Scope;
use super::suggest::quoted;
use super::{Builder, Source, Value, builtins, library};
use crate::ir::{Prim, Ty};
use crate::table;
use crate::types::Type;

impl<'a> Builder<'a> {
    pub(super) fn call(
        &mut self,
        callee: &'a Name,
        primes: u32,
        args: &'a [ExprId],
        span: Span,
    ) -> Value {
        let user = self.user_function(&callee.text);
        let mut values: Vec<Value> = Vec::new();
        for (k, &arg) in args.iter().enumerate() {
            let formal = user.and_then(|function| function.params.get(k));
            let takes_records = formal.is_some_and(|formal| formal.ty.is_none());
            values.push(if takes_records {
                self.any(arg)
            } else {
                self.expr(arg)
            });
        }
        if primes > 0 {
            return self.report(
                Diagnostic::error(
                    "not-yet",
                    callee.span,
                    "derivatives inside of a formula are not available in this version",
                )
                .with_hint("`pullback eval --what derivative` computes them"),
            );
        }
        if values.contains(&Value::Error) {
            return Value::Error;
        }
        let name = callee.text.as_str();
        if let Some(function) = user {
            let spans: Vec<Span> = args.iter().map(|&a| self.span(a)).collect();
            return self.call_function(function, values, &spans, span);
        }
        if let Some(builtin) = builtins::by_name(name) {
            if !builtin.arity.contains(&values.len()) {
                return Value::Error;
            }
            return (builtin.build)(self, &values, span);
        }
        if let Some(function) = library::by_name(name) {
            return self.call_library(function, values, span);
        }
        match table::by_name(name) {
            Some(row) => self.call_primitive(row.prim, &values, span),
            // unknown functions have been reported by the pass over names
            None => Value::Error,
        }
    }

    fn call_primitive(&mut self, prim: Prim, values: &[Value], span: Span) -> Value {
        let arity = table::row(prim).typing.arity();
        if values.len() == arity {
            return self.map(prim, values, span);
        }
        if !matches!(prim, Prim::Min | Prim::Max) || values.len() < arity {
            return Value::Error;
        }
        let mut total = values[0].clone();
        for value in &values[1..] {
            total = self.map(prim, &[total, value.clone()], span);
        }
        total
    }

    /// Calls a function of the program with checked arguments. The value may be a record, see [`Self::number`].
    pub fn call_function(
        &mut self,
        function: &'a Function,
        mut values: Vec<Value>,
        spans: &[Span],
        span: Span,
    ) -> Value {
        let name = function.name.text.as_str();
        if function.params.len() != values.len() || self.active.contains(&name) {
            return Value::Error;
        }
        for (k, formal) in function.params.iter().enumerate() {
            let Some(ty) = formal.ty.as_ref().map(|t| Type::from_name(&t.text)) else {
                continue;
            };
            let Some(ty) = ty else { return Value::Error };
            let place = spans.get(k).copied().unwrap_or(span);
            values[k] = self.convert(&values[k], ty, place, function, k);
            if values[k] == Value::Error {
                return Value::Error;
            }
        }
        let key = (Source::Program, name, values);
        if let Some(known) = self.calls.get(&key).cloned() {
            let fits = self.reuse(known.loops, span);
            return if fits { known.value } else { Value::Error };
        }
        let scope: Scope<'a, Value> = function
            .params
            .iter()
            .map(|p| p.name.text.as_str())
            .zip(key.2.iter().cloned())
            .collect();
        let before = self.diagnostics.len();
        let around = self.nesting.apart();
        let value = self.outside(name, Source::Program, scope, function.body);
        let loops = self.nesting.join(around);
        for problem in self.diagnostics.iter_mut().skip(before) {
            if problem.code == "type-mismatch" && problem.related.is_empty() && !spans.is_empty() {
                problem.related.push((span, "in this call".to_owned()));
            }
        }
        self.name_value(name, &value);
        let known = Known {
            value: value.clone(),
            loops,
            place: self.calls.len(),
        };
        self.calls.insert(key, known);
        value
    }

    /// The k-th argument of a function as what the annotation says.
    fn convert(
        &mut self,
        value: &Value,
        ty: Type,
        span: Span,
        function: &Function,
        k: usize,
    ) -> Value {
        let Some(found) = value.ty(&self.graph) else {
            return Value::Error;
        };
        match value {
            _ if found == ty => value.clone(),
            Value::Scalar(id) if found == Type::Real && ty == Type::Complex => {
                Value::Scalar(self.graph.widen(*id))
            }
            _ => {
                let problem = Diagnostic::error(
                    "type-mismatch",
                    span,
                    format!(
                        "{} is {ty}, found {found}",
                        quoted(&function.params[k].name.text)
                    ),
                )
                .with_label(format!("this is {found}"))
                .with_related(
                    function.params[k].name.span,
                    format!("{ty} in {}", signature(function)),
                );
                let wants_vector = matches!(ty, Type::Vector(_));
                self.report(problem.with_hint(advice(found, wants_vector)))
            }
        }
    }

    /// Calls a function of the library, by components where an argument is a vector.
    fn call_library(
        &mut self,
        function: &'static library::LibraryFunction,
        values: Vec<Value>,
        span: Span,
    ) -> Value {
        let mut size = None;
        for value in &values {
            if let Value::Vector(items) = value {
                if size.is_some_and(|n| n != items.len()) {
                    return self.report(Diagnostic::error(
                        "type-mismatch",
                        span,
                        format!("`{}` takes vectors of one size", function.name),
                    ));
                }
                size = Some(items.len());
            }
        }
        let Some(size) = size else {
            return self.library_scalar(function, values, span);
        };
        let mut out = SmallVec::new();
        for k in 0..size {
            let component = |v: &Value| match v {
                Value::Vector(items) => Value::Scalar(items[k]),
                _ => v.clone(),
            };
            match self.library_scalar(function, values.iter().map(component).collect(), span) {
                Value::Scalar(id) if self.graph.ty(id) == Ty::Real => out.push(id),
                Value::Error => return Value::Error,
                _ => {
                    return self.report(
                        Diagnostic::error(
                            "type-mismatch",
                            span,
                            format!("`{}` does not take vectors and complex numbers together", function.name),
                        )
                        .with_hint("a vector has real components: take re(…) or im(…) of the complex number"),
                    );
                }
            }
        }
        Value::Vector(out)
    }

    fn library_scalar(
        &mut self,
        function: &'static library::LibraryFunction,
        values: Vec<Value>,
        span: Span,
    ) -> Value {
        let formals = &function.function.params;
        if formals.len() != values.len() {
            return Value::Error;
        }
        let shown: Vec<String> = values
            .iter()
            .filter_map(|v| v.ty(&self.graph))
            .map(|t| t.to_string())
            .collect();
        let scope = formals
            .iter()
            .map(|p| p.name.text.as_str())
            .zip(values)
            .collect();
        let before = self.diagnostics.len();
        let value = self.outside(
            function.name,
            Source::Library,
            scope,
            function.function.body,
        );
        if self.diagnostics.len() > before {
            // places inside of the library mean nothing to the user
            self.diagnostics.truncate(before);
            return self.report(
                Diagnostic::error(
                    "type-mismatch",
                    span,
                    format!("`{}` does not take {}", function.name, shown.join(" and ")),
                )
                .with_hint(format!("it is defined as {}", function.definition)),
            );
        }
        value
    }
}
