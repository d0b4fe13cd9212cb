//! Joining loops that take the same steps, such as a loop and its extensions by tangents.

use std::borrow::Cow;

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::{Binder, Graph, Id, Loop, Op, Regions};

/// What loops that may be joined have in common: binder, limit, count, condition, and where they stand.
type Frame = (Binder, u32, Id, Option<Id>, SmallVec<[Binder; 4]>);

/// Joins loops with one binder, count and condition to one loop with the states of all, where none of them needs
/// a result of another. The roots keep their values bit for bit.
#[must_use]
pub fn merge_loops<'g>(graph: &'g Graph, roots: &[Id]) -> (Cow<'g, Graph>, Vec<Id>) {
    let unchanged = || (Cow::Borrowed(graph), roots.to_vec());
    if !graph.has_loops() {
        return unchanged();
    }
    let live = graph.reachable(roots);
    let Some(joined) = joined(graph, &live) else {
        return unchanged();
    };
    match rebuild(graph, roots, &live, &joined) {
        Some((merged, roots)) => (Cow::Owned(merged), roots),
        None => unchanged(),
    }
}

/// For each loop that is to be joined with others, the place of its union; `None` where there is nothing to join.
struct Joined {
    union_of: FxHashMap<Id, usize>,
    unions: Vec<Loop>,
}

fn joined(graph: &Graph, live: &[bool]) -> Option<Joined> {
    let regions = Regions::new(graph, live);
    let mut groups: FxHashMap<Frame, Vec<Id>> = FxHashMap::default();
    let mut order: Vec<Frame> = Vec::new();
    for id in graph.ids().take(live.len()) {
        if !live[id.index()] {
            continue;
        }
        let Some(it) = graph.as_loop(id) else {
            continue;
        };
        let place = SmallVec::from_slice(regions.of(id));
        let frame = (it.binder, it.limit, it.count, it.until, place);
        let members = groups.entry(frame.clone()).or_default();
        if members.is_empty() {
            order.push(frame);
        }
        members.push(id);
    }
    let mut out = Joined {
        union_of: FxHashMap::default(),
        unions: Vec::new(),
    };
    for frame in order {
        let members = groups.remove(&frame).unwrap_or_default();
        if members.len() > 1 {
            join(graph, live, &members, &mut out);
        }
    }
    (!out.unions.is_empty()).then_some(out)
}

/// Joins as many of the members as do not need one another, in their order.
fn join(graph: &Graph, live: &[bool], members: &[Id], out: &mut Joined) {
    let mut union: Option<Loop> = None;
    let mut inside: Vec<Id> = Vec::new();
    for &member in members {
        let Some(mut it) = graph.as_loop(member) else {
            continue;
        };
        it.states.retain(|state| live[state.leaf.index()]);
        let Some(union) = &mut union else {
            union = Some(it);
            inside.push(member);
            continue;
        };
        let needs = graph.reachable(&[member]);
        let agrees = it.states.iter().all(|state| {
            let twin = union.states.iter().find(|s| s.leaf == state.leaf);
            twin.is_none_or(|twin| twin == state)
        });
        if !agrees || inside.iter().any(|id| needs[id.index()]) {
            continue;
        }
        for state in it.states {
            if !union.states.contains(&state) {
                union.states.push(state);
            }
        }
        inside.push(member);
    }
    if let (Some(union), true) = (union, inside.len() > 1) {
        for id in inside {
            out.union_of.insert(id, out.unions.len());
        }
        out.unions.push(union);
    }
}

/// The graph with each union in the place of its members; `None` where unions need one another in a circle.
fn rebuild(
    graph: &Graph,
    roots: &[Id],
    live: &[bool],
    joined: &Joined,
) -> Option<(Graph, Vec<Id>)> {
    let mut out = graph.emptied();
    let mut map: Vec<Option<Id>> = vec![None; live.len()];
    let mut loops: FxHashMap<usize, Id> = FxHashMap::default();
    let mut open = vec![false; live.len()];
    let mut stack: Vec<(Id, bool)> = roots.iter().rev().map(|&r| (r, false)).collect();
    while let Some((id, ready)) = stack.pop() {
        if map[id.index()].is_some() {
            continue;
        }
        let union = joined.union_of.get(&id).copied();
        let it = union
            .map(|k| joined.unions[k].clone())
            .or_else(|| graph.as_loop(id));
        let operands: SmallVec<[Id; 8]> = match &it {
            Some(it) => it.operands().filter(|a| live[a.index()]).collect(),
            None => graph.node(id).args.iter().copied().collect(),
        };
        if !ready {
            if std::mem::replace(&mut open[id.index()], true) {
                return None;
            }
            stack.push((id, true));
            let missing = |a: &Id| map[a.index()].is_none();
            stack.extend(operands.into_iter().filter(missing).map(|a| (a, false)));
            continue;
        }
        let known = union.and_then(|k| loops.get(&k).copied());
        let new = match (known, it) {
            (Some(known), _) => known,
            (None, Some(mut it)) => {
                it.states.retain(|state| live[state.leaf.index()]);
                it.rename(|old| map[old.index()].unwrap_or(old));
                out.repeat(&it)
            }
            (None, None) => {
                let node = graph.node(id);
                let args: SmallVec<[Id; 4]> =
                    node.args.iter().filter_map(|a| map[a.index()]).collect();
                out.intern(node.op, node.ty, &args)
            }
        };
        if let (Op::Loop { .. }, Some(k)) = (graph.node(id).op, union) {
            loops.insert(k, new);
        }
        out.cover(graph.span(id));
        if let Some(name) = graph.name(id) {
            out.set_name(new, name);
        }
        map[id.index()] = Some(new);
    }
    let roots: Option<Vec<Id>> = roots.iter().map(|r| map[r.index()]).collect();
    Some((out, roots?))
}
