//! Stability rewrites: what a person writes naturally is computed without cancellation and overflow.
//!
//! The difference of two values of a function is computed from the difference of its arguments, which is formed
//! exactly where terms cancel ([`difference`](self)); beside that stand closed identities. Each rewrite is a
//! [`Record`]: its equation, and where it holds in floating point. "Unknown" means no.
//!
//! Rules run twice. Those that keep derivatives good change the formula before it is differentiated, and what a
//! derivative within a formula is taken of; all of them run over what is computed in the end, values and derivatives
//! alike. The `f64` reference runs none: it computes what is written.

mod cardinal;
mod explain;
mod functions;
mod guard;
mod identity;
mod logarithms;
mod pass;
mod polynomial;
mod powers;
mod quotient;
mod range;
mod remainder;
mod rule;
mod sum;

pub(crate) use explain::scalar_names;
pub use explain::{Explanation, Step, explain};
pub use pass::{Applied, Stable, stabilise};
pub use rule::{RULES, Record, Rewrites, Rule};

use crate::ir::{Graph, Id, Op, transcribe};

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

/// What is differentiated where a derivative stands in a formula: the roots, in the same graph, rewritten by those of the
/// rules that keep derivatives good; `None` where none applies. Roots with loops stay: a value and its tangents share those.
#[must_use]
pub fn before_derivative(graph: &mut Graph, roots: &[Id], rewrites: Rewrites) -> Option<Vec<Id>> {
    if !rewrites.any() {
        return None;
    }
    let live = graph.reachable(roots);
    let of_loop = |op| {
        matches!(
            op,
            Op::State(..) | Op::Counter(_) | Op::Loop { .. } | Op::Result(_)
        )
    };
    if (graph.nodes().iter().zip(&live)).any(|(node, live)| *live && of_loop(node.op)) {
        return None;
    }
    let stable = stabilise(graph, roots, rewrites, Phase::Early);
    if stable.applied.is_empty() {
        return None;
    }
    Some(transcribe(
        &stable.graph,
        &stable.roots,
        graph,
        |g, node, args| g.intern(node.op, node.ty, args),
    ))
}

#[cfg(test)]
mod tests;
