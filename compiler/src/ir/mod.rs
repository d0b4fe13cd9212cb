//! The intermediate representation: one hash-consed graph of typed scalar and complex operations.
//!
//! Vectors do not occur here: the checker takes them apart, so that every pass sees numbers only.

mod branches;
mod cost;
mod graph;
mod infix;
mod loops;
mod merge;
mod op;
mod powers;
mod regions;
mod replace;
mod schedule;
mod slopes;
mod text;
mod transcribe;
mod verify;

pub use branches::has_branches;
pub use cost::{Cost, cost};
pub use graph::{Graph, Id, Node, OverBudget};
pub use infix::{LeafNames, to_infix};
pub use loops::{Loop, State};
pub use merge::merge_loops;
pub use op::{Binder, Op, Prim, Ty};
pub use powers::{NO_CALLS, SINGLE_CALLS, expand_powers};
pub use regions::Regions;
pub use schedule::{Plan, Schedule};
pub use slopes::Slopes;
pub use text::{ParseError, parse_text, to_text};
pub use transcribe::transcribe;
pub use verify::{Invalid, verify};
