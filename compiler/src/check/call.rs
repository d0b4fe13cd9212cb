//! Calls: of the program's functions, of the library's, and of builtins.

use pullback_grammar::ast::{ExprId, Function, Name};
use pullback_grammar::{Diagnostic, Span};
use smallvec::SmallVec;

use super::builder::Known;
use super::library::LibraryFunction;
use super::names::{listed, signature};
use super::scope::Scope;
use super::suggest::quoted;
use super::{Builder, Source, Value, builtins, calculus, library};
use crate::defined::Digits;
use crate::ir::{Id, Prim, Slopes, Ty};
use crate::table;
use crate::types::Type;

/// What the library writes `_tier(a, b)`: a where digits are those of binary32, else b.
const TIER: &str = "_tier";

impl<'a> Builder<'a> {
    pub(super) fn call(
        &mut self,
        callee: &'a Name,
        primes: u32,
        args: &'a [ExprId],
        span: Span,
    ) -> Value {
        let name = callee.text.as_str();
        let user = self.user_function(name);
        if let Some(operator) = calculus::by_name(name).filter(|_| user.is_none()) {
            return self.calculus(operator, args, span);
        }
        if primes > 0 {
            return self.prime(callee, primes, args, span);
        }
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
        let spans: Vec<Span> = args.iter().map(|&a| self.span(a)).collect();
        self.invoke(name, values, &spans, span)
    }

    /// Calls the function of this name, whatever it is; `spans` are the places of the arguments where they have any.
    pub(super) fn invoke(
        &mut self,
        name: &'a str,
        mut values: Vec<Value>,
        spans: &[Span],
        span: Span,
    ) -> Value {
        if values.contains(&Value::Error) {
            return Value::Error;
        }
        if let Some(function) = self.user_function(name) {
            return self.call_function(function, values, spans, span);
        }
        if name == TIER && self.source == Source::Library && values.len() == 2 {
            return values.swap_remove(usize::from(self.digits == Digits::Wide));
        }
        if let Some(builtin) = builtins::by_name(name) {
            if !builtin.arity.contains(&values.len()) {
                return Value::Error;
            }
            return (builtin.build)(self, &values, span);
        }
        let row = table::by_name(name).or_else(|| self.rest_of_rounding(name));
        let is_primitive = row.is_some_and(|row| row.typing.arity() == values.len());
        if let Some(definitions) = library::by_name(name)
            && !is_primitive
        {
            return self.call_library(definitions, values, span);
        }
        match row {
            Some(row) => self.call_primitive(row.prim, &values, span),
            // unknown functions have been reported by the pass over names
            None => Value::Error,
        }
    }

