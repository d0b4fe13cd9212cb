//! The line along which is integrated, and what an expression is on it.

use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::SmallVec;

use super::arithmetic::{add, if_less, is_zero, mul, mul_add, scale, sub, total};
use super::pair::{Pair, mul_add_rest, product_rest, sum_rest};
use crate::ir::{Binder, Graph, Id, Op, Prim};

/// A coordinate that changes along the line: origin + t slope.
#[derive(Clone, Copy, Debug)]
pub struct Coordinate {
    /// The leaf that stands for it in the integrand.
    pub leaf: Id,
    /// Its value at t = 0.
    pub origin: Id,
    /// What the value at t = 0 is beyond [`Self::origin`].
    pub low: Id,
    /// Its value in the middle of the interval.
    pub mid: Id,
    /// Its rate of change.
    pub slope: Id,
}

/// A line with an interval: t = middle + s, where s runs from -half to half. A negative half turns the sign of the
/// integral.
#[derive(Clone, Debug)]
pub struct Path {
    /// What changes along it.
    pub coordinates: Vec<Coordinate>,
    /// t at the ends.
    pub ends: [Id; 2],
    /// t in the middle.
    pub middle: Id,
    /// What it is beyond [`Self::middle`].
    pub middle_low: Id,
    /// Half the length of the interval, with its sign.
    pub half: Id,
    /// What it is beyond [`Self::half`].
    pub half_low: Id,
}

impl Path {
    /// The line of one variable, from a to b.
    pub fn of_variable(g: &mut Graph, leaf: Id, a: Id, b: Id) -> Self {
        let (origin, slope) = (g.real(0.0), g.real(1.0));
        Self::of_lines(g, &[(leaf, origin, slope)], [a, b])
    }

    /// The ray origin + t direction of space from t = a to t = b.
    pub fn of_ray(
        g: &mut Graph,
        leaves: &[Id],
        origin: &[Id],
        direction: &[Id],
        ends: (Id, Id),
    ) -> Self {
        let low = g.real(0.0);
        let lows = vec![low; origin.len()];
        Self::of_ray_beside(g, leaves, (origin, &lows), direction, ends)
    }

    /// The same with what the origin is beyond its rounded numbers.
    pub fn of_ray_beside(
        g: &mut Graph,
        leaves: &[Id],
        (origin, lows): (&[Id], &[Id]),
        direction: &[Id],
        ends: (Id, Id),
    ) -> Self {
        let zero = g.real(0.0);
        let lines = leaves.iter().zip(origin.iter().zip(lows)).zip(direction);
        let coordinates = lines.map(|((&leaf, (&origin, &low)), &slope)| Coordinate {
            leaf,
            origin,
            low,
            mid: origin,
            slope,
        });
        Self::of_coordinates(g, coordinates.collect(), [ends.0, ends.1], [zero; 2])
    }

    /// Each a leaf, its value at t = 0, and its slope.
    pub(super) fn of_lines(g: &mut Graph, lines: &[(Id, Id, Id)], ends: [Id; 2]) -> Self {
        let low = g.real(0.0);
        let line = |&(leaf, origin, slope): &(Id, Id, Id)| Coordinate {
            leaf,
            origin,
            low,
            mid: origin,
            slope,
        };
        Self::of_coordinates(g, lines.iter().map(line).collect(), ends, [low; 2])
    }

    /// The interval between two ends of a line, with what they are beyond their rounded t; values in the middle are still
    /// to be found.
    fn of_coordinates(
        g: &mut Graph,
        mut coordinates: Vec<Coordinate>,
        ends: [Id; 2],
        lows: [Id; 2],
    ) -> Self {
        // from half ends, so that neither overflows
        let halves = ends.map(|end| scale(g, 0.5, end));
        let (middle, half) = (add(g, halves[0], halves[1]), sub(g, halves[1], halves[0]));
        let lows = lows.map(|low| scale(g, 0.5, low));
        let (beside, longer) = (add(g, lows[0], lows[1]), sub(g, lows[1], lows[0]));
        let back = g.neg(halves[0]);
        let short = sum_rest(g, halves[1], back, half);
        let (first, half) = (half, add(g, half, longer));
        let half_low = {
            let own = sum_rest(g, first, longer, half);
            add(g, short, own)
        };
        let rest = sum_rest(g, halves[0], halves[1], middle);
        for c in &mut coordinates {
            c.mid = mid(g, c, ends, middle, half);
        }
        Self {
            coordinates,
            ends,
            middle,
            middle_low: add(g, rest, beside),
            half,
            half_low,
        }
    }

