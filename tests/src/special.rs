//! Formulas of the functions that are defined in the language, and what their modules hold.

use pullback_compiler::ir::Prim;
use pullback_compiler::table;

/// The greatest error factor in binary64: 2⁻⁴⁵ of the norm, far below the goal of 10⁻¹².
pub const MOST_DOUBLE: f64 = 32.0;
/// In pairs: 2⁻⁴² of the norm.
pub const MOST_EXTENDED: f64 = 8.0;

/// A formula f(z) whose value is one function.
#[derive(Clone, Debug)]
pub struct SpecialFormula {
    /// The function.
    pub prim: Prim,
    /// Its name.
    pub name: &'static str,
    /// The program.
    pub text: String,
}

/// Names of arguments as the function reference writes them, the likeliest to be the variable first.
const VARIABLES: [&str; 8] = ["z", "s", "u", "τ", "m", "x", "a", "w"];

/// What stands for an argument that is not the variable.
fn constant(name: &str) -> &'static str {
    match name {
        "k" => "0",
        "q" => "0.3",
        "a" | "b" | "m" => "0.5",
        "c" => "1.5",
        "τ" => "i",
        "g₂" => "4",
        _ => "1",
    }
}

/// One formula for each function of the operator table that has a definition on complex numbers.
#[must_use]
pub fn special_formulas() -> Vec<SpecialFormula> {
    let defined = table::rows()
        .iter()
        .filter(|row| row.is_written() && row.is_defined(true));
    defined
        .filter_map(|row| {
            let (name, rest) = row.usage.split_once('(')?;
            let arguments: Vec<&str> = rest.trim_end_matches(')').split(", ").collect();
            let variable = VARIABLES.iter().find(|name| arguments.contains(name));
            let written = arguments.iter().map(|argument| {
                if Some(argument) == variable || arguments.len() == 1 {
                    "z"
                } else {
                    constant(argument)
                }
            });
            let written: Vec<&str> = written.collect();
            let name = row.names.iter().find(|&&n| n == name.trim())?;
            let text = format!("f(z) = {name}({})\n", written.join(", "));
            Some(SpecialFormula {
                prim: row.prim,
                name,
                text,
            })
        })
        .collect()
}

/// The functions of a WGSL text, with their bodies, in its order.
#[must_use]
pub fn functions_of(text: &str) -> Vec<(&str, &str)> {
    let mut functions = Vec::new();
    for part in text.split("\nfn ").skip(1) {
        let name = part.split_once('(').map_or("", |(name, _)| name);
        let body = part.split_once('{').map_or("", |(_, body)| body);
        functions.push((name, body));
    }
    functions
}
