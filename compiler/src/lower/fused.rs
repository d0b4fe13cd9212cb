//! Sums of a square and an exact number as one fused operation.

use naga::{Expression, Handle, MathFunction, UnaryOperator};

use super::function::Lowering;
use super::{LowerError, Precision};
use crate::ir::{Graph, Id, Node, Op, Prim, Ty};

impl Lowering<'_, '_, '_> {
    /// a² ± b or b - a², where b is a constant or a multiple of a by a power of two, as one `fma`: b is not rounded, so that
    /// nothing that is written to be 0 stops to be. Drivers that fuse do so only with a product that nothing else needs: with
    /// this one a rewritten form is as good as a written one that they fuse. Where `fma` is not fused it is as written.
    pub(super) fn sum_with_square(
        &mut self,
        prim: Prim,
        node: &Node,
    ) -> Result<Option<Handle<Expression>>, LowerError> {
        let &[a, b] = node.args.as_slice() else {
            return Ok(None);
        };
        let is_sum = matches!(prim, Prim::Add | Prim::Sub) && node.ty == Ty::Real;
        if !is_sum || self.precision != Precision::Accurate {
            return Ok(None);
        }
        let sides = [(a, b), (b, a)].map(|(square, other)| {
            let root = root(self.graph, square)?;
            is_exact(self.graph, other, root).then_some(root)
        });
        let (root, other, is_first) = match sides {
            [Some(root), _] => (root, b, true),
            [None, Some(root)] => (root, a, false),
            [None, None] => return Ok(None),
        };
        let (root, mut other) = (self.value(root)?, self.value(other)?);
        let mut left = root;
        if prim == Prim::Sub {
            let negated = if is_first { &mut other } else { &mut left };
            *negated = self.unary(UnaryOperator::Negate, *negated);
        }
        Ok(Some(self.math(MathFunction::Fma, &[left, root, other])))
    }
}

/// a of a² that is no constant.
fn root(graph: &Graph, square: Id) -> Option<Id> {
    let node = graph.node(square);
    match (node.op, node.args.as_slice()) {
        (Op::Apply(Prim::Mul), &[a, b]) if a == b && graph.as_real(a).is_none() => Some(a),
        _ => None,
    }
}

/// Whether a number is a constant, or a multiple of `base` by a power of two.
fn is_exact(graph: &Graph, id: Id, base: Id) -> bool {
    let node = graph.node(id);
    let is_power = |id| graph.as_real(id).is_some_and(is_power_of_two);
    match (node.op, node.args.as_slice()) {
        (Op::Apply(Prim::Mul), &[a, b]) => (a == base && is_power(b)) || (b == base && is_power(a)),
        _ => graph.as_real(id).is_some(),
    }
}

/// Whether a number is ±2ⁿ, n neither large nor small.
fn is_power_of_two(x: f64) -> bool {
    x.to_bits() & ((1 << 52) - 1) == 0 && (2f64.powi(-20)..=2f64.powi(20)).contains(&x.abs())
}
