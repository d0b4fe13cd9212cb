//! Gradients of real expressions by the cheaper of both modes.

use super::jet::wirtinger;
use super::rules::has_such_quotient;
use super::{NoDerivative, forward, reverse};
use crate::ir::{Graph, Id, Prim, Ty, cost};

/// A value and its partial derivatives.
#[derive(Clone, Debug)]
pub struct Gradient {
    /// The value.
    pub value: Id,
    /// ∂value/∂leaf for each leaf, in order.
    pub partials: Vec<Id>,
}

/// The gradient of a real root by real leaves. Forward and reverse mode are both derived, and the one whose
/// counted cost, together with the value, is lower is kept; of two leaves and through complex numbers, also the
/// derivative by x + i y, which is one complex tangent in the place of two where a part is holomorphic. Where forward mode finds an exact zero that reverse mode
/// does not, forward mode is kept: the other would multiply that zero by a slope that may be infinite. So it is where a
/// divisor may overflow.
///
/// # Errors
/// An operation that depends on a leaf has no derivative rule.
pub fn gradient(g: &mut Graph, value: Id, leaves: &[Id]) -> Result<Gradient, NoDerivative> {
    let one = g.real(1.0);
    let zero = g.real(0.0);
    let mut tangents = Vec::with_capacity(leaves.len());
    for &leaf in leaves {
        tangents.push(forward(g, &[value], &[(leaf, one)])?[0]);
    }
    let mut partials: Vec<Id> = tangents.iter().map(|t| t.unwrap_or(zero)).collect();
    let price = |g: &Graph, partials: &[Id]| {
        let roots: Vec<Id> = std::iter::once(value)
            .chain(partials.iter().copied())
            .collect();
        cost(g, &roots).weighted
    };
    if leaves.len() > 1
        && !has_such_quotient(g, value)
        && let Some(adjoints) = reverse(g, value, leaves)?
        && adjoints
            .iter()
            .zip(&tangents)
            .all(|(a, t)| a.is_none() || t.is_some())
    {
        let adjoints: Vec<Id> = adjoints.into_iter().map(|a| a.unwrap_or(zero)).collect();
        if price(g, &adjoints) < price(g, &partials) {
            partials = adjoints;
        }
    }
    if let &[x, y] = leaves
        && tangents.iter().all(Option::is_some)
        && goes_through_complex(g, value)
        && let Some(dz) = wirtinger(g, value, x, y)?
    {
        let (two, re, im) = (
            g.real(2.0),
            g.apply(Prim::Re, &[dz]),
            g.apply(Prim::Im, &[dz]),
        );
        let (along, across) = (g.mul(two, re), g.mul(two, im));
        let both = vec![along, g.neg(across)];
        if price(g, &both) < price(g, &partials) {
            partials = both;
        }
    }
    Ok(Gradient { value, partials })
}

fn goes_through_complex(g: &Graph, value: Id) -> bool {
    let live = g.reachable(&[value]);
    g.ids()
        .take(live.len())
        .any(|id| live[id.index()] && g.ty(id) == Ty::Complex)
}
