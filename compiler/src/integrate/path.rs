//! The line along which is integrated, and what an expression is on it.

use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::SmallVec;

use super::arithmetic::{add, mul};
use crate::ir::{Binder, Graph, Id, Op};

/// A coordinate that changes along the line: mid + s slope.
#[derive(Clone, Copy, Debug)]
pub struct Coordinate {
    /// The leaf that stands for it in the integrand.
    pub leaf: Id,
    /// Its value in the middle of the interval.
    pub mid: Id,
    /// Its rate of change by s.
    pub slope: Id,
}

/// A line with an interval: s runs from -half to half. A negative half turns the sign of the integral.
#[derive(Clone, Debug)]
pub struct Path {
    /// What changes along it.
    pub coordinates: Vec<Coordinate>,
    /// Half the length of the interval, with its sign.
    pub half: Id,
}

impl Path {
    /// The line t = mid + s of one variable, from a to b.
    pub fn of_variable(g: &mut Graph, leaf: Id, a: Id, b: Id) -> Self {
        let (mid, half) = middle(g, a, b);
        let slope = g.real(1.0);
        let coordinates = vec![Coordinate { leaf, mid, slope }];
        Self { coordinates, half }
    }

    /// The ray origin + t direction of space from t = a to t = b.
    pub fn of_ray(
        g: &mut Graph,
        leaves: &[Id],
        origin: &[Id],
        direction: &[Id],
        ends: (Id, Id),
    ) -> Self {
        let (mid, half) = middle(g, ends.0, ends.1);
        let mut coordinates = Vec::new();
        for ((&leaf, &o), &slope) in leaves.iter().zip(origin).zip(direction) {
            let step = g.mul(mid, slope);
            let mid = g.add(o, step);
            coordinates.push(Coordinate { leaf, mid, slope });
        }
        Self { coordinates, half }
    }

    /// The part of the line whose middle is at s = `middle`.
    pub fn part(&self, g: &mut Graph, middle: Id, half: Id) -> Self {
        let shifted = |c: &Coordinate| {
            let step = mul(g, middle, c.slope);
            Coordinate {
                mid: add(g, c.mid, step),
                ..*c
            }
        };
        Self {
            coordinates: self.coordinates.iter().map(shifted).collect(),
            half,
        }
    }

    /// The coordinates at s.
    pub fn point(&self, g: &mut Graph, s: Id) -> Vec<(Id, Id)> {
        let at = |c: &Coordinate| {
            let step = mul(g, s, c.slope);
            (c.leaf, add(g, c.mid, step))
        };
        self.coordinates.iter().map(at).collect()
    }

    /// The coordinates in the middle.
    pub fn middle(&self) -> Vec<(Id, Id)> {
        self.coordinates.iter().map(|c| (c.leaf, c.mid)).collect()
    }

    /// The direction for a derivative by s.
    pub fn seeds(&self) -> Vec<(Id, Id)> {
        self.coordinates.iter().map(|c| (c.leaf, c.slope)).collect()
    }
}

/// Middle and half length of an interval, both from half ends, so that neither overflows.
fn middle(g: &mut Graph, a: Id, b: Id) -> (Id, Id) {
    let half = g.real(0.5);
    let (a, b) = (g.mul(half, a), g.mul(half, b));
    (g.add(a, b), g.sub(b, a))
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
