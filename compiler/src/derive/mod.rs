//! Exact derivatives as IR: forward mode, reverse mode, and the complex jet; and bounds of them in a box.

mod activity;
mod extend;
mod forward;
mod gradient;
mod jet;
mod majorant;
mod reverse;
mod rules;
#[cfg(test)]
mod tests;

pub use forward::forward;
pub use gradient::{Gradient, gradient};
pub use jet::{ComplexVariable, Jet, jet};
pub use majorant::{Majorant, majorant};
pub use reverse::reverse;

use crate::ir::Prim;

/// An operation on the way has no derivative rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoDerivative {
    /// The operation.
    pub prim: Prim,
}
