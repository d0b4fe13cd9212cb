//! Sums whose addends have conditions of their own: clamp(x) + clamp(y).
//!
//! Cut together, each piece of one is cut by the conditions of the others, and every addend is integrated on every
//! piece. Addends that share no condition are integrated one by one instead.

use smallvec::SmallVec;

use super::Integrator;
use super::arithmetic::{add, sub};
use crate::ir::{Id, Op, Prim};

/// Greatest number of addends that are told apart.
const MAX_ADDENDS: usize = 64;

/// Addends that share conditions, and what these compare.
struct Group {
    sum: Id,
    conditions: Vec<(Id, Option<Id>)>,
}

impl Integrator<'_> {
    /// The sums of those addends of an expression that share conditions; the expression itself where there are not two
    /// with some.
    pub(super) fn addends(&mut self, root: Id) -> SmallVec<[Id; 4]> {
        let whole = SmallVec::from_slice(&[root]);
        let Some(addends) = self.signed_addends(root) else {
            return whole;
        };
        let mut groups: Vec<Group> = Vec::new();
        for (id, is_negative) in addends {
            let conditions = self.conditions(id);
            let conditions: Vec<_> = conditions.into_iter().map(|(_, a, b)| (a, b)).collect();
            let shares = |group: &Group| {
                group.conditions.is_empty() && conditions.is_empty()
                    || group.conditions.iter().any(|c| conditions.contains(c))
            };
            let (same, mut others): (Vec<Group>, Vec<Group>) = groups.into_iter().partition(shares);
            let mut joined = Group {
                sum: self.g.real(0.0),
                conditions,
            };
            for group in same {
                joined.sum = add(self.g, joined.sum, group.sum);
                joined.conditions.extend(group.conditions);
            }
            joined.sum = if is_negative {
                sub(self.g, joined.sum, id)
            } else {
                add(self.g, joined.sum, id)
            };
            others.push(joined);
            groups = others;
        }
        let with_conditions = groups.iter().filter(|g| !g.conditions.is_empty());
        if with_conditions.count() < 2 {
            return whole;
        }
        groups.into_iter().map(|group| group.sum).collect()
    }

    /// What is added up, each with whether it is subtracted, in order; `None` of no sum, or of too long a one.
    fn signed_addends(&mut self, root: Id) -> Option<Vec<(Id, bool)>> {
        let mut out = Vec::new();
        let mut stack = vec![(root, false)];
        while let Some((id, is_negative)) = stack.pop() {
            if out.len() + stack.len() > MAX_ADDENDS {
                return None;
            }
            let node = self.g.node(id).clone();
            match (node.op, node.args.as_slice()) {
                _ if self.degree(id).is_some() => out.push((id, is_negative)),
                (Op::Apply(Prim::Add), &[a, b]) => {
                    stack.extend([(b, is_negative), (a, is_negative)])
                }
                (Op::Apply(Prim::Sub), &[a, b]) => {
                    stack.extend([(b, !is_negative), (a, is_negative)])
                }
                (Op::Apply(Prim::Neg), &[a]) => stack.push((a, !is_negative)),
                _ => out.push((id, is_negative)),
            }
        }
        (out.len() > 1).then_some(out)
    }
}
