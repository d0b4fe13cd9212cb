//! Putting values in the place of leaves.

use smallvec::SmallVec;

use super::{Graph, Id, Op};

impl Graph {
    /// The roots with each leaf replaced by its value, in the same graph. Only what depends on a leaf is built anew,
    /// and simplified as it is built. A value must be of its leaf's type and older than its leaf; it may depend on
    /// other leaves, which are replaced in it, too. States of loops are never replaced: a loop whose operands change
    /// keeps its binder and the leaves of its states.
    pub fn replace(&mut self, roots: &[Id], values: &[(Id, Id)]) -> Vec<Id> {
        // operands are older than their users: nothing below the oldest leaf depends on any
        let (Some(first), Some(last)) = (
            values.iter().map(|v| v.0).min(),
            roots.iter().copied().max(),
        ) else {
            return roots.to_vec();
        };
        if last < first {
            return roots.to_vec();
        }
        let mut map = Replaced::over(first, last);
        for &(leaf, value) in values {
            if let (Some(slot), true) = (map.slot(leaf), value < leaf) {
                *slot = Some(value);
            }
        }
        let live = self.live_between(first, last, roots, &map);
        for index in first.0..=last.0 {
            let id = Id(index);
            if !live[(index - first.0) as usize] {
                continue;
            }
            let new = match map.get(id) {
                Some(value) => Some(map.get(value).unwrap_or(value)),
                None => self.rebuilt(id, &map),
            };
            if let Some(slot) = map.slot(id) {
                *slot = new;
            }
        }
        let new = |root: &Id| map.get(*root).unwrap_or(*root);
        roots.iter().map(new).collect()
    }

    /// Marks what the roots, with their leaves replaced, need of the nodes from `first` to `last`.
    fn live_between(&self, first: Id, last: Id, roots: &[Id], map: &Replaced) -> Vec<bool> {
        let mut live = vec![false; (last.0 - first.0) as usize + 1];
        let mark = |live: &mut Vec<bool>, id: Id| {
            if id >= first {
                live[(id.0 - first.0) as usize] = true;
            }
        };
        for &root in roots {
            mark(&mut live, root);
        }
        for index in (first.0..=last.0).rev() {
            if !live[(index - first.0) as usize] {
                continue;
            }
            match map.get(Id(index)) {
                Some(value) => mark(&mut live, value),
                None => {
                    for &arg in &self.node(Id(index)).args {
                        mark(&mut live, arg);
                    }
                }
            }
        }
        live
    }

    /// The node with its new operands, or `None` where none has changed.
    fn rebuilt(&mut self, id: Id, map: &Replaced) -> Option<Id> {
        let node = self.node(id);
        if node.args.iter().all(|&arg| map.get(arg).is_none()) {
            return None;
        }
        let (op, ty) = (node.op, node.ty);
        let args: SmallVec<[Id; 4]> = node
            .args
            .iter()
            .map(|&arg| map.get(arg).unwrap_or(arg))
            .collect();
        let new = match op {
            Op::Apply(prim) => self.apply(prim, &args),
            _ => self.intern(op, ty, &args),
        };
        if new == id {
            return None;
        }
        self.cover(self.span(id));
        if let Some(name) = self.name(id).map(str::to_owned) {
            self.set_name(new, &name);
        }
        // of a node that has not been built anew it is not known whether it ought to have been
        let slopes = self
            .slopes(id)
            .and_then(|s| s.mapped(|old| map.kept_or_new(old)));
        if let Some(slopes) = slopes {
            self.set_slopes(new, slopes);
        }
        Some(new)
    }
}

/// What stands in the place of the nodes of a range.
struct Replaced {
    first: Id,
    new: Vec<Option<Id>>,
}

impl Replaced {
    fn over(first: Id, last: Id) -> Self {
        Self {
            first,
            new: vec![None; (last.0 - first.0) as usize + 1],
        }
    }

    fn slot(&mut self, id: Id) -> Option<&mut Option<Id>> {
        let index = id.0.checked_sub(self.first.0)?;
        self.new.get_mut(index as usize)
    }

    /// What stands in the place of a node, or the node where it is older than all that is replaced.
    fn kept_or_new(&self, id: Id) -> Option<Id> {
        self.get(id).or((id < self.first).then_some(id))
    }

    fn get(&self, id: Id) -> Option<Id> {
        let index = id.0.checked_sub(self.first.0)?;
        self.new.get(index as usize).copied().flatten()
    }
}

#[cfg(test)]
mod tests {
    use crate::ir::{Graph, Id, Loop, Op, Prim, State, Ty, to_text, verify};

    fn input(g: &mut Graph, k: u16) -> Id {
        g.leaf(Op::Input(k), Ty::Real)
    }

    #[test]
    fn what_depends_on_a_leaf_is_simplified() {
        let mut g = Graph::new();
        let x = input(&mut g, 0);
        let one = g.real(1.0);
        let v = g.new_variable(Ty::Real);
        let (sum, product) = (g.add(v, x), g.mul(v, x));
        let square = g.mul(x, x);
        let found = g.replace(&[sum, product, square, v], &[(v, one)]);
        let expected = g.add(one, x);
        assert_eq!(found, [expected, x, square, one]);
    }

    #[test]
    fn values_depend_on_older_leaves() {
        let mut g = Graph::new();
        let x = input(&mut g, 0);
        let u = g.new_variable(Ty::Real);
        let square = g.mul(u, u);
        let v = g.new_variable(Ty::Real);
        let sum = g.add(u, v);
        // v = u², u = x
        let found = g.replace(&[sum], &[(u, x), (v, square)]);
        let square = g.mul(x, x);
        let expected = g.add(x, square);
        assert_eq!(found, [expected]);
    }

    /// z ← z² + v, v times: the body, the start and the count change, the leaf of the state stays.
    #[test]
    fn loops_are_built_anew() {
        let mut g = Graph::new();
        let x = input(&mut g, 0);
        let v = g.new_variable(Ty::Real);
        let binder = g.binder();
        let leaf = g.new_state(binder, Ty::Real);
        let square = g.apply(Prim::PowInt(2), &[leaf]);
        let next = g.add(square, v);
        let repeated = g.repeat(&Loop {
            binder,
            count: v,
            limit: 7,
            until: None,
            states: [State {
                leaf,
                init: v,
                next,
            }]
            .into_iter()
            .collect(),
        });
        let result = g.result(repeated, leaf);
        let found = g.replace(&[result], &[(v, x)]);
        assert!(verify(&g).is_ok());
        let again = g.replace(&found, &[(x, x)]);
        assert_eq!(again, found);
        let text = to_text(&g, &found);
        assert!(!text.contains("variable"), "{text}");
        let it = g.as_loop(g.node(found[0]).args[0]);
        let it = it.unwrap_or_else(|| panic!("{text}"));
        let next = g.add(square, x);
        assert_eq!((it.count, it.limit, it.binder), (x, 7, binder));
        assert_eq!(
            it.states[0],
            State {
                leaf,
                init: x,
                next
            }
        );
    }
}
