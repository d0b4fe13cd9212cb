//! Places on rays, where the adapter's `fma` is a product and a sum, each rounded.

use super::function::Lowering;
use crate::ir::{Graph, Id, Node, Op, Prim};

/// What stands in for `fma` at places, in libraries for adapters that round it twice.
pub(super) const STAND_IN: &str = "real_place";

impl Lowering<'_, '_, '_> {
    /// Whether a sum is a place o + t d on a ray, whose product is rounded on its own where `fma` is not one operation. Elsewhere
    /// the product is small beside what it is added to.
    pub(super) fn is_split_place(&self, node: &Node) -> bool {
        let is_given = |&id: &Id| is_given(self.graph, id);
        self.linker.offers(STAND_IN) && node.args[1..].iter().all(is_given)
    }
}

/// Whether a number is an argument, or a multiple of one, or either beside a constant, or a place itself.
fn is_given(graph: &Graph, mut id: Id) -> bool {
    while let (Op::Apply(Prim::MulAdd), &[_, factor, addend]) = parts(graph, id) {
        if !is_argument(graph, factor) {
            return false;
        }
        id = addend;
    }
    is_argument(graph, id)
}

/// The same of no place.
fn is_argument(graph: &Graph, mut id: Id) -> bool {
    let is_known = |id| graph.as_real(id).is_some();
    loop {
        id = match parts(graph, id) {
            (Op::Input(_), _) => return true,
            (Op::Apply(Prim::Neg), &[a]) => a,
            (Op::Apply(Prim::Mul | Prim::Add | Prim::Sub), &[a, b]) if is_known(a) => b,
            (Op::Apply(Prim::Mul | Prim::Add | Prim::Sub), &[a, b]) if is_known(b) => a,
            _ => return false,
        };
    }
}

fn parts(graph: &Graph, id: Id) -> (Op, &[Id]) {
    let node = graph.node(id);
    (node.op, &node.args)
}
