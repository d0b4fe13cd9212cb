//! Counted cost of an expression.

use rustc_hash::FxHashMap;

use super::{Binder, Graph, Id, Op, Prim, Regions, SINGLE_CALLS, Ty, expand_powers, merge_loops};
use crate::table;

/// Cost of an expression after common subexpressions, integer powers counted as products.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Number of operations; leaves and constants are free.
    pub operations: u32,
    /// Operations weighted by the operator table (one addition or multiplication of reals is 1).
    pub weighted: u32,
}

/// Cost of computing all the roots together. What is in a loop counts as often as the loop can step.
#[must_use]
pub fn cost(graph: &Graph, roots: &[Id]) -> Cost {
    let (graph, roots) = expand_powers(graph, roots, &SINGLE_CALLS);
    let (graph, roots) = merge_loops(&graph, &roots);
    let live = graph.reachable(&roots);
    let steps = steps(&graph, &live);
    let regions = (!steps.is_empty()).then(|| Regions::new(&graph, &live));
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
            let times = regions.as_ref().map_or(1, |regions| {
                let loops = regions.of(id).iter();
                loops.fold(1, |times: u32, binder| {
                    times.saturating_mul(steps.get(binder).copied().unwrap_or(1))
                })
            });
            total.operations = total.operations.saturating_add(times);
            let weight = u32::from(weight).saturating_mul(times);
            total.weighted = total.weighted.saturating_add(weight);
        }
    }
    total
}

/// How many steps the loops of each binder do at most.
fn steps(graph: &Graph, live: &[bool]) -> FxHashMap<Binder, u32> {
    let mut out = FxHashMap::default();
    for id in graph.ids().filter(|id| live[id.index()]) {
        let Some(it) = graph.as_loop(id) else {
            continue;
        };
        let steps = graph.as_real(it.count).map_or(it.limit, |count| {
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a float is kept within the range of the integer"
            )]
            let count = count as u32;
            count.min(it.limit)
        });
        out.insert(it.binder, steps);
    }
    out
}

fn follows_partner(graph: &Graph, live: &[bool], id: Id, partner: Prim) -> bool {
    let partner = graph.find_unary(partner, graph.node(id).args[0]);
    partner.is_some_and(|p| p < id && live[p.index()])
}
