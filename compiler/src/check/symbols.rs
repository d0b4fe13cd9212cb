//! The names that a program defines.

use pullback_grammar::ast::{Constant, File, Function, Item, Name, Param};
use pullback_grammar::{Diagnostic, Span};
use rustc_hash::FxHashMap;

use super::hides_builtin;
use super::suggest::quoted;
use super::variables::Differentiated;

/// What each name at the top of a program stands for.
#[derive(Debug, Default)]
pub struct Symbols<'a> {
    /// Functions.
    pub functions: FxHashMap<&'a str, &'a Function>,
    /// Constants.
    pub constants: FxHashMap<&'a str, &'a Constant>,
    /// Parameters with their index.
    pub params: FxHashMap<&'a str, (u16, &'a Param)>,
    /// The calls that differentiate.
    pub(super) differentiated: Differentiated,
}

/// Greatest number of `param` statements of a program.
pub const MAX_PARAMS: usize = 64;

impl<'a> Symbols<'a> {
    /// Collects the definitions of a program, and reports names that are defined twice or may not be.
    pub fn collect(file: &'a File, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let mut symbols = Self {
            differentiated: Differentiated::of(file),
            ..Self::default()
        };
        let mut seen: FxHashMap<&str, Span> = FxHashMap::default();
        for item in &file.items {
            let name = match item {
                Item::Function(f) => &f.name,
                Item::Constant(c) => &c.name,
                Item::Param(p) => &p.name,
                Item::Show(_) | Item::Formula(_) => continue,
            };
            let text = name.text.as_str();
            if let Some(first) = seen.get(text) {
                diagnostics.push(
                    Diagnostic::error(
                        "duplicate-definition",
                        name.span,
                        format!("{} is defined twice", quoted(text)),
                    )
                    .with_label("defined again")
                    .with_related(*first, "first defined here")
                    .with_hint("rename one of them"),
                );
                continue;
            }
            seen.insert(text, name.span);
            check_definable(name, matches!(item, Item::Function(_)), diagnostics);
            match item {
                Item::Function(f) => {
                    symbols.functions.insert(text, f);
                }
                Item::Constant(c) => {
                    symbols.constants.insert(text, c);
                }
                Item::Param(p) => {
                    let index = u16::try_from(symbols.params.len()).unwrap_or(u16::MAX);
                    if symbols.params.len() == MAX_PARAMS {
                        diagnostics.push(
                            Diagnostic::error(
                                "too-many-params",
                                p.name.span,
                                format!("more than {MAX_PARAMS} parameters"),
                            )
                            .with_hint("make some of them constants"),
                        );
                    }
                    symbols.params.insert(text, (index, p));
                }
                Item::Show(_) | Item::Formula(_) => {}
            }
        }
        symbols
    }

    /// Every name that a program defines.
    pub fn names(&self) -> impl Iterator<Item = &'a str> {
        self.functions
            .keys()
            .chain(self.constants.keys())
            .chain(self.params.keys())
            .copied()
    }
}

/// Reports names that mean something fixed, and warns of definitions that hide a builtin. Functions of the library
/// may be hidden: it has many of the names that people give their own, and its own text never sees the program's.
fn check_definable(name: &Name, is_function: bool, diagnostics: &mut Vec<Diagnostic>) {
    if let Some(problem) = reserved(name) {
        diagnostics.push(problem);
    } else if hides_builtin(&name.text) {
        let kind = if is_function { "function" } else { "value" };
        diagnostics.push(
            Diagnostic::warning(
                "shadows-builtin",
                name.span,
                format!("this {kind} hides the builtin function `{}`", name.text),
            )
            .with_hint("rename it if the builtin is meant elsewhere"),
        );
    }
}

/// The error for a name that cannot be given a new meaning.
pub fn reserved(name: &Name) -> Option<Diagnostic> {
    let what = match name.text.as_str() {
        "i" => "the imaginary unit",
        "time" => "the animation clock",
        "pixel" => "the footprint of a pixel",
        "true" | "false" => "a truth value",
        "pi" | "π" | "tau" | "τ" | "phi" | "φ" | "∞" | "inf" | "nan" => "a constant",
        _ => return None,
    };
    Some(
        Diagnostic::error(
            "reserved-name",
            name.span,
            format!("`{}` is {what}", name.text),
        )
        .with_label("cannot be given another meaning")
        .with_hint(match name.text.as_str() {
            "i" => "use another name, such as `k` for a whole number",
            "time" => "use another name, such as `t`",
            "pi" | "π" | "tau" | "τ" | "phi" | "φ" => "use another name, such as `a` or `angle`",
            _ => "use another name",
        }),
    )
}
