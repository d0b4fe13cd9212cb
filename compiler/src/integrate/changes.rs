//! Nodes of sums of waves that may cancel: the integrand in the middle is known as a pair, and each node takes what it
//! changes by from there.
//!
//! Beside a zero, sin x cos y + sin y cos z is what is left of terms near 1, and their roundings would be most of it. The
//! middle has the rests of its waves, sums and products. What changes from there to a node is s f' and what is beyond that: the
//! slope in the middle is known by pairs, too, as slopes may cancel where values do; what is beyond it is of the second
//! order, and so are its roundings.

use rustc_hash::{FxHashMap, FxHashSet};

use super::Integrator;
use super::arithmetic::{add, call, div, if_less, mul, mul_add, scale, sub};
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
    /// Slopes in the middle; of what has none the whole change is taken as one.
    slopes: FxHashMap<Id, Id>,
}

/// A node of the rule on one side of the middle.
#[derive(Clone, Copy)]
struct Step {
    /// Its distance from the middle.
    size: Id,
    /// 1 or -1
    side: f64,
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
                let step = Step { size: step, side };
                let beyond = locals
                    .iter()
                    .map(|l| (l.id, self.beyond_local_slope(l, &above, step)))
                    .collect();
                let change = self.change_of(root, &above, beyond, step)?;
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
        let slopes = self.slopes_in_the_middle(&order, locals, &middle);
        let slopes = slopes
            .into_iter()
            .map(|(id, pair)| (id, pair.total(self.g)))
            .collect();
        Some(Above {
            order,
            middle,
            totals,
            slopes,
        })
    }

    /// Slopes by t with their rests, of waves, polynomials, and their sums, products and squares.
    fn slopes_in_the_middle(
        &mut self,
        order: &[Id],
        locals: &[Local],
        middle: &FxHashMap<Id, Pair>,
    ) -> FxHashMap<Id, Pair> {
        let mut out: FxHashMap<Id, Pair> = FxHashMap::default();
        for local in locals {
            let pair = match local.kind {
                Kind::Polynomial => self.rate_pair(local.id, local.slope),
                Kind::Wave(prim) => {
                    let rate = self.rate_pair(self.g.node(local.id).args[0], local.slope);
                    let turned = match prim {
                        Prim::Sin => self.wave_pair(Prim::Cos, local.middle),
                        _ => self.wave_pair(Prim::Sin, local.middle).negated(self.g),
                    };
                    turned.times(self.g, rate)
                }
                Kind::Exponential | Kind::Logarithm => continue,
            };
            out.insert(local.id, pair);
        }
        for &id in order {
            if let Some(slope) = self.slope_of_operation(id, &out, middle) {
                out.insert(id, slope);
            }
        }
        out
    }

    /// The slope of a polynomial of degree 1 or 2 in the middle.
    fn rate_pair(&mut self, of: Id, rounded: Id) -> Pair {
        let slope = self.slope(of);
        let whole = self.path.clone();
        let values = whole.pairs_in_middle(self.g);
        self.whole_pair(slope, &values)
            .unwrap_or_else(|| Pair::exact(self.g, rounded))
    }

    fn slope_of_operation(
        &mut self,
        id: Id,
        slopes: &FxHashMap<Id, Pair>,
        middle: &FxHashMap<Id, Pair>,
    ) -> Option<Pair> {
        let node = self.g.node(id).clone();
        let Op::Apply(prim) = node.op else {
            return None;
        };
        let slope = |k: usize| slopes.get(&node.args[k]).copied();
        let at = |k: usize| middle.get(&node.args[k]).copied();
        let is_square =
            prim == Prim::PowInt(2) || prim == Prim::Mul && node.args[0] == node.args[1];
        if is_square {
            let product = at(0)?.times(self.g, slope(0)?);
            return Some(product.multiple(self.g, 2.0));
        }
        match prim {
            Prim::Neg => Some(slope(0)?.negated(self.g)),
            Prim::Add => self.sum_of_slopes(slope(0), slope(1)),
            Prim::Sub => {
                let back = slope(1).map(|s| s.negated(self.g));
                self.sum_of_slopes(slope(0), back)
            }
            Prim::Div => Some(slope(0)?.over(self.g, node.args[1])),
            Prim::Mul => {
                let mut part = |a: Option<Pair>, b: Option<Pair>| Some(a?.times(self.g, b?));
                let (left, right) = (part(slope(0), at(1)), part(at(0), slope(1)));
                self.sum_of_slopes(left, right)
            }
            _ => None,
        }
    }

    fn sum_of_slopes(&mut self, a: Option<Pair>, b: Option<Pair>) -> Option<Pair> {
        match (a, b) {
            (Some(a), Some(b)) => Some(a.plus(self.g, b)),
            (one, other) => one.or(other),
        }
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

    /// What a local part changes by from the middle to a node beyond its slope there; of exponentials and logarithms all of it.
    fn beyond_local_slope(&mut self, of: &Local, above: &Above, step: Step) -> Id {
        if let Kind::Wave(prim) = of.kind {
            let [turn, fall] = self.beyond_angle(of.slope, step);
            let [up, along] = of.values;
            let (own, other) = match prim {
                Prim::Sin => (up, along),
                _ => (along, self.g.neg(up)),
            };
            let product = mul(self.g, other, turn);
            return mul_add(self.g, own, fall, product);
        }
        let size = scale(self.g, step.side, step.size);
        if matches!(of.kind, Kind::Polynomial) {
            let curved = mul(self.g, size, of.curve);
            return mul(self.g, size, curved);
        }
        let rate = mul_add(self.g, size, of.curve, of.slope);
        let change = mul(self.g, size, rate);
        if matches!(of.kind, Kind::Exponential) {
            let growth = call(self.g, Prim::Expm1, change);
            let size = above.totals.get(&of.id).copied().unwrap_or(of.values[0]);
            return mul(self.g, size, growth);
        }
        let part = div(self.g, change, of.middle.value);
        call(self.g, Prim::Log1p, part)
    }

    /// sin δ - δ and cos δ - 1 = -2 sin² δ/2 for what a phase changes by; the first by its series below 1.
    fn beyond_angle(&mut self, slope: Id, step: Step) -> [Id; 2] {
        let angle = mul(self.g, step.size, slope);
        let half = scale(self.g, 0.5, angle);
        let [sine, cosine] = [Prim::Sin, Prim::Cos].map(|p| call(self.g, p, half));
        let fall = mul(self.g, sine, sine);
        let fall = scale(self.g, -2.0, fall);
        let product = mul(self.g, sine, cosine);
        let whole = scale(self.g, 2.0, product);
        let far = sub(self.g, whole, angle);
        let square = mul(self.g, angle, angle);
        let near = self.beyond_small_angle(angle, square);
        let one = self.g.real(1.0);
        let turn = if_less(self.g, square, one, near, far);
        [scale(self.g, step.side, turn), fall]
    }

    /// sin δ - δ = -δ³/3! + δ⁵/5! - …, to δ¹⁵: the next term is 3e-15 at 1.
    fn beyond_small_angle(&mut self, angle: Id, square: Id) -> Id {
        let mut coefficient = -1.0;
        let mut coefficients = Vec::new();
        for k in 1..=7 {
            let order = 2.0 * f64::from(k);
            coefficient /= order * (order + 1.0);
            coefficients.push(coefficient);
            coefficient = -coefficient;
        }
        let mut sum = self.g.real(0.0);
        for c in coefficients.into_iter().rev() {
            let c = self.g.real(c);
            sum = mul_add(self.g, sum, square, c);
        }
        let cube = mul(self.g, angle, square);
        mul(self.g, cube, sum)
    }

    /// What the integrand changes by, from what its local parts change by beyond their slopes.
    fn change_of(
        &mut self,
        root: Id,
        above: &Above,
        mut beyond: FxHashMap<Id, Id>,
        step: Step,
    ) -> Option<Id> {
        for &id in &above.order {
            let node = self.g.node(id).clone();
            let Op::Apply(prim) = node.op else {
                return None;
            };
            let zero = self.g.real(0.0);
            let of = |k: usize| beyond.get(&node.args[k]).copied().unwrap_or(zero);
            let at = |k: usize| above.totals.get(&node.args[k]).copied();
            let is_square = prim == Prim::Mul && node.args[0] == node.args[1];
            let change = match prim {
                Prim::Neg => self.g.neg(of(0)),
                Prim::Add => add(self.g, of(0), of(1)),
                Prim::Sub => sub(self.g, of(0), of(1)),
                Prim::Div => div(self.g, of(0), node.args[1]),
                Prim::PowInt(_) | Prim::Mul if is_square || prim != Prim::Mul => {
                    let n = if let Prim::PowInt(n) = prim { n } else { 2 };
                    let whole = self.whole_change(node.args[0], of(0), above, step);
                    if id == root {
                        return Some(self.change_of_power(n, at(0)?, whole));
                    }
                    if n == 2 {
                        // 2 a Δ and Δ², of the first what is beyond the slope
                        let twice = scale(self.g, 2.0, at(0)?);
                        let first = mul(self.g, twice, of(0));
                        mul_add(self.g, whole, whole, first)
                    } else {
                        self.change_of_power(n, at(0)?, whole)
                    }
                }
                Prim::Mul => {
                    let changes =
                        [0, 1].map(|k| self.whole_change(node.args[k], of(k), above, step));
                    let both = mul(self.g, changes[0], changes[1]);
                    let left = mul_add(self.g, at(1)?, of(0), both);
                    mul_add(self.g, at(0)?, of(1), left)
                }
                _ => return None,
            };
            beyond.insert(id, change);
        }
        let last = beyond.get(&root).copied()?;
        Some(self.whole_change(root, last, above, step))
    }

    /// s f' and what is beyond.
    fn whole_change(&mut self, of: Id, beyond: Id, above: &Above, step: Step) -> Id {
        let Some(&slope) = above.slopes.get(&of) else {
            return beyond;
        };
        let size = scale(self.g, step.side, step.size);
        mul_add(self.g, size, slope, beyond)
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
