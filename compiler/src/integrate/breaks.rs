//! Cutting the interval where conditions change.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::arithmetic::{call, if_less, mul, square, sub};
use super::path::cone;
use super::term::Factor;
use super::{Integrator, Problem, Reason};
use crate::ir::{Id, Loop, Op, Prim, State, Ty};

/// Greatest number of places where the conditions of one integrand may change along a line.
pub const MAX_BREAKS: usize = 32;
/// Greatest number of forms that what a condition compares may take by other conditions in it.
const MAX_FORMS: usize = 16;

/// A place where conditions change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cut {
    /// t there.
    t: Id,
    /// What it is beyond, where the integrand may jump: to the length of a short piece that counts.
    low: Id,
}

/// The most that a cut is beyond its t, as a part of it.
const MOST_LOW: f64 = 1e-6;

/// How a piece is integrated, given the integrand without its conditions.
type OnPiece<'g> = fn(&mut Integrator<'g>, Id) -> Result<Id, Problem>;

impl<'g> Integrator<'g> {
    /// The places where conditions of an expression may change, as values of t; what is not a number or is outside of
    /// the interval is none. There may be more places than changes: cutting there does no harm.
    ///
    /// # Errors
    /// A condition compares something else than polynomials of degree 2 or less and lengths, or there are too many.
    pub(super) fn cuts(&mut self, root: Id) -> Result<Vec<Id>, Problem> {
        let cuts = self.cuts_with_lows(root)?;
        Ok(cuts.into_iter().map(|cut| cut.t).collect())
    }

    pub(super) fn cuts_with_lows(&mut self, root: Id) -> Result<Vec<Cut>, Problem> {
        let mut forms: FxHashMap<Id, Vec<Id>> = FxHashMap::default();
        // each with whether the integrand may jump there
        let mut zeros: Vec<(Id, bool)> = Vec::new();
        for (node, a, b) in self.conditions(root) {
            let left = self.forms(a, &mut forms)?;
            let right = match b {
                Some(b) => self.forms(b, &mut forms)?,
                None => vec![self.g.real(0.0)],
            };
            let jumps = self.g.ty(node) == Ty::Bool
                || matches!(self.g.node(node).op, Op::Apply(Prim::Sign));
            for &a in &left {
                for &b in &right {
                    let zero = self.difference(a, b);
                    match zeros.iter_mut().find(|z| z.0 == zero) {
                        Some(known) => known.1 |= jumps,
                        None => zeros.push((zero, jumps)),
                    }
                    if zeros.len() > MAX_BREAKS {
                        return Err(self.problem(node, Reason::Bound("conditions", MAX_BREAKS)));
                    }
                }
            }
        }
        let mut cuts = Vec::new();
        // t at the zeros, so that they are exact to their distance from t = 0
        let whole = self.path.clone();
        self.path = whole.from_origin(self.g);
        let found = zeros
            .into_iter()
            .try_for_each(|(zero, jumps)| self.zeros(zero, jumps, &mut cuts));
        self.path = whole;
        found?;
        cuts.dedup();
        if cuts.len() > MAX_BREAKS {
            return Err(self.problem(root, Reason::Bound("breakpoints", MAX_BREAKS)));
        }
        Ok(cuts)
    }

    /// What changes its form where a difference of two expressions (or one expression) is 0, in order. Polynomials
    /// have none, whatever they are written with.
    pub(super) fn conditions(&mut self, root: Id) -> Vec<(Id, Id, Option<Id>)> {
        let mut seen = rustc_hash::FxHashSet::default();
        let mut stack = vec![root];
        let mut out = Vec::new();
        while let Some(id) = stack.pop() {
            let is_truth = self.g.ty(id) == Ty::Bool;
            if !seen.insert(id) || !self.moves(id) || !is_truth && self.degree(id).is_some() {
                continue;
            }
            let node = self.g.node(id).clone();
            let Op::Apply(prim) = node.op else { continue };
            match (prim, node.args.as_slice()) {
                (Prim::Abs | Prim::Sign, &[a]) if self.g.ty(a) == Ty::Real => {
                    out.push((id, a, None))
                }
                (
                    Prim::Min
                    | Prim::Max
                    | Prim::Less
                    | Prim::LessEqual
                    | Prim::Equal
                    | Prim::NotEqual,
                    &[a, b],
                ) if self.g.ty(a) == Ty::Real && self.g.ty(b) == Ty::Real => {
                    out.push((id, a, Some(b)))
                }
                _ => {}
            }
            stack.extend(node.args.iter().copied());
        }
        out.sort_unstable();
        out
    }

