//! Bounds of a function of space and of its derivatives in a box.
//!
//! Every node is given a number that is at least its absolute value everywhere in the box, and others for its first and second
//! derivatives, from those of its operands by the rules of differentiation with every sign positive: majorants (A. Cauchy; see
//! E. Hairer, S. Nørsett and G. Wanner, Solving Ordinary Differential Equations I, 2nd edition, I.8). They are not tight, but
//! they hold for each point of the box, which no number of samples tells.

use std::f64::consts::FRAC_PI_2;

use crate::ir::{Graph, Id, Node, Op, Prim, Ty};

/// Bounds of f in a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Majorant {
    /// At least |f|.
    pub value: f64,
    /// At least |∇f|.
    pub slope: f64,
    /// At least the norm of the matrix of second derivatives.
    pub curvature: f64,
}

/// More than this is no bound: in single precision f may be infinite.
const LARGEST: f64 = 1e30;
/// Room for the roundings of the bounds themselves.
const ROOM: f64 = 1.0 + 1e-6;
/// Row and column of the elements of a symmetric matrix.
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

#[derive(Clone, Copy, Debug)]
struct Bound {
    value: f64,
    slopes: [f64; 3],
    curvatures: [f64; 6],
}

/// Bounds of a real function of x, y, z, which are inputs 0, 1, 2, where |x|, |y|, |z| are at most `reach`. None where it is not
/// known to be defined and twice differentiable in all of the box: it has parameters, the time, a loop, or a function that has
/// poles, edges or corners.
#[must_use]
pub fn majorant(graph: &Graph, root: Id, reach: [f64; 3]) -> Option<Majorant> {
    let mut bounds: Vec<Option<Bound>> = Vec::with_capacity(graph.nodes().len());
    for node in graph.nodes() {
        bounds.push(of_node(graph, node, &bounds, reach));
    }
    let found = (*bounds.get(root.index())?)?;
    // the greatest sum of a row
    let row = |i: usize| {
        let in_row = PAIRS.iter().zip(&found.curvatures);
        let elements = in_row.filter(|((a, b), _)| *a == i || *b == i);
        elements.map(|(_, c)| c).sum::<f64>()
    };
    let curvature = row(0).max(row(1)).max(row(2));
    let slope = found.slopes.iter().map(|x| x * x).sum::<f64>().sqrt();
    let all = [found.value, slope, curvature].map(|x| x * ROOM);
    let [value, slope, curvature] = all;
    all.iter().all(|x| *x < LARGEST).then_some(Majorant {
        value,
        slope,
        curvature,
    })
}

fn of_node(graph: &Graph, node: &Node, bounds: &[Option<Bound>], reach: [f64; 3]) -> Option<Bound> {
    if node.ty != Ty::Real {
        return None;
    }
    match node.op {
        Op::Const(bits) => Some(Bound::constant(f64::from_bits(bits).abs())),
        Op::Input(k) => Bound::coordinate(usize::from(k), reach),
        Op::Apply(prim) => {
            let operand = |k: usize| *bounds.get(node.args.get(k)?.index())?;
            let divisor = || match graph.node(*node.args.get(1)?).op {
                Op::Const(bits) => Some(f64::from_bits(bits).abs()),
                _ => None,
            };
            apply(prim, operand, divisor)
        }
        _ => None,
    }
}

fn apply(
    prim: Prim,
    operand: impl Fn(usize) -> Option<Bound>,
    divisor: impl Fn() -> Option<f64>,
) -> Option<Bound> {
    let first = operand(0)?;
    match prim {
        Prim::Neg => Some(first),
        Prim::Add | Prim::Sub => Some(first.plus(&operand(1)?)),
        Prim::Mul => Some(first.times(&operand(1)?)),
        Prim::MulAdd => Some(first.times(&operand(1)?).plus(&operand(2)?)),
        Prim::SquarePlus => Some(first.times(&first).plus(&operand(1)?)),
        Prim::Div => Some(first.times(&Bound::constant(1.0 / divisor()?))),
        _ => first.chain(slopes(prim, first.value)?),
    }
}

/// Bounds of a function of one argument and of its first two derivatives where the argument is at most `u`.
fn slopes(prim: Prim, u: f64) -> Option<[f64; 3]> {
    match prim {
        Prim::PowInt(n) if n >= 0 => {
            let whole = f64::from(n);
            // 0⁰ is 1, but those factors are 0 then
            let less = |k: i32| if n < k { 0.0 } else { u.powi(n - k) };
            Some([u.powi(n), whole * less(1), whole * (whole - 1.0) * less(2)])
        }
        Prim::Sin => Some([u.min(1.0), 1.0, u.min(1.0)]),
        Prim::Cos => Some([1.0, u.min(1.0), 1.0]),
        Prim::Exp => Some([u.exp(); 3]),
        Prim::Sinh => Some([u.sinh(), u.cosh(), u.sinh()]),
        Prim::Cosh => Some([u.cosh(), u.sinh(), u.cosh()]),
        // 4/(3√3) at tanh² = 1/3
        Prim::Tanh => Some([u.min(1.0), 1.0, 0.769_800_358_919_501]),
        // 3√3/8 at 1/√3
        Prim::Atan => Some([u.min(FRAC_PI_2), 1.0, 0.649_519_052_838_329]),
        // √(2/e) at 1/√2
        Prim::Gauss => Some([1.0, 0.857_763_884_960_706_8, 2.0]),
        // half the integral of e^{iux} over u from -1 to 1
        Prim::Sinc => Some([1.0, 0.5, 1.0 / 3.0]),
        _ => None,
    }
}

