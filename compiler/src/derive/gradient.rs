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
/// counted cost, together with the value, is lower is kept.
///
/// # Errors
/// An operation that depends on a leaf has no derivative rule.
pub fn gradient(g: &mut Graph, value: Id, leaves: &[Id]) -> Result<Gradient, NoDerivative> {
    let one = g.real(1.0);
    let zero = g.real(0.0);
    let mut partials = Vec::with_capacity(leaves.len());
    for &leaf in leaves {
        let tangent = forward(g, &[value], &[(leaf, one)])?;
        partials.push(tangent[0].unwrap_or(zero));
    }
    if leaves.len() > 1
        && let Some(adjoints) = reverse(g, value, leaves)?
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
