//! From the syntax tree to the IR: names, types, and the pictures that a program shows.

mod bounds;
mod builder;
mod builtins;
mod calculus;
mod call;
mod familiar;
mod fold;
mod iteration;
mod library;
mod names;
mod nesting;
mod operators;
mod record;
mod scope;
mod suggest;
mod symbols;
mod value;
mod variables;
mod whole;

pub(crate) use bounds::Bounds;
pub use builder::{Builder, MAX_DEPTH, Source};
pub use builtins::{Builtin, builtins};
pub use calculus::MAX_ORDER;
pub use calculus::{Operator, operators};
pub use library::{LibraryFunction, file as library_file, library_functions};
pub use names::{MAX_CALL_DEPTH, check_names, free_variables, not_constant, signature};
pub use nesting::{MAX_LOOP_NESTING, MAX_STEPS};
pub use record::Record;
pub use suggest::{nearest, quoted, shortened};
pub use symbols::{MAX_PARAMS, Symbols};
pub use value::Value;

use crate::table;

/// Whether a name is a function of the language without being defined in the program.
#[must_use]
pub fn is_builtin_function(name: &str) -> bool {
    hides_builtin(name) || (library::by_name(name).is_some() && !library::is_private(name))
}

/// Whether a definition of this name hides what a reader takes to be fixed.
fn hides_builtin(name: &str) -> bool {
    table::by_name(name).is_some()
        || builtins::by_name(name).is_some()
        || calculus::by_name(name).is_some()
        || matches!(name, "sum" | "product" | "iterate")
}

/// The value of a named constant of the language.
#[must_use]
pub fn named_constant(name: &str) -> Option<f64> {
    Some(match name {
        "pi" | "π" => std::f64::consts::PI,
        "tau" | "τ" => std::f64::consts::TAU,
        // (1 + √5)/2
        "phi" | "φ" => 1.618_033_988_749_895,
        "e" => std::f64::consts::E,
        "inf" | "∞" => f64::INFINITY,
        "nan" => f64::NAN,
        _ => return None,
    })
}

/// Whether a name means something without being defined: constants, the imaginary unit, the clock and the
/// footprint.
#[must_use]
pub fn is_builtin_value(name: &str) -> bool {
    named_constant(name).is_some() || matches!(name, "i" | "time" | "pixel" | "true" | "false")
}
