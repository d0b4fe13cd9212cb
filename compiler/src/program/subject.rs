//! What a picture shows: its inputs, its type, its formula.

use super::checker::{Checker, Subject};
use crate::check::{Builder, Value, free_variables, quoted, shortened, signature};
use crate::formula::{Form, Formula, Input, argument_value, scalar_types};
use crate::ir::Graph;
use crate::scene::{Scene, Space, default_scene};
use crate::types::Type;
use pullback_grammar::ast::{BinaryOp, CompareOp, Expr, ExprId, Function};
use pullback_grammar::{Diagnostic, Span, print_expr};

impl<'a> Checker<'a> {
    pub(super) fn subject_span(&self, subject: Subject) -> Span {
        match subject {
            Subject::Function(function) => function.name.span,
            Subject::Formula(body) => self.file.exprs.span(body),
        }
    }

    /// The space that a function or formula lives in by its inputs.
    pub(super) fn default_space(&mut self, subject: Subject<'a>) -> Option<Space> {
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

    /// Builds what is shown, with the inputs of a space.
    pub(super) fn formula(
        &mut self,
        subject: Subject<'a>,
        space: Space,
        span: Span,
    ) -> Option<Formula> {
        let declared: Vec<(&'a str, Option<Type>)> = match subject {
            Subject::Function(function) => declared(function),
            Subject::Formula(body) => self.formula_inputs(body, space)?,
        };
        let Some(types) = input_types(space, &declared) else {
            self.wrong_inputs(subject, space, span);
            return None;
        };
        self.formula_of(subject, &declared, types, span)
    }

    /// Builds a function or formula with inputs of these names and types.
    pub(super) fn formula_of(
        &mut self,
        subject: Subject<'a>,
        declared: &[(&'a str, Option<Type>)],
        types: Vec<Type>,
        span: Span,
    ) -> Option<Formula> {
        let mut builder = self.builder();
        let value = build(&mut builder, subject, declared, &types, span);
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
        let derived = if builder.has_differentiated() {
            self.derived_form(subject, declared, &types, ty)
        } else {
            None
        };
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
            rewrites: self.rewrites,
            derived,
        })
    }

    /// What [`Self::formula_of`] builds, with the derivatives that stand in it taken of rewritten expressions; `None`
    /// where nothing is rewritten, or the result would be too large. What is wrong with the text has been reported.
    fn derived_form(
        &self,
        subject: Subject<'a>,
        declared: &[(&'a str, Option<Type>)],
        types: &[Type],
        ty: Type,
    ) -> Option<Form> {
        let mut builder = self.builder().with_rewrites(self.rewrites);
        let span = self.subject_span(subject);
        let value = build(&mut builder, subject, declared, types, span);
        let fits = builder.graph.budget().is_ok() && value.ty(&builder.graph) == Some(ty);
        (builder.has_rewritten() && fits).then(|| Form {
            value: value.ids(),
            graph: builder.graph,
        })
    }

    /// Inputs of a bare formula: those of the space, or the vector p where it uses that.
    pub(super) fn formula_inputs(
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

    pub(super) fn wrong_inputs(&mut self, subject: Subject, space: Space, span: Span) {
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
                    "show it by `show {name}({})`, or take the inputs: `{header}`",
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

    pub(super) fn check_result(
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
            self.warn_of_quadrature(scene, formula);
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
                scene.name,
                formula.ty.in_words()
            ),
        );
        self.diagnostics.push(match formula.ty {
            Type::Complex => {
                problem.with_hint("show its `abs(…)`, `re(…)` or `im(…)`, or use `domain`")
            }
            Type::Vector(_) => problem.with_hint(self.hint_for_vector(subject)),
            _ => problem.with_hint(self.hint_for_condition(subject)),
        });
        None
    }
}

impl Checker<'_> {
    /// How a vector becomes something to draw.
    fn hint_for_vector(&self, subject: Subject) -> String {
        let body = match subject {
            Subject::Formula(body) => body,
            Subject::Function(function) => function.body,
        };
        let text = shortened(&print_expr(&self.file.exprs, body));
        match &self.file.exprs[body] {
            Expr::Where { .. } | Expr::If { .. } => {
                "show its length `|…|`, or a component of it".to_owned()
            }
            Expr::Vector(_) | Expr::Name(_) | Expr::Call { .. } => {
                format!("show its length `|{text}|`, or a component such as `{text}.x`")
            }
            _ => format!("show its length `|{text}|`, or a component such as `({text}).x`"),
        }
    }

    /// How a condition becomes something to draw.
    fn hint_for_condition(&self, subject: Subject) -> String {
        let exprs = &self.file.exprs;
        let Subject::Formula(body) = subject else {
            return "a condition becomes a number by `if … then 1 else 0`".to_owned();
        };
        let shown = shortened(&print_expr(exprs, body));
        match &exprs[body] {
            Expr::Compare { first, rest } if matches!(rest.as_slice(), [(CompareOp::Equal, _)]) => {
                let side = |id: ExprId| shortened(&print_expr(exprs, id));
                let right = match &exprs[rest[0].1] {
                    Expr::Binary {
                        op: BinaryOp::Add | BinaryOp::Sub,
                        ..
                    } => {
                        format!("({})", side(rest[0].1))
                    }
                    _ => side(rest[0].1),
                };
                let left = side(*first);
                format!("write `{left} - {right}`, which is 0 where both sides agree")
            }
            _ => format!("write `if {shown} then 1 else 0`"),
        }
    }
}

/// The value of a subject at inputs of these names and types.
fn build<'a>(
    builder: &mut Builder<'a>,
    subject: Subject<'a>,
    declared: &[(&'a str, Option<Type>)],
    types: &[Type],
    span: Span,
) -> Value {
    let mut values = Vec::new();
    let mut first = 0;
    for &ty in types {
        values.push(argument_value(&mut builder.graph, first, ty));
        first += scalar_types(ty).len();
    }
    match subject {
        Subject::Function(function) => {
            let value = builder.call_function(function, values, &[], span);
            builder.number(value, function.body)
        }
        Subject::Formula(body) => {
            for ((name, _), value) in declared.iter().zip(values) {
                builder.define(name, value);
            }
            builder.expr(body)
        }
    }
}

/// Names and annotations of a function's parameters.
pub(super) fn declared(function: &Function) -> Vec<(&str, Option<Type>)> {
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
pub(super) fn input_types(space: Space, declared: &[(&str, Option<Type>)]) -> Option<Vec<Type>> {
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
