//! Whether an integral along a ray is one: its derivatives by its ends, and that parts add up to the whole.
//!
//! I is ∫ₐᵇ f(o + t d) dt exactly if ∂I/∂b = f(o + b d), ∂I/∂a = -f(o + a d), I(a, a) = 0, and I(a, b) + I(b, c) =
//! I(a, c), which a jump between two branches of a rule would break. The derivatives are those of the compiler, not
//! differences. What normal forms do not show ([`super::symbolic`]) is evaluated in f64 on rays of every kind.

use super::field::FieldIntegral;
use super::symbolic::is_integral;
use crate::derive::forward;
use crate::eval::{Leaves, Tape};
use crate::formula::Formula;
use crate::ir::{Id, Op, Ty};
use crate::table::Number;

/// How far both sides of an identity may be from one another, as a part of the greatest |f| and the mean of |f|.
pub const PROOF_TOLERANCE: f64 = 1e-7;
/// In how many pieces an interval is cut.
const PIECES: u8 = 16;
/// How many places the mean of |f| is taken of.
const PLACES: u32 = 24;

/// What came of it.
#[derive(Clone, Debug)]
pub struct Proof {
    /// Whether the normal form of I has the derivative f(o + b d) by b, and I(a, a) is 0: then I is the integral.
    pub is_symbolic: bool,
    /// Rays on which the identities were evaluated: where f is a finite number all along.
    pub rays: usize,
    /// The greatest error, as a part of the greatest |f| and the mean of |f|.
    pub worst: f64,
    /// The identity with the first error beyond [`PROOF_TOLERANCE`], after which no more are tried, and its ray o, d, a, b.
    pub failure: Option<(&'static str, [f64; 8])>,
}

impl Proof {
    /// Whether every identity holds, on one ray at least.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.failure.is_none() && (self.rays > 0 || self.is_symbolic)
    }
}

/// Values that an identity is about.
struct Sides {
    integral: Tape,
    field: Tape,
    params: Vec<f64>,
}

impl Sides {
    fn run(tape: &mut Tape, inputs: &[f64], params: &[f64]) -> Vec<f64> {
        let inputs: Vec<Number> = inputs.iter().map(|&x| Number::Real(x)).collect();
        let leaves = Leaves {
            inputs: &inputs,
            params,
            time: 0.375,
            pixel: 1e-3,
        };
        let mut out = Vec::new();
        tape.run(&leaves, |value| {
            out.push(match value {
                Number::Real(x) => x,
                _ => f64::NAN,
            });
        });
        out
    }

    /// I, ∂I/∂a and ∂I/∂b.
    fn integral(&mut self, ray: &[f64; 8]) -> [f64; 3] {
        let found = Self::run(&mut self.integral, ray, &self.params);
        [0, 1, 2].map(|k| found.get(k).copied().unwrap_or(f64::NAN))
    }

    fn field(&mut self, ray: &[f64; 8], t: f64) -> f64 {
        let point = [0, 1, 2].map(|k| t.mul_add(ray[3 + k], ray[k]));
        let found = Self::run(&mut self.field, &point, &self.params);
        found.first().copied().unwrap_or(f64::NAN)
    }
}

/// Checks the integral of a formula for these values of its parameters.
#[must_use]
pub fn prove(of: &Formula, made: &FieldIntegral, params: &[f64]) -> Proof {
    let mut graph = made.graph.clone();
    let input = |graph: &mut crate::ir::Graph, k: usize| Formula::leaf(graph, k, Ty::Real);
    let [a, b] = [6, 7].map(|k| input(&mut graph, k));
    let one = graph.real(1.0);
    let root = made.integral.value;
    let slopes = [a, b].map(|end| slope(&mut graph, root, end, one));
    let field = field_at_end(&mut graph, of);
    let is_symbolic = field.is_some_and(|field| is_integral(&graph, root, field));
    let (from, value) = of.to_compile();
    let mut sides = Sides {
        integral: Tape::new(&graph, &[root, slopes[0], slopes[1]]),
        field: Tape::new(from, value),
        params: params.to_vec(),
    };
    let mut out = Proof {
        is_symbolic,
        rays: 0,
        worst: 0.0,
        failure: None,
    };
    let sized = rays()
        .into_iter()
        .filter_map(|ray| Some((ray, sizes(&mut sides, &ray)?)));
    let sized: Vec<([f64; 8], (f64, f64))> = sized.collect();
    // along a ray on which f is 0 both sides are roundings of what f is elsewhere
    let floor = sized
        .iter()
        .fold(0.0_f64, |most, (_, sizes)| most.max(sizes.0))
        * PROOF_TOLERANCE;
    for (ray, (greatest, mean)) in sized {
        out.rays += 1;
        for (what, error) in errors(&mut sides, &ray, greatest.max(floor), mean.max(floor)) {
            let error = if error.is_nan() { f64::INFINITY } else { error };
            out.worst = out.worst.max(error);
            if error > PROOF_TOLERANCE {
                out.failure = Some((what, ray));
                return out;
            }
        }
    }
    out
}

