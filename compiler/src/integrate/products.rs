//! Products of the reciprocals of two different polynomials of degree 1, or of two of degree 2.

use super::algebraic::{Bowl, NEAR_NODES};
use super::arithmetic::{add, call, div, if_less, mul, scale, square, sub};
use super::rule::Rule;
use super::term::{Factor, Term};
use super::{Integrator, Problem, Reason};
use crate::derive::forward;
use crate::ir::{Id, Prim, Ty};

/// How near the zeros of two quadratics are, as (D₁₂/√(D₁D₂))², where partial fractions begin to cancel.
const NEAR_ZEROS: f64 = 1.25 * 1.25;
/// Nodes over the pencil of two quadratics: (3 + √8)⁻¹⁶ is 6e-13.
const PENCIL_NODES: usize = 8;

impl Integrator<'_> {
    /// ∫ of the product of two powers, where both are reciprocals and of the same degree.
    pub(super) fn product_of_powers(
        &mut self,
        term: &Term,
        [(p, m), (q, n)]: [(Id, Id); 2],
    ) -> Result<(Id, Rule), Problem> {
        let are_reciprocals = [m, n].iter().all(|&e| self.g.as_real(e) == Some(-1.0));
        match (self.degree(p), self.degree(q)) {
            (Some(1), Some(1)) if are_reciprocals => {
                Ok((self.two_affine(p, q), Rule::ReciprocalProduct))
            }
            (Some(2), Some(2)) if are_reciprocals => {
                let integrand = term.moving(self.g);
                Ok((
                    self.two_quadratics(integrand, p, q),
                    Rule::ReciprocalProduct,
                ))
            }
            (Some(1), Some(2)) if are_reciprocals => {
                let integrand = term.moving(self.g);
                Ok((
                    self.affine_by_quadratic(integrand, p, q),
                    Rule::ReciprocalProduct,
                ))
            }
            (Some(2), Some(1)) if are_reciprocals => {
                let integrand = term.moving(self.g);
                Ok((
                    self.affine_by_quadratic(integrand, q, p),
                    Rule::ReciprocalProduct,
                ))
            }
            _ => Err(self.problem(term.source, Reason::NotFound)),
        }
    }

    /// ∫ 1/(x q) for x = α + β s, q = a s² + 2 b s + c, by partial fractions: with the resultant R = a α² - 2 b α β + c β²,
    /// R I = β (log(x₁/x₀) - log(q₁/q₀)/2) + (a α - b β) ∫ 1/q. On intervals on which both change little nodes of the
    /// product.
    fn affine_by_quadratic(&mut self, integrand: Id, affine: Id, base: Id) -> Id {
        let (x, bowl) = (self.affine(affine), self.bowl(base));
        let near = self.local_gauss(integrand, NEAR_NODES);
        let ratio = self.g.div(x.ends[1], x.ends[0]);
        let fall = self.g.div(bowl.ends[0], bowl.ends[1]);
        let turned = square(self.g, ratio);
        let turned = self.g.mul(turned, fall);
        let log = call(self.g, Prim::Log, turned);
        let log = scale(self.g, 0.5, log);
        let first = mul(self.g, x.slope, log);
        let (left, right) = (mul(self.g, bowl.q.a, x.mid), mul(self.g, bowl.q.b, x.slope));
        let bend = sub(self.g, left, right);
        let angle = self.reciprocal(&bowl);
        let second = mul(self.g, bend, angle);
        let sum = add(self.g, first, second);
        let resultant = self.resultant(base, &bowl.q, x);
        let far = self.g.div(sum, resultant);
        let half = self.path.half;
        let way = mul(self.g, x.slope, half);
        let [way, level] = [way, x.mid].map(|v| call(self.g, Prim::Abs, v));
        let level = scale(self.g, 0.5, level);
        let reach = call(self.g, Prim::Abs, bowl.reach);
        let limit = scale(self.g, 0.25, bowl.q.c);
        let short = [
            self.g.apply(Prim::Less, &[way, level]),
            self.g.apply(Prim::Less, &[reach, limit]),
        ];
        let is_short = self.g.apply(Prim::And, &short);
        let value = self.g.apply(Prim::Select, &[is_short, near, far]);
        // a zero of the linear one in the interval
        let (zero, nan) = (self.g.real(0.0), self.g.real(f64::NAN));
        let crossed = mul(self.g, x.ends[0], x.ends[1]);
        if_less(self.g, zero, crossed, value, nan)
    }

    /// ∫ 1/(x y) = L log1p(z)/z/(x₀ y₁), z = L (x' y - y' x)/(x₀ y₁), where the bracket is constant.
    fn two_affine(&mut self, p: Id, q: Id) -> Id {
        let (x, y) = (self.affine(p), self.affine(q));
        let (left, right) = (mul(self.g, x.slope, y.mid), mul(self.g, y.slope, x.mid));
        let bracket = sub(self.g, left, right);
        let length = self.length_of_path();
        let product = mul(self.g, x.ends[0], y.ends[1]);
        let mean = div(self.g, length, product);
        let z = mul(self.g, mean, bracket);
        let quotient = self.g.apply(Prim::Log1pRel(0), &[z]);
        let value = mul(self.g, mean, quotient);
        // a zero of one of them in the interval
        let zero = self.g.real(0.0);
        let nan = self.g.real(f64::NAN);
        let mut out = value;
        for a in [x, y] {
            let crossed = mul(self.g, a.ends[0], a.ends[1]);
            out = if_less(self.g, zero, crossed, out, nan);
        }
        out
    }

    /// ∫ 1/(q r): partial fractions, seen from the place of the least of the steeper quadratic; where the zeros of both
    /// are near one another, nodes over their pencil; on short intervals nodes of the product.
    fn two_quadratics(&mut self, integrand: Id, p: Id, q: Id) -> Id {
        let bowls = [p, q].map(|base| self.bowl(base));
        let near = self.local_gauss(integrand, NEAR_NODES);
        let far = self.partial_fractions([p, q], &bowls);
        let limits = bowls.map(|bowl| {
            let reach = call(self.g, Prim::Abs, bowl.reach);
            let limit = scale(self.g, 0.25, bowl.q.c);
            self.g.apply(Prim::Less, &[reach, limit])
        });
        let is_short = self.g.apply(Prim::And, &limits);
        self.g.apply(Prim::Select, &[is_short, near, far])
    }

    /// With s from the place where the first is least, so that its b is 0 and its c is D/a: α = a₁ b₂,
    /// β = a₁ c₂ - a₂ c₁, and the resultant R = β² + 4 D₁ b₂², a sum of squares:
    /// R I = α [log(q₂/q₁)] + a₁ β ∫ 1/q₁ + (2 α b₂ - a₂ β) ∫ 1/q₂.
    fn partial_fractions(&mut self, bases: [Id; 2], bowls: &[Bowl; 2]) -> Id {
        let rates = bases.map(|base| self.slope(base));
        // the first is the steeper: the distance √D/a of its zeros from the line is less
        let steep = [0, 1].map(|k| {
            let rate = square(self.g, bowls[1 - k].q.a);
            mul(self.g, rate, bowls[k].q.discriminant)
        });
        let is_less = self.g.apply(Prim::Less, &steep);
        // of a constant one neither is
        let is_open = self.g.apply(Prim::LessEqual, &steep);
        let is_curved = self.g.apply(Prim::Less, &[bowls[1].q.a, bowls[0].q.a]);
        let is_tie = self.g.apply(Prim::And, &[is_open, is_curved]);
        let is_first = self.g.apply(Prim::Or, &[is_less, is_tie]);
        let mut choose = |of: [Id; 2]| {
            [[of[0], of[1]], [of[1], of[0]]]
                .map(|pair| self.g.apply(Prim::Select, &[is_first, pair[0], pair[1]]))
        };
        let [a1, a2] = choose([bowls[0].q.a, bowls[1].q.a]);
        let [d1, d2] = choose([bowls[0].q.discriminant, bowls[1].q.discriminant]);
        let [foot, _] = choose([bowls[0].q.foot, bowls[1].q.foot]);
        let ends = [0, 1].map(|k| choose([bowls[0].ends[k], bowls[1].ends[k]]));
        let chords = choose([bowls[0].q.chord, bowls[1].q.chord]);
        let there = self.at_place(&[bases[0], bases[1], rates[0], rates[1]], foot);
        let c2 = self.g.apply(Prim::Select, &[is_first, there[1], there[0]]);
        let rate = self.g.apply(Prim::Select, &[is_first, there[3], there[2]]);
        let b2 = scale(self.g, 0.5, rate);
        let integrals = [0, 1].map(|k| self.reciprocal(&bowls[k]));
        let [r1, r2] = [[integrals[0], integrals[1]], [integrals[1], integrals[0]]]
            .map(|pair| self.g.apply(Prim::Select, &[is_first, pair[0], pair[1]]));
        let c1 = self.g.div(d1, a1);
        let alpha = mul(self.g, a1, b2);
        let (left, right) = (mul(self.g, a1, c2), mul(self.g, a2, c1));
        let (beta, twice_mixed) = (sub(self.g, left, right), add(self.g, left, right));
        let resultant = {
            let (first, second) = (square(self.g, beta), square(self.g, b2));
            let second = mul(self.g, d1, second);
            let second = scale(self.g, 4.0, second);
            add(self.g, first, second)
        };
        let ratios = ends.map(|[one, other]| self.g.div(other, one));
        let ratio = self.g.div(ratios[1], ratios[0]);
        let log = call(self.g, Prim::Log, ratio);
        let first = mul(self.g, alpha, log);
        let weight = mul(self.g, a1, beta);
        let second = mul(self.g, weight, r1);
        let (turn, level) = (mul(self.g, alpha, b2), mul(self.g, a2, beta));
        let turn = scale(self.g, 2.0, turn);
        let weight = sub(self.g, turn, level);
        let third = mul(self.g, weight, r2);
        let sum = add(self.g, first, second);
        let sum = add(self.g, sum, third);
        let far = self.g.div(sum, resultant);
        let near = self.over_the_pencil([a1, a2], [d1, d2], chords, twice_mixed);
        let mixed = scale(self.g, 0.5, twice_mixed);
        let mixed = square(self.g, mixed);
        let product = mul(self.g, d1, d2);
        let limit = scale(self.g, NEAR_ZEROS, product);
        if_less(self.g, mixed, limit, near, far)
    }

    /// 1/(q r) = ∫ 1/((1 - t) q + t r)² dt over [0, 1] (Feynman), of both divided by the roots of their discriminants:
    /// then D is 1 + 2 (k - 1) t (1 - t), k = D₁₂/√(D₁D₂) the hyperbolic cosine of the distance of the zeros in the
    /// upper half-plane, and for k < 5/4 the integrand has its singularities beyond -1 and 2. ∫ 1/q² is
    /// L (1/(E² + DL²) - a L² ∂ₚ), ∂ₚ the derivative of atan2(√p, E)/√p at p = D L².
    fn over_the_pencil(&mut self, a: [Id; 2], d: [Id; 2], chords: [Id; 2], twice_mixed: Id) -> Id {
        let roots = d.map(|d| call(self.g, Prim::Sqrt, d));
        let product = self.g.mul(roots[0], roots[1]);
        let (one, length) = (self.g.real(1.0), self.length_of_path());
        let twice = self.g.div(twice_mixed, product);
        let two = self.g.real(2.0);
        // 2 (k - 1)
        let excess = self.g.sub(twice, two);
        let square_length = square(self.g, length);
        let [a, chords] = [a, chords].map(|of| [0, 1].map(|k| self.g.div(of[k], roots[k])));
        let (p_leaf, x_leaf) = (self.g.new_variable(Ty::Real), self.g.new_variable(Ty::Real));
        let quotient = self.g.apply(Prim::Atan2Quotient, &[p_leaf, x_leaf]);
        let slope = forward(self.g, &[quotient], &[(p_leaf, one)]);
        let Some(slope) = slope.ok().and_then(|s| s[0]) else {
            return self.g.real(f64::NAN);
        };
        let body = super::path::Body::new(self.g, &[slope], [p_leaf, x_leaf].into_iter());
        let mut sum = self.g.real(0.0);
        for node in super::gauss_legendre(PENCIL_NODES) {
            for t in [0.5 - 0.5 * node.place, 0.5 + 0.5 * node.place] {
                let mut mixed = |of: [Id; 2]| {
                    let parts = [scale(self.g, 1.0 - t, of[0]), scale(self.g, t, of[1])];
                    add(self.g, parts[0], parts[1])
                };
                let (rate, chord) = (mixed(a), mixed(chords));
                let bump = scale(self.g, t * (1.0 - t), excess);
                let depth = self.g.add(one, bump);
                let p = self.g.mul(depth, square_length);
                let base = self.g.apply(Prim::SquarePlus, &[chord, p]);
                let first = self.g.div(one, base);
                let slope = body.at(self.g, &[(p_leaf, p), (x_leaf, chord)])[0];
                let second = self.g.mul(square_length, slope);
                let second = mul(self.g, rate, second);
                let value = self.g.sub(first, second);
                let value = scale(self.g, 0.5 * node.weight, value);
                sum = add(self.g, sum, value);
            }
        }
        let mean = self.g.div(sum, product);
        mul(self.g, length, mean)
    }
}

/// Two powers and nothing else.
pub(super) fn pair_of_powers(factors: &[Factor]) -> Option<[(Id, Id); 2]> {
    match *factors {
        [Factor::Power(p, m), Factor::Power(q, n)] => Some([(p, m), (q, n)]),
        _ => None,
    }
}
