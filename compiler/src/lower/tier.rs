//! What a shader's numbers are computed with.

use super::{Exactness, Precision};

/// A precision, and by what means its rounding errors are found exactly. Every precision makes a tier by the means that
/// are exact everywhere; who loads the shader may know that its adapter has faster ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Tier {
    /// The precision.
    pub precision: Precision,
    /// The form of the exact steps; only [`Precision::Extended`] has several.
    pub exactness: Exactness,
    /// Whether the adapter's `fma` is a product and a sum, each rounded, so that places on rays are made of exact steps; only
    /// [`Precision::Accurate`] asks.
    pub splits_fma: bool,
}

impl Tier {
    /// Whether a module of the tier is right only when its SPIR-V is decorated with NoContraction before it is loaded.
    #[must_use]
    pub fn is_decorated(self) -> bool {
        self.precision == Precision::Extended && self.exactness.is_decorated()
    }
}

impl From<Precision> for Tier {
    fn from(precision: Precision) -> Self {
        Self {
            precision,
            exactness: Exactness::default(),
            splits_fma: false,
        }
    }
}
