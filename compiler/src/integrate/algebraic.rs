//! Powers and logarithms of quadratics, alone and beside polynomials.
//!
//! q = a s² + 2 b s + c with the discriminant D = a c - b², r₀ and r₁ the roots of q at the ends, E = c - a h²,
//! s₀ = -b/a the place of the least q, σ = s - s₀. Each rule has a form for short intervals, |a| h² < c/4, in which
//! the zeros of q are further from the middle than 2h: there nodes of Gauss and Legendre take the integrand as it is;
//! or its form holds everywhere.

use super::arithmetic::{add, call, if_less, mul, scale, square, sub, total};
use super::quadratic::Quadratic;
use super::rule::Rule;
use super::{Integrator, Problem, Reason};
use crate::ir::{Id, Prim};

/// Greatest degree of a polynomial beside a power.
pub const MAX_DEGREE_BESIDE_POWER: u32 = 12;
/// Nodes on intervals whose nearest singularity is 2h from the middle: (2 + √3)⁻²⁴ is 2e-14.
pub(super) const NEAR_NODES: usize = 12;
/// The same of moments, which cancel around a foot that is not far from an interval with a zero of the polynomial: nodes
/// where the nearest singularity is 1.29h from the middle, 2.1⁻³² is 5e-11.
const NEAR_NODES_OF_MOMENTS: usize = 16;
/// (1/1.29)²
const REACH_OF_MOMENTS: f64 = 0.6;
/// a h² as a part of (r₀ + r₁)² where the zeros are on the same ellipse, the semi-axes of which add up to 2.1h.
const SUM_OF_MOMENTS: f64 = 0.15;
/// Below it a quadratic counts as 0 where its logarithm is multiplied by 0.
pub(super) const TINY: f64 = 1e-37;

/// A quadratic with what its rules share.
#[derive(Clone, Copy)]
pub(super) struct Bowl {
    pub q: Quadratic,
    /// a h²
    pub reach: Id,
    /// Length of the interval with its sign.
    pub length: Id,
    /// Values at both ends; what is below 0 by a rounding is 0.
    pub ends: [Id; 2],
    /// Whether it is known to be nowhere negative.
    pub is_sum_of_squares: bool,
    /// Whether a is known to be not negative.
    opens_up: bool,
}

