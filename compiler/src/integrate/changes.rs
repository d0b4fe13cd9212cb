//! Nodes of sums of waves that may cancel: the integrand in the middle is known as a pair, and each node takes what it
//! changes by from there.
//!
//! Beside a zero, sin x cos y + sin y cos z is what is left of terms near 1, and their roundings would be most of it. The
//! middle has the rests of its waves, sums and products. What a product changes by is a Δb + Δa (b + Δb), which is as
//! small as the changes are, and so are its roundings.

use rustc_hash::{FxHashMap, FxHashSet};

use super::Integrator;
use super::arithmetic::{add, call, div, mul, mul_add, scale, sub};
use super::legendre::{Node, gauss_legendre};
use super::local::{Kind, Local};
use super::pair::Pair;
use crate::ir::{Id, Op, Prim};

/// Greatest power that is told apart.
const MAX_POWER: i32 = 16;

/// An integrand above its local parts.
struct Above {
    /// Operations that change along the path, operands before users.
    order: Vec<Id>,
    /// Each in the middle, and the local parts.
    middle: FxHashMap<Id, Pair>,
    /// The same as one number each.
    totals: FxHashMap<Id, Id>,
}

impl Integrator<'_> {
    /// The mean along the path; `None` where there is no wave, nothing may cancel, or an operation is none of those that
    /// are told apart.
    pub(super) fn mean_of_changes(
        &mut self,
        root: Id,
        locals: &[Local],
        count: usize,
    ) -> Option<Id> {
        if !locals.iter().any(|l| matches!(l.kind, Kind::Wave(_))) {
            return None;
        }
        let order = self.above(root, locals)?;
        if !self.sums_may_cancel(&order, locals) {
            return None;
        }
        let above = self.in_the_middle(order, locals)?;
        let base = above.middle.get(&root)?.normalised(self.g);
        let mut sum = self.g.real(0.0);
        for Node { place, weight } in gauss_legendre(count) {
            let sides: &[f64] = if place == 0.0 { &[1.0] } else { &[1.0, -1.0] };
            let mut both = self.g.real(0.0);
            for &side in sides {
                let step = scale(self.g, place, self.path.half);
                let changes = locals
                    .iter()
                    .map(|l| (l.id, self.local_change(l, &above, step, side)))
                    .collect();
                let change = self.change_of(root, &above, changes)?;
                let beside = add(self.g, base.rest, change);
                let value = add(self.g, base.value, beside);
                both = add(self.g, both, value);
            }
            let part = scale(self.g, 0.5 * weight, both);
            sum = add(self.g, sum, part);
        }
        Some(sum)
    }

    /// The sums, products and powers above the local parts; `None` where there is anything else.
    fn above(&mut self, root: Id, locals: &[Local]) -> Option<Vec<Id>> {
        let below: FxHashSet<Id> = locals.iter().map(|l| l.id).collect();
        let mut out: FxHashSet<Id> = FxHashSet::default();
        let mut stack = vec![root];
        while let Some(id) = stack.pop() {
            if below.contains(&id) || !self.moves(id) || !out.insert(id) {
                continue;
            }
            let node = self.g.node(id).clone();
            match node.op {
                Op::Apply(Prim::Add | Prim::Sub | Prim::Mul | Prim::Neg) => {}
                Op::Apply(Prim::PowInt(n)) if (1..=MAX_POWER).contains(&n) => {}
                Op::Apply(Prim::Div) if !self.moves(node.args[1]) => {}
                _ => return None,
            }
            stack.extend(node.args);
        }
        let mut out: Vec<Id> = out.into_iter().collect();
        out.sort_unstable();
        Some(out)
    }

    /// Whether one of the sums may be 0, by the ranges of waves, exponentials and squares.
    fn sums_may_cancel(&mut self, order: &[Id], locals: &[Local]) -> bool {
        let mut ranges: FxHashMap<Id, [f64; 2]> = FxHashMap::default();
        for local in locals {
            let range = match local.kind {
                Kind::Wave(_) => [-1.0, 1.0],
                Kind::Exponential => [0.0, f64::INFINITY],
                Kind::Polynomial if !self.may_cancel(local.id) => [0.0, f64::INFINITY],
                Kind::Polynomial | Kind::Logarithm => [f64::NEG_INFINITY, f64::INFINITY],
            };
            ranges.insert(local.id, range);
        }
        for &id in order {
            let node = self.g.node(id).clone();
            let of = |k: usize| self.range(&ranges, node.args[k]);
            let Op::Apply(prim) = node.op else { continue };
            let range = match prim {
                Prim::Neg => of(0).map(|v| -v),
                Prim::Add => [of(0)[0] + of(1)[0], of(0)[1] + of(1)[1]],
                Prim::Sub => [of(0)[0] - of(1)[1], of(0)[1] - of(1)[0]],
                Prim::PowInt(n) if n % 2 == 0 => [0.0, f64::INFINITY],
                Prim::Mul if node.args[0] == node.args[1] => [0.0, f64::INFINITY],
                Prim::Mul => product_of_ranges(of(0), of(1)),
                Prim::Div => product_of_ranges(of(0), of(1).map(|v| 1.0 / v)),
                _ => [f64::NEG_INFINITY, f64::INFINITY],
            };
            let range = [range[0].min(range[1]), range[0].max(range[1])];
            let is_apart = range[0] > 0.0 || range[1] < 0.0;
            if matches!(prim, Prim::Add | Prim::Sub) && !is_apart {
                return true;
            }
            ranges.insert(id, range);
        }
        false
    }

    fn range(&self, known: &FxHashMap<Id, [f64; 2]>, id: Id) -> [f64; 2] {
        let constant = self.g.as_real(id).map(|v| [v, v]);
        let range = known.get(&id).copied().or(constant);
        range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY])
    }

    fn in_the_middle(&mut self, order: Vec<Id>, locals: &[Local]) -> Option<Above> {
        let mut middle: FxHashMap<Id, Pair> = FxHashMap::default();
        for local in locals {
            let pair = self.local_pair(local);
            middle.insert(local.id, pair);
        }
        for &id in &order {
            for arg in self.g.node(id).args.clone() {
                if !self.moves(arg) {
                    let pair = Pair::exact(self.g, arg);
                    middle.insert(arg, pair);
                }
            }
            let pair = self.pair_of_operation(id, &middle)?;
            middle.insert(id, pair);
        }
        let totals = middle
            .iter()
            .map(|(&id, pair)| (id, pair.total(self.g)))
            .collect();
        Some(Above {
            order,
            middle,
            totals,
        })
    }

    /// A local part in the middle.
    fn local_pair(&mut self, of: &Local) -> Pair {
        let rest = of.middle.rest;
        match of.kind {
            Kind::Polynomial => of.middle,
            Kind::Exponential => Pair {
                value: of.values[0],
                rest: mul(self.g, of.values[0], rest),
            },
            Kind::Logarithm => Pair {
                value: of.values[0],
                rest: div(self.g, rest, of.middle.value),
            },
            Kind::Wave(prim) => self.wave_pair(prim, of.middle),
        }
    }

    /// sin or cos of a phase with a rest: sin γ with what it is rounded by, and the rest of the phase by the slope.
    pub(super) fn wave_pair(&mut self, prim: Prim, phase: Pair) -> Pair {
        let value = call(self.g, prim, phase.value);
        let (rounding, slope, sign) = match prim {
            Prim::Sin => (Prim::SineRest, Prim::Cos, 1.0),
            _ => (Prim::CosineRest, Prim::Sin, -1.0),
        };
        let own = self.g.apply(rounding, &[phase.value, value]);
        let slope = call(self.g, slope, phase.value);
        let beside = mul(self.g, phase.rest, slope);
        let beside = scale(self.g, sign, beside);
        let rest = add(self.g, own, beside);
        Pair { value, rest }
    }

    /// What a local part changes by from the middle to a step to one side.
    fn local_change(&mut self, of: &Local, above: &Above, step: Id, side: f64) -> Id {
        if let Kind::Wave(prim) = of.kind {
            let angle = mul(self.g, step, of.slope);
            let half = scale(self.g, 0.5, angle);
            let [sine, cosine] = [Prim::Sin, Prim::Cos].map(|p| call(self.g, p, half));
            // sin δ, and cos δ - 1
            let turn = mul(self.g, sine, cosine);
            let turn = scale(self.g, 2.0 * side, turn);
            let fall = mul(self.g, sine, sine);
            let fall = scale(self.g, -2.0, fall);
            let [up, along] = of.values;
            let (own, other) = match prim {
                Prim::Sin => (up, along),
                _ => (along, self.g.neg(up)),
            };
            let product = mul(self.g, other, turn);
            return mul_add(self.g, own, fall, product);
        }
        let step = scale(self.g, side, step);
        let rate = mul_add(self.g, step, of.curve, of.slope);
        let change = mul(self.g, step, rate);
        match of.kind {
            Kind::Exponential => {
                let growth = call(self.g, Prim::Expm1, change);
                let size = above.totals.get(&of.id).copied().unwrap_or(of.values[0]);
                mul(self.g, size, growth)
            }
            Kind::Logarithm => {
                let part = div(self.g, change, of.middle.value);
                call(self.g, Prim::Log1p, part)
            }
            _ => change,
        }
    }

    /// What the integrand changes by, from what its local parts do.
    fn change_of(&mut self, root: Id, above: &Above, mut known: FxHashMap<Id, Id>) -> Option<Id> {
        for &id in &above.order {
            let node = self.g.node(id).clone();
            let Op::Apply(prim) = node.op else {
                return None;
            };
            let zero = self.g.real(0.0);
            let of = |k: usize| known.get(&node.args[k]).copied().unwrap_or(zero);
            let at = |k: usize| above.totals.get(&node.args[k]).copied();
            let change = match prim {
                Prim::Neg => self.g.neg(of(0)),
                Prim::Add => add(self.g, of(0), of(1)),
                Prim::Sub => sub(self.g, of(0), of(1)),
                Prim::Div => div(self.g, of(0), node.args[1]),
                Prim::Mul if node.args[0] == node.args[1] => self.change_of_power(2, at(0)?, of(0)),
                Prim::Mul => {
                    let there = add(self.g, at(1)?, of(1));
                    let left = mul(self.g, of(0), there);
                    mul_add(self.g, at(0)?, of(1), left)
                }
                Prim::PowInt(n) => self.change_of_power(n, at(0)?, of(0)),
                _ => return None,
            };
            known.insert(id, change);
        }
        known.get(&root).copied()
    }

    /// (a + Δ)ⁿ - aⁿ = Δ Σ aⁿ⁻¹⁻ᵏ (a + Δ)ᵏ
    fn change_of_power(&mut self, n: i32, a: Id, change: Id) -> Id {
        let there = add(self.g, a, change);
        let mut sum = self.g.real(1.0);
        let mut power = sum;
        for _ in 1..n {
            power = mul(self.g, power, a);
            sum = mul_add(self.g, sum, there, power);
        }
        mul(self.g, change, sum)
    }
}

/// All products of two ranges.
fn product_of_ranges(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let ends = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
    if ends.iter().any(|v| v.is_nan()) {
        return [f64::NEG_INFINITY, f64::INFINITY];
    }
    let least = ends.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [least, greatest]
}
