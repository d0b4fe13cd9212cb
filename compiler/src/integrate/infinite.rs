//! Integrals to infinity: ∫ from a place to ∞ of what falls fast enough, in closed form.
//!
//! The half-line is seen from its beginning: the path is empty there, so that "in the middle" is at the beginning. An
//! interval whose lower end is -∞ is mirrored, one with two infinite ends is cut at 0. What has conditions goes by
//! pieces to the last place where one changes, and on from there.

use super::arithmetic::{add, if_less, is_zero, mul};
use super::path::without_rests;
use super::rule::Rule;
use super::term::{Factor, Term};
use super::{Integral, Integrator, Otherwise, Path, Problem, Reason};
use crate::ir::{Graph, Id, Loop, Op, Prim, State};

/// ∫ of a real expression by a variable between ends of which one at least is the constant ∞ or -∞.
///
/// Where a symbol decides whether the integral converges, its value is NaN for symbols for which it diverges.
///
/// # Errors
/// The integral diverges, a part has no closed form, or a bound is exceeded.
pub fn improper(g: &mut Graph, root: Id, leaf: Id, [a, b]: [Id; 2]) -> Result<Integral, Problem> {
    let root = without_rests(g, root);
    let (lower, upper) = (infinity(g, a), infinity(g, b));
    let zero = g.real(0.0);
    // each half-line by where it begins, the side to which it goes, and its sign
    let mut halves: Vec<(Id, f64, f64)> = Vec::new();
    if lower != upper {
        if let Some(side) = upper {
            halves.push((if lower.is_some() { zero } else { a }, side, side));
        }
        if let Some(side) = lower {
            halves.push((if upper.is_some() { zero } else { b }, side, -side));
        }
    }
    let path = Path::of_variable(g, leaf, zero, zero);
    let mut integrator = Integrator::new(g, path, Otherwise::Refuse);
    let mut value = zero;
    for (begin, side, sign) in halves {
        let half = integrator.half_line(root, (leaf, begin, side))?;
        let signed = super::arithmetic::scale(integrator.g, sign, half);
        value = add(integrator.g, value, signed);
    }
    Ok(Integral {
        value,
        parts: integrator.parts,
        pieces: integrator.pieces,
        numerical: integrator.numerical,
        rest: integrator.rest,
    })
}

/// 1 for ∞, -1 for -∞.
fn infinity(g: &Graph, id: Id) -> Option<f64> {
    g.as_real(id).filter(|v| v.is_infinite()).map(f64::signum)
}

