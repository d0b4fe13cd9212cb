//! The integral of a function of space along a ray.

use super::{Integral, Otherwise, Path, Problem, integrate};
use crate::formula::Formula;
use crate::ir::{Graph, Id, Op, Ty, transcribe};

/// Inputs of the integral of a field: origin, direction, and both ends.
pub const INPUTS: [&str; 8] = ["o.x", "o.y", "o.z", "d.x", "d.y", "d.z", "a", "b"];

/// I(o, d, a, b) = ∫ₐᵇ f(o + t d) dt.
#[derive(Clone, Debug)]
pub struct FieldIntegral {
    /// The IR. Its inputs are [`INPUTS`].
    pub graph: Graph,
    /// The leaves that stand for the point in the integrands of the parts.
    pub point: Vec<Id>,
    /// The integral.
    pub integral: Integral,
}

/// The integral of a real function of three real inputs (or fewer) along a ray.
///
/// # Errors
/// A bound is exceeded, or there is no closed form and quadrature is not wanted.
pub fn field_integral(formula: &Formula, otherwise: Otherwise) -> Result<FieldIntegral, Problem> {
    let (from, value) = formula.to_compile();
    let mut graph = Graph::new();
    let input = |g: &mut Graph, k: usize| Formula::leaf(g, k, Ty::Real);
    let inputs: Vec<Id> = (0..INPUTS.len()).map(|k| input(&mut graph, k)).collect();
    let count = formula.scalars().len().min(3);
    let point: Vec<Id> = (0..count).map(|_| graph.new_variable(Ty::Real)).collect();
    let roots = transcribe(from, value, &mut graph, |to, node, args| match node.op {
        Op::Input(k) => point
            .get(usize::from(k))
            .copied()
            .unwrap_or_else(|| to.real(f64::NAN)),
        Op::Apply(prim) => to.apply(prim, args),
        op => to.leaf(op, node.ty),
    });
    let path = Path::of_ray(
        &mut graph,
        &point,
        &inputs[..3],
        &inputs[3..6],
        (inputs[6], inputs[7]),
    );
    let root = roots
        .first()
        .copied()
        .unwrap_or_else(|| graph.real(f64::NAN));
    let integral = integrate(&mut graph, root, &path, otherwise)?;
    Ok(FieldIntegral {
        graph,
        point,
        integral,
    })
}
