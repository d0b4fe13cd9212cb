//! Products that were written out: on short intervals they are taken as they are written.
//!
//! (1 - |p|)² is 1 - 2 |p| + |p|² to the rules, which cancels where |p| is near 1. Where every factor changes little
//! along the interval, nodes of Gauss and Legendre take the product as it is.

use rustc_hash::FxHashMap;

use super::Integrator;
use super::algebraic::NEAR_NODES;
use super::arithmetic::{add, call, mul, scale, square};
use super::exponential::NEAR;
use super::legendre::nodes_for_exponential;
use super::term::{Factor, Term};
use crate::ir::{Id, Prim};

/// What the exponents and phases of a product may change by together where it is taken as it is.
const CHANGE: f64 = 2.0;
/// The same where there are only waves, the sum of which cancels beside a zero of the product.
const CHANGE_OF_WAVES: f64 = 10.0;
/// How much more a function whose singularities are π/2 away from the real line counts.
const WEIGHT: f64 = 4.0;

/// What is known of the terms that come of one product.
#[derive(Debug, Default)]
pub(super) struct Groups {
    of: Vec<(Id, Vec<(Term, Id)>)>,
}

impl Groups {
    /// Remembers the integral of a term of a product.
    pub(super) fn push(&mut self, product: Id, term: Term, value: Id) {
        match self.of.iter_mut().find(|g| g.0 == product) {
            Some(group) => group.1.push((term, value)),
            None => self.of.push((product, vec![(term, value)])),
        }
    }
}

impl Integrator<'_> {
    /// Σ of the integrals of all products.
    pub(super) fn sum_of_groups(&mut self, groups: Groups, all_closed: bool) -> Id {
        let mut sum = self.g.real(0.0);
        for (product, terms) in groups.of {
            let mut far = self.g.real(0.0);
            for (_, value) in &terms {
                far = add(self.g, far, *value);
            }
            let value = if all_closed && terms.len() > 1 {
                self.as_written(product, &terms, far)
            } else {
                far
            };
            sum = add(self.g, sum, value);
        }
        sum
    }

    fn as_written(&mut self, product: Id, terms: &[(Term, Id)], far: Id) -> Id {
        let Some((conditions, nodes)) = self.is_short(terms) else {
            return far;
        };
        if !self.moves(product) {
            return far;
        }
        let near = self.local_gauss(product, nodes);
        let short = conditions
            .into_iter()
            .reduce(|a, b| self.g.apply(Prim::And, &[a, b]));
        match short {
            Some(short) => self.g.apply(Prim::Select, &[short, near, far]),
            None => far,
        }
    }

    /// The conditions under which every factor changes little, and how many nodes are then enough. `None` where
    /// a factor has no such condition.
    fn is_short(&mut self, terms: &[(Term, Id)]) -> Option<(Vec<Id>, usize)> {
        let mut counts: FxHashMap<(bool, Id), u32> = FxHashMap::default();
        let mut bases: Vec<Id> = Vec::new();
        let mut exponents: Vec<Id> = Vec::new();
        let mut degree = 0;
        for (term, _) in terms {
            let mut own: FxHashMap<(bool, Id), u32> = FxHashMap::default();
            let mut polynomial = 0;
            for factor in &term.factors {
                match *factor {
                    Factor::Polynomial(p) => polynomial += self.degree(p)?,
                    Factor::Wave(_, phase) => *own.entry((false, phase)).or_default() += 1,
                    // it changes faster the farther it falls
                    Factor::Function(Prim::Erfc, _) => return None,
                    Factor::Function(_, x) | Factor::Logistic(x) => {
                        *own.entry((true, x)).or_default() += 1
                    }
                    Factor::Exponential(e) if !exponents.contains(&e) => exponents.push(e),
                    Factor::Power(base, _) | Factor::Log(base) if !bases.contains(&base) => {
                        bases.push(base)
                    }
                    Factor::Series(_) | Factor::Other(_) => return None,
                    _ => {}
                }
            }
            degree = degree.max(polynomial);
            for (key, n) in own {
                let known = counts.entry(key).or_default();
                *known = (*known).max(n);
            }
        }
        let mut conditions = Vec::new();
        let mut counted: Vec<((bool, Id), u32)> = counts.into_iter().collect();
        counted.sort_unstable();
        let rates = self.rates(&counted, &exponents);
        let is_wave = |term: &(Term, Id)| {
            let is_wave = |f: &Factor| matches!(f, Factor::Wave(..));
            term.0.factors.iter().all(is_wave)
        };
        let most = if terms.iter().all(is_wave) {
            CHANGE_OF_WAVES
        } else {
            CHANGE
        };
        if let Some(change) = rates {
            let limit = self.g.real(most);
            conditions.push(self.g.apply(Prim::Less, &[change, limit]));
        }
        for &base in &bases {
            conditions.push(self.is_far_from_zero(base));
        }
        let least = if bases.is_empty() { 0 } else { NEAR_NODES };
        let nodes = nodes_for_exponential(most, 0, NEAR).max(least);
        Some((conditions, nodes + degree.div_ceil(2) as usize))
    }

    /// What the phases and exponents change by together, at most.
    fn rates(&mut self, counted: &[((bool, Id), u32)], exponents: &[Id]) -> Option<Id> {
        let half = call(self.g, Prim::Abs, self.path.half);
        let mut sum = self.g.real(0.0);
        let mut any = false;
        for &((is_singular, phase), n) in counted {
            let slope = self.affine(phase).slope;
            let rate = mul(self.g, slope, half);
            let rate = call(self.g, Prim::Abs, rate);
            let weight = if is_singular { WEIGHT } else { 1.0 };
            let rate = scale(self.g, weight * f64::from(n), rate);
            sum = add(self.g, sum, rate);
            any = true;
        }
        for &exponent in exponents {
            let q = self.quadratic(exponent);
            let (slope, curve) = (mul(self.g, q.b, half), square(self.g, half));
            let slope = scale(self.g, 2.0, slope);
            let curve = mul(self.g, q.a, curve);
            for part in [slope, curve] {
                let size = call(self.g, Prim::Abs, part);
                sum = add(self.g, sum, size);
            }
            any = true;
        }
        any.then_some(sum)
    }

    /// Whether the zeros of a polynomial of degree 1 or 2 are at least 2h from the middle.
    fn is_far_from_zero(&mut self, base: Id) -> Id {
        let half = self.path.half;
        if self.degree(base) == Some(1) {
            let x = self.affine(base);
            let w = mul(self.g, x.slope, half);
            let sizes = [w, x.mid].map(|v| call(self.g, Prim::Abs, v));
            let limit = scale(self.g, 0.5, sizes[1]);
            return self.g.apply(Prim::Less, &[sizes[0], limit]);
        }
        let q = self.quadratic(base);
        let reach = square(self.g, half);
        let reach = mul(self.g, q.a, reach);
        let reach = call(self.g, Prim::Abs, reach);
        let limit = scale(self.g, 0.25, q.c);
        self.g.apply(Prim::Less, &[reach, limit])
    }
}
