//! What an operation takes, and where the numbers are known from.

use naga::{Expression, Function, Handle, Literal};
use rustc_hash::FxHashMap;

use super::site::{Choice, Operand};
use super::text::Writer;

/// Operands that are looked through, such as vectors that are put together from parts, before they count as unknown.
const DEPTH: usize = 6;

/// Sites that tell values.
#[derive(Debug, Default)]
pub(super) struct Known(FxHashMap<Handle<Expression>, Vec<(Vec<u32>, usize)>>);

impl Known {
    /// A site tells the part of a value that these indices lead to.
    pub(super) fn insert(&mut self, value: Handle<Expression>, path: Vec<u32>, site: usize) {
        self.0.entry(value).or_default().push((path, site));
    }

    /// Where the part of a value is told that these indices lead to: several places where it has several parts itself.
    fn find(&self, value: Handle<Expression>, path: &[u32]) -> Option<Vec<Operand>> {
        let parts = self.0.get(&value)?;
        let below: Vec<Operand> = parts
            .iter()
            .filter(|(known, _)| known.starts_with(path))
            .map(|&(_, site)| Operand::Site(site, None))
            .collect();
        if !below.is_empty() {
            return Some(below);
        }
        // a component of a vector that is told as a whole
        let (&last, rest) = path.split_last()?;
        let whole = parts.iter().find(|(known, _)| known == rest)?;
        Some(vec![Operand::Site(whole.1, Some(u8::try_from(last).ok()?))])
    }
}

/// Whether an expression computes something, or fetches it from memory.
pub(super) fn is_operation(expression: &Expression) -> bool {
    matches!(
        expression,
        Expression::Binary { .. }
            | Expression::Unary { .. }
            | Expression::Math { .. }
            | Expression::Select { .. }
            | Expression::Relational { .. }
            | Expression::As { .. }
            | Expression::CallResult(_)
            | Expression::Load { .. }
    )
}

/// What a value is computed from.
#[derive(Debug, Default)]
pub(super) struct Taken {
    /// What is known of it.
    pub(super) operands: Vec<Operand>,
    pub(super) choice: Option<Choice>,
    /// Whether all of it is known, and counts.
    pub(super) is_complete: bool,
}

/// What an operation takes.
pub(super) fn taken(
    function: &Function,
    writer: &Writer,
    known: &Known,
    operation: Handle<Expression>,
) -> Taken {
    let all: Vec<Handle<Expression>> = match function.expressions[operation] {
        Expression::Binary { left, right, .. } => vec![left, right],
        Expression::Unary { expr, .. } | Expression::As { expr, .. } => vec![expr],
        Expression::Relational { argument, .. } => vec![argument],
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
        Expression::Select {
            condition,
            accept,
            reject,
        } => return chosen(function, known, [condition, accept, reject]),
        Expression::CallResult(_) => writer.arguments(operation).to_vec(),
        _ => return Taken::default(),
    };
    let mut operands = Vec::new();
    let mut is_complete = true;
    for operand in all {
        is_complete &= resolve(function, known, operand, &[], DEPTH, &mut operands).is_some();
    }
    Taken {
        operands,
        choice: None,
        is_complete,
    }
}

fn chosen(
    function: &Function,
    known: &Known,
    [condition, accept, reject]: [Handle<Expression>; 3],
) -> Taken {
    let mut operands = Vec::new();
    let mut add = |value| {
        let _ = resolve(function, known, value, &[], DEPTH, &mut operands);
        operands.len()
    };
    let choice = Choice {
        accept: add(condition),
        reject: add(accept),
    };
    add(reject);
    Taken {
        operands,
        choice: Some(choice),
        is_complete: false,
    }
}

/// What a value is made of that is handed on: returned, stored, or decided by.
pub(super) fn parts(function: &Function, known: &Known, value: Handle<Expression>) -> Vec<Operand> {
    let mut operands = Vec::new();
    let _ = resolve(function, known, value, &[], DEPTH, &mut operands);
    operands
}

fn resolve(
    function: &Function,
    known: &Known,
    value: Handle<Expression>,
    path: &[u32],
    depth: usize,
    all: &mut Vec<Operand>,
) -> Option<()> {
    if let Some(found) = known.find(value, path) {
        all.extend(found);
        return Some(());
    }
    let depth = depth.checked_sub(1)?;
    match &function.expressions[value] {
        Expression::Literal(literal) => all.push(Operand::Number(number(*literal))),
        Expression::ZeroValue(_) => all.push(Operand::Number(0.0)),
        Expression::AccessIndex { base, index } => {
            let path = [&[*index], path].concat();
            resolve(function, known, *base, &path, depth, all)?;
        }
        Expression::Compose { components, .. } => match path.split_first() {
            Some((&index, rest)) => {
                let component = *components.get(index as usize)?;
                resolve(function, known, component, rest, depth, all)?;
            }
            None => {
                let mut found = Some(());
                for &component in components {
                    let one = resolve(function, known, component, &[], depth, all);
                    found = found.and(one);
                }
                return found;
            }
        },
        Expression::Splat { value, .. } => resolve(function, known, *value, &[], depth, all)?,
        Expression::Swizzle { vector, .. } => resolve(function, known, *vector, &[], depth, all)?,
        _ => return None,
    }
    Some(())
}

fn number(literal: Literal) -> f64 {
    match literal {
        Literal::F32(x) => x.into(),
        Literal::F64(x) => x,
        Literal::U32(x) => x.into(),
        Literal::I32(x) => x.into(),
        Literal::Bool(x) => f64::from(u8::from(x)),
        _ => 0.0,
    }
}
