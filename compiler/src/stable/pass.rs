//! The walk over a graph: each node is copied, and rewritten where a rule fits.

use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::SmallVec;

use super::Phase;
use super::polynomial::{Expand, Monomial, Polynomial, polynomial};
use super::rule::{Rewrites, Rule};
use crate::ir::{Graph, Id, Node, Op, Prim, Ty, transcribe};

/// Most nodes of a result that are searched for what must not get lost.
const MAX_SEARCH: usize = 256;

/// One rewrite that was done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Applied {
    /// The rules that took part, the last one first.
    pub rules: SmallVec<[Rule; 4]>,
    /// What it was, its operands rewritten before: a node of [`Stable::graph`].
    pub before: Id,
    /// What it has become: a node of [`Stable::graph`].
    pub after: Id,
}

/// A rewritten graph.
#[derive(Clone, Debug)]
pub struct Stable {
    /// The graph; it also holds what has been replaced.
    pub graph: Graph,
    /// The roots.
    pub roots: Vec<Id>,
    /// What was done, in the order of the graph.
    pub applied: Vec<Applied>,
}

/// Rewrites what the roots depend on. A graph that would get too large stays as it is.
#[must_use]
pub fn stabilise(graph: &Graph, roots: &[Id], rewrites: Rewrites, phase: Phase) -> Stable {
    let mut pass = Pass::new(rewrites, phase);
    let mut out = Graph::new();
    let mut tops = tops(graph, roots).into_iter();
    let new_roots = transcribe(graph, roots, &mut out, |g, node, args| {
        let top = tops.next().unwrap_or(false);
        pass.node(g, node, args, top)
    });
    if out.budget().is_err() {
        return Stable {
            graph: graph.clone(),
            roots: roots.to_vec(),
            applied: Vec::new(),
        };
    }
    keep_live(&out, &new_roots, &mut pass.applied);
    Stable {
        graph: out,
        roots: new_roots,
        applied: pass.applied,
    }
}

/// Keeps the rewrites whose results are used, by the roots or by what was rewritten again.
fn keep_live(g: &Graph, roots: &[Id], applied: &mut Vec<Applied>) {
    let mut live = g.reachable(roots);
    let mut kept = Vec::new();
    for step in applied.drain(..).rev() {
        if !live[step.after.index()] {
            continue;
        }
        let mut stack = vec![step.before];
        while let Some(id) = stack.pop() {
            if !std::mem::replace(&mut live[id.index()], true) {
                stack.extend(g.node(id).args.iter().copied());
            }
        }
        kept.push(step);
    }
    kept.reverse();
    *applied = kept;
}

/// For each node that [`transcribe`] asks about, in its order: whether something else than a sum needs it.
fn tops(graph: &Graph, roots: &[Id]) -> Vec<bool> {
    let live = graph.reachable(roots);
    let mut top = vec![false; live.len()];
    for root in roots {
        top[root.index()] = true;
    }
    for (id, node) in graph.ids().zip(graph.nodes()) {
        if live[id.index()] && !is_sum(node.op) {
            for arg in &node.args {
                top[arg.index()] = true;
            }
        }
    }
    let asked = |node: &Node| {
        !matches!(
            node.op,
            Op::State(..) | Op::Counter(_) | Op::Loop { .. } | Op::Result(_)
        )
    };
    let nodes = graph.nodes().iter().enumerate();
    nodes
        .filter(|(k, node)| live[*k] && asked(node))
        .map(|(k, _)| top[k])
        .collect()
}

fn is_sum(op: Op) -> bool {
    matches!(op, Op::Apply(Prim::Add | Prim::Sub | Prim::Neg))
}

/// What is known while a graph is rewritten.
pub(super) struct Pass {
    rewrites: Rewrites,
    pub(super) phase: Phase,
    /// The written form of what has been rewritten, always of a smaller index.
    plain: FxHashMap<Id, Id>,
    /// Rules that took part in the rewrite at hand.
    used: SmallVec<[Rule; 4]>,
    /// What has cancelled in the rewrite at hand.
    lost: SmallVec<[Id; 4]>,
    applied: Vec<Applied>,
    /// Whether differences that are not simplified count, too, where they are of inputs.
    pub(super) inputs_too: bool,
    /// Whether the sum at hand has just two terms.
    pub(super) alone: bool,
    /// Steps left for the rewrite at hand.
    pub(super) patience: usize,
    /// Differences that have no better form, and to which depth that is known: of two nodes, and whether inputs count.
    pub(super) hopeless: FxHashMap<(Id, Id, bool), usize>,
}

impl Pass {
    fn new(rewrites: Rewrites, phase: Phase) -> Self {
        Self {
            rewrites,
            phase,
            plain: FxHashMap::default(),
            used: SmallVec::new(),
            lost: SmallVec::new(),
            applied: Vec::new(),
            inputs_too: false,
            alone: false,
            patience: 0,
            hopeless: FxHashMap::default(),
        }
    }

