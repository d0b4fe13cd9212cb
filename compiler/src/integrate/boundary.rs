//! Polynomials beside roots and logarithms of quadratics, as what is at both ends and one elementary integral.
//!
//! With σ = s - s₀ from the place of the least q = a Q, Q = σ² + D/a², every ∫ p q^(n/2) is [q^(n/2) R(σ)] + κ ∫ 1/√q with a polynomial
//! R. Where p has a zero in the interval, R nearly cancels at that end; so its coefficients, σ and R are pairs. What is
//! multiplied afterwards, a root or a logarithm, need not be.

use super::Integrator;
use super::algebraic::{Bowl, TINY};
use super::arithmetic::{add, call, div, mul, scale, square, sub};
use super::pair::{Pair, sum_rest};
use crate::ir::{Id, Prim};

/// (σ/w)², w² = D/a², up to which an end is not far from the place of the least q.
const NOT_LONG: f64 = 4.0;

/// e⁻² as single precision has it, and log q - 2 less log(q BELOW).
const BELOW: f64 = 0.135_335_281_491_279_6;
const SHIFT: f64 = 1.289_636_419_532_961_3e-8;

impl Integrator<'_> {
    /// ∫ p q^(n/2) for odd n ≥ -1 by (n + 1 + k) ∫ σᵏ q^(n/2) = [σᵏ⁻¹ q^(n/2) Q] - (k - 1) (D/a²) ∫ σᵏ⁻² q^(n/2), from the highest
    /// degree down.
    pub(super) fn beside_root(
        &mut self,
        bowl: &Bowl,
        polynomials: &[Id],
        degree: u32,
        n: i32,
    ) -> Id {
        let mut left = self.taylor_pairs(polynomials, degree, bowl);
        let spread = self.spread(bowl);
        let order = |k: u32| u32::try_from(n + 1).unwrap_or(0) + k;
        let mut known = Vec::new();
        for k in (1..=degree as usize).rev() {
            #[allow(clippy::cast_possible_truncation, reason = "a degree of at most 12")]
            let own = k as u32;
            let part = left[k].part(self.g, order(own));
            if k > 1 {
                let rest = scale(self.g, f64::from(own - 1), spread.value);
                let rest = Pair::exact(self.g, rest);
                let fall = part.times(self.g, rest).negated(self.g);
                left[k - 2] = left[k - 2].plus(self.g, fall);
            }
            known.push(part);
        }
        known.reverse();
        let last = left[0];
        let ends = [0, 1].map(|end| {
            let offset = self.offset_pair(bowl, end);
            let sum = self.polynomial_of_pair(&known, offset);
            if n < 0 {
                let sum = sum.total(self.g);
                let root = self.half_power(bowl.ends[end], n + 2);
                let product = mul(self.g, sum, root);
                return self.g.div(product, bowl.q.a);
            }
            let base = offset.squared(self.g).plus(self.g, spread);
            let own = last.part(self.g, order(0)).times(self.g, offset);
            let sum = sum.times(self.g, base).plus(self.g, own).total(self.g);
            let power = self.half_power(bowl.ends[end], n);
            mul(self.g, sum, power)
        });
        let beside = self.g.sub(ends[1], ends[0]);
        let last = last.total(self.g);
        let rest = if n < 0 {
            let whole = self.reciprocal_root(bowl);
            let product = mul(self.g, last, whole);
            self.none_of(last, product)
        } else {
            // (n + 1) ∫ q^(n/2) = [σ q^(n/2)] + n (D/a) ∫ q^(n/2 - 1)
            let depth = self.g.div(bowl.q.discriminant, bowl.q.a);
            let lower = self.power_by_parts(bowl, n - 2);
            let product = mul(self.g, depth, lower);
            let product = mul(self.g, last, product);
            scale(self.g, f64::from(n) / f64::from(n + 1), product)
        };
        self.g.add(beside, rest)
    }

    /// ∫ p log q = [(P - β) log q - 2 S] - 2 α a ∫ 1/q with the antiderivative P of p that is 0 at s₀, and σ P/Q = S' + (α + β σ)/Q.
    pub(super) fn beside_log(&mut self, bowl: &Bowl, polynomials: &[Id], degree: u32) -> Id {
        let coefficients = self.taylor_pairs(polynomials, degree, bowl);
        let spread = self.spread(bowl);
        let zero = self.g.real(0.0);
        let none = Pair::exact(self.g, zero);
        // P from σ on, and σ P from the constant on
        let antiderivative: Vec<Pair> = (1..)
            .zip(&coefficients)
            .map(|(k, c)| c.part(self.g, k))
            .collect();
        let mut left = vec![none, none];
        left.extend(&antiderivative);
        let mut quotient = Vec::new();
        for j in (2..left.len()).rev() {
            let fall = left[j].times(self.g, spread).negated(self.g);
            left[j - 2] = left[j - 2].plus(self.g, fall);
            #[allow(clippy::cast_possible_truncation, reason = "a degree of at most 14")]
            let order = (j - 1) as u32;
            quotient.push(left[j].part(self.g, order));
        }
        quotient.reverse();
        let alpha = left[0].total(self.g);
        let floor = self.g.real(TINY);
        let ends = [0, 1].map(|end| {
            let offset = self.offset_pair(bowl, end);
            let value = self
                .polynomial_of_pair(&antiderivative, offset)
                .times(self.g, offset);
            let back = left[1].negated(self.g);
            let value = value.plus(self.g, back).total(self.g);
            let q = self.g.apply(Prim::Max, &[bowl.ends[end], floor]);
            let log = call(self.g, Prim::Log, q);
            let first = mul(self.g, value, log);
            let second = self
                .polynomial_of_pair(&quotient, offset)
                .times(self.g, offset);
            let second = second.total(self.g);
            let second = scale(self.g, 2.0, second);
            self.g.sub(first, second)
        });
        let beside = self.g.sub(ends[1], ends[0]);
        let angle = self.reciprocal(bowl);
        let rate = mul(self.g, alpha, bowl.q.a);
        let rest = mul(self.g, rate, angle);
        let rest = scale(self.g, 2.0, rest);
        let rest = self.none_of(alpha, rest);
        sub(self.g, beside, rest)
    }

    /// ∫ log q = [σ (log q - 2)] + 2 (D/a) ∫ 1/q. On an interval that is not long beside the distance from the zeros the last two terms
    /// cancel: there [σ log q] - 2 [σ z A₁(z)], z = a σ²/(D/a) and A₁(z) = (1 - atan(√z)/√z)/z.
    pub(super) fn log_alone(&mut self, bowl: &Bowl) -> Id {
        let offsets = [0, 1].map(|end| self.offset_pair(bowl, end).total(self.g));
        let depth = self.g.div(bowl.q.discriminant, bowl.q.a);
        let angle = self.reciprocal(bowl);
        let rest = mul(self.g, depth, angle);
        let far = self.none_of(bowl.q.discriminant, rest);
        let [one, scaled, zero, shift] = [1.0, BELOW, 0.0, SHIFT].map(|v| self.g.real(v));
        let (mut factor, mut shift, mut curved) = (scaled, shift, far);
        if bowl.is_sum_of_squares {
            let bent = self.g.div(bowl.q.a, depth);
            let squares = offsets.map(|s| square(self.g, s));
            let ratios = squares.map(|s| mul(self.g, bent, s));
            let parts = [0, 1].map(|end| {
                let moment = self.g.apply(Prim::AtanQuotient(1), &[ratios[end]]);
                let part = mul(self.g, ratios[end], moment);
                mul(self.g, offsets[end], part)
            });
            let near = self.g.sub(parts[0], parts[1]);
            let most = self.g.apply(Prim::Max, &ratios);
            let limit = self.g.real(NOT_LONG);
            let is_near = self.g.apply(Prim::Less, &[most, limit]);
            let mut choose = |a: Id, b: Id| self.g.apply(Prim::Select, &[is_near, a, b]);
            factor = choose(one, factor);
            shift = choose(zero, shift);
            curved = choose(near, curved);
        }
        let [first, last] = [0, 1].map(|end| {
            let log = self.log_at_end(bowl, end, (factor, shift));
            mul(self.g, offsets[end], log)
        });
        let beside = self.g.sub(last, first);
        let curved = scale(self.g, 2.0, curved);
        self.g.add(beside, curved)
    }

    /// log(q · factor) + shift at an end, with what q is rounded by.
    fn log_at_end(&mut self, bowl: &Bowl, end: usize, (factor, shift): (Id, Id)) -> Id {
        let q = self.pair_at_ends(bowl.q.of)[end];
        let q = if bowl.is_sum_of_squares {
            q
        } else {
            q.normalised(self.g)
        };
        let floor = self.g.real(TINY);
        let value = self.g.apply(Prim::Max, &[q.value, floor]);
        let q = Pair { value, ..q };
        let factor = Pair::exact(self.g, factor);
        let scaled = q.times(self.g, factor);
        let log = call(self.g, Prim::Log, scaled.value);
        let beside = div(self.g, scaled.rest, scaled.value);
        let beside = add(self.g, beside, shift);
        add(self.g, log, beside)
    }

    /// A product with a factor, 0 where that is 0: what it is multiplied by may be infinite there.
    fn none_of(&mut self, factor: Id, product: Id) -> Id {
        let zero = self.g.real(0.0);
        let is_none = self.g.apply(Prim::Equal, &[factor, zero]);
        self.g.apply(Prim::Select, &[is_none, zero, product])
    }

    /// D/a²
    fn spread(&mut self, bowl: &Bowl) -> Pair {
        let depth = self.g.div(bowl.q.discriminant, bowl.q.a);
        let spread = self.g.div(depth, bowl.q.a);
        Pair::exact(self.g, spread)
    }

    /// σ at an end: t less the place of the least q, with what both are rounded by.
    pub(super) fn offset_pair(&mut self, bowl: &Bowl, end: usize) -> Pair {
        let t = self.path.ends[end];
        let back = self.g.neg(bowl.q.foot);
        let value = add(self.g, t, back);
        let own = sum_rest(self.g, t, back, value);
        Pair {
            value,
            rest: sub(self.g, own, bowl.q.foot_low),
        }
    }

    /// The coefficients of a product of polynomials around the place of the least q, with their rests.
    fn taylor_pairs(&mut self, polynomials: &[Id], degree: u32, bowl: &Bowl) -> Vec<Pair> {
        let derivatives = self.derivatives(polynomials, degree);
        let whole = self.path.clone();
        let values = whole.pairs_beside(self.g, bowl.q.foot, bowl.q.foot_low);
        let mut factorial = 1;
        let mut out = Vec::new();
        for (k, &root) in (0_u32..).zip(&derivatives) {
            factorial *= k.max(1);
            let pair = match self.whole_pair(root, &values) {
                Some(pair) => pair,
                None => self.pair(root, &values),
            };
            out.push(pair.part(self.g, factorial));
        }
        out
    }

    /// Σ cₖ σᵏ
    fn polynomial_of_pair(&mut self, coefficients: &[Pair], offset: Pair) -> Pair {
        let mut sum: Option<Pair> = None;
        for &c in coefficients.iter().rev() {
            sum = Some(match sum {
                None => c,
                Some(sum) => sum.times(self.g, offset).plus(self.g, c),
            });
        }
        sum.unwrap_or_else(|| {
            let zero = self.g.real(0.0);
            Pair::exact(self.g, zero)
        })
    }
}
