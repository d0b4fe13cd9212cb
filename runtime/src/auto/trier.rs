//! What tries the tiers: the adapter that is to draw, or the processor in its place.

use pullback_compiler::EvalModule;
use pullback_compiler::lower::{Precision, Tier};

use crate::evaluate::Surroundings;
use crate::executor::{Arithmetic, Rows};
use crate::{Capabilities, Error, Gpu, GpuEvaluator};

/// What the tiers are tried on.
#[derive(Clone, Copy, Debug)]
pub enum Trier<'a> {
    /// An adapter.
    Device(&'a Gpu),
    /// The processor, in exact single precision: it has all tiers.
    Exact,
}

impl<'a> From<&'a Gpu> for Trier<'a> {
    fn from(gpu: &'a Gpu) -> Self {
        Self::Device(gpu)
    }
}

impl Trier<'_> {
    pub(super) fn has(self, precision: Precision) -> bool {
        match self {
            Self::Device(gpu) => gpu.has(precision),
            Self::Exact => true,
        }
    }

    pub(super) fn tier(self, precision: Precision) -> Result<Tier, Error> {
        match self {
            Self::Device(gpu) => Capabilities::tier(gpu, precision),
            Self::Exact => Ok(precision.into()),
        }
    }

    pub(super) fn evaluator(self, module: &EvalModule) -> Result<Evaluating, Error> {
        Ok(match self {
            Self::Device(gpu) => Evaluating::Device(Box::new(GpuEvaluator::new(gpu, module)?)),
            Self::Exact => Evaluating::Exact(Box::new(Rows::new(module, Arithmetic::Ieee32)?)),
        })
    }
}

/// A formula that is evaluated in a tier.
pub(super) enum Evaluating {
    Device(Box<GpuEvaluator>),
    Exact(Box<Rows>),
}

impl Evaluating {
    pub(super) fn eval(
        &mut self,
        around: Surroundings,
        count: usize,
        rows: &[f64],
        values: &mut Vec<f64>,
    ) -> Result<(), Error> {
        match self {
            Self::Device(evaluator) => evaluator.eval_exactly(around, count, rows, values),
            Self::Exact(evaluator) => evaluator.eval(around, count, rows, values),
        }
    }
}
