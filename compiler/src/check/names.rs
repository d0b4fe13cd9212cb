//! Names: every name that is used must mean something, and no definition may need itself.

use pullback_grammar::ast::{Expr, ExprId, Exprs, File, Function, Item, Name};
use pullback_grammar::{Diagnostic, Span};
use rustc_hash::FxHashMap;

use super::symbols::reserved;
use super::{
    Symbols, builtins, is_builtin_function, is_builtin_value, is_reserved_function, library,
    nearest,
};
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
                walk.definition(&param.name.text, param.default);
                if let Some((lo, hi)) = param.range {
                    walk.definition(&param.name.text, lo);
                    walk.definition(&param.name.text, hi);
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
            }
        }
    }
    let uses = std::mem::take(&mut walk.uses);
    check_cycles(symbols, &uses, diagnostics);
}

/// The inputs that a bare formula uses, in the order of [`FREE_NAMES`].
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
    scope: Vec<&'a str>,
    /// Locals whose definitions come later.
    pending: Vec<&'a Name>,
    /// Whether free variables are inputs.
    in_formula: bool,
    free: Vec<&'static str>,
    /// The definition that is being walked.
    current: Option<&'a str>,
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
            scope: Vec::new(),
            pending: Vec::new(),
            in_formula: false,
            free: Vec::new(),
            current: None,
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
                        format!("`{}` is a parameter twice", formal.name.text),
                    )
                    .with_related(first.span, "first here"),
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
            .map(|p| p.name.text.as_str())
            .collect();
        self.definition(&function.name.text, function.body);
        self.scope.clear();
    }

    fn definition(&mut self, name: &'a str, body: ExprId) {
        self.current = Some(name);
        self.expr(body);
        self.current = None;
    }

    fn formula(&mut self, body: ExprId) {
        self.in_formula = true;
        self.expr(body);
        self.in_formula = false;
    }

    /// Depth is bounded by the parser; left-leaning chains of operators are walked in a loop.
    fn expr(&mut self, id: ExprId) {
        let mut id = id;
        while let Expr::Binary { lhs, rhs, .. } = &self.exprs[id] {
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
            Expr::Call { callee, args, .. } => {
                self.callee(callee, args.len());
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
        }
    }

    fn locals(&mut self, body: ExprId, locals: &'a [(Name, ExprId)]) {
        let depth = self.scope.len();
        let pending = self.pending.len();
        self.pending
            .extend(locals.iter().rev().map(|(name, _)| name));
        for (name, value) in locals {
            if let Some(problem) = reserved(name) {
                self.diagnostics.push(problem);
            }
            self.expr(*value);
            self.pending.pop();
            self.scope.push(&name.text);
        }
        self.pending.truncate(pending);
        self.expr(body);
        self.scope.truncate(depth);
    }

    fn is_value(&self, name: &str) -> bool {
        self.scope.contains(&name)
            || self.symbols.constants.contains_key(name)
            || self.symbols.params.contains_key(name)
            || is_builtin_value(name)
    }

    fn name(&mut self, name: &'a Name) {
        let text = name.text.as_str();
        if self.scope.contains(&text) {
            return;
        }
        if self.symbols.constants.contains_key(text) {
            self.record_use(text, name.span);
            return;
        }
        if self.is_value(text) {
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
        let problem = if self.symbols.functions.contains_key(text) || is_builtin_function(text) {
            Diagnostic::error(
                "function-without-call",
                name.span,
                format!("`{text}` is a function"),
            )
            .with_label("needs its arguments")
            .with_hint(format!("write {}", self.usage(text)))
        } else {
            self.unknown(name)
        };
        self.diagnostics.push(problem);
    }

    fn unknown(&self, name: &Name) -> Diagnostic {
        let text = name.text.as_str();
        let problem =
            Diagnostic::error("unknown-name", name.span, format!("unknown name `{text}`"))
                .with_label("not defined");
        if let Some(local) = self.pending.iter().rev().find(|n| n.text == text) {
            return Diagnostic::error(
                "used-before-definition",
                name.span,
                format!("`{text}` is used before it is defined"),
            )
            .with_related(local.span, "defined here")
            .with_hint("each local sees those before it: move the definition up");
        }
        let inputs: &[&str] = if self.in_formula { &FREE_NAMES } else { &[] };
        if let Some(product) = self.as_product(text) {
            return problem.with_hint(format!("for a product write `{product}`"));
        }
        let candidates = self
            .scope
            .iter()
            .copied()
            .chain(self.symbols.names())
            .chain(inputs.iter().copied())
            .chain(["pi", "tau", "phi", "e", "time", "pixel"]);
        match nearest(text, candidates) {
            Some(near) => problem.with_hint(format!("did you mean `{near}`?")),
            None if text == "z" && !self.in_formula => problem
                .with_hint("add z to the function's parameters, or define it with `where z = …`"),
            None => problem.with_hint(format!(
                "define it: `{text} = …`, or `param {text} = 1 in 0..2` for a slider"
            )),
        }
    }

    /// `xy` as `x y`, where every letter has a meaning.
    fn as_product(&self, text: &str) -> Option<String> {
        let letters: Vec<String> = text.chars().map(String::from).collect();
        let known =
            |l: &String| self.is_value(l) || (self.in_formula && FREE_NAMES.contains(&l.as_str()));
        (letters.len() > 1 && letters.iter().all(known)).then(|| letters.join(" "))
    }

    fn usage(&self, name: &str) -> String {
        match self.symbols.functions.get(name) {
            Some(function) => signature(function),
            None => format!("{name}(…)"),
        }
    }

    fn callee(&mut self, callee: &'a Name, given: usize) {
        let text = callee.text.as_str();
        if let Some(function) = self.symbols.functions.get(text).copied() {
            self.record_use(text, callee.span);
            if function.params.len() != given {
                let problem = wrong_arity(
                    callee,
                    given,
                    &function.params.len().to_string(),
                    &signature(function),
                )
                .with_related(function.name.span, "defined here");
                self.diagnostics.push(problem);
            }
            return;
        }
        if is_reserved_function(text) {
            self.diagnostics.push(
                Diagnostic::error(
                    "not-yet",
                    callee.span,
                    format!("`{text}` is not available in this version"),
                )
                .with_label("reserved for a later version"),
            );
            return;
        }
        if let Some((expected, usage)) = builtin_arity(text, given) {
            if let Some(expected) = expected {
                self.diagnostics
                    .push(wrong_arity(callee, given, &expected, &usage));
            }
            return;
        }
        self.diagnostics.push(self.unknown_function(callee));
    }

    fn unknown_function(&self, callee: &Name) -> Diagnostic {
        let text = callee.text.as_str();
        let problem = Diagnostic::error(
            "unknown-function",
            callee.span,
            format!("unknown function `{text}`"),
        )
        .with_label("not defined");
        let known = table::rows()
            .iter()
            .flat_map(|r| r.names.iter().copied())
            .chain(
                builtins::builtins()
                    .iter()
                    .flat_map(|b| b.names.iter().copied()),
            )
            .chain(library::library_functions().iter().map(|f| f.name))
            .chain(self.symbols.functions.keys().copied());
        match nearest(text, known) {
            Some(near) => problem.with_hint(format!("did you mean `{near}`?")),
            None => problem.with_hint(format!(
                "define it: `{text}(x) = …`, or write a product with a sign or a blank"
            )),
        }
    }

    fn record_use(&mut self, used: &'a str, span: Span) {
        if let Some(current) = self.current {
            self.uses.entry(current).or_default().push((used, span));
        }
    }
}

fn unknown_type(ty: &Name) -> Diagnostic {
    let types = ["real", "complex", "vec2", "vec3", "vec4", "bool"];
    let problem = Diagnostic::error(
        "unknown-type",
        ty.span,
        format!("unknown type `{}`", ty.text),
    );
    match nearest(&ty.text, types) {
        Some(near) => problem.with_hint(format!("did you mean `{near}`?")),
        None => problem.with_hint("types are real, complex, vec2, vec3, vec4 and bool"),
    }
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
    format!("{}({})", function.name.text, params.join(", "))
}

fn wrong_arity(callee: &Name, given: usize, expected: &str, usage: &str) -> Diagnostic {
    let plural = if given == 1 { "" } else { "s" };
    Diagnostic::error(
        "wrong-arity",
        callee.span,
        format!(
            "`{}` takes {expected}, not {given} argument{plural}",
            callee.text
        ),
    )
    .with_label(format!("called with {given}"))
    .with_hint(format!("it is written {usage}"))
}

/// For a builtin: what it expects where `given` is wrong, and how it is written.
fn builtin_arity(name: &str, given: usize) -> Option<(Option<String>, String)> {
    if let Some(row) = table::by_name(name) {
        let variadic = matches!(row.prim, crate::ir::Prim::Min | crate::ir::Prim::Max);
        let arity = row.typing.arity();
        let fits = given == arity || (variadic && given > arity);
        return Some(((!fits).then(|| arity.to_string()), row.usage.to_owned()));
    }
    if let Some(builtin) = builtins::by_name(name) {
        let expected = (!builtin.arity.contains(&given)).then(|| {
            let (lo, hi) = (builtin.arity.start(), builtin.arity.end());
            if lo == hi {
                lo.to_string()
            } else {
                format!("{lo} to {hi}")
            }
        });
        return Some((expected, builtin.usage.to_owned()));
    }
    let function = library::by_name(name)?;
    let arity = function.function.params.len();
    Some((
        (given != arity).then(|| arity.to_string()),
        signature(function.function),
    ))
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
    for start in names {
        let mut path: Vec<(&str, usize)> = vec![(start, 0)];
        while let Some(&mut (name, ref mut next)) = path.last_mut() {
            let callees = uses.get(name).map_or(&[][..], Vec::as_slice);
            let Some(&(callee, span)) = callees.get(*next) else {
                let below = callees
                    .iter()
                    .filter_map(|(c, _)| depth.get(c))
                    .max()
                    .unwrap_or(&0)
                    + 1;
                depth.insert(name, below);
                path.pop();
                continue;
            };
            *next += 1;
            if let Some(at) = path.iter().position(|(n, _)| *n == callee) {
                diagnostics.push(cycle(symbols, &path[at..], callee, span));
                depth.insert(callee, 1);
            } else if !depth.contains_key(callee) {
                path.push((callee, 0));
            }
        }
    }
    let too_deep = depth
        .iter()
        .filter(|(_, d)| **d > MAX_CALL_DEPTH)
        .min_by_key(|(n, d)| (**d, **n));
    if let Some((name, _)) = too_deep
        && let Some(function) = symbols.functions.get(name)
    {
        diagnostics.push(
            Diagnostic::error(
                "too-deep",
                function.name.span,
                format!("more than {MAX_CALL_DEPTH} definitions that use each other"),
            )
            .with_hint("join some of them"),
        );
    }
}

fn cycle(symbols: &Symbols, path: &[(&str, usize)], callee: &str, span: Span) -> Diagnostic {
    let mut chain: Vec<&str> = path.iter().map(|(n, _)| *n).collect();
    chain.push(callee);
    if symbols.constants.contains_key(callee) {
        return Diagnostic::error(
            "cyclic-constant",
            span,
            format!("the constant `{callee}` needs its own value"),
        )
        .with_label(chain.join(" → "))
        .with_hint("break the circle with a number");
    }
    Diagnostic::error("recursion", span, format!("`{callee}` calls itself"))
        .with_label(chain.join(" → "))
        .with_hint("a formula has no recursion; write the steps out")
}
