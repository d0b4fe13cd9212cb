//! What both modes know about the operations that the table calls structural.

use crate::ir::{Graph, Id, Prim, Ty};

/// n · x^(n-1)
pub fn int_power_partial(g: &mut Graph, x: Id, n: i32) -> Id {
    let power = g.apply(Prim::PowInt(n.saturating_sub(1)), &[x]);
    let factor = g.real(f64::from(n));
    g.mul(factor, power)
}

/// Whether a node is the constant 0.
pub fn is_zero(g: &Graph, id: Id) -> bool {
    g.as_real(id) == Some(0.0) || g.as_complex(id) == Some((0.0, 0.0))
}

/// A zero of the type of `like`.
pub fn zero_like(g: &mut Graph, like: Ty) -> Id {
    if like == Ty::Complex {
        g.complex(0.0, 0.0)
    } else {
        g.real(0.0)
    }
}

/// The condition under which `min` or `max` takes its second operand.
pub fn takes_second(g: &mut Graph, prim: Prim, a: Id, b: Id) -> Id {
    if prim == Prim::Min {
        g.apply(Prim::Less, &[b, a])
    } else {
        g.apply(Prim::Less, &[a, b])
    }
}

/// a + b, either of which may be an exact zero.
pub fn sum(g: &mut Graph, a: Option<Id>, b: Option<Id>) -> Option<Id> {
    match (a, b) {
        (Some(a), Some(b)) => Some(g.add(a, b)),
        _ => a.or(b),
    }
}
