//! Names: every name that is used must mean something, and no definition may need itself.

mod binding;

use pullback_grammar::ast::{BinaryOp, Expr, ExprId, Exprs, File, Function, Item, Name, Setting};
use pullback_grammar::diagnostic::MAX_DIAGNOSTICS;
use pullback_grammar::{Diagnostic, Span, print_expr};
use rustc_hash::{FxHashMap, FxHashSet};

mod calculus;

use super::scope::Scope;
use super::suggest::{quoted, shortened};
use super::symbols::reserved;
use super::{Symbols, builtins, familiar, is_builtin_function, is_builtin_value, library, nearest};
use crate::table;

/// Longest chain of functions that call each other.
pub const MAX_CALL_DEPTH: usize = 64;

/// Names that a bare formula may use for its inputs.
const FREE_NAMES: [&str; 4] = ["x", "y", "z", "p"];

/// Checks every name of a program, including in functions that no picture uses.
pub fn check_names<'a>(file: &'a File, symbols: &Symbols<'a>, diagnostics: &mut Vec<Diagnostic>) {
    let mut walk = Walk::new(&file.exprs, symbols, diagnostics);
    for item in &file.items {
        match item {
            Item::Function(function) => walk.function(function),
            Item::Constant(constant) => walk.definition(&constant.name.text, constant.value),
            Item::Param(param) => {
                let name = &param.name.text;
                walk.fixed(Some(name), "the default of a parameter", param.default);
                for end in param.range.iter().flat_map(|&(lo, hi)| [lo, hi]) {
                    walk.fixed(Some(name), "an end of a range", end);
                }
            }
            Item::Formula(formula) => walk.formula(formula.body),
            Item::Show(show) => {
                for &arg in &show.args {
                    // a function's name stands for the function here
                    if !matches!(&file.exprs[arg], Expr::Name(n) if symbols.functions.contains_key(n.text.as_str()))
                    {
                        walk.formula(arg);
                    }
                }
                walk.settings(&show.settings);
            }
        }
    }
    let uses = std::mem::take(&mut walk.uses);
    check_cycles(symbols, &uses, diagnostics);
}

/// The inputs that a bare formula uses, in the order x, y, z, p.
pub fn free_variables(file: &File, symbols: &Symbols, formula: ExprId) -> Vec<&'static str> {
    let mut ignored = Vec::new();
    let mut walk = Walk::new(&file.exprs, symbols, &mut ignored);
    walk.formula(formula);
    let free = std::mem::take(&mut walk.free);
    FREE_NAMES
        .into_iter()
        .filter(|name| free.contains(name))
        .collect()
}

struct Walk<'a, 'd> {
    exprs: &'a Exprs,
    symbols: &'d Symbols<'a>,
    diagnostics: &'d mut Vec<Diagnostic>,
    /// Names that hold here, each with whether it has been used since that was last asked.
    scope: Scope<'a, bool>,
    /// Locals whose definitions come later.
    pending: Vec<&'a Name>,
    /// Whether free variables are inputs.
    in_formula: bool,
    /// What must be a constant, if that is walked: no inputs, no parameters, no clock.
    fixed: Option<&'static str>,
    free: Vec<&'static str>,
    /// The definition that is being walked.
    current: Option<&'a str>,
    /// Its value.
    body: Option<ExprId>,
    /// Inputs that it lacks, which has been said.
    excused: Vec<&'a str>,
    /// Which definitions each definition uses, and where.
    uses: FxHashMap<&'a str, Vec<(&'a str, Span)>>,
}

impl<'a, 'd> Walk<'a, 'd> {
    fn new(
        exprs: &'a Exprs,
        symbols: &'d Symbols<'a>,
        diagnostics: &'d mut Vec<Diagnostic>,
    ) -> Self {
        Self {
            exprs,
            symbols,
            diagnostics,
            scope: Scope::default(),
            pending: Vec::new(),
            in_formula: false,
            fixed: None,
            free: Vec::new(),
            current: None,
            body: None,
            excused: Vec::new(),
            uses: FxHashMap::default(),
        }
    }

