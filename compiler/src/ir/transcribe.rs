//! Copying expressions from one graph to another, node by node.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::{Binder, Graph, Id, Node, Op};

/// Copies what the roots depend on from `from` to `to`, names and places included, and gives the roots there. `each` makes the
/// new node of every old one that is no part of a loop's frame from its copied operands; it must keep the type. States
/// that no root depends on are left out.
pub fn transcribe(
    from: &Graph,
    roots: &[Id],
    to: &mut Graph,
    mut each: impl FnMut(&mut Graph, &Node, &[Id]) -> Id,
) -> Vec<Id> {
    let live = from.reachable(roots);
    let mut map: Vec<Option<Id>> = vec![None; live.len()];
    let mut binders: FxHashMap<Binder, Binder> = FxHashMap::default();
    for (id, node) in from.ids().zip(from.nodes()) {
        if !live[id.index()] {
            continue;
        }
        let copied = |a: &Id| map[a.index()];
        let new = match node.op {
            Op::State(binder, index) => {
                let binder = *binders.entry(binder).or_insert_with(|| to.binder());
                to.state(binder, index, node.ty)
            }
            Op::Counter(binder) => {
                let binder = *binders.entry(binder).or_insert_with(|| to.binder());
                to.counter(binder)
            }
            Op::Loop { .. } => {
                let Some(mut it) = from.as_loop(id) else {
                    continue;
                };
                it.binder = *binders.entry(it.binder).or_insert_with(|| to.binder());
                it.states.retain(|state| live[state.leaf.index()]);
                it.rename(|old| map[old.index()].unwrap_or(old));
                to.repeat(&it)
            }
            Op::Result(_) => {
                let args: SmallVec<[Id; 3]> = node.args.iter().filter_map(copied).collect();
                to.intern(node.op, node.ty, &args)
            }
            _ => {
                let args: SmallVec<[Id; 4]> = node.args.iter().filter_map(copied).collect();
                each(to, node, &args)
            }
        };
        to.cover(from.span(id));
        if let Some(name) = from.name(id) {
            to.set_name(new, name);
        }
        if let Some(slopes) = from
            .slopes(id)
            .and_then(|s| s.mapped(|old| map[old.index()]))
        {
            to.set_slopes(new, slopes);
        }
        map[id.index()] = Some(new);
    }
    roots.iter().filter_map(|r| map[r.index()]).collect()
}
