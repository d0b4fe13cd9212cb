//! Polynomials of degree 1 and 2 by their values in the middle of the path.

use super::Integrator;
use super::arithmetic::{add, call, div, mul, scale, square, sub, total};
use super::pair::{Pair, mul_add_rest};
use crate::ir::{Id, Op, Prim};

/// mid + s slope, s from the middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Affine {
    /// The expression.
    pub of: Id,
    /// Value in the middle.
    pub mid: Id,
    /// Values at both ends.
    pub ends: [Id; 2],
    /// Change by t.
    pub slope: Id,
}

/// a s² + 2 b s + c.
#[derive(Clone, Copy, Debug)]
pub struct Quadratic {
    /// The expression.
    pub of: Id,
    /// Coefficient of s².
    pub a: Id,
    /// Half the coefficient of s.
    pub b: Id,
    /// Value in the middle.
    pub c: Id,
    /// a c - b². Of a sum of squares |u + t v|² with a constant k it is k |v|² + |u × v|², which does not cancel.
    pub discriminant: Id,
    /// c - a h². Of a sum of squares it is k + u₀ · u₁ with the values at both ends, which does not cancel.
    pub chord: Id,
    /// Values at both ends.
    pub ends: [Id; 2],
    /// Half the slopes at both ends.
    pub slopes: [Id; 2],
    /// t where the slope is 0.
    pub foot: Id,
    /// What that is beyond [`Self::foot`].
    pub foot_low: Id,
    /// Of a sum of two or three squares and nothing else: how the line passes its zero.
    pub passing: Option<Passing>,
}

/// How a line passes the zero of a sum of squares, for distances of which the squares are too small numbers.
#[derive(Clone, Copy, Debug)]
pub struct Passing {
    /// √D by [`SCALE`].
    pub distance: Id,
    /// √a
    pub rate: Id,
    /// The distances from the zero at both ends.
    pub ends: [Id; 2],
}

/// A power of two that takes the least number of single precision, denormal ones among them, to where a quotient by it is not too
/// large: 2⁶⁴.
pub const SCALE: f64 = 18_446_744_073_709_551_616.0;

/// What a polynomial of degree 2 is a sum of.
#[derive(Debug, Default)]
struct Squares {
    /// Weights and what is squared.
    squares: Vec<(Id, Affine)>,
    /// What is of degree 1.
    linear: Vec<(Id, Affine)>,
    /// What is constant, with its weight.
    constant: Vec<(Id, Id)>,
}

/// Greatest number of squares for which products of all pairs are formed.
const MAX_SQUARES: usize = 8;

