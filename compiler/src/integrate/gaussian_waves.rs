//! Gaussians by waves and polynomials: ∫ p e^(-q) cos φ with q of degree 2 and φ of degree 1.
//!
//! In u = √a s + b/√a the integrand is e^(-D/a) p e^(-u² + iκu) with κ = δ/√a. From x ≥ 0 on its integral is
//! (√π/2) e^(-x² + iκx) Σ p⁽ⁿ⁾ e^(z²) iⁿerfc z with z = x - iκ/2, by repeated integration by parts: of the first the size is
//! at most 1, and of each that of the one before, so that nothing overflows and nothing cancels. Phases and exponents at
//! the ends are taken from the ends themselves.

use std::f64::consts::PI;

use super::arithmetic::{add, call, if_less, mul, scale};
use super::exponential::{NEAR, Parts, Wave};
use super::gaussian::MAX_DEGREE_BESIDE_GAUSSIAN;
use super::legendre::nodes_for_exponential;
use super::pair::Pair;
use super::path::Body;
use super::quadratic::{Affine, Quadratic};
use super::rule::Rule;
use super::term::Term;
use super::{Integrator, MAX_WAVES, Problem, Reason};
use crate::ir::{Id, Prim};

/// Half-width of the interval in u that is taken at least: along a line on which the Gaussian does not change it
/// changes the integrand by 1e-8.
const LEAST_WIDTH: f64 = 1e-4;
/// What exponent and phases change by together below which nodes take the product as it is: what both ends and the whole
/// differ by cancels beside zeros of the product.
const CHANGE: f64 = 16.0;

/// The most that κ/2 counts as where it is not in an exponent: e⁻⁹⁰⁰ is 0.
const MOST_SHIFT: f64 = 30.0;

/// What is divided out of the derivatives of the polynomial: u by t.
#[derive(Clone, Copy)]
struct Rate {
    rate: Id,
    /// 1/(2 rate)
    step: Id,
}

/// One end of the interval: e^(-q), and the place in u.
struct End {
    size: Id,
    /// The polynomial and its derivatives by t.
    values: Vec<Id>,
    /// What the exponent is beyond its rounded value.
    rest: Id,
    place: Id,
}

