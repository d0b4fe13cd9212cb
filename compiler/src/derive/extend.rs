//! A loop with further states that are the tangents of its own.

use crate::ir::{Graph, Id, Op, State, Ty};

use super::rules::zero_like;

/// The leaves of states that are live and active.
pub fn states(g: &Graph, live: &[bool], active: &[bool]) -> Vec<Id> {
    let is_wanted = |id: &Id| {
        let k = id.index();
        live[k] && active[k] && matches!(g.node(*id).op, Op::State(..))
    };
    g.ids().take(live.len()).filter(is_wanted).collect()
}

/// The loop with a state for the tangent of each of its live states that has one; `tangent` gives that of any node.
/// `None` where none has.
///
/// Griewank and Walther, Evaluating Derivatives, 2nd edition, section 3.1: the tangent of an iteration is the
/// iteration of the tangents. The number of steps is locally constant.
pub fn extend(
    g: &mut Graph,
    repeated: Id,
    live: &[bool],
    tangent: impl Fn(Id) -> Option<Id>,
) -> Option<Id> {
    let mut it = g.as_loop(repeated)?;
    it.states.retain(|state| live[state.leaf.index()]);
    let own = it.states.clone();
    for state in &own {
        let Some(leaf) = tangent(state.leaf) else {
            continue;
        };
        let ty = g.ty(leaf);
        let mut of = |node: Id| match tangent(node) {
            None => zero_like(g, ty),
            Some(t) if ty == Ty::Complex => g.widen(t),
            Some(t) => t,
        };
        let (init, next) = (of(state.init), of(state.next));
        // a second derivative by one variable meets the first one's tangents again: the same rules have made the same
        // nodes
        if own.iter().all(|state| state.leaf != leaf) {
            it.states.push(State { leaf, init, next });
        }
    }
    let any = own.iter().any(|state| tangent(state.leaf).is_some());
    any.then(|| g.repeat(&it))
}
