//! How large a real number can become: a small interval analysis, for the numbers of steps of loops.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use crate::ir::{Binder, Graph, Id, Op, Prim, Ty};

/// Deepest operand that is looked at.
const MAX_DEPTH: usize = 64;
/// Most nodes that are looked at for one number.
const MAX_VISITS: usize = 4096;
/// Most different terms of a sum that are told apart.
const MAX_TERMS: usize = 8;

/// What is known of leaves.
#[derive(Clone, Debug, Default)]
pub struct Bounds {
    /// The stated range of each parameter that has one.
    pub params: Vec<Option<(f64, f64)>>,
    /// The greatest number of steps of each loop whose body is being built.
    pub limits: FxHashMap<Binder, u32>,
    /// What each leaf stands for that something is differentiated by.
    pub variables: FxHashMap<Id, Id>,
}

/// The values that a real number can take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// No lesser value.
    pub lo: f64,
    /// No greater value.
    pub hi: f64,
    /// Whether it can be NaN.
    pub nan: bool,
}

const ANY: Interval = Interval {
    lo: f64::NEG_INFINITY,
    hi: f64::INFINITY,
    nan: true,
};

impl Interval {
    fn new(lo: f64, hi: f64) -> Self {
        if lo.is_nan() || hi.is_nan() {
            ANY
        } else {
            Self { lo, hi, nan: false }
        }
    }

    fn or_nan(self, nan: bool) -> Self {
        Self {
            nan: self.nan || nan,
            ..self
        }
    }

    fn is_finite(self) -> bool {
        self.lo.is_finite() && self.hi.is_finite() && !self.nan
    }

    /// The image under a function that does not decrease.
    fn rising(self, f: impl Fn(f64) -> f64) -> Self {
        Self::new(f(self.lo), f(self.hi)).or_nan(self.nan)
    }

    fn joined(self, other: Self) -> Self {
        Self::new(self.lo.min(other.lo), self.hi.max(other.hi)).or_nan(self.nan || other.nan)
    }

    fn plus(self, other: Self) -> Self {
        let opposite = |a: f64, b: f64| a.is_infinite() && b.is_infinite();
        let nan =
            self.nan || other.nan || opposite(self.lo, other.hi) || opposite(self.hi, other.lo);
        let (lo, hi) = (self.lo + other.lo, self.hi + other.hi);
        let lo = if lo.is_nan() { f64::NEG_INFINITY } else { lo };
        let hi = if hi.is_nan() { f64::INFINITY } else { hi };
        Self { lo, hi, nan }
    }

    fn scaled(self, factor: f64) -> Self {
        self.times(Self::new(factor, factor))
    }

    fn times(self, other: Self) -> Self {
        // 0 times an unbounded end is an unbounded end's product with something near to 0: 0
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let corners = [
            product(self.lo, other.lo),
            product(self.lo, other.hi),
            product(self.hi, other.lo),
            product(self.hi, other.hi),
        ];
        let lo = corners.iter().copied().fold(f64::INFINITY, f64::min);
        let hi = corners.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self::new(lo, hi).or_nan(!self.is_finite() || !other.is_finite())
    }

    fn over(self, other: Self) -> Self {
        if other.lo > 0.0 || other.hi < 0.0 {
            let inverse = Self::new(1.0 / other.hi, 1.0 / other.lo).or_nan(other.nan);
            return self.times(inverse);
        }
        ANY
    }

    fn size(self) -> Self {
        let greatest = self.hi.max(-self.lo);
        let least = if self.lo <= 0.0 && self.hi >= 0.0 {
            0.0
        } else {
            self.lo.abs().min(self.hi.abs())
        };
        Self::new(least, greatest).or_nan(self.nan)
    }
}

impl Bounds {
    /// The values that a node can take; where `trusting`, while every parameter is in its stated range.
    pub fn of(&self, graph: &Graph, id: Id, trusting: bool) -> Interval {
        self.query(graph, trusting).of(id, 0)
    }

    /// `a - b` where it is the same number whatever the leaves are, as in (x + 3) - x.
    pub fn difference(&self, graph: &Graph, a: Id, b: Id) -> Option<f64> {
        let mut sum = Sum::default();
        let mut query = self.query(graph, false);
        query.collect(&mut sum, a, 1.0, 0)?;
        query.collect(&mut sum, b, -1.0, 0)?;
        sum.terms
            .iter()
            .all(|term| term.1 == 0.0)
            .then_some(sum.constant)
    }

    fn query<'q>(&'q self, graph: &'q Graph, trusting: bool) -> Query<'q> {
        Query {
            bounds: self,
            graph,
            trusting,
            visits: MAX_VISITS,
        }
    }
}

