//! Differences of quotients over a common denominator.

use smallvec::SmallVec;

use super::guard::{choose, less, scaled};
use super::pass::Pass;
use super::polynomial::{
    Expand, Monomial, Polynomial, build, build_monomial, build_term, constant,
};
use super::rule::Rule;
use crate::ir::{Graph, Id, Op, Prim};

/// Most divisors of one side.
const MAX_DIVISORS: usize = 4;

/// A numerator over a product of divisors.
struct Quotient {
    numerator: Id,
    divisors: SmallVec<[Id; 4]>,
}

impl Pass {
    /// a/b - k c/d = (a d - k c b)/b/d where the numerator gets simple.
    pub(super) fn by_quotient(
        &mut self,
        g: &mut Graph,
        a: &Monomial,
        k: f64,
        b: &Monomial,
        depth: usize,
    ) -> Option<Id> {
        if !self.on(Rule::Quotients) {
            return None;
        }
        let depth = depth.checked_sub(1)?;
        if !self.may_divide(g, a) && !self.may_divide(g, b) {
            return None;
        }
        let left = self.quotient(g, a, 1.0)?;
        let right = self.quotient(g, b, k)?;
        if left.divisors.is_empty() && right.divisors.is_empty() {
            return None;
        }
        let mut divisors = left.divisors.clone();
        let mut missing_left: SmallVec<[Id; 4]> = SmallVec::new();
        for &d in &right.divisors {
            let have = left.divisors.iter().filter(|&&x| x == d).count();
            let used = right.divisors.iter().filter(|&&x| x == d).count();
            let added = missing_left.iter().filter(|&&x| x == d).count();
            if have + added < used {
                missing_left.push(d);
                divisors.push(d);
            }
        }
        let mut missing_right: SmallVec<[Id; 4]> = divisors.clone();
        for d in &right.divisors {
            if let Some(k) = missing_right.iter().position(|x| x == d) {
                missing_right.remove(k);
            }
        }
        let first = product(g, left.numerator, &missing_left);
        let second = product(g, right.numerator, &missing_right);
        let squares = self.has_used(Rule::Squares);
        let mut numerator = self.simple_difference(g, first, second, depth)?;
        let is_of_squares = !squares && self.has_used(Rule::Squares);
        self.shorten(g, &mut numerator, &mut divisors);
        // the divisors with more terms first: what the numerator is near to
        divisors.sort_by_key(|&d| {
            let terms = self
                .polynomial(g, d, Expand::Constants)
                .map(|p| p.terms.len());
            std::cmp::Reverse(terms.unwrap_or(1))
        });
        let out = divided(g, numerator, &divisors);
        let out = if is_of_squares {
            where_it_cancels(g, a, k, b, out)?
        } else {
            out
        };
        self.by(Rule::Quotients, out)
    }

    /// a - b, where multiplying out makes it short, or another rule does.
    fn simple_difference(&mut self, g: &mut Graph, a: Id, b: Id, depth: usize) -> Option<Id> {
        let (p, q) = (
            self.polynomial(g, a, Expand::All),
            self.polynomial(g, b, Expand::All),
        );
        if let (Some(p), Some(q)) = (p, q) {
            let before = p.terms.len() + q.terms.len();
            let constants = |p: &Polynomial| p.terms.iter().filter(|(m, _)| m.is_empty()).count();
            let had = constants(&p) + constants(&q);
            let rest = p.clone().add(&q, -1.0)?;
            let gone = !rest.lost.is_empty() || (had == 2 && constants(&rest) == 0);
            let lost = gone && an_end_is_lost(&[&p, &q], &rest);
            let small = rest.terms.len() <= 2 && rest.terms.len() < before;
            if lost && small && self.on(Rule::Cancel) && !self.unbounded(g, &rest) {
                self.lose(&rest);
                self.by(Rule::Cancel, ())?;
                let terms = rest.terms.clone();
                return Some(if terms.len() < 2 {
                    build(g, &terms)
                } else {
                    self.built(g, rest_without_marks(rest), depth)
                });
            }
            // only a part of a term has gone: a + b of like size remains, as before
            if rest.cancelled > 0 {
                return None;
            }
        }
        // a common factor of both is taken out: f/√a - f/√b
        self.difference(g, a, b, depth)
    }

    /// Whether the numerator grows with an exponential, which would make ∞/∞ of what is finite.
    fn unbounded(&self, g: &Graph, p: &Polynomial) -> bool {
        p.terms.iter().any(|(monomial, _)| {
            monomial.iter().any(|&(atom, _)| {
                let fast = [
                    Prim::Exp,
                    Prim::Exp2,
                    Prim::Expm1,
                    Prim::Sinh,
                    Prim::Cosh,
                    Prim::Pow,
                    Prim::Gamma,
                ];
                self.view(g, atom).0.is_some_and(|f| fast.contains(&f))
            })
        })
    }

