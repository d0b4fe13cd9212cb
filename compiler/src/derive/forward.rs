//! Forward mode: tangents of every node along one direction, with zero tangents folded away.

use rustc_hash::FxHashMap;

use super::NoDerivative;
use super::activity::activity;
use super::extend::{extend, states};
use super::rules::{
    int_power_partial, inverse_tangent, is_zero, quotient_correction, sum, takes_second, zero_like,
};
use crate::ir::{Graph, Id, Node, Op, Prim, Slopes, Ty};
use crate::table::{self, Derivative};

/// Derivative of each root along the direction that gives each seeded leaf the seed as its tangent. `None` is
/// an exact zero. A complex leaf may have a real seed: the tangent of a holomorphic expression with seed 1 is
/// its complex derivative.
///
/// Griewank and Walther, Evaluating Derivatives, 2nd edition, chapter 3.
///
/// # Errors
/// An operation that depends on a seeded leaf has no derivative rule.
pub fn forward(
    g: &mut Graph,
    roots: &[Id],
    seeds: &[(Id, Id)],
) -> Result<Vec<Option<Id>>, NoDerivative> {
    let live = g.reachable(roots);
    let mut tangents: Vec<Option<Id>> = vec![None; live.len()];
    if g.has_loops() {
        let leaves: Vec<Id> = seeds.iter().map(|seed| seed.0).collect();
        let active = activity(g, &live, &leaves);
        for leaf in states(g, &live, &active) {
            let ty = g.ty(leaf);
            tangents[leaf.index()] = Some(g.tangent_state(leaf, seeds, 0, ty));
        }
    }
    for &(leaf, seed) in seeds {
        tangents[leaf.index()] = Some(seed);
    }
    let mut extended: FxHashMap<Id, Id> = FxHashMap::default();
    let ids: Vec<Id> = g.ids().take(live.len()).collect();
    for id in ids {
        if !live[id.index()] {
            continue;
        }
        let node = g.node(id).clone();
        let prim = match node.op {
            Op::Apply(prim) => prim,
            Op::Loop { .. } => {
                if let Some(longer) = extend(g, id, &live, |of| tangents[of.index()]) {
                    extended.insert(id, longer);
                }
                continue;
            }
            Op::Result(_) => {
                tangents[id.index()] = extended.get(&node.args[0]).and_then(|&longer| {
                    let leaf = g.leaf_of_result(id)?;
                    Some(g.result(longer, tangents[leaf.index()]?))
                });
                continue;
            }
            _ => continue,
        };
        if node.args.iter().all(|a| tangents[a.index()].is_none()) {
            continue;
        }
        let of_args: smallvec::SmallVec<[Option<Id>; 3]> =
            node.args.iter().map(|a| tangents[a.index()]).collect();
        let tangent = match known_slopes(g, id, |fixed| tangents[fixed.index()].is_none()) {
            Some(slopes) => along_slopes(g, &slopes, &tangents),
            None => tangent(g, prim, &node, id, &of_args)?,
        };
        g.cover(g.span(id));
        tangents[id.index()] = tangent.filter(|&t| !is_zero(g, t));
    }
    Ok(roots.iter().map(|r| tangents[r.index()]).collect())
}

/// The derivatives of a node that are known, where all hold that `is_fixed` of what must be constant.
pub(super) fn known_slopes(g: &Graph, id: Id, is_fixed: impl Fn(Id) -> bool) -> Option<Slopes> {
    let slopes = g.slopes(id)?;
    let all = slopes.fixed.iter().all(|&fixed| is_fixed(fixed));
    all.then(|| slopes.clone())
}

fn along_slopes(g: &mut Graph, slopes: &Slopes, tangents: &[Option<Id>]) -> Option<Id> {
    let mut total = None;
    for &(value, slope) in &slopes.by {
        if let Some(tangent) = tangents[value.index()].filter(|_| !is_zero(g, slope)) {
            let term = g.mul(slope, tangent);
            total = sum(g, total, Some(term));
        }
    }
    total
}

fn tangent(
    g: &mut Graph,
    prim: Prim,
    node: &Node,
    value: Id,
    tangents: &[Option<Id>],
) -> Result<Option<Id>, NoDerivative> {
    match table::derivative(prim) {
        Derivative::Zero => Ok(None),
        Derivative::Missing => Err(NoDerivative { prim }),
        Derivative::Structural => Ok(structural(g, prim, node, value, tangents)),
        Derivative::Partial(partial) => {
            let mut total = None;
            for (k, tangent) in tangents.iter().enumerate() {
                let Some(tangent) = *tangent else { continue };
                if table::is_missing(prim, k) {
                    return Err(NoDerivative { prim });
                }
                let slope = partial(g, &node.args, value, k);
                if is_zero(g, slope) {
                    continue;
                }
                let term = g.mul(slope, tangent);
                total = sum(g, total, Some(term));
            }
            Ok(total)
        }
    }
}