    /// Every form without conditions that an expression may have.
    fn forms(&mut self, root: Id, known: &mut FxHashMap<Id, Vec<Id>>) -> Result<Vec<Id>, Problem> {
        for id in cone(self.g, &[root]) {
            if known.contains_key(&id) {
                continue;
            }
            let node = self.g.node(id).clone();
            if !self.moves(id) || node.ty != Ty::Real {
                known.insert(id, vec![id]);
                continue;
            }
            let of = |k: usize| {
                known
                    .get(&node.args[k])
                    .cloned()
                    .unwrap_or_else(|| vec![node.args[k]])
            };
            let mut forms = match node.op {
                Op::Apply(Prim::Abs) => {
                    let mut both = of(0);
                    let turned: Vec<Id> = both.iter().map(|&a| self.g.neg(a)).collect();
                    both.extend(turned);
                    both
                }
                Op::Apply(Prim::Sign) => [-1.0, 1.0].map(|v| self.g.real(v)).to_vec(),
                Op::Apply(Prim::Min | Prim::Max) => [of(0), of(1)].concat(),
                Op::Apply(Prim::Select) => [of(1), of(2)].concat(),
                Op::Apply(prim) => {
                    let mut lists: Vec<SmallVec<[Id; 3]>> = vec![SmallVec::new()];
                    for k in 0..node.args.len() {
                        let choices = of(k);
                        lists = lists
                            .iter()
                            .flat_map(|list| {
                                choices.iter().map(move |&c| {
                                    let mut longer = list.clone();
                                    longer.push(c);
                                    longer
                                })
                            })
                            .take(MAX_FORMS + 1)
                            .collect();
                    }
                    lists.iter().map(|list| self.g.apply(prim, list)).collect()
                }
                _ => vec![id],
            };
            forms.sort_unstable();
            forms.dedup();
            if forms.len() > MAX_FORMS {
                return Err(self.problem(
                    id,
                    Reason::Bound("forms of what a condition compares", MAX_FORMS),
                ));
            }
            known.insert(id, forms);
        }
        Ok(known.get(&root).cloned().unwrap_or_else(|| vec![root]))
    }

    /// The zeros of a form.
    fn zeros(&mut self, of: Id, jumps: bool, out: &mut Vec<Cut>) -> Result<(), Problem> {
        let found: SmallVec<[Id; 2]> = match self.degree(of) {
            Some(0) => SmallVec::new(),
            Some(1) => SmallVec::from_slice(&[self.zero_of_affine(of)]),
            Some(2) => SmallVec::from_slice(&self.zeros_of_quadratic(of)),
            _ => match self.without_roots(of) {
                Some(polynomial) if polynomial != of => return self.zeros(polynomial, jumps, out),
                _ => return Err(self.problem(of, Reason::Condition)),
            },
        };
        for t in found {
            let low = if jumps {
                self.beyond_zero(of, t)
            } else {
                self.g.real(0.0)
            };
            out.push(Cut { t, low });
        }
        Ok(())
    }

    /// One step of Newton's method from a zero that was rounded, with what is rounded there known.
    fn beyond_zero(&mut self, of: Id, t: Id) -> Id {
        let value = self.pair_at(of, t).total(self.g);
        let slope = self.slope(of);
        let slope = self.at_place(&[slope], t)[0];
        let step = super::arithmetic::div(self.g, value, slope);
        if super::arithmetic::is_zero(self.g, step) {
            return step;
        }
        let step = self.g.neg(step);
        let sizes = [step, t].map(|v| call(self.g, Prim::Abs, v));
        let most = super::arithmetic::scale(self.g, MOST_LOW, sizes[1]);
        let zero = self.g.real(0.0);
        if_less(self.g, sizes[0], most, step, zero)
    }

