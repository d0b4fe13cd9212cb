//! An integral along a ray as it is told to people.

use super::field::field_integral;
use super::{Numerical, Otherwise, Problem, Record};
use crate::eval::{Leaves, Tape};
use crate::formula::Formula;
use crate::ir::{Graph, Id, LeafNames, cost, to_infix};
use crate::stable::scalar_names;
use crate::table::Number;

/// What became of an integral along a ray.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// The products of the integrand, each with its rule.
    pub parts: Vec<Told>,
    /// What was integrated numerically, and why.
    pub numerical: Vec<(String, Problem)>,
    /// How it was.
    pub rest: Vec<Rest>,
    /// Whether the ray is cut where conditions change.
    pub pieces: bool,
    /// The integral as a formula of the ray: o, d, a and b.
    pub compiled: String,
    /// Counted operations.
    pub operations: u32,
}

/// A product of the integrand.
#[derive(Clone, Debug)]
pub struct Told {
    /// The product.
    pub integrand: String,
    /// The conditions under which it counts.
    pub conditions: Vec<String>,
    /// The rule that integrates it.
    pub rule: &'static Record,
}

/// What is integrated numerically in one sum.
#[derive(Clone, Debug)]
pub struct Rest {
    /// The integrand.
    pub integrand: String,
    /// The operation that no bound is known of, with its place; `None` where panels are chosen by a bound.
    pub without: Option<(String, Problem)>,
    /// How many panels the bound asks for along [`SAMPLE`], and the sum of the bounds of their errors; `None` without
    /// a bound, and where parameters decide it.
    pub along_sample: Option<[f64; 2]>,
}

/// The ray o, d, a, b for which [`Rest::along_sample`] is told.
pub const SAMPLE: [f64; 8] = [0.1, 0.2, -2.0, 0.1, -0.2, 1.0, 0.0, 4.0];

/// Integrates a formula along a ray, and tells how.
///
/// # Errors
/// A bound is exceeded.
pub fn explain(formula: &Formula, params: &[String]) -> Result<Explanation, Problem> {
    let made = field_integral(formula, Otherwise::Quadrature)?;
    let coordinates: Vec<String> = formula.inputs.iter().flat_map(scalar_names).collect();
    let mut graph = made.graph;
    let text = |graph: &Graph, id: Id| {
        let (told, roots) = graph.compacted(&[id]);
        to_infix(
            &told,
            &roots,
            LeafNames {
                inputs: &[],
                params,
            },
        )
    };
    let condition = |graph: &Graph, (id, holds): (Id, bool)| {
        let told = text(graph, id);
        if holds { told } else { format!("not ({told})") }
    };
    for (&leaf, name) in made.point.iter().zip(&coordinates) {
        graph.set_name(leaf, name);
    }
    let parts = made.integral.parts.iter().map(|part| Told {
        integrand: text(&graph, part.integrand),
        conditions: part.guards.iter().map(|&c| condition(&graph, c)).collect(),
        rule: part.rule.record(),
    });
    let parts = parts.collect();
    let numerical = made
        .integral
        .numerical
        .iter()
        .map(|p| (text(&graph, p.node), p.clone()));
    let numerical = numerical.collect();
    let told_rest = |rest: &Numerical| Rest {
        integrand: text(&graph, rest.integrand),
        without: rest
            .without
            .as_ref()
            .map(|p| (text(&graph, p.node), p.clone())),
        along_sample: rest.bound.and_then(|bound| along_sample(&graph, &bound)),
    };
    let rest = made.integral.rest.iter().map(told_rest).collect();
    let names: Vec<String> = super::field::INPUTS.iter().map(|&n| n.to_owned()).collect();
    let (short, roots) = graph.compacted(&[made.integral.value]);
    let names = LeafNames {
        inputs: &names,
        params,
    };
    Ok(Explanation {
        parts,
        numerical,
        rest,
        pieces: made.integral.pieces,
        compiled: to_infix(&short, &roots, names),
        operations: cost(&short, &roots).operations,
    })
}

/// Two values along the sample, if they are numbers.
fn along_sample(graph: &Graph, roots: &[Id; 2]) -> Option<[f64; 2]> {
    let inputs = SAMPLE.map(Number::Real);
    let leaves = Leaves {
        inputs: &inputs,
        params: &[],
        time: f64::NAN,
        pixel: f64::NAN,
    };
    let mut found = Vec::new();
    Tape::new(graph, roots).run(&leaves, |value| found.push(value));
    match *found.as_slice() {
        [Number::Real(a), Number::Real(b)] if a.is_finite() && b.is_finite() => Some([a, b]),
        _ => None,
    }
}
