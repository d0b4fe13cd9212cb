//! Integer powers as products.

use std::borrow::Cow;

use super::{Graph, Id, Op, Prim, Ty};

/// Exponents up to this size become products; larger ones stay calls.
const MAX_EXPANDED: u32 = 1 << 16;

/// Rewrites every integer power that the roots depend on as products by repeated squaring, so that xⁿ and
/// the xⁿ⁻¹ of its derivative share their factors. A negative exponent is the reciprocal of the positive power.
///
/// Knuth, The Art of Computer Programming 2, section 4.6.3 (left-to-right binary method).
#[must_use]
pub fn expand_powers<'g>(graph: &'g Graph, roots: &[Id]) -> (Cow<'g, Graph>, Vec<Id>) {
    let live = graph.reachable(roots);
    let is_power =
        |id: &Id| live[id.index()] && matches!(graph.node(*id).op, Op::Apply(Prim::PowInt(_)));
    if !graph.ids().any(|id| is_power(&id)) {
        return (Cow::Borrowed(graph), roots.to_vec());
    }
    let mut out = Graph::new();
    let mut map = vec![None; graph.nodes().len()];
    for (id, node) in graph.ids().zip(graph.nodes()) {
        if !live[id.index()] {
            continue;
        }
        let args: Vec<Id> = node
            .args
            .iter()
            .filter_map(|a: &Id| map[a.index()])
            .collect();
        let new = match (node.op, args.as_slice()) {
            (Op::Apply(Prim::PowInt(n)), &[base]) if n.unsigned_abs() <= MAX_EXPANDED => {
                power(&mut out, node.ty, base, n)
            }
            _ => out.intern(node.op, node.ty, &args),
        };
        if let Some(name) = graph.name(id) {
            out.set_name(new, name);
        }
        map[id.index()] = Some(new);
    }
    let roots = roots.iter().filter_map(|r| map[r.index()]).collect();
    (Cow::Owned(out), roots)
}

fn power(g: &mut Graph, ty: Ty, base: Id, n: i32) -> Id {
    let positive = positive_power(g, ty, base, n.unsigned_abs());
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
