//! Counted cost of an expression.

use super::{Graph, Id, Op, Prim, Ty, expand_powers};
use crate::table;

/// Cost of an expression after common subexpressions, integer powers counted as products.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Number of operations; leaves and constants are free.
    pub operations: u32,
    /// Operations weighted by the operator table (one addition or multiplication of reals is 1).
    pub weighted: u32,
}

/// Cost of computing all the roots together.
#[must_use]
pub fn cost(graph: &Graph, roots: &[Id]) -> Cost {
    let (graph, roots) = expand_powers(graph, roots);
    let live = graph.reachable(&roots);
    let mut total = Cost::default();
    for (id, node) in graph.ids().zip(graph.nodes()) {
        let Op::Apply(prim) = node.op else { continue };
        if !live[id.index()] {
            continue;
        }
        let complex =
            node.ty == Ty::Complex || node.args.iter().any(|&a| graph.ty(a) == Ty::Complex);
        let row = table::row(prim);
        let weight = match table::pair(prim) {
            // the second of a pair that is computed together
            Some(pair) if follows_partner(&graph, &live, id, pair.partner) => pair.extra,
            _ => row.cost,
        };
        let weight = if complex { weight.complex } else { weight.real };
        if weight > 0 {
            total.operations += 1;
            total.weighted += u32::from(weight);
        }
    }
    total
}

fn follows_partner(graph: &Graph, live: &[bool], id: Id, partner: Prim) -> bool {
    let partner = graph.find_unary(partner, graph.node(id).args[0]);
    partner.is_some_and(|p| p < id && live[p.index()])
}
