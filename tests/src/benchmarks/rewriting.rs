//! Stability rewrites, switched on and off.

use pullback_compiler::formula::Formula;
use pullback_compiler::stable::{Phase, Rewrites, stabilise};

/// The formula with all rewrites, or with none.
#[must_use]
pub fn with_rewrites(formula: &Formula, on: bool) -> Formula {
    let rewrites = if on { Rewrites::ON } else { Rewrites::OFF };
    formula.clone().with_rewrites(rewrites)
}

/// How many rewrites take place.
#[must_use]
pub fn count(formula: &Formula) -> usize {
    [Phase::Early, Phase::Late]
        .into_iter()
        .map(|phase| {
            let (graph, value) = formula.to_compile();
            stabilise(graph, value, Rewrites::ON, phase)
        })
        .map(|stable| stable.applied.len())
        .max()
        .unwrap_or(0)
}