impl Integrator<'_> {
    /// ∫ of a Gaussian times sines and cosines, beside a polynomial or alone.
    pub(super) fn gaussian_by_waves(
        &mut self,
        term: &Term,
        parts: &Parts,
        exponent: Id,
    ) -> Result<(Id, Rule), Problem> {
        let (waves, derivatives) = self.waves_beside(term, parts)?;
        let degree = derivatives.len() - 1;
        let negated = self.g.neg(exponent);
        let q = self.quadratic(negated);
        let half = call(self.g, Prim::Abs, self.path.half);
        let (_, rate) = self.rate_of_widths(&q, LEAST_WIDTH);
        let rate = self.with_step(rate);
        let leaves = self.path.coordinates.iter().map(|c| c.leaf);
        let body = Body::new(self.g, &derivatives, leaves);
        let ends = [0, 1].map(|k| {
            let fall = self.pair_at(q.of, self.path.ends[k]).negated(self.g);
            let place = self.path.end(self.g, k);
            End {
                size: call(self.g, Prim::Exp, fall.value),
                rest: fall.rest,
                place: self.g.div(q.slopes[k], rate.rate),
                values: body.at(self.g, &place).to_vec(),
            }
        });
        let centre = self.at_pair(&derivatives, q.foot, q.foot_low);
        let mut sum = self.g.real(0.0);
        for wave in &waves {
            let value = match wave.wave {
                Some((prim, phase)) => self.one_wave(&q, rate, (&ends, &centre), prim, phase),
                None if degree == 0 => self.mass(&q),
                None => {
                    let still = self.constant_phase();
                    self.one_wave(&q, rate, (&ends, &centre), Prim::Cos, still)
                }
            };
            let value = scale(self.g, wave.scale, value);
            sum = add(self.g, sum, value);
        }
        #[allow(clippy::cast_precision_loss, reason = "a degree of at most 7")]
        let limit = CHANGE.max(degree as f64 + 2.0);
        let integrand = term.moving(self.g);
        let nodes = nodes_for_exponential(limit, degree, NEAR);
        let greatest = self.greatest_place(&q);
        let near = self.local_gauss_from(integrand, nodes, greatest);
        let size = self.change_of_waves(&q, half, &waves);
        let limit = self.g.real(limit);
        let value = if_less(self.g, limit, size, sum, near);
        // with a growing square only intervals on which it changes little
        let zero = self.g.real(0.0);
        let value = if self.is_sum_of_squares(negated) {
            value
        } else {
            if_less(self.g, q.a, zero, near, value)
        };
        Ok((value, Rule::GaussianByWave))
    }

    /// The sum of waves that sines and cosines are, and the polynomial beside them with its derivatives.
    fn waves_beside(
        &mut self,
        term: &Term,
        parts: &Parts,
    ) -> Result<(Vec<Wave>, Vec<Id>), Problem> {
        let is_round = |w: &(Prim, Id)| matches!(w.0, Prim::Sin | Prim::Cos);
        if !parts.waves.iter().all(is_round) {
            return Err(self.problem(term.source, Reason::NotFound));
        }
        let degree = self.polynomial_degree(&parts.polynomials);
        if degree > MAX_DEGREE_BESIDE_GAUSSIAN {
            let bound = MAX_DEGREE_BESIDE_GAUSSIAN as usize;
            let reason = Reason::Bound("degrees of a polynomial beside a Gaussian", bound);
            return Err(self.problem(term.source, reason));
        }
        let Some(waves) = self.as_sum(parts, None) else {
            return Err(self.problem(term.source, Reason::Bound("waves", MAX_WAVES)));
        };
        Ok((waves, self.derivatives(&parts.polynomials, degree)))
    }

    fn with_step(&mut self, rate: Id) -> Rate {
        let half = self.g.real(0.5);
        Rate {
            rate,
            step: self.g.div(half, rate),
        }
    }

    /// t of the interval where q is least; an end where q has no curvature.
    fn greatest_place(&mut self, q: &Quadratic) -> Id {
        let [low, high] = [Prim::Min, Prim::Max].map(|p| self.g.apply(p, &self.path.ends));
        let before = if_less(self.g, q.foot, high, q.foot, high);
        if_less(self.g, low, q.foot, before, low)
    }

    fn constant_phase(&mut self) -> Affine {
        let zero = self.g.real(0.0);
        Affine {
            of: zero,
            mid: zero,
            ends: [zero; 2],
            slope: zero,
        }
    }

    /// 2 |b h| + a h² + |δ h| for the fastest wave: that of the sum of the phases.
    fn change_of_waves(&mut self, q: &Quadratic, half: Id, waves: &[Wave]) -> Id {
        let mut most = self.g.real(0.0);
        for wave in waves {
            if let Some((_, phase)) = wave.wave {
                let rate = call(self.g, Prim::Abs, phase.slope);
                most = self.g.apply(Prim::Max, &[most, rate]);
            }
        }
        let turns = mul(self.g, half, most);
        let change = self.change_of_exponent(q, half);
        add(self.g, change, turns)
    }

    /// S(x₀) - S(x₁) and the whole where the centre is between, over √a; S(x) is the integral from x to the infinity of its
    /// side, with the sign of x. The derivatives of the polynomial are given at both ends and in the centre.
    fn one_wave(
        &mut self,
        q: &Quadratic,
        rate: Rate,
        (ends, centre): (&[End; 2], &[Id]),
        prim: Prim,
        phase: Affine,
    ) -> Id {
        let shift = mul(self.g, rate.step, phase.slope);
        let zero = self.g.real(0.0);
        let angles = self.pair_at_ends(phase.of);
        let parts = [0, 1].map(|k| self.end_part(&ends[k], (shift, rate), prim, angles[k]));
        let sum = self.g.sub(parts[0], parts[1]);
        let whole = self.whole_wave(q, (shift, rate), centre, prim, phase);
        let inside = ends.each_ref().map(|end| {
            let one = self.g.real(1.0);
            if_less(self.g, end.place, zero, one, zero)
        });
        let count = self.g.sub(inside[0], inside[1]);
        let is_outside = self.g.apply(Prim::Equal, &[count, zero]);
        let part = self.g.mul(count, whole);
        let part = self.g.apply(Prim::Select, &[is_outside, zero, part]);
        let sum = self.g.add(sum, part);
        self.g.div(sum, rate.rate)
    }

    /// S(x) times √a: e^(-q + iφ) (√π/2) Σ (±1)ⁿ p⁽ⁿ⁾/rateⁿ e^(z²) iⁿerfc z, of the left side the conjugates.
    fn end_part(&mut self, end: &End, (shift, rate): (Id, Rate), prim: Prim, angle: Pair) -> Id {
        let zero = self.g.real(0.0);
        let distance = call(self.g, Prim::Abs, end.place);
        let family = self.faddeeva_family((shift, distance), rate.step, end.values.len());
        let is_left = self.g.apply(Prim::Less, &[end.place, zero]);
        let turn = |this: &mut Self, value: Id| {
            let back = this.g.neg(value);
            this.g.apply(Prim::Select, &[is_left, back, value])
        };
        let mut sums = [zero; 2];
        for (n, (&value, parts)) in end.values.iter().zip(&family).enumerate() {
            for (sum, &part) in sums.iter_mut().zip(parts) {
                let mut part = mul(self.g, value, part);
                if n % 2 == 1 {
                    part = turn(self, part);
                }
                *sum = add(self.g, *sum, part);
            }
        }
        let im = turn(self, sums[1]);
        let turned = self.turned(prim, angle, sums[0], im);
        let turned = self.grown(turned, end.rest);
        let value = mul(self.g, end.size, turned);
        let value = scale(self.g, 0.5 * PI.sqrt(), value);
        turn(self, value)
    }

    /// The same from the beginning of a half-line to infinity: S(x), and the whole where the centre is ahead.
    pub(super) fn tail_of_gaussian_by_waves(
        &mut self,
        term: &Term,
        parts: &Parts,
        exponent: Id,
    ) -> Result<(Id, Rule), Problem> {
        let (waves, derivatives) = self.waves_beside(term, parts)?;
        let negated = self.g.neg(exponent);
        let q = self.quadratic(negated);
        let root = call(self.g, Prim::Sqrt, q.a);
        let rate = self.with_step(root);
        let fall = self.pair_in_middle(q.of).negated(self.g);
        let here = self.path.middle;
        let end = End {
            size: call(self.g, Prim::Exp, fall.value),
            rest: fall.rest,
            place: self.g.div(q.b, rate.rate),
            values: self.at_place(&derivatives, here).to_vec(),
        };
        let centre = self.at_pair(&derivatives, q.foot, q.foot_low);
        let zero = self.g.real(0.0);
        let still = self.constant_phase();
        let mut sum = zero;
        for wave in &waves {
            let (prim, phase) = wave.wave.unwrap_or((Prim::Cos, still));
            let shift = mul(self.g, rate.step, phase.slope);
            let angle = self.pair_in_middle(phase.of);
            let part = self.end_part(&end, (shift, rate), prim, angle);
            let whole = self.whole_wave(&q, (shift, rate), &centre, prim, phase);
            let whole = if_less(self.g, end.place, zero, whole, zero);
            let value = add(self.g, part, whole);
            let value = scale(self.g, wave.scale, value);
            sum = add(self.g, sum, value);
        }
        let value = self.g.div(sum, rate.rate);
        let curve = self.g.neg(q.a);
        let problem = self.diverges(term, "the exponential does not fall");
        Ok((
            self.where_negative(curve, value, problem)?,
            Rule::GaussianByWave,
        ))
    }

    /// √π e^(-D/a - κ²/4) times the wave at the centre, beside a polynomial with Σ p⁽ᵐ⁾/(m! rateᵐ) (iκ/2 + N)ᵐ for the mean
    /// over N of variance ½: these are iᵐ hₘ with hₘ₊₁ = (κ/2) hₘ - (m/2) hₘ₋₁.
    fn whole_wave(
        &mut self,
        q: &Quadratic,
        (shift, rate): (Id, Rate),
        centre: &[Id],
        prim: Prim,
        phase: Affine,
    ) -> Id {
        let depth = self.pair_at(q.of, q.foot);
        let square = super::arithmetic::square(self.g, shift);
        let [least, spread] = [depth.value, square].map(|x| {
            let fall = self.g.neg(x);
            call(self.g, Prim::Exp, fall)
        });
        let [re, im] = self.mean_around_centre(shift, rate, centre);
        let mut angle = self.pair_at(phase.of, q.foot);
        let beside = mul(self.g, q.foot_low, phase.slope);
        angle.rest = add(self.g, angle.rest, beside);
        let wave = self.turned(prim, angle, re, im);
        let fall = scale(self.g, -1.0, depth.rest);
        let wave = self.grown(wave, fall);
        let wave = mul(self.g, spread, wave);
        let value = mul(self.g, least, wave);
        scale(self.g, PI.sqrt(), value)
    }

    fn mean_around_centre(&mut self, shift: Id, rate: Rate, centre: &[Id]) -> [Id; 2] {
        let limits = [-MOST_SHIFT, MOST_SHIFT].map(|v| self.g.real(v));
        let shift = self.g.apply(Prim::Max, &[shift, limits[0]]);
        let shift = self.g.apply(Prim::Min, &[shift, limits[1]]);
        let twice = scale(self.g, 2.0, rate.step);
        let mut sums = [self.g.real(0.0); 2];
        let (mut last, mut moment) = (self.g.real(0.0), self.g.real(1.0));
        let mut weight = self.g.real(1.0);
        for (m, &value) in (0_u32..).zip(centre) {
            let part = mul(self.g, value, weight);
            let part = mul(self.g, part, moment);
            let part = scale(self.g, if m % 4 < 2 { 1.0 } else { -1.0 }, part);
            let sum = &mut sums[m as usize % 2];
            *sum = add(self.g, *sum, part);
            let order = f64::from(m);
            let (up, down) = (mul(self.g, shift, moment), scale(self.g, 0.5 * order, last));
            (last, moment) = (moment, super::arithmetic::sub(self.g, up, down));
            let step = scale(self.g, 1.0 / (order + 1.0), twice);
            weight = mul(self.g, weight, step);
        }
        sums
    }
}
