//! Exponentials of quadratics, alone and beside polynomials.
//!
//! e^(-q), q = a s² + 2 b s + c with a ≥ 0 and D = a c - b². In u = √a s + b/√a the exponent is -u² - D/a. The width of
//! the interval in u is kept from 0 by a floor, which changes the integrand by less than it can be told from.

use std::f64::consts::PI;

use super::arithmetic::{add, call, if_less, mul, scale, square};
use super::exponential::{NEAR, Parts};
use super::legendre::nodes_for_exponential;
use super::quadratic::Quadratic;
use super::rule::Rule;
use super::term::Term;
use super::{Integrator, Problem, Reason};
use crate::ir::{Id, Prim};

/// Greatest degree of a polynomial beside a Gaussian: as many scaled repeated integrals of erfc as there are.
pub const MAX_DEGREE_BESIDE_GAUSSIAN: u32 = 7;
/// Half-width in u from which on the closed form takes over from an exponential of degree 1.
const LEAST_WIDTH: f64 = 1e-7;
/// The same beside polynomials, whose derivatives are divided by powers of it.
const LEAST_WIDTH_BESIDE: f64 = 3e-4;

impl Integrator<'_> {
    /// ∫ of a Gaussian and a polynomial.
    pub(super) fn gaussian(&mut self, term: &Term) -> Result<(Id, Rule), Problem> {
        let parts = Parts::of(term);
        let Some(exponent) = parts.exponent else {
            return Err(self.problem(term.source, Reason::NotFound));
        };
        if !parts.waves.is_empty() {
            return Err(self.problem(term.source, Reason::NotFound));
        }
        let degree = self.polynomial_degree(&parts.polynomials);
        if degree > MAX_DEGREE_BESIDE_GAUSSIAN {
            let bound = MAX_DEGREE_BESIDE_GAUSSIAN as usize;
            return Err(self.problem(
                term.source,
                Reason::Bound("degrees of a polynomial beside a Gaussian", bound),
            ));
        }
        let negated = self.g.neg(exponent);
        let q = self.quadratic(negated);
        if self.g.as_real(q.a).is_some_and(|a| a < 0.0) || self.is_sum_of_squares(exponent) {
            return Err(self.problem(
                term.source,
                Reason::NotElementary("Liouville: e to a growing square"),
            ));
        }
        let integrand = term.moving(self.g);
        let (value, rule) = if degree == 0 {
            (self.mass(&q, negated), Rule::Gaussian)
        } else {
            (
                self.moments_of_gaussian(&q, negated, &parts.polynomials, degree, integrand),
                Rule::PolynomialByGaussian,
            )
        };
        if self.is_sum_of_squares(negated) {
            return Ok((value, rule));
        }
        // with a growing square only intervals on which it changes little
        let growing = self.gauss(integrand, nodes_for_exponential(4.0, degree as usize, NEAR));
        let zero = self.g.real(0.0);
        Ok((if_less(self.g, q.a, zero, growing, value), rule))
    }

    /// q at s = ±h.
    fn exponents(&mut self, negated: Id) -> [Id; 2] {
        let half = self.path.half;
        let back = self.g.neg(half);
        [back, half].map(|s| self.at(&[negated], s)[0])
    }

    /// L e^(-min q) mass(c, w)/(2w): mass is ∫ e^(-u²) from c - w to c + w over its greatest value.
    fn mass(&mut self, q: &Quadratic, negated: Id) -> Id {
        let half = call(self.g, Prim::Abs, self.path.half);
        let root = call(self.g, Prim::Sqrt, q.a);
        let width = mul(self.g, root, half);
        let floor = self.g.real(LEAST_WIDTH);
        let width = self.g.apply(Prim::Max, &[width, floor]);
        let change = mul(self.g, q.b, half);
        let centre = self.g.div(change, width);
        let mass = self.g.apply(Prim::GaussMassScaled, &[centre, width]);
        let double = scale(self.g, 2.0, width);
        let mean = self.g.div(mass, double);
        let ends = self.exponents(negated);
        let nearest = self.g.apply(Prim::Min, &ends);
        let depth = self.g.div(q.discriminant, q.a);
        let (reach, size) = (mul(self.g, q.a, half), call(self.g, Prim::Abs, q.b));
        let least = if_less(self.g, size, reach, depth, nearest);
        let least = self.g.neg(least);
        let top = call(self.g, Prim::Exp, least);
        let value = mul(self.g, top, mean);
        let length = self.length_of_path();
        mul(self.g, length, value)
    }

    /// Both sides of the centre by repeated integration by parts from their ends,
    /// ∫ₓ^∞ p e^(-u²) du = Σ p⁽ⁿ⁾(x) (√π/2) iⁿerfc x (NIST DLMF 7.18), and nodes of the integrand where the exponent changes
    /// by less than the degree and 2.
    fn moments_of_gaussian(
        &mut self,
        q: &Quadratic,
        negated: Id,
        polynomials: &[Id],
        degree: u32,
        integrand: Id,
    ) -> Id {
        let half = call(self.g, Prim::Abs, self.path.half);
        let root = call(self.g, Prim::Sqrt, q.a);
        let width = mul(self.g, root, half);
        let floor = self.g.real(LEAST_WIDTH_BESIDE);
        let wide = self.g.apply(Prim::Max, &[width, floor]);
        let rate = self.g.div(wide, half);
        let change = mul(self.g, q.b, half);
        let centre = self.g.div(change, wide);
        let foot = self.g.div(q.b, q.a);
        let foot = self.g.neg(foot);
        let depth = self.g.div(q.discriminant, q.a);
        let one = self.g.real(1.0);
        let mut derivatives = vec![polynomials.iter().fold(one, |p, &r| mul(self.g, p, r))];
        for _ in 0..degree {
            let last = derivatives[derivatives.len() - 1];
            derivatives.push(self.slope(last));
        }
        let zero = self.g.real(0.0);
        let mut sum = zero;
        for side in [1.0, -1.0] {
            // the part of the interval on this side of the centre, nearer end first
            for (end, sign) in [
                (scale(self.g, -side, half), 1.0),
                (scale(self.g, side, half), -1.0),
            ] {
                let offset = mul(self.g, rate, end);
                let place = self.g.add(centre, offset);
                let distance = scale(self.g, side, place);
                let is_beyond = self.g.apply(Prim::Less, &[zero, distance]);
                let x = self.g.apply(Prim::Max, &[distance, zero]);
                let s = self.g.apply(Prim::Select, &[is_beyond, end, foot]);
                let at_end = self.at(&[negated], end)[0];
                let exponent = self.g.apply(Prim::Select, &[is_beyond, at_end, depth]);
                let values = self.at(&derivatives, s);
                let tail = self.tail(&values, x, rate, side);
                let fall = self.g.neg(exponent);
                let size = call(self.g, Prim::Exp, fall);
                let part = mul(self.g, size, tail);
                let part = scale(self.g, sign, part);
                sum = add(self.g, sum, part);
            }
        }
        let far = self.g.div(sum, rate);
        let sign = call(self.g, Prim::Sign, self.path.half);
        let far = mul(self.g, sign, far);
        let near = self.gauss(
            integrand,
            nodes_for_exponential(f64::from(degree) + 2.0, degree as usize, NEAR) + 2,
        );
        let limit = self.g.real(f64::from(degree) + 2.0);
        let (slope, curve) = (scale(self.g, 2.0, change), square(self.g, width));
        let slope = call(self.g, Prim::Abs, slope);
        let change = self.g.add(slope, curve);
        if_less(self.g, limit, change, far, near)
    }

    /// (√π/2) Σ (±1)ⁿ p⁽ⁿ⁾/rateⁿ e^(x²) iⁿerfc x
    fn tail(&mut self, values: &[Id], x: Id, rate: Id, side: f64) -> Id {
        let mut sum = self.g.real(0.0);
        for (n, &value) in (0_u8..).zip(values) {
            let integral = self.g.apply(Prim::Erfcx(n), &[x]);
            let power = self.g.apply(Prim::PowInt(n.into()), &[rate]);
            let value = self.g.div(value, power);
            let part = mul(self.g, value, integral);
            let part = scale(self.g, if n % 2 == 1 { side } else { 1.0 }, part);
            sum = add(self.g, sum, part);
        }
        scale(self.g, 0.5 * PI.sqrt(), sum)
    }
}
