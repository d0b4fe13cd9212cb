//! The reference evaluator: the IR in `f64`, operation by operation as the operator table defines them.

use crate::ir::{Graph, Id, Node, Op, Prim, Ty};
use crate::reference::complex::complex;
use crate::table::{self, Number};

/// What the leaves of a graph are worth.
#[derive(Clone, Copy, Debug)]
pub struct Leaves<'a> {
    /// Scalar inputs, each a real or complex number.
    pub inputs: &'a [Number],
    /// User parameters.
    pub params: &'a [f64],
    /// Seconds.
    pub time: f64,
    /// World units per pixel.
    pub pixel: f64,
}

/// A graph ready to be evaluated many times.
#[derive(Clone, Debug)]
pub struct Tape {
    nodes: Vec<Node>,
    ids: Vec<Id>,
    roots: Vec<Id>,
    values: Vec<Number>,
}

impl Tape {
    /// Keeps what the roots depend on.
    #[must_use]
    pub fn new(graph: &Graph, roots: &[Id]) -> Self {
        let (graph, roots) = graph.compacted(roots);
        let values = vec![Number::Real(f64::NAN); graph.nodes().len()];
        Self {
            nodes: graph.nodes().to_vec(),
            ids: graph.ids().collect(),
            roots,
            values,
        }
    }

    /// Computes every root, and hands them to `each` in order.
    pub fn run(&mut self, leaves: &Leaves, mut each: impl FnMut(Number)) {
        for (id, node) in self.ids.iter().zip(&self.nodes) {
            self.values[id.index()] = value(node, leaves, &self.values);
        }
        for root in &self.roots {
            each(self.values[root.index()]);
        }
    }
}

fn value(node: &Node, leaves: &Leaves, values: &[Number]) -> Number {
    let missing = Number::Real(f64::NAN);
    match node.op {
        Op::Const(bits) => Number::Real(f64::from_bits(bits)),
        Op::Truth(value) => Number::Truth(value),
        Op::Input(k) => leaves
            .inputs
            .get(usize::from(k))
            .copied()
            .unwrap_or(missing),
        Op::Param(k) => Number::Real(
            leaves
                .params
                .get(usize::from(k))
                .copied()
                .unwrap_or(f64::NAN),
        ),
        Op::Time => Number::Real(leaves.time),
        Op::Pixel => Number::Real(leaves.pixel),
        Op::Apply(prim) => apply(prim, node, values),
    }
}

fn apply(prim: Prim, node: &Node, values: &[Number]) -> Number {
    let operands: smallvec::SmallVec<[Number; 3]> =
        node.args.iter().map(|a| values[a.index()]).collect();
    table::row(prim)
        .evaluate(prim, &operands)
        .unwrap_or(match node.ty {
            Ty::Real => Number::Real(f64::NAN),
            Ty::Complex => Number::Complex(complex(f64::NAN, f64::NAN)),
            Ty::Bool => Number::Truth(false),
        })
}