    /// The part of the line between two other ends.
    pub fn between(&self, g: &mut Graph, ends: [Id; 2]) -> Self {
        let low = g.real(0.0);
        self.between_cuts(g, ends, [low; 2])
    }

    /// The same with what the ends are beyond their rounded t.
    pub fn between_cuts(&self, g: &mut Graph, ends: [Id; 2], lows: [Id; 2]) -> Self {
        Self::of_coordinates(g, self.coordinates.clone(), ends, lows)
    }

    /// The same line and interval with t counted from the middle of the interval, where that is further from t = 0 than
    /// the interval is long: there what is in the interval would be rounded to its distance from t = 0. Nothing is
    /// rounded by that, as the ends are between half and twice the middle and what values at the new t = 0 are rounded
    /// by is kept.
    ///
    /// Sterbenz, Floating-Point Computation, 1974, theorem 4.3.1.
    pub fn rebased(&self, g: &mut Graph) -> Self {
        let [away, reach] = [self.middle, self.half].map(|t| g.apply(Prim::Abs, &[t]));
        let (length, zero) = (scale(g, 2.0, reach), g.real(0.0));
        let start = if_less(g, length, away, self.middle, zero);
        let ends = self.ends.map(|end| sub(g, end, start));
        let mut coordinates = self.coordinates.clone();
        for c in &mut coordinates {
            let there = c.at(g, start);
            (c.origin, c.low) = (there.value, there.rest);
        }
        Self::of_coordinates(g, coordinates, ends, [zero; 2])
    }

    /// The same line, seen from t = 0.
    pub fn from_origin(&self, g: &mut Graph) -> Self {
        let mut out = self.clone();
        for c in &mut out.coordinates {
            c.mid = c.origin;
        }
        out.middle = g.real(0.0);
        out.middle_low = out.middle;
        out
    }

    /// The same line, seen from another t.
    pub fn from_place(&self, g: &mut Graph, t: Id) -> Self {
        let mut out = self.clone();
        for c in &mut out.coordinates {
            c.mid = c.at(g, t).value;
        }
        out.middle = t;
        out.middle_low = g.real(0.0);
        out
    }

    /// The coordinates at s, which is measured from the middle.
    pub fn point(&self, g: &mut Graph, s: Id) -> Vec<(Id, Id)> {
        let at = |c: &Coordinate| (c.leaf, line(g, c.mid, s, c.slope));
        self.coordinates.iter().map(at).collect()
    }

    /// The coordinates at t = 0.
    pub fn pairs_at_origin(&self) -> Vec<(Id, Pair)> {
        let at = |c: &Coordinate| Pair {
            value: c.origin,
            rest: c.low,
        };
        self.coordinates.iter().map(|c| (c.leaf, at(c))).collect()
    }

    /// The coordinates at t with what it is rounded by.
    pub fn pairs_beside(&self, g: &mut Graph, t: Id, low: Id) -> Vec<(Id, Pair)> {
        let at = |c: &Coordinate| {
            let mut pair = c.at(g, t);
            let beside = mul(g, low, c.slope);
            pair.rest = add(g, pair.rest, beside);
            (c.leaf, pair)
        };
        self.coordinates.iter().map(at).collect()
    }

    /// The coordinates at t, which is not rounded, with what they are rounded by.
    pub fn pairs(&self, g: &mut Graph, t: Id) -> Vec<(Id, Pair)> {
        let at = |c: &Coordinate| (c.leaf, c.at(g, t));
        self.coordinates.iter().map(at).collect()
    }

    /// The coordinates in the middle, with what they and its t are rounded by.
    pub fn pairs_in_middle(&self, g: &mut Graph) -> Vec<(Id, Pair)> {
        let at = |c: &Coordinate| {
            let mut pair = c.at(g, self.middle);
            let beside = mul(g, self.middle_low, c.slope);
            pair.rest = add(g, pair.rest, beside);
            (c.leaf, pair)
        };
        self.coordinates.iter().map(at).collect()
    }

