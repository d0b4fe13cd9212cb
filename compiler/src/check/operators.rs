//! Operators: which types they take, and what they build.

use pullback_grammar::ast::{BinaryOp, CompareOp, ExprId, UnaryOp};
use pullback_grammar::diagnostic::MAX_DIAGNOSTICS;
use pullback_grammar::{Diagnostic, Span, print_expr};
use smallvec::SmallVec;

use super::builtins::length;
use super::{Builder, Value, shortened};
use crate::ir::{Id, Prim, Ty};
use crate::numeral::Numeral;
use crate::types::Type;

impl<'a> Builder<'a> {
    pub(super) fn unary(&mut self, op: UnaryOp, value: &Value, span: Span, operand: Span) -> Value {
        match op {
            UnaryOp::Neg => self.map(Prim::Neg, std::slice::from_ref(value), span),
            UnaryOp::Sqrt => self.map(Prim::Sqrt, std::slice::from_ref(value), span),
            UnaryOp::Abs => length(self, value, span),
            UnaryOp::Factorial => {
                let one = Value::Scalar(self.graph.real(1.0));
                let shifted = self.arithmetic(Prim::Add, value, &one, span);
                self.map(Prim::Gamma, &[shifted], span)
            }
            UnaryOp::Not => match value {
                Value::Scalar(id) if self.graph.ty(*id) == Ty::Bool => {
                    Value::Scalar(self.graph.apply(Prim::Not, &[*id]))
                }
                _ => self.condition_expected(value, operand),
            },
        }
    }

    /// Both operands with their places, and the place of the whole.
    pub(super) fn binary(
        &mut self,
        op: BinaryOp,
        (a, a_span): (&Value, Span),
        (b, b_span): (&Value, Span),
        span: Span,
    ) -> Value {
        let prim = match op {
            BinaryOp::Add => Prim::Add,
            BinaryOp::Sub => Prim::Sub,
            BinaryOp::Mul | BinaryOp::ImplicitMul => Prim::Mul,
            BinaryOp::Div => Prim::Div,
            BinaryOp::Pow => Prim::Pow,
            BinaryOp::And => return self.logic(Prim::And, (a, a_span), (b, b_span)),
            BinaryOp::Or => return self.logic(Prim::Or, (a, a_span), (b, b_span)),
        };
        self.arithmetic(prim, a, b, span)
    }

    /// Sum, difference, product, quotient or power, by components on vectors.
    pub fn arithmetic(&mut self, prim: Prim, a: &Value, b: &Value, span: Span) -> Value {
        self.map(prim, &[a.clone(), b.clone()], span)
    }

    fn logic(&mut self, prim: Prim, a: (&Value, Span), b: (&Value, Span)) -> Value {
        let [a, b] = [a, b].map(|(value, span)| match value {
            Value::Scalar(id) if self.graph.ty(*id) == Ty::Bool => Some(*id),
            _ => {
                self.condition_expected(value, span);
                None
            }
        });
        match (a, b) {
            (Some(a), Some(b)) => Value::Scalar(self.graph.apply(prim, &[a, b])),
            _ => Value::Error,
        }
    }

    /// The text of what stands at a place, cut where it is long.
    pub(super) fn text_at(&self, span: Span) -> Option<String> {
        if self.diagnostics.len() > MAX_DIAGNOSTICS {
            // will not be listed
            return None;
        }
        let exprs = &self.file.exprs;
        Some(shortened(&print_expr(exprs, exprs.at(span)?)))
    }

    /// How what stands at a place becomes what is wanted, in its own text: a vector, or a real number.
    pub(super) fn advice_at(&self, found: Type, wants_vector: bool, span: Span) -> String {
        match self.text_at(span) {
            Some(text) => advice_for(found, wants_vector, &text),
            None => super::builtins::advice(found, wants_vector).to_owned(),
        }
    }

    /// The text of the first operand or argument at a place that has a type, where `types` are those of all of them.
    fn operand_of(&self, span: Span, types: &[Type], wanted: Type) -> Option<String> {
        if self.diagnostics.len() > MAX_DIAGNOSTICS {
            return None;
        }
        let exprs = &self.file.exprs;
        let whole = &exprs[exprs.at(span)?];
        let mut operands = Vec::new();
        whole.for_each_child(|child| operands.push(child));
        let which = types.iter().position(|ty| *ty == wanted)?;
        let operand = operands
            .get(which)
            .filter(|_| operands.len() == types.len())?;
        Some(shortened(&print_expr(exprs, *operand)))
    }

