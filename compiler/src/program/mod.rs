//! A whole program: its parameters and the pictures that it shows.

mod checker;
mod function;
mod outline;
mod params;
mod quadrature;
mod settings;
mod subject;
mod unused;

use crate::check::{Symbols, check_names, is_builtin_function};
use crate::formula::Formula;
use crate::scene::{Scene, SettingKind, SettingSpec};
use crate::stable::Rewrites;
use checker::Checker;
pub use function::compile_function;
use glam::DVec3;
pub use outline::{ConstantInfo, FunctionInfo, MAX_SIGNATURES, Outline, Signature};
use pullback_grammar::ast::File;
use pullback_grammar::diagnostic::limit;
use pullback_grammar::{Diagnostic, Span};
use std::sync::Arc;
pub use unused::MAX_UNUSED;

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
    pub value: DVec3,
}

impl SettingValue {
    /// The word of a choice.
    #[must_use]
    pub fn word(&self) -> Option<&'static str> {
        let SettingKind::Choice(words) = self.spec.kind else {
            return None;
        };
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a place in a short list"
        )]
        let place = self.value.x as usize;
        words.get(place).copied()
    }
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
    /// The function that gives the colours, where the scene takes one and the program names one.
    pub colour: Option<Formula>,
}

impl Picture {
    /// The value of a setting.
    #[must_use]
    pub fn setting(&self, name: &str) -> Option<DVec3> {
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
    /// The text, where other rewrites make other derivatives within formulas.
    file: Option<Arc<File>>,
}

impl Program {
    /// The parameters in the order of the text.
    #[must_use]
    pub fn params(&self) -> &[ParamInfo] {
        &self.params
    }

    /// The same program with other stability rewrites in all its formulas, and in what is differentiated within them.
    #[must_use]
    pub fn with_rewrites(mut self, rewrites: Rewrites) -> Self {
        let formulas = match self.file.as_deref() {
            Some(file) => formulas(file, rewrites),
            None => Vec::new(),
        };
        let mut formulas = formulas.into_iter();
        for picture in &mut self.pictures {
            if let Some(colour) = picture.colour.take() {
                picture.colour = Some(colour.with_rewrites(rewrites));
            }
            match formulas.next() {
                Some(formula) => picture.formula = formula,
                None => picture.formula.rewrites = rewrites,
            }
        }
        self
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
    /// What the text defines, errors or not.
    pub outline: Outline,
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
    let mut checker = Checker::new(file, &symbols, diagnostics);
    let params = checker.params();
    let pictures = checker.pictures();
    checker.unused_functions();
    let outline = checker.outline(&params);
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
    let needs_text = pictures.iter().any(|p| p.formula.derived.is_some());
    let program = (!failed && !pictures.is_empty()).then(|| Program {
        params,
        pictures,
        file: needs_text.then(|| Arc::new(parsed.file)),
    });
    Compilation {
        program,
        diagnostics,
        outline,
    }
}

/// The formulas of the pictures of a file without errors.
fn formulas(file: &File, rewrites: Rewrites) -> Vec<Formula> {
    let symbols = Symbols::collect(file, &mut Vec::new());
    let mut checker = Checker::new(file, &symbols, Vec::new());
    checker.rewrites = rewrites;
    checker.params();
    let pictures = checker.pictures().into_iter();
    pictures.map(|picture| picture.formula).collect()
}

/// Greatest number of `show` statements of a program.
pub const MAX_SHOWS: usize = 64;
