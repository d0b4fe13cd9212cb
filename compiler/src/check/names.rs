//! Names: every name that is used must mean something, and no definition may need itself.

mod arity;
mod binding;
mod calculus;
mod unknown;

use std::cell::OnceCell;

use pullback_grammar::ast::{BinaryOp, Expr, ExprId, Exprs, File, Function, Item, Name, Setting};
use pullback_grammar::{Diagnostic, Span};
use rustc_hash::{FxHashMap, FxHashSet};

use super::scope::Scope;
use super::suggest::{quoted, shortened};
use super::symbols::reserved;
use super::{Symbols, is_builtin_function, is_builtin_value, nearest};
use arity::{builtin_arity, wrong_arity};

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
    /// Every name that is bound somewhere, looked up once there is an unknown one.
    bound: OnceCell<FxHashMap<String, Span>>,
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
            bound: OnceCell::new(),
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
            Expr::Integral { body, range, .. } => self.integral(*body, range),
        }
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

/// `name(a, b: complex)`, cut where it is long.
pub fn signature(function: &Function) -> String {
    shortened(&whole_signature(function))
}

/// `name(a, b: complex)`
pub fn whole_signature(function: &Function) -> String {
    let params: Vec<String> = function
        .params
        .iter()
        .map(|p| match &p.ty {
            Some(ty) => format!("{}: {}", p.name.text, ty.text),
            None => p.name.text.clone(),
        })
        .collect();
    format!("{}({})", function.name.text, params.join(", "))
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
