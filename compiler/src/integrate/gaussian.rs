//! Exponentials of quadratics, alone and beside polynomials.
//!
//! e^(-q), q = a s² + 2 b s + c with a ≥ 0 and D = a c - b². In u = √a s + b/√a the exponent is -u² - D/a. The width of
//! the interval in u is kept from 0 by a floor, which changes the integrand by less than it can be told from.

use std::f64::consts::PI;

use super::arithmetic::{add, call, if_less, mul, scale, square};
use super::exponential::{NEAR, Parts};
use super::legendre::nodes_for_exponential;
use super::path::Body;
use super::quadratic::Quadratic;
use super::rule::Rule;
use super::term::Term;
use super::{Integrator, Problem, Reason};
use crate::ir::{Id, Prim};

/// Greatest degree of a polynomial beside a Gaussian: as many scaled repeated integrals of erfc as there are.
pub const MAX_DEGREE_BESIDE_GAUSSIAN: u32 = 7;
/// Half-width in u from which on the closed form takes over from an exponential of degree 1.
const LEAST_WIDTH: f64 = 1e-7;
/// Half-width in u from which on centre and width are taken from the ends: their difference would round the nearer end.
const WIDE: f64 = 1.5;
/// Widths beyond which a Gaussian counts as 0: e⁻⁴⁹ is 5e-22.
const ENOUGH: f64 = 7.0;
/// The same as [`LEAST_WIDTH`] beside polynomials, whose derivatives are divided by powers of it.
const LEAST_WIDTH_BESIDE: f64 = 3e-4;

