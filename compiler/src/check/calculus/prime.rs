//! `f'(x)`: derivatives of functions of one number.

use pullback_grammar::ast::{ExprId, Function, Name};
use pullback_grammar::{Diagnostic, Span};

use super::partial::Subject;
use crate::check::builder::Known;
use crate::check::suggest::quoted;
use crate::check::{Builder, Value};
use crate::types::Type;

/// Greatest order of a derivative that is written at once.
pub const MAX_ORDER: u32 = 4;

/// What is wrong with the primes of a call, as its text shows it: `arities` are the numbers of arguments that the
/// function takes, `args` the arguments as text.
pub fn primes_misused(
    (callee, span): (&Name, Span),
    primes: u32,
    arities: &[usize],
    args: &[String],
    variable: &str,
) -> Option<Diagnostic> {
    let fits = arities.contains(&args.len());
    if arities.contains(&1) && (args.len() == 1 || !fits) {
        // a wrong number of arguments is reported as such
        return too_high(span, primes);
    }
    let name = &callee.text;
    let count = if fits {
        args.len()
    } else {
        arities.first().copied().unwrap_or(args.len())
    };
    let message = format!(
        "{} is a function of {count} variables: a prime does not say which one is meant",
        quoted(name)
    );
    let order = if primes > 1 {
        format!(", {primes}")
    } else {
        String::new()
    };
    let call = crate::check::shortened(&format!("{name}({})", args.join(", ")));
    let problem = Diagnostic::error("prime-needs-one-variable", span, message);
    Some(
        problem
            .with_label("not of one variable")
            .with_hint(format!("write `diff({call}, {variable}{order})`")),
    )
}

/// The error for derivatives of too high an order.
pub fn too_high(span: Span, order: u32) -> Option<Diagnostic> {
    (order > MAX_ORDER).then(|| {
        Diagnostic::error(
            "too-many-derivatives",
            span,
            format!("a derivative of order {order}, the highest is {MAX_ORDER}"),
        )
        .with_hint("name the derivative, g(x) = f''''(x), and differentiate that")
    })
}

impl<'a> Builder<'a> {
    /// `f'(x)`, with as many primes as the order says.
    pub(in crate::check) fn prime(
        &mut self,
        callee: &'a Name,
        order: u32,
        args: &'a [ExprId],
        span: Span,
    ) -> Value {
        // what is wrong with the text has been reported by the pass over names
        let &[arg] = args else { return Value::Error };
        if order > MAX_ORDER {
            return Value::Error;
        }
        let at = self.expr(arg);
        self.derivative_at(callee, order, &at, self.span(arg), span)
    }

    /// The derivative of a function of one number at a value.
    pub(super) fn derivative_at(
        &mut self,
        callee: &'a Name,
        order: u32,
        at: &Value,
        at_span: Span,
        span: Span,
    ) -> Value {
        let function = self.user_function(&callee.text);
        let Some(at) = self.argument_of(callee, function, at, at_span) else {
            return Value::Error;
        };
        let name = callee.text.as_str();
        let key = (self.source, name, order, at.clone());
        if let Some(known) = self.derivatives.get(&key) {
            let known = known.clone();
            let fits = self.reuse(known.loops, span);
            return if fits { known.value } else { Value::Error };
        }
        let around = self.nesting.apart();
        let value = self.derive_at(callee, order, &at, at_span, span);
        let loops = self.nesting.join(around);
        if value != Value::Error {
            let known = Known {
                value: value.clone(),
                loops,
                place: 0,
            };
            self.derivatives.insert(key, known);
        }
        value
    }

    fn derive_at(
        &mut self,
        callee: &'a Name,
        order: u32,
        at: &Value,
        at_span: Span,
        span: Span,
    ) -> Value {
        let function = self.user_function(&callee.text);
        let Some(leaf) = self.leaves_like(at) else {
            return Value::Error;
        };
        let value = self.invoke(&callee.text, vec![leaf.clone()], &[at_span], span);
        let mut value = self.as_number(value, span);
        let subject = Subject {
            span,
            text: function.map(|f| f.body),
        };
        let (from, to) = (leaf.ids(), at.ids());
        for _ in 0..order {
            value = match self.partial(&value, from[0], subject) {
                Some(value) => value,
                None => return Value::Error,
            };
        }
        self.replaced(&value, &[(from[0], to[0])])
    }

    /// The argument as the number that the function takes.
    fn argument_of(
        &mut self,
        callee: &Name,
        function: Option<&Function>,
        at: &Value,
        span: Span,
    ) -> Option<Value> {
        let formal = function.and_then(|f| f.params.first());
        let declared = formal
            .and_then(|f| f.ty.as_ref())
            .and_then(|t| Type::from_name(&t.text));
        let found = at.ty(&self.graph)?;
        match (at, found, declared) {
            (Value::Scalar(id), Type::Real, Some(Type::Complex)) => {
                Some(Value::Scalar(self.graph.widen(*id)))
            }
            (_, Type::Real | Type::Complex, _) => Some(at.clone()),
            _ => {
                let message = format!(
                    "a prime is the derivative by one number, and this is {}",
                    found.in_words()
                );
                let problem = Diagnostic::error("prime-needs-one-variable", span, message)
                    .with_label(format!("this is {}", found.in_words()));
                let name = quoted(&callee.text);
                let name = name.trim_matches('`');
                self.report(match found {
                    Type::Vector(_) => problem.with_hint(format!(
                        "write grad({name})(…) for the derivatives by all components"
                    )),
                    _ => problem.with_hint("a condition is not a number"),
                });
                None
            }
        }
    }
}
