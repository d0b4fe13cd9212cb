//! Differences of powers with any exponent.

use super::guard::{choose, is_real, less, scaled, within};
use super::pass::Pass;
use super::polynomial::{Expand, Polynomial};
use super::rule::Rule;
use crate::ir::{Graph, Id, Prim};

impl Pass {
    /// a^b - 1 = expm1(b log a) where that is small
    pub(super) fn power_minus_one(
        &mut self,
        g: &mut Graph,
        written: Id,
        base: Id,
        exponent: Id,
    ) -> Option<Id> {
        if !self.on(Rule::PowerMinusOne) {
            return None;
        }
        let log = match self.minus_one(g, base) {
            Some(rest) => g.apply(Prim::Log1p, &[rest]),
            None => g.apply(Prim::Log, &[base]),
        };
        let log = g.mul(exponent, log);
        let small = g.apply(Prim::Expm1, &[log]);
        let condition = within(g, log, 0.5);
        let one = g.real(1.0);
        let written = g.sub(written, one);
        let new = choose(g, condition, small, written);
        self.by(Rule::PowerMinusOne, new)
    }

    /// a^p - b^p = b^p expm1(p log1p((a - b)/b)) where |a - b| < b
    pub(super) fn power_difference(
        &mut self,
        g: &mut Graph,
        u: Id,
        v: Id,
        depth: usize,
    ) -> Option<Id> {
        let ((_, &[a, p]), (_, &[b, q])) = (self.view(g, u), self.view(g, v)) else {
            return None;
        };
        if p != q || !is_real(g, u) || !is_real(g, v) || !self.on(Rule::PowerDifference) {
            return None;
        }
        let delta = self.difference(g, a, b, depth)?;
        let quotient = g.div(delta, b);
        let log = g.apply(Prim::Log1p, &[quotient]);
        let log = g.mul(p, log);
        let small = g.apply(Prim::Expm1, &[log]);
        let product = g.mul(v, small);
        let size = g.apply(Prim::Abs, &[delta]);
        let conditions = [less(g, size, b), within(g, log, 100.0)];
        let condition = g.apply(Prim::And, &conditions);
        let written = g.sub(u, v);
        let new = choose(g, condition, product, written);
        self.by(Rule::PowerDifference, new)
    }

    /// (1 + a)^b = exp(b log1p a) where a is small
    pub(super) fn compound_power(
        &mut self,
        g: &mut Graph,
        written: Id,
        base: Id,
        exponent: Id,
    ) -> Option<Id> {
        if !self.on(Rule::CompoundPower) || !is_real(g, written) || g.as_real(exponent).is_some() {
            return None;
        }
        let rest = self.minus_one(g, base)?;
        let log = g.apply(Prim::Log1p, &[rest]);
        let log = g.mul(exponent, log);
        let power = g.apply(Prim::Exp, &[log]);
        // an infinite b times 0 is no exponent
        let conditions = [within(g, rest, 1.0 / 256.0), within(g, log, 100.0)];
        let condition = g.apply(Prim::And, &conditions);
        let new = choose(g, condition, power, written);
        self.by(Rule::CompoundPower, new)
    }

    /// a - 1, where a is a sum with the term 1 and not all of it is constant.
    pub(super) fn minus_one(&mut self, g: &mut Graph, a: Id) -> Option<Id> {
        let p = self.polynomial(g, a, Expand::Constants)?;
        let has_one = |(m, value): &(super::polynomial::Monomial, f64)| {
            m.is_empty() && value.to_bits() == 1.0_f64.to_bits()
        };
        if p.terms.len() < 2 || !p.terms.iter().any(has_one) {
            return None;
        }
        let rest = p.add(&Polynomial::one(), -1.0)?;
        Some(self.built(g, rest, 4))
    }

    /// (n · log|a|) for a factor n.
    pub(super) fn times_log(g: &mut Graph, n: f64, a: Id) -> Id {
        let size = g.apply(Prim::Abs, &[a]);
        let log = g.apply(Prim::Log, &[size]);
        scaled(g, n, log)
    }
}
