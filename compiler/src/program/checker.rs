//! The pictures of a program.

use super::settings::default_settings;
use super::{MAX_SHOWS, Picture, Signature};
use crate::check::{Builder, Symbols, nearest, quoted, shortened};
use crate::scene::{Space, default_scene, scene, scenes};
use crate::stable::Rewrites;
use crate::types::Type;
use pullback_grammar::ast::{Expr, ExprId, File, Function, Item, Show};
use pullback_grammar::{Diagnostic, Span, print_expr};
use rustc_hash::{FxHashMap, FxHashSet};

/// What a picture shows: a function, or a formula in free variables.
#[derive(Clone, Copy)]
pub(super) enum Subject<'a> {
    Function(&'a Function),
    Formula(ExprId),
}

pub(super) struct Checker<'a> {
    pub(super) file: &'a File,
    pub(super) symbols: &'a Symbols<'a>,
    pub(super) diagnostics: Vec<Diagnostic>,
    /// Functions that something shown, or a constant, has called: they are checked.
    pub(super) called: FxHashSet<&'a str>,
    /// The types with which functions are used.
    pub(super) signatures: FxHashMap<&'a str, Vec<Signature>>,
    /// Types of the constants that are used.
    pub(super) constants: FxHashMap<&'a str, Type>,
    /// The range of each parameter that states one.
    pub(super) ranges: Vec<Option<(f64, f64)>>,
    /// The stability rewrites of the formulas.
    pub(super) rewrites: Rewrites,
}

impl<'a> Checker<'a> {
    /// A checker of a file whose names are collected.
    pub(super) fn new(
        file: &'a File,
        symbols: &'a Symbols<'a>,
        diagnostics: Vec<Diagnostic>,
    ) -> Self {
        Self {
            file,
            symbols,
            diagnostics,
            called: FxHashSet::default(),
            signatures: FxHashMap::default(),
            constants: FxHashMap::default(),
            ranges: Vec::new(),
            rewrites: Rewrites::ON,
        }
    }

    pub(super) fn builder(&self) -> Builder<'a> {
        Builder::new(self.file, self.symbols).with_ranges(&self.ranges)
    }

    /// Takes over what a builder found.
    pub(super) fn finish(&mut self, builder: &mut Builder<'a>) {
        self.diagnostics.append(&mut builder.diagnostics);
        self.called.extend(builder.called());
        self.remember_types(builder);
    }

    /// Whether an error lies in this part of the text: what follows from it is not reported.
    pub(super) fn has_error_in(&self, span: Span) -> bool {
        self.diagnostics
            .iter()
            .any(|d| d.is_error() && span.start <= d.span.start && d.span.end <= span.end)
    }

    pub(super) fn pictures(&mut self) -> Vec<Picture> {
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
    pub(super) fn check_formulas(&mut self) {
        let formulas: Vec<_> = self
            .file
            .items
            .iter()
            .filter_map(|item| match item {
                // what could not be read may be no formula at all
                Item::Formula(formula) if !matches!(self.file.exprs[formula.body], Expr::Error) => {
                    Some(formula.span)
                }
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

    pub(super) fn default_picture(&mut self) -> Option<Picture> {
        let file = self.file;
        let formula = file.items.iter().find_map(|item| match item {
            Item::Formula(formula) => Some(Subject::Formula(formula.body)),
            _ => None,
        });
        let function = self.default_function().map(Subject::Function);
        let Some(subject) = formula.or(function) else {
            if !self.diagnostics.iter().any(Diagnostic::is_error) {
                self.diagnostics.push(
                    Diagnostic::error(
                        "nothing-to-show",
                        Span::default(),
                        "there is no formula to show",
                    )
                    .with_hint(self.hint_for_nothing()),
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
            colour: None,
        })
    }

    /// `x = 2` names a number; as a curve it is the difference of its sides.
    fn hint_for_nothing(&self) -> String {
        let exprs = &self.file.exprs;
        let curve = self.file.items.iter().find_map(|item| match item {
            Item::Constant(constant) => {
                let name = constant.name.text.as_str();
                let side = match name {
                    "x" | "y" | "z" => name,
                    "xy" => "x y",
                    "r" => "hypot(x, y)",
                    "θ" => "atan2(y, x)",
                    _ => return None,
                };
                let value = shortened(&print_expr(exprs, constant.value));
                let value = match &exprs[constant.value] {
                    Expr::Number(_) | Expr::Name(_) => value,
                    _ => format!("({value})"),
                };
                Some(format!(
                    "for a curve write `{side} - {value}`, without a name"
                ))
            }
            _ => None,
        });
        curve.unwrap_or_else(|| "write one, such as `sin(x^2 + y^2)`".to_owned())
    }

    pub(super) fn picture(&mut self, show: &'a Show) -> Option<Picture> {
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
                    None if matches!(
                        show.scene.text.as_str(),
                        "contour" | "contours" | "plot" | "heatmap" | "curve" | "plane"
                    ) =>
                    {
                        problem.with_hint("write `levels`")
                    }
                    None if matches!(show.scene.text.as_str(), "isosurface" | "plot3d" | "sdf") => {
                        problem.with_hint("write `surface`")
                    }
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
                .with_hint(format!(
                    "show one after the other: `show {0}(f)`, and `show {0}(g)` in the next line",
                    scene.name
                )),
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
        let colour = self.colour_of(scene, show);
        self.check_result(scene, &formula?, subject, span)
            .map(|formula| Picture {
                scene,
                settings,
                formula,
                colour,
            })
    }
}
