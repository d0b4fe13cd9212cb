//! Nodes of an integrand on an interval on which it changes little, by what is in it of degree 1 and 2.
//!
//! Beside a zero of such a polynomial, or where it is the exponent or the phase of something, its rounding at each node
//! would count more than that of all else. So each is known once in the middle of the interval, with its rest, and the
//! nodes take what it changes by from there: e^(q + δ) = e^q e^δ, log(q + δ) = log q + log(1 + δ/q), sin(φ + δ) =
//! sin φ cos δ + cos φ sin δ.

use rustc_hash::FxHashMap;

use super::Integrator;
use super::algebraic::Bowl;
use super::arithmetic::{add, call, div, if_less, mul, mul_add, scale, sub};
use super::legendre::{Node, gauss_legendre};
use super::pair::Pair;
use super::path::Body;
use crate::ir::{Id, Op, Prim};

/// What an integrand has of degree 1 or 2, without what is part of something larger that has.
pub(super) enum Kind {
    /// The polynomial itself.
    Polynomial,
    /// e to it.
    Exponential,
    /// Its logarithm.
    Logarithm,
    /// Its sine or cosine.
    Wave(Prim),
}

/// One of these, seen from the middle of the path.
pub(super) struct Local {
    /// The node of the integrand that it is.
    pub(super) id: Id,
    pub(super) kind: Kind,
    pub(super) middle: Pair,
    /// The value, e to it, its logarithm, or its sine and cosine in the middle.
    pub(super) values: [Id; 2],
    /// Half the curvature, and the slope in the middle.
    pub(super) curve: Id,
    pub(super) slope: Id,
    /// Where it is seen from, measured from the middle.
    pub(super) from: Id,
}

