//! Calls of operators: what is differentiated, and by which variables.

use pullback_grammar::ast::{Expr, ExprId, Name};
use pullback_grammar::{Diagnostic, Span};
use smallvec::SmallVec;

use super::partial::Subject;
use super::{Kind, Operator, arguments};
use crate::check::suggest::quoted;
use crate::check::{Builder, Value, is_builtin_function, signature};
use crate::ir::Id;
use crate::types::Type;

impl<'a> Builder<'a> {
    /// Builds the call of an operator.
    pub(in crate::check) fn calculus(
        &mut self,
        operator: &'static Operator,
        args: &'a [ExprId],
        span: Span,
    ) -> Value {
        // what is wrong with the text has been reported by the pass over names
        let Some((&first, rest)) = args.split_first() else {
            return Value::Error;
        };
        match self.bare_function(first) {
            Some(name) if self.is_form(name) => self.form_as_function(operator, name),
            Some(name) if operator.kind == Kind::Diff => self.diff_function(name, rest, span),
            Some(name) => self.of_function(operator, name, rest, span),
            None if operator.kind == Kind::Diff => {
                let value = self.expr(first);
                self.diff(&value, rest, Subject::of(span, first))
            }
            None => self.of_expression(operator, first, rest, span),
        }
    }

    /// The name of a function that stands for the function.
    fn bare_function(&self, id: ExprId) -> Option<&'a Name> {
        let file = self.file;
        let Expr::Name(name) = &file.exprs[id] else {
            return None;
        };
        let text = name.text.as_str();
        let is_value = self.scope.get(text).is_some();
        let is_function = self.user_function(text).is_some() || is_builtin_function(text);
        (!is_value && is_function && !self.is_defined_value(text)).then_some(name)
    }

    /// Whether a name is an operator or another form that takes expressions, not a function of numbers.
    fn is_form(&self, name: &Name) -> bool {
        let text = name.text.as_str();
        let is_loop = matches!(text, "sum" | "product" | "iterate");
        (is_loop || super::by_name(text).is_some()) && self.user_function(text).is_none()
    }

    fn form_as_function(&mut self, operator: &Operator, name: &Name) -> Value {
        let text = &name.text;
        let message = format!("`{text}` is of expressions, and no function itself");
        self.report(
            Diagnostic::error("not-a-function", name.span, message)
                .with_label("cannot be differentiated by itself")
                .with_hint(format!(
                    "write out what is meant: `{}({text}(…), x, y)`",
                    operator.name
                )),
        )
    }

    /// `diff(e, x, y, 2)`
    fn diff(&mut self, value: &Value, rest: &'a [ExprId], subject: Subject) -> Value {
        let file = self.file;
        let Some(order) = arguments::variables(&file.exprs, rest) else {
            return Value::Error;
        };
        let mut names: SmallVec<[&'a Name; 4]> = SmallVec::new();
        for &name in &order {
            if !names.iter().any(|n| n.text == name.text) {
                names.push(name);
            }
        }
        let Some((mut value, leaves)) = self.opened_by(value, &names) else {
            return Value::Error;
        };
        for name in order {
            let Some(k) = names.iter().position(|n| n.text == name.text) else {
                return Value::Error;
            };
            let Value::Scalar(leaf) = leaves[k] else {
                return self.diff_by_vector(name, &leaves[k]);
            };
            value = match self.partial(&value, leaf, subject) {
                Some(value) => value,
                None => return Value::Error,
            };
        }
        value
    }

    fn diff_by_vector(&mut self, name: &Name, leaves: &Value) -> Value {
        let Some(ty) = leaves.ty(&self.graph) else {
            return Value::Error;
        };
        let message = format!(
            "{} is {}: `diff` is by one number",
            quoted(&name.text),
            ty.in_words()
        );
        let shown = crate::check::shortened(&name.text);
        self.report(
            Diagnostic::error("type-mismatch", name.span, message)
                .with_label(format!("this is {}", ty.in_words()))
                .with_hint(format!(
                    "grad(…, {shown}) has the derivatives by every component: grad(…, {shown}).x"
                )),
        )
    }

    /// `diff(f, x)`: of a function of one number at x, else of f at the parameters around by its parameter x.
    fn diff_function(&mut self, name: &'a Name, rest: &'a [ExprId], span: Span) -> Value {
        let file = self.file;
        let of_one = arguments::arities_of(self.user_function(&name.text), &name.text).contains(&1);
        let (points, order) = arguments::point_and_order(&file.exprs, rest);
        if of_one && let [point] = points.as_slice() {
            let at = self.expr(*point);
            let at_span = self.span(*point);
            return self.derivative_at(name, order, &at, at_span, span);
        }
        let Some(values) = self.around(name, "diff", span) else {
            return Value::Error;
        };
        let value = self.invoke(&name.text, values, &[], span);
        let value = self.as_number(value, span);
        let text = self.user_function(&name.text).map(|f| f.body);
        self.diff(&value, rest, Subject { span, text })
    }

    /// The parameters of the definition around a place, as the arguments of a function.
    fn around(&mut self, callee: &Name, operator: &str, span: Span) -> Option<Vec<Value>> {
        let values: Vec<Value> = self
            .frame
            .parameters
            .iter()
            .map(|(_, value)| value.clone())
            .collect();
        let function = self.user_function(&callee.text);
        let arities = arguments::arities_of(function, &callee.text);
        let fits = arities.contains(&values.len());
        if fits && !values.is_empty() {
            return Some(values);
        }
        let shown = crate::check::shortened(&callee.text);
        let message = match function {
            Some(f) if !values.is_empty() => format!(
                "`{operator}({shown})` is at the parameters around it, but those are not the ones of {}",
                signature(f)
            ),
            None if !values.is_empty() => {
                let count = values.len();
                let plural = if count == 1 { "" } else { "s" };
                format!(
                    "`{operator}({shown})` is at the parameters around it, and `{shown}` does not take {count} argument{plural}"
                )
            }
            _ => format!("`{operator}({shown})` without a point, and without parameters around it"),
        };
        self.report(
            Diagnostic::error("missing-variable", span, message)
                .with_label("where?")
                .with_hint(format!("name the point: `{operator}({shown})(…)`")),
        );
        None
    }

    /// `grad(f)(x, y)`
    fn of_function(
        &mut self,
        operator: &'static Operator,
        name: &'a Name,
        rest: &'a [ExprId],
        span: Span,
    ) -> Value {
        let (points, spans): (Vec<Value>, Vec<Span>) = if rest.is_empty() {
            match self.around(name, operator.name, span) {
                Some(values) => (values, Vec::new()),
                None => return Value::Error,
            }
        } else {
            rest.iter().map(|&a| (self.expr(a), self.span(a))).unzip()
        };
        let mut leaves = Vec::new();
        for point in &points {
            match self.leaves_like(point) {
                Some(leaf) => leaves.push(leaf),
                None => return self.no_variables(operator, point, span),
            }
        }
        let value = self.invoke(&name.text, leaves.clone(), &spans, span);
        let value = self.as_number(value, span);
        if value == Value::Error {
            return Value::Error;
        }
        let subject = Subject {
            span,
            text: self.user_function(&name.text).map(|f| f.body),
        };
        let Some(scalars) = self.real_variables(operator, &leaves, span) else {
            return Value::Error;
        };
        let Some(built) = self.operate(operator, &value, &scalars, subject) else {
            return Value::Error;
        };
        let pairs: Vec<(Id, Id)> = leaves
            .iter()
            .flat_map(Value::ids)
            .zip(points.iter().flat_map(Value::ids))
            .collect();
        self.replaced(&built, &pairs)
    }

    /// `grad(e, x, y)`
    fn of_expression(
        &mut self,
        operator: &'static Operator,
        first: ExprId,
        rest: &'a [ExprId],
        span: Span,
    ) -> Value {
        let value = self.expr(first);
        let opened = if rest.is_empty() {
            if self.frame.parameters.is_empty() {
                return self.no_parameters(operator, first, span);
            }
            Some(self.opened_by_parameters(&value))
        } else {
            let file = self.file;
            if let Some(twice) = arguments::named_twice(&file.exprs, rest) {
                return self.variable_twice(twice);
            }
            match arguments::variables(&file.exprs, rest) {
                Some(names) => self.opened_by(&value, &names),
                // what is no name has been reported by the pass over names
                None if rest.iter().all(|&r| matches!(file.exprs[r], Expr::Name(_))) => {
                    return self.wrong_count(operator, rest.len(), span);
                }
                None => None,
            }
        };
        let Some((value, leaves)) = opened else {
            return Value::Error;
        };
        let subject = Subject::of(span, first);
        self.real_variables(operator, &leaves, span)
            .and_then(|scalars| self.operate(operator, &value, &scalars, subject))
            .unwrap_or(Value::Error)
    }

    fn no_parameters(&mut self, operator: &Operator, first: ExprId, span: Span) -> Value {
        let shown = crate::check::shortened(&pullback_grammar::print_expr(&self.file.exprs, first));
        self.report(
            Diagnostic::error(
                "missing-variable",
                span,
                format!(
                    "`{}` without variables, and without parameters around it",
                    operator.name
                ),
            )
            .with_label("by what?")
            .with_hint(format!(
                "name the variables: `{}({shown}, x, y)`",
                operator.name
            )),
        )
    }

    /// The value in which only the variables vary, and their leaves.
    fn opened_by(&mut self, value: &Value, names: &[&'a Name]) -> Option<(Value, Vec<Value>)> {
        if *value == Value::Error {
            return None;
        }
        let texts: SmallVec<[&str; 4]> = names.iter().map(|n| n.text.as_str()).collect();
        match self.opened(value, &texts) {
            Ok(opened) => Some(opened),
            Err(at) => {
                // names without a meaning have been reported by the pass over names
                let name = names[at];
                let bound = self.scope.get(&name.text).cloned();
                let found = match bound {
                    Some(Value::Error) => return None,
                    Some(value) => value.ty(&self.graph).map(Type::in_words),
                    None => return None,
                };
                let found = found.unwrap_or("no number");
                let message = format!("{} is {found}, which is no variable", quoted(&name.text));
                self.report(
                    Diagnostic::error("not-a-variable", name.span, message)
                        .with_label(format!("this is {found}"))
                        .with_hint("differentiate by a name that stands for a number or a vector"),
                );
                None
            }
        }
    }

    /// The leaves of variables as reals; reports complex ones.
    fn real_variables(
        &mut self,
        operator: &Operator,
        leaves: &[Value],
        span: Span,
    ) -> Option<SmallVec<[Id; 4]>> {
        for leaf in leaves {
            let is_real = matches!(leaf.ty(&self.graph), Some(Type::Real | Type::Vector(_)));
            if !is_real {
                self.no_variables(operator, leaf, span);
                return None;
            }
        }
        let scalars: SmallVec<[Id; 4]> = leaves.iter().flat_map(Value::ids).collect();
        let numbers = operator.kind.numbers_of_variables();
        if numbers.contains(&scalars.len()) {
            return Some(scalars);
        }
        self.wrong_count(operator, scalars.len(), span);
        None
    }

    fn variable_twice(&mut self, name: &Name) -> Value {
        self.report(
            Diagnostic::error(
                "wrong-variables",
                name.span,
                format!("{} is named twice", quoted(&name.text)),
            )
            .with_label("named again")
            .with_hint("name each variable once"),
        )
    }

    fn wrong_count(&mut self, operator: &Operator, count: usize, span: Span) -> Value {
        let numbers = operator.kind.numbers_of_variables();
        let (lo, hi) = (*numbers.start(), *numbers.end());
        let wanted = match hi - lo {
            0 => lo.to_string(),
            1 => format!("{lo} or {hi}"),
            _ => format!("{lo} to {hi}"),
        };
        let problem = Diagnostic::error(
            "wrong-variables",
            span,
            format!(
                "`{}` is by {wanted} real variables, not {count}",
                operator.name
            ),
        )
        .with_label(format!("by {count}"));
        self.report(match count {
            1 => problem.with_hint("by one variable, write diff(…, x)"),
            _ => problem.with_hint(format!("name the variables: `{}`", operator.usage)),
        })
    }

    fn no_variables(&mut self, operator: &Operator, found: &Value, span: Span) -> Value {
        let Some(ty) = found.ty(&self.graph) else {
            return Value::Error;
        };
        let problem = Diagnostic::error(
            "wrong-variables",
            span,
            format!(
                "`{}` is by real variables, and one of them is {ty}",
                operator.name
            ),
        );
        self.report(match ty {
            Type::Complex => problem.with_hint(
                "take the parts as variables, f(x, y) with z = x + i y; the complex derivative is f'(z)",
            ),
            _ => problem.with_hint(format!("name the variables: `{}`", operator.usage)),
        })
    }
}
