//! Loops: states that change step by step.
//!
//! The body of a loop is not a graph of its own. Its nodes stand among the others and are told by the leaves that
//! they depend on: what depends on a state or the counter is computed in every step, the rest once, outside. A loop
//! node is complete in itself; two loops may share a binder, such as one and its extension by tangents.

use smallvec::SmallVec;

use super::{Binder, Graph, Id, Op, Ty};

/// One state of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct State {
    /// The leaf that stands for it before a step.
    pub leaf: Id,
    /// Its value at the start.
    pub init: Id,
    /// Its value after a step.
    pub next: Id,
}

/// A loop taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loop {
    /// Whose leaves its body uses.
    pub binder: Binder,
    /// The number of steps as a real; rounded down, negative and NaN are none.
    pub count: Id,
    /// No more steps than this are done.
    pub limit: u32,
    /// The condition that ends it, tested before each step.
    pub until: Option<Id>,
    /// Its states.
    pub states: SmallVec<[State; 4]>,
}

impl Loop {
    /// Every operand: count, condition, and leaf, start and next value of each state.
    pub fn operands(&self) -> impl Iterator<Item = Id> + '_ {
        let states = self.states.iter();
        [Some(self.count), self.until]
            .into_iter()
            .flatten()
            .chain(states.flat_map(|s| [s.leaf, s.init, s.next]))
    }

    /// Exchanges every operand.
    pub fn rename(&mut self, new: impl Fn(Id) -> Id) {
        self.count = new(self.count);
        self.until = self.until.map(&new);
        for state in &mut self.states {
            (state.leaf, state.init, state.next) =
                (new(state.leaf), new(state.init), new(state.next));
        }
    }
}

impl Graph {
    /// Whether a loop may be in the graph.
    #[must_use]
    pub fn has_loops(&self) -> bool {
        !self.states_of.is_empty()
    }

    /// A graph without nodes whose binders are those of this one.
    pub(crate) fn emptied(&self) -> Self {
        let mut out = Self::new();
        out.states_of.clone_from(&self.states_of);
        out.variables = self.variables;
        out
    }

    /// The leaf of a state with a known number.
    pub(crate) fn state(&mut self, binder: Binder, index: u16, ty: Ty) -> Id {
        let needed = binder.0 as usize + 1;
        if self.states_of.len() < needed {
            self.states_of.resize(needed, 0);
        }
        let count = &mut self.states_of[binder.0 as usize];
        *count = (*count).max(index.saturating_add(1));
        self.leaf(Op::State(binder, index), ty)
    }

    /// A binder for a new loop.
    pub fn binder(&mut self) -> Binder {
        let binder = Binder(u32::try_from(self.states_of.len()).unwrap_or(u32::MAX));
        self.states_of.push(0);
        binder
    }

    /// A leaf for a further state of the loops of a binder.
    pub fn new_state(&mut self, binder: Binder, ty: Ty) -> Id {
        let Some(count) = self.states_of.get_mut(binder.0 as usize) else {
            return self.real(f64::NAN);
        };
        let index = *count;
        if index == u16::MAX {
            self.refuse();
            return self.real(f64::NAN);
        }
        *count += 1;
        self.leaf(Op::State(binder, index), ty)
    }

    /// The leaf for the tangent of a state along the seeds; the same leaf each time. `part` tells tangents of one state
    /// apart.
    pub(crate) fn tangent_state(&mut self, leaf: Id, seeds: &[(Id, Id)], part: u8, ty: Ty) -> Id {
        let Op::State(binder, _) = self.node(leaf).op else {
            return self.real(f64::NAN);
        };
        let key = (leaf, part, seeds.to_vec());
        if let Some(&known) = self.tangent_states.get(&key) {
            return known;
        }
        let new = self.new_state(binder, ty);
        if let Some(name) = self.name(leaf).map(|name| format!("d_{name}")) {
            self.set_name(new, &name);
        }
        self.tangent_states.insert(key, new);
        new
    }

    /// The leaf of the state that a result node is.
    #[must_use]
    pub fn leaf_of_result(&self, result: Id) -> Option<Id> {
        let node = self.node(result);
        let Op::Result(index) = node.op else {
            return None;
        };
        let it = self.as_loop(*node.args.first()?)?;
        let mut leaves = it.states.iter().map(|state| state.leaf);
        leaves.find(|&leaf| matches!(self.node(leaf).op, Op::State(_, k) if k == index))
    }

    /// The leaf for the number of steps done.
    pub fn counter(&mut self, binder: Binder) -> Id {
        self.leaf(Op::Counter(binder), Ty::Real)
    }

    /// A bound variable that is no other.
    pub fn new_variable(&mut self, ty: Ty) -> Id {
        self.variables += 1;
        self.leaf(Op::Variable(self.variables), ty)
    }

    /// Adds a loop. Each state's leaf, start and next value must be of one type, the count a real, `until` a truth
    /// value.
    pub fn repeat(&mut self, it: &Loop) -> Id {
        let op = Op::Loop {
            binder: it.binder,
            limit: it.limit,
            until: it.until.is_some(),
        };
        let mut args: SmallVec<[Id; 16]> = SmallVec::from_slice(&[it.count]);
        args.extend(it.until);
        for state in &it.states {
            args.extend([state.leaf, state.init, state.next]);
        }
        self.intern(op, Ty::Loop, &args)
    }

    /// The final value of the state with this leaf.
    pub fn result(&mut self, repeated: Id, leaf: Id) -> Id {
        let Op::State(_, index) = self.node(leaf).op else {
            return self.real(f64::NAN);
        };
        let ty = self.ty(leaf);
        self.intern(Op::Result(index), ty, &[repeated])
    }

    /// The parts of a loop node.
    #[must_use]
    pub fn as_loop(&self, id: Id) -> Option<Loop> {
        let node = self.node(id);
        let Op::Loop {
            binder,
            limit,
            until,
        } = node.op
        else {
            return None;
        };
        let (&count, rest) = node.args.split_first()?;
        let (condition, rest) = if until {
            let (&condition, rest) = rest.split_first()?;
            (Some(condition), rest)
        } else {
            (None, rest)
        };
        let states = rest.chunks_exact(3);
        Some(Loop {
            binder,
            count,
            limit,
            until: condition,
            states: states
                .map(|part| State {
                    leaf: part[0],
                    init: part[1],
                    next: part[2],
                })
                .collect(),
        })
    }
}