    /// Whether a rule may be used now.
    pub(super) fn on(&self, rule: Rule) -> bool {
        self.rewrites.has(rule) && (self.phase == Phase::Late || rule.record().early)
    }

    /// Notes that a rule was used, and gives what it gave.
    pub(super) fn by<T>(&mut self, rule: Rule, result: T) -> Option<T> {
        if !self.used.contains(&rule) {
            self.used.push(rule);
        }
        Some(result)
    }

    /// Whether a rule has taken part in the rewrite at hand.
    pub(super) fn has_used(&self, rule: Rule) -> bool {
        self.used.contains(&rule)
    }

    /// How much has been noted, for [`Self::reset`].
    pub(super) fn marks(&self) -> (usize, usize) {
        (self.used.len(), self.lost.len())
    }

    /// Forgets what an attempt without success has noted.
    pub(super) fn reset(&mut self, used: usize, lost: usize) {
        self.used.truncate(used);
        self.lost.truncate(lost);
    }

    /// Notes what has cancelled.
    pub(super) fn lose(&mut self, p: &Polynomial) {
        for (atom, _) in p.lost.iter().flatten() {
            self.lose_atom(*atom);
        }
    }

    /// Notes one that has cancelled.
    pub(super) fn lose_atom(&mut self, atom: Id) {
        if !self.lost.contains(&atom) {
            self.lost.push(atom);
        }
    }

    /// The form in which a node was written.
    pub(super) fn plain(&self, id: Id) -> Id {
        self.plain.get(&id).copied().unwrap_or(id)
    }

    /// The operation and operands of a node as it was written.
    pub(super) fn view<'g>(&self, g: &'g Graph, id: Id) -> (Option<Prim>, &'g [Id]) {
        let node = g.node(self.plain(id));
        match node.op {
            Op::Apply(prim) => (Some(prim), &node.args),
            _ => (None, &node.args),
        }
    }

    /// The operand of a function of one operand.
    pub(super) fn argument(&self, g: &Graph, id: Id, prim: Prim) -> Option<Id> {
        match self.view(g, id) {
            (Some(found), &[a]) if found == prim => Some(a),
            _ => None,
        }
    }

    /// Reads a node as a polynomial.
    pub(super) fn polynomial(&self, g: &Graph, id: Id, expand: Expand) -> Option<Polynomial> {
        polynomial(g, &|id| self.plain(id), id, expand)
    }

    fn node(&mut self, g: &mut Graph, node: &Node, args: &[Id], top: bool) -> Id {
        let written = g.intern(node.op, node.ty, args);
        let Op::Apply(prim) = node.op else {
            return written;
        };
        if is_sum(node.op) && !top {
            return written;
        }
        self.used.clear();
        self.lost.clear();
        self.patience = 60;
        let new = match prim {
            Prim::Add | Prim::Sub => self.sum_node(g, written),
            _ => self.identity(g, prim, written),
        };
        let Some(new) = new.filter(|&new| new != written && g.ty(new) == node.ty) else {
            return written;
        };
        let new = self.keep_lost(g, new);
        if new > written {
            self.plain.insert(new, written);
        }
        self.applied.push(Applied {
            rules: self.used.clone(),
            before: written,
            after: new,
        });
        new
    }

    /// Adds 0 · a for each atom a that has cancelled and is nowhere else: where a is NaN or infinite, so is what was
    /// written.
    fn keep_lost(&self, g: &mut Graph, new: Id) -> Id {
        let mut out = new;
        for &atom in &self.lost {
            if !depends_on(g, out, atom) {
                let zero = g.real(0.0);
                let nothing = g.intern(Op::Apply(Prim::Mul), g.ty(atom), &[zero, atom]);
                if g.ty(nothing) == Ty::Real || g.ty(out) == Ty::Complex {
                    out = g.add(out, nothing);
                }
            }
        }
        out
    }
}

/// Whether an expression has a part; not further than [`MAX_SEARCH`] nodes.
fn depends_on(g: &Graph, id: Id, part: Id) -> bool {
    let mut seen = FxHashSet::default();
    let mut stack = vec![id];
    while let Some(next) = stack.pop() {
        if next == part {
            return true;
        }
        if next < part || seen.len() > MAX_SEARCH || !seen.insert(next) {
            continue;
        }
        stack.extend(g.node(next).args.iter().copied());
    }
    false
}

/// The one atom that a monomial is.
pub(super) fn only_atom(monomial: &Monomial) -> Option<Id> {
    match monomial.as_slice() {
        [(atom, 1)] => Some(*atom),
        _ => None,
    }
}
