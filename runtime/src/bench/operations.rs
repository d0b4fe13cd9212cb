//! What derivatives cost in operations, counted after common subexpressions, with integer powers as products.

use pullback_compiler::derive::{ComplexVariable, forward, jet};
use pullback_compiler::formula::Formula;
use pullback_compiler::ir::{Cost, Graph, Id, Ty, cost};
use pullback_compiler::module::{Evaluation, What, evaluation};
use pullback_compiler::types::Type;

use crate::Error;

/// Of the value, of the value with its first derivatives, and with its second ones, too.
///
/// # Errors
/// [`Error::Invalid`] where there is no derivative.
pub fn costs(formula: &Formula) -> Result<[Cost; 3], Error> {
    let complex = formula.inputs.iter().any(|i| i.ty == Type::Complex);
    let what = if complex {
        What::Derivative
    } else {
        What::Gradient
    };
    let Evaluation {
        mut graph, roots, ..
    } = evaluation(formula, what).map_err(|error| none(&error))?;
    let first = cost(&graph, &roots);
    let derivatives = &roots[formula.value.len()..];
    let further = if complex {
        second_jets(&mut graph, derivatives)?
    } else {
        hessian(&mut graph, derivatives)?
    };
    let all: Vec<Id> = roots.iter().copied().chain(further).collect();
    let second = cost(&graph, &all);
    Ok([cost(&formula.graph, &formula.value), first, second])
}

fn none(error: &impl std::fmt::Debug) -> Error {
    Error::Invalid {
        reason: format!("no derivative: {error:?}"),
    }
}

/// The upper triangle of the Hessian, by forward mode on the gradient.
fn hessian(g: &mut Graph, gradient: &[Id]) -> Result<Vec<Id>, Error> {
    let count = gradient.len();
    let leaves: Vec<Id> = (0..count).map(|k| Formula::leaf(g, k, Ty::Real)).collect();
    let one = g.real(1.0);
    let mut out = Vec::new();
    for (k, &slope) in gradient.iter().enumerate() {
        for &leaf in &leaves[k..] {
            let tangents = forward(g, &[slope], &[(leaf, one)]).map_err(|error| none(&error))?;
            out.extend(tangents.into_iter().flatten());
        }
    }
    Ok(out)
}

/// f″ of a holomorphic function; ∂²f/∂z², ∂²f/∂z∂z̄ and ∂²f/∂z̄² of others.
fn second_jets(g: &mut Graph, derivatives: &[Id]) -> Result<Vec<Id>, Error> {
    let z = ComplexVariable::Whole(Formula::leaf(g, 0, Ty::Complex));
    let mut out = Vec::new();
    for (k, &derivative) in derivatives.iter().enumerate() {
        let jet = jet(g, derivative, z).map_err(|error| none(&error))?;
        if k == 0 {
            out.push(jet.dz);
        }
        out.extend(jet.dzbar);
    }
    Ok(out)
}
