//! Which operations of a closed form lose digits on a ray.

use std::fmt::Write as _;

use pullback_compiler::eval::{Leaves, Tape};
use pullback_compiler::formula::Formula;
use pullback_compiler::ir::{Graph, Id, Op, Prim, Ty, transcribe};
use pullback_compiler::table::Number;

use super::ROUNDING;
use super::rays::Ray;

/// The operations whose rounding changes the integral along a ray most, with that change as a part of `size`: each in turn is
/// made larger by half a unit in the last place of binary32, all others as they are in f64.
#[must_use]
pub fn worst(integral: &Formula, ray: &Ray, size: f64, count: usize) -> String {
    let (graph, roots) = integral.to_compile();
    let (graph, roots) = graph.compacted(roots);
    let Some(&root) = roots.first() else {
        return String::new();
    };
    let whole = value(&graph, root, ray);
    let mut found: Vec<(f64, Id)> = graph
        .ids()
        .filter(|&id| matches!(graph.node(id).op, Op::Apply(_)) && graph.ty(id) == Ty::Real)
        .map(|id| {
            let (other, root) = rounded(&graph, root, id);
            ((value(&other, root, ray) - whole).abs() / size, id)
        })
        .collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut out = String::new();
    for (change, id) in found.into_iter().take(count) {
        let node = graph.node(id);
        let args: Vec<String> = node
            .args
            .iter()
            .map(|&a| format!("{} = {:e}", a.index(), value(&graph, a, ray)))
            .collect();
        let _ = writeln!(
            out,
            "        {change:.1e} by {} = {:e}: {:?} of {}",
            id.index(),
            value(&graph, id, ray),
            node.op,
            args.join(", ")
        );
    }
    out
}

fn rounded(graph: &Graph, root: Id, at: Id) -> (Graph, Id) {
    let mut out = Graph::new();
    let roots = transcribe(graph, &[root], &mut out, |to, node, args| {
        let new = match node.op {
            Op::Apply(prim) => to.apply(prim, args),
            op => to.leaf(op, node.ty),
        };
        if *node == *graph.node(at) {
            let factor = to.real(1.0 + ROUNDING);
            return to.apply(Prim::Mul, &[new, factor]);
        }
        new
    });
    (out, roots[0])
}

fn value(graph: &Graph, root: Id, ray: &Ray) -> f64 {
    let inputs = ray.numbers.map(Number::Real);
    let leaves = Leaves {
        inputs: &inputs,
        params: &[],
        time: 0.0,
        pixel: 0.0,
    };
    let mut out = f64::NAN;
    Tape::new(graph, &[root]).run(&leaves, |v| {
        if let Number::Real(x) = v {
            out = x;
        }
    });
    out
}
