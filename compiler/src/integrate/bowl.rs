//! Roots and the squared reciprocal of a quadratic without the difference of two antiderivatives.
//!
//! q = a s² + 2 b s + c, q₀, q₁, r₀, r₁ it and its roots at the ends, S = r₀ + r₁, E = c - a h², D = a c - b². The ends see
//! the zero of q at an angle θ: √D L = r₀ r₁ sin θ and E = r₀ r₁ cos θ, as q₀ q₁ = E² + D L².

use super::Integrator;
use super::algebraic::Bowl;
use super::arithmetic::{add, call, div, if_less, mul, scale, square, sub};
use super::quadratic::{Passing, SCALE};
use crate::ir::{Id, Prim};

/// What a is kept from 0 by, where its root has no derivative.
const LEAST_CURVE: f64 = 1e-37;
/// What z is kept from 1 by where it is rounded to 1 or more: half a unit of binary32. There k changes by less than that
/// counts, as it is multiplied by about 1 - z.
const NEXT_TO_ONE: f64 = 1.0 - 0.5 * f32::EPSILON as f64;
/// Beyond it L²/S² is that of squares that underflow.
const LARGEST_RATIO: f64 = 1e36;
/// Below it a discriminant may be 0 that is not.
const LEAST_DISCRIMINANT: f64 = 1e-30;
/// -a L²/2E beyond which an interval between two zeros is long.
const LONG_BETWEEN: f64 = 0.4;
/// What S is kept from 0 by.
const LEAST_SUM: f64 = 1e-30;