    /// The coordinates at a place of the interval in [-1, 1], with what they, the place and half the interval are rounded
    /// by.
    pub fn pairs_at_place(&self, g: &mut Graph, place: f64) -> Vec<(Id, Pair)> {
        let middle = self.pairs_in_middle(g);
        if place == 0.0 {
            return middle;
        }
        #[allow(clippy::cast_possible_truncation, reason = "the rest is kept")]
        let high = f64::from(place as f32);
        let step = scale(g, high, self.half);
        let high_id = g.real(high);
        let own = product_rest(g, high_id, self.half, step);
        let (beside, below) = (
            scale(g, place - high, self.half),
            scale(g, high, self.half_low),
        );
        let low = total(g, [own, beside, below]);
        let at = |(c, (leaf, mid)): (&Coordinate, (Id, Pair))| {
            let value = mul_add(g, step, c.slope, mid.value);
            let own = mul_add_rest(g, [step, c.slope, mid.value], value);
            let beside = mul(g, low, c.slope);
            let rest = total(g, [own, mid.rest, beside]);
            (leaf, Pair { value, rest })
        };
        self.coordinates.iter().zip(middle).map(at).collect()
    }

    /// The coordinates at an end, from its t and not by way of the middle.
    pub fn end(&self, g: &mut Graph, which: usize) -> Vec<(Id, Id)> {
        let t = self.ends[which];
        let at = |c: &Coordinate| (c.leaf, c.at(g, t).value);
        self.coordinates.iter().map(at).collect()
    }

    /// The coordinates in the middle.
    pub fn middle(&self) -> Vec<(Id, Id)> {
        self.coordinates.iter().map(|c| (c.leaf, c.mid)).collect()
    }

    /// The direction for a derivative by t.
    pub fn seeds(&self) -> Vec<(Id, Id)> {
        self.coordinates.iter().map(|c| (c.leaf, c.slope)).collect()
    }
}

impl Coordinate {
    /// The value at t, and what it is rounded by.
    fn at(&self, g: &mut Graph, t: Id) -> Pair {
        let near = line(g, self.origin, t, self.slope);
        let value = add(g, near, self.low);
        let rest = mul_add_rest(g, [t, self.slope, self.origin], value);
        Pair {
            value,
            rest: add(g, rest, self.low),
        }
    }
}

/// base + t slope, rounded once: the ray may begin far away from where it is looked at.
fn line(g: &mut Graph, base: Id, t: Id, slope: Id) -> Id {
    mul_add(g, t, slope, base)
}

/// A coordinate in the middle of the interval. Where that is further from t = 0 than the ends from each other, the mean of
/// both ends: each is rounded by itself, and the t of the middle would be rounded to its distance from 0.
fn mid(g: &mut Graph, c: &Coordinate, ends: [Id; 2], middle: Id, half: Id) -> Id {
    let there = c.at(g, middle).value;
    // t has been counted from the middle already
    let is_near = !is_zero(g, c.low);
    if is_near || is_zero(g, c.slope) || is_zero(g, c.origin) || is_zero(g, half) {
        return there;
    }
    let [low, high] = ends.map(|t| line(g, c.origin, t, c.slope));
    let low = scale(g, 0.5, low);
    let between = {
        let half = g.real(0.5);
        mul_add(g, half, high, low)
    };
    let [away, reach] = [middle, half].map(|t| g.apply(Prim::Abs, &[t]));
    if_less(g, reach, away, between, there)
}

/// Expressions that are to be copied with their coordinates replaced, once for each node of a rule.
#[derive(Debug)]
pub struct Body {
    roots: Vec<Id>,
    /// What is copied, operands before users.
    order: Vec<Id>,
}

impl Body {
    /// Prepares what the roots depend on and what depends on a leaf.
    pub fn new(g: &Graph, roots: &[Id], leaves: impl Iterator<Item = Id>) -> Self {
        let leaves: FxHashSet<Id> = leaves.collect();
        let below = cone(g, roots);
        let mut moving: FxHashSet<Id> = FxHashSet::default();
        let mut binders: FxHashSet<Binder> = FxHashSet::default();
        loop {
            let known = binders.len();
            for &id in &below {
                let node = g.node(id);
                let of_loop = match node.op {
                    Op::State(binder, _) | Op::Counter(binder) => binders.contains(&binder),
                    _ => false,
                };
                if of_loop || leaves.contains(&id) || node.args.iter().any(|a| moving.contains(a)) {
                    moving.insert(id);
                    if let Op::Loop { binder, .. } = node.op {
                        binders.insert(binder);
                    }
                }
            }
            if binders.len() == known {
                break;
            }
        }
        Self {
            roots: roots.to_vec(),
            order: below.into_iter().filter(|id| moving.contains(id)).collect(),
        }
    }

