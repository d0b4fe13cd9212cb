//! What the arguments of an operator are, by their text.

use pullback_grammar::ast::{Expr, ExprId, Exprs, Function, Name};

use super::prime::MAX_ORDER;
use crate::check::{builtins, library};
use crate::table;

/// The variables behind the first argument, in order; a number repeats the one before it. `None` where they are
/// something else, or more than [`MAX_ORDER`].
pub(super) fn variables<'a>(exprs: &'a Exprs, rest: &[ExprId]) -> Option<Vec<&'a Name>> {
    let mut out: Vec<&Name> = Vec::new();
    let mut repeatable = false;
    for &arg in rest {
        match &exprs[arg] {
            Expr::Name(name) => {
                out.push(name);
                repeatable = true;
            }
            _ => {
                let times = order(exprs, arg).filter(|_| repeatable)?;
                let last = *out.last()?;
                out.extend((1..times).map(|_| last));
                repeatable = false;
            }
        }
    }
    (!out.is_empty() && out.len() <= MAX_ORDER as usize).then_some(out)
}

/// The first name that stands a second time among the variables.
pub(super) fn named_twice<'a>(exprs: &'a Exprs, rest: &[ExprId]) -> Option<&'a Name> {
    let mut seen: Vec<&str> = Vec::new();
    for &arg in rest {
        let Expr::Name(name) = &exprs[arg] else {
            continue;
        };
        if seen.contains(&name.text.as_str()) {
            return Some(name);
        }
        // more are too many in any case
        if seen.len() < 16 {
            seen.push(&name.text);
        }
    }
    None
}

/// A literal order of a derivative that is not too high.
pub fn order(exprs: &Exprs, arg: ExprId) -> Option<u32> {
    let Expr::Number(value) = exprs[arg] else {
        return None;
    };
    (1..=MAX_ORDER).find(|&n| f64::from(n) == value)
}

/// The arguments behind a function's name that are its point, and the order of the derivative.
pub fn point_and_order(exprs: &Exprs, rest: &[ExprId]) -> (Vec<ExprId>, u32) {
    match rest {
        [point @ .., last] if !point.is_empty() => match order(exprs, *last) {
            Some(order) => (point.to_vec(), order),
            None => (rest.to_vec(), 1),
        },
        _ => (rest.to_vec(), 1),
    }
}

/// The numbers of arguments that a function takes; none where it is not known.
pub fn arities_of(function: Option<&Function>, name: &str) -> Vec<usize> {
    if let Some(function) = function {
        return vec![function.params.len()];
    }
    if let Some(builtin) = builtins::by_name(name) {
        return builtin.arity.clone().collect();
    }
    let definitions = library::by_name(name).unwrap_or_default();
    let row = table::by_name(name).map(|row| row.typing.arity());
    let of_library = definitions.iter().map(|f| f.types.len());
    of_library.chain(row).collect()
}
