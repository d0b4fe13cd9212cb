//! A whole program: its parameters and the pictures that it shows.

use pullback_grammar::ast::{Expr, ExprId, File, Function, Item, Param, Show};
use pullback_grammar::diagnostic::limit;
use pullback_grammar::{Diagnostic, Span};

use rustc_hash::{FxHashMap, FxHashSet};

use crate::check::{
    Builder, MAX_PARAMS, Symbols, Value, check_names, free_variables, is_builtin_function, nearest,
    not_constant, quoted, shortened, signature,
};
use crate::formula::{Formula, Input, argument_value, scalar_types};
use crate::ir::{Graph, Id};
use crate::scene::{Scene, SettingKind, SettingSpec, Space, default_scene, scene, scenes};
use crate::types::Type;

/// A parameter: a number that can change without compiling again.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamInfo {
    /// Its name.
    pub name: String,
    /// Value at the start.
    pub default: f64,
    /// Lower end of the slider.
    pub lo: f64,
    /// Upper end of the slider.
    pub hi: f64,
}

/// A setting of a picture with its value.
#[derive(Clone, Debug)]
pub struct SettingValue {
    /// What it is.
    pub spec: &'static SettingSpec,
    /// Its components; for a choice, the place of the word.
    pub value: [f64; 3],
}

/// One picture: a scene, its settings, and the formula that it shows.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The scene.
    pub scene: &'static Scene,
    /// Every setting of the scene.
    pub settings: Vec<SettingValue>,
    /// What is shown.
    pub formula: Formula,
}

impl Picture {
    /// The value of a setting.
    #[must_use]
    pub fn setting(&self, name: &str) -> Option<[f64; 3]> {
        self.settings
            .iter()
            .find(|s| s.spec.name == name)
            .map(|s| s.value)
    }
}

/// A program without errors.
#[derive(Clone, Debug)]
pub struct Program {
    params: Vec<ParamInfo>,
    pictures: Vec<Picture>,
}

impl Program {
    /// The parameters in the order of the text.
    #[must_use]
    pub fn params(&self) -> &[ParamInfo] {
        &self.params
    }

    /// One picture for each `show`, or the default one. Never empty.
    #[must_use]
    pub fn pictures(&self) -> &[Picture] {
        &self.pictures
    }
}

/// What compiling a text gives.
#[derive(Clone, Debug)]
pub struct Compilation {
    /// The program, where there are no errors.
    pub program: Option<Program>,
    /// Everything that was found, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
}

/// Compiles a program: parses it, resolves names and types, and builds the IR of what it shows.
///
/// Never fails: problems are diagnostics, all of them from one pass.
#[must_use]
pub fn compile(source: &str) -> Compilation {
    from_parsed(pullback_grammar::parse(source, &is_builtin_function))
}

/// [`compile`] for text that may not be UTF-8.
#[must_use]
pub fn compile_bytes(source: &[u8]) -> Compilation {
    from_parsed(pullback_grammar::parse_bytes(source, &is_builtin_function))
}

fn from_parsed(parsed: pullback_grammar::Parsed) -> Compilation {
    let mut diagnostics = parsed.diagnostics;
    let file = &parsed.file;
    let symbols = Symbols::collect(file, &mut diagnostics);
    check_names(file, &symbols, &mut diagnostics);
    let in_order = |d: &Diagnostic| d.span;
    diagnostics.sort_by_key(in_order);
    limit(&mut diagnostics);
    let mut checker = Checker {
        file,
        symbols: &symbols,
        diagnostics,
        called: FxHashSet::default(),
    };
    let params = checker.params();
    let pictures = checker.pictures();
    checker.unused_functions();
    let mut diagnostics = checker.diagnostics;
    let failed = diagnostics.iter().any(Diagnostic::is_error);
    if !failed && pictures.is_empty() {
        diagnostics.push(
            Diagnostic::error(
                "internal-silent",
                Span::default(),
                "the program cannot be shown",
            )
            .with_hint("this is a mistake in pullback; please report the program"),
        );
    }
    diagnostics.sort_by(|a, b| {
        (a.span, a.severity, a.code, &a.message).cmp(&(b.span, b.severity, b.code, &b.message))
    });
    diagnostics.dedup_by(|a, b| a.span == b.span && a.code == b.code && a.message == b.message);
    limit(&mut diagnostics);
    let program = (!failed && !pictures.is_empty()).then_some(Program { params, pictures });
    Compilation {
        program,
        diagnostics,
    }
}

