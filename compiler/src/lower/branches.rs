//! Choices that are written as branches: those of which one side alone needs much.
//!
//! A select computes both of its operands. The closed form of an integral has one form for short intervals and one for long
//! ones, each of hundreds of operations, and neighbouring pixels mostly want the same one.

use naga::{Block, Statement};
use rustc_hash::FxHashMap;

use super::LowerError;
use super::function::Lowering;
use crate::ir::{Graph, Id, Op, Prim, Ty};
use crate::table;

/// Weighted operations of a side from which on a choice is a branch.
const DEAR: u32 = 96;
/// Choices that stand in so many others are selects.
const MAX_LEVEL: u8 = 16;

/// The side of a choice that alone needs a node: the first or the second operand to choose from. `None`: it is needed in any
/// case.
type Side = Option<(Id, usize)>;

/// What is computed where.
pub(super) struct Branches {
    /// What is computed in any case, operands before users.
    pub(super) top: Vec<Id>,
    /// What is computed on each side of the choices that are branches.
    sides: FxHashMap<Id, [Vec<Id>; 2]>,
}

/// For each node, the side that alone needs it.
struct Needs<'g> {
    graph: &'g Graph,
    sides: Vec<Option<Side>>,
    /// In how many choices a choice stands.
    levels: FxHashMap<Id, u8>,
}

impl Branches {
    /// What a graph without loops computes where.
    pub(super) fn find(graph: &Graph, roots: &[Id], live: &[bool]) -> Self {
        let needs = Needs::find(graph, roots, live);
        let dear = needs.dear(live);
        let mut out = Self {
            top: Vec::new(),
            sides: FxHashMap::default(),
        };
        for choice in dear {
            out.sides.insert(choice, [Vec::new(), Vec::new()]);
        }
        for id in graph.ids().filter(|id| live[id.index()]) {
            let mut side = needs.side(id);
            while let Some((choice, _)) = side
                && !out.sides.contains_key(&choice)
            {
                side = needs.side(choice);
            }
            match side {
                Some((choice, k)) => {
                    if let Some(sides) = out.sides.get_mut(&choice) {
                        sides[k].push(id);
                    }
                }
                None => out.top.push(id),
            }
        }
        out
    }
}

impl<'g> Needs<'g> {
    fn find(graph: &'g Graph, roots: &[Id], live: &[bool]) -> Self {
        let mut out = Self {
            graph,
            sides: vec![None; live.len()],
            levels: FxHashMap::default(),
        };
        for root in roots {
            out.sides[root.index()] = Some(None);
        }
        let ids: Vec<Id> = graph.ids().filter(|id| live[id.index()]).collect();
        // users before operands
        for &id in ids.iter().rev() {
            let own = out.side(id);
            let level = out.level(own);
            let is_choice = level < MAX_LEVEL && is_choice(graph, id);
            if is_choice {
                out.levels.insert(id, level);
            }
            for (k, &arg) in graph.node(id).args.iter().enumerate() {
                let side = match k.checked_sub(1) {
                    Some(k) if is_choice => Some((id, k)),
                    _ => own,
                };
                let joined = match out.sides[arg.index()] {
                    Some(known) => out.joined(known, side),
                    None => side,
                };
                out.sides[arg.index()] = Some(joined);
            }
        }
        out
    }

    fn side(&self, id: Id) -> Side {
        self.sides[id.index()].flatten()
    }

    fn level(&self, side: Side) -> u8 {
        side.map_or(0, |(choice, _)| {
            self.levels.get(&choice).copied().unwrap_or(0) + 1
        })
    }

    /// The innermost side that both are in.
    fn joined(&self, mut a: Side, mut b: Side) -> Side {
        while a != b {
            let (of_a, of_b) = (self.level(a), self.level(b));
            let out = |side: Side| side.and_then(|(choice, _)| self.side(choice));
            if of_a >= of_b {
                a = out(a);
            }
            if of_b >= of_a {
                b = out(b);
            }
        }
        a
    }

    /// The choices of which one side alone needs much.
    fn dear(&self, live: &[bool]) -> Vec<Id> {
        let mut weights: FxHashMap<(Id, usize), u32> = FxHashMap::default();
        let mut out = Vec::new();
        for id in self.graph.ids().filter(|id| live[id.index()]) {
            let mut weight = weight(self.graph, id);
            if self.levels.contains_key(&id) {
                let of = |k: usize| weights.get(&(id, k)).copied().unwrap_or(0);
                let sides = [of(0), of(1)];
                if sides.iter().any(|&weight| weight >= DEAR) {
                    out.push(id);
                }
                weight = weight.saturating_add(sides[0].saturating_add(sides[1]));
            }
            if let Some(side) = self.side(id) {
                let known = weights.entry(side).or_default();
                *known = known.saturating_add(weight);
            }
        }
        out
    }
}

fn is_choice(graph: &Graph, id: Id) -> bool {
    let node = graph.node(id);
    node.op == Op::Apply(Prim::Select) && node.ty == Ty::Real
}

fn weight(graph: &Graph, id: Id) -> u32 {
    let node = graph.node(id);
    let Op::Apply(prim) = node.op else { return 0 };
    let complex = node.ty == Ty::Complex || node.args.iter().any(|&a| graph.ty(a) == Ty::Complex);
    let cost = table::row(prim).cost;
    u32::from(if complex { cost.complex } else { cost.real })
}

impl Lowering<'_, '_, '_> {
    /// Writes what is computed in one block, and its branches.
    pub(super) fn with_branches(
        &mut self,
        branches: &Branches,
        ids: &[Id],
    ) -> Result<(), LowerError> {
        for &id in ids {
            match branches.sides.get(&id) {
                Some(sides) => self.branch(branches, id, sides)?,
                None => self.compute(id)?,
            }
        }
        Ok(())
    }

    /// A choice as a branch: each side writes its value into one variable.
    fn branch(
        &mut self,
        branches: &Branches,
        id: Id,
        sides: &[Vec<Id>; 2],
    ) -> Result<(), LowerError> {
        let graph = self.graph;
        let node = graph.node(id);
        let condition = self.value(node.args[0])?;
        let name = format!("chosen{}", id.index());
        let variable = self.body.variable(name, self.numbers.real);
        let mut blocks = [Block::new(), Block::new()];
        for (k, block) in blocks.iter_mut().enumerate() {
            let pairs = self.pairs.clone();
            self.body.open();
            self.with_branches(branches, &sides[k])?;
            let value = self.value(node.args[k + 1])?;
            self.body.store(variable, value);
            *block = self.body.close();
            // what was computed on a side does not hold outside of it
            self.pairs = pairs;
            for inside in &sides[k] {
                self.values[inside.index()] = None;
            }
        }
        let [accept, reject] = blocks;
        self.body.at(graph.span(id));
        self.body.statement(Statement::If {
            condition,
            accept,
            reject,
        });
        let value = self.body.load(variable);
        self.keep_value(id, value);
        Ok(())
    }
}
