//! Logarithms of sums of exponentials, of hyperbolic functions and of tangents: neither overflow nor 1 + a small number is
//! formed on the way.

use std::f64::consts::{FRAC_PI_4, LN_2};

use smallvec::SmallVec;

use super::guard::{choose, is_real, less, positive, scaled, within};
use super::pass::{Pass, only_atom};
use super::polynomial::{Expand, Polynomial, build};
use super::rule::Rule;
use crate::ir::{Graph, Id, Prim};

impl Pass {
    /// The logarithm of a real sum or function that has a better form.
    pub(super) fn log_of_exponentials(&mut self, g: &mut Graph, a: Id) -> Option<Id> {
        if !is_real(g, a) {
            return None;
        }
        match self.view(g, a) {
            (Some(Prim::Tan), &[t]) => self.log_of_tangent(g, t),
            (Some(Prim::Cosh), &[x]) => self.log_of_cosh(g, x),
            (Some(Prim::Sinh), &[x]) => self.log_of_sinh(g, a, x, false),
            (Some(Prim::Abs), &[s]) => {
                let x = self.argument(g, s, Prim::Sinh)?;
                self.log_of_sinh(g, a, x, true)
            }
            (Some(Prim::Add), _) => self.log_of_sum(g, a),
            _ => None,
        }
    }

    /// log tan(π/4 + a) = 2 atanh(tan a)
    fn log_of_tangent(&mut self, g: &mut Graph, t: Id) -> Option<Id> {
        if !self.on(Rule::LogTan) {
            return None;
        }
        let p = self.polynomial(g, t, Expand::Constants)?;
        let is_quarter = |term: &(super::polynomial::Monomial, f64)| {
            term.0.is_empty() && term.1.to_bits() == FRAC_PI_4.to_bits()
        };
        if p.terms.len() < 2 || !p.terms.iter().any(is_quarter) {
            return None;
        }
        let rest: SmallVec<[_; 8]> = p.terms.into_iter().filter(|t| !is_quarter(t)).collect();
        let rest = build(g, &rest);
        let tan = g.apply(Prim::Tan, &[rest]);
        let atanh = g.apply(Prim::Atanh, &[tan]);
        let new = scaled(g, 2.0, atanh);
        self.by(Rule::LogTan, new)
    }

    /// log(exp a + exp b) = a + log1p(exp(b - a)) for a > b, else b + log1p(exp(a - b)); log(1 + exp a) likewise.
    fn log_of_sum(&mut self, g: &mut Graph, sum: Id) -> Option<Id> {
        if !self.on(Rule::LogSum) {
            return None;
        }
        let p = self.polynomial(g, sum, Expand::Constants)?;
        let [first, second] = p.terms.as_slice() else {
            return None;
        };
        if [first, second]
            .iter()
            .any(|t| t.1.to_bits() != 1.0_f64.to_bits())
        {
            return None;
        }
        let exponent = |term: &(super::polynomial::Monomial, f64)| {
            self.argument(g, only_atom(&term.0)?, Prim::Exp)
        };
        let new = match (exponent(first), exponent(second)) {
            (Some(a), None) if second.0.is_empty() => Self::softplus(g, a),
            (None, Some(a)) if first.0.is_empty() => Self::softplus(g, a),
            (Some(a), Some(b)) => {
                let (left, right) = (Self::above(g, a, b), Self::above(g, b, a));
                let greater = less(g, b, a);
                let either = choose(g, greater, left, right);
                // infinite exponents have no difference
                let difference = g.sub(a, b);
                let finite = within(g, difference, 1e30);
                let written = g.apply(Prim::Log, &[sum]);
                choose(g, finite, either, written)
            }
            _ => return None,
        };
        self.by(Rule::LogSum, new)
    }

    /// a + log1p(exp(b - a))
    fn above(g: &mut Graph, a: Id, b: Id) -> Id {
        let difference = g.sub(b, a);
        let exp = g.apply(Prim::Exp, &[difference]);
        let log = g.apply(Prim::Log1p, &[exp]);
        g.add(a, log)
    }

    /// a + log1p(exp(-a)) for a > 0, else log1p(exp a)
    fn softplus(g: &mut Graph, a: Id) -> Id {
        let minus = g.neg(a);
        let (down, up) = (g.apply(Prim::Exp, &[minus]), g.apply(Prim::Exp, &[a]));
        let rest = g.apply(Prim::Log1p, &[down]);
        let right = g.add(a, rest);
        let left = g.apply(Prim::Log1p, &[up]);
        let condition = positive(g, a);
        choose(g, condition, right, left)
    }