/// Types that are tried for the parameters of a function that nothing calls.
const GENERIC: [Type; 5] = [
    Type::Real,
    Type::Complex,
    Type::Vector(2),
    Type::Vector(3),
    Type::Vector(4),
];

/// Greatest number of `show` statements of a program.
pub const MAX_SHOWS: usize = 64;

/// Greatest number of times that such functions are built, all together.
const MAX_ATTEMPTS: usize = 2000;

/// What a picture shows: a function, or a formula in free variables.
#[derive(Clone, Copy)]
enum Subject<'a> {
    Function(&'a Function),
    Formula(ExprId),
}

struct Checker<'a> {
    file: &'a File,
    symbols: &'a Symbols<'a>,
    diagnostics: Vec<Diagnostic>,
    /// Functions that something shown, or a constant, has called: they are checked.
    called: FxHashSet<&'a str>,
}

impl<'a> Checker<'a> {
    fn builder(&self) -> Builder<'a> {
        Builder::new(self.file, self.symbols)
    }

    /// Takes over what a builder found.
    fn finish(&mut self, builder: &mut Builder<'a>) {
        self.diagnostics.append(&mut builder.diagnostics);
        self.called.extend(builder.called());
    }

    /// Whether an error lies in this part of the text: what follows from it is not reported.
    fn has_error_in(&self, span: Span) -> bool {
        self.diagnostics
            .iter()
            .any(|d| d.is_error() && span.start <= d.span.start && d.span.end <= span.end)
    }

    fn params(&mut self) -> Vec<ParamInfo> {
        let file = self.file;
        let params = file.items.iter().filter_map(|item| match item {
            Item::Param(param) => Some(param),
            _ => None,
        });
        // more have been refused
        params
            .take(MAX_PARAMS)
            .map(|param| self.param(param))
            .collect()
    }

    fn param(&mut self, param: &'a Param) -> ParamInfo {
        let default = self
            .constant(param.default, "the default of a parameter")
            .unwrap_or(0.0);
        let reach = default.abs().max(1.0);
        let (mut lo, mut hi) = (default - reach, default + reach);
        if let Some((from, to)) = param.range {
            lo = self.constant(from, "an end of a range").unwrap_or(lo);
            hi = self.constant(to, "an end of a range").unwrap_or(hi);
            let span = self.file.exprs.span(from).join(self.file.exprs.span(to));
            if lo >= hi {
                self.diagnostics.push(
                    Diagnostic::error("bad-range", span, format!("the range {lo}..{hi} is empty"))
                        .with_label("the first end must be the lesser one")
                        .with_hint(if lo > hi {
                            format!("write {hi}..{lo}")
                        } else {
                            "write two different ends".to_owned()
                        }),
                );
            } else if !(lo..=hi).contains(&default) {
                self.diagnostics.push(
                    Diagnostic::error(
                        "default-outside-range",
                        self.file.exprs.span(param.default),
                        format!("the default {default} is not in {lo}..{hi}"),
                    )
                    .with_related(span, "the range")
                    .with_hint(format!(
                        "write {}..{} to include it",
                        lo.min(default),
                        hi.max(default)
                    )),
                );
            }
        }
        ParamInfo {
            name: param.name.text.clone(),
            default,
            lo,
            hi,
        }
    }

    /// The value of a real constant expression; reports one that is not.
    fn constant(&mut self, expr: ExprId, what: &str) -> Option<f64> {
        let span = self.file.exprs.span(expr);
        let (value, graph) = self.constant_value(expr)?;
        match value.ty(&graph)? {
            Type::Real => self.finite(&value, &graph, expr, what),
            ty => {
                let problem = Diagnostic::error(
                    "type-mismatch",
                    span,
                    format!("{what} must be real, this is {ty}"),
                );
                self.diagnostics.push(if ty == Type::Complex {
                    problem.with_hint("use one parameter for each part, as in `a + b i`")
                } else {
                    problem.with_hint("use one parameter for each number")
                });
                None
            }
        }
    }

    /// Builds an expression that must be constant. Warnings are left out where the value is refused anyway.
    fn constant_value(&mut self, expr: ExprId) -> Option<(Value, Graph)> {
        let mut builder = self.builder();
        let value = builder.expr(expr);
        let is_number = |id: &Id| builder.graph.as_real(*id).is_none_or(f64::is_finite);
        if !value.ids().iter().all(is_number) {
            builder.diagnostics.retain(Diagnostic::is_error);
        }
        self.finish(&mut builder);
        (value != Value::Error).then_some((value, builder.graph))
    }

    fn finite(&mut self, value: &Value, graph: &Graph, expr: ExprId, what: &str) -> Option<f64> {
        let span = self.file.exprs.span(expr);
        let number = value.ids().first().and_then(|&id| graph.as_real(id));
        match number {
            Some(x) if x.is_finite() => Some(x),
            Some(x) => {
                self.diagnostics.push(
                    Diagnostic::error(
                        "not-finite",
                        span,
                        format!("{what} is {}", infinity_or_nan(x)),
                    )
                    .with_hint("write a finite number"),
                );
                None
            }
            None => {
                if !self.has_error_in(span) {
                    self.diagnostics.push(not_constant(span, what));
                }
                None
            }
        }
    }

    fn pictures(&mut self) -> Vec<Picture> {
        let file = self.file;
        let shows: Vec<&Show> = file
            .items
            .iter()
            .filter_map(|item| match item {
                Item::Show(show) => Some(show),
                _ => None,
            })
            .collect();
        self.check_formulas();
        if shows.is_empty() {
            return self.default_picture().into_iter().collect();
        }
        if let Some(show) = shows.get(MAX_SHOWS) {
            self.diagnostics.push(
                Diagnostic::error(
                    "too-many-shows",
                    show.span,
                    format!("more than {MAX_SHOWS} pictures"),
                )
                .with_hint("put some of them into a program of their own"),
            );
        }
        shows
            .into_iter()
            .take(MAX_SHOWS)
            .filter_map(|show| self.picture(show))
            .collect()
    }

    /// At most one bare formula can be meant.
    fn check_formulas(&mut self) {
        let formulas: Vec<_> = self
            .file
            .items
            .iter()
            .filter_map(|item| match item {
                Item::Formula(formula) => Some(formula.span),
                _ => None,
            })
            .collect();
        for &span in formulas.iter().skip(1) {
            self.diagnostics.push(
                Diagnostic::error("two-formulas", span, "a second bare formula")
                    .with_related(formulas[0], "the first one")
                    .with_hint("name them, `f(x, y) = …`, and `show` each"),
            );
        }
    }

    fn default_picture(&mut self) -> Option<Picture> {
        let file = self.file;
        let formula = file.items.iter().find_map(|item| match item {
            Item::Formula(formula) => Some(Subject::Formula(formula.body)),
            _ => None,
        });
        let named = self.symbols.functions.get("f").copied();
        let last = file.items.iter().rev().find_map(|item| match item {
            Item::Function(function) => Some(function),
            _ => None,
        });
        let Some(subject) = formula.or(named.or(last).map(Subject::Function)) else {
            if !self.diagnostics.iter().any(Diagnostic::is_error) {
                self.diagnostics.push(
                    Diagnostic::error(
                        "nothing-to-show",
                        Span::default(),
                        "there is no formula to show",
                    )
                    .with_hint("write one, such as sin(x^2 + y^2)"),
                );
            }
            return None;
        };
        let space = self.default_space(subject)?;
        let span = self.subject_span(subject);
        let formula = self.formula(subject, space, span)?;
        let mut space = space;
        if space == Space::Plane && formula.ty == Type::Complex {
            space = Space::Complex;
        }
        let scene = default_scene(space);
        let formula = self.check_result(scene, &formula, subject, span)?;
        Some(Picture {
            scene,
            settings: default_settings(scene),
            formula,
        })
    }

    fn subject_span(&self, subject: Subject) -> Span {
        match subject {
            Subject::Function(function) => function.name.span,
            Subject::Formula(body) => self.file.exprs.span(body),
        }
    }

    /// Checks functions that nothing calls. Where parameters have no fixed type, types are looked for with which
    /// the function makes sense; if there are none, what is wrong with it for reals is reported.
    fn unused_functions(&mut self) {
        let mut attempts = MAX_ATTEMPTS;
        let functions = self.file.items.iter().filter_map(|item| match item {
            Item::Function(function) => Some(function),
            _ => None,
        });
        for function in functions {
            let is_current = self
                .symbols
                .functions
                .get(function.name.text.as_str())
                .is_some_and(|f| std::ptr::eq(*f, function));
            if is_current
                && !self.called.contains(function.name.text.as_str())
                && !self.has_error_in(function.span)
            {
                self.unused_function(function, &mut attempts);
            }
        }
    }

    fn unused_function(&mut self, function: &'a Function, attempts: &mut usize) {
        let declared = declared(function);
        let is_plain_z = matches!(declared.as_slice(), [("z", None)]);
        let fixed: Vec<Option<Type>> = declared
            .iter()
            .map(|d| d.1.or(is_plain_z.then_some(Type::Complex)))
            .collect();
        let open = fixed.iter().filter(|t| t.is_none()).count();
        if open > 2 {
            return;
        }
        let mut of_reals = None;
        for first in GENERIC {
            for second in GENERIC {
                if *attempts == 0 {
                    return;
                }
                *attempts -= 1;
                let mut choices = [first, second].into_iter();
                let types: Vec<Type> = fixed
                    .iter()
                    .map(|t| t.or_else(|| choices.next()).unwrap_or(first))
                    .collect();
                let mut builder = self.attempt(function, &types);
                // a large function counts as many
                *attempts = attempts.saturating_sub(builder.graph.nodes().len() / 200);
                if builder.graph.budget().is_err() {
                    return;
                }
                if !builder.diagnostics.iter().any(Diagnostic::is_error) {
                    if open > 0 {
                        // a warning may be due to the types that were tried
                        builder.diagnostics.clear();
                    }
                    self.finish(&mut builder);
                    return;
                }
                let found = std::mem::take(&mut builder.diagnostics);
                self.called.extend(builder.called());
                of_reals.get_or_insert(found);
                if open < 2 {
                    break;
                }
            }
            if open == 0 {
                break;
            }
        }
        let found = of_reals.unwrap_or_default();
        let too_deep = |d: &Diagnostic| d.code == "too-deep";
        if !(found.iter().any(too_deep) && self.diagnostics.iter().any(too_deep)) {
            self.diagnostics.extend(found);
        }
    }

    fn attempt(&self, function: &'a Function, types: &[Type]) -> Builder<'a> {
        let mut builder = self.builder();
        let mut values = Vec::new();
        let mut first = 0;
        for &ty in types {
            values.push(argument_value(&mut builder.graph, first, ty));
            first += scalar_types(ty).len();
        }
        builder.call_function(function, values, &[], function.name.span);
        builder
    }

    /// The space that a function or formula lives in by its inputs.
    fn default_space(&mut self, subject: Subject<'a>) -> Option<Space> {
        let function = match subject {
            Subject::Function(function) => function,
            Subject::Formula(body) => {
                let free = free_variables(self.file, self.symbols, body);
                return Some(match free.as_slice() {
                    ["z"] => Space::Complex,
                    names if names.contains(&"p") || names.contains(&"z") => Space::Space,
                    _ => Space::Plane,
                });
            }
        };
        let declared = declared(function);
        let problem = match declared.as_slice() {
            [] | [_, _] => return Some(Space::Plane),
            [_, _, _] => return Some(Space::Space),
            [(_, Some(Type::Complex)) | ("z", None)] => return Some(Space::Complex),
            [(_, Some(Type::Vector(2) | Type::Real)) | ("x" | "y", None)] => {
                return Some(Space::Plane);
            }
            [(_, Some(Type::Vector(3))) | ("p", None)] => return Some(Space::Space),
            [(name, None)] => Diagnostic::error(
                "ambiguous-input",
                function.params[0].name.span,
                format!("what {} is cannot be told", quoted(name)),
            )
            .with_hint(format!(
                "write `{0}: real`, `{0}: complex`, `{0}: vec2` or `{0}: vec3`",
                shortened(name)
            )),
            _ => Diagnostic::error(
                "no-scene",
                function.name.span,
                "no scene shows a function of these inputs",
            )
            .with_hint("a picture needs f(x, y), f(z) or f(x, y, z)"),
        };
        self.diagnostics.push(problem);
        None
    }

    fn picture(&mut self, show: &'a Show) -> Option<Picture> {
        if show.scene.text.is_empty() {
            // the parser has reported that it is missing
            return None;
        }
        let Some(scene) = scene(&show.scene.text) else {
            let names = scenes().iter().map(|s| s.name);
            let list: Vec<&str> = names.clone().collect();
            let problem = Diagnostic::error(
                "unknown-scene",
                show.scene.span,
                format!("unknown scene {}", quoted(&show.scene.text)),
            );
            self.diagnostics
                .push(match nearest(&show.scene.text, names) {
                    Some(near) => problem.with_hint(format!("did you mean `{near}`?")),
                    None => problem.with_hint(format!("scenes are {}", list.join(", "))),
                });
            return None;
        };
        let &[arg] = show.args.as_slice() else {
            self.settings_of(scene, show);
            if show.args.is_empty() {
                // reported by the parser
                return None;
            }
            self.diagnostics.push(
                Diagnostic::error(
                    "wrong-arity",
                    show.span,
                    format!(
                        "`{}` shows one function, not {}",
                        scene.name,
                        show.args.len()
                    ),
                )
                .with_hint(format!("write `show {}(f)`", scene.name)),
            );
            return None;
        };
        let subject = match &self.file.exprs[arg] {
            Expr::Name(name) => match self.symbols.functions.get(name.text.as_str()) {
                Some(function) => Subject::Function(function),
                None => Subject::Formula(arg),
            },
            _ => Subject::Formula(arg),
        };
        let span = self.file.exprs.span(arg);
        let formula = self.formula(subject, scene.space, span);
        let settings = self.settings_of(scene, show);
        self.check_result(scene, &formula?, subject, span)
            .map(|formula| Picture {
                scene,
                settings,
                formula,
            })
    }

    fn check_result(
        &mut self,
        scene: &Scene,
        formula: &Formula,
        subject: Subject,
        span: Span,
    ) -> Option<Formula> {
        let fits = match scene.space {
            Space::Plane | Space::Space => formula.ty == Type::Real,
            Space::Complex => matches!(formula.ty, Type::Real | Type::Complex),
        };
        if fits {
            return Some(formula.clone());
        }
        let whole = match subject {
            Subject::Function(function) => function.span,
            Subject::Formula(body) => self.file.exprs.span(body),
        };
        if self.has_error_in(whole) {
            return None;
        }
        let wanted = if scene.space == Space::Complex {
            "a complex number"
        } else {
            "a real number"
        };
        let problem = Diagnostic::error(
            "wrong-result-type",
            span,
            format!(
                "`{}` shows {wanted}, but this is {}",
                scene.name, formula.ty
            ),
        );
        self.diagnostics.push(match formula.ty {
            Type::Complex => problem.with_hint("show abs(f), re(f) or im(f), or use `domain`"),
            Type::Vector(_) => problem.with_hint("show its length |v|, or a component such as v.x"),
            _ => problem.with_hint("write if … then 1 else 0"),
        });
        None
    }

    /// Builds what is shown, with the inputs of a space.
    fn formula(&mut self, subject: Subject<'a>, space: Space, span: Span) -> Option<Formula> {
        let declared: Vec<(&'a str, Option<Type>)> = match subject {
            Subject::Function(function) => declared(function),
            Subject::Formula(body) => self.formula_inputs(body, space)?,
        };
        let Some(types) = input_types(space, &declared) else {
            self.wrong_inputs(subject, space, span);
            return None;
        };
        let mut builder = self.builder();
        let mut values = Vec::new();
        let mut first = 0;
        for &ty in &types {
            values.push(argument_value(&mut builder.graph, first, ty));
            first += scalar_types(ty).len();
        }
        let value = match subject {
            Subject::Function(function) => builder.call_function(function, values, &[], span),
            Subject::Formula(body) => {
                for ((name, _), value) in declared.iter().zip(values) {
                    builder.define(name, value);
                }
                builder.expr(body)
            }
        };
        self.finish(&mut builder);
        if let Subject::Function(function) = subject {
            self.called.insert(&function.name.text);
        }
        if builder.graph.budget().is_err() {
            self.diagnostics.push(
                Diagnostic::error(
                    "too-large",
                    span,
                    format!(
                        "the formula needs more than {} operations",
                        Graph::MAX_NODES
                    ),
                )
                .with_hint("functions that call others many times multiply; name what repeats"),
            );
            return None;
        }
        let ty = value.ty(&builder.graph)?;
        let inputs = declared
            .iter()
            .zip(types)
            .map(|((name, _), ty)| Input {
                name: (*name).to_owned(),
                ty,
            })
            .collect();
        let name = match subject {
            Subject::Function(function) => function.name.text.clone(),
            Subject::Formula(_) => "f".to_owned(),
        };
        Some(Formula {
            name,
            inputs,
            value: value.ids(),
            graph: builder.graph,
            ty,
            span,
        })
    }

    /// Inputs of a bare formula: those of the space, or the vector p where it uses that.
    fn formula_inputs(
        &mut self,
        body: ExprId,
        space: Space,
    ) -> Option<Vec<(&'a str, Option<Type>)>> {
        let free = free_variables(self.file, self.symbols, body);
        let coordinates: &[&'a str] = match space {
            Space::Plane => &["x", "y"],
            Space::Complex if free.contains(&"x") || free.contains(&"y") => &["x", "y"],
            Space::Complex => &["z"],
            Space::Space => &["x", "y", "z"],
        };
        let names: &[&'a str] = match (free.as_slice(), space) {
            (["p"], Space::Plane | Space::Space) => &["p"],
            // a function of x alone
            (["x"], Space::Plane) => &["x"],
            _ => coordinates,
        };
        if let Some(stray) = free.iter().find(|n| !names.contains(n)) {
            self.diagnostics.push(
                Diagnostic::error(
                    "unknown-name",
                    self.file.exprs.span(body),
                    format!(
                        "`{stray}` is not an input here, those are {}",
                        names.join(", ")
                    ),
                )
                .with_hint("name the inputs: f(x, y) = …, f(z) = … or f(x, y, z) = …"),
            );
            return None;
        }
        if free.is_empty() && space == Space::Plane {
            return Some(Vec::new());
        }
        Some(names.iter().map(|n| (*n, None)).collect())
    }

    fn wrong_inputs(&mut self, subject: Subject, space: Space, span: Span) {
        let (wanted, inputs) = match space {
            Space::Plane => ("(x, y)", "x, y"),
            Space::Complex => ("one complex number", "z"),
            Space::Space => ("(x, y, z)", "x, y, z"),
        };
        let name = match subject {
            Subject::Function(function) => shortened(&function.name.text),
            Subject::Formula(_) => "f".to_owned(),
        };
        let header = format!("{name}({inputs}) = …");
        let message = format!(
            "`{}` shows a function of {wanted}",
            default_scene(space).name
        );
        let problem = Diagnostic::error("wrong-inputs", span, message);
        let Subject::Function(function) = subject else {
            self.diagnostics
                .push(problem.with_hint(format!("name the inputs: `{header}`")));
            return;
        };
        let declared = declared(function);
        let fitting = [Space::Plane, Space::Complex, Space::Space]
            .into_iter()
            .find(|&s| s != space && input_types(s, &declared).is_some());
        let hint = match fitting {
            Some(other) => {
                let name = default_scene(other).name;
                format!(
                    "write `show {name}({})`, or take the inputs: `{header}`",
                    shortened(&function.name.text)
                )
            }
            None => format!("write `{header}`"),
        };
        self.diagnostics.push(
            problem
                .with_label(format!("this is {}", signature(function)))
                .with_related(function.name.span, "defined here")
                .with_hint(hint),
        );
    }

    fn settings_of(&mut self, scene: &'static Scene, show: &'a Show) -> Vec<SettingValue> {
        let mut settings = default_settings(scene);
        let mut seen: FxHashMap<&str, Span> = FxHashMap::default();
        for setting in &show.settings {
            let name = setting.name.text.as_str();
            if let Some(&first) = seen.get(name) {
                self.diagnostics.push(
                    Diagnostic::error(
                        "duplicate-setting",
                        setting.name.span,
                        format!("{} is set twice", quoted(name)),
                    )
                    .with_related(first, "first set here")
                    .with_hint("remove one of them"),
                );
                continue;
            }
            seen.insert(name, setting.name.span);
            let Some(spec) = scene.setting(name) else {
                self.unknown_setting(scene, &setting.name);
                continue;
            };
            if let Some(upper) = setting.upper {
                let span = self
                    .file
                    .exprs
                    .span(setting.value)
                    .join(self.file.exprs.span(upper));
                self.diagnostics.push(
                    Diagnostic::error("type-mismatch", span, format!("`{name}` is not a range"))
                        .with_hint("write one value"),
                );
                continue;
            }
            let Some(value) = self.setting_value(spec, setting.value) else {
                continue;
            };
            if let Some(slot) = settings.iter_mut().find(|s| s.spec.name == name) {
                slot.value = value;
            }
        }
        settings
    }

    fn unknown_setting(&mut self, scene: &Scene, name: &pullback_grammar::ast::Name) {
        let problem = Diagnostic::error(
            "unknown-setting",
            name.span,
            format!("`{}` has no setting {}", scene.name, quoted(&name.text)),
        );
        let names: Vec<&str> = scene.settings.iter().map(|s| s.name).collect();
        self.diagnostics
            .push(match nearest(&name.text, names.iter().copied()) {
                Some(near) => problem.with_hint(format!("did you mean `{near}`?")),
                None => problem.with_hint(format!("it has {}", names.join(", "))),
            });
    }

    fn setting_value(&mut self, spec: &SettingSpec, expr: ExprId) -> Option<[f64; 3]> {
        let span = self.file.exprs.span(expr);
        if let SettingKind::Choice(words) = spec.kind {
            let found = match &self.file.exprs[expr] {
                Expr::Name(name) => words.iter().position(|w| *w == name.text),
                _ => None,
            };
            let Some(place) = found else {
                self.diagnostics.push(
                    Diagnostic::error(
                        "type-mismatch",
                        span,
                        format!("`{}` is a choice of words", spec.name),
                    )
                    .with_hint(format!("write {}", words.join(", or "))),
                );
                return None;
            };
            #[allow(clippy::cast_precision_loss, reason = "a place in a short list")]
            return Some([place as f64; 3]);
        }
        let (value, graph) = self.constant_value(expr)?;
        let (size, wanted, example) = match spec.kind {
            SettingKind::Vec2 => (2, "vec2", "(1, 2)"),
            SettingKind::Vec3 => (3, "vec3", "(1, 2, 3)"),
            _ => (1, "real", "1"),
        };
        let found = value.ty(&graph)?;
        let fits = match found {
            Type::Real => size != 2,
            Type::Vector(n) => usize::from(n) == size,
            _ => false,
        };
        if !fits {
            self.diagnostics.push(
                Diagnostic::error(
                    "type-mismatch",
                    span,
                    format!("`{}` is {wanted}, found {found}", spec.name),
                )
                .with_label(format!("this is {found}"))
                .with_hint(format!(
                    "write a {wanted}, such as `{} = {example}`",
                    spec.name
                )),
            );
            return None;
        }
        let numbers: Option<Vec<f64>> = value.ids().iter().map(|&id| graph.as_real(id)).collect();
        let Some(numbers) = numbers else {
            if !self.has_error_in(span) {
                self.diagnostics.push(not_constant(span, "a setting"));
            }
            return None;
        };
        if let Some(&x) = numbers.iter().find(|x| !x.is_finite()) {
            let message = format!("`{}` is {}", spec.name, infinity_or_nan(x));
            self.diagnostics.push(
                Diagnostic::error("not-finite", span, message).with_hint("write a finite number"),
            );
            return None;
        }
        let out = match *numbers.as_slice() {
            [x] => [x; 3],
            [x, y] => [x, y, 0.0],
            [x, y, z] => [x, y, z],
            _ => return None,
        };
        match spec.check(&out[..size]) {
            Ok(()) => Some(out),
            Err(message) => {
                self.diagnostics.push(
                    Diagnostic::error("setting-out-of-range", span, message).with_hint(spec.doc),
                );
                None
            }
        }
    }
}

