//! Exponentials and waves of what changes evenly, their products, and those with polynomials.

use smallvec::SmallVec;

use super::arithmetic::{add, call, if_less, mul, scale, sub, total};
use super::legendre::nodes_for_exponential;
use super::pair::Pair;
use super::path::Body;
use super::quadratic::Affine;
use super::rule::Rule;
use super::term::{Factor, Term};
use super::waves::{MAX_WAVES, product_to_sum};
use super::{Integrator, Problem, Reason};
use crate::ir::{Id, Prim};

/// Greatest degree of a polynomial beside an exponential or a wave.
pub const MAX_DEGREE_BESIDE: u32 = 16;

/// What the branches of a rule that uses Gauss-Legendre nodes on short intervals are right to.
pub(super) const NEAR: f64 = 1e-12;

/// Values of a polynomial and its derivatives.
pub(super) type Values = SmallVec<[Id; 4]>;

/// e^exponent times one wave.
#[derive(Clone, Debug)]
pub(super) struct Wave {
    pub scale: f64,
    pub exponent: Option<Affine>,
    /// sin, cos, sinh or cosh.
    pub wave: Option<(Prim, Affine)>,
}

impl Integrator<'_> {
    /// ∫ of an exponential, waves and a polynomial.
    ///
    /// One exponential: 2h e^(α + |βh|) φ(-2|βh|) with φ(x) = (eˣ - 1)/x. One wave: 2h sinc(δh) sin(γ). Products of
    /// waves become sums (NIST DLMF 4.21(ii), 4.35(ii)); where all phases together change by no more than 1 each,
    /// nodes of Gauss and Legendre take the integrand as it is, so that nothing cancels near a common zero. With a
    /// polynomial each of these is integrated by [`Self::polynomial_by_wave`].
    pub(super) fn exponential(&mut self, term: &Term) -> Result<(Id, Rule), Problem> {
        let parts = Parts::of(term);
        let degree = self.polynomial_degree(&parts.polynomials);
        if degree > MAX_DEGREE_BESIDE {
            let bound = MAX_DEGREE_BESIDE as usize;
            let reason = Reason::Bound("degrees of a polynomial beside an exponential", bound);
            return Err(self.problem(term.source, reason));
        }
        let exponent = parts.exponent.map(|e| self.affine(e));
        let Some(waves) = self.as_sum(&parts, exponent) else {
            return Err(self.problem(term.source, Reason::Bound("waves", MAX_WAVES)));
        };
        let (far, rule) = if degree > 0 {
            let integral = self.polynomial_by_waves(&parts.polynomials, degree, &waves);
            (integral, Rule::PolynomialByWave)
        } else {
            let rule = match (exponent, parts.waves.len()) {
                (Some(_), 0) => Rule::Exponential,
                (None, 1) => Rule::Wave,
                (_, 1) => Rule::DampedWave,
                _ => Rule::ProductOfWaves,
            };
            (self.sum_of(&waves), rule)
        };
        let is_growth = |w: &(Prim, Id)| matches!(w.0, Prim::Sinh | Prim::Cosh);
        let may_cancel =
            parts.waves.len() > 1 || exponent.is_some() && parts.waves.iter().any(is_growth);
        // beside other terms of one product that is taken as it is on short intervals
        if !may_cancel || term.product.is_some() {
            return Ok((far, rule));
        }
        let change = self.change(&parts, exponent);
        let count = parts.waves.len() + usize::from(exponent.is_some());
        #[allow(clippy::cast_precision_loss, reason = "a count of at most 17")]
        let limit = count as f64;
        let integrand = term.moving(self.g);
        let nodes = nodes_for_exponential(limit, degree as usize, NEAR);
        let near = self.local_gauss(integrand, nodes);
        let limit = self.g.real(limit);
        Ok((if_less(self.g, limit, change, far, near), rule))
    }

    /// |h| times the sum of the sizes of all slopes.
    fn change(&mut self, parts: &Parts, exponent: Option<Affine>) -> Id {
        let mut slopes: Vec<Id> = exponent.iter().map(|e| e.slope).collect();
        for &(_, phase) in &parts.waves {
            slopes.push(self.affine(phase).slope);
        }
        let sizes: Vec<Id> = slopes
            .into_iter()
            .map(|s| call(self.g, Prim::Abs, s))
            .collect();
        let sum = total(self.g, sizes);
        let half = call(self.g, Prim::Abs, self.path.half);
        mul(self.g, half, sum)
    }

    pub(super) fn polynomial_degree(&mut self, polynomials: &[Id]) -> u32 {
        polynomials
            .iter()
            .map(|&p| self.degree(p).unwrap_or(0))
            .sum()
    }

    /// The waves as a sum of exponentials times at most one wave each.
    pub(super) fn as_sum(&mut self, parts: &Parts, exponent: Option<Affine>) -> Option<Vec<Wave>> {
        let is_round = |p: &Prim| matches!(p, Prim::Sin | Prim::Cos);
        let (round, hyperbolic): (Vec<_>, Vec<_>) =
            parts.waves.iter().copied().partition(|w| is_round(&w.0));
        let round_sum = product_to_sum(&round, true)?;
        let hyperbolic_sum = product_to_sum(&hyperbolic, false)?;
        if round_sum.len() * hyperbolic_sum.len() > MAX_WAVES {
            return None;
        }
        let mut out = Vec::new();
        for ((sine, phases), v) in &round_sum {
            let wave = self.combined(phases);
            let wave = wave.map(|w| (if *sine { Prim::Sin } else { Prim::Cos }, w));
            if wave.is_none() && *sine {
                continue;
            }
            for ((odd, growths), w) in &hyperbolic_sum {
                let growth = self.combined(growths);
                if growth.is_none() && *odd {
                    continue;
                }
                let alone = exponent.is_none() && wave.is_none();
                match growth {
                    None => out.push(Wave {
                        scale: v * w,
                        exponent,
                        wave,
                    }),
                    Some(growth) if alone => out.push(Wave {
                        scale: v * w,
                        exponent,
                        wave: Some((if *odd { Prim::Sinh } else { Prim::Cosh }, growth)),
                    }),
                    Some(growth) => {
                        let back = if *odd { -1.0 } else { 1.0 };
                        for (sign, factor) in [(1.0, 1.0), (-1.0, back)] {
                            let turned = self.multiple(sign, growth);
                            let exponent = Some(match exponent {
                                None => turned,
                                Some(e) => self.sum_of_affine(e, turned),
                            });
                            out.push(Wave {
                                scale: 0.5 * factor * v * w,
                                exponent,
                                wave,
                            });
                        }
                    }
                }
            }
        }
        Some(out)
    }

    fn sum_of_affine(&mut self, a: Affine, b: Affine) -> Affine {
        let sum = add(self.g, a.of, b.of);
        self.affine(sum)
    }

    fn multiple(&mut self, v: f64, a: Affine) -> Affine {
        let multiple = scale(self.g, v, a.of);
        self.affine(multiple)
    }

    /// Σ n phase, `None` of nothing. Slopes of phases may cancel: that of a sum is taken with its rests.
    fn combined(&mut self, phases: &[(Id, i32)]) -> Option<Affine> {
        let mut sum: Option<Id> = None;
        for &(phase, n) in phases {
            let one = scale(self.g, f64::from(n), phase);
            sum = Some(match sum {
                None => one,
                Some(sum) => add(self.g, sum, one),
            });
        }
        let sum = sum?;
        let mut out = self.affine(sum);
        if phases.len() > 1 {
            let slope = self.slope(sum);
            out.slope = self.constant_with_rests(slope);
        }
        Some(out)
    }

    fn sum_of(&mut self, waves: &[Wave]) -> Id {
        let length = self.length_of_path();
        if let &[
            Wave {
                scale: factor,
                exponent: Some(e),
                wave: None,
            },
        ] = waves
        {
            let value = self.of_exponential(e, length);
            return scale(self.g, factor, value);
        }
        let parts: Vec<Id> = waves.iter().map(|w| self.mean_of_wave(w)).collect();
        let sum = total(self.g, parts);
        mul(self.g, length, sum)
    }

    /// The mean of one exponential with one wave.
    fn mean_of_wave(&mut self, of: &Wave) -> Id {
        let half = self.path.half;
        let mean = match (of.exponent, of.wave) {
            (None, None) => self.g.real(1.0),
            (Some(e), None) => self.mean_of_exponential(e),
            (None, Some((prim @ (Prim::Sin | Prim::Cos), phase))) => {
                let change = mul(self.g, phase.slope, half);
                let middle = self.pair_in_middle(phase.of);
                let (value, shrink) =
                    (self.wave_of(prim, middle), call(self.g, Prim::Sinc, change));
                mul(self.g, value, shrink)
            }
            (None, Some((prim, phase))) => self.mean_of_growth(prim, phase),
            (Some(e), Some((prim, phase))) => self.mean_of_damped_wave(e, prim, phase),
        };
        scale(self.g, of.scale, mean)
    }

    /// sinh(α) sinhc(βh), or cosh: both from the ends with their rests, as a large exponent is rounded by more than
    /// its exponential may be.
    fn mean_of_growth(&mut self, prim: Prim, of: Affine) -> Id {
        let ends = self.pair_at_ends(of.of).map(|end| Pair {
            value: scale(self.g, 0.5, end.value),
            rest: scale(self.g, 0.5, end.rest),
        });
        let middle = ends[0].plus(self.g, ends[1]).normalised(self.g);
        let back = ends[0].negated(self.g);
        let change = ends[1].plus(self.g, back).normalised(self.g);
        let value = call(self.g, prim, middle.value);
        let shrink = call(self.g, Prim::Sinhc, change.value);
        let mean = mul(self.g, value, shrink);
        // each as if it were an exponential, which it is where the rest matters
        let mut rest = self.g.real(0.0);
        for pair in [middle, change] {
            let sign = call(self.g, Prim::Sign, pair.value);
            let part = mul(self.g, sign, pair.rest);
            rest = add(self.g, rest, part);
        }
        let one = self.g.real(1.0);
        let factor = add(self.g, one, rest);
        mul(self.g, mean, factor)
    }

    /// The end where e^(βs) is greater: its t.
    fn greater_end(&mut self, change: Id) -> Id {
        let zero = self.g.real(0.0);
        let [low, high] = self.path.ends;
        if_less(self.g, change, zero, low, high)
    }

    /// e^(α + |βh|) φ(-2|βh|): the greater end times a number in (0, 1]. One comparison chooses the end and the sign, so
    /// that the derivative is right where both ends are the same.
    pub(super) fn mean_of_exponential(&mut self, e: Affine) -> Id {
        let (end, quotient) = self.exponential_from_greater_end(e);
        let top = call(self.g, Prim::Exp, end);
        mul(self.g, top, quotient)
    }

    /// The same times a factor which may be so large that the greater end alone is too small a number, or so small that it is
    /// too large: the root of the end is multiplied twice.
    fn of_exponential(&mut self, e: Affine, factor: Id) -> Id {
        let (end, quotient) = self.exponential_from_greater_end(e);
        let half = scale(self.g, 0.5, end);
        let root = call(self.g, Prim::Exp, half);
        let value = mul(self.g, factor, quotient);
        let value = mul(self.g, value, root);
        mul(self.g, value, root)
    }

    /// The greater exponent, and φ(-2|βh|) with what the exponent is rounded by.
    fn exponential_from_greater_end(&mut self, e: Affine) -> (Id, Id) {
        let zero = self.g.real(0.0);
        let change = mul(self.g, e.slope, self.path.half);
        let back = self.g.neg(change);
        let size = if_less(self.g, change, zero, back, change);
        let place = self.greater_end(change);
        let end = self.pair_at(e.of, place);
        let twice = scale(self.g, -2.0, size);
        let quotient = call(self.g, Prim::Exprel, twice);
        (end.value, self.grown(quotient, end.rest))
    }

    /// The part of e^(α + w + i(γ + v)) φ(-2(w + i v)) that the wave is, w + i v = ±(β + iδ)h with w ≥ 0.
    fn mean_of_damped_wave(&mut self, e: Affine, prim: Prim, phase: Affine) -> Id {
        let half = self.path.half;
        let zero = self.g.real(0.0);
        let (w, v) = (mul(self.g, e.slope, half), mul(self.g, phase.slope, half));
        // the phase at the end where the exponential is greater
        let place = self.greater_end(w);
        let (turn, top) = (self.pair_at(phase.of, place), self.pair_at(e.of, place));
        let [back, falling] = [v, w].map(|x| self.g.neg(x));
        let v = if_less(self.g, w, zero, back, v);
        let w = if_less(self.g, w, zero, falling, w);
        let twice = [w, v].map(|x| scale(self.g, -2.0, x));
        let argument = self.g.apply(Prim::Complex, &twice);
        let quotient = call(self.g, Prim::Exprel, argument);
        let [re, im] = [Prim::Re, Prim::Im].map(|part| call(self.g, part, quotient));
        let size = call(self.g, Prim::Exp, top.value);
        let mixed = self.turned(prim, turn, re, im);
        let mixed = self.grown(mixed, top.rest);
        mul(self.g, size, mixed)
    }

    /// The part of e^(iφ) (re + i im) that the wave is.
    pub(super) fn turned(&mut self, prim: Prim, angle: Pair, re: Id, im: Id) -> Id {
        let [sine, cosine] = [Prim::Sin, Prim::Cos].map(|p| self.wave_of(p, angle));
        if prim == Prim::Sin {
            let (a, b) = (mul(self.g, sine, re), mul(self.g, cosine, im));
            add(self.g, a, b)
        } else {
            let (a, b) = (mul(self.g, cosine, re), mul(self.g, sine, im));
            sub(self.g, a, b)
        }
    }

    /// ∫ p e^λs = [e^λs (p - (p' - (p'' - …)/λ)/λ)/λ] at both ends, for one wave; the derivatives of p at the ends
    /// are given.
    pub(super) fn by_parts(&mut self, ends: &[(f64, Values); 2], wave: &Wave) -> Id {
        let mut sum = self.g.real(0.0);
        for (side, values) in ends {
            let part = self.end(wave, *side, values);
            let part = scale(self.g, *side, part);
            sum = add(self.g, sum, part);
        }
        sum
    }

    /// A product of polynomials and its derivatives.
    pub(super) fn derivatives(&mut self, polynomials: &[Id], degree: u32) -> Vec<Id> {
        let one = self.g.real(1.0);
        let mut derivatives = vec![polynomials.iter().fold(one, |p, &q| mul(self.g, p, q))];
        for _ in 0..degree {
            let last = derivatives[derivatives.len() - 1];
            derivatives.push(self.slope(last));
        }
        derivatives
    }

    /// The derivatives of a product of polynomials at both ends.
    pub(super) fn derivatives_at_ends(
        &mut self,
        polynomials: &[Id],
        degree: u32,
    ) -> [(f64, Values); 2] {
        let derivatives = self.derivatives(polynomials, degree);
        let leaves = self.path.coordinates.iter().map(|c| c.leaf);
        let body = Body::new(self.g, &derivatives, leaves);
        [(1.0, 1), (-1.0, 0)].map(|(side, which)| {
            let values = self.path.end(self.g, which);
            (side, body.at(self.g, &values))
        })
    }

    /// The antiderivative of a polynomial, given by its derivatives at an end, times one wave.
    pub(super) fn end(&mut self, of: &Wave, side: f64, values: &[Id]) -> Id {
        let place = self.path.ends[usize::from(side > 0.0)];
        let at_end = |this: &mut Self, a: Affine| this.pair_at(a.of, place);
        let exponent = of.exponent.map(|e| (at_end(self, e), e.slope));
        let wave = of
            .wave
            .map(|(prim, phase)| (prim, at_end(self, phase), phase.slope));
        match (exponent, wave) {
            (Some((top, rate)), None) => {
                let sum = self.nested(values, rate);
                let size = call(self.g, Prim::Exp, top.value);
                let sum = self.grown(sum, top.rest);
                mul(self.g, size, sum)
            }
            (None, Some((prim @ (Prim::Sinh | Prim::Cosh), top, rate))) => {
                // even derivatives keep the kind of the wave turned once, odd ones turn it back
                let [sinh, cosh] = [Prim::Sinh, Prim::Cosh].map(|p| self.wave_of(p, top));
                let (first, second) = if prim == Prim::Sinh {
                    (cosh, sinh)
                } else {
                    (sinh, cosh)
                };
                self.alternating(values, rate, [first, second], false)
            }
            (None, Some((prim, top, rate))) => {
                let [sine, cosine] = [Prim::Sin, Prim::Cos].map(|p| self.wave_of(p, top));
                let (first, second) = if prim == Prim::Sin {
                    (self.g.neg(cosine), sine)
                } else {
                    (sine, cosine)
                };
                self.alternating(values, rate, [first, second], true)
            }
            (Some((top, rate)), Some((prim, turn, speed))) => {
                let rate = self.g.apply(Prim::Complex, &[rate, speed]);
                let sum = self.nested(values, rate);
                let [re, im] = [Prim::Re, Prim::Im].map(|part| call(self.g, part, sum));
                let size = call(self.g, Prim::Exp, top.value);
                let mixed = self.turned(prim, turn, re, im);
                let mixed = self.grown(mixed, top.rest);
                mul(self.g, size, mixed)
            }
            (None, None) => self.g.real(0.0),
        }
    }

    /// (p - (p' - (p'' - …)/λ)/λ)/λ
    fn nested(&mut self, values: &[Id], rate: Id) -> Id {
        let mut sum = self.g.real(0.0);
        for &value in values.iter().rev() {
            let rest = sub(self.g, value, sum);
            sum = self.g.div(rest, rate);
        }
        sum
    }

    /// Σ p⁽ᵏ⁾/δᵏ⁺¹ times the waves in turn. `turns` tells circular waves, whose signs go + + - -, from hyperbolic ones,
    /// whose signs go + - + -.
    fn alternating(&mut self, values: &[Id], rate: Id, waves: [Id; 2], turns: bool) -> Id {
        let mut sums = [self.g.real(0.0), self.g.real(0.0)];
        // in pairs from the last: p⁽ᵏ⁾ ∓ p⁽ᵏ⁺²⁾/δ² …
        let square = self.g.apply(Prim::PowInt(2), &[rate]);
        for (k, &value) in values.iter().enumerate().rev() {
            let sum = &mut sums[k % 2];
            let rest = self.g.div(*sum, square);
            let rest = if super::arithmetic::is_zero(self.g, *sum) {
                *sum
            } else {
                rest
            };
            *sum = if turns {
                sub(self.g, value, rest)
            } else {
                add(self.g, value, rest)
            };
        }
        let even = self.g.div(sums[0], rate);
        let odd = self.g.div(sums[1], square);
        let (first, second) = (mul(self.g, even, waves[0]), mul(self.g, odd, waves[1]));
        if turns {
            add(self.g, first, second)
        } else {
            sub(self.g, first, second)
        }
    }
}

/// The factors of a term by kind.
pub(super) struct Parts {
    pub polynomials: Vec<Id>,
    pub exponent: Option<Id>,
    pub waves: Vec<(Prim, Id)>,
    /// Every other factor.
    pub rest: Vec<Factor>,
}

impl Parts {
    pub(super) fn of(term: &Term) -> Self {
        let mut out = Self {
            polynomials: Vec::new(),
            exponent: None,
            waves: Vec::new(),
            rest: Vec::new(),
        };
        for &factor in &term.factors {
            match factor {
                Factor::Polynomial(p) => out.polynomials.push(p),
                Factor::Exponential(e) if out.exponent.is_none() => out.exponent = Some(e),
                Factor::Wave(prim, phase) => out.waves.push((prim, phase)),
                other => out.rest.push(other),
            }
        }
        out
    }
}
