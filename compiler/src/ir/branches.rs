//! Whether a function is made of branches.

use super::{Graph, Id, Op, Prim, Ty};

/// Whether values or derivatives of the roots may jump from one point to the next: choices, extremes, moduli of real numbers,
/// roundings, remainders, signs, angles, and loops that end by a condition. `false` is certain; points at which a function is
/// not differentiable, such as the tip of a cone, are no jumps of this kind.
#[must_use]
pub fn has_branches(graph: &Graph, roots: &[Id]) -> bool {
    let live = graph.reachable(roots);
    let mut nodes = graph.ids().zip(graph.nodes());
    nodes.any(|(id, node)| {
        live[id.index()]
            && match node.op {
                Op::Loop { until, .. } => until,
                Op::Apply(Prim::Abs) => graph.ty(node.args[0]) == Ty::Real,
                Op::Apply(prim) => is_branch(prim),
                _ => false,
            }
    })
}

fn is_branch(prim: Prim) -> bool {
    matches!(
        prim,
        Prim::Floor
            | Prim::Ceil
            | Prim::Round
            | Prim::Trunc
            | Prim::Fract
            | Prim::Mod
            | Prim::Sign
            | Prim::Min
            | Prim::Max
            | Prim::Select
            | Prim::Arg
            | Prim::Atan2
    )
}

#[cfg(test)]
mod tests {
    use super::has_branches;
    use crate::compile;

    #[test]
    fn extremes_and_choices_are_branches() {
        for (text, expected) in [
            ("x³ - y² + sin(x y)", false),
            ("√(x² + y²) - 1", false),
            ("sum(k in 1..3, x^k) - y", false),
            ("max(x, y)", true),
            ("|x| - y", true),
            ("if x > 0 then y else -y", true),
            ("floor(x) + y", true),
            ("mod(x, 2) - y", true),
        ] {
            let compiled = compile(&format!("f(x, y) = {text}"));
            let program = compiled.program.unwrap();
            let formula = &program.pictures()[0].formula;
            let found = has_branches(&formula.graph, &formula.value);
            assert_eq!(found, expected, "{text}");
        }
    }
}
