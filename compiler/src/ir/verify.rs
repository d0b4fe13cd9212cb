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
        check(graph, node).map_err(|reason| Invalid { id, reason })?;
    }
    Ok(())
}

fn check(graph: &Graph, node: &Node) -> Result<(), &'static str> {
    let leaf_ty = match node.op {
        Op::Const(_) | Op::Param(_) | Op::Time | Op::Pixel => Ty::Real,
        Op::Truth(_) => Ty::Bool,
        Op::Input(_) => node.ty,
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
