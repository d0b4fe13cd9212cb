//! Reverse mode for one real root: adjoints of every node.

use super::NoDerivative;
use super::activity::activity;
use super::forward::known_slopes;
use super::rules::{is_zero, sum, takes_second};
use crate::ir::{Graph, Id, Op, Prim, Ty};
use crate::table::{self, Derivative};

/// More choices than this on the way are left to forward mode: each costs a sweep over the graph.
const MAX_CHOICES: usize = 32;

/// Partial derivatives of a real node by each leaf; `None` is an exact zero.
type Partials = Vec<Option<Id>>;

/// Partial derivatives of a real root by each leaf; `Ok(None)` where the expression goes through complex numbers,
/// loops, or very many choices, which this mode does not treat.
///
/// The gradient of a choice is the choice of the gradients of its branches, each swept by itself: passing the
/// adjoint 0 into the branch that is not taken would give NaN where a slope there is infinite or undefined.
///
/// Griewank and Walther, Evaluating Derivatives, 2nd edition, section 3.2.
///
/// # Errors
/// An operation that depends on a leaf has no derivative rule.
pub fn reverse(g: &mut Graph, root: Id, leaves: &[Id]) -> Result<Option<Partials>, NoDerivative> {
    let live = g.reachable(&[root]);
    let active = activity(g, &live, leaves);
    let in_loop = |id: Id| active[id.index()] && matches!(g.node(id).op, Op::Result(_));
    if g.has_loops() && g.ids().take(live.len()).any(in_loop) {
        return Ok(None);
    }
    let moving = |id: &Id| active[id.index()];
    let ids: Vec<Id> = g.ids().take(live.len()).filter(moving).collect();
    let choices: Vec<Id> = ids
        .iter()
        .copied()
        .filter(|&id| is_choice(g.node(id).op))
        .collect();
    if ids.iter().any(|&id| g.ty(id) == Ty::Complex) || choices.len() > MAX_CHOICES {
        return Ok(None);
    }
    let mut sweep = Sweep {
        leaves,
        active: &active,
        known: Vec::new(),
    };
    for choice in choices {
        let partials = sweep.choice(g, choice)?;
        sweep.known.push((choice, partials));
    }
    sweep.partials(g, root).map(Some)
}

struct Sweep<'a> {
    leaves: &'a [Id],
    active: &'a [bool],
    /// Choices below, in order, with their gradients.
    known: Vec<(Id, Partials)>,
}

impl Sweep<'_> {
    /// The gradient of a choice from those of its branches.
    fn choice(&self, g: &mut Graph, choice: Id) -> Result<Partials, NoDerivative> {
        let node = g.node(choice).clone();
        let (condition, yes, no) = match (node.op, node.args.as_slice()) {
            (Op::Apply(prim @ (Prim::Min | Prim::Max)), &[a, b]) => {
                (takes_second(g, prim, a, b), b, a)
            }
            (_, &[condition, yes, no]) => (condition, yes, no),
            _ => return Ok(vec![None; self.leaves.len()]),
        };
        let (yes, no) = (self.partials(g, yes)?, self.partials(g, no)?);
        let zero = g.real(0.0);
        let mut select = |yes: Option<Id>, no: Option<Id>| {
            (yes.is_some() || no.is_some()).then(|| {
                g.apply(
                    Prim::Select,
                    &[condition, yes.unwrap_or(zero), no.unwrap_or(zero)],
                )
            })
        };
        Ok(yes
            .into_iter()
            .zip(no)
            .map(|(yes, no)| select(yes, no))
            .collect())
    }

    /// The gradient of a node, by adjoints down to the leaves and to the choices below it.
    fn partials(&self, g: &mut Graph, root: Id) -> Result<Partials, NoDerivative> {
        if let Some((_, partials)) = self.known.iter().find(|(id, _)| *id == root) {
            return Ok(partials.clone());
        }
        let live = g.reachable(&[root]);
        let mut adjoints: Vec<Option<Id>> = vec![None; root.index() + 1];
        if self.active.get(root.index()) == Some(&true) {
            adjoints[root.index()] = Some(g.real(1.0));
        }
        let ids: Vec<Id> = g.ids().take(root.index() + 1).collect();
        for id in ids.into_iter().rev() {
            let (true, Some(adjoint)) = (live[id.index()], adjoints[id.index()]) else {
                continue;
            };
            let node = g.node(id).clone();
            let Op::Apply(prim) = node.op else { continue };
            if is_choice(node.op) {
                continue;
            }
            if let Some(slopes) = known_slopes(g, id, |fixed| !self.active[fixed.index()]) {
                for &(value, slope) in &slopes.by {
                    if self.active[value.index()] && !is_zero(g, slope) {
                        let term = g.mul(slope, adjoint);
                        adjoints[value.index()] = sum(g, adjoints[value.index()], Some(term));
                    }
                }
                g.cover(g.span(id));
                continue;
            }
            for (k, &arg) in node.args.iter().enumerate() {
                if !self.active[arg.index()] || g.ty(arg) == Ty::Bool {
                    continue;
                }
                let term = contribution(g, prim, &node.args, id, k, adjoint)?;
                adjoints[arg.index()] = sum(g, adjoints[arg.index()], term);
            }
            g.cover(g.span(id));
        }
        let adjoint = |id: Id| adjoints.get(id.index()).copied().flatten();
        let mut partials: Partials = self.leaves.iter().map(|&l| adjoint(l)).collect();
        for (choice, slopes) in &self.known {
            let Some(adjoint) = adjoint(*choice) else {
                continue;
            };
            for (partial, slope) in partials.iter_mut().zip(slopes) {
                let term = slope.map(|slope| g.mul(slope, adjoint));
                *partial = sum(g, *partial, term);
            }
        }
        Ok(partials)
    }
}

fn is_choice(op: Op) -> bool {
    matches!(op, Op::Apply(Prim::Select | Prim::Min | Prim::Max))
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
    Ok(match (table::derivative(prim), prim, args) {
        (Derivative::Zero, ..) => None,
        (Derivative::Missing, ..) => return Err(NoDerivative { prim }),
        _ if table::is_missing(prim, k) => return Err(NoDerivative { prim }),
        (Derivative::Partial(partial), ..) => {
            let slope = partial(g, args, value, k);
            (!is_zero(g, slope)).then(|| g.mul(slope, adjoint))
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
        // of a real: itself; im and arg of a real are locally constant
        (_, Prim::Re | Prim::Conj, _) => Some(adjoint),
        _ => None,
    })
}
