//! Functions of the language that are written in the language itself.
//!
//! A name may have several definitions, told apart by the number and the types of their arguments. A definition
//! without annotations takes numbers, and vectors by components; one with annotations takes what they say. A name that
//! begins with `_` is for the library alone.

use std::sync::OnceLock;

use pullback_grammar::Parsed;
use pullback_grammar::ast::{File, Function, Item, Name};
use rustc_hash::FxHashMap;

use super::builtins;
use super::names::whole_signature;
use crate::table;
use crate::types::Type;

/// A definition of the library.
#[derive(Debug)]
pub struct LibraryFunction {
    /// Its name, which other definitions may share.
    pub name: &'static str,
    /// One line: the comment above its definition.
    pub doc: &'static str,
    /// How it is written.
    pub usage: String,
    /// Its definition as text.
    pub definition: &'static str,
    /// Its definition in [`file`](fn@file).
    pub function: &'static Function,
    /// The types of its parameters; `None` takes any.
    pub types: Vec<Option<Type>>,
}

/// The definitions, by subject.
const SOURCE: &str = concat!(
    include_str!("library/interpolation.pull"),
    include_str!("library/trigonometry.pull"),
    include_str!("library/vector.pull"),
    include_str!("library/blending.pull"),
    include_str!("library/distance.pull"),
    include_str!("library/noise.pull"),
    include_str!("library/light.pull"),
    include_str!("library/special/pair.pull"),
    include_str!("library/special/error.pull"),
    include_str!("library/special/lambert.pull"),
    include_str!("library/special/zeta.pull"),
    include_str!("library/special/airy.pull"),
    include_str!("library/special/elliptic.pull"),
    include_str!("library/special/modular.pull"),
    include_str!("library/special/gamma.pull"),
    include_str!("library/special/dilogarithm.pull"),
    include_str!("library/special/bessel.pull"),
    include_str!("library/special/exponential_integral.pull"),
    include_str!("library/special/fresnel.pull"),
    include_str!("library/special/beta.pull"),
    include_str!("library/special/polynomial.pull"),
    include_str!("library/special/theta.pull"),
    include_str!("library/special/jacobi.pull"),
    include_str!("library/special/jacobi_curve.pull"),
    include_str!("library/special/lattice.pull"),
    include_str!("library/special/hurwitz.pull"),
    include_str!("library/special/hypergeometric.pull"),
);

/// Longest chain of definitions of the library that call each other.
pub const MAX_LIBRARY_DEPTH: usize = 8;

/// The parsed library.
pub fn file() -> &'static File {
    static FILE: OnceLock<File> = OnceLock::new();
    FILE.get_or_init(|| parsed().file)
}

fn parsed() -> Parsed {
    let known = |name: &str| table::by_name(name).is_some() || builtins::by_name(name).is_some();
    pullback_grammar::parse(SOURCE, &known)
}

/// Every definition of the library that programs may use, in the order of its text.
pub fn library_functions() -> impl Iterator<Item = &'static LibraryFunction> {
    definitions().iter().filter(|f| !is_private(f.name))
}

/// Whether only the library itself may use a name.
pub fn is_private(name: &str) -> bool {
    name.starts_with('_')
}

fn definitions() -> &'static [LibraryFunction] {
    static FUNCTIONS: OnceLock<Vec<LibraryFunction>> = OnceLock::new();
    FUNCTIONS.get_or_init(|| {
        let mut functions = Vec::new();
        for item in &file().items {
            let Item::Function(function) = item else {
                continue;
            };
            let before = SOURCE.get(..function.span.start as usize).unwrap_or("");
            let comment = before.trim_end().lines().last().unwrap_or("");
            let annotation = |ty: &Name| Type::from_name(&ty.text);
            functions.push(LibraryFunction {
                name: &function.name.text,
                doc: comment.strip_prefix("//").unwrap_or("").trim(),
                usage: whole_signature(function),
                definition: function.span.text(SOURCE),
                function,
                types: function
                    .params
                    .iter()
                    .map(|p| p.ty.as_ref().and_then(annotation))
                    .collect(),
            });
        }
        functions
    })
}

/// The definitions of this name, in the order of the text.
pub fn by_name(name: &str) -> Option<&'static [&'static LibraryFunction]> {
    type Index = FxHashMap<&'static str, Vec<&'static LibraryFunction>>;
    static INDEX: OnceLock<Index> = OnceLock::new();
    let index = INDEX.get_or_init(|| {
        let mut index = Index::default();
        for function in definitions() {
            index.entry(function.name).or_default().push(function);
        }
        index
    });
    index.get(name).map(Vec::as_slice)
}

impl LibraryFunction {
    /// Whether it takes vectors by components.
    pub fn is_generic(&self) -> bool {
        self.types.iter().all(Option::is_none)
    }

    /// How far it is from what is given; `None` where it does not take that.
    fn misfit(&self, given: &[Type]) -> Option<usize> {
        if self.types.len() != given.len() {
            return None;
        }
        let mut misfit = 0;
        for (expected, found) in self.types.iter().zip(given) {
            misfit += match expected {
                Some(ty) if ty == found => 0,
                Some(Type::Complex) if *found == Type::Real => 1,
                Some(_) => return None,
                // what is made for a type goes before what takes any
                None => 2,
            };
        }
        Some(misfit)
    }
}

/// The definition that fits what is given best; of several the first.
pub fn overload(
    definitions: &[&'static LibraryFunction],
    given: &[Type],
) -> Option<&'static LibraryFunction> {
    let fitting = |f: &&'static LibraryFunction| f.misfit(given).map(|misfit| (misfit, *f));
    let best = definitions.iter().filter_map(fitting);
    best.min_by_key(|(misfit, _)| *misfit).map(|(_, f)| f)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::{Symbols, check_names};

    #[test]
    fn the_library_is_well_formed() {
        assert_eq!(parsed().diagnostics, []);
        let mut found = Vec::new();
        check_names(file(), &Symbols::default(), &mut found);
        // names that are private, and numbers of arguments, are told apart by the builder
        found.retain(|problem| !["unknown-function", "wrong-arity"].contains(&problem.code));
        assert_eq!(found, []);
        for function in definitions() {
            let usage = &function.usage;
            assert!(
                !function.doc.is_empty() || is_private(function.name),
                "{usage}"
            );
            let annotated = function.function.params.iter().filter(|p| p.ty.is_some());
            assert_eq!(annotated.count(), function.types.iter().flatten().count());
            let all = function.types.iter().all(Option::is_some);
            assert!(all || function.is_generic(), "{usage}: all or none");
        }
    }

    #[test]
    fn definitions_of_a_name_differ_in_what_they_take() {
        for function in definitions() {
            let twins = by_name(function.name).unwrap_or_default();
            let same = twins.iter().filter(|f| f.types == function.types);
            assert_eq!(same.count(), 1, "{}", function.usage);
        }
    }

    #[test]
    fn the_nearest_definition_is_taken() {
        let definitions = by_name("box").unwrap_or_default();
        let taken = |given: &[Type]| overload(definitions, given).map(|f| f.usage.as_str());
        let (real, plane, space) = (Type::Real, Type::Vector(2), Type::Vector(3));
        assert_eq!(taken(&[plane, plane]), Some("box(p: vec2, b: vec2)"));
        assert_eq!(taken(&[space, real]), Some("box(p: vec3, b: real)"));
        assert_eq!(taken(&[space, plane]), None);
        assert_eq!(taken(&[space]), None);
    }
}
