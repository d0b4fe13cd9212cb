//! Checks that a graph is well formed.

use super::{Graph, Id, Node, Op, Ty};
use crate::table;

/// A node that breaks an invariant of the IR.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Invalid {
    /// The node.
    pub id: Id,
    /// The invariant.
    pub reason: &'static str,
}

/// Checks every node: operands precede their users, and types fit the operator table.
///
/// # Errors
/// The first node that is not well formed.
pub fn verify(graph: &Graph) -> Result<(), Invalid> {
    for (id, node) in graph.ids().zip(graph.nodes()) {
        if node.args.iter().any(|&a| a >= id) {
            return Err(Invalid {
                id,
                reason: "an operand does not precede its user",
            });
        }
        check(graph, id, node).map_err(|reason| Invalid { id, reason })?;
    }
    Ok(())
}

fn check_loop(graph: &Graph, id: Id) -> Result<(), &'static str> {
    let it = graph.as_loop(id).ok_or("a loop has no count")?;
    let given = graph.node(id).args.len();
    if graph.ty(id) != Ty::Loop || given != it.operands().count() {
        return Err("a loop's operands are not those of its states");
    }
    if graph.ty(it.count) != Ty::Real || it.until.is_some_and(|u| graph.ty(u) != Ty::Bool) {
        return Err("a loop's count or condition has the wrong type");
    }
    for (k, state) in it.states.iter().enumerate() {
        if it.states[..k].iter().any(|other| other.leaf == state.leaf) {
            return Err("a loop has two states with one leaf");
        }
        let ty = graph.ty(state.leaf);
        let is_own = matches!(graph.node(state.leaf).op, Op::State(b, _) if b == it.binder);
        if !is_own || graph.ty(state.init) != ty || graph.ty(state.next) != ty {
            return Err("a loop's state, start and next value do not fit");
        }
    }
    Ok(())
}

fn check_result(graph: &Graph, node: &Node) -> Result<(), &'static str> {
    let it = node.args.first().and_then(|&a| graph.as_loop(a));
    let states = it.iter().flat_map(|it| &it.states);
    let mut leaves = states.map(|s| graph.node(s.leaf));
    match node.op {
        Op::Result(k)
            if leaves.any(|l| matches!(l.op, Op::State(_, j) if j == k) && l.ty == node.ty) =>
        {
            Ok(())
        }
        _ => Err("a result is of no state of its loop"),
    }
}

fn check(graph: &Graph, id: Id, node: &Node) -> Result<(), &'static str> {
    let leaf_ty = match node.op {
        Op::Const(_) | Op::Param(_) | Op::Time | Op::Pixel => Ty::Real,
        Op::Truth(_) => Ty::Bool,
        Op::Input(_) | Op::Variable(_) | Op::State(..) => node.ty,
        Op::Counter(_) => Ty::Real,
        Op::Loop { .. } => return check_loop(graph, id),
        Op::Result(_) => return check_result(graph, node),
        Op::Apply(prim) => {
            let tys: Vec<Ty> = node.args.iter().map(|&a| graph.ty(a)).collect();
            return match table::row(prim).typing.result(&tys) {
                Some(ty) if ty == node.ty => Ok(()),
                Some(_) => Err("the result type is not that of the operator table"),
                None => Err("the operand types are not those of the operator table"),
            };
        }
    };
    if !node.args.is_empty() {
        return Err("a leaf has operands");
    }
    if leaf_ty == node.ty {
        Ok(())
    } else {
        Err("a leaf has the wrong type")
    }
}
