//! Finished shader modules: a scene with a formula in it, and the evaluation of rows of numbers.

mod bounds;
mod column;
mod demand;
mod evaluation;
mod reciprocal;
mod rows;
mod scene;
mod substitute;

pub use demand::DEMANDS;
pub use evaluation::{Evaluation, What, evaluation, stable_evaluation};
pub use rows::{EvalModule, Evaluator, MAX_COLUMNS, MAX_RESULTS};
pub use scene::SceneModule;

use naga::Module;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use pullback_grammar::Diagnostic;

use crate::formula::Formula;
use crate::lower::{Format, LowerError, Precision};

/// Why a module could not be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ModuleError {
    /// A function could not be lowered.
    Lower(LowerError),
    /// The finished module is not valid; this is a mistake of ours.
    Invalid(String),
}

impl<T: Into<LowerError>> From<T> for ModuleError {
    fn from(error: T) -> Self {
        Self::Lower(error.into())
    }
}

impl ModuleError {
    /// The error at the formula's place.
    #[must_use]
    pub fn diagnostic(&self, formula: &Formula) -> Diagnostic {
        let span = formula.span;
        match self {
            Self::Lower(LowerError::NoForm(usage)) => Diagnostic::error(
                "no-gpu-form",
                span,
                format!("{usage} cannot be computed on the GPU for these types"),
            )
            .with_hint("`eval --on reference` computes it in f64"),
            Self::Lower(LowerError::NoDerivative(missing)) => Diagnostic::error(
                "no-derivative",
                span,
                format!(
                    "`{}` has no {}, and that is needed here",
                    crate::table::written(missing.prim).usage,
                    crate::table::lacking(missing.prim)
                ),
            ),
            Self::Lower(LowerError::NoIntegral(problem)) => problem.diagnostic(span),
            Self::Lower(LowerError::NoColumn(problem)) => problem.diagnostic(span).with_hint(
                "this scene wants it for `steps_by = integral`; `steps_by = samples` steps along rays, `auto` where it has to",
            ),
            Self::Lower(LowerError::Demand(message)) => {
                Diagnostic::error("wrong-demand", span, message.clone())
            }
            Self::Lower(LowerError::Link(error)) => Diagnostic::error(
                "internal-link",
                span,
                format!("the shader library could not be linked: {error:?}"),
            )
            .with_hint("this is a mistake in pullback; please report the formula"),
            Self::Invalid(message) => Diagnostic::error(
                "internal-invalid",
                span,
                format!("the generated shader is not valid: {message}"),
            )
            .with_hint("this is a mistake in pullback; please report the formula"),
        }
    }
}

/// Validates a finished module.
pub(crate) fn validate(module: &Module, precision: Precision) -> Result<ModuleInfo, ModuleError> {
    let capabilities = match precision.format() {
        Format::Single | Format::Pair => Capabilities::default(),
        Format::Double => {
            Capabilities::default() | Capabilities::FLOAT64 | Capabilities::SHADER_INT64
        }
    };
    Validator::new(ValidationFlags::all(), capabilities)
        .validate(module)
        .map_err(|error| {
            use std::error::Error as _;
            let mut message = error.as_inner().to_string();
            let mut source = error.as_inner().source();
            while let Some(cause) = source {
                message.push_str(": ");
                message.push_str(&cause.to_string());
                source = cause.source();
            }
            ModuleError::Invalid(message)
        })
}
