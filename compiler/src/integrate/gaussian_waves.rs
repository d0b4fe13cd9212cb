//! Gaussians by waves: ∫ e^(-q) cos φ with q of degree 2 and φ of degree 1.
//!
//! In u = √a s + b/√a the integrand is e^(-D/a) e^(-u² + iκu) with κ = δ/√a. From x ≥ 0 on its integral is
//! (√π/2) e^(-x² + iκx) w(κ/2 + ix) with Faddeeva's w, whose size is at most 1 there: nothing overflows and nothing
//! cancels. Phases and exponents at the ends are taken from the ends themselves.

use std::f64::consts::PI;

use super::arithmetic::{add, call, if_less, mul, scale};
use super::exponential::{NEAR, Parts, Wave};
use super::legendre::nodes_for_exponential;
use super::pair::Pair;
use super::quadratic::{Affine, Quadratic};
use super::rule::Rule;
use super::term::Term;
use super::{Integrator, MAX_WAVES, Problem, Reason};
use crate::ir::{Id, Prim};

/// Terms of the approximation of w: right to 3e-13 of |w| in the upper half-plane.
const TERMS: usize = 32;
/// Half-width of the interval in u that is taken at least: along a line on which the Gaussian does not change it
/// changes the integrand by 1e-8.
const LEAST_WIDTH: f64 = 1e-4;
/// What exponent and phases change by together below which nodes take the product as it is.
const CHANGE: f64 = 4.0;

/// One end of the interval: e^(-q), and the place in u.
struct End {
    size: Id,
    /// What the exponent is beyond its rounded value.
    rest: Id,
    place: Id,
}