    /// log cosh a = log1p(2 sinh²(a/2)) for |a| < 1, else |a| + log1p(exp(-2|a|)) - log 2
    fn log_of_cosh(&mut self, g: &mut Graph, a: Id) -> Option<Id> {
        if !self.on(Rule::LogCosh) {
            return None;
        }
        let half = scaled(g, 0.5, a);
        let sinh = g.apply(Prim::Sinh, &[half]);
        let square = g.apply(Prim::PowInt(2), &[sinh]);
        let double = scaled(g, 2.0, square);
        let near = g.apply(Prim::Log1p, &[double]);
        let far = far_logarithm(g, a, 1.0);
        let condition = within(g, a, 1.0);
        let new = choose(g, condition, near, far);
        self.by(Rule::LogCosh, new)
    }

    /// log|sinh a| = |a| + log1p(-exp(-2|a|)) - log 2 for |a| > 1, else as written; without the bars for a > 1.
    fn log_of_sinh(&mut self, g: &mut Graph, sinh: Id, a: Id, of_size: bool) -> Option<Id> {
        if !self.on(Rule::LogCosh) {
            return None;
        }
        let size = if of_size { g.apply(Prim::Abs, &[a]) } else { a };
        let one = g.real(1.0);
        let condition = less(g, one, size);
        let far = far_logarithm(g, a, -1.0);
        let written = g.apply(Prim::Log, &[sinh]);
        let new = choose(g, condition, far, written);
        self.by(Rule::LogCosh, new)
    }

    /// c/(1 + exp a) - c/2 = -c/2 tanh(a/2), and c/(1 + exp a) - c = -c/(1 + exp(-a))
    pub(super) fn logistic(&mut self, g: &mut Graph, n: Id, d: Id, k: f64) -> Option<Id> {
        let c = g.as_real(n)?;
        if !self.on(Rule::Logistic) || c == 0.0 || !c.is_finite() {
            return None;
        }
        let p = self.polynomial(g, d, Expand::Constants)?;
        let exp = p.add(&Polynomial::one(), -1.0)?;
        let [(monomial, factor)] = exp.terms.as_slice() else {
            return None;
        };
        let a = self.argument(g, only_atom(monomial)?, Prim::Exp)?;
        if factor.to_bits() != 1.0_f64.to_bits() || !is_real(g, a) {
            return None;
        }
        let new = if k.to_bits() == (0.5 * c).to_bits() {
            let half = scaled(g, 0.5, a);
            let tanh = g.apply(Prim::Tanh, &[half]);
            scaled(g, -k, tanh)
        } else if k.to_bits() == c.to_bits() {
            let minus = g.neg(a);
            let exp = g.apply(Prim::Exp, &[minus]);
            let one = g.real(1.0);
            let sum = g.add(one, exp);
            let c = g.real(-c);
            g.div(c, sum)
        } else {
            return None;
        };
        self.by(Rule::Logistic, new)
    }

    /// acos(1 + r) = 2 asin √(-r/2) where -1/4 < r ≤ 0
    pub(super) fn acos(&mut self, g: &mut Graph, written: Id, a: Id) -> Option<Id> {
        if !is_real(g, a) || !self.on(Rule::Acos) {
            return None;
        }
        let rest = self.minus_one(g, a)?;
        let half = scaled(g, -0.5, rest);
        let root = g.apply(Prim::Sqrt, &[half]);
        let asin = g.apply(Prim::Asin, &[root]);
        let near = scaled(g, 2.0, asin);
        let (limit, zero) = (g.real(-0.25), g.real(0.0));
        let not_above = g.apply(Prim::LessEqual, &[rest, zero]);
        let conditions = [less(g, limit, rest), not_above];
        let condition = g.apply(Prim::And, &conditions);
        let new = choose(g, condition, near, written);
        self.by(Rule::Acos, new)
    }
}

/// |a| + log1p(sign · exp(-2|a|)) - log 2
fn far_logarithm(g: &mut Graph, a: Id, sign: f64) -> Id {
    let size = g.apply(Prim::Abs, &[a]);
    let minus = scaled(g, -2.0, size);
    let exp = g.apply(Prim::Exp, &[minus]);
    let exp = scaled(g, sign, exp);
    let log = g.apply(Prim::Log1p, &[exp]);
    let half = g.real(LN_2);
    let rest = g.sub(log, half);
    g.add(size, rest)
}
