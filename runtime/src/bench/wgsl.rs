//! Texts in WGSL as modules, with functions of a formula in the place of stubs.

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Function, Module};
use pullback_compiler::SceneModule;
use pullback_compiler::formula::Formula;
use pullback_compiler::link::{Linker, Provider};
use pullback_compiler::lower::{LowerError, Tier};

use crate::Error;

/// The module of a text.
///
/// # Errors
/// It is no WGSL.
pub fn parsed(text: &str) -> Result<Module, Error> {
    naga::front::wgsl::parse_str(text).map_err(|error| invalid(error.emit_to_string(text)))
}

/// What is known of a module after it was checked.
///
/// # Errors
/// It is no valid one.
pub fn validated(module: &Module) -> Result<ModuleInfo, Error> {
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(module)
        .map_err(|error| invalid(format!("{error:?}")))
}

/// The module of a text with a function `shade` of the pixel, whose stubs are functions of a formula; it writes the first
/// component of each pixel as the number that it is.
pub(super) fn numbers_of_pixels(
    text: &str,
    formula: &Formula,
    tier: Tier,
) -> Result<(Module, ModuleInfo), Error> {
    let spliced = SceneModule::splice(&parsed(text)?, formula, tier)
        .map_err(|problem| invalid(format!("{problem:?}")))?;
    let image = parsed(include_str!("image.wgsl"))?;
    let mut linker = Linker::new(vec![&image, &spliced]);
    linker
        .link_entry_points(0, &mut Nothing)
        .map_err(|problem| invalid(format!("{problem:?}")))?;
    let mut module = linker.out;
    naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
    let info = validated(&module)?;
    Ok((module, info))
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

fn invalid(reason: String) -> Error {
    Error::Invalid { reason }
}
