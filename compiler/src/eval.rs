//! The reference evaluator: the IR in `f64`, operation by operation as the operator table defines them.

use smallvec::SmallVec;

use crate::ir::{Graph, Id, Node, Op, Plan, Prim, Schedule, Ty, merge_loops};
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
    steps: Vec<Step>,
    roots: Vec<Id>,
    values: Vec<Number>,
}

/// What is done next.
#[derive(Clone, Debug)]
enum Step {
    /// A node is computed.
    Node(Id),
    /// A loop is run.
    Loop(Box<Repeat>),
}

#[derive(Clone, Debug)]
struct Repeat {
    plan: Plan,
    before: Vec<Step>,
    after: Vec<Step>,
    /// Each node that is a final state, with the state's leaf.
    results: Vec<(Id, Id)>,
}

impl Tape {
    /// Keeps what the roots depend on.
    #[must_use]
    pub fn new(graph: &Graph, roots: &[Id]) -> Self {
        let (graph, roots) = graph.compacted(roots);
        let (graph, roots) = merge_loops(&graph, &roots);
        let values = vec![Number::Real(f64::NAN); graph.nodes().len()];
        let steps = if graph.has_loops() {
            let schedule = Schedule::new(&graph, &roots);
            steps(&graph, &schedule, &schedule.top)
        } else {
            graph.ids().map(Step::Node).collect()
        };
        Self {
            nodes: graph.nodes().to_vec(),
            steps,
            roots,
            values,
        }
    }

    /// Computes every root, and hands them to `each` in order.
    pub fn run(&mut self, leaves: &Leaves, mut each: impl FnMut(Number)) {
        run(&self.nodes, &self.steps, leaves, &mut self.values);
        for root in &self.roots {
            each(self.values[root.index()]);
        }
    }

    /// As [`Self::run`], with memory of its own, for a tape that several evaluations share.
    pub fn run_apart(&self, leaves: &Leaves, mut each: impl FnMut(Number)) {
        let mut values = self.values.clone();
        run(&self.nodes, &self.steps, leaves, &mut values);
        for root in &self.roots {
            each(values[root.index()]);
        }
    }
}

fn steps(graph: &Graph, schedule: &Schedule, ids: &[Id]) -> Vec<Step> {
    let step = |&id: &Id| match schedule.plan(id) {
        None => Step::Node(id),
        Some(plan) => Step::Loop(Box::new(Repeat {
            before: steps(graph, schedule, &plan.before),
            after: steps(graph, schedule, &plan.after),
            results: results(graph, plan),
            plan: plan.clone(),
        })),
    };
    ids.iter().map(step).collect()
}

fn results(graph: &Graph, plan: &Plan) -> Vec<(Id, Id)> {
    let leaf = |result: &Id| graph.leaf_of_result(*result);
    let results = plan.results.iter();
    results.filter_map(|r| Some((*r, leaf(r)?))).collect()
}

fn run(nodes: &[Node], steps: &[Step], leaves: &Leaves, values: &mut [Number]) {
    for step in steps {
        match step {
            Step::Node(id) => values[id.index()] = value(&nodes[id.index()], leaves, values),
            Step::Loop(repeat) => run_loop(nodes, repeat, leaves, values),
        }
    }
}

fn run_loop(nodes: &[Node], repeat: &Repeat, leaves: &Leaves, values: &mut [Number]) {
    let it = &repeat.plan.it;
    for state in &it.states {
        values[state.leaf.index()] = values[state.init.index()];
    }
    let count = match values[it.count.index()] {
        Number::Real(count) if count > f64::from(it.limit) => f64::from(it.limit),
        Number::Real(count) => count.floor(),
        _ => 0.0,
    };
    let mut next: SmallVec<[Number; 8]> = SmallVec::new();
    let mut done = 0.0;
    while done < count {
        if let Some(counter) = repeat.plan.counter {
            values[counter.index()] = Number::Real(done);
        }
        run(nodes, &repeat.before, leaves, values);
        if it
            .until
            .is_some_and(|u| values[u.index()] == Number::Truth(true))
        {
            break;
        }
        run(nodes, &repeat.after, leaves, values);
        next.clear();
        next.extend(it.states.iter().map(|state| values[state.next.index()]));
        for (state, &value) in it.states.iter().zip(&next) {
            values[state.leaf.index()] = value;
        }
        done += 1.0;
    }
    for (result, leaf) in &repeat.results {
        values[result.index()] = values[leaf.index()];
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
        Op::Variable(_) | Op::State(..) | Op::Counter(_) | Op::Loop { .. } | Op::Result(_) => {
            missing
        }
        Op::Apply(prim) => apply(prim, node, values),
    }
}

fn apply(prim: Prim, node: &Node, values: &[Number]) -> Number {
    let operands: SmallVec<[Number; 3]> = node.args.iter().map(|a| values[a.index()]).collect();
    table::row(prim)
        .evaluate(prim, &operands)
        .unwrap_or(match node.ty {
            Ty::Real | Ty::Loop => Number::Real(f64::NAN),
            Ty::Complex => Number::Complex(complex(f64::NAN, f64::NAN)),
            Ty::Bool => Number::Truth(false),
        })
}
