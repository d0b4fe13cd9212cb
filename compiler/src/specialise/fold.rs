//! Operations on known values, in the arithmetic of the executor's IEEE 754 mode.
//!
//! Sums, products and quotients of floating-point numbers are folded where operands and result are zero or normal: those are
//! correctly rounded or, quotients on some machines, off by a few units, as they are everywhere in a template. Functions of
//! numbers and of vectors are in `functions`.

use naga::{BinaryOperator, Literal, RelationalFunction, ScalarKind, UnaryOperator};

use super::known::Known;

/// `op a`.
pub fn unary(op: UnaryOperator, a: &Known) -> Option<Known> {
    each(a, &|x| match (op, x) {
        (UnaryOperator::Negate, Literal::F32(x)) => Some(Literal::F32(-x)),
        (UnaryOperator::Negate, Literal::I32(x)) => Some(Literal::I32(x.wrapping_neg())),
        (UnaryOperator::LogicalNot, Literal::Bool(x)) => Some(Literal::Bool(!x)),
        (UnaryOperator::BitwiseNot, Literal::U32(x)) => Some(Literal::U32(!x)),
        (UnaryOperator::BitwiseNot, Literal::I32(x)) => Some(Literal::I32(!x)),
        _ => None,
    })
}

/// `a op b`, component by component; a number beside a vector stands for equal components. `truth` is the type of the result
/// of comparing vectors.
pub fn binary(op: BinaryOperator, a: &Known, b: &Known) -> Option<Known> {
    pairs(a, b, &|x, y| match (x, y) {
        (Literal::F32(x), Literal::F32(y)) => float(op, x, y),
        (Literal::U32(x), Literal::U32(y)) => unsigned(op, x, y),
        (Literal::I32(x), Literal::I32(y)) => signed(op, x, y),
        // the right operand of a shift is unsigned, whatever the left one is
        (Literal::I32(x), Literal::U32(y)) => match op {
            BinaryOperator::ShiftLeft => x.checked_shl(y).map(Literal::I32),
            BinaryOperator::ShiftRight => x.checked_shr(y).map(Literal::I32),
            _ => None,
        },
        (Literal::Bool(x), Literal::Bool(y)) => truth(op, x, y),
        _ => None,
    })
}

/// Whether the operator compares: the result of vectors is then a vector of another type.
pub fn compares(op: BinaryOperator) -> bool {
    use BinaryOperator::{Equal, Greater, GreaterEqual, Less, LessEqual, NotEqual};
    matches!(
        op,
        Equal | NotEqual | Less | LessEqual | Greater | GreaterEqual
    )
}

/// A number that machines do not treat differently.
pub(super) fn plain(x: f32) -> Option<f32> {
    (x == 0.0 || x.is_normal()).then_some(x)
}

fn float(op: BinaryOperator, x: f32, y: f32) -> Option<Literal> {
    let (x, y) = (plain(x)?, plain(y)?);
    let number = |z: f32| plain(z).map(Literal::F32);
    match op {
        BinaryOperator::Add => number(x + y),
        BinaryOperator::Subtract => number(x - y),
        BinaryOperator::Multiply => number(x * y),
        BinaryOperator::Divide => number(x / y),
        _ => compared(op, &x, &y),
    }
}

fn unsigned(op: BinaryOperator, x: u32, y: u32) -> Option<Literal> {
    let number = match op {
        BinaryOperator::Add => x.wrapping_add(y),
        BinaryOperator::Subtract => x.wrapping_sub(y),
        BinaryOperator::Multiply => x.wrapping_mul(y),
        BinaryOperator::Divide => x.checked_div(y)?,
        BinaryOperator::Modulo => x.checked_rem(y)?,
        BinaryOperator::And => x & y,
        BinaryOperator::InclusiveOr => x | y,
        BinaryOperator::ExclusiveOr => x ^ y,
        BinaryOperator::ShiftLeft => x.checked_shl(y)?,
        BinaryOperator::ShiftRight => x.checked_shr(y)?,
        _ => return compared(op, &x, &y),
    };
    Some(Literal::U32(number))
}

fn signed(op: BinaryOperator, x: i32, y: i32) -> Option<Literal> {
    let number = match op {
        BinaryOperator::Add => x.wrapping_add(y),
        BinaryOperator::Subtract => x.wrapping_sub(y),
        BinaryOperator::Multiply => x.wrapping_mul(y),
        BinaryOperator::Divide => x.checked_div(y)?,
        BinaryOperator::Modulo => x.checked_rem(y)?,
        BinaryOperator::And => x & y,
        BinaryOperator::InclusiveOr => x | y,
        BinaryOperator::ExclusiveOr => x ^ y,
        _ => return compared(op, &x, &y),
    };
    Some(Literal::I32(number))
}

fn truth(op: BinaryOperator, x: bool, y: bool) -> Option<Literal> {
    Some(Literal::Bool(match op {
        BinaryOperator::LogicalAnd | BinaryOperator::And => x && y,
        BinaryOperator::LogicalOr | BinaryOperator::InclusiveOr => x || y,
        BinaryOperator::Equal => x == y,
        BinaryOperator::NotEqual => x != y,
        _ => return None,
    }))
}

