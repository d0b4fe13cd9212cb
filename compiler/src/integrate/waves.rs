//! Products of waves as sums.

use std::collections::BTreeMap;

use smallvec::SmallVec;

use crate::ir::{Id, Prim};

/// Greatest number of waves that a product becomes the sum of.
pub const MAX_WAVES: usize = 512;

/// A whole multiple of each phase.
type Phases = SmallVec<[(Id, i32); 4]>;

/// Σ of waves of sums of phases; the key is the wave and its phases.
pub type Waves = BTreeMap<(bool, Vec<(Id, i32)>), f64>;

/// cos A cos u = (cos(A + u) + cos(A - u))/2 and its kin: a product of waves as a sum of waves of sums. `round`: sin
/// and cos, else sinh and cosh. The empty product is cos 0. `None` of more than [`MAX_WAVES`].
pub fn product_to_sum(waves: &[(Prim, Id)], round: bool) -> Option<Waves> {
    let mut sum: Waves = BTreeMap::new();
    sum.insert((false, Vec::new()), 1.0);
    for &(prim, phase) in waves {
        let odd = matches!(prim, Prim::Sin | Prim::Sinh);
        let mut next: Waves = BTreeMap::new();
        for ((is_odd, phases), v) in &sum {
            // the wave of the sum of phases, then that of the difference
            let (kind, plus, minus) = match (is_odd, odd) {
                (false, false) => (false, 0.5, 0.5),
                (false, true) => (true, 0.5, -0.5),
                (true, false) => (true, 0.5, 0.5),
                (true, true) if round => (false, -0.5, 0.5),
                (true, true) => (false, 0.5, -0.5),
            };
            for (n, weight) in [(1, plus), (-1, minus)] {
                let (phases, turned) = canonical(phases, phase, n);
                let sign = if turned && kind { -1.0 } else { 1.0 };
                *next.entry((kind, phases)).or_insert(0.0) += sign * weight * v;
            }
        }
        next.retain(|_, v| *v != 0.0);
        if next.len() > MAX_WAVES {
            return None;
        }
        sum = next;
    }
    Some(sum)
}

/// Adds n times a phase; the first multiple is made positive, and whether that turned the whole is told.
fn canonical(phases: &[(Id, i32)], phase: Id, n: i32) -> (Vec<(Id, i32)>, bool) {
    let mut out: Phases = SmallVec::from_slice(phases);
    match out.iter_mut().find(|p| p.0 == phase) {
        Some(known) => known.1 += n,
        None => out.push((phase, n)),
    }
    out.retain(|p| p.1 != 0);
    out.sort_unstable();
    let turned = out.first().is_some_and(|p| p.1 < 0);
    if turned {
        for p in &mut out {
            p.1 = -p.1;
        }
    }
    (out.to_vec(), turned)
}