impl Integrator<'_> {
    /// a ≥ 0: ∫ 1/√q = (1/√a) log((S + √a L)²/(2 W)) = (L/x) log(1 + x (S + x)/W), x = √a |L|, W = r₀ r₁ + E, as
    /// 2 W = S² - a L²; L S/W where x is 0.
    pub(super) fn reciprocal_root_of_bowl(&mut self, bowl: &Bowl) -> Id {
        let (roots, sum) = self.roots(bowl);
        let width = self.width(bowl, roots);
        let value = self.by_width(bowl, sum, width);
        match bowl.q.passing {
            Some(passing) => {
                let beside = self.reciprocal_root_beside(bowl, passing);
                self.where_it_passes(bowl, beside, value)
            }
            None => value,
        }
    }

    /// The first where the line passes the zero of a sum of squares within the interval, so near that D or D L² is too small a number.
    pub(super) fn where_it_passes(&mut self, bowl: &Bowl, beside: Id, otherwise: Id) -> Id {
        let (zero, least) = (self.g.real(0.0), self.g.real(LEAST_DISCRIMINANT));
        let is_between = self.g.apply(Prim::Less, &[bowl.q.chord, zero]);
        let triangle = self.width_of_triangle(bowl);
        let size = self.g.apply(Prim::Min, &[bowl.q.discriminant, triangle]);
        let is_near = self.g.apply(Prim::Less, &[size, least]);
        let passes = self.g.apply(Prim::And, &[is_between, is_near]);
        self.g.apply(Prim::Select, &[passes, beside, otherwise])
    }

    /// E < 0: ∫ 1/√q = ±(2/√a) log((S + √a |L|) √((r₀ r₁ - E)/2)/(√D |L|)), as W = D L²/(r₀ r₁ - E).
    fn reciprocal_root_beside(&mut self, bowl: &Bowl, passing: Passing) -> Id {
        let sum = self.g.add(passing.ends[0], passing.ends[1]);
        let size = call(self.g, Prim::Abs, bowl.length);
        let along = mul(self.g, passing.rate, size);
        let whole = self.g.add(sum, along);
        let product = mul(self.g, passing.ends[0], passing.ends[1]);
        let across = self.g.sub(product, bowl.q.chord);
        let across = scale(self.g, 0.5, across);
        let across = call(self.g, Prim::Sqrt, across);
        let top = mul(self.g, whole, across);
        let bottom = mul(self.g, passing.distance, size);
        let ratio = self.g.div(top, bottom);
        let log = call(self.g, Prim::Log, ratio);
        let scaled = self.g.real(SCALE.ln());
        let log = self.g.add(log, scaled);
        let double = scale(self.g, 2.0, log);
        let value = self.g.div(double, passing.rate);
        let sign = call(self.g, Prim::Sign, bowl.length);
        mul(self.g, sign, value)
    }

    /// E < 0: ∫ 1/q = ±atan2(√D |L|, E)/√D.
    pub(super) fn reciprocal_beside(&mut self, bowl: &Bowl, passing: Passing) -> Id {
        let size = call(self.g, Prim::Abs, bowl.length);
        let across = mul(self.g, passing.distance, size);
        let along = scale(self.g, SCALE, bowl.q.chord);
        let angle = self.g.apply(Prim::Atan2, &[across, along]);
        let value = self.g.div(angle, passing.distance);
        let value = scale(self.g, SCALE, value);
        let sign = call(self.g, Prim::Sign, bowl.length);
        mul(self.g, sign, value)
    }

    /// The same with S and W. Below 1 by log(1 + y)/y, so that the derivative does not cancel.
    pub(super) fn by_width(&mut self, bowl: &Bowl, sum: Id, width: Id) -> Id {
        let floor = self.g.real(LEAST_CURVE);
        let curve = self.g.apply(Prim::Max, &[bowl.q.a, floor]);
        let root = call(self.g, Prim::Sqrt, curve);
        let size = call(self.g, Prim::Abs, bowl.length);
        let along = mul(self.g, root, size);
        let whole = self.g.add(sum, along);
        let mean = self.g.div(whole, width);
        let growth = mul(self.g, along, mean);
        let log = call(self.g, Prim::Log1p, growth);
        let far = div(self.g, log, along);
        let rate = call(self.g, Prim::Log1pRel(0), growth);
        let near = mul(self.g, mean, rate);
        let one = self.g.real(1.0);
        let mean = if_less(self.g, growth, one, near, far);
        mul(self.g, bowl.length, mean)
    }

    /// a ≥ 0: ∫ √q = L (S/4 + (c + D u k(a u))/S), u = L²/S², k(z) = (artanh(√z)/√z - 1)/z. No term is negative where
    /// D is not. By parts 2 a ∫ √q = [(a s + b) √q] + D ∫ 1/√q, with [(a s + b) √q] = a L S/2 + 2 b² L/S.
    pub(super) fn root_of_bowl(&mut self, bowl: &Bowl) -> Id {
        let (_, sum) = self.roots(bowl);
        let floor = self.g.real(LEAST_SUM);
        let safe = self.g.apply(Prim::Max, &[sum, floor]);
        let ratio = self.g.div(bowl.length, safe);
        let ratio = square(self.g, ratio);
        let z = mul(self.g, bowl.q.a, ratio);
        let (one, most) = (self.g.real(1.0), self.g.real(NEXT_TO_ONE));
        let z = if_less(self.g, z, one, z, most);
        let back = self.g.neg(z);
        let moment = self.g.apply(Prim::AtanQuotient(1), &[back]);
        let depth = mul(self.g, bowl.q.discriminant, ratio);
        let part = mul(self.g, depth, moment);
        // of a line that is so short and near the zero that its squares are none, nothing
        let (zero, large) = (self.g.real(0.0), self.g.real(LARGEST_RATIO));
        let part = if_less(self.g, ratio, large, part, zero);
        let top = add(self.g, bowl.q.c, part);
        let middle = div(self.g, top, safe);
        let quarter = scale(self.g, 0.25, sum);
        let mean = add(self.g, quarter, middle);
        mul(self.g, bowl.length, mean)
    }

    /// ∫ 1/q² = (L/q₀q₁) (1 + (a/2D) (G q₀q₁ - E)), G = atan2(√(D L²), E)/√(D L²): nothing cancels while θ is
    /// greater than π/4. Below, G = A₀(z)/E with z = D L²/E² = tan² θ, and the second term is
    /// (a L²/2E) (A₀ - A₁), A₀ - A₁ = 1 - (1 + z) A₁(z), A₁ = (1 - A₀)/z.
    pub(super) fn reciprocal_square(&mut self, bowl: &Bowl) -> Id {
        let sign = self.sign_of(bowl);
        let (a, e) = (mul(self.g, sign, bowl.q.a), mul(self.g, sign, bowl.q.chord));
        let p = self.width_of_triangle(bowl);
        let product = mul(self.g, bowl.ends[0], bowl.ends[1]);
        let quotient = self.g.apply(Prim::Atan2Quotient, &[p, e]);
        let angle = mul(self.g, quotient, product);
        let angle = sub(self.g, angle, e);
        let twice = scale(self.g, 2.0, bowl.q.discriminant);
        let rate = div(self.g, a, twice);
        let wide = mul(self.g, rate, angle);

        let (z, turned) = (self.over_square(p, e), self.over_square(product, e));
        let moment = self.g.apply(Prim::AtanQuotient(1), &[z]);
        let moment = mul(self.g, turned, moment);
        let one = self.g.real(1.0);
        let rest = sub(self.g, one, moment);
        let square_length = square(self.g, bowl.length);
        let reach = mul(self.g, a, square_length);
        let reach = div(self.g, reach, e);
        let reach = scale(self.g, 0.5, reach);
        let narrow = mul(self.g, reach, rest);

        // E² > D L² > -E², E > 0
        let zero = self.g.real(0.0);
        let ahead = self.g.apply(Prim::Less, &[zero, e]);
        let beside = self.g.apply(Prim::Less, &[z, one]);
        let is_narrow = self.g.apply(Prim::And, &[ahead, beside]);
        let part = self.g.apply(Prim::Select, &[is_narrow, narrow, wide]);
        let factor = add(self.g, one, part);
        let least = div(self.g, bowl.length, product);
        let value = mul(self.g, least, factor);
        if bowl.is_sum_of_squares {
            return value;
        }
        let between = self.reciprocal_square_between(bowl);
        let limit = self.g.real(-LONG_BETWEEN);
        let is_long = self.g.apply(Prim::Less, &[reach, limit]);
        let is_long = self.g.apply(Prim::And, &[ahead, is_long]);
        self.g.apply(Prim::Select, &[is_long, between, value])
    }

    /// ∫ 1/q² = ([q'/2q] + a ∫ 1/q)/2D: between two zeros, where a/q < 0, both terms have one sign.
    fn reciprocal_square_between(&mut self, bowl: &Bowl) -> Id {
        let [first, last] = [0, 1].map(|k| self.g.div(bowl.q.slopes[k], bowl.ends[k]));
        let beside = self.g.sub(last, first);
        let whole = self.reciprocal(bowl);
        let curved = mul(self.g, bowl.q.a, whole);
        let sum = self.g.add(beside, curved);
        let twice = scale(self.g, 2.0, bowl.q.discriminant);
        self.g.div(sum, twice)
    }

    /// x/e² without e².
    fn over_square(&mut self, x: Id, e: Id) -> Id {
        let once = div(self.g, x, e);
        div(self.g, once, e)
    }
}
