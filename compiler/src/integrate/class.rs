//! What kind of function of the path's parameter s each expression is.

use rustc_hash::FxHashSet;

use crate::ir::{Graph, Id, Op, Prim, Ty};

/// Greatest degree of a polynomial in s.
pub const MAX_DEGREE: u32 = 60;

/// The classes of the nodes of a graph, extended as the graph grows.
#[derive(Debug)]
pub struct Classes {
    leaves: FxHashSet<usize>,
    /// For each node its degree as a polynomial in s with coefficients that are constant along the path; `None` where
    /// it is no such polynomial.
    degrees: Vec<Option<u32>>,
    /// Whether it changes along the path.
    moves: Vec<bool>,
}

impl Classes {
    /// Classes by these leaves, which are of degree 1.
    pub fn new(leaves: impl Iterator<Item = Id>) -> Self {
        Self {
            leaves: leaves.map(Id::index).collect(),
            degrees: Vec::new(),
            moves: Vec::new(),
        }
    }

    /// The degree of an expression as a polynomial in s, 0 of a constant.
    pub fn degree(&mut self, g: &Graph, id: Id) -> Option<u32> {
        self.extend(g);
        self.degrees.get(id.index()).copied().flatten()
    }

    /// Whether an expression changes along the path.
    pub fn moves(&mut self, g: &Graph, id: Id) -> bool {
        self.extend(g);
        self.moves.get(id.index()).copied().unwrap_or(false)
    }

    /// The degree of an expression that has been classified.
    pub fn known_degree(&self, id: Id) -> Option<u32> {
        self.degrees.get(id.index()).copied().flatten()
    }

    /// Classifies the nodes that were added.
    pub fn extend(&mut self, g: &Graph) {
        for index in self.degrees.len()..g.nodes().len() {
            let node = &g.nodes()[index];
            let moves = node.args.iter().any(|a| self.moves[a.index()]) || self.is_leaf(index);
            let degree = match node.op {
                _ if !moves => Some(0),
                Op::Apply(prim) if node.ty == Ty::Real => self.of_operation(g, prim, &node.args),
                _ if self.is_leaf(index) => Some(1),
                _ => None,
            };
            self.moves.push(moves);
            self.degrees.push(degree.filter(|&d| d <= MAX_DEGREE));
        }
    }

    fn is_leaf(&self, index: usize) -> bool {
        self.leaves.contains(&index)
    }

    fn of_operation(&self, g: &Graph, prim: Prim, args: &[Id]) -> Option<u32> {
        let degree = |k: usize| self.degrees[args[k].index()];
        match prim {
            Prim::Neg => degree(0),
            Prim::Add | Prim::Sub => Some(degree(0)?.max(degree(1)?)),
            Prim::Mul => Some(degree(0)? + degree(1)?),
            Prim::Div if !self.moves[args[1].index()] => degree(0),
            Prim::PowInt(n) if n > 0 => {
                let n = n.unsigned_abs();
                let square = self.of_square(g, args[0]);
                let even = if n % 2 == 0 {
                    square.and_then(|d| d.checked_mul(n / 2))
                } else {
                    None
                };
                even.or_else(|| degree(0)?.checked_mul(n))
            }
            // a choice that is made once for the whole path
            Prim::Select if !self.moves[args[0].index()] => Some(degree(1)?.max(degree(2)?)),
            _ => None,
        }
    }

    /// The degree of the square of a root or an absolute value.
    fn of_square(&self, g: &Graph, id: Id) -> Option<u32> {
        let node = g.node(id);
        let degree = |k: usize| self.degrees[node.args[k].index()];
        match node.op {
            Op::Apply(Prim::Abs) => Some(2 * degree(0)?),
            Op::Apply(Prim::Sqrt) => degree(0),
            Op::Apply(Prim::Hypot) => Some(2 * degree(0)?.max(degree(1)?)),
            Op::Apply(Prim::Hypot3) => Some(2 * degree(0)?.max(degree(1)?).max(degree(2)?)),
            _ => None,
        }
    }
}
