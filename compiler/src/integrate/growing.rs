//! Exponentials of quadratics that grow on both sides, alone and beside polynomials.
//!
//! e^(q), q = a s² + 2 b s + c with a > 0. In u = √a s + b/√a it is e^(u²) times a constant, of which Dawson's function
//! D(u) = e^(-u²) ∫₀ᵘ e^(v²) dv gives the antiderivative: ∫ p e^(u²) du = e^(u²) Σ p⁽ⁿ⁾ D⁽ⁿ⁾/(2ⁿ n!), by repeated
//! integration by parts, as d/du (e^(u²) D⁽ⁿ⁾) = -2 n e^(u²) D⁽ⁿ⁻¹⁾. Its values at both ends are far from one another where
//! the exponent changes by more than half the degree and 3; nodes elsewhere.

use std::f64::consts::PI;

use super::Integrator;
use super::arithmetic::{add, call, if_less, mul, scale};
use super::exponential::NEAR;
use super::legendre::nodes_for_exponential;
use super::path::Body;
use crate::ir::{Id, Prim};

/// Half-width of the interval in u that is taken at least: with less the exponent changes by its linear part alone.
const LEAST_WIDTH: f64 = 1e-4;
/// What the exponent changes by below which nodes take the integrand as it is, beside half the degree.
const CHANGE: f64 = 3.0;
/// As what change of a line that of a square counts.
const BENT: f64 = 1.75;

impl Integrator<'_> {
    /// ∫ p e^q where q opens up.
    pub(super) fn growing_gaussian(&mut self, exponent: Id, polynomials: &[Id], degree: u32) -> Id {
        let q = self.quadratic(exponent);
        let half = call(self.g, Prim::Abs, self.path.half);
        let (_, rate) = self.rate_of_widths(&q, LEAST_WIDTH);
        let derivatives = self.derivatives(polynomials, degree);
        let leaves = self.path.coordinates.iter().map(|c| c.leaf);
        let body = Body::new(self.g, &derivatives, leaves);
        let ends = [0, 1].map(|k| {
            let place = self.g.div(q.slopes[k], rate);
            let end = self.path.end(self.g, k);
            let values = body.at(self.g, &end);
            let sum = self.sum_of_dawson(&values, place, rate);
            let top = self.pair_at(q.of, self.path.ends[k]);
            let size = call(self.g, Prim::Exp, top.value);
            let sum = self.grown(sum, top.rest);
            mul(self.g, size, sum)
        });
        let difference = self.g.sub(ends[1], ends[0]);
        let far = self.g.div(difference, rate);
        let factor = call(self.g, Prim::Exp, exponent);
        let integrand = polynomials
            .iter()
            .fold(factor, |product, &p| mul(self.g, product, p));
        let limit = CHANGE + 0.5 * f64::from(degree);
        // e to a square has larger derivatives than e to a line that changes by as much
        let nodes = nodes_for_exponential(BENT * limit, degree as usize, NEAR);
        let near = self.local_gauss(integrand, nodes);
        let change = self.change_of_exponent(&q, half);
        let limit = self.g.real(limit);
        if_less(self.g, limit, change, far, near)
    }

    /// Σ p⁽ⁿ⁾/rateⁿ D⁽ⁿ⁾/(2ⁿ n!), D the imaginary part of (√π/2) w on the real line.
    fn sum_of_dawson(&mut self, values: &[Id], place: Id, rate: Id) -> Id {
        let zero = self.g.real(0.0);
        let half = self.g.real(0.5);
        let step = self.g.div(half, rate);
        let step = self.g.apply(Prim::Complex, &[zero, step]);
        let family = self.faddeeva_family((place, zero), step, values.len());
        let mut sum = zero;
        for (&value, [_, part]) in values.iter().zip(family) {
            let part = mul(self.g, value, part);
            sum = add(self.g, sum, part);
        }
        scale(self.g, 0.5 * PI.sqrt(), sum)
    }
}
