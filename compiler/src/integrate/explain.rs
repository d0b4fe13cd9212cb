//! An integral along a ray as it is told to people.

use super::field::field_integral;
use super::{Otherwise, Problem, Record};
use crate::formula::Formula;
use crate::ir::{Graph, Id, LeafNames, cost, to_infix};
use crate::stable::scalar_names;

/// What became of an integral along a ray.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// The products of the integrand, each with its rule.
    pub parts: Vec<Told>,
    /// What was integrated numerically, and why.
    pub numerical: Vec<(String, Problem)>,
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
    let names: Vec<String> = super::field::INPUTS.iter().map(|&n| n.to_owned()).collect();
    let (short, roots) = graph.compacted(&[made.integral.value]);
    let names = LeafNames {
        inputs: &names,
        params,
    };
    Ok(Explanation {
        parts,
        numerical,
        pieces: made.integral.pieces,
        compiled: to_infix(&short, &roots, names),
        operations: cost(&short, &roots).operations,
    })
}
