//! Polynomials beside waves and exponentials: Legendre coefficients with spherical Bessel functions, or by parts.

use super::Integrator;
use super::arithmetic::{add, call, if_less, mul, scale};
use super::exponential::{NEAR, Values, Wave};
use super::legendre::{gauss_legendre, nodes_for_exponential};
use super::path::Body;
use super::quadratic::Affine;
use crate::ir::{Id, Prim};

impl Integrator<'_> {
    /// Σ of the integrals of a polynomial beside each wave.
    pub(super) fn polynomial_by_waves(
        &mut self,
        polynomials: &[Id],
        degree: u32,
        waves: &[Wave],
    ) -> Id {
        let one = self.g.real(1.0);
        let product = polynomials.iter().fold(one, |p, &q| mul(self.g, p, q));
        let coefficients = self.legendre_coefficients(product, degree);
        let is_plain = |w: &Wave| w.exponent.is_none() && w.wave.is_none_or(|w| is_round(w.0));
        let ends = if waves.iter().all(is_plain) {
            None
        } else {
            Some(self.derivatives_at_ends(polynomials, degree))
        };
        let mut sum = self.g.real(0.0);
        for wave in waves {
            let value =
                self.polynomial_by_wave(product, degree, &coefficients, ends.as_ref(), wave);
            let value = scale(self.g, wave.scale, value);
            sum = add(self.g, sum, value);
        }
        sum
    }

    /// With p(h x) = Σ cₙ Pₙ(x): ∫ p e^(iδs) = 2h Σ cₙ iⁿ jₙ(δh). Beside an exponential by parts, and nodes where the
    /// exponent changes by less than the degree and 2.
    ///
    /// NIST DLMF 10.54.2.
    fn polynomial_by_wave(
        &mut self,
        product: Id,
        degree: u32,
        coefficients: &[Id],
        ends: Option<&[(f64, Values); 2]>,
        wave: &Wave,
    ) -> Id {
        let half = self.path.half;
        let limit = f64::from(degree) + 2.0;
        let (mean, change) = match (wave.exponent, wave.wave) {
            // the mean of a polynomial is its first coefficient
            (None, None) => (coefficients[0], None),
            (Some(exponent), Some((prim, phase))) => {
                let near = self.by_nodes(
                    product,
                    degree,
                    &[(Prim::Exp, exponent), (prim, phase)],
                    limit,
                );
                let sizes = [exponent, phase].map(|a| call(self.g, Prim::Abs, a.slope));
                let size = self.g.add(sizes[0], sizes[1]);
                let size = mul(self.g, half, size);
                (near, Some(size))
            }
            (Some(phase), None) => {
                let near = self.by_nodes(product, degree, &[(Prim::Exp, phase)], limit);
                (near, Some(mul(self.g, phase.slope, half)))
            }
            (None, Some((prim, phase))) => {
                let width = mul(self.g, phase.slope, half);
                if is_round(prim) {
                    (self.sum_of_bessel(prim, phase, width, coefficients), None)
                } else {
                    (
                        self.by_nodes(product, degree, &[(prim, phase)], limit),
                        Some(width),
                    )
                }
            }
        };
        let length = self.length_of_path();
        let near = mul(self.g, length, mean);
        match (change, ends) {
            (Some(change), Some(ends)) => {
                let far = self.by_parts(ends, wave);
                let size = call(self.g, Prim::Abs, change);
                let limit = self.g.real(limit);
                if_less(self.g, size, limit, near, far)
            }
            _ => near,
        }
    }

    /// The mean of a polynomial beside exponentials and waves that change by less than `limit` together.
    fn by_nodes(&mut self, product: Id, degree: u32, waves: &[(Prim, Affine)], limit: f64) -> Id {
        let integrand = waves.iter().fold(product, |product, &(prim, a)| {
            let factor = call(self.g, prim, a.of);
            mul(self.g, product, factor)
        });
        let count = nodes_for_exponential(limit, degree as usize, NEAR);
        self.local_mean(integrand, count)
    }

    /// The mean over the path of a polynomial beside a sine or cosine: Σ cₙ iⁿ jₙ, even and odd orders apart.
    fn sum_of_bessel(&mut self, prim: Prim, phase: Affine, width: Id, coefficients: &[Id]) -> Id {
        let mut sums = [self.g.real(0.0), self.g.real(0.0)];
        for (n, &c) in (0_u8..).zip(coefficients) {
            let value = call(self.g, Prim::SphericalJ(n), width);
            let part = mul(self.g, c, value);
            let part = scale(self.g, if n % 4 >= 2 { -1.0 } else { 1.0 }, part);
            let sum = &mut sums[usize::from(n % 2)];
            *sum = add(self.g, *sum, part);
        }
        let [even, odd] = sums;
        let middle = self.pair_in_middle(phase.of);
        self.turned(prim, middle, even, odd)
    }

    /// cₙ = (n + ½) Σ wⱼ Pₙ(xⱼ) p(h xⱼ), exact with one node more than the degree; sums of both sides of the middle
    /// for even orders, differences for odd ones.
    fn legendre_coefficients(&mut self, product: Id, degree: u32) -> Vec<Id> {
        let leaves = self.path.coordinates.iter().map(|c| c.leaf);
        let body = Body::new(self.g, &[product], leaves);
        let zero = self.g.real(0.0);
        let orders = degree as usize + 1;
        let mut out = vec![zero; orders];
        for node in gauss_legendre(orders) {
            let s = scale(self.g, node.place, self.path.half);
            let values = self.path.point(self.g, s);
            let right = body.at(self.g, &values)[0];
            let (even, odd) = if node.place == 0.0 {
                (right, zero)
            } else {
                let back = self.g.neg(s);
                let values = self.path.point(self.g, back);
                let left = body.at(self.g, &values)[0];
                (self.g.add(right, left), self.g.sub(right, left))
            };
            let (mut last, mut legendre) = (0.0, 1.0);
            for (n, c) in (0_u32..).zip(&mut out) {
                let order = f64::from(n);
                let weight = (order + 0.5) * node.weight * legendre;
                let part = scale(self.g, weight, if n % 2 == 0 { even } else { odd });
                *c = add(self.g, *c, part);
                let next =
                    ((2.0 * order + 1.0) * node.place * legendre - order * last) / (order + 1.0);
                (last, legendre) = (legendre, next);
            }
        }
        out
    }
}

fn is_round(prim: Prim) -> bool {
    matches!(prim, Prim::Sin | Prim::Cos)
}