impl Integrator<'_> {
    /// ∫ by Gauss-Legendre nodes, each by what the integrand changes by from the middle: Σ h wⱼ f(h xⱼ).
    pub(super) fn local_gauss(&mut self, root: Id, count: usize) -> Id {
        let mean = self.local_mean(root, count);
        let length = self.length_of_path();
        mul(self.g, length, mean)
    }

    /// The same, exponentials of degree 2 seen from another t than the middle: from where they are greatest what they change by is
    /// rounded least where it counts.
    pub(super) fn local_gauss_from(&mut self, root: Id, count: usize, place: Id) -> Id {
        let Some(found) = self.locals_of(root) else {
            return self.local_gauss(root, count);
        };
        let locals: Vec<Local> = found
            .into_iter()
            .map(|(id, kind)| self.local_from(id, kind, place))
            .collect();
        let mean = self.mean_of_locals(root, &locals, count);
        let length = self.length_of_path();
        mul(self.g, length, mean)
    }

    /// The same, a sum of squares seen from the end where it is less: from the middle it would be what is left of its value there,
    /// which counts where it is divided by.
    pub(super) fn gauss_of_bowl(&mut self, root: Id, bowl: &Bowl, count: usize) -> Id {
        let base = bowl.q.of;
        let is_beside = |(id, kind): &(Id, Kind)| *id == base && matches!(kind, Kind::Polynomial);
        let found = bowl.is_sum_of_squares.then(|| self.locals_of(root));
        let Some(found) = found.flatten().filter(|all| all.iter().any(is_beside)) else {
            return self.local_gauss(root, count);
        };
        let [first, last] = bowl.ends;
        let half = self.path.half;
        let back = self.g.neg(half);
        // counted from the lesser end on
        let ahead = if_less(self.g, last, first, back, half);
        let least = self.g.apply(Prim::Min, &[first, last]);
        let slope = if_less(self.g, last, first, bowl.q.slopes[1], bowl.q.slopes[0]);
        let slope = scale(self.g, 2.0, slope);
        let others: Vec<Local> = found
            .into_iter()
            .filter(|local| !is_beside(local))
            .map(|(id, kind)| self.local(id, kind))
            .collect();
        let leaves = others.iter().map(|l| l.id).chain(std::iter::once(base));
        let body = Body::new(self.g, &[root], leaves);
        let mut sum = self.g.real(0.0);
        for Node { place, weight } in gauss_legendre(count) {
            let sides: &[f64] = if place == 0.0 { &[1.0] } else { &[1.0, -1.0] };
            let s = scale(self.g, place, ahead);
            let mut both = self.g.real(0.0);
            for &side in sides {
                let mut values: Vec<(Id, Id)> = others
                    .iter()
                    .map(|l| (l.id, self.local_value(l, s, side)))
                    .collect();
                let u = scale(self.g, 1.0 + side * place, ahead);
                let rate = mul_add(self.g, u, bowl.q.a, slope);
                values.push((base, mul_add(self.g, u, rate, least)));
                let value = body.at(self.g, &values)[0];
                both = add(self.g, both, value);
            }
            let part = scale(self.g, 0.5 * weight, both);
            sum = add(self.g, sum, part);
        }
        let length = self.length_of_path();
        mul(self.g, length, sum)
    }

    /// The mean along the path by the same nodes.
    pub(super) fn local_mean(&mut self, root: Id, count: usize) -> Id {
        if !self.moves(root) {
            return root;
        }
        match self.degree(root) {
            Some(1) if self.may_cancel(root) => {
                if let Some(mean) = self.mean_of_height(root) {
                    return mean;
                }
                let middle = self.pair_in_middle(root);
                return middle.total(self.g);
            }
            Some(1) => return self.mean(root, count),
            Some(3..) if self.needs_pairs(root) => {
                if let Some(mean) = self.paired_mean(root, count) {
                    return mean;
                }
            }
            _ => {}
        }
        let Some(found) = self.locals_of(root) else {
            return self.mean(root, count);
        };
        let locals: Vec<Local> = found
            .into_iter()
            .map(|(id, kind)| self.local(id, kind))
            .collect();
        if let Some(mean) = self.mean_of_changes(root, &locals, count) {
            return mean;
        }
        self.mean_of_locals(root, &locals, count)
    }

    fn mean_of_locals(&mut self, root: Id, locals: &[Local], count: usize) -> Id {
        let body = Body::new(self.g, &[root], locals.iter().map(|l| l.id));
        let mut sum = self.g.real(0.0);
        for Node { place, weight } in gauss_legendre(count) {
            let sides: &[f64] = if place == 0.0 { &[1.0] } else { &[1.0, -1.0] };
            let mut both = self.g.real(0.0);
            for &side in sides {
                let s = scale(self.g, place, self.path.half);
                let values: Vec<(Id, Id)> = locals
                    .iter()
                    .map(|l| (l.id, self.local_value(l, s, side)))
                    .collect();
                let value = body.at(self.g, &values)[0];
                both = add(self.g, both, value);
            }
            let part = scale(self.g, 0.5 * weight, both);
            sum = add(self.g, sum, part);
        }
        sum
    }

    /// The largest parts of degree 1 or 2, and exponentials and waves of such. `None` where something else changes along
    /// the path.
    fn locals_of(&mut self, root: Id) -> Option<Vec<(Id, Kind)>> {
        let mut out: FxHashMap<Id, Kind> = FxHashMap::default();
        let mut stack = vec![root];
        let mut seen = rustc_hash::FxHashSet::default();
        while let Some(id) = stack.pop() {
            if !seen.insert(id) || !self.moves(id) {
                continue;
            }
            let node = self.g.node(id).clone();
            if matches!(self.degree(id), Some(1 | 2)) {
                if self.is_product_of_lines(id) {
                    stack.extend(node.args);
                } else {
                    out.insert(id, Kind::Polynomial);
                }
                continue;
            }
            let Op::Apply(prim) = node.op else {
                return None;
            };
            let of = node.args.first().and_then(|&a| self.degree(a));
            match (prim, of) {
                (Prim::Exp, Some(1 | 2)) => _ = out.insert(id, Kind::Exponential),
                (Prim::Log, Some(1 | 2)) => _ = out.insert(id, Kind::Logarithm),
                (Prim::Sin | Prim::Cos, Some(1)) => _ = out.insert(id, Kind::Wave(prim)),
                _ => stack.extend(node.args),
            }
        }
        let mut out: Vec<(Id, Kind)> = out.into_iter().collect();
        out.sort_unstable_by_key(|l| l.0);
        Some(out)
    }

    /// Whether a polynomial of degree 2 is a product of two of degree 1, or a multiple of one: beside a zero of theirs its value by
    /// the curvature would cancel.
    fn is_product_of_lines(&mut self, id: Id) -> bool {
        let node = self.g.node(id).clone();
        if self.degree(id) != Some(2) {
            return false;
        }
        match (node.op, node.args.as_slice()) {
            (Op::Apply(Prim::Mul), &[a, b]) => {
                let of = [a, b].map(|x| if self.moves(x) { self.degree(x) } else { None });
                match of {
                    [Some(1), Some(1)] => true,
                    [None, _] => self.is_product_of_lines(b),
                    [_, None] => self.is_product_of_lines(a),
                    _ => false,
                }
            }
            (Op::Apply(Prim::PowInt(2)), &[a]) => self.degree(a) == Some(1),
            _ => false,
        }
    }

    fn local(&mut self, id: Id, kind: Kind) -> Local {
        let of = match kind {
            Kind::Polynomial => id,
            _ => self.g.node(id).args[0],
        };
        let middle = if matches!(kind, Kind::Polynomial) && !self.may_cancel(of) {
            let value = self.at_middle(of);
            Pair::exact(self.g, value)
        } else {
            self.pair_in_middle(of)
        };
        let slope = self.slope(of);
        let curve = self.slope(slope);
        let [slope, curve] = [slope, curve].map(|id| self.at_middle(id));
        let values = match kind {
            Kind::Polynomial => [middle.total(self.g); 2],
            Kind::Exponential => [call(self.g, Prim::Exp, middle.value); 2],
            Kind::Logarithm => [call(self.g, Prim::Log, middle.value); 2],
            Kind::Wave(_) => [Prim::Sin, Prim::Cos].map(|p| self.wave_of(p, middle)),
        };
        Local {
            id,
            kind,
            middle,
            values,
            curve: scale(self.g, 0.5, curve),
            slope,
            from: self.g.real(0.0),
        }
    }

    /// An exponential of degree 2 seen from a t, all else from the middle.
    fn local_from(&mut self, id: Id, kind: Kind, place: Id) -> Local {
        let out = self.local(id, kind);
        let of = self.g.node(id).args.first().copied().unwrap_or(id);
        if !matches!(out.kind, Kind::Exponential) || self.degree(of) != Some(2) {
            return out;
        }
        let there = self.pair_at(of, place);
        let slope = self.slope(of);
        let slope = self.at_place(&[slope], place)[0];
        let from = sub(self.g, place, self.path.middle);
        Local {
            middle: there,
            values: [call(self.g, Prim::Exp, there.value); 2],
            slope,
            from: sub(self.g, from, self.path.middle_low),
            ..out
        }
    }

    /// At s on one side of the middle.
    fn local_value(&mut self, of: &Local, s: Id, side: f64) -> Id {
        let g = &mut *self.g;
        if let Kind::Wave(prim) = of.kind {
            let change = mul(g, s, of.slope);
            let [sine, cosine] = [Prim::Sin, Prim::Cos].map(|p| call(g, p, change));
            let sine = scale(g, side, sine);
            let [up, along] = of.values;
            if prim == Prim::Sin {
                let product = mul(g, along, sine);
                return mul_add(g, up, cosine, product);
            }
            let product = mul(g, up, sine);
            let back = g.neg(product);
            return mul_add(g, along, cosine, back);
        }
        let s = scale(g, side, s);
        let s = sub(g, s, of.from);
        let rate = mul_add(g, s, of.curve, of.slope);
        if matches!(of.kind, Kind::Polynomial) {
            return mul_add(g, s, rate, of.values[0]);
        }
        let change = mul_add(g, s, rate, of.middle.rest);
        if matches!(of.kind, Kind::Logarithm) {
            let part = div(g, change, of.middle.value);
            let growth = call(g, Prim::Log1p, part);
            return add(g, of.values[0], growth);
        }
        let growth = call(g, Prim::Exp, change);
        mul(g, of.values[0], growth)
    }

    /// Whether a polynomial of degree 1 or 2 may be much smaller than what it is the sum of: not a multiple of a
    /// coordinate or of its square, nor a sum of such squares and constants none of which is negative.
    pub(super) fn may_cancel(&mut self, id: Id) -> bool {
        let mut stack = vec![id];
        while let Some(of) = stack.pop() {
            let node = self.g.node(of).clone();
            let Op::Apply(prim) = node.op else { continue };
            match (prim, node.args.as_slice()) {
                (Prim::Neg, &[a]) => stack.push(a),
                (Prim::Mul, &[a, b]) if !self.moves(a) => stack.push(b),
                (Prim::Mul | Prim::Div, &[a, b]) if !self.moves(b) => stack.push(a),
                (Prim::Mul, &[a, b]) => stack.extend([a, b]),
                (Prim::PowInt(_), &[a]) => stack.push(a),
                (Prim::Hypot | Prim::Hypot3 | Prim::Sqrt | Prim::Abs, args) => stack.extend(args),
                (Prim::Add, &[a, b]) if self.is_sum_of_squares(of) => {
                    stack.extend([a, b].into_iter().filter(|&x| self.moves(x)));
                }
                _ if self.moves(of) => return true,
                _ => {}
            }
        }
        false
    }
}
