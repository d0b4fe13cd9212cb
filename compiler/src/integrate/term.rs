//! Products that are integrated one by one.

use smallvec::SmallVec;

use super::arithmetic::{add, mul};
use crate::ir::{Graph, Id, Prim};

/// Greatest number of factors of a divisor that are looked at.
const MAX_DIVISORS: usize = 16;

/// A function of the path's parameter that the rules know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// A polynomial of degree 1 or more.
    Polynomial(Id),
    /// e to a polynomial of degree 1 or 2.
    Exponential(Id),
    /// sin, cos, sinh or cosh of a polynomial of degree 1.
    Wave(Prim, Id),
    /// A power of a polynomial of degree 1 or 2 with a constant exponent.
    Power(Id, Id),
    /// The natural logarithm of a polynomial of degree 1 or 2.
    Log(Id),
    /// A function of the table, of a polynomial of degree 1, that has a rule of its own.
    Function(Prim, Id),
    /// 1/(1 + e^-x) of a polynomial x of degree 1.
    Logistic(Id),
    /// Σ over a counter of terms that have an integral each: the result of a loop.
    Series(Id),
    /// Something without a rule.
    Other(Id),
}

/// A product of factors, a coefficient that is constant along the path, and the conditions under which it counts.
#[derive(Clone, Debug)]
pub struct Term {
    /// What does not change along the path.
    pub coefficient: Id,
    /// What does.
    pub factors: SmallVec<[Factor; 4]>,
    /// Conditions, constant along the path, of which all must be as told.
    pub guards: SmallVec<[(Id, bool); 2]>,
    /// The expression that it comes from.
    pub source: Id,
    /// The product that was written out, of which it is one of several terms.
    pub product: Option<Id>,
}

impl Term {
    /// A constant.
    pub fn constant(coefficient: Id) -> Self {
        Self {
            coefficient,
            factors: SmallVec::new(),
            guards: SmallVec::new(),
            source: coefficient,
            product: None,
        }
    }

    /// One factor.
    pub fn of(g: &mut Graph, factor: Factor, source: Id) -> Self {
        Self {
            coefficient: g.real(1.0),
            factors: SmallVec::from_slice(&[factor]),
            guards: SmallVec::new(),
            source,
            product: None,
        }
    }

    /// The product of two terms. Powers of one base become one power, exponentials one exponential.
    pub fn times(&self, g: &mut Graph, other: &Self, source: Id) -> Self {
        let mut out = self.clone();
        out.coefficient = mul(g, self.coefficient, other.coefficient);
        out.source = if other.factors.is_empty() {
            self.source
        } else if self.factors.is_empty() {
            other.source
        } else {
            source
        };
        for &factor in &other.factors {
            out.push(g, factor);
        }
        for &guard in &other.guards {
            if !out.guards.contains(&guard) {
                out.guards.push(guard);
            }
        }
        out
    }

    fn push(&mut self, g: &mut Graph, factor: Factor) {
        for known in &mut self.factors {
            if let Some(joined) = joined(g, *known, factor) {
                *known = joined;
                return self.tidy(g);
            }
        }
        self.factors.push(factor);
    }

    /// Powers with whole exponents of at least 0 are polynomials.
    fn tidy(&mut self, g: &mut Graph) {
        for factor in &mut self.factors {
            if let Factor::Power(base, exponent) = *factor
                && let Some(n) = g.as_real(exponent)
                && n >= 0.0
                && n.fract() == 0.0
                && n < 64.0
            {
                #[allow(clippy::cast_possible_truncation, reason = "bounded just above")]
                let power = g.apply(Prim::PowInt(n as i32), &[base]);
                *factor = Factor::Polynomial(power);
            }
        }
        let one = |f: &Factor| matches!(f, Factor::Polynomial(p) if g.as_real(*p) == Some(1.0));
        self.factors.retain(|f| !one(f));
    }

    /// One over the term, where each factor has an inverse.
    pub fn inverse(&self, g: &mut Graph, degree: impl Fn(Id) -> Option<u32>) -> Option<Self> {
        let one = g.real(1.0);
        let mut out = Self::constant(g.div(one, self.coefficient));
        if !self.guards.is_empty() {
            return None;
        }
        for &factor in &self.factors {
            let inverse = match factor {
                Factor::Polynomial(p) => {
                    out.divide(g, p, &degree)?;
                    continue;
                }
                Factor::Exponential(exponent) => Factor::Exponential(g.neg(exponent)),
                Factor::Power(base, exponent) => Factor::Power(base, g.neg(exponent)),
                Factor::Wave(Prim::Cosh, x) => Factor::Function(Prim::Sech, x),
                _ => return None,
            };
            out.push(g, inverse);
        }
        out.source = self.source;
        Some(out)
    }

