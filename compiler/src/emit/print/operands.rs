//! What expressions and statements read.

use naga::{Expression, Function, Handle, Statement};
use smallvec::{SmallVec, smallvec};

/// Operands of an expression, or the reason why it cannot be printed. Those of a call's result are its arguments, which the
/// statement knows.
pub(super) fn operands(
    expression: &Expression,
) -> Result<SmallVec<[Handle<Expression>; 4]>, &'static str> {
    Ok(match *expression {
        Expression::Literal(_)
        | Expression::Constant(_)
        | Expression::ZeroValue(_)
        | Expression::FunctionArgument(_)
        | Expression::GlobalVariable(_)
        | Expression::LocalVariable(_)
        | Expression::CallResult(_) => smallvec![],
        Expression::Compose { ref components, .. } => components.iter().copied().collect(),
        Expression::Access { base, index } => smallvec![base, index],
        Expression::AccessIndex { base, .. } => smallvec![base],
        Expression::Splat { value, .. } => smallvec![value],
        Expression::Swizzle { vector, .. } => smallvec![vector],
        Expression::Load { pointer } => smallvec![pointer],
        Expression::Unary { expr, .. } | Expression::As { expr, .. } => smallvec![expr],
        Expression::Binary { left, right, .. } => smallvec![left, right],
        Expression::Select {
            condition,
            accept,
            reject,
        } => smallvec![condition, accept, reject],
        Expression::Relational { argument, .. } => smallvec![argument],
        Expression::Math {
            arg,
            arg1,
            arg2,
            arg3,
            ..
        } => [Some(arg), arg1, arg2, arg3]
            .into_iter()
            .flatten()
            .collect(),
        Expression::ArrayLength(array) => smallvec![array],
        _ => return Err("an image, a ray query or another thing that formulas do not have"),
    })
}

/// Expressions that a statement reads by itself, without those of the blocks in it.
pub(super) fn reads(
    statement: &Statement,
) -> Result<SmallVec<[Handle<Expression>; 4]>, &'static str> {
    Ok(match statement {
        Statement::Emit(_)
        | Statement::Block(_)
        | Statement::Break
        | Statement::Continue
        | Statement::Kill
        | Statement::Loop { break_if: None, .. }
        | Statement::Return { value: None } => smallvec![],
        Statement::Return { value: Some(value) } => smallvec![*value],
        Statement::If { condition, .. } => smallvec![*condition],
        Statement::Switch { selector, .. } => smallvec![*selector],
        Statement::Store { pointer, value } => smallvec![*pointer, *value],
        // the arguments belong to the result, which may be written where it is used
        Statement::Call {
            result: Some(_), ..
        } => smallvec![],
        Statement::Call {
            arguments,
            result: None,
            ..
        } => arguments.iter().copied().collect(),
        _ => return Err("a statement that formulas do not have"),
    })
}

/// The local variable that a pointer leads to.
pub(super) fn variable_of(
    function: &Function,
    mut pointer: Handle<Expression>,
) -> Option<Handle<naga::LocalVariable>> {
    loop {
        match function.expressions[pointer] {
            Expression::LocalVariable(variable) => return Some(variable),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
                pointer = base;
            }
            _ => return None,
        }
    }
}
