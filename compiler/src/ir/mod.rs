//! The intermediate representation: one hash-consed graph of typed scalar and complex operations.
//!
//! Vectors do not occur here: the checker takes them apart, so that every pass sees numbers only.

mod cost;
mod graph;
mod op;
mod powers;
mod text;
mod verify;

pub use cost::{Cost, cost};
pub use graph::{Graph, Id, Node, OverBudget};
pub use op::{Op, Prim, Ty};
pub use powers::expand_powers;
pub use text::{ParseError, parse_text, to_text};
pub use verify::{Invalid, verify};
