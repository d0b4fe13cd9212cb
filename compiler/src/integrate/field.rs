//! The integral of a function of space along a ray.

use super::{Integral, Otherwise, Path, Problem, Reason, integrate};
use crate::formula::{Formula, Input};
use crate::ir::{Graph, Id, Op, Ty, transcribe};
use crate::stable::{self, Rewrites};
use crate::types::Type;

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
/// The function is no such function, a bound is exceeded, or there is no closed form and quadrature is not wanted.
pub fn field_integral(formula: &Formula, otherwise: Otherwise) -> Result<FieldIntegral, Problem> {
    let is_field = formula.ty == Type::Real && formula.value.len() == 1;
    let scalars = formula.scalars();
    if !is_field || scalars.len() > 3 || scalars.iter().any(|&ty| ty != Ty::Real) {
        let node = formula.value.first().copied();
        let node = node.unwrap_or_else(|| Graph::new().real(f64::NAN));
        return Err(Problem {
            node,
            span: formula.span,
            reason: Reason::NoField,
        });
    }
    let (from, value) = formula.to_compile();
    let mut graph = Graph::new();
    let input = |g: &mut Graph, k: usize| Formula::leaf(g, k, Ty::Real);
    let inputs: Vec<Id> = (0..INPUTS.len()).map(|k| input(&mut graph, k)).collect();
    let count = scalars.len();
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

/// The stability rewrites of a closed form. Differences of products are formed as the rules of integration have them: a term
/// at a far end may be the product of a large and a tiny number, of which the rewrite would take differences.
pub(crate) fn of_integrals(rewrites: Rewrites) -> Rewrites {
    rewrites.without(stable::Rule::Products)
}

impl FieldIntegral {
    /// The integral as a function of its eight inputs, to be evaluated or written as a shader.
    #[must_use]
    pub fn into_formula(self, of: &Formula) -> Formula {
        let (graph, value) = self.graph.compacted(&[self.integral.value]);
        let inputs = [
            ("o", Type::Vector(3)),
            ("d", Type::Vector(3)),
            ("a", Type::Real),
            ("b", Type::Real),
        ];
        let inputs = inputs.map(|(name, ty)| Input {
            name: name.to_owned(),
            ty,
        });
        Formula {
            name: format!("{}_integral", of.name),
            inputs: inputs.into(),
            graph,
            value: value.into(),
            ty: Type::Real,
            span: of.span,
            rewrites: of_integrals(of.rewrites),
            derived: None,
        }
    }
}
