//! What is declared about the errors of functions that are defined in the language.
//!
//! The goal is a multiple of the unit u of the format (2⁻²⁴, 2⁻⁴⁸, 2⁻⁵³) of the norm of the value, and what changes of the arguments
//! by u move: 16 u and 2 u in `accurate`, four times that in `extended`, sixteen times in `double`; of derivatives four times as much.

/// The beginning of the name of a table of references, by how much `accurate` exceeds the goal there, and why.
type Excess = (&'static str, f64, &'static str);

const EXCESS: [Excess; 9] = [
    ("jacobi_theta1", 2.5, STEPS),
    ("jacobi_theta2", 1.5, STEPS),
    ("jacobi_theta3", 2.0, STEPS),
    ("jacobi_theta4", 1.75, STEPS),
    ("jacobi_sn", 2.0, PERIOD),
    ("jacobi_cn", 2.0, PERIOD),
    ("weierstrass_p_invariants", 2.0, PERIOD),
    ("weierstrass_p_prime_invariants", 1.25, PERIOD),
    ("weierstrass_p", 2.0, ZEROS),
];
const STEPS: &str =
    "each inversion of τ rounds z and τ; near the unit circle and the zeros there are several";
const ZEROS: &str =
    "about the double zeros of the square lattice the terms, as large as π²/3, cancel";
const PERIOD: &str = "the argument is divided by a period that has three roundings";

/// By how much the error of a function may exceed the goal in `accurate`, and why: 1 where it does not. `name` is that of its table of
/// references, or its own.
#[must_use]
pub fn excess(name: &str) -> (f64, &'static str) {
    let found = EXCESS.iter().find(|(word, ..)| name.starts_with(word));
    found.map_or((1.0, ""), |&(_, factor, reason)| (factor, reason))
}
