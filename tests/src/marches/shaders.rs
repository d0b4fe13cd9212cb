//! The three shaders of a density: they differ in nothing but how the integral along a ray is found.

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Function, Module};
use pullback_compiler::SceneModule;
use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::gauss_legendre;
use pullback_compiler::link::{Linker, Provider};
use pullback_compiler::lower::{LowerError, Precision};

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
            Self::Closed => (include_str!("../../marches/closed.wgsl"), 0),
            Self::March(steps) => (include_str!("../../marches/march.wgsl"), steps),
            Self::Gauss(order) => (include_str!("../../marches/gauss.wgsl"), order),
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

/// Leaves everything to the modules that are joined.
struct Nothing;

impl Provider for Nothing {
    fn provide(
        &mut self,
        _: &str,
        _: &Function,
        _: &mut Linker,
    ) -> Result<Option<Function>, LowerError> {
        Ok(None)
    }
}

/// The module that writes the integrals of every `stride`-th pixel's ray.
///
/// # Panics
/// The formula is no density, or a text no valid WGSL.
#[must_use]
pub fn module(formula: &Formula, method: Method, stride: u32) -> (Module, ModuleInfo) {
    let (integral, order) = method.text();
    let text = format!(
        "const STRIDE: f32 = {stride}.0;\nconst ORDER: u32 = {order}u;\n{}{integral}",
        include_str!("../../marches/rays.wgsl")
    );
    let parse = |text: &str| {
        naga::front::wgsl::parse_str(text)
            .unwrap_or_else(|error| panic!("{}", error.emit_to_string(text)))
    };
    let spliced = SceneModule::splice(&parse(&text), formula, Precision::Accurate.into())
        .unwrap_or_else(|error| panic!("{method:?}: {error:?}"));
    let image = parse(include_str!("../../marches/image.wgsl"));
    let mut linker = Linker::new(vec![&image, &spliced]);
    linker
        .link_entry_points(0, &mut Nothing)
        .unwrap_or_else(|error| panic!("{method:?}: {error:?}"));
    let mut module = linker.out;
    naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{method:?}: {error:?}"));
    (module, info)
}
