//! Which nodes change when a leaf does.

use crate::ir::{Graph, Id, Loop, Op, Prim, Ty};
use crate::table::{self, Derivative};

/// For each live node, whether its value depends on one of the leaves in a way that has a derivative: not only through
/// conditions, counts of steps or functions that are locally constant.
pub fn activity(g: &Graph, live: &[bool], leaves: &[Id]) -> Vec<bool> {
    let mut active = vec![false; live.len()];
    for leaf in leaves {
        if let Some(slot) = active.get_mut(leaf.index()) {
            *slot = true;
        }
    }
    let constant = |op| match op {
        Op::Apply(prim) => matches!(table::row(prim).derivative, Derivative::Zero),
        _ => false,
    };
    spread(g, live, &mut active, |op, ty, args| {
        ty != Ty::Bool && !constant(op) && args.contains(&true)
    });
    active
}

/// For each live node, whether it is complex and depends on z̄ as well as on z where `active` nodes depend on z.
pub fn conjugate_activity(g: &Graph, live: &[bool], active: &[bool]) -> Vec<bool> {
    let mut bar: Vec<bool> = vec![false; live.len()];
    for id in g.ids().take(live.len()) {
        let conjugates = match g.node(id).op {
            Op::Apply(Prim::Conj) => true,
            Op::Apply(_) => {
                let args = &g.node(id).args;
                args.iter()
                    .any(|&a| g.ty(a) == Ty::Real && active[a.index()])
            }
            _ => false,
        };
        bar[id.index()] = conjugates && active[id.index()] && g.ty(id) == Ty::Complex;
    }
    spread(g, live, &mut bar, |_, ty, args| {
        ty == Ty::Complex && args.contains(&true)
    });
    bar
}

/// Spreads marks from operands to their users until nothing changes; a state of a loop is marked where its start or
/// its next value is.
fn spread(g: &Graph, live: &[bool], marks: &mut [bool], takes: impl Fn(Op, Ty, &[bool]) -> bool) {
    let loops: Vec<Option<Loop>> = if g.has_loops() {
        g.ids().take(live.len()).map(|id| g.as_loop(id)).collect()
    } else {
        Vec::new()
    };
    let mut of_args: smallvec::SmallVec<[bool; 3]> = smallvec::SmallVec::new();
    loop {
        let mut again = false;
        for id in g.ids().take(live.len()) {
            if !live[id.index()] || marks[id.index()] {
                continue;
            }
            let node = g.node(id);
            match node.op {
                Op::Loop { .. } => {}
                Op::Result(index) => {
                    let it = loops[node.args[0].index()].as_ref();
                    marks[id.index()] = it.is_some_and(|it| {
                        let mut states = it.states.iter();
                        states.any(|s| {
                            matches!(g.node(s.leaf).op, Op::State(_, k) if k == index)
                                && (marks[s.leaf.index()] || marks[s.init.index()])
                        })
                    });
                }
                _ => {
                    of_args.clear();
                    of_args.extend(node.args.iter().map(|a| marks[a.index()]));
                    marks[id.index()] = takes(node.op, node.ty, &of_args);
                }
            }
        }
        for (index, it) in loops.iter().enumerate() {
            let Some(it) = it else { continue };
            if !live[index] {
                continue;
            }
            for state in &it.states {
                if live[state.leaf.index()]
                    && !marks[state.leaf.index()]
                    && (marks[state.init.index()] || marks[state.next.index()])
                {
                    marks[state.leaf.index()] = true;
                    again = true;
                }
            }
        }
        if !again {
            return;
        }
    }
}
