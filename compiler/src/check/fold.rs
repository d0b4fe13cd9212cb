//! Loops that depend on nothing are computed once and for all, in `f64`.

use rustc_hash::FxHashSet;
use smallvec::SmallVec;

use crate::eval::{Leaves, Tape};
use crate::ir::{Graph, Id, Op};
use crate::table::Number;

/// Most nodes of a loop that is looked at.
const MAX_VISITS: usize = 20_000;

/// The operations that a builder may still spend on loops that are constant: beyond, they stay loops.
#[derive(Clone, Copy, Debug)]
pub struct FoldBudget(u64);

impl Default for FoldBudget {
    fn default() -> Self {
        Self(Self::WHOLE)
    }
}

impl FoldBudget {
    const WHOLE: u64 = 2_000_000;

    /// The operations that were spent.
    pub fn spent(self) -> u64 {
        Self::WHOLE - self.0
    }

    /// The values of a loop's results, where it is constant and the budget is large enough. `steps` is the number
    /// of its steps times those of the loops within it.
    pub fn fold(
        &mut self,
        graph: &mut Graph,
        results: &[Id],
        steps: u64,
    ) -> Option<SmallVec<[Id; 4]>> {
        let size = constant_size(graph, results)?;
        // taking the loop out of the graph looks at every node
        let nodes = u64::try_from(graph.nodes().len()).unwrap_or(u64::MAX);
        let cost = size.saturating_mul(steps).saturating_add(nodes);
        self.0 = self.0.checked_sub(cost)?;
        let leaves = Leaves {
            inputs: &[],
            params: &[],
            time: f64::NAN,
            pixel: f64::NAN,
        };
        let mut values: SmallVec<[Number; 4]> = SmallVec::new();
        Tape::new(graph, results).run(&leaves, |value| values.push(value));
        let constant = |value| match value {
            Number::Real(x) => graph.real(x),
            Number::Complex(z) => graph.complex(z.re, z.im),
            Number::Truth(truth) => graph.truth(truth),
        };
        Some(values.into_iter().map(constant).collect())
    }
}

/// The number of nodes that the roots depend on, where none of them is an input, a parameter, the clock, the
/// footprint, or a state of a loop around.
fn constant_size(graph: &Graph, roots: &[Id]) -> Option<u64> {
    let mut seen: FxHashSet<Id> = FxHashSet::default();
    let mut stack: Vec<Id> = roots.to_vec();
    let (mut used, mut bound) = (FxHashSet::default(), FxHashSet::default());
    while let Some(id) = stack.pop() {
        if !seen.insert(id) {
            continue;
        }
        if seen.len() > MAX_VISITS {
            return None;
        }
        let node = graph.node(id);
        match node.op {
            Op::Input(_) | Op::Param(_) | Op::Time | Op::Pixel | Op::Variable(_) => return None,
            Op::State(binder, _) | Op::Counter(binder) => {
                used.insert(binder);
            }
            Op::Loop { binder, .. } => {
                bound.insert(binder);
            }
            Op::Const(_) | Op::Truth(_) | Op::Result(_) | Op::Apply(_) => {}
        }
        stack.extend(node.args.iter().copied());
    }
    let is_closed = used.is_subset(&bound);
    is_closed.then(|| u64::try_from(seen.len()).unwrap_or(u64::MAX))
}
