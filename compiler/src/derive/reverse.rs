//! Reverse mode for one real root: adjoints of every node.

use super::NoDerivative;
use super::rules::takes_second;
use crate::ir::{Graph, Id, Op, Prim, Ty};
use crate::table::{self, Derivative};

/// Partial derivatives of a real root by each leaf, `None` being an exact zero; `Ok(None)` where the expression
/// goes through complex numbers, which this mode does not treat.
///
/// Griewank and Walther, Evaluating Derivatives, 2nd edition, section 3.2.
///
/// # Errors
/// An operation that depends on a leaf has no derivative rule.
pub fn reverse(
    g: &mut Graph,
    root: Id,
    leaves: &[Id],
) -> Result<Option<Vec<Option<Id>>>, NoDerivative> {
    let live = g.reachable(&[root]);
    let active = active(g, &live, leaves);
    let mut adjoints: Vec<Option<Id>> = vec![None; live.len()];
    adjoints[root.index()] = Some(g.real(1.0));
    let ids: Vec<Id> = g.ids().take(live.len()).collect();
    for id in ids.into_iter().rev() {
        if !active[id.index()] {
            continue;
        }
        let node = g.node(id).clone();
        if node.ty == Ty::Complex {
            return Ok(None);
        }
        let (Op::Apply(prim), Some(adjoint)) = (node.op, adjoints[id.index()]) else {
            continue;
        };
        for (k, &arg) in node.args.iter().enumerate() {
            if !active[arg.index()] || g.ty(arg) == Ty::Bool {
                continue;
            }
            let Some(term) = contribution(g, prim, &node.args, id, k, adjoint)? else {
                continue;
            };
            adjoints[arg.index()] = Some(match adjoints[arg.index()] {
                Some(sum) => g.add(sum, term),
                None => term,
            });
        }
    }
    Ok(Some(leaves.iter().map(|l| adjoints[l.index()]).collect()))
}

/// Marks the live nodes that depend on a leaf.
fn active(g: &Graph, live: &[bool], leaves: &[Id]) -> Vec<bool> {
    let mut active = vec![false; live.len()];
    for leaf in leaves {
        active[leaf.index()] = true;
    }
    for (id, node) in g.ids().zip(g.nodes()) {
        if live[id.index()] && node.args.iter().any(|a| active[a.index()]) {
            active[id.index()] = true;
        }
    }
    active
}

/// What the adjoint of a node gives to its k-th operand.
fn contribution(
    g: &mut Graph,
    prim: Prim,
    args: &[Id],
    value: Id,
    k: usize,
    adjoint: Id,
) -> Result<Option<Id>, NoDerivative> {
    Ok(match (table::row(prim).derivative, prim, args) {
        (Derivative::Zero, ..) => None,
        (Derivative::Missing, ..) => return Err(NoDerivative { prim }),
        (Derivative::Partial(partial), ..) => {
            let slope = partial(g, args, value, k);
            Some(g.mul(slope, adjoint))
        }
        (_, Prim::Neg, _) => Some(g.neg(adjoint)),
        (_, Prim::Add, _) => Some(adjoint),
        (_, Prim::Sub, _) => Some(if k == 0 { adjoint } else { g.neg(adjoint) }),
        (_, Prim::Mul, &[a, b]) => Some(g.mul(adjoint, if k == 0 { b } else { a })),
        (_, Prim::Div, &[_, b]) => {
            let quotient = g.div(adjoint, b);
            if k == 0 {
                Some(quotient)
            } else {
                let product = g.mul(quotient, value);
                Some(g.neg(product))
            }
        }
        // n · adjoint first: terms of one degree share it
        (_, Prim::PowInt(n), &[x]) => {
            let factor = g.real(f64::from(n));
            let scaled = g.mul(factor, adjoint);
            let power = g.apply(Prim::PowInt(n.saturating_sub(1)), &[x]);
            Some(g.mul(scaled, power))
        }
        (_, Prim::Abs, &[x]) => {
            let sign = g.apply(Prim::Sign, &[x]);
            Some(g.mul(sign, adjoint))
        }
        (_, Prim::Min | Prim::Max, &[a, b]) => {
            let second = takes_second(g, prim, a, b);
            let zero = g.real(0.0);
            let (yes, no) = if k == 1 {
                (adjoint, zero)
            } else {
                (zero, adjoint)
            };
            Some(g.apply(Prim::Select, &[second, yes, no]))
        }
        (_, Prim::Select, &[c, ..]) => {
            let zero = g.real(0.0);
            let (yes, no) = if k == 1 {
                (adjoint, zero)
            } else {
                (zero, adjoint)
            };
            Some(g.apply(Prim::Select, &[c, yes, no]))
        }
        // of a real: itself; im and arg of a real are locally constant
        (_, Prim::Re | Prim::Conj, _) => Some(adjoint),
        _ => None,
    })
}
