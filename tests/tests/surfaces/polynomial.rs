//! Polynomials in x, y and z, expanded from the IR with arithmetic of their own: a degree and derivatives that owe nothing to
//! the compiler's.

use std::collections::BTreeMap;

use pullback_compiler::ir::{Graph, Id, Op, Prim};

/// Exponents of x, y and z.
type Exponents = [u32; 3];

/// A coefficient, and the sum of the absolute values of all that was added up to it.
#[derive(Clone, Copy, Debug, Default)]
struct Coefficient {
    value: f64,
    size: f64,
}

/// A polynomial in three variables.
#[derive(Clone, Debug, Default)]
pub struct Polynomial(BTreeMap<Exponents, Coefficient>);

/// A value, and the sum of the absolute values of the terms, against which it is judged.
#[derive(Clone, Copy, Debug)]
pub struct Value {
    pub value: f64,
    pub size: f64,
}

impl Polynomial {
    fn constant(value: f64) -> Self {
        let size = value.abs();
        Self(BTreeMap::from([([0; 3], Coefficient { value, size })]))
    }

    fn variable(k: usize) -> Self {
        let mut exponents = [0; 3];
        exponents[k] = 1;
        let one = Coefficient {
            value: 1.0,
            size: 1.0,
        };
        Self(BTreeMap::from([(exponents, one)]))
    }

    fn scaled(&self, factor: f64) -> Self {
        let scale = |c: &Coefficient| Coefficient {
            value: factor * c.value,
            size: factor.abs() * c.size,
        };
        Self(self.0.iter().map(|(k, c)| (*k, scale(c))).collect())
    }

    fn plus(mut self, other: &Self) -> Self {
        for (exponents, c) in &other.0 {
            let sum = self.0.entry(*exponents).or_default();
            sum.value += c.value;
            sum.size += c.size;
        }
        self
    }

    fn times(&self, other: &Self) -> Self {
        let mut out = Self::default();
        for (a, c) in &self.0 {
            for (b, d) in &other.0 {
                let sum = out.0.entry([0, 1, 2].map(|k| a[k] + b[k])).or_default();
                sum.value += c.value * d.value;
                sum.size += c.size * d.size;
            }
        }
        out
    }

    fn power(&self, n: u32) -> Self {
        (0..n).fold(Self::constant(1.0), |product, _| product.times(self))
    }

    fn as_constant(&self) -> Option<f64> {
        let constant = self.0.get(&[0; 3]).map_or(0.0, |c| c.value);
        (self.degree() == 0).then_some(constant)
    }

    /// Expands the value of a graph, with numbers for the parameters.
    pub fn expanded(graph: &Graph, root: Id, params: &[f64]) -> Self {
        let mut values: Vec<Self> = Vec::new();
        for node in graph.nodes() {
            let operand = |k: usize| &values[node.args[k].index()];
            values.push(match node.op {
                Op::Const(bits) => Self::constant(f64::from_bits(bits)),
                Op::Input(k) => Self::variable(k.into()),
                Op::Param(k) => Self::constant(params[usize::from(k)]),
                Op::Apply(prim) => apply(prim, operand),
                other => panic!("{other:?} in a polynomial"),
            });
        }
        values[root.index()].clone()
    }

    /// The total degree. What is less than the rounding errors of the expansion is zero.
    pub fn degree(&self) -> u32 {
        let there = self
            .0
            .iter()
            .filter(|(_, c)| c.value.abs() > 1e-12 * c.size);
        there.map(|(k, _)| k.iter().sum()).max().unwrap_or(0)
    }

    /// The value at a point.
    pub fn at(&self, p: [f64; 3]) -> Value {
        let mut sum = Value {
            value: 0.0,
            size: 0.0,
        };
        for (exponents, c) in &self.0 {
            let power: f64 = (0..3).map(|k| p[k].powi(exponents[k] as i32)).product();
            sum.value += c.value * power;
            sum.size += c.size * power.abs();
        }
        sum
    }

    /// The derivative by the k-th variable.
    pub fn derivative(&self, k: usize) -> Self {
        let mut out = Self::default();
        for (exponents, c) in self.0.iter().filter(|(e, _)| e[k] > 0) {
            let n = f64::from(exponents[k]);
            let mut lower = *exponents;
            lower[k] -= 1;
            let coefficient = Coefficient {
                value: n * c.value,
                size: n * c.size,
            };
            out.0.insert(lower, coefficient);
        }
        out
    }
}

fn apply<'a>(prim: Prim, operand: impl Fn(usize) -> &'a Polynomial) -> Polynomial {
    let (a, constant) = (operand(0), |k: usize| {
        operand(k).as_constant().expect("a constant operand")
    });
    match prim {
        Prim::Neg => a.scaled(-1.0),
        Prim::Add => a.clone().plus(operand(1)),
        Prim::Sub => a.clone().plus(&operand(1).scaled(-1.0)),
        Prim::Mul => a.times(operand(1)),
        Prim::Div => a.scaled(1.0 / constant(1)),
        Prim::Sqrt => Polynomial::constant(constant(0).sqrt()),
        Prim::PowInt(n) => a.power(n.try_into().expect("a polynomial")),
        Prim::Pow => a.power(constant(1) as u32),
        other => panic!("{other:?} in a polynomial"),
    }
}

/// A polynomial with its first and second derivatives.
#[derive(Debug)]
pub struct Jet {
    pub value: Polynomial,
    pub gradient: [Polynomial; 3],
    pub hessian: [[Polynomial; 3]; 3],
}

impl Jet {
    pub fn new(value: Polynomial) -> Self {
        let gradient = [0, 1, 2].map(|k| value.derivative(k));
        let hessian = [0, 1, 2].map(|j| [0, 1, 2].map(|k| gradient[j].derivative(k)));
        Self {
            value,
            gradient,
            hessian,
        }
    }

    pub fn hessian_at(&self, p: [f64; 3]) -> [[f64; 3]; 3] {
        let at = |k: usize, j: usize| self.hessian[k][j].at(p).value;
        [0, 1, 2].map(|k| [0, 1, 2].map(|j| at(k, j)))
    }
}
