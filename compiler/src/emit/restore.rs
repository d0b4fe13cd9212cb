//! The operators `&&` and `||` in the place of the branches that a WGSL parser makes of them.

use naga::{
    BinaryOperator, Block, Expression, Function, Handle, Literal, LocalVariable, Module, Statement,
    UnaryOperator,
};
use rustc_hash::FxHashMap;

/// Turns `if a { v = b } else { v = false }`, with a nameless `v` that is read once, back into `a && b`, and the same with
/// `!a` and `true` into `a || b`. That is what naga's parser writes for these operators. Operands in our shaders have no effect
/// but their value, so it does not matter whether the second one is computed.
pub fn restore_operators(module: &mut Module) {
    for (_, function) in module.functions.iter_mut() {
        restore(function);
    }
    for entry in &mut module.entry_points {
        restore(&mut entry.function);
    }
}

/// The only place where each nameless variable is read.
type Loads = FxHashMap<Handle<LocalVariable>, Vec<Handle<Expression>>>;

fn restore(function: &mut Function) {
    let mut loads = Loads::default();
    for (handle, expression) in function.expressions.iter() {
        if let Expression::Load { pointer } = *expression
            && let Expression::LocalVariable(variable) = function.expressions[pointer]
            && function.local_variables[variable].name.is_none()
        {
            loads.entry(variable).or_default().push(handle);
        }
    }
    let body = std::mem::take(&mut function.body);
    function.body = restored(body, function, &loads);
}

fn restored(block: Block, function: &mut Function, loads: &Loads) -> Block {
    let mut out = Block::new();
    for (statement, span) in block.span_into_iter() {
        match statement {
            Statement::Block(inner) => {
                out.push(Statement::Block(restored(inner, function, loads)), span);
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => out.push(
                Statement::Loop {
                    body: restored(body, function, loads),
                    continuing: restored(continuing, function, loads),
                    break_if,
                },
                span,
            ),
            Statement::Switch {
                selector,
                mut cases,
            } => {
                for case in &mut cases {
                    let body = std::mem::take(&mut case.body);
                    case.body = restored(body, function, loads);
                }
                out.push(Statement::Switch { selector, cases }, span);
            }
            Statement::If {
                condition,
                accept,
                reject,
            } => {
                let accept = restored(accept, function, loads);
                let reject = restored(reject, function, loads);
                match operator(function, loads, condition, &accept, &reject) {
                    Some((load, operation)) => {
                        function.expressions[load] = operation;
                        let operands = accept.span_into_iter();
                        let steps = operands.filter(|(s, _)| !matches!(s, Statement::Store { .. }));
                        for (step, span) in steps {
                            out.push(step, span);
                        }
                    }
                    None => out.push(
                        Statement::If {
                            condition,
                            accept,
                            reject,
                        },
                        span,
                    ),
                }
            }
            other => out.push(other, span),
        }
    }
    out
}

/// The operation that a branch stands for, and the load that gives its value.
fn operator(
    function: &Function,
    loads: &Loads,
    condition: Handle<Expression>,
    accept: &Block,
    reject: &Block,
) -> Option<(Handle<Expression>, Expression)> {
    let (
        Statement::Store {
            pointer,
            value: right,
        },
        steps,
    ) = accept.split_last()?
    else {
        return None;
    };
    let &[
        Statement::Store {
            pointer: other,
            value: otherwise,
        },
    ] = &reject[..]
    else {
        return None;
    };
    let Expression::LocalVariable(variable) = function.expressions[*pointer] else {
        return None;
    };
    let only_values = |s: &Statement| matches!(s, Statement::Emit(_) | Statement::Call { .. });
    let same = matches!(function.expressions[other], Expression::LocalVariable(v) if v == variable);
    if !same || !steps.iter().all(only_values) {
        return None;
    }
    let &[load] = loads.get(&variable)?.as_slice() else {
        return None;
    };
    if load < *right {
        return None;
    }
    let (op, left) = match (
        &function.expressions[otherwise],
        &function.expressions[condition],
    ) {
        (Expression::Literal(Literal::Bool(false)), _) => (BinaryOperator::LogicalAnd, condition),
        (
            Expression::Literal(Literal::Bool(true)),
            &Expression::Unary {
                op: UnaryOperator::LogicalNot,
                expr,
            },
        ) => (BinaryOperator::LogicalOr, expr),
        _ => return None,
    };
    Some((
        load,
        Expression::Binary {
            op,
            left,
            right: *right,
        },
    ))
}