    pub(super) fn condition_expected(&mut self, value: &Value, span: Span) -> Value {
        let Some(ty) = value.ty(&self.graph) else {
            return Value::Error;
        };
        self.report(
            Diagnostic::error(
                "condition-not-bool",
                span,
                format!("a condition is needed here, and this is {}", ty.in_words()),
            )
            .with_label(format!("this is {}", ty.in_words()))
            .with_hint(match self.text_at(span) {
                Some(text) if text.parse::<f64>().is_ok() => {
                    "a number is no condition; a choice is `if c then a else b`".to_owned()
                }
                Some(text) if ty == Type::Real => {
                    format!("write a comparison such as `{text} > 0`")
                }
                Some(text) => format!("write a comparison such as `|{text}| > 1`"),
                None => "write a comparison such as `x > 0`".to_owned(),
            }),
        )
    }

    /// Applies a primitive to numbers; where an argument is a vector, to each component, scalars being repeated.
    pub fn map(&mut self, prim: Prim, args: &[Value], span: Span) -> Value {
        let mut size = None;
        for arg in args {
            match arg {
                Value::Record(_) | Value::Error => return Value::Error,
                Value::Scalar(_) => {}
                Value::Vector(items) => match size {
                    Some(n) if n != items.len() => return self.mismatched(prim, args, span),
                    _ => size = Some(items.len()),
                },
            }
        }
        let Some(size) = size else {
            let ids: SmallVec<[Id; 4]> = args.iter().flat_map(Value::ids).collect();
            return self.scalar(prim, &ids, args, span);
        };
        let mut out = SmallVec::new();
        for k in 0..size {
            let ids: SmallVec<[Id; 4]> = args
                .iter()
                .map(|arg| match arg {
                    Value::Vector(items) => items[k],
                    _ => arg.ids()[0],
                })
                .collect();
            match self.scalar(prim, &ids, args, span) {
                Value::Scalar(id) if self.graph.ty(id) == Ty::Real => out.push(id),
                Value::Error => return Value::Error,
                _ => return self.mismatched(prim, args, span),
            }
        }
        Value::Vector(out)
    }

    fn scalar(&mut self, prim: Prim, ids: &[Id], args: &[Value], span: Span) -> Value {
        let row = crate::table::row(prim);
        let complex = ids.iter().any(|&id| self.graph.ty(id) == Ty::Complex);
        let boolean = ids.iter().any(|&id| self.graph.ty(id) == Ty::Bool);
        let accepts_complex = row.typing.mixes_real_and_complex()
            || matches!(
                row.typing,
                crate::table::Typing::Analytic(_) | crate::table::Typing::Complex(_)
            );
        if boolean || (complex && !accepts_complex) {
            return self.mismatched(prim, args, span);
        }
        if let Some(problem) = self.not_whole(prim, ids, span) {
            return self.report(problem);
        }
        let id = self.graph.apply(prim, ids);
        if !self.warn_of_nan(prim, ids, id, span) {
            self.warn_of_domain(prim, ids, span);
        }
        Value::Scalar(id)
    }

    /// Warns where a constant among the arguments lies outside of the domain of a special function.
    fn warn_of_domain(&mut self, prim: Prim, ids: &[Id], span: Span) {
        let constant = |&id: &Id| {
            let real = self.graph.as_real(id).map(|x| (x, 0.0));
            real.or_else(|| self.graph.as_complex(id))
        };
        let constants: SmallVec<[Option<(f64, f64)>; 4]> = ids.iter().map(constant).collect();
        if let Some(reason) = crate::table::outside(prim, &constants) {
            let name = crate::table::row(prim).sign();
            let message = format!("`{name}` is not a number here: {reason}");
            let problem = Diagnostic::warning("outside-domain", span, message);
            self.diagnostics.push(problem);
        }
    }

    /// Warns where constant real arguments lie outside of the domain, and says whether it did.
    fn warn_of_nan(&mut self, prim: Prim, ids: &[Id], result: Id, span: Span) -> bool {
        let constants: Option<Vec<f64>> = ids.iter().map(|&id| self.graph.as_real(id)).collect();
        let (Some(args), Some(value)) = (constants, self.graph.as_real(result)) else {
            return false;
        };
        let outside = value.is_nan() && args.iter().all(|x| !x.is_nan());
        if outside {
            let row = crate::table::row(prim);
            let name = row.sign();
            let shown: Vec<String> = args.iter().map(|&x| Numeral(x).to_string()).collect();
            let problem = Diagnostic::warning(
                "outside-domain",
                span,
                format!("`{name}` of the real {} is not a number", shown.join(", ")),
            );
            self.diagnostics
                .push(if row.complex.is_some() && args.len() == 1 {
                    problem.with_hint(format!(
                        "for the complex value write {name}({} + 0i)",
                        shown[0]
                    ))
                } else {
                    problem
                });
        }
        outside
    }

