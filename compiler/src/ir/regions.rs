//! Which loops a node belongs to.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::{Binder, Graph, Id, Op};

type Set = SmallVec<[Binder; 4]>;

/// For each node, the binders whose leaves it depends on, other than through a finished loop.
#[derive(Debug)]
pub struct Regions {
    sets: Vec<Set>,
    of_node: Vec<u32>,
    /// How many loops a binder's loops stand in.
    depths: FxHashMap<Binder, usize>,
}

impl Regions {
    /// The regions of the live nodes of a graph.
    #[must_use]
    pub fn new(graph: &Graph, live: &[bool]) -> Self {
        let mut out = Self {
            sets: vec![Set::new()],
            of_node: vec![0; live.len()],
            depths: FxHashMap::default(),
        };
        let mut known: FxHashMap<Set, u32> = FxHashMap::default();
        known.insert(Set::new(), 0);
        for (id, node) in graph.ids().zip(graph.nodes()) {
            if !live.get(id.index()).copied().unwrap_or(false) {
                continue;
            }
            let mut set = Set::new();
            if let Op::State(binder, _) | Op::Counter(binder) = node.op {
                set.push(binder);
            }
            let mut last = 0;
            for arg in &node.args {
                let index = out.of_node[arg.index()];
                if index == last || !live[arg.index()] {
                    continue;
                }
                last = index;
                set.extend(out.sets[index as usize].iter().copied());
            }
            if let Op::Loop { binder, .. } = node.op {
                set.retain(|b| *b != binder);
            }
            if set.is_empty() {
                continue;
            }
            set.sort_unstable();
            set.dedup();
            if let Op::Loop { binder, .. } = node.op {
                let depth = out.depths.entry(binder).or_default();
                *depth = (*depth).max(set.len());
            }
            let next = u32::try_from(out.sets.len()).unwrap_or(0);
            let index = *known.entry(set).or_insert_with_key(|set| {
                out.sets.push(set.clone());
                next
            });
            out.of_node[id.index()] = index;
        }
        out
    }

    /// The binders whose leaves a node depends on.
    #[must_use]
    pub fn of(&self, id: Id) -> &[Binder] {
        let index = self.of_node.get(id.index()).copied().unwrap_or(0);
        &self.sets[index as usize]
    }

    /// The loop in whose steps a node is computed; `None` outside of loops.
    #[must_use]
    pub fn innermost(&self, id: Id) -> Option<Binder> {
        let depth = |b: &&Binder| self.depths.get(*b).copied().unwrap_or(0);
        self.of(id).iter().max_by_key(depth).copied()
    }
}
