//! Values with what they are rounded by, as unevaluated sums of two numbers.
//!
//! An exponent of 40 is rounded by 2e-6, and a sum that nearly cancels by all that is left of it. Polynomials of the
//! coordinates are therefore known with the rest that their rounding left, where a rule needs it. Each rest is taken
//! against the rounded value as it is, so that a sum or product that a driver has fused only makes it smaller.
//!
//! Ogita, Rump and Oishi, "Accurate sum and dot product", SIAM Journal on Scientific Computing 26 (2005).

use rustc_hash::FxHashMap;

use super::Integrator;
use super::arithmetic::{add, call, div, if_less, is_zero, mul, scale, total};
use super::path::{Body, cone};
use crate::ir::{Graph, Id, Op, Prim};

/// Sizes of known numbers whose rests are kept.
const SIZES: std::ops::RangeInclusive<f64> = 1e-20..=1e20;

/// A rounded value and what is beyond it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pair {
    /// The rounded value.
    pub value: Id,
    /// What the value that is meant is beyond it; next to nothing in comparison, except where a sum has cancelled.
    pub rest: Id,
}

/// a + b - s
pub fn sum_rest(g: &mut Graph, a: Id, b: Id, s: Id) -> Id {
    if is_zero(g, a) || is_zero(g, b) {
        return g.real(0.0);
    }
    g.apply(Prim::SumRest, &[a, b, s])
}

/// a b - p
pub fn product_rest(g: &mut Graph, a: Id, b: Id, p: Id) -> Id {
    let is_exact = |id: Id| g.as_real(id).is_some_and(is_power_of_two);
    if is_exact(a) || is_exact(b) {
        return g.real(0.0);
    }
    g.apply(Prim::ProductRest, &[a, b, p])
}

/// a b + c - s
pub fn mul_add_rest(g: &mut Graph, [a, b, c]: [Id; 3], s: Id) -> Id {
    let is_exact = |id: Id| g.as_real(id).is_some_and(is_power_of_two);
    if is_zero(g, c) {
        return product_rest(g, a, b, s);
    }
    if is_exact(a) || is_exact(b) {
        let product = mul(g, a, b);
        return sum_rest(g, product, c, s);
    }
    g.apply(Prim::MulAddRest, &[a, b, c, s])
}

/// Whether a product with it is not rounded: 0 or a power of two.
fn is_power_of_two(v: f64) -> bool {
    v == 0.0 || v.is_finite() && v.to_bits() & ((1 << 52) - 1) == 0
}

/// A number as one of single precision and the rest; `None` where that is 0, and of sizes at which either may be no normal number.
fn split(v: f64) -> Option<(f64, f64)> {
    #[allow(clippy::cast_possible_truncation, reason = "the rest is kept")]
    let high = f64::from(v as f32);
    let low = v - high;
    (low != 0.0 && SIZES.contains(&v.abs())).then_some((high, low))
}

impl Pair {
    /// A value that is not rounded.
    pub fn exact(g: &mut Graph, value: Id) -> Self {
        let rest = g.real(0.0);
        Self { value, rest }
    }

    /// What does not change along the path. A known number that single precision does not hold has what it is rounded by.
    pub fn constant(g: &mut Graph, value: Id) -> Self {
        let zero = g.real(0.0);
        let Some((high, low)) = g.as_real(value).and_then(split) else {
            return Self { value, rest: zero };
        };
        Self {
            value: g.real(high),
            rest: g.real(low),
        }
    }

    /// The one where a < b, else the other.
    pub fn if_less(g: &mut Graph, a: Id, b: Id, then: Self, otherwise: Self) -> Self {
        Self {
            value: if_less(g, a, b, then.value, otherwise.value),
            rest: if_less(g, a, b, then.rest, otherwise.rest),
        }
    }

    /// Both as one number.
    pub fn total(self, g: &mut Graph) -> Id {
        add(g, self.value, self.rest)
    }

    /// The same with a rest that is next to nothing beside the value, after a sum that may have cancelled.
    pub fn normalised(self, g: &mut Graph) -> Self {
        let value = self.total(g);
        let rest = sum_rest(g, self.value, self.rest, value);
        Self { value, rest }
    }

