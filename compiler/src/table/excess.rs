//! What is declared about the errors of functions that are defined in the language.
//!
//! The goal is a multiple of the unit u of the format (2⁻²⁴, 2⁻⁴⁸, 2⁻⁵³) of the norm of the value, and what changes of the arguments
//! by u move: 16 u and 2 u in `accurate`, four times that in `extended`, sixteen times in `double`; of derivatives four times as much.

/// The beginning of the name of a table of references, by how much `accurate` exceeds the goal there, and why.
type Excess = (&'static str, f64, &'static str);

const EXCESS: [Excess; 7] = [
    ("airy_bi_real", 1.75, AXIS),
    ("airy_ai_prime_real", 1.75, AXIS),
    ("euler_beta", 1.75, PRODUCTS),
    ("hurwitz_zeta", 1.25, TAIL),
    ("hypergeometric_ab", 8.0, MIXED),
    ("hypergeometric", 1.25, TERMS),
    ("zeta", 1.25, TAIL),
];
const AXIS: &str = "on the negative real axis the real part of a product with e^-ζ, whose exponent has a rounded real part";
const PRODUCTS: &str = "left of 0 it is a product of Γ and many quotients";
const TAIL: &str = "left of 1 the sum and what is left of it have opposite signs";
const TERMS: &str = "where z is negative or c next to 0 its terms have both signs";
const MIXED: &str =
    "where z is negative the terms of its derivative by a and b have both signs, and are larger";

/// By how much the error of a function may exceed the goal in `accurate`, and why: 1 where it does not. `name` is that of its table of
/// references, or its own.
#[must_use]
pub fn excess(name: &str) -> (f64, &'static str) {
    let found = EXCESS.iter().find(|(word, ..)| name.starts_with(word));
    found.map_or((1.0, ""), |&(_, factor, reason)| (factor, reason))
}
