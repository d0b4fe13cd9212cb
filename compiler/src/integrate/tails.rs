//! The rules of integrals to infinity, each seen from the beginning of the half-line: c is a value there, x and s count
//! from there.

use super::algebraic::{Bowl, MAX_DEGREE_BESIDE_POWER};
use super::arithmetic::{add, call, div, if_less, is_zero, mul, scale, sub, total};
use super::equiangular::Least;
use super::exponential::Parts;
use super::gaussian::MAX_DEGREE_BESIDE_GAUSSIAN;
use super::quadratic::Affine;
use super::rule::Rule;
use super::term::{Factor, Term};
use super::{Integrator, MAX_DEGREE_BESIDE, MAX_WAVES, Problem, Reason};
use crate::ir::{Id, Prim};

/// Why a logarithm, a power that does not fall, and their kin have no integral to infinity.
const SLOW: &str = "the integrand does not fall faster than 1/t";

impl Integrator<'_> {
    /// The integral to infinity of a product of known factors, not all of them polynomials.
    pub(super) fn tail_by_class(&mut self, term: &Term) -> Result<(Id, Rule), Problem> {
        let parts = Parts::of(term);
        let degree = self.polynomial_degree(&parts.polynomials);
        if let Some(exponent) = parts.exponent.filter(|_| parts.rest.is_empty()) {
            return match self.degree(exponent) {
                Some(1) => self.tail_of_waves(term, &parts, degree),
                _ if parts.waves.is_empty() => self.tail_of_gaussian(term, &parts, degree),
                _ => self.tail_of_gaussian_by_waves(term, &parts, exponent),
            };
        }
        if parts.rest.is_empty() {
            return self.tail_of_waves(term, &parts, degree);
        }
        if parts.exponent.is_some() || !parts.waves.is_empty() {
            return Err(self.why_product(term));
        }
        match *parts.rest.as_slice() {
            [Factor::Log(_)] => Err(self.diverges(term, SLOW)),
            [Factor::Power(base, exponent)] if self.degree(base) == Some(1) => {
                self.tail_of_affine_power(term, &parts.polynomials, degree, (base, exponent))
            }
            [Factor::Power(base, exponent)] => {
                self.tail_of_quadratic_power(term, &parts.polynomials, degree, (base, exponent))
            }
            _ if degree == 0 => self.tail_of_function(term, &parts.rest),
            _ => Err(self.why_product(term)),
        }
    }

    /// ∫ p e^λs = -e^α (p - (p' - …)/λ)/λ at the beginning, where Re λ < 0.
    fn tail_of_waves(
        &mut self,
        term: &Term,
        parts: &Parts,
        degree: u32,
    ) -> Result<(Id, Rule), Problem> {
        if degree > MAX_DEGREE_BESIDE {
            let bound = MAX_DEGREE_BESIDE as usize;
            let reason = Reason::Bound("degrees of a polynomial beside an exponential", bound);
            return Err(self.problem(term.source, reason));
        }
        let exponent = parts.exponent.map(|e| self.affine(e));
        let Some(waves) = self.as_sum(parts, exponent) else {
            return Err(self.problem(term.source, Reason::Bound("waves", MAX_WAVES)));
        };
        let [(_, values), _] = self.derivatives_at_ends(&parts.polynomials, degree);
        let mut sum = self.g.real(0.0);
        for wave in &waves {
            let Some(exponent) = wave.exponent else {
                let why = "a wave has no limit, and a growing one none at all";
                return Err(self.diverges(term, why));
            };
            let value = self.end(wave, -1.0, &values);
            let value = scale(self.g, -wave.scale, value);
            let problem = self.diverges(term, "the exponential does not fall");
            let value = self.where_negative(exponent.slope, value, problem)?;
            sum = add(self.g, sum, value);
        }
        let rule = match (degree, parts.waves.len()) {
            (0, 0) => Rule::Exponential,
            (0, 1) => Rule::DampedWave,
            (0, _) => Rule::ProductOfWaves,
            _ => Rule::PolynomialByWave,
        };
        Ok((sum, rule))
    }

    /// e^-c times the scaled integrals of erfc from the beginning where the exponent falls from there on, else all
    /// around the centre less what is on the other side.
    fn tail_of_gaussian(
        &mut self,
        term: &Term,
        parts: &Parts,
        degree: u32,
    ) -> Result<(Id, Rule), Problem> {
        let Some(exponent) = parts
            .exponent
            .filter(|_| degree <= MAX_DEGREE_BESIDE_GAUSSIAN)
        else {
            let bound = MAX_DEGREE_BESIDE_GAUSSIAN as usize;
            let reason = Reason::Bound("degrees of a polynomial beside a Gaussian", bound);
            return Err(self.problem(term.source, reason));
        };
        let negated = self.g.neg(exponent);
        let q = self.quadratic(negated);
        let rate = call(self.g, Prim::Sqrt, q.a);
        let place = self.g.div(q.b, rate);
        let one = self.g.real(1.0);
        let product = parts
            .polynomials
            .iter()
            .fold(one, |p, &r| mul(self.g, p, r));
        let mut derivatives = vec![product];
        for _ in 0..degree {
            let last = derivatives[derivatives.len() - 1];
            derivatives.push(self.slope(last));
        }
        let zero = self.g.real(0.0);
        let here: Vec<Id> = derivatives.iter().map(|&d| self.at_middle(d)).collect();
        let less = self.g.real(-1.0);
        let side = if_less(self.g, place, zero, less, one);
        let distance = call(self.g, Prim::Abs, place);
        let beyond = self.tail_of(&here, distance, rate, side);
        let fall = self.g.neg(q.c);
        let there = call(self.g, Prim::Exp, fall);
        let falling = mul(self.g, there, beyond);
        let whole = self.whole_gaussian(&q, &derivatives, rate);
        let around = self.g.sub(whole, falling);
        let value = if_less(self.g, place, zero, around, falling);
        let value = self.g.div(value, rate);
        let rule = if degree == 0 {
            Rule::Gaussian
        } else {
            Rule::PolynomialByGaussian
        };
        let curve = self.g.neg(q.a);
        let problem = self.diverges(term, "the exponential does not fall");
        Ok((self.where_negative(curve, value, problem)?, rule))
    }

    /// Σ p⁽ᵏ⁾/(k! βᵏ) at the zero of x, times ∫ x^(p + k) ds = |x|^(p + k + 1)/(|β| (-p - k - 1)).
    fn tail_of_affine_power(
        &mut self,
        term: &Term,
        polynomials: &[Id],
        degree: u32,
        (base, exponent): (Id, Id),
    ) -> Result<(Id, Rule), Problem> {
        if degree > MAX_DEGREE_BESIDE_POWER {
            return Err(self.bound_beside(term.source));
        }
        let x = self.affine(base);
        let mut parts = Vec::new();
        if degree == 0 {
            parts.push(self.affine_moment(x, exponent));
        } else {
            let ratio = self.g.div(x.mid, x.slope);
            let foot = self.g.sub(self.path.middle, ratio);
            let zero = self.g.real(0.0);
            let coefficients = self.taylor(polynomials, degree, foot, zero);
            for (k, c) in (0_i32..).zip(coefficients) {
                let power = self.g.apply(Prim::PowInt(k), &[x.slope]);
                let c = self.g.div(c, power);
                let shift = self.g.real(f64::from(k));
                let raised = add(self.g, exponent, shift);
                let moment = self.affine_moment(x, raised);
                parts.push(mul(self.g, c, moment));
            }
        }
        let value = total(self.g, parts);
        let shift = self.g.real(f64::from(degree) + 1.0);
        let margin = add(self.g, exponent, shift);
        let problem = self.diverges(term, SLOW);
        let value = self.where_negative(margin, value, problem)?;
        Ok((value, Rule::AffinePower))
    }

    /// ∫ x^p to infinity, p < -1; where x meets 0 on the way infinite for even p, NaN for others.
    fn affine_moment(&mut self, x: Affine, exponent: Id) -> Id {
        let (zero, one) = (self.g.real(0.0), self.g.real(1.0));
        let size = call(self.g, Prim::Abs, x.mid);
        let rate = call(self.g, Prim::Abs, x.slope);
        let raised = add(self.g, exponent, one);
        let power = Factor::Power(size, raised).expression(self.g);
        let bottom = mul(self.g, rate, raised);
        let bottom = self.g.neg(bottom);
        let value = self.g.div(power, bottom);
        let value = self.with_sign(x.mid, exponent, value);
        let is_even = self
            .g
            .as_real(exponent)
            .is_some_and(|p| p.rem_euclid(2.0) == 0.0);
        let through = self.g.real(if is_even { f64::INFINITY } else { f64::NAN });
        let back = self.g.neg(x.mid);
        let ahead = if_less(self.g, x.slope, zero, back, x.mid);
        if_less(self.g, zero, ahead, value, through)
    }

    /// The angle or power forms of a quadratic that stays above 0.
    fn tail_of_quadratic_power(
        &mut self,
        term: &Term,
        polynomials: &[Id],
        degree: u32,
        (base, exponent): (Id, Id),
    ) -> Result<(Id, Rule), Problem> {
        let Some(p) = self.g.as_real(exponent) else {
            return Err(self.problem(term.source, Reason::Hypergeometric));
        };
        if 2.0 * p + f64::from(degree) >= -1.0 {
            return Err(self.diverges(term, SLOW));
        }
        if (2.0 * p).fract() != 0.0 || p < -12.0 {
            return Err(self.problem(term.source, Reason::Hypergeometric));
        }
        #[allow(clippy::cast_possible_truncation, reason = "a whole number above -25")]
        let twice = (2.0 * p) as i32;
        let bowl = self.bowl(base);
        let (value, rule) = match (twice, degree) {
            (-2, _) => (self.angle_to_infinity(&bowl, bowl.q.b), Rule::Reciprocal),
            (-3, 0) => (self.cube_to_infinity(&bowl), Rule::ReciprocalCube),
            _ => {
                let (least, ends) = self.least_to_infinity(&bowl);
                let k = twice.unsigned_abs().saturating_sub(2);
                let (sum, difference) =
                    (add(self.g, ends[0], ends[1]), sub(self.g, ends[1], ends[0]));
                let (middle, reach) = (scale(self.g, 0.5, sum), scale(self.g, 0.5, difference));
                let value = self.over_the_angle(&bowl, polynomials, k, &least, [middle, reach]);
                (value, Rule::Equiangular)
            }
        };
        let curve = self.g.neg(bowl.q.a);
        let problem = self.problem(term.source, Reason::NotFound);
        Ok((self.where_negative(curve, value, problem)?, rule))
    }

    /// ∫ ds/q from where half the slope of q is b: atan2(√D, b)/√D; no number where q has a simple zero ahead.
    fn angle_to_infinity(&mut self, bowl: &Bowl, b: Id) -> Id {
        let quotient = self.g.apply(Prim::Atan2Quotient, &[bowl.q.discriminant, b]);
        let zero = self.g.real(0.0);
        let nan = self.g.real(f64::NAN);
        // with zeros of q on the line the slope there is positive beyond the last
        let is_before = self.g.apply(Prim::Less, &[b, zero]);
        let is_between = self.g.apply(Prim::LessEqual, &[bowl.q.c, zero]);
        let meets = self.g.apply(Prim::Or, &[is_before, is_between]);
        let beyond = self.g.apply(Prim::Select, &[meets, nan, quotient]);
        if_less(self.g, bowl.q.discriminant, zero, beyond, quotient)
    }

    /// ∫ q^(-3/2) = 1/(√c (√(a c) + b)), and (√(a c) - b)/(D √c) where b < 0.
    fn cube_to_infinity(&mut self, bowl: &Bowl) -> Id {
        let q = bowl.q;
        let root = call(self.g, Prim::Sqrt, q.c);
        let rate = call(self.g, Prim::Sqrt, q.a);
        let product = mul(self.g, rate, root);
        let (sum, difference) = (add(self.g, product, q.b), sub(self.g, product, q.b));
        let falling = mul(self.g, root, sum);
        let one = self.g.real(1.0);
        let falling = self.g.div(one, falling);
        let bottom = mul(self.g, q.discriminant, root);
        let around = self.g.div(difference, bottom);
        let zero = self.g.real(0.0);
        if_less(self.g, q.b, zero, around, falling)
    }

    /// The place of the least q on the half-line, and the angles from there to the beginning and to infinity.
    fn least_to_infinity(&mut self, bowl: &Bowl) -> (Least, [Id; 2]) {
        let q = bowl.q;
        let zero = self.g.real(0.0);
        let rising = self.g.apply(Prim::Less, &[q.b, zero]);
        let depth = self.g.div(q.discriminant, q.a);
        let mut choose = |foot: Id, here: Id| self.g.apply(Prim::Select, &[rising, foot, here]);
        let least = Least {
            place: choose(q.foot, self.path.middle),
            value: choose(depth, q.c),
            slope: choose(zero, q.b),
        };
        let offset = div(self.g, q.b, q.a);
        let square = super::arithmetic::square(self.g, offset);
        let p = mul(self.g, q.discriminant, square);
        let quotient = self.g.apply(Prim::Atan2Quotient, &[p, depth]);
        let around = mul(self.g, offset, quotient);
        let begin = self.g.apply(Prim::Select, &[rising, around, zero]);
        let end = self
            .g
            .apply(Prim::Atan2Quotient, &[q.discriminant, least.slope]);
        (least, [begin, end])
    }

    /// ∫ of the functions of the table that fall: 2 atan(e^-y)/|β|, 2/((1 + e^2y) |β|), log(1 + e^-y)/|β|, with y what is
    /// at the beginning, positive to the side where it grows.
    fn tail_of_function(&mut self, term: &Term, factors: &[Factor]) -> Result<(Id, Rule), Problem> {
        let of = match *factors {
            [Factor::Function(_, x) | Factor::Logistic(x)] => x,
            [
                Factor::Function(Prim::Sech, x),
                Factor::Function(Prim::Sech, y),
            ] if x == y => x,
            _ => return Err(self.why_product(term)),
        };
        let x = self.affine(of);
        let zero = self.g.real(0.0);
        let rate = call(self.g, Prim::Abs, x.slope);
        let back = self.g.neg(x.mid);
        let y = if_less(self.g, x.slope, zero, back, x.mid);
        let fall = self.g.neg(y);
        let (value, rule) = match *factors {
            [Factor::Function(Prim::Sech, _)] => {
                let size = call(self.g, Prim::Exp, fall);
                let angle = call(self.g, Prim::Atan, size);
                (scale(self.g, 2.0, angle), Rule::Bell)
            }
            [Factor::Function(Prim::Sech, _), _] => {
                let (one, steep) = (self.g.real(1.0), scale(self.g, 2.0, y));
                let size = call(self.g, Prim::Exp, steep);
                let (two, sum) = (self.g.real(2.0), self.g.add(one, size));
                (self.g.div(two, sum), Rule::Bell)
            }
            [Factor::Function(Prim::Erfc, _)] => {
                let value = self.tail_of_complementary(x.mid);
                let back = self.g.neg(x.slope);
                let problem = self.diverges(term, "it tends to 2");
                let value = self.where_negative(back, value, problem)?;
                (value, Rule::Sigmoidal)
            }
            [Factor::Logistic(_)] => {
                let value = call(self.g, Prim::Log1pExp, fall);
                let problem = self.diverges(term, "it tends to 1");
                (
                    self.where_negative(x.slope, value, problem)?,
                    Rule::Logistic,
                )
            }
            _ => return Err(self.diverges(term, "it does not tend to 0")),
        };
        if is_zero(self.g, rate) {
            return Err(self.diverges(term, "it does not change"));
        }
        Ok((self.g.div(value, rate), rule))
    }
}