/// Multiples of nodes, and a constant.
#[derive(Default)]
struct Sum {
    terms: SmallVec<[(Id, f64); MAX_TERMS]>,
    constant: f64,
}

struct Query<'q> {
    bounds: &'q Bounds,
    graph: &'q Graph,
    trusting: bool,
    visits: usize,
}

impl Query<'_> {
    fn of(&mut self, id: Id, depth: usize) -> Interval {
        if self.visits == 0 || depth > MAX_DEPTH || self.graph.ty(id) != Ty::Real {
            return ANY;
        }
        self.visits -= 1;
        let node = self.graph.node(id);
        match node.op {
            Op::Const(bits) => {
                let value = f64::from_bits(bits);
                Interval::new(value, value)
            }
            Op::Param(k) if self.trusting => {
                let range = self.bounds.params.get(usize::from(k)).copied().flatten();
                range.map_or(ANY, |(lo, hi)| Interval::new(lo, hi))
            }
            Op::Counter(binder) => match self.bounds.limits.get(&binder) {
                Some(&limit) => Interval::new(0.0, (f64::from(limit) - 1.0).max(0.0)),
                None => ANY,
            },
            Op::Variable(_) => match self.bounds.variables.get(&id) {
                Some(&value) => self.of(value, depth + 1),
                None => ANY,
            },
            Op::Apply(prim) => self.apply(prim, id, &node.args, depth + 1),
            _ => ANY,
        }
    }

    fn apply(&mut self, prim: Prim, id: Id, args: &[Id], depth: usize) -> Interval {
        match (prim, args) {
            (Prim::Add | Prim::Sub | Prim::Neg, _) => self.sum(id, depth),
            (Prim::Mul, &[a, b]) => {
                let (a, b) = (self.of(a, depth), self.of(b, depth));
                a.times(b)
            }
            (Prim::Div, &[a, b]) => {
                let (a, b) = (self.of(a, depth), self.of(b, depth));
                a.over(b)
            }
            // the other operand where one is NaN
            (Prim::Min, &[a, b]) => {
                let (a, b) = (self.of(a, depth), self.of(b, depth));
                let hi = match (a.nan, b.nan) {
                    (false, false) => a.hi.min(b.hi),
                    (true, false) => b.hi,
                    (false, true) => a.hi,
                    (true, true) => a.hi.max(b.hi),
                };
                Interval::new(a.lo.min(b.lo), hi).or_nan(a.nan && b.nan)
            }
            (Prim::Max, &[a, b]) => {
                let (a, b) = (self.of(a, depth), self.of(b, depth));
                let lo = match (a.nan, b.nan) {
                    (false, false) => a.lo.max(b.lo),
                    (true, false) => b.lo,
                    (false, true) => a.lo,
                    (true, true) => a.lo.min(b.lo),
                };
                Interval::new(lo, a.hi.max(b.hi)).or_nan(a.nan && b.nan)
            }
            (Prim::Floor, &[a]) => self.of(a, depth).rising(f64::floor),
            (Prim::Ceil, &[a]) => self.of(a, depth).rising(f64::ceil),
            (Prim::Round, &[a]) => self.of(a, depth).rising(crate::reference::real::round),
            (Prim::Trunc, &[a]) => self.of(a, depth).rising(f64::trunc),
            (Prim::Abs, &[a]) if self.graph.ty(a) == Ty::Real => self.of(a, depth).size(),
            (Prim::PowInt(n), &[a]) if n > 0 && n % 2 == 0 && self.graph.ty(a) == Ty::Real => {
                self.of(a, depth).size().rising(|x| x.powi(n))
            }
            (Prim::Exp, &[a]) if self.graph.ty(a) == Ty::Real => self.of(a, depth).rising(f64::exp),
            (Prim::Hypot | Prim::Hypot3, _) => {
                let nan = args.iter().any(|&a| self.of(a, depth).nan);
                Interval::new(0.0, f64::INFINITY).or_nan(nan)
            }
            (Prim::Sqrt, &[a]) => {
                let a = self.of(a, depth);
                a.rising(|x| x.max(0.0).sqrt()).or_nan(a.lo < 0.0)
            }
            (Prim::Fract, &[a]) => Interval::new(0.0, 1.0).or_nan(!self.of(a, depth).is_finite()),
            (Prim::Sin | Prim::Cos, &[a]) => {
                Interval::new(-1.0, 1.0).or_nan(!self.of(a, depth).is_finite())
            }
            (Prim::Sign, &[a]) => Interval::new(-1.0, 1.0).or_nan(self.of(a, depth).nan),
            (Prim::Select, &[_, a, b]) => {
                let (a, b) = (self.of(a, depth), self.of(b, depth));
                a.joined(b)
            }
            _ => ANY,
        }
    }

    /// Sums are taken together, so that k - k / 2 is k / 2.
    fn sum(&mut self, id: Id, depth: usize) -> Interval {
        let mut sum = Sum::default();
        if self.collect(&mut sum, id, 1.0, depth).is_none() {
            return ANY;
        }
        let mut total = Interval::new(sum.constant, sum.constant);
        for (term, factor) in sum.terms {
            let term = self.of(term, depth + 1);
            total = if factor == 0.0 {
                total.or_nan(!term.is_finite())
            } else {
                total.plus(term.scaled(factor))
            };
        }
        total
    }

    /// Adds a multiple of a node to a sum; `None` where that has too many terms.
    fn collect(&mut self, sum: &mut Sum, id: Id, factor: f64, depth: usize) -> Option<()> {
        if self.visits == 0 || depth > MAX_DEPTH {
            return None;
        }
        self.visits -= 1;
        if let Some(value) = self.graph.as_real(id) {
            sum.constant += factor * value;
            return Some(());
        }
        let node = self.graph.node(id);
        match (node.op, node.args.as_slice()) {
            (Op::Apply(Prim::Add), &[a, b]) => {
                self.collect(sum, a, factor, depth + 1)?;
                return self.collect(sum, b, factor, depth + 1);
            }
            (Op::Apply(Prim::Sub), &[a, b]) => {
                self.collect(sum, a, factor, depth + 1)?;
                return self.collect(sum, b, -factor, depth + 1);
            }
            (Op::Apply(Prim::Neg), &[a]) => return self.collect(sum, a, -factor, depth + 1),
            (Op::Apply(Prim::Mul), &[a, b]) => {
                for (a, b) in [(a, b), (b, a)] {
                    if let Some(value) = self.graph.as_real(a) {
                        return self.collect(sum, b, factor * value, depth + 1);
                    }
                }
            }
            (Op::Apply(Prim::Div), &[a, b]) => {
                if let Some(value) = self.graph.as_real(b) {
                    return self.collect(sum, a, factor / value, depth + 1);
                }
            }
            _ => {}
        }
        match sum.terms.iter_mut().find(|term| term.0 == id) {
            Some(term) => term.1 += factor,
            None => sum.terms.push((id, factor)),
        }
        (sum.terms.len() <= MAX_TERMS).then_some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn leaf(graph: &mut Graph, k: u16) -> Id {
        graph.leaf(Op::Param(k), Ty::Real)
    }

    fn interval(lo: f64, hi: f64, nan: bool) -> Interval {
        Interval { lo, hi, nan }
    }

    #[test]
    fn ranges_of_parameters_bound_what_is_made_of_them() {
        let mut g = Graph::new();
        let bounds = Bounds {
            params: vec![Some((-2.0, 3.0)), None],
            ..Bounds::default()
        };
        let (n, open) = (leaf(&mut g, 0), leaf(&mut g, 1));
        let two = g.real(2.0);
        let doubled = g.mul(n, two);
        let half = g.div(doubled, two);
        let same = g.sub(doubled, n);
        let size = g.apply(Prim::Abs, &[n]);
        let capped = g.apply(Prim::Min, &[open, two]);
        for (id, want) in [
            (doubled, interval(-4.0, 6.0, false)),
            (half, interval(-2.0, 3.0, false)),
            (same, interval(-2.0, 3.0, false)),
            (size, interval(0.0, 3.0, false)),
            (open, ANY),
            (capped, interval(f64::NEG_INFINITY, 2.0, false)),
        ] {
            assert_eq!(bounds.of(&g, id, true), want);
        }
        // a parameter can be set outside of its range
        assert_eq!(bounds.of(&g, n, false), ANY);
        assert_eq!(bounds.of(&g, capped, false).hi, 2.0);
    }

    #[test]
    fn differences_that_are_always_the_same_are_found() {
        let mut g = Graph::new();
        let bounds = Bounds::default();
        let (x, y) = (leaf(&mut g, 0), leaf(&mut g, 1));
        let five = g.real(5.0);
        let (sum, shifted) = (g.add(x, y), g.add(x, five));
        let moved = g.add(shifted, y);
        assert_eq!(bounds.difference(&g, moved, sum), Some(5.0));
        assert_eq!(bounds.difference(&g, shifted, sum), None);
    }
}