impl Bound {
    fn constant(value: f64) -> Self {
        Self {
            value,
            slopes: [0.0; 3],
            curvatures: [0.0; 6],
        }
    }

    fn coordinate(k: usize, reach: [f64; 3]) -> Option<Self> {
        let mut bound = Self::constant(*reach.get(k)?);
        bound.slopes[k] = 1.0;
        Some(bound)
    }

    fn plus(&self, other: &Self) -> Self {
        Self {
            value: self.value + other.value,
            slopes: [0, 1, 2].map(|i| self.slopes[i] + other.slopes[i]),
            curvatures: [0, 1, 2, 3, 4, 5].map(|k| self.curvatures[k] + other.curvatures[k]),
        }
    }

    fn times(&self, other: &Self) -> Self {
        let (a, b) = (self.value, other.value);
        let (da, db) = (self.slopes, other.slopes);
        let second = |k: usize| {
            let (i, j) = PAIRS[k];
            a * other.curvatures[k] + b * self.curvatures[k] + da[i] * db[j] + da[j] * db[i]
        };
        Self {
            value: a * b,
            slopes: [0, 1, 2].map(|i| a * db[i] + b * da[i]),
            curvatures: [0, 1, 2, 3, 4, 5].map(second),
        }
    }

    /// A function of one argument, of which [`slopes`] are known, of this.
    fn chain(&self, [value, first, second]: [f64; 3]) -> Option<Self> {
        let curvature = |k: usize| {
            let (i, j) = PAIRS[k];
            first * self.curvatures[k] + second * self.slopes[i] * self.slopes[j]
        };
        value.is_finite().then(|| Self {
            value,
            slopes: self.slopes.map(|x| first * x),
            curvatures: [0, 1, 2, 3, 4, 5].map(curvature),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile_function;
    use crate::derive::gradient;
    use crate::eval::{Leaves, Tape};
    use crate::formula::Formula;
    use crate::table::Number;

    fn formula(text: &str) -> Formula {
        compile_function(&format!("f(x, y, z) = {text}")).unwrap()
    }

    fn of(text: &str, reach: [f64; 3]) -> Option<Majorant> {
        let formula = formula(text);
        majorant(&formula.graph, formula.value[0], reach)
    }

    /// The value, the gradient, and the matrix of second derivatives row by row.
    fn all_derivatives(formula: &Formula) -> Tape {
        let mut graph = formula.graph.clone();
        let leaves = [0, 1, 2].map(|k| Formula::leaf(&mut graph, k, Ty::Real));
        let first = gradient(&mut graph, formula.value[0], &leaves).unwrap();
        let mut roots = vec![first.value];
        roots.extend(&first.partials);
        for partial in &first.partials {
            let second = gradient(&mut graph, *partial, &leaves).unwrap();
            roots.extend(&second.partials);
        }
        Tape::new(&graph, &roots)
    }

    #[test]
    fn no_point_of_the_box_has_more() {
        let texts = [
            "x^2 + y^2 + z^2 + 2 x y z - 1",
            "3 (cos(x) + cos(y) + cos(z)) + 4 cos(x) cos(y) cos(z)",
            "sin(x y) cos(z)^3 - tanh(x + 2 z)/3",
            "exp(-x^2 - y^2) + atan(2 x z) - sinh(y)/5 + cosh(x)",
            "sinc(3 x) sinc(y + z) + (x - y)^5/7 - z^0",
        ];
        let reach = [1.3, 0.8, 2.1];
        let mut state = 1_u64;
        let mut random = || {
            // D. Knuth's linear congruential generator
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / 4_503_599_627_370_496.0 - 1.0
        };
        for text in texts {
            let bound = of(text, reach).unwrap();
            let mut tape = all_derivatives(&formula(text));
            for _ in 0..2000 {
                let p = reach.map(|r| r * random());
                let d = [random(), random(), random()];
                let inputs = p.map(Number::Real);
                let leaves = Leaves {
                    inputs: &inputs,
                    params: &[],
                    time: 0.0,
                    pixel: 0.0,
                };
                let mut found = Vec::new();
                tape.run(&leaves, |x| match x {
                    Number::Real(x) => found.push(x),
                    _ => found.push(f64::NAN),
                });
                let square: f64 = d.iter().map(|x| x * x).sum();
                let slope: f64 = found[1..4].iter().map(|x| x * x).sum::<f64>().sqrt();
                let bend: f64 = (0..9).map(|k| found[4 + k] * d[k / 3] * d[k % 3]).sum();
                assert!(found[0].abs() <= bound.value, "{text} at {p:?}");
                assert!(slope <= bound.slope, "{text} at {p:?}");
                assert!(bend.abs() <= bound.curvature * square, "{text} at {p:?}");
            }
        }
    }

    #[test]
    fn bounds_are_those_of_the_rules() {
        let bound = of("x^2 + y^2 + z^2 + 2 x y z - 1", [1.5; 3]).unwrap();
        assert!((bound.value - 14.5).abs() < 1e-4);
        assert!((bound.slope - 7.5 * 3.0_f64.sqrt()).abs() < 1e-4);
        assert!((bound.curvature - 8.0).abs() < 1e-4);
    }

    #[test]
    fn what_may_be_undefined_or_has_corners_has_none() {
        for text in [
            "1/x",
            "sqrt(x)",
            "abs(x) + y",
            "log(x + 3)",
            "tan(x)",
            "x^-2",
            "x^y",
            "max(x, y)",
            "floor(z)",
            "x + time",
            "if x > 0 then y else z",
            "exp(100 x)",
        ] {
            assert_eq!(of(text, [1.0; 3]), None, "{text}");
        }
    }
}