    /// The roots with values in the place of leaves. Loops that depend on them are copied with leaves of their own.
    pub fn at(&self, g: &mut Graph, values: &[(Id, Id)]) -> SmallVec<[Id; 4]> {
        let mut map: FxHashMap<Id, Id> = values.iter().copied().collect();
        let mut binders: FxHashMap<Binder, Binder> = FxHashMap::default();
        for &id in &self.order {
            if map.contains_key(&id) {
                continue;
            }
            let new = copy(g, id, &map, &mut binders);
            if let Some(name) = g.name(id).map(str::to_owned) {
                g.set_name(new, &name);
            }
            map.insert(id, new);
        }
        self.roots
            .iter()
            .map(|r| map.get(r).copied().unwrap_or(*r))
            .collect()
    }
}

fn copy(
    g: &mut Graph,
    id: Id,
    map: &FxHashMap<Id, Id>,
    binders: &mut FxHashMap<Binder, Binder>,
) -> Id {
    let node = g.node(id).clone();
    let new = |a: Id| map.get(&a).copied().unwrap_or(a);
    match node.op {
        Op::State(binder, k) => {
            let binder = *binders.entry(binder).or_insert_with(|| g.binder());
            g.state(binder, k, node.ty)
        }
        Op::Counter(binder) => {
            let binder = *binders.entry(binder).or_insert_with(|| g.binder());
            g.counter(binder)
        }
        Op::Loop { .. } => {
            let Some(mut it) = g.as_loop(id) else {
                return id;
            };
            it.binder = *binders.entry(it.binder).or_insert_with(|| g.binder());
            it.rename(new);
            g.repeat(&it)
        }
        op => {
            let args: SmallVec<[Id; 4]> = node.args.iter().map(|&a| new(a)).collect();
            match op {
                Op::Apply(prim) => g.apply(prim, &args),
                _ => g.intern(op, node.ty, &args),
            }
        }
    }
}

/// An integrand without what rules have written to lessen roundings: `fma` as product and sum, and no rests. That is what
/// an integral within it is to the rules.
pub fn without_rests(g: &mut Graph, root: Id) -> Id {
    let order = cone(g, &[root]);
    let is_rest = |g: &Graph, id: Id| {
        matches!(
            g.node(id).op,
            Op::Apply(Prim::MulAdd | Prim::SumRest | Prim::MulAddRest | Prim::ProductRest)
        )
    };
    if !order.iter().any(|&id| is_rest(g, id)) {
        return root;
    }
    let mut map: FxHashMap<Id, Id> = FxHashMap::default();
    let mut binders: FxHashMap<Binder, Binder> = FxHashMap::default();
    for id in order {
        let args: SmallVec<[Id; 4]> = g
            .node(id)
            .args
            .iter()
            .map(|a| map.get(a).copied().unwrap_or(*a))
            .collect();
        let new = match (g.node(id).op, args.as_slice()) {
            (Op::Apply(Prim::MulAdd), &[a, b, c]) => {
                let product = mul(g, a, b);
                add(g, product, c)
            }
            (Op::Apply(Prim::SumRest | Prim::MulAddRest | Prim::ProductRest), _) => g.real(0.0),
            _ => copy(g, id, &map, &mut binders),
        };
        map.insert(id, new);
    }
    map.get(&root).copied().unwrap_or(root)
}

/// What the roots depend on, in order.
pub fn cone(g: &Graph, roots: &[Id]) -> Vec<Id> {
    let mut seen: FxHashSet<Id> = FxHashSet::default();
    let mut stack = roots.to_vec();
    while let Some(id) = stack.pop() {
        if seen.insert(id) {
            stack.extend(g.node(id).args.iter().copied());
        }
    }
    let mut out: Vec<Id> = seen.into_iter().collect();
    out.sort_unstable();
    out
}
