//! Integrals of sums over a counter: the sum of the integrals of the terms.

use super::arithmetic::mul;
use super::path::{Body, cone};
use super::rule::Rule;
use super::{Integrator, Otherwise, Problem, Reason};
use crate::ir::{Id, Loop, Op, Prim, State, Ty};

/// Greatest number of terms that are written out where the term alone has no closed form.
const MAX_UNROLLED: f64 = 16.0;

impl Integrator<'_> {
    /// ∫ Σ fₖ = Σ ∫ fₖ for the result of a loop that adds up terms, whose number is constant along the path.
    pub(super) fn series(&mut self, result: Id) -> Result<(Id, Rule), Problem> {
        let Some((it, state, term)) = self.sum_of_terms(result) else {
            return Err(self.problem(result, Reason::Loop));
        };
        let known = (self.parts.len(), self.numerical.len(), self.rest.len());
        let otherwise = std::mem::replace(&mut self.otherwise, Otherwise::Refuse);
        let closed = self.whole(term);
        self.otherwise = otherwise;
        let integral = match closed {
            Ok(integral) => integral,
            Err(_) => {
                self.parts.truncate(known.0);
                self.numerical.truncate(known.1);
                self.rest.truncate(known.2);
                if let Some(sum) = self.unrolled(&it, state, term) {
                    return Ok((self.whole(sum)?, Rule::Series));
                }
                self.whole(term)?
            }
        };
        let length = self.length_of_path();
        let init = mul(self.g, length, state.init);
        let leaf = self.g.new_state(it.binder, Ty::Real);
        let next = self.g.add(leaf, integral);
        let repeated = Loop {
            states: std::iter::once(State { leaf, init, next }).collect(),
            ..it
        };
        let repeated = self.g.repeat(&repeated);
        Ok((self.g.result(repeated, leaf), Rule::Series))
    }

    /// A sum of a few terms written out.
    fn unrolled(&mut self, it: &Loop, state: State, term: Id) -> Option<Id> {
        let count = self
            .g
            .as_real(it.count)
            .filter(|&n| (0.0..=MAX_UNROLLED).contains(&n))?;
        let counter = self.g.counter(it.binder);
        let body = Body::new(self.g, &[term], std::iter::once(counter));
        let mut sum = state.init;
        let mut k = 0.0;
        while k < count.floor() {
            let value = self.g.real(k);
            let term = body.at(self.g, &[(counter, value)])[0];
            sum = self.g.add(sum, term);
            k += 1.0;
        }
        Some(sum)
    }

    /// The loop, the state that is added up, and what is added.
    pub(super) fn sum_of_terms(&mut self, result: Id) -> Option<(Loop, State, Id)> {
        let node = self.g.node(result).clone();
        let it = self.g.as_loop(*node.args.first()?)?;
        let leaf = self.g.leaf_of_result(result)?;
        let state = *it.states.iter().find(|state| state.leaf == leaf)?;
        if it.until.is_some()
            || self.moves(it.count)
            || self.moves(state.init)
            || node.ty != Ty::Real
        {
            return None;
        }
        let next = self.g.node(state.next).clone();
        let term = match (next.op, next.args.as_slice()) {
            (Op::Apply(Prim::Add), &[a, b]) if a == leaf => b,
            (Op::Apply(Prim::Add), &[a, b]) if b == leaf => a,
            (Op::Apply(Prim::Sub), &[a, b]) if a == leaf => self.g.neg(b),
            _ => return None,
        };
        let is_state =
            |id: &Id| matches!(self.g.node(*id).op, Op::State(binder, _) if binder == it.binder);
        let depends = cone(self.g, &[term]).iter().any(is_state);
        (!depends).then_some((it, state, term))
    }
}