    /// The pair turned.
    pub fn negated(self, g: &mut Graph) -> Self {
        Self {
            value: g.neg(self.value),
            rest: if is_zero(g, self.rest) {
                self.rest
            } else {
                g.neg(self.rest)
            },
        }
    }

    /// A sum.
    pub fn plus(self, g: &mut Graph, other: Self) -> Self {
        let value = add(g, self.value, other.value);
        let own = sum_rest(g, self.value, other.value, value);
        let rests = add(g, self.rest, other.rest);
        let rest = add(g, own, rests);
        Self { value, rest }
    }

    /// A product; what is small in both is left out.
    pub fn times(self, g: &mut Graph, other: Self) -> Self {
        let value = mul(g, self.value, other.value);
        let own = product_rest(g, self.value, other.value, value);
        let left = mul(g, self.rest, other.value);
        let right = mul(g, self.value, other.rest);
        let mixed = add(g, left, right);
        let rest = add(g, own, mixed);
        Self { value, rest }
    }

    /// A square.
    pub fn squared(self, g: &mut Graph) -> Self {
        let value = mul(g, self.value, self.value);
        let own = product_rest(g, self.value, self.value, value);
        let mixed = mul(g, self.value, self.rest);
        let mixed = scale(g, 2.0, mixed);
        Self {
            value,
            rest: add(g, own, mixed),
        }
    }

    /// A multiple by a power of two.
    pub fn multiple(self, g: &mut Graph, factor: f64) -> Self {
        Self {
            value: scale(g, factor, self.value),
            rest: scale(g, factor, self.rest),
        }
    }

    /// A part of it: a quotient by a whole number.
    pub fn part(self, g: &mut Graph, count: u32) -> Self {
        if count.is_power_of_two() {
            return self.multiple(g, 1.0 / f64::from(count));
        }
        let count = g.real(f64::from(count));
        self.over(g, count)
    }

    /// A quotient by a number that is not rounded.
    pub fn over(self, g: &mut Graph, divisor: Id) -> Self {
        let value = div(g, self.value, divisor);
        let own = product_rest(g, value, divisor, self.value);
        let left = super::arithmetic::sub(g, self.rest, own);
        Self {
            value,
            rest: div(g, left, divisor),
        }
    }

    fn power(self, g: &mut Graph, n: u32) -> Self {
        let mut out = self;
        for bit in (0..n.ilog2()).rev() {
            out = out.squared(g);
            if n >> bit & 1 == 1 {
                out = out.times(g, self);
            }
        }
        out
    }
}

