//! The three shaders of a density: they differ in nothing but how the integral along a ray is found.

use naga::Module;
use naga::valid::ModuleInfo;
use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::gauss_legendre;
use pullback_compiler::lower::Precision;

use crate::bench::wgsl::numbers_of_pixels;
use crate::capabilities::Capabilities;
use crate::{Error, Gpu};

/// How an integral is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The closed form of the compiler.
    Closed,
    /// Midpoints of this many steps.
    March(u32),
    /// This many nodes of Gauss and Legendre on the whole interval: an even number to 64.
    Gauss(u32),
}

impl Method {
    fn text(self) -> (&'static str, u32) {
        match self {
            Self::Closed => (include_str!("closed.wgsl"), 0),
            Self::March(steps) => (include_str!("march.wgsl"), steps),
            Self::Gauss(order) => (include_str!("gauss.wgsl"), order),
        }
    }

    /// Parameters of the shader: the nodes, place and weight.
    #[must_use]
    pub fn params(self) -> Vec<f64> {
        match self {
            Self::Gauss(order) => gauss_legendre(order as usize)
                .iter()
                .flat_map(|node| [node.place, node.weight])
                .collect(),
            Self::Closed | Self::March(_) => Vec::new(),
        }
    }
}

/// The module that writes the integrals of every `stride`-th pixel's ray.
///
/// # Errors
/// The formula is no density.
pub fn module(
    gpu: &Gpu,
    formula: &Formula,
    method: Method,
    stride: f64,
) -> Result<(Module, ModuleInfo), Error> {
    let (integral, order) = method.text();
    let text = format!(
        "const STRIDE: f32 = {stride:?};\nconst ORDER: u32 = {order}u;\n{}{integral}",
        include_str!("rays.wgsl")
    );
    numbers_of_pixels(
        &text,
        formula,
        Capabilities::tier(gpu, Precision::Accurate)?,
    )
}
