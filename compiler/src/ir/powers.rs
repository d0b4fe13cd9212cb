//! Integer powers as products.

use std::borrow::Cow;
use std::ops::Range;

use super::{Graph, Id, Op, Prim, Ty, transcribe};

/// Exponents up to this size become products; larger ones stay calls.
const MAX_EXPANDED: u32 = 1 << 16;

/// Exponents whose complex powers stay calls in single precision: products by repeated squaring would round to more than 4 ulp
/// of the modulus there, which the library's function does not.
pub const SINGLE_CALLS: Range<u32> = 5..9;

/// No exponents: all complex powers become products.
pub const NO_CALLS: Range<u32> = 0..0;

/// Rewrites every integer power that the roots depend on as products by repeated squaring, so that xⁿ and
/// the xⁿ⁻¹ of its derivative share their factors. A negative exponent is the reciprocal of the positive power, but x⁻² the
/// square of the reciprocal, which neither overflows nor underflows where the result does not; z⁻² of a complex z stays, and so do complex powers by
/// `calls`.
///
/// Knuth, The Art of Computer Programming 2, section 4.6.3 (left-to-right binary method).
#[must_use]
pub fn expand_powers<'g>(
    graph: &'g Graph,
    roots: &[Id],
    calls: &Range<u32>,
) -> (Cow<'g, Graph>, Vec<Id>) {
    let live = graph.reachable(roots);
    let is_power =
        |id: &Id| live[id.index()] && matches!(graph.node(*id).op, Op::Apply(Prim::PowInt(_)));
    if !graph.ids().any(|id| is_power(&id)) {
        return (Cow::Borrowed(graph), roots.to_vec());
    }
    let mut out = Graph::new();
    let roots = transcribe(graph, roots, &mut out, |out, node, args| {
        match (node.op, args) {
            // one operation, so that each part of it is accurate
            (Op::Apply(Prim::PowInt(-2)), _) if node.ty == Ty::Complex => {
                out.intern(node.op, node.ty, args)
            }
            (Op::Apply(Prim::PowInt(n)), &[base]) if n.unsigned_abs() <= MAX_EXPANDED => {
                power(out, node.ty, base, n, calls)
            }
            _ => out.intern(node.op, node.ty, args),
        }
    });
    (Cow::Owned(out), roots)
}

fn power(g: &mut Graph, ty: Ty, base: Id, n: i32, calls: &Range<u32>) -> Id {
    if n == -2 {
        let one = g.real(1.0);
        let inverse = g.intern(Op::Apply(Prim::Div), ty, &[one, base]);
        return g.intern(Op::Apply(Prim::Mul), ty, &[inverse, inverse]);
    }
    let size = n.unsigned_abs();
    let positive = if ty == Ty::Complex && calls.contains(&size) {
        g.intern(Op::Apply(Prim::PowInt(n.abs())), ty, &[base])
    } else {
        positive_power(g, ty, base, size)
    };
    if n >= 0 {
        return positive;
    }
    let one = g.real(1.0);
    g.intern(Op::Apply(Prim::Div), ty, &[one, positive])
}

fn positive_power(g: &mut Graph, ty: Ty, base: Id, n: u32) -> Id {
    if n == 0 {
        return if ty == Ty::Complex {
            g.complex(1.0, 0.0)
        } else {
            g.real(1.0)
        };
    }
    let mut value = base;
    for bit in (0..n.ilog2()).rev() {
        value = g.intern(Op::Apply(Prim::Mul), ty, &[value, value]);
        if n >> bit & 1 == 1 {
            value = g.intern(Op::Apply(Prim::Mul), ty, &[value, base]);
        }
    }
    value
}
