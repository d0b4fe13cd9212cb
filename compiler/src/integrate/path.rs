//! The line along which is integrated, and what an expression is on it.

use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::SmallVec;

use super::arithmetic::{if_less, is_zero, mul_add, scale, sub};
use crate::ir::{Binder, Graph, Id, Op, Prim};

/// A coordinate that changes along the line: origin + t slope.
#[derive(Clone, Copy, Debug)]
pub struct Coordinate {
    /// The leaf that stands for it in the integrand.
    pub leaf: Id,
    /// Its value at t = 0.
    pub origin: Id,
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
    /// Half the length of the interval, with its sign.
    pub half: Id,
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
        let lines: Vec<(Id, Id, Id)> = leaves
            .iter()
            .zip(origin)
            .zip(direction)
            .map(|((&leaf, &o), &d)| (leaf, o, d))
            .collect();
        Self::of_lines(g, &lines, [ends.0, ends.1])
    }

    /// Each a leaf, its value at t = 0, and its slope.
    pub(super) fn of_lines(g: &mut Graph, lines: &[(Id, Id, Id)], ends: [Id; 2]) -> Self {
        // from half ends, so that neither overflows
        let halves = ends.map(|end| scale(g, 0.5, end));
        let (middle, half) = (
            super::arithmetic::add(g, halves[0], halves[1]),
            sub(g, halves[1], halves[0]),
        );
        let mut coordinate = |&(leaf, origin, slope): &(Id, Id, Id)| Coordinate {
            leaf,
            origin,
            mid: mid(g, (origin, slope), ends, middle, half),
            slope,
        };
        Self {
            coordinates: lines.iter().map(&mut coordinate).collect(),
            ends,
            middle,
            half,
        }
    }

    /// The part of the line between two other ends.
    pub fn between(&self, g: &mut Graph, ends: [Id; 2]) -> Self {
        let lines: Vec<(Id, Id, Id)> = self
            .coordinates
            .iter()
            .map(|c| (c.leaf, c.origin, c.slope))
            .collect();
        Self::of_lines(g, &lines, ends)
    }

    /// The same line, seen from t = 0.
    pub fn from_origin(&self, g: &mut Graph) -> Self {
        let mut out = self.clone();
        for c in &mut out.coordinates {
            c.mid = c.origin;
        }
        out.middle = g.real(0.0);
        out
    }

    /// The same line, seen from another t.
    pub fn from_place(&self, g: &mut Graph, t: Id) -> Self {
        let mut out = self.clone();
        for c in &mut out.coordinates {
            c.mid = line(g, c.origin, t, c.slope);
        }
        out.middle = t;
        out
    }

    /// The coordinates at s, which is measured from the middle.
    pub fn point(&self, g: &mut Graph, s: Id) -> Vec<(Id, Id)> {
        let at = |c: &Coordinate| (c.leaf, line(g, c.mid, s, c.slope));
        self.coordinates.iter().map(at).collect()
    }

    /// The coordinates at an end, from its t and not by way of the middle.
    pub fn end(&self, g: &mut Graph, which: usize) -> Vec<(Id, Id)> {
        let t = self.ends[which];
        let at = |c: &Coordinate| (c.leaf, line(g, c.origin, t, c.slope));
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

/// base + t slope, rounded once: the ray may begin far away from where it is looked at.
fn line(g: &mut Graph, base: Id, t: Id, slope: Id) -> Id {
    mul_add(g, t, slope, base)
}

/// A coordinate in the middle of the interval. Where that is further from t = 0 than the ends from each other, the mean of
/// both ends: each is rounded by itself, and the t of the middle would be rounded to its distance from 0.
fn mid(g: &mut Graph, (origin, slope): (Id, Id), ends: [Id; 2], middle: Id, half: Id) -> Id {
    let there = line(g, origin, middle, slope);
    if is_zero(g, slope) || is_zero(g, origin) || is_zero(g, half) {
        return there;
    }
    let [low, high] = ends.map(|t| line(g, origin, t, slope));
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