impl Integrator<'_> {
    /// ∫ of a polynomial times a power of a quadratic, exponent a whole multiple of 1/2.
    pub(super) fn quadratic_power(
        &mut self,
        source: Id,
        polynomials: &[Id],
        base: Id,
        exponent: Id,
    ) -> Result<(Id, Rule), Problem> {
        let not_found = |this: &Self| this.problem(source, Reason::NotFound);
        let twice = self
            .g
            .as_real(exponent)
            .map(|r| 2.0 * r)
            .filter(|r| r.fract() == 0.0 && r.abs() <= 24.0);
        let Some(twice) = twice else {
            return Err(self.problem(source, Reason::Hypergeometric));
        };
        #[allow(
            clippy::cast_possible_truncation,
            reason = "a whole number of at most 24"
        )]
        let twice = twice as i32;
        let degree = self.polynomial_degree(polynomials);
        if degree > MAX_DEGREE_BESIDE_POWER {
            return Err(self.bound_beside(source));
        }
        let whole = self.path.clone();
        if !polynomials.is_empty() {
            self.path = whole.rebased(self.g);
        }
        let bowl = self.bowl(base);
        let found = match (twice, degree) {
            (-2, 0) => Ok((self.reciprocal(&bowl), Rule::Reciprocal)),
            (-1, 0) => Ok((self.reciprocal_root(&bowl), Rule::ReciprocalRoot)),
            (1, 0) => Ok((self.root_alone(&bowl), Rule::Root)),
            (-3, 0) => Ok((self.reciprocal_cube(&bowl), Rule::ReciprocalCube)),
            (-4, 0) => Ok((self.reciprocal_square(&bowl), Rule::ReciprocalSquare)),
            (..=-3, m) if i64::from(m) <= i64::from(-twice - 2) => {
                let k = twice.unsigned_abs().saturating_sub(2);
                Ok((self.equiangular(&bowl, polynomials, k), Rule::Equiangular))
            }
            (-3, _) | (-2.., _) => {
                let far = match (twice, degree) {
                    (..=-2, _) => self.moments(&bowl, polynomials, degree, twice),
                    (_, 0) => self.power_by_parts(&bowl, twice),
                    _ => self.beside_root(&bowl, polynomials, degree, twice),
                };
                let integrand =
                    self.beside(polynomials, super::term::Factor::Power(base, exponent));
                Ok((
                    self.near_or(&bowl, integrand, degree, far),
                    Rule::PolynomialByPower,
                ))
            }
            _ => Err(not_found(self)),
        };
        self.path = whole;
        found
    }

    pub(super) fn bound_beside(&self, source: Id) -> Problem {
        let bound = MAX_DEGREE_BESIDE_POWER as usize;
        self.problem(
            source,
            Reason::Bound(
                "degrees of a polynomial beside a power or a logarithm",
                bound,
            ),
        )
    }

    /// ∫ of a polynomial times the logarithm of a quadratic.
    pub(super) fn quadratic_log(
        &mut self,
        source: Id,
        polynomials: &[Id],
        base: Id,
    ) -> Result<(Id, Rule), Problem> {
        let degree = self.polynomial_degree(polynomials);
        if degree > MAX_DEGREE_BESIDE_POWER {
            return Err(self.bound_beside(source));
        }
        let whole = self.path.clone();
        self.path = whole.rebased(self.g);
        self.splits_constants = true;
        let bowl = self.bowl(base);
        let far = if polynomials.is_empty() {
            self.log_alone(&bowl)
        } else {
            self.beside_log(&bowl, polynomials, degree)
        };
        let integrand = self.beside(polynomials, super::term::Factor::Log(base));
        let value = self.near_or(&bowl, integrand, degree, far);
        self.splits_constants = false;
        self.path = whole;
        Ok((value, Rule::LogQuadratic))
    }

    pub(super) fn beside(&mut self, polynomials: &[Id], factor: super::term::Factor) -> Id {
        let value = factor.expression(self.g);
        polynomials
            .iter()
            .fold(value, |product, &p| mul(self.g, product, p))
    }

    pub(super) fn bowl(&mut self, base: Id) -> Bowl {
        let q = self.quadratic(base);
        let half = self.path.half;
        let square_half = square(self.g, half);
        let rounding = scale(self.g, 1e-6, q.c);
        let ends = q.ends.map(|end| {
            let size = call(self.g, Prim::Abs, end);
            if_less(self.g, size, rounding, size, end)
        });
        Bowl {
            q,
            reach: mul(self.g, q.a, square_half),
            length: self.length_of_path(),
            ends,
            is_sum_of_squares: self.is_sum_of_squares(base),
            opens_up: self.opens_up(base),
        }
    }

    /// The nodes of the integrand where the interval is short, else the other form. Of what is divided by a sum of squares they are
    /// seen from the end where that is least.
    fn near_or(&mut self, bowl: &Bowl, integrand: Id, degree: u32, far: Id) -> Id {
        let (nodes, share) = if degree == 0 {
            (NEAR_NODES, 0.25)
        } else {
            (NEAR_NODES_OF_MOMENTS, REACH_OF_MOMENTS)
        };
        let near = self.gauss_of_bowl(integrand, bowl, nodes + degree.div_ceil(2) as usize);
        let reach = call(self.g, Prim::Abs, bowl.reach);
        let mut limit = scale(self.g, share, bowl.q.c);
        if !bowl.is_sum_of_squares {
            limit = call(self.g, Prim::Abs, limit);
        } else if degree > 0 {
            // the zeros are (r₀ + r₁)/√a from both ends together: on an ellipse around them
            let (_, sum) = self.roots(bowl);
            let sum = square(self.g, sum);
            limit = scale(self.g, SUM_OF_MOMENTS, sum);
        }
        if_less(self.g, reach, limit, near, far)
    }

    /// D L²
    pub(super) fn width_of_triangle(&mut self, bowl: &Bowl) -> Id {
        let square_length = square(self.g, bowl.length);
        mul(self.g, bowl.q.discriminant, square_length)
    }

    /// The sign of q in the middle, which is that of all of an integral that has a value, 1 where it is known.
    pub(super) fn sign_of(&mut self, bowl: &Bowl) -> Id {
        let one = self.g.real(1.0);
        if bowl.is_sum_of_squares {
            return one;
        }
        let (zero, less) = (self.g.real(0.0), self.g.real(-1.0));
        if_less(self.g, bowl.q.c, zero, less, one)
    }

    /// ∫ 1/q = L atan2(√(D L²), E)/√(D L²), which is one formula through D = 0; of -q where q is negative. Beside a pole
    /// (L/√(-D L²)) log((E + √(-D L²))/√(q₀ q₁)), as q₀ q₁ = E² + D L².
    pub(super) fn reciprocal(&mut self, bowl: &Bowl) -> Id {
        let sign = self.sign_of(bowl);
        let e = mul(self.g, sign, bowl.q.chord);
        let p = self.width_of_triangle(bowl);
        let ends = bowl.ends.map(|q| mul(self.g, sign, q));
        let quotient = self.angle_between(bowl, (p, e), ends);
        let length = mul(self.g, sign, bowl.length);
        let value = mul(self.g, length, quotient);
        match bowl.q.passing {
            Some(passing) => {
                let beside = self.reciprocal_beside(bowl, passing);
                self.where_it_passes(bowl, beside, value)
            }
            None => value,
        }
    }

    /// ∫ dt/q over its length, by p = D L², E and the values of q at both ends, none of which is negative.
    pub(super) fn angle_between(&mut self, bowl: &Bowl, (p, e): (Id, Id), ends: [Id; 2]) -> Id {
        let quotient = self.g.apply(Prim::Atan2Quotient, &[p, e]);
        if bowl.is_sum_of_squares {
            return quotient;
        }
        // beside a pole E² and -D L² are nearly the same, and what is left is the product of the ends
        let back = self.g.neg(p);
        let root = call(self.g, Prim::Sqrt, back);
        let sum = add(self.g, e, root);
        let roots = ends.map(|q| call(self.g, Prim::Sqrt, q));
        let product = mul(self.g, roots[0], roots[1]);
        let ratio = self.g.div(sum, product);
        let log = call(self.g, Prim::Log, ratio);
        let beside = self.g.div(log, root);
        let reach = square(self.g, e);
        let limit = scale(self.g, 0.5, reach);
        if_less(self.g, limit, back, beside, quotient)
    }

    pub(super) fn roots(&mut self, bowl: &Bowl) -> ([Id; 2], Id) {
        let roots = bowl.ends.map(|q| call(self.g, Prim::Sqrt, q));
        (roots, self.g.add(roots[0], roots[1]))
    }

    /// r₀ r₁ + E, which is D L²/(r₀ r₁ - E) where E < 0.
    pub(super) fn width(&mut self, bowl: &Bowl, roots: [Id; 2]) -> Id {
        let e = bowl.q.chord;
        let product = mul(self.g, roots[0], roots[1]);
        let sum = add(self.g, product, e);
        let square_length = square(self.g, bowl.length);
        let p = mul(self.g, bowl.q.discriminant, square_length);
        let difference = sub(self.g, product, e);
        let quotient = self.g.div(p, difference);
        let zero = self.g.real(0.0);
        if_less(self.g, e, zero, quotient, sum)
    }

    /// Of q of any curvature: ∫ 1/√q = 2 L atan2(√(-a) L, r₀ + r₁)/(√(-a) L), and where E < 0 the logarithm that this is,
    /// (2/√a) log((r₀ + r₁ + √a L)/√(2 (r₀ r₁ + E))).
    pub(super) fn reciprocal_root(&mut self, bowl: &Bowl) -> Id {
        if bowl.opens_up {
            return self.reciprocal_root_of_bowl(bowl);
        }
        let (roots, sum) = self.roots(bowl);
        let square_length = square(self.g, bowl.length);
        let p = mul(self.g, bowl.q.a, square_length);
        let p = self.g.neg(p);
        let quotient = self.g.apply(Prim::Atan2Quotient, &[p, sum]);
        let product = mul(self.g, bowl.length, quotient);
        let open = scale(self.g, 2.0, product);
        let width = self.width(bowl, roots);
        let around = self.log_form(bowl, sum, width);
        self.is_long(bowl, around, open)
    }

    fn log_form(&mut self, bowl: &Bowl, sum: Id, width: Id) -> Id {
        let root = call(self.g, Prim::Sqrt, bowl.q.a);
        let size = call(self.g, Prim::Abs, bowl.length);
        let along = mul(self.g, root, size);
        let top = self.g.add(sum, along);
        let double = scale(self.g, 2.0, width);
        let bottom = call(self.g, Prim::Sqrt, double);
        let ratio = self.g.div(top, bottom);
        let log = call(self.g, Prim::Log, ratio);
        let double = scale(self.g, 2.0, log);
        let value = self.g.div(double, root);
        let sign = call(self.g, Prim::Sign, bowl.length);
        mul(self.g, sign, value)
    }

    /// Of q of any curvature: ∫ √q = L (S/4 + c G - (r₁ - r₀)² A₁(-z)/(4 S)), z = a L²/S², S = r₀ + r₁, G the quotient of the reciprocal root;
    /// where E < 0 by parts.
    fn root_alone(&mut self, bowl: &Bowl) -> Id {
        if bowl.opens_up {
            return self.root_of_bowl(bowl);
        }
        let (roots, sum) = self.roots(bowl);
        let floor = self.g.real(1e-12);
        let safe = self.g.apply(Prim::Max, &[sum, floor]);
        let square_length = square(self.g, bowl.length);
        let p = mul(self.g, bowl.q.a, square_length);
        let p = self.g.neg(p);
        let quotient = self.g.apply(Prim::Atan2Quotient, &[p, safe]);
        let ratio = self.g.div(bowl.length, safe);
        let ratio = square(self.g, ratio);
        let z = mul(self.g, bowl.q.a, ratio);
        let z = self.g.neg(z);
        let moment = self.g.apply(Prim::AtanQuotient(1), &[z]);
        let difference = self.g.sub(roots[1], roots[0]);
        let difference = square(self.g, difference);
        let difference = self.g.div(difference, safe);
        let correction = mul(self.g, difference, moment);
        let (quarter, correction) = (scale(self.g, 0.25, sum), scale(self.g, 0.25, correction));
        let middle = mul(self.g, bowl.q.c, quotient);
        let mean = add(self.g, quarter, middle);
        let mean = sub(self.g, mean, correction);
        let open = mul(self.g, bowl.length, mean);
        let around = self.power_by_parts(bowl, 1);
        self.is_long(bowl, around, open)
    }

    /// ∫ q^(-3/2) = L (r₀ + r₁)/(r₀ r₁ (r₀ r₁ + E)).
    fn reciprocal_cube(&mut self, bowl: &Bowl) -> Id {
        let (roots, sum) = self.roots(bowl);
        let width = self.width(bowl, roots);
        let product = mul(self.g, roots[0], roots[1]);
        let top = self.g.div(sum, product);
        let mean = self.g.div(top, width);
        mul(self.g, bowl.length, mean)
    }

    /// σ = t - t₀ at both ends, t₀ the place of the least q.
    pub(super) fn offsets(&mut self, bowl: &Bowl) -> [Id; 2] {
        if !bowl.opens_up {
            // slopes and a may cancel
            return [0, 1].map(|end| self.offset_pair(bowl, end).total(self.g));
        }
        bowl.q.slopes.map(|b| self.g.div(b, bowl.q.a))
    }

    /// Whether a h² is more than three tenths of c: the interval is so long that antiderivatives do not cancel.
    fn is_long(&mut self, bowl: &Bowl, then: Id, otherwise: Id) -> Id {
        let limit = scale(self.g, 0.7, bowl.q.c);
        if_less(self.g, bowl.q.chord, limit, then, otherwise)
    }

    /// ∫ q^(n/2) for n > 0 by parts down to the root or to the reciprocal root:
    /// (n + 1) I = [σ q^(n/2)] + n (D/a) I of n - 2.
    pub(super) fn power_by_parts(&mut self, bowl: &Bowl, n: i32) -> Id {
        let offsets = self.offsets(bowl);
        let depth = self.g.div(bowl.q.discriminant, bowl.q.a);
        let (roots, _) = self.roots(bowl);
        let mut value = self.around_root(bowl);
        let mut k = 1;
        while k <= n {
            let ends = [0, 1].map(|i| {
                let power = self.g.apply(Prim::PowInt(k), &[roots[i]]);
                mul(self.g, offsets[i], power)
            });
            let ends = self.g.sub(ends[1], ends[0]);
            let rest = mul(self.g, depth, value);
            let rest = scale(self.g, f64::from(k), rest);
            let sum = self.g.add(ends, rest);
            value = scale(self.g, 1.0 / (f64::from(k) + 1.0), sum);
            k += 2;
        }
        value
    }

    /// ∫ 1/√q by the logarithm that is finite where D = 0: what it is multiplied by is 0 there.
    fn around_root(&mut self, bowl: &Bowl) -> Id {
        let (roots, sum) = self.roots(bowl);
        let width = self.width(bowl, roots);
        let least = square(self.g, sum);
        let least = scale(self.g, 1e-30, least);
        let floor = self.g.real(TINY);
        let least = self.g.apply(Prim::Max, &[least, floor]);
        let width = self.g.apply(Prim::Max, &[width, least]);
        if bowl.opens_up {
            return self.by_width(bowl, sum, width);
        }
        let log = self.log_form(bowl, sum, width);
        let square_length = square(self.g, bowl.length);
        let p = mul(self.g, bowl.q.a, square_length);
        let p = self.g.neg(p);
        let quotient = self.g.apply(Prim::Atan2Quotient, &[p, sum]);
        let product = mul(self.g, bowl.length, quotient);
        let open = scale(self.g, 2.0, product);
        let zero = self.g.real(0.0);
        if_less(self.g, zero, bowl.q.a, log, open)
    }

    /// Σ p⁽ᵏ⁾(s₀)/k! ∫ σᵏ q^(n/2) for n < -1, where the interval is long.
    fn moments(&mut self, bowl: &Bowl, polynomials: &[Id], degree: u32, n: i32) -> Id {
        let offsets = self.offsets(bowl);
        let coefficients = self.taylor(polynomials, degree, bowl.q.foot, bowl.q.foot_low);
        let moments = self.power_moments(bowl, offsets, n, degree);
        let mut parts: Vec<Id> = coefficients
            .iter()
            .zip(&moments)
            .map(|(&c, &m)| mul(self.g, c, m))
            .collect();
        // through the zero of q the first moment may be infinite, and what is 0 there does not count
        let zero = self.g.real(0.0);
        let is_none = self.g.apply(Prim::Equal, &[coefficients[0], zero]);
        parts[0] = self.g.apply(Prim::Select, &[is_none, zero, parts[0]]);
        total(self.g, parts)
    }

    /// The coefficients of a product of polynomials around t, which is rounded by `low`. Beside a zero of theirs that
    /// would be most of them.
    pub(super) fn taylor(&mut self, polynomials: &[Id], degree: u32, t: Id, low: Id) -> Vec<Id> {
        let one = self.g.real(1.0);
        let mut derivatives = vec![polynomials.iter().fold(one, |p, &q| mul(self.g, p, q))];
        for _ in 0..degree {
            let last = derivatives[derivatives.len() - 1];
            derivatives.push(self.slope(last));
        }
        let values = self.at_pair(&derivatives, t, low);
        let mut factorial = 1.0;
        let mut out = Vec::new();
        for (k, &value) in (0_u32..).zip(&values) {
            factorial *= f64::from(k.max(1));
            out.push(scale(self.g, 1.0 / factorial, value));
        }
        out
    }

    /// Fₖ = ∫ σᵏ q^(n/2) for n = -2 and -3: (n + 1 + k) Fₖ = [σᵏ⁻¹ q^(n/2 + 1)]/a - (k - 1) (D/a²) Fₖ₋₂.
    fn power_moments(&mut self, bowl: &Bowl, offsets: [Id; 2], n: i32, degree: u32) -> Vec<Id> {
        let first = match n {
            -3 => self.reciprocal_cube(bowl),
            _ => self.reciprocal(bowl),
        };
        let raised = bowl.ends.map(|q| self.half_power(q, n + 2));
        let mut out = vec![first];
        let depth = self.g.div(bowl.q.discriminant, bowl.q.a);
        let depth = self.g.div(depth, bowl.q.a);
        for k in 1..=i32::try_from(degree).unwrap_or(0) {
            let value = if k == 1 && n == -2 {
                let ratio = self.g.div(bowl.ends[1], bowl.ends[0]);
                let log = call(self.g, Prim::Log, ratio);
                let half = scale(self.g, 0.5, log);
                self.g.div(half, bowl.q.a)
            } else if k == 2 && n == -3 {
                // σ² = (q - D/a)/a
                let root = self.reciprocal_root(bowl);
                let curved = mul(self.g, bowl.q.a, depth);
                let rest = mul(self.g, curved, first);
                let (zero, difference) = (self.g.real(0.0), self.g.sub(root, rest));
                let is_flat = self.g.apply(Prim::Equal, &[curved, zero]);
                let value = self.g.apply(Prim::Select, &[is_flat, root, difference]);
                self.g.div(value, bowl.q.a)
            } else {
                let ends = [0, 1].map(|i| {
                    let power = self.g.apply(Prim::PowInt(k - 1), &[offsets[i]]);
                    mul(self.g, power, raised[i])
                });
                let ends = self.g.sub(ends[1], ends[0]);
                let mut sum = self.g.div(ends, bowl.q.a);
                if k > 1 {
                    let last = out[out.len() - 2];
                    let mut rest = mul(self.g, depth, last);
                    if k == 2 && n < 0 {
                        // D times what may be infinite for D = 0 tends to 0
                        let zero = self.g.real(0.0);
                        let is_flat = self.g.apply(Prim::Equal, &[depth, zero]);
                        rest = self.g.apply(Prim::Select, &[is_flat, zero, rest]);
                    }
                    let rest = scale(self.g, f64::from(k - 1), rest);
                    sum = self.g.sub(sum, rest);
                }
                scale(self.g, 1.0 / f64::from(n + 1 + k), sum)
            };
            out.push(value);
        }
        out
    }

    /// q^(n/2)
    pub(super) fn half_power(&mut self, q: Id, n: i32) -> Id {
        if n % 2 == 0 {
            return self.g.apply(Prim::PowInt(n / 2), &[q]);
        }
        let root = call(self.g, Prim::Sqrt, q);
        self.g.apply(Prim::PowInt(n), &[root])
    }
}