fn compared<T: PartialOrd>(op: BinaryOperator, x: &T, y: &T) -> Option<Literal> {
    Some(Literal::Bool(match op {
        BinaryOperator::Equal => x == y,
        BinaryOperator::NotEqual => x != y,
        BinaryOperator::Less => x < y,
        BinaryOperator::LessEqual => x <= y,
        BinaryOperator::Greater => x > y,
        BinaryOperator::GreaterEqual => x >= y,
        _ => return None,
    }))
}

/// A question about a known value.
pub fn relational(fun: RelationalFunction, a: &Known) -> Option<Known> {
    let components: Vec<&Known> = match a {
        Known::Scalar(_) => vec![a],
        Known::Composite(_, parts) => parts.iter().collect(),
    };
    let mut truths = components.into_iter().map(Known::bool);
    let value = match fun {
        RelationalFunction::All => truths.try_fold(true, |all, x| Some(all & x?))?,
        RelationalFunction::Any => truths.try_fold(false, |any, x| Some(any | x?))?,
        RelationalFunction::IsNan | RelationalFunction::IsInf => return None,
    };
    Some(Known::Scalar(Literal::Bool(value)))
}

/// A number in another format; `None` where machines may differ: what does not fit.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "the shader's conversions are meant, within their range"
)]
pub fn converted(x: Literal, kind: ScalarKind) -> Option<Literal> {
    let fits = |x: f32, low: f32, high: f32| (low..high).contains(&x).then_some(x);
    Some(match (x, kind) {
        (Literal::F32(_), ScalarKind::Float)
        | (Literal::I32(_), ScalarKind::Sint)
        | (Literal::U32(_), ScalarKind::Uint)
        | (Literal::Bool(_), ScalarKind::Bool) => x,
        (Literal::F32(x), ScalarKind::Sint) => {
            Literal::I32(fits(x, -2_147_483_600.0, 2_147_483_600.0)? as i32)
        }
        (Literal::F32(x), ScalarKind::Uint) => Literal::U32(fits(x, 0.0, 4_294_967_000.0)? as u32),
        (Literal::I32(x), ScalarKind::Float) => Literal::F32(x as f32),
        (Literal::U32(x), ScalarKind::Float) => Literal::F32(x as f32),
        (Literal::I32(x), ScalarKind::Uint) => Literal::U32(x.cast_unsigned()),
        (Literal::U32(x), ScalarKind::Sint) => Literal::I32(x.cast_signed()),
        (Literal::Bool(x), ScalarKind::Float) => Literal::F32(f32::from(u8::from(x))),
        (Literal::Bool(x), ScalarKind::Sint) => Literal::I32(i32::from(x)),
        (Literal::Bool(x), ScalarKind::Uint) => Literal::U32(u32::from(x)),
        (Literal::F32(x), ScalarKind::Bool) => Literal::Bool(x != 0.0),
        (Literal::I32(x), ScalarKind::Bool) => Literal::Bool(x != 0),
        (Literal::U32(x), ScalarKind::Bool) => Literal::Bool(x != 0),
        _ => return None,
    })
}

/// The number of another format that has the same bits; `None` for floating-point numbers that machines treat differently.
pub fn with_bits(x: Literal, kind: ScalarKind) -> Option<Literal> {
    let bits = match x {
        Literal::F32(x) => plain(x)?.to_bits(),
        Literal::U32(x) => x,
        Literal::I32(x) => x.cast_unsigned(),
        _ => return None,
    };
    Some(match kind {
        ScalarKind::Float => Literal::F32(plain(f32::from_bits(bits))?),
        ScalarKind::Uint => Literal::U32(bits),
        ScalarKind::Sint => Literal::I32(bits.cast_signed()),
        _ => return None,
    })
}

/// The function of each component. The type of a composite stays what it is: for those whose result has another, the caller
/// sets it.
pub fn each(a: &Known, f: &impl Fn(Literal) -> Option<Literal>) -> Option<Known> {
    match a {
        Known::Scalar(x) => f(*x).map(Known::Scalar),
        Known::Composite(ty, parts) => {
            let parts = parts.iter().map(|part| match part {
                Known::Scalar(x) => f(*x).map(Known::Scalar),
                Known::Composite(..) => None,
            });
            Some(Known::Composite(*ty, parts.collect::<Option<_>>()?))
        }
    }
}

/// As [`each`], of two values.
pub(super) fn pairs(
    a: &Known,
    b: &Known,
    f: &impl Fn(Literal, Literal) -> Option<Literal>,
) -> Option<Known> {
    match (a, b) {
        (_, Known::Scalar(y)) => each(a, &|x| f(x, *y)),
        (Known::Scalar(x), _) => each(b, &|y| f(*x, y)),
        (Known::Composite(ty, left), Known::Composite(_, right)) if left.len() == right.len() => {
            let parts = left
                .iter()
                .zip(right)
                .map(|(x, y)| f(x.literal()?, y.literal()?).map(Known::Scalar));
            Some(Known::Composite(*ty, parts.collect::<Option<_>>()?))
        }
        _ => None,
    }
}
