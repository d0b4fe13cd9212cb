//! How the time of each stage grows with the size of a formula.

use std::fmt::Write as _;

use pullback_compiler::compile;
use pullback_compiler::lower::Precision;

use super::stages::stages;
use super::statistics::median;
use crate::Error;

/// Terms of the sums that are compiled.
pub const TERMS: [u32; 5] = [2, 20, 200, 2_000, 20_000];

/// Syntax nodes of a term.
const NODES: u32 = 5;
/// Turns of the smaller sums, and of those above a thousand terms.
const TURNS: [usize; 2] = [15, 3];

/// What a sum takes.
#[derive(Clone, Copy, Debug)]
pub struct Grown {
    /// Syntax nodes.
    pub nodes: f64,
    /// Seconds of each of [`STAGES`](super::STAGES).
    pub seconds: [f64; 5],
}

impl Grown {
    /// Seconds of all stages.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.seconds.iter().sum()
    }
}

/// Medians of the stages for a sum of distinct terms, which no common subexpression shortens.
///
/// # Errors
/// As [`stages`].
pub fn grown(terms: u32) -> Result<Grown, Error> {
    let mut text = String::from("f(x, y) = x");
    for k in 1..terms {
        let _ = write!(text, " + {k} x y");
    }
    let settings = compile(&text)
        .program
        .map(|program| program.pictures()[0].settings.clone())
        .ok_or_else(|| Error::Invalid {
            reason: format!("a sum of {terms} terms has errors"),
        })?;
    let turns = TURNS[usize::from(terms > 1_000)];
    let mut all = Vec::with_capacity(turns);
    for _ in 0..=turns {
        all.push(stages(&text, &settings, Precision::Accurate.into())?);
    }
    // the first turn parses templates and fills caches
    let of = |k: usize| {
        let times: Vec<f64> = all[1..].iter().map(|turn| turn[k]).collect();
        median(&times)
    };
    Ok(Grown {
        nodes: f64::from(NODES * terms),
        seconds: [0, 1, 2, 3, 4].map(of),
    })
}