impl Integrator<'_> {
    /// The integral over a half-line of the variable, from where it begins to the side's infinity, by its length.
    fn half_line(&mut self, root: Id, (leaf, begin, side): (Id, Id, f64)) -> Result<Id, Problem> {
        let (zero, rate) = (self.g.real(0.0), self.g.real(side));
        let begin = super::arithmetic::scale(self.g, side, begin);
        self.path = Path::of_lines(self.g, &[(leaf, zero, rate)], [begin, begin]);
        self.onwards(root)
    }

    /// The integral from the place where the empty path is to infinity.
    fn onwards(&mut self, root: Id) -> Result<Id, Problem> {
        let cuts = self.cuts(root)?;
        if cuts.is_empty() {
            return self.tail(root);
        }
        self.pieces = true;
        let here = self.path.clone();
        let begin = here.middle;
        let last = self.last(begin, &cuts);
        let near = here.between(self.g, [begin, last]);
        let mut sum = self.g.real(0.0);
        if !is_zero(self.g, near.half) {
            self.path = near;
            sum = match self.ridge(root) {
                Some(value) => value,
                None => {
                    let cuts = self.cuts_with_lows(root)?;
                    self.piecewise(root, &cuts, Self::smooth)?
                }
            };
        }
        // beyond the last cut every condition is what it is one further
        let (one, zero) = (self.g.real(1.0), self.g.real(0.0));
        let back = self.g.neg(last);
        let size = if_less(self.g, last, zero, back, last);
        let step = self.g.add(one, size);
        let beyond = self.g.add(last, step);
        self.path = here.between(self.g, [beyond, beyond]);
        self.beyond = true;
        let decided = self.decided(root);
        self.beyond = false;
        self.path = here.between(self.g, [last, last]);
        let far = self.tail(decided)?;
        self.path = here;
        Ok(add(self.g, sum, far))
    }

    /// The last of the cuts beyond a place, or the place.
    fn last(&mut self, begin: Id, cuts: &[Id]) -> Id {
        let infinity = self.g.real(f64::INFINITY);
        let mut last = begin;
        for &cut in cuts {
            let finite = if_less(self.g, cut, infinity, cut, last);
            last = if_less(self.g, last, cut, finite, last);
        }
        last
    }

    /// A condition or a sign at infinity, where it is that of a polynomial whose leading coefficient is a known number.
    pub(super) fn at_infinity(&mut self, condition: Id) -> Option<Id> {
        let node = self.g.node(condition).clone();
        let Op::Apply(prim) = node.op else {
            return None;
        };
        let of = match *node.args.as_slice() {
            [a] => a,
            [a, b] => self.difference(a, b),
            _ => return None,
        };
        let mut lead = of;
        for _ in 0..self.degree(of).filter(|d| (1..=2).contains(d))? {
            lead = self.slope(lead);
        }
        let lead = self.at_middle(lead);
        let sign = self
            .g
            .as_real(lead)
            .filter(|v| *v != 0.0 && v.is_finite())?;
        Some(match prim {
            Prim::Less | Prim::LessEqual => self.g.truth(sign < 0.0),
            Prim::Equal => self.g.truth(false),
            Prim::NotEqual => self.g.truth(true),
            Prim::Sign => self.g.real(sign.signum()),
            _ => return None,
        })
    }

    /// The integral to infinity of an integrand whose conditions are decided.
    fn tail(&mut self, root: Id) -> Result<Id, Problem> {
        let mut sum = self.g.real(0.0);
        let terms = self.expand(root)?;
        let mut open: Vec<Problem> = Vec::new();
        for term in &terms {
            match self.tail_of_term(term) {
                Ok((value, rule)) => {
                    let integrand = term.integrand(self.g);
                    self.note(integrand, &term.guards, rule);
                    let value = mul(self.g, term.coefficient, value);
                    let value = self.guarded(term, value);
                    sum = add(self.g, sum, value);
                }
                Err(problem) if problem.reason.diverges() => open.push(problem),
                Err(problem) => return Err(problem),
            }
            if self.g.nodes().len() > self.limit {
                let reason = Reason::Bound("operations", super::MAX_NODES);
                return Err(self.problem(term.source, reason));
            }
        }
        match open.pop() {
            None => Ok(sum),
            Some(problem) if open.is_empty() => Err(problem),
            // each diverges; their sum may not
            Some(_) => Err(self.problem(root, Reason::Together)),
        }
    }

    /// The integral to infinity of the factors of a product.
    fn tail_of_term(&mut self, term: &Term) -> Result<(Id, Rule), Problem> {
        let is_polynomial = |f: &Factor| matches!(f, Factor::Polynomial(_));
        if term.factors.iter().all(is_polynomial) {
            return Err(self.diverges(term, "a polynomial does not fall"));
        }
        if let Some(problem) = self.without_rule(term) {
            return Err(problem);
        }
        if let [Factor::Series(id)] = *term.factors.as_slice() {
            return self.series_to_infinity(id);
        }
        self.classes.extend(self.g);
        self.tail_by_class(term)
    }

    /// ∫ Σ fₖ = Σ ∫ fₖ
    fn series_to_infinity(&mut self, result: Id) -> Result<(Id, Rule), Problem> {
        let Some((it, state, term)) = self.sum_of_terms(result) else {
            return Err(self.problem(result, Reason::Loop));
        };
        if !is_zero(self.g, state.init) {
            return Err(self.problem(result, Reason::Diverges("a constant does not fall")));
        }
        let here = self.path.clone();
        let integral = self.onwards(term);
        self.path = here;
        let integral = integral?;
        let leaf = self.g.new_state(it.binder, crate::ir::Ty::Real);
        let next = self.g.add(leaf, integral);
        let init = state.init;
        let repeated = Loop {
            states: std::iter::once(State { leaf, init, next }).collect(),
            ..it
        };
        let repeated = self.g.repeat(&repeated);
        Ok((self.g.result(repeated, leaf), Rule::Series))
    }

    pub(super) fn diverges(&self, term: &Term, why: &'static str) -> Problem {
        self.problem(term.source, Reason::Diverges(why))
    }

    /// A value where a number is below 0, else NaN; an error where it is known not to be.
    pub(super) fn where_negative(
        &mut self,
        of: Id,
        value: Id,
        problem: Problem,
    ) -> Result<Id, Problem> {
        match self.g.as_real(of) {
            Some(v) if v < 0.0 => Ok(value),
            Some(_) => Err(problem),
            None => {
                let (zero, nan) = (self.g.real(0.0), self.g.real(f64::NAN));
                let condition = self.g.apply(Prim::Less, &[of, zero]);
                Ok(self.g.apply(Prim::Select, &[condition, value, nan]))
            }
        }
    }
}