fn slope(graph: &mut crate::ir::Graph, root: Id, leaf: Id, one: Id) -> Id {
    let found = forward(graph, &[root], &[(leaf, one)]);
    match found {
        Ok(tangents) => tangents
            .first()
            .copied()
            .flatten()
            .unwrap_or_else(|| graph.real(0.0)),
        Err(_) => graph.real(f64::NAN),
    }
}

/// f(o + b d)
fn field_at_end(graph: &mut crate::ir::Graph, of: &Formula) -> Option<Id> {
    let (from, value) = of.to_compile();
    let leaves: Vec<Id> = (0..8).map(|k| Formula::leaf(graph, k, Ty::Real)).collect();
    let point: Vec<Id> = (0..3)
        .map(|k| {
            let step = graph.mul(leaves[7], leaves[3 + k]);
            graph.add(leaves[k], step)
        })
        .collect();
    let roots = crate::ir::transcribe(from, value, graph, |to, node, args| match node.op {
        Op::Input(k) => point[usize::from(k).min(2)],
        Op::Apply(prim) => to.apply(prim, args),
        op => to.leaf(op, node.ty),
    });
    roots.first().copied()
}

/// The greatest and the mean |f| along a ray; `None` where f is no finite number somewhere.
fn sizes(sides: &mut Sides, ray: &[f64; 8]) -> Option<(f64, f64)> {
    let (a, b) = (ray[6], ray[7]);
    let (mut greatest, mut sum) = (0.0_f64, 0.0);
    for k in 0..=PLACES {
        let t = a + (b - a) * f64::from(k) / f64::from(PLACES);
        let value = sides.field(ray, t).abs();
        if !value.is_finite() || value > 1e100 {
            return None;
        }
        greatest = greatest.max(value);
        sum += value;
    }
    Some((greatest, sum / f64::from(PLACES + 1)))
}

/// Each identity, with its error.
fn errors(sides: &mut Sides, ray: &[f64; 8], greatest: f64, mean: f64) -> [(&'static str, f64); 5] {
    let (a, b) = (ray[6], ray[7]);
    let length = (b - a).abs();
    let with = |a: f64, b: f64| {
        let mut ray = *ray;
        (ray[6], ray[7]) = (a, b);
        ray
    };
    let size = greatest.max(1e-30);
    let [whole, by_a, by_b] = sides.integral(ray);
    let ends = [a, b].map(|t| sides.field(ray, t));
    let between = 0.375_f64.mul_add(b - a, a);
    let parts = sides.integral(&with(a, between))[0] + sides.integral(&with(between, b))[0];
    // a mistake in what counts only between ends that are far apart is none of a derivative, nor of two long parts
    let place = |k: u8| (b - a).mul_add(f64::from(k) / f64::from(PIECES), a);
    let pieces = (0..PIECES).map(|k| sides.integral(&with(place(k), place(k + 1)))[0]);
    let pieces: f64 = pieces.sum();
    let empty = sides.integral(&with(b, b))[0];
    let share = (mean * length).max(1e-30);
    [
        ("dI/db = f(o + b d)", (by_b - ends[1]).abs() / size),
        ("dI/da = -f(o + a d)", (by_a + ends[0]).abs() / size),
        ("I(a, a) = 0", empty.abs() / share),
        ("I(a, b) + I(b, c) = I(a, c)", (parts - whole).abs() / share),
        (
            "the pieces together are I(a, b)",
            (pieces - whole).abs() / share,
        ),
    ]
}

/// Rays in general position, parallel to axes and nearly so, short and long, and from b to a.
fn rays() -> Vec<[f64; 8]> {
    const DIRECTIONS: [[f64; 3]; 8] = [
        [0.6, -0.5, 0.62],
        [-0.31, 0.82, 0.48],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 0.0],
        [0.0, -1.0, 1e-4],
        [0.7, 1e-7, -0.71],
        [1e-2, 0.99, 0.1],
        [0.05, -0.03, 0.02],
    ];
    const INTERVALS: [[f64; 2]; 5] = [
        [-0.4, 1.3],
        [0.1, 0.9],
        [2.2, -0.7],
        [0.3, 0.34],
        [-3.0, 4.0],
    ];
    let mut out = Vec::new();
    for (k, d) in DIRECTIONS.iter().enumerate() {
        for (n, ends) in INTERVALS.iter().enumerate() {
            if (k + n) % 2 == 1 {
                continue;
            }
            let [x, y] = [k, n].map(|v| u8::try_from(v).map_or(0.0, f64::from));
            let o = [0.17 - 0.11 * y, 0.29 * x - 0.9, 0.23 + 0.07 * y - 0.05 * x];
            out.push([o[0], o[1], o[2], d[0], d[1], d[2], ends[0], ends[1]]);
        }
    }
    out
}
