//! Gradients of real expressions by the cheaper of both modes.

use super::{NoDerivative, forward, reverse};
use crate::ir::{Graph, Id, cost};

/// A value and its partial derivatives.
#[derive(Clone, Debug)]
pub struct Gradient {
    /// The value.
    pub value: Id,
    /// ∂value/∂leaf for each leaf, in order.
    pub partials: Vec<Id>,
}

/// The gradient of a real root by real leaves. Forward and reverse mode are both derived, and the one whose
/// counted cost, together with the value, is lower is kept. Where forward mode finds an exact zero that reverse mode
/// does not, forward mode is kept: the other would multiply that zero by a slope that may be infinite.
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
    if leaves.len() > 1
        && let Some(adjoints) = reverse(g, value, leaves)?
        && adjoints
            .iter()
            .zip(&tangents)
            .all(|(a, t)| a.is_none() || t.is_some())
    {
        let adjoints: Vec<Id> = adjoints.into_iter().map(|a| a.unwrap_or(zero)).collect();
        let price = |partials: &[Id]| {
            let roots: Vec<Id> = std::iter::once(value)
                .chain(partials.iter().copied())
                .collect();
            cost(g, &roots).weighted
        };
        if price(&adjoints) < price(&partials) {
            partials = adjoints;
        }
    }
    Ok(Gradient { value, partials })
}
