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

/// The integral with divisions, roots and functions that are off by as many units in the last place of binary32, up or down by turns:
/// what a graphics card may do that rounds sums and products as binary32 does.
#[must_use]
pub fn loosened(integral: &Formula, units: f64) -> Formula {
    let (graph, roots) = integral.to_compile();
    let mut out = Graph::new();
    let mut count = 0_u32;
    let roots = transcribe(graph, roots, &mut out, |to, node, args| {
        let prim = match node.op {
            Op::Apply(prim) => prim,
            op => return to.leaf(op, node.ty),
        };
        let new = to.apply(prim, args);
        if node.ty != Ty::Real || !is_loose(prim) {
            return new;
        }
        count += 1;
        // Weyl's sequence, so that neighbours are not always off to different sides
        let turn = f64::from(count) * 0.618_033_988_749_894_9;
        let side = if turn.fract() < 0.5 { 1.0 } else { -1.0 };
        let factor = to.real(1.0 + side * units * f64::from(f32::EPSILON));
        to.apply(Prim::Mul, &[new, factor])
    });
    Formula {
        graph: out,
        value: roots.into(),
        derived: None,
        ..integral.clone()
    }
}

/// Whether an operation is none of those that are rounded once, or not at all, on every adapter.
fn is_loose(prim: Prim) -> bool {
    match prim {
        Prim::PowInt(n) => n < 0,
        Prim::Neg
        | Prim::Add
        | Prim::Sub
        | Prim::Mul
        | Prim::MulAdd
        | Prim::SumRest
        | Prim::MulAddRest
        | Prim::Min
        | Prim::Max
        | Prim::Abs
        | Prim::Sign
        | Prim::Floor
        | Prim::Ceil
        | Prim::Round
        | Prim::Trunc
        | Prim::Fract
        | Prim::Select
        | Prim::Re
        | Prim::Im => false,
        _ => true,
    }
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
