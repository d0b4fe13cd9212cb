//! The first-order jet of a function of one complex variable.

use super::{NoDerivative, forward};
use crate::ir::{Graph, Id, Op, Prim, Ty};
use crate::table::{self, Derivative};

/// Value and Wirtinger derivatives of f at z.
#[derive(Clone, Copy, Debug)]
pub struct Jet {
    /// f(z), complex.
    pub value: Id,
    /// ∂f/∂z, which is f′(z) where f is holomorphic; complex.
    pub dz: Id,
    /// ∂f/∂z̄, or `None` where f is holomorphic as an expression.
    pub dzbar: Option<Id>,
}

/// The variable of a complex function.
#[derive(Clone, Copy, Debug)]
pub enum ComplexVariable {
    /// One complex leaf.
    Whole(Id),
    /// Two real leaves, the real and the imaginary part.
    Parts(Id, Id),
}

/// The jet of `root` by a complex variable. One complex tangent serves a holomorphic expression; otherwise the
/// partial derivatives along x and y give ∂f/∂z = (f_x - i f_y)/2 and ∂f/∂z̄ = (f_x + i f_y)/2.
///
/// Wirtinger 1927; Ahlfors, Complex Analysis, 3rd edition, section 2.1.2.
///
/// # Errors
/// An operation that depends on z has no derivative rule.
pub fn jet(g: &mut Graph, root: Id, z: ComplexVariable) -> Result<Jet, NoDerivative> {
    let value = g.widen(root);
    let (zero, one) = (g.real(0.0), g.real(1.0));
    let (x_seed, y_seed) = match z {
        ComplexVariable::Whole(z) => ((z, one), (z, g.complex(0.0, 1.0))),
        ComplexVariable::Parts(x, y) => ((x, one), (y, one)),
    };
    let along_x = forward(g, &[root], &[x_seed])?[0].unwrap_or(zero);
    if let ComplexVariable::Whole(z) = z
        && is_holomorphic(g, root, z)
    {
        let dz = g.widen(along_x);
        return Ok(Jet {
            value,
            dz,
            dzbar: None,
        });
    }
    let along_y = forward(g, &[root], &[y_seed])?[0].unwrap_or(zero);
    let turned = turn(g, along_y);
    let half = g.real(0.5);
    let (difference, total) = (g.sub(along_x, turned), g.add(along_x, turned));
    let (dz, dzbar) = (g.mul(half, difference), g.mul(half, total));
    let (dz, dzbar) = (g.widen(dz), g.widen(dzbar));
    Ok(Jet {
        value,
        dz,
        dzbar: Some(dzbar),
    })
}

/// i · w
fn turn(g: &mut Graph, w: Id) -> Id {
    let (re, im) = (g.apply(Prim::Re, &[w]), g.apply(Prim::Im, &[w]));
    let minus = g.neg(im);
    g.apply(Prim::Complex, &[minus, re])
}

/// Whether the value depends on z through holomorphic operations only. Conditions of choices do not count: the
/// derivative is that of the branch.
#[must_use]
pub fn is_holomorphic(g: &Graph, root: Id, z: Id) -> bool {
    let live = g.reachable(&[root]);
    let mut depends = vec![false; live.len()];
    depends[z.index()] = true;
    for (id, node) in g.ids().zip(g.nodes()) {
        let Op::Apply(prim) = node.op else { continue };
        if !live[id.index()] || node.ty == Ty::Bool || !node.args.iter().any(|a| depends[a.index()])
        {
            continue;
        }
        if matches!(table::row(prim).derivative, Derivative::Zero) {
            continue;
        }
        if node.ty == Ty::Real || prim == Prim::Conj {
            return false;
        }
        depends[id.index()] = true;
    }
    true
}
