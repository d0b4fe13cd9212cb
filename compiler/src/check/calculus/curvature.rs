//! Curvatures of level sets.

use smallvec::SmallVec;

use super::fields::Matrix;
use crate::ir::{Graph, Id, Prim};

/// Mean curvature H = div(n)/2, n = ∇f/|∇f|, of the level surface; of two variables the curvature div(n) of the level
/// line. Positive where the gradient points out of a ball: 1/r for f = |p| - r. NaN where ∇f = 0, where there is no
/// normal.
///
/// div(n) |∇f| = Σ (1 - n_i²) f_ii - 2 Σ_{i<j} n_i n_j f_ij, with 1 - n_i² as the sum of the other squares: what a
/// function changes along its normal, however much, does not cancel. The normal and then the quotient by |∇f| are
/// formed instead of |∇f|³, which overflows early.
///
/// Goldman, Curvature formulas for implicit curves and surfaces, Computer Aided Geometric Design 22 (2005) 632-658,
/// sections 3 and 4, with the opposite sign.
pub(super) fn mean(g: &mut Graph, slopes: &[Id], second: &Matrix) -> Option<Id> {
    let (normal, size) = normal(g, slopes)?;
    let squares: SmallVec<[Id; 4]> = normal
        .iter()
        .map(|&n| g.apply(Prim::PowInt(2), &[n]))
        .collect();
    let (mut straight, mut mixed) = (None, None);
    for i in 0..slopes.len() {
        let others = (0..slopes.len()).filter(|&j| j != i);
        let weight = others.map(|j| squares[j]).reduce(|a, b| g.add(a, b))?;
        let term = g.mul(weight, second[i][i]);
        straight = Some(add(g, straight, term));
        for j in i + 1..slopes.len() {
            let weight = g.mul(normal[i], normal[j]);
            let term = g.mul(weight, second[i][j]);
            mixed = Some(add(g, mixed, term));
        }
    }
    let two = g.real(2.0);
    let twice = g.mul(two, mixed?);
    let trace = g.sub(straight?, twice);
    let curvature = g.div(trace, size);
    if slopes.len() == 2 {
        return Some(curvature);
    }
    let half = g.real(0.5);
    Some(g.mul(half, curvature))
}

/// Gaussian curvature of the level surface: nᵀ adj(S) n with n = ∇f/|∇f| and S the second derivatives over |∇f|. NaN
/// where ∇f = 0.
///
/// Goldman (as above), section 4.
pub(super) fn gaussian(g: &mut Graph, slopes: &[Id], second: &Matrix) -> Option<Id> {
    let (normal, size) = normal(g, slopes)?;
    let scaled: Matrix = second
        .iter()
        .map(|row| row.iter().map(|&entry| g.div(entry, size)).collect())
        .collect();
    let mut total = None;
    for i in 0..3 {
        for j in i..3 {
            let cofactor = cofactor(g, &scaled, i, j);
            let mut weight = g.mul(normal[i], normal[j]);
            if i != j {
                let two = g.real(2.0);
                weight = g.mul(two, weight);
            }
            let term = g.mul(weight, cofactor);
            total = Some(add(g, total, term));
        }
    }
    total
}

/// The entry (i, j) of the adjugate of a symmetric matrix of three rows; indices in a circle have the sign in them.
fn cofactor(g: &mut Graph, m: &Matrix, i: usize, j: usize) -> Id {
    let (a, b) = ((i + 1) % 3, (i + 2) % 3);
    let (c, d) = ((j + 1) % 3, (j + 2) % 3);
    let (down, up) = (g.mul(m[a][c], m[b][d]), g.mul(m[a][d], m[b][c]));
    g.sub(down, up)
}

/// ∇f/|∇f| and |∇f|.
fn normal(g: &mut Graph, slopes: &[Id]) -> Option<(SmallVec<[Id; 4]>, Id)> {
    let size = match *slopes {
        [x, y] => g.apply(Prim::Hypot, &[x, y]),
        [x, y, z] => g.apply(Prim::Hypot3, &[x, y, z]),
        _ => return None,
    };
    Some((slopes.iter().map(|&s| g.div(s, size)).collect(), size))
}

fn add(g: &mut Graph, total: Option<Id>, term: Id) -> Id {
    match total {
        Some(total) => g.add(total, term),
        None => term,
    }
}