    /// Divides a factor of the numerator by a divisor that is the same.
    fn shorten(&self, g: &mut Graph, numerator: &mut Id, divisors: &mut SmallVec<[Id; 4]>) {
        let Some(p) = self.polynomial(g, *numerator, Expand::Constants) else {
            return;
        };
        let Some((monomial, value)) = p.single() else {
            return;
        };
        let mut monomial = monomial.clone();
        divisors.retain(
            |d| match monomial.iter_mut().find(|(atom, p)| atom == d && *p > 0) {
                Some(slot) => {
                    slot.1 -= 1;
                    false
                }
                None => true,
            },
        );
        monomial.retain(|(_, p)| *p != 0);
        *numerator = build_term(g, &monomial, *value);
    }

    /// Whether [`Self::quotient`] may find a divisor in a monomial; to be known before one is built.
    fn may_divide(&self, g: &Graph, monomial: &Monomial) -> bool {
        monomial.iter().any(|&(atom, power)| {
            let node = g.node(self.plain(atom));
            power < 0
                || match node.op {
                    Op::Apply(Prim::Div) => true,
                    Op::Apply(Prim::PowInt(n)) => n < 0,
                    Op::Apply(Prim::Mul) => node
                        .args
                        .iter()
                        .any(|&a| matches!(self.view(g, a).0, Some(Prim::Div | Prim::Mul))),
                    _ => false,
                }
        })
    }

    /// A constant times a monomial as a quotient.
    fn quotient(&self, g: &mut Graph, monomial: &Monomial, factor: f64) -> Option<Quotient> {
        let mut numerator = g.real(factor);
        let mut divisors: SmallVec<[Id; 4]> = SmallVec::new();
        let mut pending: SmallVec<[(Id, i32); 8]> = monomial.iter().copied().collect();
        while let Some((atom, power)) = pending.pop() {
            if power < 0 {
                for _ in 0..-power {
                    divisors.push(atom);
                }
                continue;
            }
            let plain = self.plain(atom);
            let node = g.node(plain);
            match (node.op, node.args.as_slice()) {
                (Op::Apply(Prim::Div), &[n, d]) if power <= 2 && constant(g, d).is_none() => {
                    pending.extend([(n, power), (d, -power)]);
                }
                (Op::Apply(Prim::PowInt(n @ -4..=-2)), &[d]) if power == 1 => {
                    pending.push((d, n));
                }
                (Op::Apply(Prim::Mul), &[a, b]) if power == 1 && pending.len() < 6 => {
                    let is_quotient = |id| self.view(g, id).0 == Some(Prim::Div);
                    if is_quotient(a) || is_quotient(b) {
                        pending.extend([(a, 1), (b, 1)]);
                    } else {
                        numerator = times(g, numerator, atom, power);
                    }
                }
                _ => numerator = times(g, numerator, atom, power),
            }
            if divisors.len() > MAX_DIVISORS {
                return None;
            }
        }
        (divisors.len() <= MAX_DIVISORS).then_some(Quotient {
            numerator,
            divisors,
        })
    }
}

/// A difference over a common denominator whose numerator is one of squares, where a - k b is of smaller size than a; else a -
/// k b as it is written: with the larger term's rounding alone, where the other has three more.
fn where_it_cancels(g: &mut Graph, a: &Monomial, k: f64, b: &Monomial, new: Id) -> Option<Id> {
    let (first, second) = (build_monomial(g, a)?, build_term(g, b, k));
    let written = g.sub(first, second);
    let [difference, size] = [written, first].map(|x| g.apply(Prim::Abs, &[x]));
    let double = scaled(g, 2.0, difference);
    let condition = less(g, double, size);
    Some(choose(g, condition, new, written))
}

/// Whether the terms of highest or of lowest degree have vanished: only those are what large or small values cancel in.
fn an_end_is_lost(before: &[&Polynomial], after: &Polynomial) -> bool {
    let degrees = |p: &Polynomial| -> Vec<i32> { p.terms.iter().map(|(m, _)| order(m)).collect() };
    let all: Vec<i32> = before.iter().flat_map(|p| degrees(p)).collect();
    let left = degrees(after);
    left.iter().max() < all.iter().max() || left.iter().min() > all.iter().min()
}

/// Sum of the exponents.
fn order(monomial: &Monomial) -> i32 {
    monomial.iter().map(|(_, power)| power).sum()
}

/// The numerator divided by each divisor in turn; of a product one factor is, so that the product itself, which may
/// overflow, is not formed.
fn divided(g: &mut Graph, numerator: Id, divisors: &[Id]) -> Id {
    let node = g.node(numerator);
    if let (Op::Apply(Prim::Mul), &[a, b]) = (node.op, node.args.as_slice()) {
        let quotient = divisors.iter().fold(b, |n, &d| g.div(n, d));
        return g.mul(a, quotient);
    }
    divisors.iter().fold(numerator, |n, &d| g.div(n, d))
}

/// The polynomial as if it had been written so.
fn rest_without_marks(p: Polynomial) -> Polynomial {
    Polynomial {
        terms: p.terms,
        ..Polynomial::default()
    }
}

fn times(g: &mut Graph, a: Id, b: Id, power: i32) -> Id {
    let factor = g.apply(Prim::PowInt(power), &[b]);
    g.mul(a, factor)
}

fn product(g: &mut Graph, a: Id, factors: &[Id]) -> Id {
    factors.iter().fold(a, |out, &d| g.mul(out, d))
}
