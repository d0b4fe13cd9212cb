//! Parameters as constants in a finished function.

use naga::{
    BinaryOperator, Block, Expression, Function, Handle, Literal, Range, Statement, UnaryOperator,
};

use crate::program::Program;

/// Puts the parameters' values in the place of the arguments that begin with `first`, and computes what is then made of
/// literals alone, rounded as the device would.
pub(super) fn fix(function: &mut Function, first: u32, program: &Program) {
    let count = u32::try_from(program.params().len()).unwrap_or(0);
    for (_, expression) in function.expressions.iter_mut() {
        let Expression::FunctionArgument(k) = expression else {
            continue;
        };
        if *k >= first + count {
            *k -= count;
        } else if *k >= first {
            let param = &program.params()[(*k - first) as usize];
            #[allow(
                clippy::cast_possible_truncation,
                reason = "a number as the shader has it"
            )]
            let value = param.default as f32;
            *expression = Expression::Literal(Literal::F32(value));
        }
    }
    let range = first as usize..(first + count) as usize;
    if range.end <= function.arguments.len() {
        function.arguments.drain(range);
    }
    fold(function);
}

fn fold(function: &mut Function) {
    let handles: Vec<Handle<Expression>> = function.expressions.iter().map(|(h, _)| h).collect();
    for handle in handles {
        let literal = |of: Handle<Expression>| match function.expressions[of] {
            Expression::Literal(Literal::F32(value)) => Some(value),
            _ => None,
        };
        let folded =
            match function.expressions[handle] {
                Expression::Binary { op, left, right } => literal(left)
                    .zip(literal(right))
                    .and_then(|(a, b)| match op {
                        BinaryOperator::Add => Some(a + b),
                        BinaryOperator::Subtract => Some(a - b),
                        BinaryOperator::Multiply => Some(a * b),
                        BinaryOperator::Divide => Some(a / b),
                        _ => None,
                    }),
                Expression::Unary {
                    op: UnaryOperator::Negate,
                    expr,
                } => literal(expr).map(|a| -a),
                _ => None,
            };
        if let Some(value) = folded.filter(|v| v.is_finite()) {
            function.expressions[handle] = Expression::Literal(Literal::F32(value));
            function.named_expressions.shift_remove(&handle);
        }
    }
    let mut body = std::mem::take(&mut function.body);
    emit_no_literals(&mut body, function);
    function.body = body;
}

/// Literals are no part of what is computed at a moment.
fn emit_no_literals(block: &mut Block, function: &Function) {
    let old = std::mem::take(block);
    for (mut statement, span) in old.span_into_iter() {
        match &mut statement {
            Statement::Emit(range) => {
                let all: Vec<Handle<Expression>> = range.clone().collect();
                let is_literal = |h: &Handle<Expression>| {
                    matches!(function.expressions[*h], Expression::Literal(_))
                };
                for run in all.split(is_literal) {
                    if let (Some(&first), Some(&last)) = (run.first(), run.last()) {
                        block.push(Statement::Emit(Range::new_from_bounds(first, last)), span);
                    }
                }
                continue;
            }
            Statement::Block(inner) => emit_no_literals(inner, function),
            Statement::If { accept, reject, .. } => {
                emit_no_literals(accept, function);
                emit_no_literals(reject, function);
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                emit_no_literals(body, function);
                emit_no_literals(continuing, function);
            }
            Statement::Switch { cases, .. } => {
                for case in cases {
                    emit_no_literals(&mut case.body, function);
                }
            }
            _ => {}
        }
        block.push(statement, span);
    }
}