impl Integrator<'_> {
    /// ∫ of a Gaussian and a polynomial.
    pub(super) fn gaussian(&mut self, term: &Term) -> Result<(Id, Rule), Problem> {
        let parts = Parts::of(term);
        let Some(exponent) = parts.exponent else {
            return Err(self.problem(term.source, Reason::NotFound));
        };
        if !parts.waves.is_empty() {
            return self.gaussian_by_waves(term, &parts, exponent);
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
            let value = self.growing_gaussian(exponent, &parts.polynomials, degree);
            return Ok((value, Rule::GrowingGaussian));
        }
        let integrand = term.moving(self.g);
        let (value, rule) = if degree == 0 {
            (self.mass(&q), Rule::Gaussian)
        } else {
            (
                self.moments_of_gaussian(&q, &parts.polynomials, degree, integrand),
                Rule::PolynomialByGaussian,
            )
        };
        if self.is_sum_of_squares(negated) {
            return Ok((value, rule));
        }
        let growing = self.growing_gaussian(exponent, &parts.polynomials, degree);
        let zero = self.g.real(0.0);
        Ok((if_less(self.g, q.a, zero, growing, value), rule))
    }

    /// Half-width of the interval in u, kept from 0, u' by t, and u at both ends.
    fn in_widths(&mut self, q: &Quadratic, least: f64) -> (Id, Id, [Id; 2]) {
        let (width, rate) = self.rate_of_widths(q, least);
        (width, rate, q.slopes.map(|b| self.g.div(b, rate)))
    }

    /// √a |h|, and √a, or where that is less the rate at which the half-width in u is the least.
    pub(super) fn rate_of_widths(&mut self, q: &Quadratic, least: f64) -> (Id, Id) {
        let half = call(self.g, Prim::Abs, self.path.half);
        let root = call(self.g, Prim::Sqrt, q.a);
        let width = mul(self.g, root, half);
        let floor = self.g.real(least);
        let flat = self.g.div(floor, half);
        (width, if_less(self.g, floor, width, root, flat))
    }

    /// |h| e^(-min q) mass(c, w)/w: mass is ∫ e^(-u²) from c - w to c + w over its greatest value. Of a long interval the
    /// part that is within 7 widths of its greatest value is enough.
    pub(super) fn mass(&mut self, q: &Quadratic) -> Id {
        let (narrow, rate, places) = self.in_widths(q, LEAST_WIDTH);
        let [low, high] = [Prim::Min, Prim::Max].map(|p| self.g.apply(p, &places));
        let zero = self.g.real(0.0);
        // the place of the greatest value: 0, or the end that is nearer
        let nearest = self.g.apply(Prim::Max, &[low, zero]);
        let nearest = self.g.apply(Prim::Min, &[nearest, high]);
        let far = self.g.real(ENOUGH);
        let (least, most) = (self.g.sub(nearest, far), self.g.add(nearest, far));
        let low = self.g.apply(Prim::Max, &[low, least]);
        let high = self.g.apply(Prim::Min, &[high, most]);
        let (sum, difference) = (self.g.add(low, high), self.g.sub(high, low));
        let (centre, width) = (scale(self.g, 0.5, sum), scale(self.g, 0.5, difference));
        // of an interval that is not long its own width, which the difference of the ends would cancel
        let half = call(self.g, Prim::Abs, self.path.half);
        let own = mul(self.g, rate, half);
        let middle = self.g.div(q.b, rate);
        let wide = self.g.real(WIDE);
        let (centre, width) = (
            if_less(self.g, narrow, wide, middle, centre),
            if_less(self.g, narrow, wide, own, width),
        );
        let mass = self.g.apply(Prim::GaussMassScaled, &[centre, width]);
        // where the centre is outside, the exponent goes one way: the end from which it falls
        let [start, end] = self.path.ends;
        let fall = mul(self.g, q.b, self.path.half);
        let first = if_less(self.g, zero, fall, start, end);
        let product = self.g.mul(places[0], places[1]);
        let place = if_less(self.g, product, zero, q.foot, first);
        let exponent = self.pair_at(q.of, place).negated(self.g);
        let top = call(self.g, Prim::Exp, exponent.value);
        let mass = self.grown(mass, exponent.rest);
        let value = mul(self.g, top, mass);
        let value = self.g.div(value, rate);
        let sign = call(self.g, Prim::Sign, self.path.half);
        let wide = mul(self.g, sign, value);
        // a line along which the exponent does not change, and the empty interval
        let length = self.length_of_path();
        let middle = self.pair_in_middle(q.of).negated(self.g);
        let level = call(self.g, Prim::Exp, middle.value);
        let flat = self.grown(length, middle.rest);
        let flat = mul(self.g, flat, level);
        let change = self.change_of_exponent(q, half);
        let least = self.g.real(LEAST_WIDTH);
        if_less(self.g, change, least, flat, wide)
    }

    /// 2 |b h| + a h², which the exponent changes by at most.
    pub(super) fn change_of_exponent(&mut self, q: &Quadratic, half: Id) -> Id {
        let slope = mul(self.g, q.b, half);
        let slope = call(self.g, Prim::Abs, slope);
        let slope = scale(self.g, 2.0, slope);
        let curve = square(self.g, half);
        let curve = mul(self.g, q.a, curve);
        self.g.add(slope, curve)
    }

    /// The tails beyond both ends by repeated integration by parts, ∫ₓ^∞ p e^(-u²) du = Σ p⁽ⁿ⁾(x) (√π/2) iⁿerfc x (NIST DLMF
    /// 7.18), from one another or both from the whole line, and nodes of the integrand where the exponent changes by
    /// less than the degree and 2.
    fn moments_of_gaussian(
        &mut self,
        q: &Quadratic,
        polynomials: &[Id],
        degree: u32,
        integrand: Id,
    ) -> Id {
        let half = call(self.g, Prim::Abs, self.path.half);
        let (_, rate, places) = self.in_widths(q, LEAST_WIDTH_BESIDE);
        let derivatives = self.derivatives(polynomials, degree);
        let one = self.g.real(1.0);
        let (zero, less) = (self.g.real(0.0), self.g.real(-1.0));
        // on which side of the centre the ends are
        let sides = places.map(|u| if_less(self.g, u, zero, less, one));
        let leaves = self.path.coordinates.iter().map(|c| c.leaf);
        let body = Body::new(self.g, &derivatives, leaves);
        let tails = [0, 1].map(|which| {
            let end = self.path.end(self.g, which);
            let values = body.at(self.g, &end);
            let x = call(self.g, Prim::Abs, places[which]);
            let tail = self.tail_of(&values, x, rate, sides[which]);
            let fall = self.pair_at(q.of, self.path.ends[which]).negated(self.g);
            let size = call(self.g, Prim::Exp, fall.value);
            let tail = self.grown(tail, fall.rest);
            let part = mul(self.g, size, tail);
            mul(self.g, sides[which], part)
        });
        let beyond = self.g.sub(tails[0], tails[1]);
        let whole = self.whole_gaussian(q, &derivatives, rate);
        let across = self.g.sub(sides[1], sides[0]);
        let across = scale(self.g, 0.5, across);
        let whole = self.g.mul(across, whole);
        // where both are on one side the whole may be too large a number
        let product = self.g.mul(sides[0], sides[1]);
        let whole = if_less(self.g, product, zero, whole, zero);
        let sum = self.g.add(whole, beyond);
        let far = self.g.div(sum, rate);
        let limit = f64::from(degree) + 2.0;
        let near = self.local_gauss(
            integrand,
            nodes_for_exponential(limit, degree as usize, NEAR) + 2,
        );
        let limit = self.g.real(limit);
        let change = self.change_of_exponent(q, half);
        if_less(self.g, limit, change, far, near)
    }

    /// ∫ over the whole line: √π e^(-D/a) Σ p⁽²ⁿ⁾/rate²ⁿ i²ⁿerfc 0 in the centre, i²ⁿerfc 0 = 1/(4ⁿ n!).
    pub(super) fn whole_gaussian(&mut self, q: &Quadratic, derivatives: &[Id], rate: Id) -> Id {
        let values = self.at_pair(derivatives, q.foot, q.foot_low);
        let mut sum = self.g.real(0.0);
        let mut weight = PI.sqrt();
        for (n, &value) in (0_i32..).zip(&values).step_by(2) {
            let power = self.g.apply(Prim::PowInt(n), &[rate]);
            let part = self.g.div(value, power);
            let part = scale(self.g, weight, part);
            sum = add(self.g, sum, part);
            weight /= 2.0 * f64::from(n) + 4.0;
        }
        let fall = self.pair_at(q.of, q.foot).negated(self.g);
        let size = call(self.g, Prim::Exp, fall.value);
        let sum = self.grown(sum, fall.rest);
        mul(self.g, size, sum)
    }

    /// (√π/2) Σ (±1)ⁿ p⁽ⁿ⁾/rateⁿ e^(x²) iⁿerfc x, the sign that of the side.
    pub(super) fn tail_of(&mut self, values: &[Id], x: Id, rate: Id, side: Id) -> Id {
        let mut sum = self.g.real(0.0);
        for (n, &value) in (0_u8..).zip(values) {
            let integral = self.g.apply(Prim::Erfcx(n), &[x]);
            let power = self.g.apply(Prim::PowInt(n.into()), &[rate]);
            let value = self.g.div(value, power);
            let mut part = mul(self.g, value, integral);
            if n % 2 == 1 {
                part = mul(self.g, side, part);
            }
            sum = add(self.g, sum, part);
        }
        scale(self.g, 0.5 * PI.sqrt(), sum)
    }
}