impl Integrator<'_> {
    /// A polynomial in the middle of the path, with its rest.
    pub(super) fn pair_in_middle(&mut self, root: Id) -> Pair {
        let whole = self.path.clone();
        let values = whole.pairs_in_middle(self.g);
        self.pair(root, &values)
    }

    /// A polynomial at t, which is not rounded, with its rest.
    pub(super) fn pair_at(&mut self, root: Id, t: Id) -> Pair {
        let whole = self.path.clone();
        let values = whole.pairs(self.g, t);
        self.pair(root, &values)
    }

    /// A polynomial at both ends, with its rests.
    pub(super) fn pair_at_ends(&mut self, root: Id) -> [Pair; 2] {
        self.path.ends.map(|t| self.pair_at(root, t))
    }

    /// A polynomial of coordinates that are pairs. Without a rest where it has operations that are not told apart.
    pub(super) fn pair(&mut self, root: Id, values: &[(Id, Pair)]) -> Pair {
        if let Some(pair) = self.try_pair(root, values) {
            return pair;
        }
        let leaves = self.path.coordinates.iter().map(|c| c.leaf);
        let values: Vec<(Id, Id)> = values.iter().map(|&(leaf, p)| (leaf, p.value)).collect();
        let value = Body::new(self.g, &[root], leaves).at(self.g, &values)[0];
        Pair::exact(self.g, value)
    }

    pub(super) fn try_pair(&mut self, root: Id, values: &[(Id, Pair)]) -> Option<Pair> {
        let mut known: FxHashMap<Id, Pair> = values.iter().copied().collect();
        for id in cone(self.g, &[root]) {
            if known.contains_key(&id) {
                continue;
            }
            let pair = if self.moves(id) {
                self.pair_of_operation(id, &known)
            } else {
                Some(self.pair_of_constant(id))
            };
            if let Some(pair) = pair {
                known.insert(id, pair);
            }
        }
        known.get(&root).copied()
    }

    /// What does not change along the path, with what it is rounded by where that is asked for.
    fn pair_of_constant(&mut self, id: Id) -> Pair {
        if self.splits_constants {
            Pair::constant(self.g, id)
        } else {
            Pair::exact(self.g, id)
        }
    }

    /// The same with the rests of what is constant along the path, too.
    pub(super) fn whole_pair(&mut self, root: Id, values: &[(Id, Pair)]) -> Option<Pair> {
        let mut known: FxHashMap<Id, Pair> = values.iter().copied().collect();
        for id in cone(self.g, &[root]) {
            if known.contains_key(&id) {
                continue;
            }
            let pair = self.pair_of_operation(id, &known);
            let pair = match pair {
                None if self.moves(id) => return None,
                None => self.pair_of_constant(id),
                Some(pair) => pair,
            };
            known.insert(id, pair);
        }
        known.get(&root).copied()
    }

    /// Polynomials at a place that is known with what it is rounded by, each as one number.
    pub(super) fn at_pair(&mut self, roots: &[Id], t: Id, low: Id) -> Vec<Id> {
        let whole = self.path.clone();
        let values = whole.pairs_beside(self.g, t, low);
        roots
            .iter()
            .map(|&root| self.pair(root, &values).total(self.g))
            .collect()
    }

    /// The pair of an operation by those of its operands; `None` of what has none.
    pub(super) fn pair_of_operation(
        &mut self,
        id: Id,
        known: &FxHashMap<Id, Pair>,
    ) -> Option<Pair> {
        let node = self.g.node(id).clone();
        if matches!(node.op, Op::Apply(Prim::Mul | Prim::PowInt(_))) && self.is_steep(id) {
            let factors: Vec<(Id, Pair)> = node
                .args
                .iter()
                .filter(|&&a| self.is_sum(a))
                .filter_map(|&a| Some((a, *known.get(&a)?)))
                .collect();
            if !factors.is_empty() {
                let mut known = known.clone();
                for (factor, pair) in factors {
                    let pair = pair.normalised(self.g);
                    known.insert(factor, pair);
                }
                return self.pair_of_plain_operation(id, &known);
            }
        }
        self.pair_of_plain_operation(id, known)
    }

    /// Whether a product may be the square of what has cancelled: other than a polynomial of degree 1 or 2.
    fn is_steep(&mut self, id: Id) -> bool {
        !matches!(self.degree(id), Some(0..=2))
    }

    fn is_sum(&mut self, id: Id) -> bool {
        let is_sum = matches!(self.g.node(id).op, Op::Apply(Prim::Add | Prim::Sub));
        is_sum && self.moves(id) && !self.is_sum_of_squares(id)
    }

    fn pair_of_plain_operation(&mut self, id: Id, known: &FxHashMap<Id, Pair>) -> Option<Pair> {
        let node = self.g.node(id).clone();
        let of = |k: usize| known.get(&node.args[k]).copied();
        let Op::Apply(prim) = node.op else {
            return None;
        };
        if matches!(prim, Prim::Add | Prim::Sub)
            && let Some(pair) = self.pair_of_multiple(prim, (node.args[0], node.args[1]), known)
        {
            return Some(pair);
        }
        let g = &mut *self.g;
        Some(match prim {
            Prim::Neg => of(0)?.negated(g),
            Prim::Add => of(0)?.plus(g, of(1)?),
            Prim::Sub => {
                let back = of(1)?.negated(g);
                of(0)?.plus(g, back)
            }
            Prim::Mul if node.args[0] == node.args[1] => of(0)?.squared(g),
            Prim::Mul => of(0)?.times(g, of(1)?),
            Prim::Div if !self.moves(node.args[1]) => of(0)?.over(self.g, node.args[1]),
            Prim::PowInt(n) if n > 0 => {
                self.pair_of_power(node.args[0], n.unsigned_abs(), known)?
            }
            Prim::Select if !self.moves(node.args[0]) => {
                let (then, otherwise) = (of(1)?, of(2)?);
                let mut choose = |a: Id, b: Id| self.g.apply(Prim::Select, &[node.args[0], a, b]);
                Pair {
                    value: choose(then.value, otherwise.value),
                    rest: choose(then.rest, otherwise.rest),
                }
            }
            _ => return None,
        })
    }

    /// k x + c or k x - c with constants k and c, by one rest.
    fn pair_of_multiple(
        &mut self,
        prim: Prim,
        (left, right): (Id, Id),
        known: &FxHashMap<Id, Pair>,
    ) -> Option<Pair> {
        let node = self.g.node(left).clone();
        if node.op != Op::Apply(Prim::Mul) || self.moves(right) {
            return None;
        }
        let (factor, x) = match (self.moves(node.args[0]), self.moves(node.args[1])) {
            (false, true) => (node.args[0], node.args[1]),
            (true, false) => (node.args[1], node.args[0]),
            _ => return None,
        };
        let x = *known.get(&x)?;
        let [factor, constant] = [factor, right].map(|id| self.pair_of_constant(id));
        let constant = if prim == Prim::Sub {
            constant.negated(self.g)
        } else {
            constant
        };
        let product = mul(self.g, factor.value, x.value);
        let value = add(self.g, product, constant.value);
        let own = mul_add_rest(self.g, [factor.value, x.value, constant.value], value);
        let beside = mul(self.g, factor.value, x.rest);
        let steeper = mul(self.g, factor.rest, x.value);
        Some(Pair {
            value,
            rest: total(self.g, [own, beside, steeper, constant.rest]),
        })
    }

    /// A power, of a length or a root by its square.
    fn pair_of_power(&mut self, base: Id, n: u32, known: &FxHashMap<Id, Pair>) -> Option<Pair> {
        if let Some(pair) = known.get(&base) {
            return Some(pair.power(self.g, n));
        }
        if n % 2 == 1 {
            return None;
        }
        let node = self.g.node(base).clone();
        let parts: Option<Vec<Pair>> = node.args.iter().map(|a| known.get(a).copied()).collect();
        let parts = parts?;
        let square = match node.op {
            Op::Apply(Prim::Sqrt) => *parts.first()?,
            Op::Apply(Prim::Abs | Prim::Hypot | Prim::Hypot3) => {
                let squares: Vec<Pair> = parts.iter().map(|p| p.squared(self.g)).collect();
                squares.into_iter().reduce(|a, b| a.plus(self.g, b))?
            }
            _ => return None,
        };
        Some(square.power(self.g, n / 2))
    }

    /// sin, cos, sinh or cosh of a pair, by the first two terms of Taylor's series.
    pub(super) fn wave_of(&mut self, prim: Prim, phase: Pair) -> Id {
        let value = call(self.g, prim, phase.value);
        if is_zero(self.g, phase.rest) {
            return value;
        }
        let (slope, sign) = match prim {
            Prim::Sin => (Prim::Cos, 1.0),
            Prim::Cos => (Prim::Sin, -1.0),
            Prim::Sinh => (Prim::Cosh, 1.0),
            _ => (Prim::Sinh, 1.0),
        };
        let slope = call(self.g, slope, phase.value);
        let rest = scale(self.g, sign, phase.rest);
        self.g.apply(Prim::MulAdd, &[rest, slope, value])
    }

    /// x (1 + rest) for a rest of an exponent
    pub(super) fn grown(&mut self, x: Id, rest: Id) -> Id {
        if is_zero(self.g, rest) {
            return x;
        }
        self.g.apply(Prim::MulAdd, &[x, rest, x])
    }
}
