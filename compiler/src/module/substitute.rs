//! Replacing the inputs of an expression by other expressions.

use crate::ir::{Graph, Id, Op, transcribe};

/// Copies what the roots depend on into `to`, with each input replaced. Names of values are kept.
pub fn substitute(
    from: &Graph,
    roots: &[Id],
    to: &mut Graph,
    mut input: impl FnMut(&mut Graph, u16) -> Id,
) -> Vec<Id> {
    transcribe(from, roots, to, |to, node, args| match node.op {
        Op::Input(k) => input(to, k),
        Op::Apply(prim) => to.apply(prim, args),
        op => to.leaf(op, node.ty),
    })
}
