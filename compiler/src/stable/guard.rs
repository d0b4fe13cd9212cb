//! Conditions under which a rewritten form is taken.

use crate::ir::{Graph, Id, Op, Prim, Ty};

use super::polynomial::constant;

/// `new` where the condition holds, else `old`; a comparison with NaN does not hold.
pub fn choose(g: &mut Graph, condition: Id, new: Id, old: Id) -> Id {
    g.apply(Prim::Select, &[condition, new, old])
}

/// a < b
pub fn less(g: &mut Graph, a: Id, b: Id) -> Id {
    g.apply(Prim::Less, &[a, b])
}

/// a > 0
pub fn positive(g: &mut Graph, a: Id) -> Id {
    let zero = g.real(0.0);
    less(g, zero, a)
}

/// |a| < limit, of a real or complex number
pub fn within(g: &mut Graph, a: Id, limit: f64) -> Id {
    let size = g.apply(Prim::Abs, &[a]);
    let limit = g.real(limit);
    less(g, size, limit)
}

/// The value of a constant that is no zero.
pub fn nonzero_constant(g: &Graph, id: Id) -> Option<f64> {
    constant(g, id).filter(|c| *c != 0.0 && c.is_finite())
}

/// Whether a node is an argument that comes as it is, without rounding, or a constant.
pub fn is_input(g: &Graph, id: Id) -> bool {
    matches!(
        g.node(id).op,
        Op::Input(_) | Op::Param(_) | Op::Time | Op::Pixel | Op::Const(_)
    )
}

/// c · a
pub fn scaled(g: &mut Graph, c: f64, a: Id) -> Id {
    let c = g.real(c);
    g.mul(c, a)
}

/// Whether a node is real.
pub fn is_real(g: &Graph, id: Id) -> bool {
    g.ty(id) == Ty::Real
}
