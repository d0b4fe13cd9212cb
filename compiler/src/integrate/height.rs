//! The mean of k + c x for one coordinate x, by how far both ends of the line are from the place where it is 0.
//!
//! With u = o + k/c, the distance at t = 0, it is c/2 ((u + a d) + (u + b d)). Each end is one `fma`, right to half a unit
//! in its own last place, so that the sum is as good as ∫ |f| asks for whether its sign changes between the ends or not.
//! What is left is the rounding of u, one sum, whose rest is added. By way of the middle both the place and the density there
//! would have to be known with their rests.

use super::Integrator;
use super::arithmetic::{add, mul_add, scale, total};
use super::pair::sum_rest;
use crate::ir::{Graph, Id, Op, Prim};

/// Sizes of k/c and c that are far from overflow and underflow in every format.
const SIZES: std::ops::RangeInclusive<f64> = 1e-12..=1e12;

impl Integrator<'_> {
    /// The mean of such a density between two ends that are given as they are; `None` of another density or line.
    pub(super) fn mean_of_height(&mut self, root: Id) -> Option<Id> {
        let (c, leaf, k) = height(self.g, root)?;
        let coordinate = *self.path.coordinates.iter().find(|x| x.leaf == leaf)?;
        let is_given = |&end: &Id| matches!(self.g.node(end).op, Op::Input(_));
        if !self.path.ends.iter().all(is_given) {
            return None;
        }
        let (high, low) = quotient(k, c)?;
        let (high, low) = (self.g.real(high), self.g.real(low));
        let g = &mut *self.g;
        let distance = add(g, coordinate.origin, high);
        let own = sum_rest(g, coordinate.origin, high, distance);
        let rest = total(g, [own, coordinate.low, low]);
        let [from, to] = self.path.ends;
        let from = mul_add(g, from, coordinate.slope, distance);
        let to = mul_add(g, to, coordinate.slope, distance);
        let both = add(g, from, to);
        let two = g.real(2.0);
        let both = mul_add(g, two, rest, both);
        Some(scale(g, 0.5 * c, both))
    }
}

/// c, the leaf x and k of k + c x with constants c and k, as it may be written.
fn height(g: &Graph, root: Id) -> Option<(f64, Id, f64)> {
    let node = g.node(root);
    let sign = match node.op {
        Op::Apply(Prim::Add) => 1.0,
        Op::Apply(Prim::Sub) => -1.0,
        _ => return None,
    };
    let (a, b) = (node.args[0], node.args[1]);
    if let Some(k) = g.as_real(b) {
        let (c, leaf) = multiple(g, a)?;
        return Some((c, leaf, sign * k));
    }
    let k = g.as_real(a)?;
    let (c, leaf) = multiple(g, b)?;
    Some((sign * c, leaf, k))
}

/// c and x of c x with a constant c; x is anything else.
fn multiple(g: &Graph, id: Id) -> Option<(f64, Id)> {
    let node = g.node(id);
    match (node.op, node.args.as_slice()) {
        (Op::Apply(Prim::Neg), &[x]) => Some((-1.0, x)),
        (Op::Apply(Prim::Mul), &[a, b]) => match (g.as_real(a), g.as_real(b)) {
            (Some(c), None) => Some((c, b)),
            (None, Some(c)) => Some((c, a)),
            _ => None,
        },
        _ => Some((1.0, id)),
    }
}

/// k/c as a number of single precision and what is beyond it, 0 where that is no more than the last digit of k and c.
fn quotient(k: f64, c: f64) -> Option<(f64, f64)> {
    let whole = k / c;
    if !SIZES.contains(&whole.abs()) || !SIZES.contains(&c.abs()) {
        return None;
    }
    #[allow(clippy::cast_possible_truncation, reason = "the rest is kept")]
    let high = f64::from(whole as f32);
    let low = (whole - high) + (-whole).mul_add(c, k) / c;
    let is_there = low.abs() > whole.abs() * 2.0 * f64::EPSILON;
    Some((high, if is_there { low } else { 0.0 }))
}
