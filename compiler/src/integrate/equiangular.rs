//! Negative powers of quadratics, alone and beside polynomials, over the angle at their zero.

use super::Integrator;
use super::algebraic::{Bowl, TINY};
use super::arithmetic::{add, call, if_less, mul, scale, square, sub};
use super::exponential::NEAR;
use super::legendre::nodes_for_exponential;
use crate::ir::{Id, Prim};

/// The hyperbolic angle up to which nodes over the angle are right.
const HYPERBOLIC: f64 = 4.0;

/// Where a quadratic is least in an interval: t, its value, and half its slope.
pub(super) struct Least {
    pub place: Id,
    pub value: Id,
    pub slope: Id,
}

impl Integrator<'_> {
    /// ∫ p q^(n/2) dt = ∫ p q^(n/2 + 1) du by u = ∫ dt/q from the place of the least q in the interval, which is the
    /// angle under which the way is seen from the zero of q, over √D. There t - t₀ = c u sinc(√D u)/B and q = c/B²
    /// with B = cos(√D u) - b u sinc(√D u), hyperbolic where D < 0, c and b the value and half the slope of q at that place: what remains is
    /// a polynomial in sin and cos of degree k = -n - 2, for which nodes over the angle are enough.
    ///
    /// Kulla and Fajardo, "Importance sampling techniques for path tracing in participating media", 2012, for the map.
    pub(super) fn equiangular(&mut self, bowl: &Bowl, polynomials: &[Id], k: u32) -> Id {
        let (least, ends, whole) = self.least(bowl);
        let sum = self.g.add(ends[0], ends[1]);
        let (middle, reach) = (scale(self.g, 0.5, sum), scale(self.g, 0.5, whole));
        let value = self.over_the_angle(bowl, polynomials, k, &least, [middle, reach]);
        if polynomials.is_empty() {
            self.through_zero_of(bowl, value)
        } else {
            value
        }
    }

    /// ∞ with the sign of the interval where it passes the double zero of q.
    fn through_zero_of(&mut self, bowl: &Bowl, value: Id) -> Id {
        let zero = self.g.real(0.0);
        let product = self.g.mul(bowl.q.slopes[0], bowl.q.slopes[1]);
        let inside = self.g.apply(Prim::LessEqual, &[product, zero]);
        let curved = self.g.apply(Prim::Less, &[zero, bowl.q.a]);
        let double = self.g.apply(Prim::Equal, &[bowl.q.discriminant, zero]);
        let meets = self.g.apply(Prim::And, &[inside, double]);
        let meets = self.g.apply(Prim::And, &[meets, curved]);
        // not where the discriminant is too small for the format
        let is_none = self.g.apply(Prim::NotEqual, &[value, value]);
        let meets = self.g.apply(Prim::And, &[meets, is_none]);
        let infinity = self.g.real(f64::INFINITY);
        let all = self.g.mul(infinity, self.path.half);
        self.g.apply(Prim::Select, &[meets, all, value])
    }

    /// The same between two angles, counted from the place of the least |q|: their mean, and half of their difference.
    pub(super) fn over_the_angle(
        &mut self,
        bowl: &Bowl,
        polynomials: &[Id],
        k: u32,
        least: &Least,
        [middle, reach]: [Id; 2],
    ) -> Id {
        let size = if bowl.is_sum_of_squares {
            // where D is 0 it is least, and its root has no derivative
            let floor = self.g.real(TINY);
            self.g.apply(Prim::Max, &[bowl.q.discriminant, floor])
        } else {
            call(self.g, Prim::Abs, bowl.q.discriminant)
        };
        let root = call(self.g, Prim::Sqrt, size);
        let one = self.g.real(1.0);
        let product = polynomials
            .iter()
            .fold(one, |product, &p| mul(self.g, product, p));
        let exponent = i32::try_from(k).unwrap_or(0);
        // a hyperbolic angle may be greater: of 4 beside a zero at which |q| is 1e-3 of what it is in the middle
        let angle = if bowl.is_sum_of_squares {
            std::f64::consts::FRAC_PI_2
        } else {
            HYPERBOLIC
        };
        let count = nodes_for_exponential(angle * f64::from(k), 0, NEAR);
        let mut sum = self.g.real(0.0);
        for node in super::gauss_legendre(count) {
            let sides: &[f64] = if node.place == 0.0 {
                &[1.0]
            } else {
                &[1.0, -1.0]
            };
            for &side in sides {
                let offset = scale(self.g, side * node.place, reach);
                let u = add(self.g, middle, offset);
                let turn = mul(self.g, root, u);
                let sine = self.round_or_not(bowl, Prim::Sinc, Prim::Sinhc, turn);
                let cosine = self.round_or_not(bowl, Prim::Cos, Prim::Cosh, turn);
                let step = mul(self.g, u, sine);
                let down = mul(self.g, least.slope, step);
                let base = sub(self.g, cosine, down);
                let mut value = self.g.apply(Prim::PowInt(exponent), &[base]);
                if product != one {
                    let top = mul(self.g, least.value, step);
                    let offset = self.g.div(top, base);
                    let t = self.g.add(least.place, offset);
                    let factor = self.at_place(&[product], t)[0];
                    value = mul(self.g, value, factor);
                }
                let value = scale(self.g, node.weight, value);
                sum = add(self.g, sum, value);
            }
        }
        let size = self.half_power(least.value, exponent);
        let mean = self.g.div(sum, size);
        mul(self.g, reach, mean)
    }

    /// A function of √D u, and the one that it is of √-D u where D may be negative.
    fn round_or_not(&mut self, bowl: &Bowl, round: Prim, other: Prim, turn: Id) -> Id {
        let value = call(self.g, round, turn);
        if bowl.is_sum_of_squares {
            return value;
        }
        let grown = call(self.g, other, turn);
        let zero = self.g.real(0.0);
        if_less(self.g, bowl.q.discriminant, zero, grown, value)
    }

    /// The place of the least |q| in the interval, ∫ dt/q from there to both ends, and between the ends. Between two zeros
    /// that is the end that is nearer to one: there the integrand is greatest, and the angle is rounded least.
    fn least(&mut self, bowl: &Bowl) -> (Least, [Id; 2], Id) {
        let q = bowl.q;
        let zero = self.g.real(0.0);
        let sign = self.sign_of(bowl);
        let product = self.g.mul(q.slopes[0], q.slopes[1]);
        let mut inside = self.g.apply(Prim::Less, &[product, zero]);
        if !bowl.is_sum_of_squares {
            let curve = mul(self.g, sign, q.a);
            let opens = self.g.apply(Prim::Less, &[zero, curve]);
            inside = self.g.apply(Prim::And, &[inside, opens]);
        }
        let sizes = q.ends.map(|end| mul(self.g, sign, end));
        let first = self.g.apply(Prim::Less, &sizes);
        let choose = |this: &mut Self, foot: Id, ends: [Id; 2]| {
            let end = this.g.apply(Prim::Select, &[first, ends[0], ends[1]]);
            this.g.apply(Prim::Select, &[inside, foot, end])
        };
        let depth = self.g.div(q.discriminant, q.a);
        let value = choose(self, depth, q.ends);
        let slope = choose(self, zero, q.slopes);
        let place = choose(self, q.foot, self.path.ends);
        let whole = self.reciprocal(bowl);
        let back = self.g.neg(whole);
        let offsets = self.offsets(bowl);
        let beside = [[zero, back], [whole, zero]];
        let size = mul(self.g, sign, depth);
        let angles = [0, 1].map(|k| {
            let s = offsets[k];
            let square_s = square(self.g, s);
            let p = mul(self.g, q.discriminant, square_s);
            let quotient = self.angle_between(bowl, (p, size), [size, sizes[k]]);
            let quotient = mul(self.g, sign, quotient);
            let around = mul(self.g, s, quotient);
            choose(self, around, beside[k])
        });
        (
            Least {
                place,
                value,
                slope,
            },
            angles,
            whole,
        )
    }
}
