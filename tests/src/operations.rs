//! How much arithmetic a function does: the operations on numbers in its text and in what it calls, a vector's counted for each
//! component, those of a loop once.

use naga::valid::ModuleInfo;
use naga::{
    BinaryOperator, Expression, Function, Handle, MathFunction, Module, TypeInner, UnaryOperator,
};

/// Operations of a function and of those that it calls.
#[must_use]
pub fn operations(module: &Module, info: &ModuleInfo, handle: Handle<Function>) -> usize {
    count(module, info, handle, &|callee| {
        operations(module, info, callee)
    })
}

/// Operations that stand in a function itself: what it calls counts as one, as a built-in function does.
#[must_use]
pub fn own_operations(module: &Module, info: &ModuleInfo, handle: Handle<Function>) -> usize {
    count(module, info, handle, &|_| 1)
}

fn count(
    module: &Module,
    info: &ModuleInfo,
    handle: Handle<Function>,
    of_call: &dyn Fn(Handle<Function>) -> usize,
) -> usize {
    let function = &module.functions[handle];
    let about = &info[handle];
    let size = |h: Handle<Expression>| match about[h].ty.inner_with(&module.types) {
        TypeInner::Vector { size, .. } => *size as usize,
        _ => 1,
    };
    let mut count = 0;
    for (h, expression) in function.expressions.iter() {
        let is_used = about[h].ref_count > 0;
        count += match expression {
            _ if !is_used => 0,
            Expression::Binary { op, .. } => match op {
                BinaryOperator::LogicalAnd | BinaryOperator::LogicalOr => 0,
                _ => size(h),
            },
            Expression::Unary {
                op: UnaryOperator::Negate,
                ..
            }
            | Expression::Select { .. } => size(h),
            Expression::Math { fun, arg, .. } => of_function(*fun, size(*arg), size(h)),
            Expression::CallResult(callee) => of_call(*callee),
            _ => 0,
        };
    }
    count
}

fn of_function(fun: MathFunction, operand: usize, result: usize) -> usize {
    match fun {
        MathFunction::Dot => 2 * operand - 1,
        MathFunction::Length => 2 * operand,
        MathFunction::Distance | MathFunction::Normalize => 3 * operand,
        MathFunction::Cross => 9,
        _ => result,
    }
}

/// Lines of a text that are not empty and no comments.
#[must_use]
pub fn lines(text: &str) -> usize {
    let code = |line: &&str| !line.trim().is_empty() && !line.trim().starts_with("//");
    text.lines().filter(code).count()
}