    fn function(&mut self, function: &'a Function) {
        let mut seen: Vec<&Name> = Vec::new();
        for formal in &function.params {
            if let Some(problem) = reserved(&formal.name) {
                self.diagnostics.push(problem);
            }
            if let Some(first) = seen.iter().find(|n| n.text == formal.name.text) {
                self.diagnostics.push(
                    Diagnostic::error(
                        "duplicate-parameter",
                        formal.name.span,
                        format!("{} is a parameter twice", quoted(&formal.name.text)),
                    )
                    .with_label("named again")
                    .with_related(first.span, "first here")
                    .with_hint("rename one of them"),
                );
            }
            seen.push(&formal.name);
            if let Some(ty) = &formal.ty
                && crate::types::Type::from_name(&ty.text).is_none()
            {
                self.diagnostics.push(unknown_type(ty));
            }
        }
        self.scope = function
            .params
            .iter()
            .map(|p| (p.name.text.as_str(), false))
            .collect();
        self.definition(&function.name.text, function.body);
        self.scope.truncate(0);
    }

    fn definition(&mut self, name: &'a str, body: ExprId) {
        self.current = Some(name);
        self.body = Some(body);
        self.expr(body);
        self.current = None;
        self.body = None;
        self.excused.clear();
    }

    /// An expression that must be a constant; `what` says which.
    fn fixed(&mut self, name: Option<&'a str>, what: &'static str, body: ExprId) {
        self.fixed = Some(what);
        self.current = name;
        self.expr(body);
        self.current = None;
        self.fixed = None;
    }

    /// The words of choices mean something to the scene only, and are not looked up.
    fn settings(&mut self, settings: &'a [Setting]) {
        for setting in settings {
            for value in [Some(setting.value), setting.upper].into_iter().flatten() {
                let is_input = |name: &Name| FREE_NAMES.contains(&name.text.as_str());
                if !matches!(&self.exprs[value], Expr::Name(name) if !is_input(name)) {
                    self.fixed(None, "a setting", value);
                }
            }
        }
    }

    fn formula(&mut self, body: ExprId) {
        self.in_formula = true;
        self.expr(body);
        self.in_formula = false;
    }

    /// Depth is bounded by the parser; left-leaning chains of operators are walked in a loop.
    fn expr(&mut self, id: ExprId) {
        let mut id = id;
        while let Expr::Binary { op, lhs, rhs } = &self.exprs[id] {
            if *op == BinaryOp::Div && self.leibniz(id, *lhs, *rhs) {
                return;
            }
            self.expr(*rhs);
            id = *lhs;
        }
        let exprs = self.exprs;
        match &exprs[id] {
            Expr::Error | Expr::Number(_) | Expr::Imaginary(_) | Expr::Binary { .. } => {}
            Expr::Name(name) => self.name(name),
            Expr::Unary { arg, .. } => self.expr(*arg),
            Expr::Compare { first, rest } => {
                self.expr(*first);
                rest.iter().for_each(|(_, e)| self.expr(*e));
            }
            Expr::Call {
                callee,
                primes,
                args,
            } => {
                if let Some(operator) = self.operator(callee) {
                    let span = exprs.span(id);
                    self.calculus(operator, (callee, span), *primes, args);
                    return;
                }
                if !self.primes(callee, exprs.span(id), *primes, args) {
                    self.callee(callee, args, exprs.span(id));
                }
                args.iter().for_each(|a| self.expr(*a));
            }
            Expr::Member { base, .. } => self.expr(*base),
            Expr::Vector(items) => items.iter().for_each(|e| self.expr(*e)),
            Expr::If {
                cond,
                then,
                otherwise,
            } => {
                [cond, then, otherwise]
                    .into_iter()
                    .for_each(|e| self.expr(*e));
            }
            Expr::Piecewise { arms, otherwise } => {
                for (cond, value) in arms {
                    self.expr(*cond);
                    self.expr(*value);
                }
                otherwise.iter().for_each(|e| self.expr(*e));
            }
            Expr::Where { body, locals } => self.locals(*body, locals),
            Expr::Series { ranges, term, .. } => self.series(ranges, *term),
            Expr::Iterate {
                count,
                states,
                steps,
                until,
            } => self.iteration(*count, states, steps, *until),
            Expr::Integral { body, range } => self.integral(*body, range),
        }
    }

