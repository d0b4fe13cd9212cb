//! Names in the operators of the calculus: their variables are uses, and a bare name of a function stands for it.

use pullback_grammar::ast::{Expr, ExprId, Name};
use pullback_grammar::{Diagnostic, Span, print_expr};

use super::super::calculus::{
    self, Kind, MAX_ORDER, Operator, arities_of, order, point_and_order, primes_misused, too_high,
};
use super::super::suggest::{quoted, shortened};
use super::super::{is_builtin_function, is_builtin_value};
use super::arity::wrong_arity;
use super::{FREE_NAMES, Walk, listed};

impl<'a> Walk<'a, '_> {
    /// The operator that a call means, where the program has no function of that name.
    pub(super) fn operator(&self, callee: &Name) -> Option<&'static Operator> {
        let is_own = self.symbols.functions.contains_key(callee.text.as_str());
        calculus::by_name(&callee.text).filter(|_| !is_own)
    }

    /// Reports primes that do not say what is meant; whether there were any such.
    pub(super) fn primes(
        &mut self,
        callee: &Name,
        span: Span,
        primes: u32,
        args: &[ExprId],
    ) -> bool {
        if primes == 0 {
            return false;
        }
        let text = callee.text.as_str();
        let own = self.symbols.functions.get(text).copied();
        if own.is_none() && !is_builtin_function(text) {
            // an unknown function is reported as such
            return false;
        }
        let shown: Vec<String> = args.iter().map(|&a| print_expr(self.exprs, a)).collect();
        let mut names = args.iter().filter_map(|&arg| self.candidate(arg));
        let variable = shortened(names.next().unwrap_or("x"));
        let arities = arities_of(own, text);
        let problem = primes_misused((callee, span), primes, &arities, &shown, &variable);
        let found = problem.is_some();
        self.diagnostics.extend(problem);
        found
    }

    /// The call of an operator.
    pub(super) fn calculus(
        &mut self,
        operator: &Operator,
        (callee, span): (&'a Name, Span),
        primes: u32,
        args: &'a [ExprId],
    ) {
        if primes > 0 {
            let message = format!("`{}` is no function of a number", operator.name);
            self.diagnostics.push(
                Diagnostic::error("prime-needs-one-variable", span, message)
                    .with_label("has no derivative")
                    .with_hint(match args.first() {
                        Some(&first) => format!(
                            "write `diff({}({}), x)`",
                            operator.name,
                            shortened(&print_expr(self.exprs, first))
                        ),
                        None => "write `diff(expression, x)`".to_owned(),
                    }),
            );
        }
        let Some((&first, rest)) = args.split_first() else {
            let problem = wrong_arity(callee, 0, "1 or more", &listed(&[operator.usage]));
            self.diagnostics.push(problem);
            return;
        };
        let depth = self.scope.len();
        match self.bare_function(first) {
            Some(name) => self.of_function(operator, span, (first, name), rest),
            None => {
                self.variables(operator, span, first, rest);
                self.expr(first);
            }
        }
        self.scope.truncate(depth);
    }

    /// The bare name of a function that stands for the function.
    fn bare_function(&self, arg: ExprId) -> Option<&'a Name> {
        let Expr::Name(name) = &self.exprs[arg] else {
            return None;
        };
        let text = name.text.as_str();
        let is_function = self.symbols.functions.contains_key(text) || is_builtin_function(text);
        (is_function && !self.is_value(text)).then_some(name)
    }

    /// `grad(f)(x, y)`: the arguments are a point.
    fn of_function(
        &mut self,
        operator: &Operator,
        span: Span,
        (first, name): (ExprId, &'a Name),
        rest: &'a [ExprId],
    ) {
        let text = name.text.as_str();
        let own = self.symbols.functions.get(text).copied();
        if own.is_some() {
            self.record_use(text, name.span);
        }
        let arities = arities_of(own, text);
        if operator.kind == Kind::Diff {
            let (points, _) = point_and_order(self.exprs, rest);
            if arities.contains(&1) && points.len() == 1 {
                self.expr(points[0]);
                return;
            }
            self.names_behind(operator, span, &shortened(text), first, rest);
            return;
        }
        rest.iter().for_each(|&point| self.expr(point));
        if rest.is_empty() {
            self.around(own.map(|f| {
                let names = f.params.iter();
                names.map(|p| p.name.text.as_str()).collect()
            }));
        } else if !arities.contains(&rest.len()) && !arities.is_empty() {
            let wanted: Vec<String> = arities.iter().map(usize::to_string).collect();
            let point = own.map_or_else(
                || "…".to_owned(),
                |f| {
                    let names: Vec<&str> = f.params.iter().map(|p| p.name.text.as_str()).collect();
                    names.join(", ")
                },
            );
            let usage = format!("{}({})({point})", operator.name, shortened(text));
            let problem = wrong_arity(name, rest.len(), &wanted.join(" or "), &quoted(&usage));
            self.diagnostics.push(problem);
        }
    }

    /// A function at the inputs of a bare formula: its parameters are inputs, where they are called so.
    fn around(&mut self, parameters: Option<Vec<&'a str>>) {
        if !self.in_formula {
            return;
        }
        for name in parameters.unwrap_or_default() {
            if let Some(free) = FREE_NAMES.iter().find(|f| **f == name)
                && !self.free.contains(free)
            {
                self.free.push(free);
            }
        }
    }

    /// The variables behind an expression.
    fn variables(&mut self, operator: &Operator, span: Span, first: ExprId, rest: &'a [ExprId]) {
        if operator.kind == Kind::Diff || !rest.is_empty() {
            let shown = shortened(&print_expr(self.exprs, first));
            self.names_behind(operator, span, &shown, first, rest);
        }
    }

    /// Names of variables, for `diff` with the orders behind them.
    fn names_behind(
        &mut self,
        operator: &Operator,
        span: Span,
        shown: &str,
        first: ExprId,
        rest: &'a [ExprId],
    ) {
        let is_diff = operator.kind == Kind::Diff;
        let mut total = 0;
        let mut repeatable = false;
        for &arg in rest {
            let repeats = order(self.exprs, arg).filter(|_| is_diff && repeatable);
            repeatable = false;
            match (&self.exprs[arg], repeats) {
                (Expr::Error, _) => return,
                (Expr::Name(name), _) => {
                    self.variable(name);
                    total += 1;
                    repeatable = true;
                }
                (_, Some(times)) => total += times - 1,
                (Expr::Number(value), None) if is_diff && *value > f64::from(MAX_ORDER) => {
                    total += order_of(*value);
                }
                _ => return self.not_a_variable(operator, shown, first, arg),
            }
        }
        if total == 0 {
            let name = shortened(self.candidate(first).unwrap_or("x"));
            let message = format!("`{}` does not say by which variable", operator.name);
            self.diagnostics.push(
                Diagnostic::error("missing-variable", span, message)
                    .with_label("by what?")
                    .with_hint(format!("write `{}({shown}, {name})`", operator.name)),
            );
        } else if is_diff {
            self.diagnostics.extend(too_high(span, total));
        }
    }

    /// A name that is differentiated by. One without a meaning is reported here, and not again in the expression.
    fn variable(&mut self, name: &'a Name) {
        let text = name.text.as_str();
        let is_constant = self.scope.get(text).is_none()
            && (self.symbols.constants.contains_key(text)
                || (is_builtin_value(text)
                    && !matches!(text, "time" | "pixel")
                    && !self.symbols.params.contains_key(text)));
        if is_constant {
            let message = format!("{} is a constant, not a variable", quoted(text));
            self.diagnostics.push(
                Diagnostic::error("not-a-variable", name.span, message)
                    .with_label("does not vary")
                    .with_hint(
                        "differentiate by a parameter, a local, an input, a `param` or `time`",
                    ),
            );
            return;
        }
        let before = self.diagnostics.len();
        self.name(name);
        if self.diagnostics.len() > before {
            self.scope.push(text, true);
        }
    }

    fn not_a_variable(&mut self, operator: &Operator, shown: &str, first: ExprId, arg: ExprId) {
        let span = self.exprs.span(arg);
        let problem = Diagnostic::error(
            "not-a-variable",
            span,
            format!("`{}` is by names of variables", operator.name),
        )
        .with_label("not a name");
        let in_shown = self.candidate(first);
        let candidate = shortened(self.candidate(arg).or(in_shown).unwrap_or("x"));
        let operator_name = operator.name;
        self.diagnostics.push(match &self.exprs[arg] {
            Expr::Member { base, .. } => {
                let base = shortened(&print_expr(self.exprs, *base));
                problem.with_hint(format!(
                    "name the components: with `where (…)`, or take a component of grad({shown}, {base})"
                ))
            }
            Expr::Number(value) if self.is_order(*value) => problem.with_hint(format!(
                "the order stands behind its variable: `{operator_name}({shown}, {candidate}, {value})`"
            )),
            Expr::Number(_) => problem.with_hint(format!(
                "an order is 1 to {MAX_ORDER}, and stands behind its variable: `{operator_name}({shown}, {candidate}, 2)`"
            )),
            _ => problem.with_hint(format!(
                "for the derivative at a point, define the function: g({candidate}) = {shown}, and write g'(…)"
            )),
        });
        self.expr(arg);
    }

    /// Whether a number can be the order of a derivative.
    fn is_order(&self, value: f64) -> bool {
        (1..=MAX_ORDER).any(|order| f64::from(order) == value)
    }

    /// The first name in an expression that varies here.
    fn candidate(&self, id: ExprId) -> Option<&'a str> {
        let mut stack = vec![id];
        let mut steps = 0;
        while let Some(id) = stack.pop() {
            steps += 1;
            if steps > 200 {
                return None;
            }
            if let Expr::Name(name) = &self.exprs[id] {
                let text = name.text.as_str();
                let is_input = self.in_formula && FREE_NAMES.contains(&text);
                if self.scope.get(text).is_some() || is_input {
                    return Some(text);
                }
            }
            let at = stack.len();
            self.exprs[id].for_each_child(|child| stack.push(child));
            stack[at..].reverse();
        }
        None
    }
}

/// A number as an order that is too high, as far as such can be told.
fn order_of(value: f64) -> u32 {
    if value < f64::from(u32::MAX / 2) {
        // in range, and whole numbers are what is written
        value.ceil() as u32 - 1
    } else {
        u32::MAX / 2
    }
}
