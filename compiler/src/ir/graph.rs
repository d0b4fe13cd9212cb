//! The hash-consed expression graph.

use pullback_grammar::Span;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::{Binder, Loop, Op, Prim, Slopes, Ty, transcribe};

/// Index of a node. Operands have smaller indices than their users.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id(pub(super) u32);

impl Id {
    /// Position in [`Graph::nodes`].
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One operation with its operands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Node {
    /// What is computed.
    pub op: Op,
    /// Type of the result.
    pub ty: Ty,
    /// Operands.
    pub args: SmallVec<[Id; 3]>,
}

/// The graph has reached [`Graph::MAX_NODES`]; what was built since is not meaningful.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OverBudget;

/// Hash-consed expression graph: equal nodes are one node.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    ids: FxHashMap<Node, Id>,
    names: FxHashMap<Id, String>,
    pub(super) slopes: FxHashMap<Id, Slopes>,
    /// Where each node comes from in the text; nodes beyond the end come from nowhere yet.
    spans: Vec<Span>,
    /// Number of states that each binder has given out.
    pub(super) states_of: Vec<u16>,
    /// Number of bound variables that were given out.
    pub(super) variables: u32,
    /// Leaves of the tangents of states, by state, part and seeds.
    pub(super) tangent_states: FxHashMap<TangentKey, Id>,
    over_budget: bool,
}

type TangentKey = (Id, u8, Vec<(Id, Id)>);

impl Graph {
    /// Greatest number of nodes; a formula that needs more is refused.
    pub const MAX_NODES: usize = 2_000_000;

    /// An empty graph.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Every node, operands before users.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The node with this index.
    #[must_use]
    pub fn node(&self, id: Id) -> &Node {
        &self.nodes[id.index()]
    }

    /// Type of a node.
    #[must_use]
    pub fn ty(&self, id: Id) -> Ty {
        self.nodes[id.index()].ty
    }

