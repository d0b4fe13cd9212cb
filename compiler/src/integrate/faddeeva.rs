//! Faddeeva's w and its derivatives by one rational approximation, right to 3e-13 of each in the upper half-plane.
//!
//! w(z) = e^(-z²) erfc(-iz) = F(u) with u = 1/(ℓ - iz) and F = u/√π + 2 u² p(2 ℓ u - 1), p of degree 31: a polynomial in u.
//! As u(z + δ) = u (1 + v + v² + …) with v = i u δ, the Taylor coefficients of w are wₙ = (iu)ⁿ Sₙ with S₀ = F and
//! Sₙ = Σ binomial(n - 1, j - 1) uʲ F⁽ʲ⁾/j!. Nothing is divided, and far out each coefficient falls as it should.
//!
//! Weideman, "Computation of the complex error function", SIAM Journal on Numerical Analysis 31 (1994).

use std::f64::consts::PI;

use super::Integrator;
use super::arithmetic::{add, call, is_zero, square};
use super::pair::sum_rest;
use crate::ir::{Id, Prim};

/// Terms of the approximation.
const TERMS: usize = 32;
/// ℓ: next to the best, √(32/√2) = 4.757, and not rounded in any format.
const LENGTH: f64 = 4.75;
/// How near to 0 the recurrence is taken.
const NEAR_ZERO: f64 = 0.5;