    fn mismatched(&mut self, prim: Prim, args: &[Value], span: Span) -> Value {
        let tys: Vec<Type> = args.iter().filter_map(|a| a.ty(&self.graph)).collect();
        if tys.len() != args.len() {
            return Value::Error;
        }
        let row = crate::table::row(prim);
        let shown: Vec<&str> = tys.iter().map(|ty| ty.in_words()).collect();
        let problem = Diagnostic::error(
            "type-mismatch",
            span,
            format!("`{}` does not take {}", row.sign(), shown.join(" and ")),
        );
        let vectors: Vec<&Type> = tys
            .iter()
            .filter(|t| matches!(t, Type::Vector(_)))
            .collect();
        let problem = if tys.contains(&Type::Bool) {
            let culprit = self.operand_of(span, &tys, Type::Bool);
            let shown = culprit.as_deref().unwrap_or("…");
            problem.with_hint(format!(
                "a condition is no number: `if {shown} then 1 else 0` is one"
            ))
        } else if vectors.len() > 1 && vectors.iter().any(|t| *t != vectors[0]) {
            problem.with_hint("vectors must have the same number of components; a swizzle such as p.xy shortens one")
        } else if tys.contains(&Type::Complex) && !vectors.is_empty() {
            problem.with_hint(
                "a vector has real components: take re(…) or im(…) of the complex number",
            )
        } else {
            problem.with_label("takes real numbers only").with_hint(
                match self.operand_of(span, &tys, Type::Complex) {
                    Some(text) => advice_for(Type::Complex, false, &text),
                    None => "take re(…), im(…) or abs(…) of the complex number".to_owned(),
                },
            )
        };
        self.report(problem)
    }

    pub(super) fn comparison(
        &mut self,
        first: ExprId,
        rest: &'a [(CompareOp, ExprId)],
        whole: Span,
    ) -> Value {
        let mut left = self.expr(first);
        let mut left_id = first;
        // the whole has the brackets around its first and last operand, their own places have not
        let mut left_span = Span::new(whole.start, self.span(first).end);
        let mut all: Option<Id> = None;
        let mut failed = false;
        for (k, &(op, right)) in rest.iter().enumerate() {
            let mut span = left_span.join(self.span(right));
            if k + 1 == rest.len() {
                span = Span::new(span.start, whole.end);
            }
            left_span = self.span(right);
            let right_id = right;
            let right = self.expr(right_id);
            if failed {
                // one mistake in a chain is enough
                (left, left_id) = (right, right_id);
                continue;
            }
            match self.compare(op, (&left, left_id), (&right, right_id), span) {
                Value::Scalar(step) => {
                    all = Some(match all {
                        Some(all) => self.graph.apply(Prim::And, &[all, step]),
                        None => step,
                    });
                }
                _ => failed = true,
            }
            (left, left_id) = (right, right_id);
        }
        match all {
            Some(all) if !failed => Value::Scalar(all),
            _ => Value::Error,
        }
    }

    fn compare(
        &mut self,
        op: CompareOp,
        (a, a_id): (&Value, ExprId),
        (b, b_id): (&Value, ExprId),
        span: Span,
    ) -> Value {
        let (Some(ta), Some(tb)) = (a.ty(&self.graph), b.ty(&self.graph)) else {
            return Value::Error;
        };
        let equality = matches!(op, CompareOp::Equal | CompareOp::NotEqual);
        let fits = |t| t == Type::Real || (equality && t == Type::Complex);
        if !fits(ta) || !fits(tb) {
            let (culprit, id) = if fits(ta) { (tb, b_id) } else { (ta, a_id) };
            let text = shortened(&print_expr(&self.file.exprs, id));
            let problem = Diagnostic::error(
                "type-mismatch",
                span,
                match culprit {
                    Type::Complex => "complex numbers have no order to compare by",
                    Type::Vector(_) => "vectors have no order to compare by",
                    _ => "conditions have no order to compare by",
                },
            );
            return self.report(match culprit {
                Type::Complex => problem.with_hint(format!(
                    "compare `abs({text})`, `re({text})` or `im({text})`"
                )),
                Type::Vector(_) => {
                    problem.with_hint(format!("compare components, or the length `|{text}|`"))
                }
                _ => problem.with_hint("join conditions with `and`, `or`, `not`"),
            });
        }
        let (Value::Scalar(mut a), Value::Scalar(mut b)) = (a.clone(), b.clone()) else {
            return Value::Error;
        };
        let prim = match op {
            CompareOp::Less | CompareOp::Greater => Prim::Less,
            CompareOp::LessEqual | CompareOp::GreaterEqual => Prim::LessEqual,
            CompareOp::Equal => Prim::Equal,
            CompareOp::NotEqual => Prim::NotEqual,
        };
        if matches!(op, CompareOp::Greater | CompareOp::GreaterEqual) {
            std::mem::swap(&mut a, &mut b);
        }
        Value::Scalar(self.graph.apply(prim, &[a, b]))
    }

