//! Replacing the inputs of an expression by other expressions.

use rustc_hash::FxHashMap;

use crate::ir::{Graph, Id, Op};

/// Copies what the roots depend on into `to`, with each input replaced. Names of values are kept.
pub fn substitute(
    from: &Graph,
    roots: &[Id],
    to: &mut Graph,
    mut input: impl FnMut(&mut Graph, u16) -> Id,
) -> Vec<Id> {
    let live = from.reachable(roots);
    let mut map: FxHashMap<Id, Id> = FxHashMap::default();
    for (id, node) in from.ids().zip(from.nodes()) {
        if !live[id.index()] {
            continue;
        }
        let new = match node.op {
            Op::Input(k) => input(to, k),
            Op::Apply(prim) => {
                let args: Vec<Id> = node
                    .args
                    .iter()
                    .filter_map(|a| map.get(a).copied())
                    .collect();
                to.apply(prim, &args)
            }
            op => to.leaf(op, node.ty),
        };
        if let Some(name) = from.name(id) {
            to.set_name(new, name);
        }
        map.insert(id, new);
    }
    roots.iter().filter_map(|r| map.get(r).copied()).collect()
}