fn infinity_or_nan(x: f64) -> &'static str {
    if x.is_nan() {
        "not a number"
    } else {
        "infinite"
    }
}

/// Names and annotations of a function's parameters.
fn declared(function: &Function) -> Vec<(&str, Option<Type>)> {
    function
        .params
        .iter()
        .map(|p| {
            (
                p.name.text.as_str(),
                p.ty.as_ref().and_then(|t| Type::from_name(&t.text)),
            )
        })
        .collect()
}

/// Types of the arguments of a function in a space, or `None` where it does not fit.
fn input_types(space: Space, declared: &[(&str, Option<Type>)]) -> Option<Vec<Type>> {
    let is = |k: usize, ty: Type| declared[k].1.is_none_or(|t| t == ty);
    match (space, declared.len()) {
        (_, 0) => Some(Vec::new()),
        (Space::Plane | Space::Complex, 2) if is(0, Type::Real) && is(1, Type::Real) => {
            Some(vec![Type::Real; 2])
        }
        (Space::Plane, 1) if declared[0].1 == Some(Type::Real) => Some(vec![Type::Real]),
        (Space::Plane, 1) if declared[0].1.is_none() && matches!(declared[0].0, "x" | "y") => {
            Some(vec![Type::Real])
        }
        (Space::Plane, 1) if is(0, Type::Vector(2)) => Some(vec![Type::Vector(2)]),
        (Space::Complex, 1) if is(0, Type::Complex) => Some(vec![Type::Complex]),
        (Space::Space, 3) if (0..3).all(|k| is(k, Type::Real)) => Some(vec![Type::Real; 3]),
        (Space::Space, 1) if is(0, Type::Vector(3)) => Some(vec![Type::Vector(3)]),
        _ => None,
    }
}

fn default_settings(scene: &'static Scene) -> Vec<SettingValue> {
    scene
        .settings
        .iter()
        .map(|spec| SettingValue {
            spec,
            value: spec.default,
        })
        .collect()
}