    /// The first value whose condition holds; NaN where none does and there is no other.
    pub(super) fn choice(
        &mut self,
        arms: impl Iterator<Item = (ExprId, ExprId)>,
        otherwise: Option<ExprId>,
        span: Span,
    ) -> Value {
        let mut built = Vec::new();
        let mut failed = false;
        for (cond, value) in arms {
            let condition = match self.expr(cond) {
                Value::Scalar(id) if self.graph.ty(id) == Ty::Bool => Some(id),
                other => {
                    let span = self.span(cond);
                    self.condition_expected(&other, span);
                    None
                }
            };
            let value_span = self.span(value);
            let value = self.expr(value);
            failed |= condition.is_none() || value == Value::Error;
            built.push((condition, value, value_span));
        }
        let last = match otherwise {
            Some(otherwise) => (self.expr(otherwise), self.span(otherwise)),
            None => (self.undefined_like(built.first().map(|b| &b.1)), span),
        };
        if failed {
            return Value::Error;
        }
        let (mut value, mut span) = last;
        while let Some((condition, arm, arm_span)) = built.pop() {
            let Some(condition) = condition else {
                return Value::Error;
            };
            value = self.select(condition, (&arm, arm_span), (&value, span));
            span = arm_span;
        }
        value
    }

    fn undefined_like(&mut self, like: Option<&Value>) -> Value {
        let nan = self.graph.real(f64::NAN);
        match like {
            Some(Value::Vector(items)) => Value::Vector(SmallVec::from_elem(nan, items.len())),
            Some(Value::Error) => Value::Error,
            _ => Value::Scalar(nan),
        }
    }

    fn select(&mut self, condition: Id, a: (&Value, Span), b: (&Value, Span)) -> Value {
        match (a.0, b.0) {
            (Value::Error, _) | (_, Value::Error) => Value::Error,
            (Value::Scalar(x), Value::Scalar(y)) => {
                let (tx, ty) = (self.graph.ty(*x), self.graph.ty(*y));
                let (x, y) = if tx == Ty::Complex || ty == Ty::Complex {
                    (self.graph.widen(*x), self.graph.widen(*y))
                } else {
                    (*x, *y)
                };
                if self.graph.ty(x) != self.graph.ty(y) {
                    return self.branches_differ(a, b);
                }
                Value::Scalar(self.graph.apply(Prim::Select, &[condition, x, y]))
            }
            (Value::Vector(x), Value::Vector(y)) if x.len() == y.len() => Value::Vector(
                x.iter()
                    .zip(y)
                    .map(|(&x, &y)| self.graph.apply(Prim::Select, &[condition, x, y]))
                    .collect(),
            ),
            _ => self.branches_differ(a, b),
        }
    }

    fn branches_differ(&mut self, a: (&Value, Span), b: (&Value, Span)) -> Value {
        let (Some(ta), Some(tb)) = (a.0.ty(&self.graph), b.0.ty(&self.graph)) else {
            return Value::Error;
        };
        self.report(
            Diagnostic::error(
                "type-mismatch",
                b.1,
                format!(
                    "the branches differ: {} and {}",
                    ta.in_words(),
                    tb.in_words()
                ),
            )
            .with_label(format!("this is {}", tb.in_words()))
            .with_related(a.1, format!("this is {}", ta.in_words()))
            .with_hint(match (ta, tb) {
                (Type::Vector(_), Type::Vector(_)) => {
                    "give both the same number of components".to_owned()
                }
                (Type::Vector(_), Type::Real) => match self.text_at(b.1) {
                    Some(text) => {
                        format!("write `{ta}({text})` for a vector with that in each component")
                    }
                    None => format!("make a vector of it: `{ta}(…)`"),
                },
                _ => "both must be numbers, or vectors of one length".to_owned(),
            }),
        )
    }
}

/// How a value becomes what is wanted, in its own text.
fn advice_for(found: Type, wants_vector: bool, text: &str) -> String {
    let is_name = text.chars().all(|c| c.is_alphanumeric() || c == '_');
    match found {
        Type::Complex => format!("take `re({text})`, `im({text})` or `abs({text})`"),
        Type::Bool => format!("a condition is no number: `if {text} then 1 else 0` is one"),
        Type::Vector(_) if !wants_vector && is_name => {
            format!("take a component such as `{text}.x`, or the length `|{text}|`")
        }
        Type::Vector(_) if !wants_vector => format!("take a component, or the length `|{text}|`"),
        _ => super::builtins::advice(found, wants_vector).to_owned(),
    }
}
