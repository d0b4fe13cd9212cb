//! In what order the nodes of a graph are computed: outside of loops, and in each loop's steps.

use rustc_hash::FxHashMap;

use super::{Graph, Id, Loop, Op, Regions};

/// The order in which nodes are computed.
#[derive(Debug)]
pub struct Schedule {
    /// What is computed once, operands before users; loops stand for their steps.
    pub top: Vec<Id>,
    loops: FxHashMap<Id, Plan>,
}

/// What a loop does.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The loop, with those of its states that are wanted.
    pub it: Loop,
    /// The leaf for the number of steps done, where the body uses it.
    pub counter: Option<Id>,
    /// What its condition needs, in each step.
    pub before: Vec<Id>,
    /// What its states need beyond that, in each step.
    pub after: Vec<Id>,
    /// The nodes that are its final states.
    pub results: Vec<Id>,
}

impl Schedule {
    /// The schedule of what the roots depend on.
    #[must_use]
    pub fn new(graph: &Graph, roots: &[Id]) -> Self {
        let live = graph.reachable(roots);
        let regions = Regions::new(graph, &live);
        let mut loops: FxHashMap<Id, Plan> = FxHashMap::default();
        let mut top = Vec::new();
        for (id, node) in graph.ids().zip(graph.nodes()) {
            if !live[id.index()] {
                continue;
            }
            if let (Op::Result(_), Some(repeated)) = (node.op, node.args.first()) {
                if let Some(plan) = loops.get_mut(repeated) {
                    plan.results.push(id);
                }
                continue;
            }
            if let Some(mut it) = graph.as_loop(id) {
                it.states.retain(|state| live[state.leaf.index()]);
                loops.insert(id, plan(graph, &regions, it));
            }
            if regions.of(id).is_empty() {
                top.push(id);
            }
        }
        Self { top, loops }
    }

    /// What a loop node does.
    #[must_use]
    pub fn plan(&self, repeated: Id) -> Option<&Plan> {
        self.loops.get(&repeated)
    }
}

fn plan(graph: &Graph, regions: &Regions, it: Loop) -> Plan {
    let mut out = Plan {
        counter: None,
        before: Vec::new(),
        after: Vec::new(),
        results: Vec::new(),
        it,
    };
    let mut body = Vec::new();
    let mut seen = rustc_hash::FxHashSet::default();
    let condition: Vec<Id> = out.it.until.into_iter().collect();
    let steps: Vec<Id> = out.it.states.iter().map(|state| state.next).collect();
    for (roots, wanted) in [(condition, true), (steps, false)] {
        body.clear();
        collect(graph, regions, &out.it, roots, &mut seen, &mut body);
        body.sort_unstable();
        for &id in &body {
            match graph.node(id).op {
                Op::Counter(_) => out.counter = Some(id),
                Op::State(..) | Op::Result(_) => {}
                _ if wanted => out.before.push(id),
                _ => out.after.push(id),
            }
        }
    }
    out
}

/// The nodes that are computed in each step of a loop itself, not in the loops within, and were not seen before.
fn collect(
    graph: &Graph,
    regions: &Regions,
    it: &Loop,
    mut stack: Vec<Id>,
    seen: &mut rustc_hash::FxHashSet<Id>,
    body: &mut Vec<Id>,
) {
    while let Some(id) = stack.pop() {
        if !regions.of(id).contains(&it.binder) || !seen.insert(id) {
            continue;
        }
        if regions.innermost(id) == Some(it.binder) {
            body.push(id);
        }
        stack.extend(graph.node(id).args.iter().copied());
    }
}