    /// What the library writes `_sum_rest(a, b, s)` and `_product_rest(a, b, p)`, and a b + c of which the product is not rounded, which
    /// has rests in wide tiers, too.
    fn rest_of_rounding(&self, name: &str) -> Option<&'static table::Row> {
        let prim = match name {
            "_sum_rest" => Prim::SumRest,
            "_product_rest" => Prim::ProductRest,
            "_mul_add" => Prim::MulAdd,
            _ => return None,
        };
        (self.source == Source::Library).then(|| table::row(prim))
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
                        "{} is {}, and this is {}",
                        quoted(&function.params[k].name.text),
                        ty.in_words(),
                        found.in_words()
                    ),
                )
                .with_label(format!("this is {}", found.in_words()))
                .with_related(
                    function.params[k].name.span,
                    format!("{ty} in {}", signature(function)),
                );
                let wants_vector = matches!(ty, Type::Vector(_));
                let hint = self.advice_at(found, wants_vector, span);
                self.report(problem.with_hint(hint))
            }
        }
    }

    /// Calls the definition of the library that fits the arguments.
    fn call_library(
        &mut self,
        definitions: &'static [&'static LibraryFunction],
        mut values: Vec<Value>,
        span: Span,
    ) -> Value {
        let types: Option<Vec<Type>> = values.iter().map(|v| v.ty(&self.graph)).collect();
        let Some(types) = types else {
            return Value::Error;
        };
        let Some(function) = library::overload(definitions, &types) else {
            return self.no_definition(definitions, &types, span);
        };
        if function.is_generic() {
            return self.by_components(function, &values, span);
        }
        for (value, expected) in values.iter_mut().zip(&function.types) {
            if let (Value::Scalar(id), Some(Type::Complex)) = (&value, expected) {
                *value = Value::Scalar(self.graph.widen(*id));
            }
        }
        self.library_body(function, values, span)
    }

    /// Reports arguments that no definition takes. A wrong number has been reported by the pass over names.
    fn no_definition(
        &mut self,
        definitions: &'static [&'static LibraryFunction],
        types: &[Type],
        span: Span,
    ) -> Value {
        let takes_as_many = |f: &&&LibraryFunction| f.types.len() == types.len();
        let near: Vec<&str> = definitions
            .iter()
            .filter(takes_as_many)
            .map(|f| f.usage.as_str())
            .collect();
        let (Some(function), false) = (definitions.first(), near.is_empty()) else {
            return Value::Error;
        };
        let problem = does_not_take(function.name, types, span);
        self.report(problem.with_hint(format!("it is written {}", listed(&near))))
    }

    /// Calls a definition without annotations, by components where an argument is a vector.
    fn by_components(
        &mut self,
        function: &'static LibraryFunction,
        values: &[Value],
        span: Span,
    ) -> Value {
        let mut size = None;
        for value in values {
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
            return self.library_body(function, values.to_vec(), span);
        };
        let mut out = SmallVec::new();
        for k in 0..size {
            let component = |v: &Value| match v {
                Value::Vector(items) => Value::Scalar(items[k]),
                _ => v.clone(),
            };
            match self.library_body(function, values.iter().map(component).collect(), span) {
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

    /// The value of a definition for arguments that fit it. What is found inside is told at the call: places in the
    /// library mean nothing to the user.
    fn library_body(
        &mut self,
        function: &'static LibraryFunction,
        values: Vec<Value>,
        span: Span,
    ) -> Value {
        let formals = &function.function.params;
        if formals.len() != values.len() {
            return Value::Error;
        }
        let key = (Source::Library, function.name, values);
        if let Some(known) = self.calls.get(&key).cloned() {
            let fits = self.reuse(known.loops, span);
            return if fits { known.value } else { Value::Error };
        }
        let scope = formals
            .iter()
            .map(|p| p.name.text.as_str())
            .zip(key.2.iter().cloned())
            .collect();
        let before = self.diagnostics.len();
        let around = self.nesting.apart();
        let body = function.function.body;
        let value = self.outside(function.name, Source::Library, scope, body);
        self.add_slopes(function, &value, &key.2);
        let loops = self.nesting.join(around);
        let found = self.diagnostics.split_off(before);
        if let Some(problem) = found.iter().find(|problem| problem.is_error()) {
            let types: Vec<Type> = key.2.iter().filter_map(|v| v.ty(&self.graph)).collect();
            let problem = at_call(problem, function, &types, span);
            return self.report(problem);
        }
        if !found.is_empty() && self.is_undefined(&value) {
            let message = format!("`{}` of these constants is not a number", function.name);
            let problem = Diagnostic::warning("outside-domain", span, message);
            self.diagnostics.push(problem.with_hint(written(function)));
        } else if value != Value::Error {
            let known = Known {
                value: value.clone(),
                loops,
                place: self.calls.len(),
            };
            self.calls.insert(key, known);
        }
        value
    }

    /// Remembers the derivatives of a value of the library that the library gives beside it: `_slopes_NAME` has those by as
    /// many arguments as it has components, the first ones.
    fn add_slopes(
        &mut self,
        function: &'static LibraryFunction,
        value: &Value,
        arguments: &[Value],
    ) {
        let (Value::Scalar(value), Some([slopes])) = (
            value,
            library::by_name(&format!("_slopes_{}", function.name)),
        ) else {
            return;
        };
        let of: Option<SmallVec<[Id; 2]>> = arguments
            .iter()
            .map(|argument| match argument {
                Value::Scalar(id) => Some(*id),
                _ => None,
            })
            .collect();
        let (Some(of), Value::Vector(slopes)) = (
            of,
            self.library_body(slopes, arguments.to_vec(), Span::default()),
        ) else {
            return;
        };
        let by = of.iter().copied().zip(slopes.iter().copied()).collect();
        let fixed = of.iter().skip(slopes.len()).copied().collect();
        self.graph.set_slopes(*value, Slopes { by, fixed });
    }

    /// The value of the definition of the library with this name that takes exactly these types.
    pub fn defined(&mut self, name: &str, values: Vec<Value>) -> Option<Id> {
        let types: Vec<Option<Type>> = values.iter().map(|v| v.ty(&self.graph)).collect();
        let mut definitions = library::by_name(name)?.iter();
        let function = definitions.find(|f| f.types == types)?;
        match self.library_body(function, values, Span::default()) {
            Value::Scalar(id) => Some(id),
            _ => None,
        }
    }

    /// Whether a component is known not to be a number.
    fn is_undefined(&self, value: &Value) -> bool {
        let mut ids = value.ids().into_iter();
        ids.any(|id| self.graph.as_real(id).is_some_and(f64::is_nan))
    }
}

/// An error inside of a definition of the library, as the user can understand it: a limit that was exceeded, or
/// arguments that do not fit.
fn at_call(
    problem: &Diagnostic,
    function: &LibraryFunction,
    types: &[Type],
    span: Span,
) -> Diagnostic {
    if problem.code != "type-mismatch" {
        return Diagnostic {
            span,
            related: Vec::new(),
            ..problem.clone()
        };
    }
    does_not_take(function.name, types, span).with_hint(written(function))
}

/// What a definition takes: where it takes anything, the definition itself says.
fn written(function: &LibraryFunction) -> String {
    if function.is_generic() {
        format!("it is defined as {}", function.definition)
    } else {
        format!("it is written `{}`", function.usage)
    }
}

fn does_not_take(name: &str, types: &[Type], span: Span) -> Diagnostic {
    let shown: Vec<&str> = types.iter().map(|ty| ty.in_words()).collect();
    Diagnostic::error(
        "type-mismatch",
        span,
        format!("`{name}` does not take {}", shown.join(" and ")),
    )
}
