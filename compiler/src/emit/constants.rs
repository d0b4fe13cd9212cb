//! Parameters as constants: their values in the program in the place of them, before anything is derived.

use crate::formula::{Form, Formula};
use crate::ir::{Graph, Id, Op, transcribe};
use crate::program::ParamInfo;

/// The formula for the parameters' values in the program, or nothing where it has no parameters. What is then made of numbers
/// alone is computed, as everywhere in formulas.
pub(super) fn fixed(formula: &Formula, params: &[ParamInfo]) -> Option<Formula> {
    let live = formula.graph.reachable(&formula.value);
    let all = formula.graph.ids().zip(formula.graph.nodes());
    let mut used = all.filter(|(id, _)| live[id.index()]);
    if !used.any(|(_, node)| matches!(node.op, Op::Param(_))) {
        return None;
    }
    let (graph, value) = with_values(&formula.graph, &formula.value, params);
    let derived = formula.derived.as_ref().map(|form| {
        let (graph, value) = with_values(&form.graph, &form.value, params);
        Form {
            graph,
            value: value.into(),
        }
    });
    Some(Formula {
        graph,
        value: value.into(),
        derived,
        ..formula.clone()
    })
}

fn with_values(graph: &Graph, roots: &[Id], params: &[ParamInfo]) -> (Graph, Vec<Id>) {
    let mut out = Graph::new();
    let new = transcribe(graph, roots, &mut out, |out, node, args| {
        let new = match node.op {
            Op::Param(k) => params
                .get(usize::from(k))
                .map(|param| out.real(param.default)),
            Op::Apply(prim) => Some(out.apply(prim, args)),
            _ => None,
        };
        new.filter(|&new| out.ty(new) == node.ty)
            .unwrap_or_else(|| out.intern(node.op, node.ty, args))
    });
    (out, new)
}
