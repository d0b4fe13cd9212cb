//! The operands of an expression.

use naga::{Expression, Handle};

/// Calls `f` on each operand. Expressions that no shader of ours has are left as they are; see [`is_foreseen`].
pub fn each_operand(expression: &mut Expression, f: &mut impl FnMut(&mut Handle<Expression>)) {
    match expression {
        Expression::Compose { components, .. } => components.iter_mut().for_each(f),
        Expression::Access { base, index } => {
            f(base);
            f(index);
        }
        Expression::AccessIndex { base: operand, .. }
        | Expression::Splat { value: operand, .. }
        | Expression::Swizzle {
            vector: operand, ..
        }
        | Expression::Load { pointer: operand }
        | Expression::Unary { expr: operand, .. }
        | Expression::Relational {
            argument: operand, ..
        }
        | Expression::As { expr: operand, .. }
        | Expression::ArrayLength(operand) => f(operand),
        Expression::Binary { left, right, .. } => {
            f(left);
            f(right);
        }
        Expression::Select {
            condition,
            accept,
            reject,
        } => {
            f(condition);
            f(accept);
            f(reject);
        }
        Expression::Math {
            arg,
            arg1,
            arg2,
            arg3,
            ..
        } => {
            f(arg);
            [arg1, arg2, arg3].into_iter().flatten().for_each(f);
        }
        _ => {}
    }
}

/// Whether [`each_operand`] knows the expression.
pub fn is_foreseen(expression: &Expression) -> bool {
    expression.needs_pre_emit()
        || matches!(
            expression,
            Expression::Compose { .. }
                | Expression::Access { .. }
                | Expression::AccessIndex { .. }
                | Expression::Splat { .. }
                | Expression::Swizzle { .. }
                | Expression::Load { .. }
                | Expression::Unary { .. }
                | Expression::Binary { .. }
                | Expression::Select { .. }
                | Expression::Relational { .. }
                | Expression::Math { .. }
                | Expression::As { .. }
                | Expression::CallResult(_)
                | Expression::ArrayLength(_)
        )
}