    /// For u + k √q with u of degree 0 or 1: the polynomial k² q - u². For k √q - m √r: k² q - m² r. They are 0
    /// wherever the expression is.
    fn without_roots(&mut self, of: Id) -> Option<Id> {
        let terms = self.expand(of).ok()?;
        let mut roots = Vec::new();
        let mut rest = self.g.real(0.0);
        for term in &terms {
            if !term.guards.is_empty() {
                return None;
            }
            match term.factors.as_slice() {
                &[Factor::Power(base, half)] if self.g.as_real(half) == Some(0.5) => {
                    let weight = square(self.g, term.coefficient);
                    roots.push(mul(self.g, weight, base));
                }
                [] | [Factor::Polynomial(_)] => {
                    let part = term.integrand(self.g);
                    rest = super::arithmetic::add(self.g, rest, part);
                }
                _ => return None,
            }
        }
        let other = match *roots.as_slice() {
            [_] => square(self.g, rest),
            [_, other] if super::arithmetic::is_zero(self.g, rest) => other,
            _ => return None,
        };
        let polynomial = sub(self.g, roots[0], other);
        self.degree(polynomial)
            .is_some_and(|d| d <= 2)
            .then_some(polynomial)
    }

    /// -u/u': where u hardly changes that is no number, or far outside of the interval, and so no cut.
    fn zero_of_affine(&mut self, of: Id) -> Id {
        let u = self.affine(of);
        let ratio = self.g.div(u.mid, u.slope);
        self.g.neg(ratio)
    }

    /// The zeros of a s² + 2 b s + c: with r = -(b ± √(b² - a c)), the sign that of b, they are r/a and c/r.
    ///
    /// Press et al., Numerical Recipes, 3rd edition, section 5.6.
    fn zeros_of_quadratic(&mut self, of: Id) -> [Id; 2] {
        let q = self.quadratic(of);
        let zero = self.g.real(0.0);
        let inside = self.g.neg(q.discriminant);
        let root = call(self.g, Prim::Sqrt, inside);
        let back = self.g.neg(root);
        let root = if_less(self.g, q.b, zero, back, root);
        let sum = self.g.add(q.b, root);
        let r = self.g.neg(sum);
        [self.g.div(r, q.a), self.g.div(q.c, r)]
    }

    /// The integral as the sum over the pieces between the cuts, by a loop that goes from one cut to the next; with one
    /// cut, both pieces side by side.
    pub(super) fn piecewise(
        &mut self,
        root: Id,
        cuts: &[Cut],
        on_piece: OnPiece<'g>,
    ) -> Result<Id, Problem> {
        let whole = self.path.clone();
        let start = self.g.apply(Prim::Min, &whole.ends);
        let reach = self.g.apply(Prim::Max, &whole.ends);
        let low = self.g.real(0.0);
        let [start, reach] = [start, reach].map(|t| Cut { t, low });
        let total = if let &[cut] = cuts {
            let place = self.next_cut(start, &[cut], reach);
            let left = self.piece(root, start, place, on_piece)?;
            let known = (self.parts.len(), self.numerical.len(), self.rest.len());
            self.path.clone_from(&whole);
            let right = self.piece(root, place, reach, on_piece)?;
            self.parts.truncate(known.0);
            self.numerical.truncate(known.1);
            self.rest.truncate(known.2);
            self.g.add(left, right)
        } else {
            self.walk(root, cuts, (start, reach), on_piece)?
        };
        self.path = whole;
        let sign = call(self.g, Prim::Sign, self.path.half);
        Ok(self.g.mul(sign, total))
    }

    fn walk(
        &mut self,
        root: Id,
        cuts: &[Cut],
        (start, reach): (Cut, Cut),
        on_piece: OnPiece<'g>,
    ) -> Result<Id, Problem> {
        let binder = self.g.binder();
        let zero = self.g.real(0.0);
        let mut leaf = || self.g.new_state(binder, Ty::Real);
        let has_lows = cuts.iter().any(|cut| cut.low != zero);
        let (t, sum) = (leaf(), leaf());
        let low = if has_lows { leaf() } else { zero };
        let place = Cut { t, low };
        let next = self.next_cut(place, cuts, reach);
        let piece = self.piece(root, place, next, on_piece)?;
        let longer = self.g.add(sum, piece);
        let pieces = u32::try_from(cuts.len() + 1).unwrap_or(u32::MAX);
        let mut states = vec![(t, start.t, next.t), (sum, zero, longer)];
        if has_lows {
            states.push((low, zero, next.low));
        }
        let repeated = Loop {
            binder,
            count: self.g.real(f64::from(pieces)),
            limit: pieces,
            until: Some(self.g.apply(Prim::LessEqual, &[reach.t, t])),
            states: states
                .into_iter()
                .map(|(leaf, init, next)| State { leaf, init, next })
                .collect(),
        };
        let repeated = self.g.repeat(&repeated);
        Ok(self.g.result(repeated, sum))
    }

