//! Polynomials of high degree, or whose terms may cancel, at nodes whose coordinates are known with their rests.
//!
//! A power x²⁰ is rounded by twenty times what x is, and some twenty times more on the way; beside a zero of a sum of such
//! that is all that is left. With pairs each node is right to 2⁻⁴⁴ of the sizes of the terms, for about four times the
//! operations. So a bound tells where it is needed.

use rustc_hash::FxHashMap;

use super::Integrator;
use super::arithmetic::{add, scale};
use super::legendre::{Node, gauss_legendre};
use super::path::cone;
use crate::ir::{Id, Op, Prim};

/// By how many half units in the last place a value of a polynomial may be rounded where it is taken as it is written:
/// 1e-6 of binary32.
const MAX_ROUNDINGS: u32 = 16;
/// How many a coordinate at a node has, or a polynomial of degree 2 in what is known from the middle.
const ROUNDINGS: u32 = 2;

impl Integrator<'_> {
    /// Whether a polynomial of a degree above 2, with its parts of degree 1 and 2 known to two roundings, may be rounded by
    /// more than 1e-6 of itself. Of what is no sum, product or power nothing is told.
    pub(super) fn needs_pairs(&mut self, root: Id) -> bool {
        let mut known: FxHashMap<Id, u32> = FxHashMap::default();
        for id in cone(self.g, &[root]) {
            let degree = self.degree(id);
            let count = match degree {
                Some(0) => 0,
                Some(1 | 2) => ROUNDINGS,
                _ => {
                    let node = self.g.node(id).clone();
                    let of = |k: usize| known.get(&node.args[k]).copied().unwrap_or(0);
                    match node.op {
                        Op::Apply(Prim::Neg) => of(0),
                        Op::Apply(Prim::Add) if self.is_positive(id) => of(0).max(of(1)) + 1,
                        Op::Apply(Prim::Add | Prim::Sub) => return true,
                        Op::Apply(Prim::Mul | Prim::Div) => of(0) + of(1) + 1,
                        Op::Apply(Prim::PowInt(n)) => n.unsigned_abs() * (of(0) + 1),
                        _ => return false,
                    }
                }
            };
            known.insert(id, count);
        }
        known.get(&root).is_some_and(|&count| count > MAX_ROUNDINGS)
    }

    /// Whether an expression is a sum of even powers and of constants that are not negative.
    fn is_positive(&mut self, id: Id) -> bool {
        let mut stack = vec![id];
        while let Some(of) = stack.pop() {
            let node = self.g.node(of).clone();
            let is_positive = |v: f64| v >= 0.0;
            match (node.op, node.args.as_slice()) {
                (Op::Apply(Prim::Add), args) => stack.extend(args),
                (Op::Apply(Prim::Mul), &[a, b]) if a != b => stack.extend([a, b]),
                (Op::Apply(Prim::Mul), _) => {}
                (Op::Apply(Prim::PowInt(n)), _) if n % 2 == 0 => {}
                _ if self.g.as_real(of).is_some_and(is_positive) => {}
                _ => return false,
            }
        }
        true
    }

    /// The mean along the path of a polynomial by nodes that are pairs; `None` where it has operations without pairs.
    pub(super) fn paired_mean(&mut self, root: Id, count: usize) -> Option<Id> {
        let path = self.path.clone();
        let mut sum = self.g.real(0.0);
        for Node { place, weight } in gauss_legendre(count) {
            let sides: &[f64] = if place == 0.0 { &[0.0] } else { &[1.0, -1.0] };
            let mut both = self.g.real(0.0);
            for &side in sides {
                let values = path.pairs_at_place(self.g, side * place);
                let value = self.try_pair(root, &values)?.total(self.g);
                both = add(self.g, both, value);
            }
            let part = scale(self.g, 0.5 * weight, both);
            sum = add(self.g, sum, part);
        }
        Some(sum)
    }
}