    /// `dy/dx`, `d/dx(x^2)`: a quotient of names that mean nothing is a derivative. Whether it is that.
    fn leibniz(&mut self, whole: ExprId, lhs: ExprId, rhs: ExprId) -> bool {
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

    fn is_value(&self, name: &str) -> bool {
        self.scope.get(name).is_some()
            || self.symbols.constants.contains_key(name)
            || self.symbols.params.contains_key(name)
            || is_builtin_value(name)
    }

    fn name(&mut self, name: &'a Name) {
        let text = name.text.as_str();
        if let Some(used) = self.scope.get_mut(text) {
            *used = true;
            return;
        }
        if self.symbols.constants.contains_key(text) {
            self.record_use(text, name.span);
            return;
        }
        if self.is_value(text) {
            self.check_fixed(name);
            return;
        }
        if let Some(free) = FREE_NAMES.iter().find(|n| **n == text)
            && self.in_formula
        {
            if !self.free.contains(free) {
                self.free.push(free);
            }
            return;
        }
        if let Some(what) = self.fixed
            && FREE_NAMES.contains(&text)
        {
            self.diagnostics
                .push(not_constant(name.span, what).with_label("an input of formulas"));
            return;
        }
        if FREE_NAMES.contains(&text) && self.current.is_some() && self.missing_input(name) {
            return;
        }
        let problem = if self.symbols.functions.contains_key(text) || is_builtin_function(text) {
            Diagnostic::error(
                "function-without-call",
                name.span,
                format!("{} is a function", quoted(text)),
            )
            .with_label("needs its arguments")
            .with_hint(format!("write `{}`", self.usage(text)))
        } else {
            self.unknown(name)
        };
        self.diagnostics.push(problem);
    }

    /// Reports parameters and the clock where a constant is wanted.
    fn check_fixed(&mut self, name: &Name) {
        let Some(what) = self.fixed else { return };
        let text = name.text.as_str();
        let label = match text {
            "time" | "pixel" => "changes with the picture",
            _ if self.symbols.params.contains_key(text) => "a parameter",
            _ => return,
        };
        self.diagnostics
            .push(not_constant(name.span, what).with_label(label));
    }

    fn unknown(&self, name: &Name) -> Diagnostic {
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
    fn missing_input(&mut self, name: &'a Name) -> bool {
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
        let functions = self.symbols.functions.values();
        let mut formals = functions.flat_map(|function| &function.params);
        let is_it = |name: &&Name| name.text == text;
        let formal = formals.find(|formal| formal.name.text == text);
        let in_expr = |expr: &'a Expr| match expr {
            Expr::Where { locals, .. } => locals
                .iter()
                .filter(|local| local.field.is_none())
                .map(|local| &local.name)
                .find(is_it),
            Expr::Series { ranges, .. } => ranges.iter().map(|range| &range.name).find(is_it),
            Expr::Integral { range, .. } => Some(&range.name).filter(is_it),
            Expr::Iterate { states, .. } => states.iter().map(|state| &state.0).find(is_it),
            _ => None,
        };
        formal
            .map(|formal| &formal.name)
            .or_else(|| self.exprs.iter().find_map(|(_, expr, _)| in_expr(expr)))
            .map(|name| name.span)
    }

    fn usage(&self, name: &str) -> String {
        match self.symbols.functions.get(name) {
            Some(function) => signature(function),
            None => super::calculus::by_name(name)
                .map_or_else(|| format!("{name}(…)"), |o| o.usage.to_owned()),
        }
    }

    fn callee(&mut self, callee: &'a Name, args: &[ExprId], whole: Span) {
        let text = callee.text.as_str();
        let given = args.len();
        if let Some(function) = self.symbols.functions.get(text).copied() {
            self.record_use(text, callee.span);
            if function.params.len() != given {
                let problem = wrong_arity(
                    callee,
                    given,
                    &function.params.len().to_string(),
                    &listed(&[signature(function)]),
                )
                .with_related(function.name.span, "defined here");
                self.diagnostics.push(problem);
            }
            return;
        }
        if let Some((expected, usage)) = builtin_arity(text, given) {
            if let Some(expected) = expected {
                let problem = wrong_arity(callee, given, &expected, &usage);
                self.diagnostics.push(match self.other_arity(text, args) {
                    Some(hint) => problem.with_hint(hint),
                    None => problem,
                });
            }
            return;
        }
        let mut problem = self.unknown_function(callee, args);
        let hint = problem.hint.as_deref().unwrap_or_default();
        if hint.starts_with("write `") && hint.contains('(') || hint.starts_with("write `|") {
            // the hint is of the whole call
            problem.span = whole;
        }
        self.diagnostics.push(problem);
    }

    /// How a function of one argument is written that has two elsewhere.
    fn other_arity(&self, name: &str, args: &[ExprId]) -> Option<String> {
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

    fn unknown_function(&self, callee: &Name, args: &[ExprId]) -> Diagnostic {
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
            .chain(super::calculus::operators().iter().map(|o| o.name))
            .chain(self.symbols.functions.keys().copied());
        match nearest(text, known) {
            Some(near) => problem.with_hint(format!("did you mean {}?", quoted(near))),
            None => problem.with_hint(format!(
                "define it: `{0}(x) = …`, or write a product as `{0} (…)`",
                shortened(text)
            )),
        }
    }

    fn record_use(&mut self, used: &'a str, span: Span) {
        if let Some(current) = self.current {
            self.uses.entry(current).or_default().push((used, span));
        }
    }
}

/// What must be a constant is none.
pub fn not_constant(span: Span, what: &str) -> Diagnostic {
    Diagnostic::error("not-constant", span, format!("{what} must be a constant"))
        .with_hint("it may use numbers and constants, but no parameters, inputs or `time`")
}

fn unknown_type(ty: &Name) -> Diagnostic {
    let types = ["real", "complex", "vec2", "vec3", "vec4", "bool"];
    let message = format!("unknown type {}", quoted(&ty.text));
    let problem = Diagnostic::error("unknown-type", ty.span, message);
    let meant = match ty.text.as_str() {
        "float" | "double" | "f32" | "f64" | "int" | "integer" | "number" | "scalar" | "R" => {
            "real"
        }
        "C" | "complex64" | "complex128" => "complex",
        "boolean" | "truth" => "bool",
        _ => "",
    };
    match nearest(&ty.text, types) {
        _ if !meant.is_empty() => problem.with_hint(format!("write `{meant}`")),
        _ if ty.text.starts_with("vec") => {
            problem.with_hint("a vector has 2 to 4 components: `vec2`, `vec3` or `vec4`")
        }
        Some(near) => problem.with_hint(format!("did you mean {}?", quoted(near))),
        None => problem.with_hint("types are `real`, `complex`, `vec2`, `vec3` and `vec4`"),
    }
}

/// "`a`, `b` or `c`"
pub fn listed<S: AsRef<str>>(items: &[S]) -> String {
    let mut out = String::new();
    for (k, item) in items.iter().enumerate() {
        let joint = match items.len() - k {
            _ if k == 0 => "",
            1 => " or ",
            _ => ", ",
        };
        out.extend([joint, "`", item.as_ref(), "`"]);
    }
    out
}

/// `name(a, b: complex)`
pub fn signature(function: &Function) -> String {
    let params: Vec<String> = function
        .params
        .iter()
        .map(|p| match &p.ty {
            Some(ty) => format!("{}: {}", p.name.text, ty.text),
            None => p.name.text.clone(),
        })
        .collect();
    shortened(&format!("{}({})", function.name.text, params.join(", ")))
}

/// `fbm(p: vec2, octaves: real)` as `fbm(p, octaves)`.
fn without_types(usage: &str) -> String {
    let mut parts = usage.split(": ");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let rest = part.find([',', ')']).and_then(|at| part.get(at..));
        out.push_str(rest.unwrap_or_default());
    }
    out
}

fn wrong_arity(callee: &Name, given: usize, expected: &str, usage: &str) -> Diagnostic {
    let plural = if expected == "1" { "" } else { "s" };
    Diagnostic::error(
        "wrong-arity",
        callee.span,
        format!(
            "{} takes {expected} argument{plural}, not {given}",
            quoted(&callee.text)
        ),
    )
    .with_label(format!("called with {given}"))
    .with_hint(format!("it is written {usage}"))
}

/// For a builtin: what it expects where `given` is wrong, and how it is written.
fn builtin_arity(name: &str, given: usize) -> Option<(Option<String>, String)> {
    if let Some(builtin) = builtins::by_name(name) {
        let expected = (!builtin.arity.contains(&given)).then(|| {
            let (lo, hi) = (builtin.arity.start(), builtin.arity.end());
            if lo == hi {
                lo.to_string()
            } else {
                format!("{lo} to {hi}")
            }
        });
        return Some((expected, listed(&[builtin.usage])));
    }
    let row = table::by_name(name);
    let definitions = library::by_name(name).filter(|_| !library::is_private(name));
    let definitions = definitions.unwrap_or_default();
    let mut usages: Vec<&str> = definitions.iter().map(|f| f.usage.as_str()).collect();
    let mut arities: Vec<usize> = definitions.iter().map(|f| f.types.len()).collect();
    if let Some(row) = row {
        let variadic = matches!(row.prim, crate::ir::Prim::Min | crate::ir::Prim::Max);
        let arity = row.typing.arity();
        arities.push(if variadic { given.max(arity) } else { arity });
        usages.push(row.usage);
    }
    if usages.is_empty() {
        return None;
    }
    arities.sort_unstable();
    arities.dedup();
    // where the number is wrong, the types only make the list longer
    let plain: Vec<String> = usages.iter().map(|usage| without_types(usage)).collect();
    let mut plain: Vec<&str> = plain.iter().map(String::as_str).collect();
    if arities.len() > 1 {
        plain.dedup_by_key(|usage| usage.matches(',').count());
        usages = plain;
    }
    let expected = (!arities.contains(&given)).then(|| {
        let counts: Vec<String> = arities.iter().map(usize::to_string).collect();
        listed(&counts).replace('`', "")
    });
    Some((expected, listed(&usages)))
}

/// Reports definitions that need themselves, and chains of calls that are too long.
fn check_cycles(
    symbols: &Symbols,
    uses: &FxHashMap<&str, Vec<(&str, Span)>>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut names: Vec<&str> = uses.keys().copied().collect();
    names.sort_by_key(|n| uses[n].first().map(|u| u.1));
    let mut depth: FxHashMap<&str, usize> = FxHashMap::default();
    // a definition in a circle has no depth; it has been reported
    let mut cyclic: FxHashSet<&str> = FxHashSet::default();
    for start in names {
        if depth.contains_key(start) {
            continue;
        }
        let mut path: Vec<(&str, usize)> = vec![(start, 0)];
        let mut on_path: FxHashSet<&str> = FxHashSet::from_iter([start]);
        while let Some(&mut (name, ref mut next)) = path.last_mut() {
            let callees = uses.get(name).map_or(&[][..], Vec::as_slice);
            let Some(&(callee, span)) = callees.get(*next) else {
                let is_cyclic = cyclic.contains(name);
                let below = callees
                    .iter()
                    .filter_map(|(c, _)| depth.get(c))
                    .max()
                    .unwrap_or(&0)
                    + 1;
                depth.insert(name, if is_cyclic { 1 } else { below });
                on_path.remove(name);
                path.pop();
                continue;
            };
            *next += 1;
            if let Some(at) = on_path
                .contains(callee)
                .then(|| path.iter().position(|(n, _)| *n == callee))
                .flatten()
            {
                diagnostics.push(cycle(symbols, &path[at..], callee, span));
                cyclic.extend(path[at..].iter().map(|(n, _)| *n));
            } else if !depth.contains_key(callee) {
                on_path.insert(callee);
                path.push((callee, 0));
            }
        }
    }
    let too_deep = depth
        .iter()
        .filter(|(_, d)| **d > MAX_CALL_DEPTH)
        .min_by_key(|(n, d)| (**d, **n));
    let place = |name: &str| {
        let function = symbols.functions.get(name).map(|f| f.name.span);
        let constant = symbols.constants.get(name).map(|c| c.name.span);
        function
            .or(constant)
            .or(symbols.params.get(name).map(|(_, p)| p.name.span))
    };
    if let Some((name, _)) = too_deep {
        diagnostics.push(
            Diagnostic::error(
                "too-deep",
                place(name).unwrap_or_default(),
                format!("more than {MAX_CALL_DEPTH} definitions that use each other"),
            )
            .with_hint("join some of them"),
        );
    }
}

/// `a → b → a`; of a long circle, its beginning.
fn circle(path: &[(&str, usize)], callee: &str) -> String {
    let mut names: Vec<String> = path.iter().take(5).map(|(n, _)| shortened(n)).collect();
    if path.len() > 5 {
        names.push(format!("… {} more …", path.len() - 5));
    }
    names.push(shortened(callee));
    names.join(" → ")
}

fn cycle(symbols: &Symbols, path: &[(&str, usize)], callee: &str, span: Span) -> Diagnostic {
    let chain = circle(path, callee);
    if symbols.constants.contains_key(callee) {
        return Diagnostic::error(
            "cyclic-constant",
            span,
            format!("the constant {} needs its own value", quoted(callee)),
        )
        .with_label(&chain)
        .with_hint("break the circle with a number");
    }
    Diagnostic::error(
        "recursion",
        span,
        format!("{} calls itself", quoted(callee)),
    )
    .with_label(&chain)
    .with_hint("a formula has no recursion; repeat steps by `iterate(n, z = start, step)`, add up by `sum(k in 1..n, term)`")
}
