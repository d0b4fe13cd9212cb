//! The settings of a `show`.

use super::SettingValue;
use super::checker::{Checker, Subject};
use super::params::infinity_or_nan;
use crate::check::{nearest, not_constant, quoted};
use crate::formula::Formula;
use crate::scene::{Scene, SettingKind, SettingSpec, conflicts};
use crate::types::Type;
use glam::DVec3;
use pullback_grammar::ast::{Expr, ExprId, Show};
use pullback_grammar::{Diagnostic, Span};
use rustc_hash::FxHashMap;

impl<'a> Checker<'a> {
    pub(super) fn settings_of(
        &mut self,
        scene: &'static Scene,
        show: &'a Show,
    ) -> Vec<SettingValue> {
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
            if spec.kind == SettingKind::Function {
                // built by `colour_of`
                continue;
            }
            let Some(value) = self.setting_value(spec, setting.value) else {
                continue;
            };
            if let Some(slot) = settings.iter_mut().find(|s| s.spec.name == name) {
                slot.value = value;
            }
        }
        self.conflicts_of(scene, show, &settings);
        settings
    }

    /// The function that a setting of a scene of space names, with its inputs and its type checked.
    pub(super) fn colour_of(&mut self, scene: &'static Scene, show: &'a Show) -> Option<Formula> {
        let kind = |name: &str| scene.setting(name).map(|spec| spec.kind);
        let mut named = show.settings.iter();
        let setting = named.find(|s| kind(&s.name.text) == Some(SettingKind::Function))?;
        let span = self.file.exprs.span(setting.value);
        let function = match &self.file.exprs[setting.value] {
            Expr::Name(name) => self.symbols.functions.get(name.text.as_str()).copied(),
            _ => None,
        };
        let title = &setting.name.text;
        let Some(function) = function else {
            self.diagnostics.push(
                Diagnostic::error(
                    "type-mismatch",
                    span,
                    format!("`{title}` is the name of a function"),
                )
                .with_hint(format!(
                    "define one, such as `ink(p: vec3) = |p|`, and write `{title} = ink`"
                )),
            );
            return None;
        };
        let formula = self.formula(Subject::Function(function), scene.space, span)?;
        if matches!(formula.ty, Type::Real | Type::Vector(3)) {
            return Some(formula);
        }
        self.diagnostics.push(
            Diagnostic::error(
                "wrong-result-type",
                span,
                format!(
                    "`{title}` takes a real number or a vec3, and {} gives {}",
                    quoted(&function.name.text),
                    formula.ty.in_words()
                ),
            )
            .with_related(function.name.span, "defined here")
            .with_hint(
                "a real number is a place between `hot` (0) and `halo` (1), a vec3 is linear rgb",
            ),
        );
        None
    }

    /// Reports settings that make no sense together.
    fn conflicts_of(&mut self, scene: &Scene, show: &Show, settings: &[SettingValue]) {
        let place = |name: &str| {
            let setting = show.settings.iter().find(|s| s.name.text == name)?;
            Some(setting.name.span.join(self.file.exprs.span(setting.value)))
        };
        let given = |name: &str| place(name).is_some();
        let mut found = Vec::new();
        for conflict in conflicts(scene, settings, &given) {
            let span = conflict.settings.iter().find_map(|name| place(name));
            found.push(
                Diagnostic::error(
                    "setting-conflict",
                    span.unwrap_or(show.scene.span),
                    conflict.message,
                )
                .with_hint(conflict.hint),
            );
        }
        self.diagnostics.extend(found);
    }

    pub(super) fn unknown_setting(&mut self, scene: &Scene, name: &pullback_grammar::ast::Name) {
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

    pub(super) fn setting_value(&mut self, spec: &SettingSpec, expr: ExprId) -> Option<DVec3> {
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
            return Some(DVec3::splat(place as f64));
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
                    format!(
                        "`{}` is a {wanted}, and this is {}",
                        spec.name,
                        found.in_words()
                    ),
                )
                .with_label(format!("this is {}", found.in_words()))
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
            [x] => DVec3::splat(x),
            [x, y] => DVec3::new(x, y, 0.0),
            [x, y, z] => DVec3::new(x, y, z),
            _ => return None,
        };
        match spec.check(&out.as_ref()[..size]) {
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

pub(super) fn default_settings(scene: &'static Scene) -> Vec<SettingValue> {
    scene
        .settings
        .iter()
        .map(|spec| SettingValue {
            spec,
            value: spec.default,
        })
        .collect()
}
