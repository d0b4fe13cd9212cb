//! A formula as it is compiled, and each rewrite that made it so.

use smallvec::SmallVec;

use super::pass::{Applied, stabilise};
use super::{Phase, Rewrites, Rule};
use crate::formula::Formula;
use crate::ir::{Graph, Id, LeafNames, to_infix};
use crate::module::{ModuleError, What, stable_evaluation};

/// One rewrite, as text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// The rules that took part.
    pub rules: SmallVec<[Rule; 4]>,
    /// What was written, its operands rewritten before.
    pub before: String,
    /// What is computed instead.
    pub after: String,
}

/// What becomes of a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// The formula as it was written, calls and loops built.
    pub written: String,
    /// What is computed, as formulas: the value, and what else was asked for.
    pub compiled: String,
    /// The rewrites of the value that were done.
    pub applied: Vec<Step>,
    /// Those that could have been done, and are off.
    pub off: Vec<Step>,
}

/// Explains what is compiled when this is asked of a formula.
///
/// # Errors
/// It makes no sense for the formula, or an operation has no derivative rule.
pub fn explain(
    formula: &Formula,
    params: &[String],
    what: What,
) -> Result<Explanation, ModuleError> {
    let inputs: Vec<String> = formula.inputs.iter().flat_map(scalar_names).collect();
    let names = LeafNames {
        inputs: &inputs,
        params,
    };
    let compiled = stable_evaluation(formula, what)?;
    let (graph, roots) = compiled.graph.compacted(&compiled.roots);
    let applied = steps(formula, formula.rewrites, names);
    let possible = if formula.rewrites == Rewrites::ON {
        Vec::new()
    } else {
        steps(formula, Rewrites::ON, names)
    };
    let is_off = |step: &Step| step.rules.iter().any(|&r| !formula.rewrites.has(r));
    Ok(Explanation {
        written: text(&formula.graph, &formula.value, names),
        compiled: to_infix(&graph, &roots, names),
        applied,
        off: possible.into_iter().filter(is_off).collect(),
    })
}

/// One name for each scalar input: `p.x` for a component.
pub fn scalar_names(input: &crate::formula::Input) -> Vec<String> {
    match input.ty {
        crate::types::Type::Vector(_) => crate::formula::column_names(&input.name, input.ty),
        _ => vec![input.name.clone()],
    }
}

fn steps(formula: &Formula, rewrites: Rewrites, names: LeafNames) -> Vec<Step> {
    let (graph, value) = formula.to_compile();
    let early = stabilise(graph, value, rewrites, Phase::Early);
    let late = stabilise(&early.graph, &early.roots, rewrites, Phase::Late);
    let step = |graph: &Graph, applied: &Applied| Step {
        rules: applied.rules.clone(),
        before: text(graph, &[applied.before], names),
        after: text(graph, &[applied.after], names),
    };
    let early = early.applied.iter().map(|a| step(&early.graph, a));
    early
        .chain(late.applied.iter().map(|a| step(&late.graph, a)))
        .collect()
}

fn text(graph: &Graph, roots: &[Id], names: LeafNames) -> String {
    let (graph, roots) = graph.compacted(roots);
    to_infix(&graph, &roots, names)
}
