//! Hashes of the eight corners of a cell of the lattice of integers, as one call: most of the work on them is the same.

use naga::{Expression, Handle, Literal};
use rustc_hash::FxHashMap;

use super::LowerError;
use super::function::Lowering;
use crate::ir::{Graph, Id, Op, Prim};

/// The cell: its lowest corner as three roundings down, the fourth coordinate, and how many binary digits of the hashes are wanted.
type Cell = ([Id; 3], Id, u32);

/// Roundings down of 2ⁿ times a hash that are computed by cells: the cell of each, and its corner.
#[derive(Debug, Default)]
pub(super) struct Cells {
    digits: FxHashMap<Id, (Cell, usize)>,
    made: FxHashMap<Cell, Handle<Expression>>,
}

impl Cells {
    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.digits.is_empty()
    }

    /// All that there are, where every corner of a cell is wanted, and its hash for nothing else; what that makes
    /// unnecessary is marked.
    pub(super) fn find(graph: &Graph, roots: &[Id], live: &[bool], skipped: &mut [bool]) -> Self {
        let nodes = || {
            let all = graph.ids().zip(graph.nodes());
            all.filter(|(id, _)| live[id.index()])
        };
        let mut users = vec![0_u32; live.len()];
        let used = nodes().flat_map(|(_, node)| &node.args).chain(roots);
        used.for_each(|id| users[id.index()] += 1);
        let mut cells: FxHashMap<Cell, Vec<(usize, [Id; 3])>> = FxHashMap::default();
        for (id, _) in nodes() {
            let Some((cell, corner, [product, hash])) = digits(graph, id) else {
                continue;
            };
            if users[product.index()] == 1 && users[hash.index()] == 1 {
                let corners = cells.entry(cell).or_default();
                corners.push((corner, [id, product, hash]));
            }
        }
        let mut found = Self::default();
        for (cell, corners) in cells {
            let all = corners.iter().fold(0, |all, (corner, _)| all | 1 << corner);
            if all != 0xff || corners.len() != 8 {
                continue;
            }
            for (corner, [id, product, hash]) in corners {
                found.digits.insert(id, (cell, corner));
                skipped[product.index()] = true;
                skipped[hash.index()] = true;
            }
        }
        found
    }
}

/// Of ⌊2ⁿ hash(x, y, z, w)⌋ at a corner of a cell: the cell, the corner by its bits x, y, z, and the product and the hash.
fn digits(graph: &Graph, id: Id) -> Option<(Cell, usize, [Id; 2])> {
    let args = |id: Id, prim: Prim| {
        let node = graph.node(id);
        (node.op == Op::Apply(prim)).then_some(node.args.as_slice())
    };
    let &[product] = args(id, Prim::Floor)? else {
        return None;
    };
    let &[a, b] = args(product, Prim::Mul)? else {
        return None;
    };
    let (scale, hash) = match (graph.as_real(a), graph.as_real(b)) {
        (Some(scale), None) => (scale, b),
        (None, Some(scale)) => (scale, a),
        _ => return None,
    };
    let n = (1..=24).find(|&n| scale == f64::from(1_u32 << n))?;
    let &[x, y, z, w] = args(hash, Prim::Hash)? else {
        return None;
    };
    let mut corner = 0;
    let mut lowest = [x, y, z];
    for (k, low) in lowest.iter_mut().enumerate() {
        if let Some(&[a, b]) = args(*low, Prim::Add) {
            let (rest, one) = if graph.as_real(a).is_some() {
                (b, a)
            } else {
                (a, b)
            };
            if graph.as_real(one) != Some(1.0) {
                return None;
            }
            *low = rest;
            corner |= 1 << k;
        }
        args(*low, Prim::Floor)?;
    }
    Some(((lowest, w, n), corner, [product, hash]))
}

impl Lowering<'_, '_, '_> {
    /// Digits of a hash, if they are computed by a cell.
    pub(super) fn corner(&mut self, id: Id) -> Result<Option<Handle<Expression>>, LowerError> {
        let Some(&(cell, corner)) = self.cells.digits.get(&id) else {
            return Ok(None);
        };
        let made = match self.cells.made.get(&cell) {
            Some(&made) => made,
            None => {
                let ([x, y, z], w, n) = cell;
                let mut arguments = Vec::with_capacity(5);
                for id in [x, y, z, w] {
                    arguments.push(self.value(id)?);
                }
                let shift = Expression::Literal(Literal::U32(32 - n));
                arguments.push(self.body.declare(shift));
                let made = self.library("lattice_cell", arguments)?;
                self.cells.made.insert(cell, made);
                made
            }
        };
        let face = self.part(made, u32::from(corner >= 4));
        let place = u32::try_from(corner % 4).unwrap_or(0);
        Ok(Some(self.part(face, place)))
    }
}
