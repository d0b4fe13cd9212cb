//! The integral of a function of space along a ray.

use super::path::Body;
use super::{Integral, Otherwise, Path, Problem, Reason, integrate};
use crate::formula::{Formula, Input};
use crate::ir::{Graph, Id, Op, Prim, Ty, transcribe};
use crate::stable::{self, Rewrites};
use crate::types::Type;

/// Inputs of the integral of a field: origin, direction, and both ends.
pub const INPUTS: [&str; 8] = ["o.x", "o.y", "o.z", "d.x", "d.y", "d.z", "a", "b"];

/// Inputs of the integral along a shifted ray: those of [`INPUTS`], and what the origin and both ends are beyond them.
pub const SHIFTED_INPUTS: [&str; 13] = [
    "o.x", "o.y", "o.z", "d.x", "d.y", "d.z", "a", "b", "o_rest.x", "o_rest.y", "o_rest.z",
    "a_rest", "b_rest",
];

/// I(o, d, a, b) = ∫ₐᵇ f(o + t d) dt.
#[derive(Clone, Debug)]
pub struct FieldIntegral {
    /// The IR. Its inputs are [`INPUTS`], or [`SHIFTED_INPUTS`].
    pub graph: Graph,
    /// The leaves that stand for the point in the integrands of the parts.
    pub point: Vec<Id>,
    /// The integral.
    pub integral: Integral,
    /// Whether it is that along a shifted ray.
    pub is_shifted: bool,
}

/// The integral of a real function of three real inputs (or fewer) along a ray.
///
/// # Errors
/// The function is no such function, a bound is exceeded, or there is no closed form and quadrature is not wanted.
pub fn field_integral(formula: &Formula, otherwise: Otherwise) -> Result<FieldIntegral, Problem> {
    let (mut graph, point, root) = with_point(formula, INPUTS.len())?;
    let inputs = inputs(&mut graph, INPUTS.len());
    let path = Path::of_ray(
        &mut graph,
        &point,
        &inputs[..3],
        &inputs[3..6],
        (inputs[6], inputs[7]),
    );
    let integral = integrate(&mut graph, root, &path, otherwise)?;
    Ok(FieldIntegral {
        graph,
        point,
        integral,
        is_shifted: false,
    })
}

/// The integral of such a function along a ray whose origin has been moved in a wider format, o + t₀ d for o, a - t₀ and b - t₀ for
/// both ends, with t₀ in the interval. Beside the rounded numbers it takes what they are beyond that, each as one further number, so
/// that it is the integral along the ray that is meant. The rests of the origin are those of every place on the ray; what the ends
/// are beyond a and b adds f(o + b d) `b_rest` - f(o + a d) `a_rest`, of which what is left out is of the second order.
///
/// # Errors
/// As of [`field_integral`].
pub fn shifted_field_integral(
    formula: &Formula,
    otherwise: Otherwise,
) -> Result<FieldIntegral, Problem> {
    let (mut graph, point, root) = with_point(formula, SHIFTED_INPUTS.len())?;
    let g = &mut graph;
    let inputs = inputs(g, SHIFTED_INPUTS.len());
    let ends = [inputs[6], inputs[7]];
    let path = Path::of_ray_beside(
        g,
        &point,
        (&inputs[..3], &inputs[8..11]),
        &inputs[3..6],
        (ends[0], ends[1]),
    );
    let mut integral = integrate(g, root, &path, otherwise)?;
    let body = Body::new(g, &[root], point.iter().copied());
    let zero = g.real(0.0);
    let beyond = [0, 1].map(|end| {
        let place = path.end(g, end);
        let value = body.at(g, &place)[0];
        let rest = inputs[11 + end];
        let part = g.mul(rest, value);
        // an end may be a pole of f
        let is_none = g.apply(Prim::Equal, &[rest, zero]);
        g.apply(Prim::Select, &[is_none, zero, part])
    });
    let beyond = g.sub(beyond[1], beyond[0]);
    integral.value = g.add(integral.value, beyond);
    Ok(FieldIntegral {
        graph,
        point,
        integral,
        is_shifted: true,
    })
}

fn inputs(g: &mut Graph, count: usize) -> Vec<Id> {
    (0..count).map(|k| Formula::leaf(g, k, Ty::Real)).collect()
}

/// A graph with as many inputs in which the function is one of leaves that stand for a point, these, and the function.
fn with_point(formula: &Formula, count: usize) -> Result<(Graph, Vec<Id>, Id), Problem> {
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
    inputs(&mut graph, count);
    let point: Vec<Id> = scalars
        .iter()
        .map(|_| graph.new_variable(Ty::Real))
        .collect();
    let roots = transcribe(from, value, &mut graph, |to, node, args| match node.op {
        Op::Input(k) => point
            .get(usize::from(k))
            .copied()
            .unwrap_or_else(|| to.real(f64::NAN)),
        Op::Apply(prim) => to.apply(prim, args),
        op => to.leaf(op, node.ty),
    });
    let root = roots
        .first()
        .copied()
        .unwrap_or_else(|| graph.real(f64::NAN));
    Ok((graph, point, root))
}

/// The stability rewrites of a closed form. Differences of products are formed as the rules of integration have them: a term
/// at a far end may be the product of a large and a tiny number, of which the rewrite would take differences.
pub(crate) fn of_integrals(rewrites: Rewrites) -> Rewrites {
    rewrites.without(stable::Rule::Products)
}

impl FieldIntegral {
    /// The integral as a function of its inputs, to be evaluated or written as a shader.
    #[must_use]
    pub fn into_formula(self, of: &Formula) -> Formula {
        let (graph, value) = self.graph.compacted(&[self.integral.value]);
        let vector = Type::Vector(3);
        let mut inputs = vec![
            ("o", vector),
            ("d", vector),
            ("a", Type::Real),
            ("b", Type::Real),
        ];
        let mut suffix = "integral";
        if self.is_shifted {
            inputs.extend([
                ("o_rest", vector),
                ("a_rest", Type::Real),
                ("b_rest", Type::Real),
            ]);
            suffix = "shifted_integral";
        }
        let inputs: Vec<Input> = inputs
            .into_iter()
            .map(|(name, ty)| Input {
                name: name.to_owned(),
                ty,
            })
            .collect();
        Formula {
            name: format!("{}_{suffix}", of.name),
            inputs,
            graph,
            value: value.into(),
            ty: Type::Real,
            span: of.span,
            rewrites: of_integrals(of.rewrites),
            derived: None,
        }
    }
}
