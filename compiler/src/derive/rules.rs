//! What both modes know about the operations that the table calls structural.

use smallvec::SmallVec;

use crate::ir::{Graph, Id, Op, Prim, Ty};

/// n · x^(n-1)
pub fn int_power_partial(g: &mut Graph, x: Id, n: i32) -> Id {
    let power = g.apply(Prim::PowInt(n.saturating_sub(1)), &[x]);
    let factor = g.real(f64::from(n));
    g.mul(factor, power)
}

/// Most nodes of a divisor that are searched for what overflows.
const MAX_SEARCH: usize = 64;
/// A divisor above this with an infinite derivative has overflowed, or is about to; it is beside no singularity of its own.
const LARGE: f64 = (1_u128 << 100) as f64;

/// (a/b) b', where b may be so large that b' is infinite: nothing there, where the quotient itself is 0 or nearly so.
/// As it stands the product is 0·∞.
pub fn quotient_correction(g: &mut Graph, quotient: Id, b: Id, slope: Id) -> Id {
    let product = g.mul(quotient, slope);
    if !may_overflow(g, b) {
        return product;
    }
    let (infinity, large) = (g.real(f64::INFINITY), g.real(LARGE));
    let sizes = [slope, b].map(|x| g.apply(Prim::Abs, &[x]));
    let conditions = [
        g.apply(Prim::Less, &[sizes[0], infinity]),
        g.apply(Prim::Less, &[sizes[1], large]),
    ];
    let counts = g.apply(Prim::Or, &conditions);
    let ty = g.ty(product);
    let zero = zero_like(g, ty);
    g.apply(Prim::Select, &[counts, product, zero])
}

/// (1/b)' = -b' (1/b²) for a complex b with a real constant b', as one operation: the parts of a square of a rounded 1/b that
/// cancel are good to its modulus alone. `None` where b is something else.
pub fn inverse_tangent(g: &mut Graph, b: Id, slope: Id) -> Option<Id> {
    let slope = g.as_real(slope).filter(|_| g.ty(b) == Ty::Complex)?;
    let square = g.apply(Prim::PowInt(-2), &[b]);
    let factor = g.real(-slope);
    Some(g.mul(factor, square))
}

/// Whether a divisor has a part that overflows at arguments of ordinary size: exponentials, high powers. Not further than
/// [`MAX_SEARCH`] nodes.
pub fn may_overflow(g: &Graph, divisor: Id) -> bool {
    let mut seen: SmallVec<[Id; 16]> = SmallVec::new();
    let mut stack: SmallVec<[Id; 16]> = SmallVec::new();
    stack.push(divisor);
    while let Some(id) = stack.pop() {
        if seen.contains(&id) || seen.len() > MAX_SEARCH {
            continue;
        }
        seen.push(id);
        let node = g.node(id);
        match node.op {
            Op::Apply(
                Prim::Exp
                | Prim::Exp2
                | Prim::Expm1
                | Prim::Exprel
                | Prim::Gamma
                | Prim::Sinh
                | Prim::Sinhc
                | Prim::Cosh,
            ) => return true,
            Op::Apply(Prim::PowInt(n)) if n >= 6 => return true,
            Op::Apply(Prim::Sin | Prim::Cos) if node.ty == Ty::Complex => return true,
            Op::Apply(_) => stack.extend(node.args.iter().copied()),
            _ => {}
        }
    }
    false
}

/// Whether a root depends on a quotient whose divisor may overflow. Adjoints pass such a divisor as a zero, and meet an
/// infinite slope below it.
pub fn has_such_quotient(g: &Graph, root: Id) -> bool {
    let live = g.reachable(&[root]);
    g.ids().take(live.len()).any(|id| {
        let node = g.node(id);
        live[id.index()]
            && node.op == Op::Apply(Prim::Div)
            && node.args.get(1).is_some_and(|&b| may_overflow(g, b))
    })
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
