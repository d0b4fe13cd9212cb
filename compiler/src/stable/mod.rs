//! Stability rewrites: what a person writes naturally is computed without cancellation and overflow.
//!
//! The difference of two values of a function is computed from the difference of its arguments, which is formed
//! exactly where terms cancel ([`difference`](self)); beside that stand closed identities. Each rewrite is a
//! [`Record`]: its equation, and where it holds in floating point. "Unknown" means no.
//!
//! Rules run twice. Those that keep derivatives good change the formula before it is differentiated; all of them
//! run over what is computed in the end, values and derivatives alike. The `f64` reference runs none: it computes
//! what is written.

mod explain;
mod functions;
mod guard;
mod identity;
mod pass;
mod polynomial;
mod powers;
mod quotient;
mod range;
mod remainder;
mod rule;
mod sum;

pub use explain::{Explanation, Step, explain};
pub use pass::{Applied, Stable, stabilise};
pub use rule::{RULES, Record, Rewrites, Rule};

use crate::ir::{Graph, Id};

/// When a rewrite is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// On the written formula, before it is differentiated.
    Early,
    /// On what is computed.
    Late,
}

/// The graph with the roots rewritten for what is computed, values and derivatives.
#[must_use]
pub fn finish(graph: Graph, roots: Vec<Id>, rewrites: Rewrites) -> (Graph, Vec<Id>) {
    if !rewrites.any() {
        return (graph, roots);
    }
    let stable = stabilise(&graph, &roots, rewrites, Phase::Late);
    if stable.applied.is_empty() {
        return (graph, roots);
    }
    (stable.graph, stable.roots)
}

#[cfg(test)]
mod tests;
