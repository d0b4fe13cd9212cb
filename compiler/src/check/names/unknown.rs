//! Names that mean nothing, and what they may have been meant for.

use pullback_grammar::ast::{BinaryOp, Expr, ExprId, Name};
use pullback_grammar::diagnostic::MAX_DIAGNOSTICS;
use pullback_grammar::{Diagnostic, Span, print_expr};

use rustc_hash::FxHashMap;

use super::{FREE_NAMES, Walk};
use crate::check::suggest::{quoted, shortened};
use crate::check::{builtins, calculus, familiar, is_builtin_function, library, nearest};
use crate::table;

impl<'a> Walk<'a, '_> {
    /// `dy/dx`, `d/dx(x^2)`: a quotient of names that mean nothing is a derivative. Whether it is that.
    pub(super) fn leibniz(&mut self, whole: ExprId, lhs: ExprId, rhs: ExprId) -> bool {
        let Expr::Name(above) = &self.exprs[lhs] else {
            return false;
        };
        let (below, arg) = match &self.exprs[rhs] {
            Expr::Name(name) => (name, None),
            Expr::Call { callee, args, .. } => (callee, args.first()),
            _ => return false,
        };
        let (Some(of), Some(by)) = (above.text.strip_prefix('d'), below.text.strip_prefix('d'))
        else {
            return false;
        };
        let is_known = |name: &str| {
            self.is_value(name)
                || self.symbols.functions.contains_key(name)
                || is_builtin_function(name)
        };
        if by.is_empty() || is_known(&above.text) || is_known(&below.text) {
            return false;
        }
        let shown = arg.map(|&id| shortened(&print_expr(self.exprs, id)));
        let hint = match shown {
            Some(text) => format!("write `diff({text}, {})`", shortened(by)),
            None if of.is_empty() => {
                format!("a derivative is `diff(expression, {})`", shortened(by))
            }
            None => format!(
                "write `diff({}, {})`, where {0} is an expression or a local",
                shortened(of),
                shortened(by)
            ),
        };
        let span = self.exprs.span(whole);
        self.diagnostics.push(
            Diagnostic::error(
                "unknown-name",
                span,
                "a derivative is not written as a quotient",
            )
            .with_label("these names mean nothing")
            .with_hint(hint),
        );
        true
    }

    pub(super) fn unknown(&self, name: &Name) -> Diagnostic {
        let text = name.text.as_str();
        let problem = Diagnostic::error(
            "unknown-name",
            name.span,
            format!("unknown name {}", quoted(text)),
        )
        .with_label("not defined");
        if self.pending.last().is_some_and(|n| n.text == text) {
            let message = format!("{} is defined by itself", quoted(text));
            return Diagnostic::error("used-before-definition", name.span, message)
                .with_label("has no value yet")
                .with_hint("give what is meant another name: a local sees those before it");
        }
        if let Some(local) = self.pending.iter().rev().find(|n| n.text == text) {
            return Diagnostic::error(
                "used-before-definition",
                name.span,
                format!("{} is used before it is defined", quoted(text)),
            )
            .with_related(local.span, "defined here")
            .with_hint("each local sees those before it: move the definition up");
        }
        if self.diagnostics.len() > MAX_DIAGNOSTICS {
            // will not be listed
            return problem;
        }
        if let Some(place) = self.known_elsewhere(text) {
            return problem
                .with_related(
                    place,
                    format!(
                        "this {} is known inside of its own expression only",
                        quoted(text)
                    ),
                )
                .with_hint(
                    "define it where it is used, or give the value to the function as an argument",
                );
        }
        let in_plane = self.in_formula || ["x", "y"].iter().all(|n| self.scope.get(n).is_some());
        if matches!(text, "θ" | "theta") && self.current == Some("r") {
            let body = self
                .body
                .map(|id| print_expr(self.exprs, id))
                .unwrap_or_default();
            let curve = shortened(&body.replace(text, "atan2(y, x)"));
            return problem.with_hint(format!(
                "for the curve write `hypot(x, y) - ({curve})` alone"
            ));
        }
        if let Some(hint) = familiar::name(text, in_plane) {
            return problem.with_hint(hint);
        }
        let inputs: &[&str] = if self.in_formula { &FREE_NAMES } else { &[] };
        if let Some((vector, letters)) = text.split_once('_')
            && self.is_value(vector)
            && !letters.is_empty()
            && letters.chars().all(|c| "xyzw".contains(c))
        {
            return problem.with_hint(format!("did you mean `{vector}.{letters}`?"));
        }
        if let Some(product) = self.as_product(text) {
            return problem.with_hint(format!("for a product write `{product}`"));
        }
        if let Some(call) = self.as_call(text) {
            return problem.with_hint(format!("for a call write `{call}`"));
        }
        let candidates = self
            .scope
            .names()
            .chain(self.symbols.names())
            .chain(inputs.iter().copied())
            .chain(["pi", "tau", "phi", "e", "time", "pixel"]);
        match nearest(text, candidates) {
            Some(near) => problem.with_hint(format!("did you mean {}?", quoted(near))),
            None => problem.with_hint(format!(
                "define it: `{0} = …`, or `param {0} = 1 in 0..2` for a slider",
                shortened(text)
            )),
        }
    }

    /// An input that the definition which is walked does not have; said once for all that it lacks. Whether that is it.
    pub(super) fn missing_input(&mut self, name: &'a Name) -> bool {
        let text = name.text.as_str();
        if self.excused.contains(&text) {
            return true;
        }
        let Some(body) = self.body else { return false };
        if self.pending.iter().any(|n| n.text == text) {
            return false;
        }
        let (lacking, first) = self.lacking_inputs(body, name);
        let current = self.current.unwrap_or("f");
        let is_function = self.symbols.functions.contains_key(current);
        let message = format!("unknown name {}", quoted(&first.text));
        let problem = Diagnostic::error("unknown-name", first.span, message);
        self.diagnostics.push(if is_function {
            problem.with_label("not defined").with_hint(format!(
                "{}, or define it",
                self.how_to_take(&lacking.join(", "))
            ))
        } else {
            problem
                .with_label(format!(
                    "{} is a constant: no input is known in it",
                    quoted(current)
                ))
                .with_hint(self.hint_for_constant(current, body, &lacking))
        });
        self.excused.extend(lacking);
        self.excused.push(text);
        true
    }

    /// The inputs that an expression uses and that mean nothing here, in the order x, y, z, p, and the
    /// first of them.
    fn lacking_inputs(&self, body: ExprId, known: &'a Name) -> (Vec<&'static str>, &'a Name) {
        let mut found: Vec<&'a Name> = Vec::new();
        let exprs = self.exprs;
        let mut stack = vec![body];
        while let Some(id) = stack.pop() {
            if let Expr::Name(name) = &exprs[id] {
                found.push(name);
            }
            exprs[id].for_each_child(|child| stack.push(child));
        }
        let lacks = |name: &str| name == known.text || !self.is_value(name);
        let is_lacking =
            |name: &&'a Name| FREE_NAMES.contains(&name.text.as_str()) && lacks(&name.text);
        found.retain(is_lacking);
        let used = |name: &&&str| found.iter().any(|n| n.text == **name);
        let first = found.iter().copied().min_by_key(|name| name.span.start);
        let lacking = FREE_NAMES.iter().filter(used).copied().collect();
        (lacking, first.unwrap_or(known))
    }

    /// What `y = x^2` was meant for: a curve, a surface, or a function.
    fn hint_for_constant(&self, name: &str, body: ExprId, lacking: &[&str]) -> String {
        let text = shortened(&print_expr(self.exprs, body));
        let side = match &self.exprs[body] {
            Expr::Binary {
                op: BinaryOp::Add | BinaryOp::Sub,
                ..
            } => format!("({text})"),
            Expr::Where { .. } | Expr::If { .. } | Expr::Compare { .. } => format!("({text})"),
            _ => text.clone(),
        };
        let name = shortened(name);
        let inputs = lacking.join(", ");
        match (name.as_str(), lacking) {
            ("y", ["x"]) => {
                format!("for the curve write `y - {side}` alone; for a function `f(x) = {text}`")
            }
            ("x", ["y"]) => format!("for the curve write `x - {side}` alone"),
            ("z", ["x" | "y"] | ["x", "y"]) => format!(
                "for the surface write `z - {side}` alone; for a function `f({inputs}) = {text}`"
            ),
            _ => format!("for a function write `{name}({inputs}) = {text}`"),
        }
    }

    /// How the definition that is walked gets an input.
    fn how_to_take(&self, input: &str) -> String {
        let current = self.current.unwrap_or("f");
        match self.symbols.functions.get(current) {
            Some(function) => {
                let mut params: Vec<&str> = function
                    .params
                    .iter()
                    .map(|p| p.name.text.as_str())
                    .collect();
                params.push(input);
                format!(
                    "write `{}({}) = …`",
                    shortened(current),
                    shortened(&params.join(", "))
                )
            }
            None => format!("write `{}({input}) = …`", shortened(current)),
        }
    }

    /// `xy` as `x y`, where every letter has a meaning.
    fn as_product(&self, text: &str) -> Option<String> {
        let letters: Vec<String> = text.chars().take(9).map(String::from).collect();
        let known = |l: &String| self.is_value(l) || FREE_NAMES.contains(&l.as_str());
        ((2..=8).contains(&letters.len()) && letters.iter().all(known)).then(|| letters.join(" "))
    }

    /// `sinx` as `sin(x)`, where both parts have a meaning.
    fn as_call(&self, text: &str) -> Option<String> {
        let places = text.char_indices().map(|(at, _)| at).skip(2).take(12);
        let mut splits = places.map(|at| text.split_at(at));
        let is_call = |&(function, argument): &(&str, &str)| {
            let is_input = self.in_formula && FREE_NAMES.contains(&argument);
            is_builtin_function(function) && (self.is_value(argument) || is_input)
        };
        let (function, argument) = splits.find(is_call)?;
        Some(format!("{function}({})", shortened(argument)))
    }

    /// `xsin` as `x sin`, where both parts have a meaning.
    fn as_factor_and_call(&self, text: &'a str) -> Option<(&'a str, &'a str)> {
        let places = text.char_indices().map(|(at, _)| at).skip(1).take(4);
        let mut splits = places.map(|at| text.split_at(at));
        splits.find(|(factor, function)| {
            let is_value = self.is_value(factor) || self.in_formula && FREE_NAMES.contains(factor);
            is_value && function.len() > 1 && is_builtin_function(function)
        })
    }

    /// Where a name that means nothing here is a parameter, a local, a running variable or a state.
    fn known_elsewhere(&self, text: &str) -> Option<Span> {
        if FREE_NAMES.contains(&text) {
            return None;
        }
        self.bound
            .get_or_init(|| self.bound_names())
            .get(text)
            .copied()
    }

    /// The first place of every name that is bound somewhere in the program: parameters first.
    fn bound_names(&self) -> FxHashMap<String, Span> {
        let mut functions: Vec<_> = self.symbols.functions.values().collect();
        functions.sort_unstable_by_key(|function| function.span.start);
        let mut out: FxHashMap<String, Span> = FxHashMap::default();
        let mut bind = |name: &Name| {
            if !out.contains_key(&name.text) {
                out.insert(name.text.clone(), name.span);
            }
        };
        for function in functions {
            function.params.iter().for_each(|formal| bind(&formal.name));
        }
        for (_, expr, _) in self.exprs.iter() {
            match expr {
                Expr::Where { locals, .. } => locals
                    .iter()
                    .filter(|local| local.field.is_none())
                    .for_each(|local| bind(&local.name)),
                Expr::Series { ranges, .. } => ranges.iter().for_each(|range| bind(&range.name)),
                Expr::Integral { range, .. } => bind(&range.name),
                Expr::Iterate { states, .. } => states.iter().for_each(|state| bind(&state.0)),
                _ => {}
            }
        }
        out
    }

    pub(super) fn unknown_function(&self, callee: &Name, args: &[ExprId]) -> Diagnostic {
        let text = callee.text.as_str();
        let problem = Diagnostic::error(
            "unknown-function",
            callee.span,
            format!("unknown function {}", quoted(text)),
        )
        .with_label("not defined");
        if self.diagnostics.len() > MAX_DIAGNOSTICS {
            // will not be listed
            return problem;
        }
        let shown: Vec<String> = args
            .iter()
            .take(4)
            .map(|&id| shortened(&print_expr(self.exprs, id)))
            .collect();
        if let Some(hint) = familiar::function(text, &shown) {
            return problem.with_hint(hint);
        }
        if let Some((factor, function)) = self.as_factor_and_call(text) {
            return problem.with_hint(format!("for a product write `{factor} {function}`"));
        }
        let known = table::rows()
            .iter()
            .flat_map(|r| r.names.iter().copied())
            .chain(
                builtins::builtins()
                    .iter()
                    .flat_map(|b| b.names.iter().copied()),
            )
            .chain(library::library_functions().map(|f| f.name))
            .chain(calculus::operators().iter().map(|o| o.name))
            .chain(self.symbols.functions.keys().copied());
        match nearest(text, known) {
            Some(near) => problem.with_hint(format!("did you mean {}?", quoted(near))),
            None => problem.with_hint(format!(
                "define it: `{0}(x) = …`, or write a product as `{0} (…)`",
                shortened(text)
            )),
        }
    }

    /// How a function of one argument is written that has two elsewhere.
    pub(super) fn other_arity(&self, name: &str, args: &[ExprId]) -> Option<String> {
        let &[a, b] = args else { return None };
        let [a, b] = [a, b].map(|id| shortened(&print_expr(self.exprs, id)));
        match name {
            "log" | "ln" if a.parse::<f64>().is_ok() => Some(format!(
                "for the logarithm to base {a} write `log({b})/log({a})`"
            )),
            "log" | "ln" => Some(format!(
                "for the logarithm to base {b} write `log({a})/log({b})`"
            )),
            "round" => Some(format!("to {b} decimals: `round({a} 10^{b})/10^{b}`")),
            _ => None,
        }
    }
}
