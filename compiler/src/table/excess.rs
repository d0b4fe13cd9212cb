//! What is declared about the errors of functions that are defined in the language.
//!
//! The goal is a multiple of the unit u of the format (2⁻²⁴, 2⁻⁴⁸, 2⁻⁵³) of the norm of the value, and what changes of the arguments
//! by u move: 16 u and 2 u in `accurate`, four times that in `extended`, sixteen times in `double`; of derivatives four times as much.

/// The beginning of the name of a table of references, by how much `accurate` exceeds the goal there, and why.
type Excess = (&'static str, f64, &'static str);

const EXCESS: [Excess; 0] = [];

/// By how much the error of a function may exceed the goal in `accurate`, and why: 1 where it does not. `name` is that of its table of
/// references, or its own.
#[must_use]
pub fn excess(name: &str) -> (f64, &'static str) {
    let found = EXCESS.iter().find(|(word, ..)| name.starts_with(word));
    found.map_or((1.0, ""), |&(_, factor, reason)| (factor, reason))
}
