//! From an expression to the sum of products that is integrated.

use std::f64::consts::LN_2;

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::arithmetic::{add, mul, scale, square, sub};
use super::term::{Factor, Term};
use super::{Integrator, Problem, Reason};
use crate::ir::{Id, Op, Prim};

/// Greatest number of products that an expression may become.
pub const MAX_TERMS: usize = 256;
/// Greatest number of factors of a product, powers written out.
pub const MAX_FACTORS: usize = 16;

type Known = FxHashMap<Id, Vec<Term>>;

impl Integrator<'_> {
    /// The sum of products that an expression is. Polynomials stay as they are written.
    ///
    /// # Errors
    /// There are more products or factors than the bounds allow.
    pub(super) fn expand(&mut self, root: Id) -> Result<Vec<Term>, Problem> {
        let mut known: Known = FxHashMap::default();
        let mut stack = vec![(root, false)];
        while let Some((id, ready)) = stack.pop() {
            if known.contains_key(&id) {
                continue;
            }
            let parts = self.parts(id);
            if parts.is_empty() {
                let terms = self.atom(id);
                known.insert(id, terms);
            } else if ready {
                let terms = self.combine(id, &known)?;
                known.insert(id, terms);
            } else {
                stack.push((id, true));
                stack.extend(parts.into_iter().map(|part| (part, false)));
            }
        }
        Ok(known.remove(&root).unwrap_or_default())
    }

    /// The operands that are expanded before an expression is; none of an atom.
    fn parts(&mut self, id: Id) -> SmallVec<[Id; 2]> {
        if self.degree(id).is_some() {
            return SmallVec::new();
        }
        let node = self.g.node(id).clone();
        let Op::Apply(prim) = node.op else {
            return SmallVec::new();
        };
        match (prim, node.args.as_slice()) {
            (Prim::Add | Prim::Sub | Prim::Mul | Prim::Div, &[a, b]) => {
                SmallVec::from_slice(&[a, b])
            }
            (Prim::Neg | Prim::PowInt(_), &[a]) => SmallVec::from_slice(&[a]),
            (Prim::Sqrt, &[a]) if self.degree(a).is_none() => SmallVec::from_slice(&[a]),
            (Prim::Select, &[c, a, b]) if !self.moves(c) => SmallVec::from_slice(&[a, b]),
            _ => SmallVec::new(),
        }
    }

    fn combine(&mut self, id: Id, known: &Known) -> Result<Vec<Term>, Problem> {
        let node = self.g.node(id).clone();
        let Op::Apply(prim) = node.op else {
            return Ok(vec![self.other(id)]);
        };
        let of = |k: usize| known.get(&node.args[k]).cloned().unwrap_or_default();
        match prim {
            Prim::Neg => {
                let mut terms = self.scaled(of(0), -1.0);
                for term in &mut terms {
                    term.product = term.product.map(|_| id);
                }
                Ok(terms)
            }
            Prim::Add => self.join(of(0), of(1), id),
            Prim::Sub => {
                let negated = self.g.neg(node.args[1]);
                let mut right = self.scaled(of(1), -1.0);
                for term in &mut right {
                    term.product = term.product.map(|_| negated);
                }
                self.join(of(0), right, id)
            }
            Prim::Mul => self.product(&of(0), &of(1), id),
            Prim::Div => match self.inverse(&of(1)) {
                Some(inverse) => {
                    let numerator = of(0);
                    let mut terms = self.product(&numerator, &[inverse], id)?;
                    if let [term] = terms.as_mut_slice() {
                        term.source = id;
                    }
                    Ok(terms)
                }
                None => self.quotient_without_rule(id, &of(0), &of(1)),
            },
            Prim::PowInt(n) => self.power(id, &of(0), n),
            Prim::Sqrt => Ok(vec![self.root(id, &of(0))]),
            Prim::Select => {
                let (mut then, mut otherwise) = (of(1), of(2));
                let condition = node.args[0];
                for (terms, holds) in [(&mut then, true), (&mut otherwise, false)] {
                    for term in terms {
                        term.guards.push((condition, holds));
                        term.product = None;
                    }
                }
                self.join(then, otherwise, id)
            }
            _ => Ok(vec![self.other(id)]),
        }
    }

    fn other(&mut self, id: Id) -> Term {
        Term::of(self.g, Factor::Other(id), id)
    }

    /// A quotient whose divisor has no inverse among the factors: the known functions of that form, or none.
    fn quotient_without_rule(
        &mut self,
        id: Id,
        numerator: &[Term],
        divisor: &[Term],
    ) -> Result<Vec<Term>, Problem> {
        match self.logistic_of(divisor, id) {
            Some(term) => self.product(numerator, &[term], id),
            None => Ok(vec![self.other(id)]),
        }
    }

    /// 1/(k + m e^x) = (1/k)/(1 + e^(x + log(m/k))) for numbers k and m of one sign.
    fn logistic_of(&mut self, divisor: &[Term], id: Id) -> Option<Term> {
        let [first, second] = divisor else {
            return None;
        };
        let (constant, growing) = if first.factors.is_empty() {
            (first, second)
        } else {
            (second, first)
        };
        let [Factor::Exponential(exponent)] = *growing.factors.as_slice() else {
            return None;
        };
        let (k, m) = (
            self.g.as_real(constant.coefficient)?,
            self.g.as_real(growing.coefficient)?,
        );
        let is_plain =
            constant.factors.is_empty() && first.guards.is_empty() && second.guards.is_empty();
        if !is_plain || m / k <= 0.0 || self.degree(exponent) != Some(1) {
            return None;
        }
        let shift = self.g.real((m / k).ln());
        let sum = add(self.g, exponent, shift);
        let x = self.g.neg(sum);
        let mut term = Term::of(self.g, Factor::Logistic(x), id);
        term.coefficient = self.g.real(1.0 / k);
        Some(term)
    }

    fn scaled(&mut self, mut terms: Vec<Term>, v: f64) -> Vec<Term> {
        for term in &mut terms {
            term.coefficient = scale(self.g, v, term.coefficient);
        }
        terms
    }

    fn join(&mut self, mut a: Vec<Term>, b: Vec<Term>, id: Id) -> Result<Vec<Term>, Problem> {
        a.extend(b);
        self.bounded(a, id)
    }

    fn bounded(&mut self, terms: Vec<Term>, id: Id) -> Result<Vec<Term>, Problem> {
        if terms.len() > MAX_TERMS {
            return Err(self.problem(id, Reason::Bound("terms", MAX_TERMS)));
        }
        if let Some(long) = terms.iter().find(|t| t.factors.len() > MAX_FACTORS) {
            let source = long.source;
            return Err(self.problem(source, Reason::Bound("factors", MAX_FACTORS)));
        }
        Ok(terms)
    }

    fn product(&mut self, a: &[Term], b: &[Term], id: Id) -> Result<Vec<Term>, Problem> {
        if a.len().saturating_mul(b.len()) > MAX_TERMS {
            return Err(self.problem(id, Reason::Bound("terms", MAX_TERMS)));
        }
        let mut out = Vec::with_capacity(a.len() * b.len());
        for left in a {
            for right in b {
                let contradict = |&(c, holds): &(Id, bool)| right.guards.contains(&(c, !holds));
                if !left.guards.iter().any(contradict) {
                    out.push(left.times(self.g, right, id));
                }
            }
        }
        let several = out.len() > 1;
        for term in &mut out {
            term.product = several.then_some(id);
        }
        self.bounded(out, id)
    }

    fn power(&mut self, id: Id, base: &[Term], n: i32) -> Result<Vec<Term>, Problem> {
        let one = Term::constant(self.g.real(1.0));
        let count = n.unsigned_abs() as usize;
        if let [term] = base
            && let [Factor::Power(x, p)] = term.factors.as_slice()
            && term.guards.is_empty()
        {
            let exponent = scale(self.g, f64::from(n), *p);
            let mut power = Term::of(self.g, Factor::Power(*x, exponent), id);
            power.coefficient = self.g.apply(Prim::PowInt(n), &[term.coefficient]);
            return Ok(vec![power.times(self.g, &one, id)]);
        }
        if count > MAX_FACTORS {
            return Err(self.problem(id, Reason::Bound("factors", MAX_FACTORS)));
        }
        let mut out = vec![one.clone()];
        for _ in 0..count {
            out = self.product(&out, base, id)?;
        }
        if n > 0 {
            return Ok(out);
        }
        match self.inverse(&out) {
            Some(inverse) => Ok(vec![inverse]),
            None => Ok(vec![self.other(id)]),
        }
    }

    fn inverse(&mut self, terms: &[Term]) -> Option<Term> {
        let [term] = terms else { return None };
        self.extend_classes();
        let classes = &self.classes;
        term.inverse(self.g, |id| classes.known_degree(id))
    }

    /// The square root of a product of exponentials and even powers of quadratics.
    fn root(&mut self, id: Id, base: &[Term]) -> Term {
        let [term] = base else { return self.other(id) };
        let mut out = Term::constant(self.g.apply(Prim::Sqrt, &[term.coefficient]));
        if !term.guards.is_empty() {
            return self.other(id);
        }
        for &factor in &term.factors {
            let part = match factor {
                Factor::Exponential(exponent) => Factor::Exponential(scale(self.g, 0.5, exponent)),
                // a power of a sum of squares is not negative, and so is its root
                Factor::Power(base, p) if self.is_sum_of_squares(base) => {
                    Factor::Power(base, scale(self.g, 0.5, p))
                }
                _ => return self.other(id),
            };
            let part = Term::of(self.g, part, id);
            out = out.times(self.g, &part, id);
        }
        out.source = id;
        out
    }

    /// The terms of an expression that has no parts.
    fn atom(&mut self, id: Id) -> Vec<Term> {
        match self.degree(id) {
            Some(0) if super::arithmetic::is_zero(self.g, id) => return Vec::new(),
            Some(0) => return vec![Term::constant(id)],
            Some(_) => return vec![Term::of(self.g, Factor::Polynomial(id), id)],
            None => {}
        }
        let node = self.g.node(id).clone();
        let Op::Apply(prim) = node.op else {
            let factor = match node.op {
                Op::Result(_) => Factor::Series(id),
                _ => Factor::Other(id),
            };
            return vec![Term::of(self.g, factor, id)];
        };
        let (factor, coefficient) = self
            .factor(prim, &node.args)
            .unwrap_or((Factor::Other(id), 1.0));
        let mut term = Term::of(self.g, factor, id);
        term.coefficient = self.g.real(coefficient);
        vec![term]
    }

    /// The factor that an operation is, with a coefficient.
    fn factor(&mut self, prim: Prim, args: &[Id]) -> Option<(Factor, f64)> {
        let degree = |this: &mut Self, id: Id| this.degree(id).filter(|d| (1..=2).contains(d));
        let first = *args.first()?;
        Some(match prim {
            Prim::Exp if degree(self, first).is_some() => (Factor::Exponential(first), 1.0),
            Prim::Exp2 if degree(self, first).is_some() => {
                let exponent = scale(self.g, LN_2, first);
                (Factor::Exponential(exponent), 1.0)
            }
            Prim::Sin | Prim::Cos | Prim::Sinh | Prim::Cosh if self.degree(first) == Some(1) => {
                (Factor::Wave(prim, first), 1.0)
            }
            Prim::Tanh | Prim::Sech | Prim::Atan | Prim::Asinh | Prim::Erf | Prim::Erfc
                if self.degree(first) == Some(1) =>
            {
                (Factor::Function(prim, first), 1.0)
            }
            Prim::Sqrt if degree(self, first).is_some() => {
                let half = self.g.real(0.5);
                (Factor::Power(first, half), 1.0)
            }
            Prim::Hypot | Prim::Hypot3 => {
                let base = self.sum_of_squares(args)?;
                let half = self.g.real(0.5);
                (Factor::Power(base, half), 1.0)
            }
            Prim::Log => self.logarithm(first)?,
            Prim::Log2 => {
                let (factor, v) = self.logarithm(first)?;
                (factor, v / LN_2)
            }
            Prim::Log10 => {
                let (factor, v) = self.logarithm(first)?;
                (factor, v / std::f64::consts::LN_10)
            }
            Prim::Log1p if degree(self, first).is_some() => {
                let one = self.g.real(1.0);
                let base = add(self.g, one, first);
                (Factor::Log(base), 1.0)
            }
            Prim::Pow => self.general_power(first, args[1])?,
            _ => return None,
        })
    }

    fn general_power(&mut self, base: Id, exponent: Id) -> Option<(Factor, f64)> {
        if !self.moves(base) {
            // cˣ = e^(x ln c)
            if !matches!(self.degree(exponent), Some(1 | 2)) {
                return None;
            }
            let log = self.g.apply(Prim::Log, &[base]);
            let exponent = mul(self.g, exponent, log);
            return Some((Factor::Exponential(exponent), 1.0));
        }
        if self.moves(exponent) {
            return None;
        }
        if let Some(squares) = self.length(base) {
            let half = scale(self.g, 0.5, exponent);
            return Some((Factor::Power(squares, half), 1.0));
        }
        matches!(self.degree(base), Some(1 | 2)).then_some((Factor::Power(base, exponent), 1.0))
    }

    fn logarithm(&mut self, base: Id) -> Option<(Factor, f64)> {
        if let Some(squares) = self.length(base) {
            return Some((Factor::Log(squares), 0.5));
        }
        matches!(self.degree(base), Some(1 | 2)).then_some((Factor::Log(base), 1.0))
    }

    /// |v|² where an expression is the length of a vector that changes evenly, or a square root.
    fn length(&mut self, id: Id) -> Option<Id> {
        let node = self.g.node(id).clone();
        match node.op {
            Op::Apply(Prim::Hypot | Prim::Hypot3) => self.sum_of_squares(&node.args),
            Op::Apply(Prim::Sqrt) => {
                let base = node.args[0];
                matches!(self.degree(base), Some(1 | 2)).then_some(base)
            }
            _ => None,
        }
    }

    fn sum_of_squares(&mut self, args: &[Id]) -> Option<Id> {
        let mut sum = self.g.real(0.0);
        for &arg in args {
            if self.degree(arg)? > 1 {
                return None;
            }
            let part = square(self.g, arg);
            sum = add(self.g, sum, part);
        }
        Some(sum)
    }

    /// a - b, for conditions.
    pub(super) fn difference(&mut self, a: Id, b: Id) -> Id {
        sub(self.g, a, b)
    }
}