    /// Divides by a polynomial that is a power of one of degree 1 or 2, or is written as a product of such.
    fn divide(&mut self, g: &mut Graph, p: Id, degree: &impl Fn(Id) -> Option<u32>) -> Option<()> {
        let mut stack = vec![p];
        while let Some(p) = stack.pop() {
            let node = g.node(p).clone();
            if degree(p) == Some(0) {
                self.coefficient = g.div(self.coefficient, p);
            } else if let Some(power) = powers_of(g, p, degree) {
                self.push(g, power);
            } else if node.op == crate::ir::Op::Apply(Prim::Mul) && stack.len() < MAX_DIVISORS {
                stack.extend(node.args);
            } else {
                return None;
            }
        }
        Some(())
    }

    /// The term as an expression.
    pub fn integrand(&self, g: &mut Graph) -> Id {
        let mut product = self.coefficient;
        for &factor in &self.factors {
            let factor = factor.expression(g);
            product = mul(g, product, factor);
        }
        product
    }

    /// The factors alone as an expression, 1 where there are none.
    pub fn moving(&self, g: &mut Graph) -> Id {
        let one = g.real(1.0);
        let coefficient = one;
        Self {
            coefficient,
            ..self.clone()
        }
        .integrand(g)
    }
}

impl Factor {
    /// The factor as an expression.
    pub fn expression(self, g: &mut Graph) -> Id {
        match self {
            Self::Polynomial(id) | Self::Series(id) | Self::Other(id) => id,
            Self::Exponential(exponent) => g.apply(Prim::Exp, &[exponent]),
            Self::Wave(prim, phase) | Self::Function(prim, phase) => g.apply(prim, &[phase]),
            Self::Logistic(x) => {
                let (one, back) = (g.real(1.0), g.neg(x));
                let fall = g.apply(Prim::Exp, &[back]);
                let base = g.add(one, fall);
                g.div(one, base)
            }
            Self::Log(base) => g.apply(Prim::Log, &[base]),
            Self::Power(base, exponent) => match g.as_real(exponent) {
                Some(0.5) => g.apply(Prim::Sqrt, &[base]),
                Some(-0.5) => {
                    let (one, root) = (g.real(1.0), g.apply(Prim::Sqrt, &[base]));
                    g.div(one, root)
                }
                Some(p) if (2.0 * p).fract() == 0.0 && p.fract() != 0.0 && p.abs() < 64.0 => {
                    let root = g.apply(Prim::Sqrt, &[base]);
                    #[allow(clippy::cast_possible_truncation, reason = "bounded just above")]
                    g.apply(Prim::PowInt((2.0 * p) as i32), &[root])
                }
                _ => g.apply(Prim::Pow, &[base, exponent]),
            },
        }
    }
}

/// The product of two factors as one.
fn joined(g: &mut Graph, a: Factor, b: Factor) -> Option<Factor> {
    match (a, b) {
        (Factor::Exponential(x), Factor::Exponential(y)) => Some(Factor::Exponential(add(g, x, y))),
        (Factor::Power(x, p), Factor::Power(y, q)) if x == y => {
            let exponent = add(g, p, q);
            Some(Factor::Power(x, exponent))
        }
        (Factor::Power(x, p), Factor::Polynomial(y))
        | (Factor::Polynomial(y), Factor::Power(x, p)) => {
            let (base, n) = g.power_of(y);
            if base != x {
                return None;
            }
            let n = g.real(f64::from(n));
            let exponent = add(g, p, n);
            Some(Factor::Power(x, exponent))
        }
        _ => None,
    }
}

/// 1/p for a power of a polynomial of degree 1 or 2.
fn powers_of(g: &mut Graph, p: Id, degree: &impl Fn(Id) -> Option<u32>) -> Option<Factor> {
    let (base, n) = g.power_of(p);
    matches!(degree(base), Some(1 | 2)).then(|| Factor::Power(base, g.real(-f64::from(n))))
}

impl Graph {
    /// The base and the exponent of a power with a positive whole exponent; anything else is its own first power.
    fn power_of(&self, id: Id) -> (Id, i32) {
        let node = self.node(id);
        match node.op {
            crate::ir::Op::Apply(Prim::PowInt(n)) if n > 0 => (node.args[0], n),
            _ => (id, 1),
        }
    }
}