    /// The first cut beyond a place, or the end.
    fn next_cut(&mut self, place: Cut, cuts: &[Cut], end: Cut) -> Cut {
        let mut next = end;
        for &cut in cuts {
            let beyond = if_less(self.g, place.t, cut.t, cut.t, end.t);
            if cut.low != next.low {
                next.low = if_less(self.g, beyond, next.t, cut.low, next.low);
            }
            next.t = self.g.apply(Prim::Min, &[next.t, beyond]);
        }
        next
    }

    /// The integral between two cuts, where conditions do not change.
    fn piece(&mut self, root: Id, a: Cut, b: Cut, on_piece: OnPiece<'g>) -> Result<Id, Problem> {
        let whole = self.path.clone();
        self.path = whole.between_cuts(self.g, [a.t, b.t], [a.low, b.low]);
        let decided = self.decided(root);
        let value = on_piece(self, decided);
        self.path = whole;
        value
    }

    /// f(if c then a else b) as if c then f(a) else f(b) for what is no sum or product.
    fn distributed(&mut self, prim: Prim, args: &[Id]) -> Id {
        let of_choice = |this: &Self, id: Id| {
            let node = this.g.node(id);
            (node.op == Op::Apply(Prim::Select)).then(|| node.args.clone())
        };
        let place = match prim {
            Prim::Neg | Prim::Add | Prim::Sub | Prim::Mul | Prim::Select => {
                return self.g.apply(prim, args);
            }
            Prim::PowInt(n) if n > 0 => return self.g.apply(prim, args),
            Prim::Div => 1,
            _ => 0,
        };
        let choice = args.get(place).and_then(|&a| of_choice(self, a));
        let Some(choice) = choice.filter(|c| !self.moves(c[0])) else {
            return self.g.apply(prim, args);
        };
        let sides = [choice[1], choice[2]].map(|side| {
            let mut args: SmallVec<[Id; 3]> = SmallVec::from_slice(args);
            args[place] = side;
            let is_choice = of_choice(self, side).is_some_and(|c| of_choice(self, c[1]).is_none());
            if is_choice {
                self.distributed(prim, &args)
            } else {
                self.g.apply(prim, &args)
            }
        });
        self.g.apply(Prim::Select, &[choice[0], sides[0], sides[1]])
    }

    /// A condition or a sign in the middle of the path.
    fn decide(&mut self, id: Id) -> Id {
        if self.beyond
            && let Some(decided) = self.at_infinity(id)
        {
            return decided;
        }
        let decided = self.at_middle(id);
        self.written.insert(decided, id);
        decided
    }

    /// The first where a < b in the middle of the path, else the second.
    fn decided_choice(&mut self, (a, b): (Id, Id), then: Id, otherwise: Id) -> Id {
        let condition = self.g.apply(Prim::Less, &[a, b]);
        let decided = self.decide(condition);
        self.g.apply(Prim::Select, &[decided, then, otherwise])
    }

    /// The expression with every condition decided in the middle of the path.
    pub(super) fn decided(&mut self, root: Id) -> Id {
        let mut map: FxHashMap<Id, Id> = FxHashMap::default();
        for id in cone(self.g, &[root]) {
            let node = self.g.node(id).clone();
            let Op::Apply(prim) = node.op else { continue };
            if !self.moves(id) || node.ty != Ty::Bool && self.degree(id).is_some() {
                continue;
            }
            let args: SmallVec<[Id; 3]> = node
                .args
                .iter()
                .map(|a| map.get(a).copied().unwrap_or(*a))
                .collect();
            let is_real = node.args.iter().all(|&a| self.g.ty(a) == Ty::Real);
            let new = match prim {
                Prim::Sign | Prim::Less | Prim::LessEqual | Prim::Equal | Prim::NotEqual
                    if is_real =>
                {
                    self.decide(id)
                }
                Prim::Abs if is_real => {
                    let zero = self.g.real(0.0);
                    let turned = self.g.neg(args[0]);
                    self.decided_choice((node.args[0], zero), turned, args[0])
                }
                Prim::Min | Prim::Max if is_real => {
                    let (a, b) = (node.args[0], node.args[1]);
                    let (low, high) = if prim == Prim::Min { (a, b) } else { (b, a) };
                    self.decided_choice((low, high), args[0], args[1])
                }
                _ => self.distributed(prim, &args),
            };
            map.insert(id, new);
        }
        map.get(&root).copied().unwrap_or(root)
    }
}