fn structural(
    g: &mut Graph,
    prim: Prim,
    node: &Node,
    value: Id,
    tangents: &[Option<Id>],
) -> Option<Id> {
    match (prim, node.args.as_slice(), tangents) {
        (Prim::Neg, _, &[t]) => t.map(|t| g.neg(t)),
        (Prim::Add, _, &[s, t]) => sum(g, s, t),
        (Prim::Sub, _, &[s, None]) => s,
        (Prim::Sub, _, &[None, Some(t)]) => Some(g.neg(t)),
        (Prim::Sub, _, &[Some(s), Some(t)]) => Some(g.sub(s, t)),
        (Prim::Mul, &[a, b], &[s, t]) => {
            let left = s.map(|s| g.mul(s, b));
            let right = t.map(|t| g.mul(a, t));
            sum(g, left, right)
        }
        // (1/b)' = -(1/b) ((1/b) b'), without the square, which underflows early
        (Prim::Div, &[one, b], &[None, Some(t)]) if g.as_real(one) == Some(1.0) => {
            if let Some(tangent) = inverse_tangent(g, b, t) {
                return Some(tangent);
            }
            let once = quotient_correction(g, value, b, t);
            let product = g.mul(value, once);
            Some(g.neg(product))
        }
        // (a/b)' = (a' - (a/b) b') / b
        (Prim::Div, &[_, b], &[s, t]) => {
            let correction = t.map(|t| quotient_correction(g, value, b, t));
            let numerator = match (s, correction) {
                (Some(s), Some(c)) => g.sub(s, c),
                (Some(s), None) => s,
                (None, Some(c)) => g.neg(c),
                (None, None) => return None,
            };
            Some(g.div(numerator, b))
        }
        (Prim::PowInt(n), &[x], &[Some(t)]) => {
            let slope = int_power_partial(g, x, n);
            Some(g.mul(slope, t))
        }
        (Prim::Complex, _, &[s, t]) => Some(complex_tangent(g, s, t)),
        (Prim::Re | Prim::Im | Prim::Conj, _, &[Some(t)]) => Some(g.apply(prim, &[t])),
        (Prim::Abs, &[x], &[Some(t)]) => Some(abs_tangent(g, x, value, t)),
        // (arg z)' = im(z'/z)
        (Prim::Arg, &[z], &[Some(t)]) if g.ty(z) == Ty::Complex => {
            let quotient = g.div(t, z);
            Some(g.apply(Prim::Im, &[quotient]))
        }
        (Prim::Min | Prim::Max, &[a, b], &[s, t]) => {
            let second = takes_second(g, prim, a, b);
            Some(choice(g, second, t, s))
        }
        (Prim::Select, &[c, ..], &[_, s, t]) if s.is_some() || t.is_some() => {
            Some(choice(g, c, s, t))
        }
        _ => None,
    }
}

fn complex_tangent(g: &mut Graph, re: Option<Id>, im: Option<Id>) -> Id {
    let zero = g.real(0.0);
    match (re, im) {
        // a real tangent stays real: mixed arithmetic is cheaper and exact
        (Some(re), None) => re,
        (re, im) => g.apply(Prim::Complex, &[re.unwrap_or(zero), im.unwrap_or(zero)]),
    }
}

/// |x|' = sign(x) x', which is 0 at 0; |z|' = re(conj(z)/|z| · z').
fn abs_tangent(g: &mut Graph, x: Id, value: Id, tangent: Id) -> Id {
    if g.ty(x) == Ty::Real {
        let sign = g.apply(Prim::Sign, &[x]);
        return g.mul(sign, tangent);
    }
    let point = [Prim::Re, Prim::Im].map(|part| g.apply(part, &[x]));
    let mut total = None;
    for (k, part) in [Prim::Re, Prim::Im].into_iter().enumerate() {
        let slope = g.apply(part, &[tangent]);
        if is_zero(g, slope) {
            continue;
        }
        let cosine = table::direction(g, &point, k, value);
        let term = g.mul(cosine, slope);
        total = sum(g, total, Some(term));
    }
    total.unwrap_or_else(|| g.real(0.0))
}

fn choice(g: &mut Graph, condition: Id, a: Option<Id>, b: Option<Id>) -> Id {
    let complex = [a, b].iter().flatten().any(|&t| g.ty(t) == Ty::Complex);
    let zero = zero_like(g, if complex { Ty::Complex } else { Ty::Real });
    let (mut a, mut b) = (a.unwrap_or(zero), b.unwrap_or(zero));
    if complex {
        (a, b) = (g.widen(a), g.widen(b));
    }
    g.apply(Prim::Select, &[condition, a, b])
}