impl Integrator<'_> {
    /// The value and the slope in the middle of an expression of degree 1 or 0.
    pub(super) fn affine(&mut self, id: Id) -> Affine {
        let mid = self.at_middle(id);
        let slope = self.slope(id);
        let slope = self.at_middle(slope);
        let ends = self.at_ends(id);
        Affine {
            of: id,
            mid,
            slope,
            ends,
        }
    }

    /// The coefficients of an expression of degree 2 or less. What may cancel, because it is no sum of squares, is
    /// taken with the rests of its roundings.
    pub(super) fn quadratic(&mut self, id: Id) -> Quadratic {
        let may_cancel = self.may_cancel(id);
        let slope = self.slope(id);
        let curvature = self.slope(slope);
        let slope = self.at_middle(slope);
        let curvature = if may_cancel {
            self.constant_with_rests(curvature)
        } else {
            self.at_middle(curvature)
        };
        let (b, a) = (scale(self.g, 0.5, slope), scale(self.g, 0.5, curvature));
        let c = if may_cancel {
            self.pair_in_middle(id).total(self.g)
        } else {
            self.at_middle(id)
        };
        let whole = self.path.clone();
        self.path = whole.from_origin(self.g);
        let rate = self.slope(id);
        let at_origin = self.at_middle(rate);
        self.path = whole.clone();
        let foot = scale(self.g, -0.5, at_origin);
        let foot = self.g.div(foot, a);
        let foot_low = self.foot_low(id, foot);
        let (discriminant, passing) = if may_cancel {
            (self.discriminant_at_foot(id, a, at_origin), None)
        } else {
            self.discriminant_of_squares(id, a, b, c)
        };
        let chord = match self.chord_of_squares(id, may_cancel) {
            Some(chord) => chord,
            None => {
                let reach = square(self.g, self.path.half);
                let reach = mul(self.g, a, reach);
                sub(self.g, c, reach)
            }
        };
        let ends = if may_cancel {
            self.pair_at_ends(id).map(|end| end.total(self.g))
        } else {
            self.at_ends(id)
        };
        Quadratic {
            of: id,
            a,
            b,
            c,
            discriminant,
            chord,
            ends,
            slopes: self.at_ends(rate).map(|s| scale(self.g, 0.5, s)),
            foot,
            foot_low,
            passing,
        }
    }

    /// What is constant along the path, with the rests of its operations: a difference of squares of slopes may cancel.
    pub(super) fn constant_with_rests(&mut self, id: Id) -> Id {
        let origin = self.path.pairs_at_origin();
        match self.whole_pair(id, &origin) {
            Some(pair) => pair.total(self.g),
            None => self.at_middle(id),
        }
    }

    /// What the place where the slope is 0 is beyond its rounded t: -q'(t)/q'', both with their rests.
    fn foot_low(&mut self, id: Id, foot: Id) -> Id {
        let slope = self.slope(id);
        let curvature = self.slope(slope);
        let origin = self.path.pairs_at_origin();
        let pairs = self
            .whole_pair(slope, &origin)
            .zip(self.whole_pair(curvature, &origin));
        let zero = self.g.real(0.0);
        let Some((slope, curvature)) = pairs else {
            return zero;
        };
        let left = mul_add_rest(self.g, [foot, curvature.value, slope.value], zero);
        let beside = mul(self.g, foot, curvature.rest);
        let left = total(self.g, [left, slope.rest, beside]);
        let low = self.g.div(left, curvature.value);
        self.g.neg(low)
    }

    /// a c - b² as a q - (q'/2)² at about the place where the slope is 0, where nothing is subtracted from the first but
    /// what the place is rounded by.
    fn discriminant_at_foot(&mut self, id: Id, a: Id, rate_at_origin: Id) -> Id {
        let half = scale(self.g, 0.5, rate_at_origin);
        let place = self.g.apply(Prim::Foot, &[a, half]);
        let value = self.pair_at(id, place).total(self.g);
        let slope = self.slope(id);
        let slope = self.at_place(&[slope], place)[0];
        let slope = scale(self.g, 0.5, slope);
        let (product, rest) = (mul(self.g, a, value), square(self.g, slope));
        sub(self.g, product, rest)
    }

    /// a c - b² of a sum of squares from what is crossed, else as it is.
    fn discriminant_of_squares(&mut self, id: Id, a: Id, b: Id, c: Id) -> (Id, Option<Passing>) {
        let whole = self.path.clone();
        self.path = whole.from_origin(self.g);
        let mut found = self.squares(id);
        if let Some(place) = found.as_ref().and_then(|s| self.least_place(s)) {
            self.path = whole.from_place(self.g, place);
            found = self.squares(id);
        }
        let passing = found.as_ref().and_then(|s| self.passing(s));
        let found = found.and_then(|s| self.discriminant(&s));
        self.path = whole;
        let discriminant = found.unwrap_or_else(|| {
            let (ac, bb) = (mul(self.g, a, c), square(self.g, b));
            sub(self.g, ac, bb)
        });
        (discriminant, passing)
    }

    /// |u × v| and |v| of a sum of squares |u + s v|² with weights 1.
    fn passing(&mut self, found: &Squares) -> Option<Passing> {
        let is_one = |w: &Id| self.g.as_real(*w) == Some(1.0);
        let is_plain = found.linear.is_empty() && found.constant.is_empty();
        if !is_plain || !found.squares.iter().all(|(w, _)| is_one(w)) {
            return None;
        }
        let lines: Vec<Affine> = found.squares.iter().map(|s| s.1).collect();
        let g = &mut *self.g;
        let mut cross = |x: Affine, y: Affine| {
            let mids = [x.mid, y.mid].map(|mid| scale(g, SCALE, mid));
            let (left, right) = (mul(g, mids[0], y.slope), mul(g, mids[1], x.slope));
            sub(g, left, right)
        };
        match *lines.as_slice() {
            [x, y] => {
                let crossed = cross(x, y);
                Some(Passing {
                    distance: call(g, Prim::Abs, crossed),
                    rate: g.apply(Prim::Hypot, &[x.slope, y.slope]),
                    ends: [0, 1].map(|k| g.apply(Prim::Hypot, &[x.ends[k], y.ends[k]])),
                })
            }
            [x, y, z] => {
                let crossed = [cross(x, y), cross(y, z), cross(z, x)];
                Some(Passing {
                    distance: g.apply(Prim::Hypot3, &crossed),
                    rate: g.apply(Prim::Hypot3, &[x.slope, y.slope, z.slope]),
                    ends: [0, 1].map(|k| g.apply(Prim::Hypot3, &[x.ends[k], y.ends[k], z.ends[k]])),
                })
            }
            _ => None,
        }
    }

    /// c - a h² = Σ w u₀ u₁ + Σ ℓ(m) + k.
    fn chord_of_squares(&mut self, id: Id, may_cancel: bool) -> Option<Id> {
        let found = self.squares(id)?;
        if may_cancel {
            return Some(self.chord_with_rests(&found));
        }
        let mut sum = self.g.real(0.0);
        for (w, x) in &found.squares {
            let product = mul(self.g, x.ends[0], x.ends[1]);
            let part = mul(self.g, *w, product);
            sum = add(self.g, sum, part);
        }
        for (w, x) in &found.linear {
            let part = mul(self.g, *w, x.mid);
            sum = add(self.g, sum, part);
        }
        for &(w, c) in &found.constant {
            let part = mul(self.g, w, c);
            sum = add(self.g, sum, part);
        }
        Some(sum)
    }

    fn chord_with_rests(&mut self, found: &Squares) -> Id {
        let zero = self.g.real(0.0);
        let mut sum = Pair::exact(self.g, zero);
        let mut add_weighted = |this: &mut Self, weight: Id, pair: Pair| {
            let weight = Pair::exact(this.g, weight);
            let part = pair.times(this.g, weight);
            sum = sum.plus(this.g, part);
        };
        for (w, x) in &found.squares {
            let [first, last] = self.pair_at_ends(x.of);
            let product = first.times(self.g, last);
            add_weighted(self, *w, product);
        }
        for (w, x) in &found.linear {
            let middle = self.pair_in_middle(x.of);
            add_weighted(self, *w, middle);
        }
        for &(w, c) in &found.constant {
            let constant = Pair::exact(self.g, c);
            add_weighted(self, w, constant);
        }
        sum.total(self.g)
    }

    /// Whether an expression is a sum of squares with positive weights and constants that are not negative.
    pub(super) fn is_sum_of_squares(&mut self, id: Id) -> bool {
        let Some(found) = self.squares(id) else {
            return false;
        };
        let weights = found.squares.iter().map(|s| s.0);
        let values: Vec<Id> = weights.chain(found.constant.iter().map(|c| c.1)).collect();
        let positive = |&w: &Id| self.g.as_real(w).is_some_and(|w| w >= 0.0);
        found.linear.is_empty()
            && values.iter().all(positive)
            && found.constant.iter().all(|c| positive(&c.0))
    }

    /// Whether an expression is a sum of squares with constant weights that are not negative, and of what is of degree 1
    /// or 0: its curvature is not negative.
    pub(super) fn opens_up(&mut self, id: Id) -> bool {
        let Some(found) = self.squares(id) else {
            return false;
        };
        let mut weights = found.squares.iter().map(|s| s.0);
        weights.all(|w| self.g.as_real(w).is_some_and(|w| w >= 0.0))
    }

    /// t about where the sum of the squares is least, signs of their weights left out. What is formed from the values there
    /// is rounded least, as they are the smallest; the discriminant is the same number wherever it is formed. `None` for
    /// one square alone, of which nothing is crossed.
    fn least_place(&mut self, found: &Squares) -> Option<Id> {
        if found.squares.len() < 2 || found.squares.len() > MAX_SQUARES {
            return None;
        }
        let g = &mut *self.g;
        let (mut a, mut b) = (g.real(0.0), g.real(0.0));
        for (w, x) in &found.squares {
            let weight = match g.as_real(*w) {
                Some(w) => g.real(w.abs()),
                None => call(g, Prim::Abs, *w),
            };
            let (rate, product) = (square(g, x.slope), mul(g, x.mid, x.slope));
            let (rate, product) = (mul(g, weight, rate), mul(g, weight, product));
            (a, b) = (add(g, a, rate), add(g, b, product));
        }
        Some(g.apply(Prim::Foot, &[a, b]))
    }

    /// a c - b² from the squares.
    fn discriminant(&mut self, found: &Squares) -> Option<Id> {
        if found.squares.len() > MAX_SQUARES {
            return None;
        }
        let g = &mut *self.g;
        let mut out = g.real(0.0);
        for (k, (w, x)) in found.squares.iter().enumerate() {
            for (v, y) in &found.squares[..k] {
                let (left, right) = (mul(g, x.mid, y.slope), mul(g, y.mid, x.slope));
                let cross = sub(g, left, right);
                let weight = mul(g, *w, *v);
                let crossed = square(g, cross);
                let part = mul(g, weight, crossed);
                out = add(g, out, part);
            }
        }
        let mut a = g.real(0.0);
        let mut b = g.real(0.0);
        for (w, x) in &found.squares {
            let (rate, product) = (square(g, x.slope), mul(g, x.mid, x.slope));
            let (rate, product) = (mul(g, *w, rate), mul(g, *w, product));
            (a, b) = (add(g, a, rate), add(g, b, product));
        }
        let parts: Vec<Id> = found.constant.iter().map(|&(w, c)| mul(g, w, c)).collect();
        let mut constant = total(g, parts);
        if !found.linear.is_empty() {
            // the linear part ℓ₀ + ℓ₁ s: a ℓ₀ - ℓ₁ (b + ℓ₁/4)
            let mut slope = g.real(0.0);
            for &(w, x) in &found.linear {
                let (mid, rate) = (mul(g, w, x.mid), mul(g, w, x.slope));
                (constant, slope) = (add(g, constant, mid), add(g, slope, rate));
            }
            let quarter = scale(g, 0.25, slope);
            let sum = add(g, b, quarter);
            let part = mul(g, slope, sum);
            out = sub(g, out, part);
        }
        let part = mul(g, a, constant);
        Some(add(g, out, part))
    }

    /// a α² - 2 b α β + c β², β² times the value of a quadratic where α + β s is 0; of squares u² as (α u' - β u)².
    pub(super) fn resultant(&mut self, id: Id, q: &Quadratic, x: Affine) -> Id {
        let rate = square(self.g, x.slope);
        if let Some(found) = self.squares(id).filter(|s| s.linear.is_empty()) {
            let g = &mut *self.g;
            let mut sum = g.real(0.0);
            for (w, u) in &found.squares {
                let (left, right) = (mul(g, x.mid, u.slope), mul(g, x.slope, u.mid));
                let cross = sub(g, left, right);
                let crossed = square(g, cross);
                let part = mul(g, *w, crossed);
                sum = add(g, sum, part);
            }
            for &(w, c) in &found.constant {
                let level = mul(g, w, c);
                let part = mul(g, level, rate);
                sum = add(g, sum, part);
            }
            return sum;
        }
        let g = &mut *self.g;
        let level = square(g, x.mid);
        let (first, last) = (mul(g, q.a, level), mul(g, q.c, rate));
        let mixed = mul(g, x.mid, x.slope);
        let mixed = mul(g, q.b, mixed);
        let mixed = scale(g, 2.0, mixed);
        let sum = add(g, first, last);
        sub(g, sum, mixed)
    }

    /// Takes a polynomial apart into squares, what is linear, and constants.
    fn squares(&mut self, root: Id) -> Option<Squares> {
        let mut out = Squares::default();
        let one = self.g.real(1.0);
        let mut stack = vec![(root, one)];
        while let Some((id, weight)) = stack.pop() {
            if out.squares.len() + stack.len() > 64 {
                return None;
            }
            match self.degree(id)? {
                0 => out.constant.push((weight, id)),
                1 => {
                    let affine = self.affine(id);
                    out.linear.push((weight, affine));
                }
                2 => self.take_apart(id, weight, &mut stack, &mut out)?,
                _ => return None,
            }
        }
        Some(out)
    }

    fn take_apart(
        &mut self,
        id: Id,
        weight: Id,
        stack: &mut Vec<(Id, Id)>,
        out: &mut Squares,
    ) -> Option<()> {
        let node = self.g.node(id).clone();
        let Op::Apply(prim) = node.op else {
            return None;
        };
        match (prim, node.args.as_slice()) {
            (Prim::Add, &[a, b]) => stack.extend([(a, weight), (b, weight)]),
            (Prim::Sub, &[a, b]) => {
                let less = self.g.neg(weight);
                stack.extend([(a, weight), (b, less)]);
            }
            (Prim::Neg, &[a]) => {
                let less = self.g.neg(weight);
                stack.push((a, less));
            }
            (Prim::Mul, &[a, b]) if a == b => self.push_square(a, weight, out)?,
            (Prim::Mul, &[a, b]) if !self.moves(a) => {
                let weight = mul(self.g, weight, a);
                stack.push((b, weight));
            }
            (Prim::Mul, &[a, b]) if !self.moves(b) => {
                let weight = mul(self.g, weight, b);
                stack.push((a, weight));
            }
            (Prim::Div, &[a, b]) if !self.moves(b) => {
                let weight = div(self.g, weight, b);
                stack.push((a, weight));
            }
            // u v = ((u + v)² - (u - v)²)/4
            (Prim::Mul, &[a, b]) => {
                let (sum, difference) = (add(self.g, a, b), sub(self.g, a, b));
                let quarter = scale(self.g, 0.25, weight);
                self.push_square(sum, quarter, out)?;
                let less = self.g.neg(quarter);
                self.push_square(difference, less, out)?;
            }
            (Prim::PowInt(2), &[a]) => {
                let inner = self.g.node(a).clone();
                match inner.op {
                    Op::Apply(Prim::Hypot | Prim::Hypot3) => {
                        for &part in &inner.args {
                            self.push_square(part, weight, out)?;
                        }
                    }
                    Op::Apply(Prim::Sqrt) => stack.push((inner.args[0], weight)),
                    Op::Apply(Prim::Abs) => self.push_square(inner.args[0], weight, out)?,
                    _ => self.push_square(a, weight, out)?,
                }
            }
            _ => return None,
        }
        Some(())
    }

    fn push_square(&mut self, of: Id, weight: Id, out: &mut Squares) -> Option<()> {
        match self.degree(of)? {
            0 => {
                let square = square(self.g, of);
                out.constant.push((weight, square));
            }
            1 => {
                let affine = self.affine(of);
                out.squares.push((weight, affine));
            }
            _ => return None,
        }
        Some(())
    }
}
