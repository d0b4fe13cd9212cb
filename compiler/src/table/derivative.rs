//! Partial derivatives that more than one row uses.

use crate::ir::{Graph, Id, Prim};

/// 1 / a
pub fn reciprocal(g: &mut Graph, a: Id) -> Id {
    let one = g.real(1.0);
    g.div(one, a)
}

/// a + c for a constant c
pub fn plus(g: &mut Graph, a: Id, c: f64) -> Id {
    let c = g.real(c);
    g.add(a, c)
}

/// c · a for a constant c
pub fn scaled(g: &mut Graph, c: f64, a: Id) -> Id {
    let c = g.real(c);
    g.mul(c, a)
}

/// a²
pub fn square(g: &mut Graph, a: Id) -> Id {
    g.apply(Prim::PowInt(2), &[a])
}

/// A function of one operand.
pub fn call(g: &mut Graph, prim: Prim, a: Id) -> Id {
    g.apply(prim, &[a])
}

/// a, and 1 where a is 0: a divisor for a quotient that is to be 0 there.
pub fn nonzero(g: &mut Graph, a: Id) -> Id {
    let (zero, one) = (g.real(0.0), g.real(1.0));
    let vanishes = g.apply(Prim::Equal, &[a, zero]);
    g.apply(Prim::Select, &[vanishes, one, a])
}
