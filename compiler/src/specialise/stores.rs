//! What is written to local variables.

use naga::{Block, Expression, Function, Handle, LocalVariable, Statement};
use rustc_hash::FxHashSet;

use super::operands::each_operand;

/// The local variables that are only loaded and stored as a whole: no pointer to one, or to a part of it, is kept.
pub fn tracked(function: &Function) -> FxHashSet<Handle<LocalVariable>> {
    let local = |handle: Handle<Expression>| match function.expressions[handle] {
        Expression::LocalVariable(local) => Some(local),
        _ => None,
    };
    let mut all: FxHashSet<_> = function.local_variables.iter().map(|(h, _)| h).collect();
    for (_, expression) in function.expressions.iter() {
        if !matches!(expression, Expression::Load { .. }) {
            each_operand(&mut expression.clone(), &mut |operand| {
                if let Some(local) = local(*operand) {
                    all.remove(&local);
                }
            });
        }
    }
    each_statement(&function.body, &mut |statement| {
        if let Statement::Call { arguments, .. } = statement {
            for local in arguments.iter().filter_map(|&argument| local(argument)) {
                all.remove(&local);
            }
        }
    });
    all
}

/// The local variables that a block stores to as a whole, with what it stores.
pub fn writes(
    function: &Function,
    block: &Block,
) -> Vec<(Handle<LocalVariable>, Handle<Expression>)> {
    let mut all = Vec::new();
    each_statement(block, &mut |statement| {
        if let Statement::Store { pointer, value } = statement
            && let Expression::LocalVariable(local) = function.expressions[*pointer]
        {
            all.push((local, *value));
        }
    });
    all
}

/// Whether a condition at the end of a branch of a loop's body ends the loop.
pub fn ends_by_condition(body: &Block) -> bool {
    let breaks = |block: &Block| matches!(block.last(), Some(Statement::Break));
    body.iter().any(|statement| match statement {
        Statement::If { accept, reject, .. } => breaks(accept) || breaks(reject),
        _ => false,
    })
}

/// How many statements of a loop's body end the loop or its turn.
pub fn ways_out(body: &Block) -> usize {
    let count = |statement: &Statement| match statement {
        Statement::Break | Statement::Continue => 1,
        Statement::Block(inner) => ways_out(inner),
        Statement::If { accept, reject, .. } => ways_out(accept) + ways_out(reject),
        // whose breaks are its own; its continues may be the loop's, so it counts as a way
        Statement::Switch { .. } => 1,
        _ => 0,
    };
    body.iter().map(count).sum()
}

/// Calls `f` on each statement of a block and of the blocks in it. Depth is that of the template's text, not of the user's.
fn each_statement(block: &Block, f: &mut impl FnMut(&Statement)) {
    for statement in block {
        f(statement);
        match statement {
            Statement::Block(inner) => each_statement(inner, f),
            Statement::If { accept, reject, .. } => {
                each_statement(accept, f);
                each_statement(reject, f);
            }
            Statement::Switch { cases, .. } => {
                cases.iter().for_each(|case| each_statement(&case.body, f));
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                each_statement(body, f);
                each_statement(continuing, f);
            }
            _ => {}
        }
    }
}
