//! What the suite of derivatives shares: points, values, and how near they must be.

use pullback_compiler::formula::Formula;
use pullback_compiler::{Evaluator, What, compile};

/// Points at which formulas are compared.
#[derive(Clone, Copy, Debug)]
pub enum Points {
    /// Of the plane; none on an axis or the diagonal.
    Plane,
}

impl Points {
    /// Their coordinates.
    #[must_use]
    pub fn rows(self) -> Vec<Vec<f64>> {
        match self {
            Self::Plane => [
                [0.37, -1.21],
                [1.9, 0.53],
                [-0.71, -0.29],
                [-2.3, 1.7],
                [0.11, 2.9],
            ]
            .iter()
            .map(|p| p.to_vec())
            .collect(),
        }
    }
}

/// The formula that a program shows first.
///
/// # Errors
/// The program is wrong; its diagnostics.
pub fn formula(text: &str) -> Result<(Formula, Vec<f64>), String> {
    let answer = compile(text);
    let Some(program) = answer.program else {
        return Err(pullback_grammar::render(
            &answer.diagnostics,
            "calculus",
            text,
            false,
        ));
    };
    let params = program.params().iter().map(|p| p.default).collect();
    Ok((program.pictures()[0].formula.clone(), params))
}

/// The values of a program's formula at points, in `f64`.
///
/// # Errors
/// The program is wrong.
pub fn values(text: &str, points: Points) -> Result<Vec<Vec<f64>>, String> {
    let (formula, params) = formula(text)?;
    let mut evaluator =
        Evaluator::new(&formula, What::Value).map_err(|e| format!("{text}: {e:?}"))?;
    let mut out = vec![0.0; evaluator.outputs().len()];
    let width = evaluator.inputs().len();
    Ok(points
        .rows()
        .iter()
        .map(|row| {
            evaluator.eval(&params, 0.7, 0.0, &row[..width.min(row.len())], &mut out);
            out.clone()
        })
        .collect())
}

/// The first value that is not as expected, within a bound relative to it and to 1.
#[must_use]
pub fn close_to(found: &[Vec<f64>], expected: &[Vec<f64>], bound: f64) -> Option<String> {
    let pairs = found.iter().flatten().zip(expected.iter().flatten());
    for (k, (f, e)) in pairs.enumerate() {
        // also where either is not a number
        let near = (f - e).abs() <= bound * (1.0 + e.abs());
        if !near {
            return Some(format!("number {k}: {f:?} instead of {e:?}"));
        }
    }
    (found.len() != expected.len()).then(|| "of another number".to_owned())
}