impl Integrator<'_> {
    /// ∫ of a Gaussian times sines and cosines.
    pub(super) fn gaussian_by_waves(
        &mut self,
        term: &Term,
        parts: &Parts,
        exponent: Id,
    ) -> Result<(Id, Rule), Problem> {
        let is_round = |w: &(Prim, Id)| matches!(w.0, Prim::Sin | Prim::Cos);
        if !parts.polynomials.is_empty() || !parts.waves.iter().all(is_round) {
            return Err(self.problem(term.source, Reason::NotFound));
        }
        let Some(waves) = self.as_sum(parts, None) else {
            return Err(self.problem(term.source, Reason::Bound("waves", MAX_WAVES)));
        };
        let negated = self.g.neg(exponent);
        let q = self.quadratic(negated);
        let half = call(self.g, Prim::Abs, self.path.half);
        let root = call(self.g, Prim::Sqrt, q.a);
        let width = mul(self.g, root, half);
        let floor = self.g.real(LEAST_WIDTH);
        let wide = self.g.apply(Prim::Max, &[width, floor]);
        let rate = self.g.div(wide, half);
        let ends = [0, 1].map(|k| {
            let fall = self.pair_at(q.of, self.path.ends[k]).negated(self.g);
            End {
                size: call(self.g, Prim::Exp, fall.value),
                rest: fall.rest,
                place: self.g.div(q.slopes[k], rate),
            }
        });
        let mut sum = self.g.real(0.0);
        for wave in &waves {
            let value = match wave.wave {
                Some((prim, phase)) => self.one_wave(&q, rate, &ends, prim, phase),
                None => self.mass(&q),
            };
            let value = scale(self.g, wave.scale, value);
            sum = add(self.g, sum, value);
        }
        let integrand = term.moving(self.g);
        let near = self.local_gauss(integrand, nodes_for_exponential(CHANGE, 0, NEAR));
        let size = self.change_of_waves(&q, half, &waves);
        let limit = self.g.real(CHANGE);
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

    /// S(x₀) - S(x₁) and the whole √π e^(-κ²/4) where the centre is between, over √a; S(x) is the integral from x to
    /// the infinity of its side, with the sign of x.
    fn one_wave(
        &mut self,
        q: &Quadratic,
        rate: Id,
        ends: &[End; 2],
        prim: Prim,
        phase: Affine,
    ) -> Id {
        let speed = self.g.div(phase.slope, rate);
        let shift = scale(self.g, 0.5, speed);
        let zero = self.g.real(0.0);
        let angles = self.pair_at_ends(phase.of);
        let parts = [0, 1].map(|k| self.end_part(&ends[k], shift, prim, angles[k]));
        let sum = self.g.sub(parts[0], parts[1]);
        let whole = self.whole_wave(q, shift, prim, phase);
        let inside = ends.each_ref().map(|end| {
            let one = self.g.real(1.0);
            if_less(self.g, end.place, zero, one, zero)
        });
        let count = self.g.sub(inside[0], inside[1]);
        let is_outside = self.g.apply(Prim::Equal, &[count, zero]);
        let part = self.g.mul(count, whole);
        let part = self.g.apply(Prim::Select, &[is_outside, zero, part]);
        let sum = self.g.add(sum, part);
        self.g.div(sum, rate)
    }

    /// S(x) times √a.
    fn end_part(&mut self, end: &End, shift: Id, prim: Prim, angle: Pair) -> Id {
        let zero = self.g.real(0.0);
        let distance = call(self.g, Prim::Abs, end.place);
        let [re, im] = self.faddeeva(shift, distance);
        let back = self.g.neg(im);
        let is_left = self.g.apply(Prim::Less, &[end.place, zero]);
        let im = self.g.apply(Prim::Select, &[is_left, back, im]);
        let turned = self.turned(prim, angle, re, im);
        let turned = self.grown(turned, end.rest);
        let value = mul(self.g, end.size, turned);
        let value = scale(self.g, 0.5 * PI.sqrt(), value);
        let back = self.g.neg(value);
        self.g.apply(Prim::Select, &[is_left, back, value])
    }

    /// The same from the beginning of a half-line to infinity: S(x), and the whole where the centre is ahead.
    pub(super) fn tail_of_gaussian_by_waves(
        &mut self,
        term: &Term,
        parts: &Parts,
        exponent: Id,
    ) -> Result<(Id, Rule), Problem> {
        let is_round = |w: &(Prim, Id)| matches!(w.0, Prim::Sin | Prim::Cos);
        if !parts.polynomials.is_empty() || !parts.waves.iter().all(is_round) {
            return Err(self.problem(term.source, Reason::NotFound));
        }
        let Some(waves) = self.as_sum(parts, None) else {
            return Err(self.problem(term.source, Reason::Bound("waves", MAX_WAVES)));
        };
        let negated = self.g.neg(exponent);
        let q = self.quadratic(negated);
        let rate = call(self.g, Prim::Sqrt, q.a);
        let fall = self.pair_in_middle(q.of).negated(self.g);
        let end = End {
            size: call(self.g, Prim::Exp, fall.value),
            rest: fall.rest,
            place: self.g.div(q.b, rate),
        };
        let zero = self.g.real(0.0);
        let constant = Affine {
            of: zero,
            mid: zero,
            ends: [zero; 2],
            slope: zero,
        };
        let mut sum = zero;
        for wave in &waves {
            let (prim, phase) = wave.wave.unwrap_or((Prim::Cos, constant));
            let speed = self.g.div(phase.slope, rate);
            let shift = scale(self.g, 0.5, speed);
            let angle = self.pair_in_middle(phase.of);
            let part = self.end_part(&end, shift, prim, angle);
            let whole = self.whole_wave(&q, shift, prim, phase);
            let whole = if_less(self.g, end.place, zero, whole, zero);
            let value = add(self.g, part, whole);
            let value = scale(self.g, wave.scale, value);
            sum = add(self.g, sum, value);
        }
        let value = self.g.div(sum, rate);
        let curve = self.g.neg(q.a);
        let problem = self.diverges(term, "the exponential does not fall");
        Ok((
            self.where_negative(curve, value, problem)?,
            Rule::GaussianByWave,
        ))
    }

    /// √π e^(-D/a - κ²/4) times the wave at the centre.
    fn whole_wave(&mut self, q: &Quadratic, shift: Id, prim: Prim, phase: Affine) -> Id {
        let depth = self.pair_at(q.of, q.foot);
        let square = super::arithmetic::square(self.g, shift);
        let [least, spread] = [depth.value, square].map(|x| {
            let fall = self.g.neg(x);
            call(self.g, Prim::Exp, fall)
        });
        let angle = self.pair_at(phase.of, q.foot);
        let wave = self.wave_of(prim, angle);
        let fall = scale(self.g, -1.0, depth.rest);
        let wave = self.grown(wave, fall);
        let wave = mul(self.g, spread, wave);
        let value = mul(self.g, least, wave);
        scale(self.g, PI.sqrt(), value)
    }

    /// w(x + iy) = e^(-z²) erfc(-iz) for y ≥ 0: 2 p(Z)/(ℓ - iz)² + 1/(√π (ℓ - iz)), Z = (ℓ + iz)/(ℓ - iz).
    ///
    /// Weideman, "Computation of the complex error function", SIAM Journal on Numerical Analysis 31 (1994).
    fn faddeeva(&mut self, x: Id, y: Id) -> [Id; 2] {
        let (length, coefficients) = weideman(TERMS);
        let length = self.g.real(length);
        let one = self.g.real(1.0);
        let (above, below) = (self.g.sub(length, y), self.g.add(length, y));
        let back = self.g.neg(x);
        let top = self.g.apply(Prim::Complex, &[above, x]);
        let bottom = self.g.apply(Prim::Complex, &[below, back]);
        let inverse = self.g.div(one, bottom);
        let ratio = self.g.mul(top, inverse);
        let mut sum = self.g.complex(coefficients[TERMS - 1], 0.0);
        for &c in coefficients[..TERMS - 1].iter().rev() {
            let product = self.g.mul(sum, ratio);
            let c = self.g.real(c);
            sum = self.g.add(product, c);
        }
        let first = self.g.mul(sum, inverse);
        let two = self.g.real(2.0);
        let first = self.g.mul(two, first);
        let rest = self.g.real(1.0 / PI.sqrt());
        let bracket = self.g.add(first, rest);
        let value = self.g.mul(bracket, inverse);
        [Prim::Re, Prim::Im].map(|part| call(self.g, part, value))
    }
}

/// ℓ and the coefficients of p, from the constant on: aₙ = (1/4N) Σ e^(-t²) (ℓ² + t²) cos nθ over θ = kπ/2N, |k| < 2N,
/// with t = ℓ tan(θ/2) and ℓ = √(N/√2).
fn weideman(terms: usize) -> (f64, Vec<f64>) {
    #[allow(clippy::cast_precision_loss, reason = "small counts")]
    let count = terms as f64;
    let length = (count / std::f64::consts::SQRT_2).sqrt();
    let points = 2.0 * count;
    let mut out = vec![0.0; terms];
    let mut k = 1.0 - points;
    while k < points {
        let angle = k * PI / points;
        let t = length * (0.5 * angle).tan();
        let value = (-t * t).exp() * (length * length + t * t) / (2.0 * points);
        let mut n = 1.0;
        for c in &mut out {
            *c += value * (n * angle).cos();
            n += 1.0;
        }
        k += 1.0;
    }
    (length, out)
}