impl Integrator<'_> {
    /// (step u)ⁿ Sₙ of x + iy with y ≥ 0, n < count, each as real and imaginary part. With the step 1/2 it is
    /// e^(z²) iⁿerfc z of z = y - ix (NIST DLMF 7.18); with the step i it is w⁽ⁿ⁾/n!.
    pub(super) fn faddeeva_family(
        &mut self,
        (x, y): (Id, Id),
        step: Id,
        count: usize,
    ) -> Vec<[Id; 2]> {
        let coefficients = weideman(LENGTH, TERMS);
        let (twice, length) = (self.g.real(2.0 * LENGTH), self.g.real(LENGTH));
        let (below, back) = (add(self.g, length, y), self.g.neg(x));
        // ℓ - y by the rounded ℓ + y, which is known to be rounded by the rest
        let above = self.g.sub(twice, below);
        let rest = sum_rest(self.g, length, y, below);
        let top = self.g.apply(Prim::Complex, &[above, x]);
        let bottom = self.g.apply(Prim::Complex, &[below, back]);
        let one = self.g.real(1.0);
        let mut u = self.g.div(one, bottom);
        let mut ratio = self.g.mul(top, u);
        if !is_zero(self.g, rest) {
            let part = self.g.mul(rest, u);
            let (of_u, of_ratio) = (self.g.mul(part, u), self.g.mul(part, ratio));
            u = self.g.sub(u, of_u);
            let both = self.g.add(part, of_ratio);
            ratio = self.g.sub(ratio, both);
        }
        let taylor = self.taylor_of_polynomial(&coefficients, ratio, count);
        let ahead = self.g.mul(twice, u);
        let functions = self.family_of(&taylor, u, ahead);
        let twice_step = add(self.g, step, step);
        let step = self.g.mul(step, u);
        let mut power = None;
        let mut out = Vec::with_capacity(count);
        for n in 0..count {
            let mut sum = functions[n];
            let mut binomial = 1.0;
            #[allow(clippy::cast_precision_loss, reason = "small counts")]
            for j in (1..n).rev() {
                binomial *= j as f64 / (n - j) as f64;
                let weight = self.g.real(binomial);
                let part = self.g.mul(weight, functions[j]);
                sum = self.g.add(sum, part);
            }
            let value = power.map_or(sum, |p| self.g.mul(p, sum));
            power = Some(power.map_or(step, |p| self.g.mul(p, step)));
            out.push(value);
        }
        self.beside_zero((x, y), twice_step, &mut out);
        out.into_iter()
            .map(|value| [Prim::Re, Prim::Im].map(|part| call(self.g, part, value)))
            .collect()
    }

    /// From the third on members within [`NEAR_ZERO`] of 0 by the two before: 2 n iⁿerfc z = iⁿ⁻²erfc z - 2 z iⁿ⁻¹erfc z (NIST DLMF
    /// 7.18.7), which is rounded half as much there.
    fn beside_zero(&mut self, (x, y): (Id, Id), twice_step: Id, family: &mut [Id]) {
        if family.len() < 3 {
            return;
        }
        let back = self.g.neg(x);
        let z = self.g.apply(Prim::Complex, &[y, back]);
        let [squares, limit] = [square(self.g, x), self.g.real(NEAR_ZERO * NEAR_ZERO)];
        let squares = self.g.apply(Prim::SquarePlus, &[y, squares]);
        let is_near = self.g.apply(Prim::Less, &[squares, limit]);
        let turn = self.g.mul(twice_step, z);
        let half = self.g.real(0.5);
        let rate = self.g.mul(twice_step, twice_step);
        let rate = self.g.mul(half, rate);
        for n in 2..family.len() {
            let (first, second) = (
                self.g.mul(rate, family[n - 2]),
                self.g.mul(turn, family[n - 1]),
            );
            let sum = self.g.sub(first, second);
            #[allow(clippy::cast_precision_loss, reason = "small counts")]
            let part = self.g.real(1.0 / n as f64);
            let value = self.g.mul(part, sum);
            family[n] = self.g.apply(Prim::Select, &[is_near, value, family[n]]);
        }
    }

    /// p⁽ʲ⁾/j! at a place, j < count, by repeated synthetic division.
    fn taylor_of_polynomial(&mut self, coefficients: &[f64], at: Id, count: usize) -> Vec<Id> {
        let zero = self.g.complex(0.0, 0.0);
        let mut out = vec![zero; count];
        for (k, &c) in coefficients.iter().rev().enumerate() {
            for j in (1..count.min(k + 1)).rev() {
                let product = if j == k { zero } else { self.g.mul(out[j], at) };
                out[j] = if j == k {
                    out[j - 1]
                } else {
                    self.g.add(product, out[j - 1])
                };
            }
            out[0] = if k == 0 {
                self.g.complex(c, 0.0)
            } else {
                let product = self.g.mul(out[0], at);
                let c = self.g.real(c);
                self.g.add(product, c)
            };
        }
        out
    }

    /// uʲ F⁽ʲ⁾/j!: of 2 u² (1 + y)² p(Z + 2 ℓ u y) + u (1 + y)/√π by powers of y.
    fn family_of(&mut self, taylor: &[Id], u: Id, ahead: Id) -> Vec<Id> {
        let two = self.g.real(2.0);
        let mut scaled = Vec::with_capacity(taylor.len());
        let mut power = None;
        for &t in taylor {
            scaled.push(power.map_or(t, |p| self.g.mul(p, t)));
            power = Some(power.map_or(ahead, |p| self.g.mul(p, ahead)));
        }
        let rest = self.g.real(1.0 / PI.sqrt());
        (0..taylor.len())
            .map(|j| {
                let mut sum = scaled[j];
                if j > 0 {
                    let before = self.g.mul(two, scaled[j - 1]);
                    sum = self.g.add(sum, before);
                }
                if j > 1 {
                    sum = self.g.add(sum, scaled[j - 2]);
                }
                let product = self.g.mul(sum, u);
                let mut value = self.g.mul(two, product);
                if j < 2 {
                    value = self.g.add(value, rest);
                }
                self.g.mul(value, u)
            })
            .collect()
    }
}

/// The coefficients of p, from the constant on: aₙ = (1/4N) Σ e^(-t²) (ℓ² + t²) cos nθ over θ = kπ/2N, |k| < 2N,
/// with t = ℓ tan(θ/2).
fn weideman(length: f64, terms: usize) -> Vec<f64> {
    #[allow(clippy::cast_precision_loss, reason = "small counts")]
    let count = terms as f64;
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
    out
}
