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

/// The local variables that a block stores to as a whole.
pub fn writes(function: &Function, block: &Block) -> FxHashSet<Handle<LocalVariable>> {
    let mut all = FxHashSet::default();
    each_statement(block, &mut |statement| {
        if let Statement::Store { pointer, .. } = statement
            && let Expression::LocalVariable(local) = function.expressions[*pointer]
        {
            all.insert(local);
        }
    });
    all
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