    /// Ids of all nodes in order.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = Id> + use<> {
        (0..u32::try_from(self.nodes.len()).unwrap_or(u32::MAX)).map(Id)
    }

    /// Fails once the node budget has been used up.
    ///
    /// # Errors
    /// [`OverBudget`] where a node was refused.
    pub fn budget(&self) -> Result<(), OverBudget> {
        if self.over_budget {
            Err(OverBudget)
        } else {
            Ok(())
        }
    }

    /// Marks the budget as used up.
    pub(super) fn refuse(&mut self) {
        self.over_budget = true;
    }

    /// Adds a node as it is, without simplification, or finds the one that is equal to it. Sums and products
    /// are found in either order of their operands (both are commutative in IEEE 754 arithmetic).
    pub(crate) fn intern(&mut self, op: Op, ty: Ty, args: &[Id]) -> Id {
        let node = Node {
            op,
            ty,
            args: SmallVec::from_slice(args),
        };
        if let Some(&id) = self.ids.get(&node) {
            return id;
        }
        if let (Op::Apply(prim), &[a, b]) = (op, args)
            && prim.is_commutative()
        {
            let swapped = Node {
                op,
                ty,
                args: SmallVec::from_slice(&[b, a]),
            };
            if let Some(&id) = self.ids.get(&swapped) {
                return id;
            }
        }
        if self.nodes.len() >= Self::MAX_NODES {
            self.over_budget = true;
            return Id(0);
        }
        let id = Id(u32::try_from(self.nodes.len()).unwrap_or(0));
        self.nodes.push(node.clone());
        self.ids.insert(node, id);
        id
    }

    /// A real constant.
    pub fn real(&mut self, value: f64) -> Id {
        self.intern(Op::Const(value.to_bits()), Ty::Real, &[])
    }

    /// A complex constant.
    pub fn complex(&mut self, re: f64, im: f64) -> Id {
        let args = [self.real(re), self.real(im)];
        self.intern(Op::Apply(Prim::Complex), Ty::Complex, &args)
    }

    /// A truth value.
    pub fn truth(&mut self, value: bool) -> Id {
        self.intern(Op::Truth(value), Ty::Bool, &[])
    }

    /// A leaf: an input, a parameter, the clock or the footprint.
    pub fn leaf(&mut self, op: Op, ty: Ty) -> Id {
        self.intern(op, ty, &[])
    }

    /// The value of a real constant.
    #[must_use]
    pub fn as_real(&self, id: Id) -> Option<f64> {
        match self.node(id).op {
            Op::Const(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// The value of a complex constant.
    #[must_use]
    pub fn as_complex(&self, id: Id) -> Option<(f64, f64)> {
        let node = self.node(id);
        match (node.op, node.args.as_slice()) {
            (Op::Apply(Prim::Complex), &[re, im]) => Some((self.as_real(re)?, self.as_real(im)?)),
            _ => None,
        }
    }

    /// The node that applies `prim` to one operand, where the graph has it.
    #[must_use]
    pub fn find_unary(&self, prim: Prim, arg: Id) -> Option<Id> {
        let node = Node {
            op: Op::Apply(prim),
            ty: self.ty(arg),
            args: SmallVec::from_slice(&[arg]),
        };
        self.ids.get(&node).copied()
    }

    /// Remembers the user's name of a value; the first name stays.
    pub fn set_name(&mut self, id: Id, name: &str) {
        self.names.entry(id).or_insert_with(|| name.to_owned());
    }

    /// Gives a value another name.
    pub fn rename(&mut self, id: Id, name: &str) {
        self.names.insert(id, name.to_owned());
    }

    /// The user's name of a value.
    #[must_use]
    pub fn name(&self, id: Id) -> Option<&str> {
        self.names.get(&id).map(String::as_str)
    }

    /// Says where in the text every node comes from that was added since the last call.
    pub fn cover(&mut self, span: Span) {
        self.spans.resize(self.nodes.len(), span);
    }

    /// Says where in the text a node comes from, where that is not known yet.
    pub fn place(&mut self, id: Id, span: Span) {
        if let Some(known) = self.spans.get_mut(id.index())
            && *known == Span::default()
        {
            *known = span;
        }
    }

    /// The part of the text that a node was written as, or was derived from; empty where that is not known.
    #[must_use]
    pub fn span(&self, id: Id) -> Span {
        self.spans.get(id.index()).copied().unwrap_or_default()
    }

    /// Marks the nodes that the roots depend on, themselves included.
    #[must_use]
    pub fn reachable(&self, roots: &[Id]) -> Vec<bool> {
        if self.has_loops() {
            return self.reachable_through_loops(roots);
        }
        let mut seen = vec![false; self.nodes.len()];
        for root in roots {
            seen[root.index()] = true;
        }
        for index in (0..self.nodes.len()).rev() {
            if seen[index] {
                for arg in &self.nodes[index].args {
                    seen[arg.index()] = true;
                }
            }
        }
        seen
    }

    /// [`Self::reachable`] where there are loops: of a loop's states, those that a result or a live state needs.
    fn reachable_through_loops(&self, roots: &[Id]) -> Vec<bool> {
        let mut seen = vec![false; self.nodes.len()];
        let mut loops: FxHashMap<Binder, Vec<Loop>> = FxHashMap::default();
        let mut stack = roots.to_vec();
        while let Some(id) = stack.pop() {
            if std::mem::replace(&mut seen[id.index()], true) {
                continue;
            }
            let node = self.node(id);
            match node.op {
                Op::Loop { binder, .. } => {
                    let Some(it) = self.as_loop(id) else { continue };
                    stack.push(it.count);
                    stack.extend(it.until);
                    for state in it.states.iter().filter(|s| seen[s.leaf.index()]) {
                        stack.extend([state.init, state.next]);
                    }
                    loops.entry(binder).or_default().push(it);
                }
                Op::State(binder, _) => {
                    let states = loops.get(&binder).into_iter().flatten();
                    for state in states.flat_map(|it| &it.states).filter(|s| s.leaf == id) {
                        stack.extend([state.init, state.next]);
                    }
                }
                Op::Result(index) => {
                    stack.extend(node.args.iter().copied());
                    let it = node.args.first().and_then(|&a| self.as_loop(a));
                    let leaves = it.iter().flat_map(|it| &it.states).map(|s| s.leaf);
                    stack.extend(leaves.filter(
                        |&leaf| matches!(self.node(leaf).op, Op::State(_, k) if k == index),
                    ));
                }
                _ => stack.extend(node.args.iter().copied()),
            }
        }
        seen
    }

    /// A graph with only what the roots depend on, and the roots in it.
    #[must_use]
    pub fn compacted(&self, roots: &[Id]) -> (Self, Vec<Id>) {
        let mut out = Self::new();
        out.nodes.reserve(self.nodes.len());
        out.ids.reserve(self.nodes.len());
        out.variables = self.variables;
        let roots = transcribe(self, roots, &mut out, |out, node, args| {
            out.intern(node.op, node.ty, args)
        });
        (out, roots)
    }
}

impl Prim {
    /// Whether `op(a, b)` and `op(b, a)` are the same number.
    #[must_use]
    pub fn is_commutative(self) -> bool {
        matches!(
            self,
            Self::Add
                | Self::Mul
                | Self::Hypot
                | Self::Equal
                | Self::NotEqual
                | Self::And
                | Self::Or
        )
    }
}
