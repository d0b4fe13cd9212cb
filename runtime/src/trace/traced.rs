//! Shaders that tell their values.

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Function, Handle, Module};
use pullback_compiler::lower::Tier;

use super::instrument::{Detail, Instrument, Scope};
use super::recorders::{Entry, Recorders, broken, joined};
use super::site::Site;
use crate::Error;

/// A shader that tells its values, by calls of recorders.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The shader, valid.
    pub module: Module,
    /// What validation found out about it.
    pub info: ModuleInfo,
    /// Where it tells something.
    pub sites: Vec<Site>,
}

impl Traced {
    /// Makes a copy of a valid shader that tells its values: of each function as much as `detail` says of its name. The
    /// tier is that of the generated functions, and `source` the text that they were generated from.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the module or what became of it is not valid.
    pub fn new(
        module: &Module,
        recorders: Recorders,
        tier: Tier,
        source: &str,
        detail: impl Fn(&str) -> Detail,
    ) -> Result<Self, Error> {
        let text = recorders.text(tier);
        Self::with_recorders(module, (&text, Entry::Module), tier, source, detail)
    }

    /// [`Self::new`] with other recorders, in WGSL; kinds of numbers that have none are not told.
    pub(super) fn with_recorders(
        module: &Module,
        (text, entry): (&str, Entry),
        tier: Tier,
        source: &str,
        detail: impl Fn(&str) -> Detail,
    ) -> Result<Self, Error> {
        let (mut module, recorders) = joined(module, text, entry, tier)?;
        let info = validate(&module)?;
        let mut sites = Vec::new();
        let handles: Vec<Handle<Function>> = module.functions.iter().map(|(h, _)| h).collect();
        for handle in handles {
            let name = module.functions[handle].name.clone().unwrap_or_default();
            let detail = detail(&name);
            if detail == Detail::Nothing {
                continue;
            }
            let instrumented = Instrument::new(
                &module,
                &module.functions[handle],
                &info[handle],
                Scope {
                    detail,
                    format: tier.precision.format(),
                    source,
                    recorders: &recorders,
                },
                &mut sites,
            )
            .run();
            module.functions[handle] = instrumented;
        }
        let info = validate(&module)?;
        Ok(Self {
            module,
            info,
            sites,
        })
    }
}

fn validate(module: &Module) -> Result<ModuleInfo, Error> {
    let wanted = Capabilities::default() | Capabilities::FLOAT64 | Capabilities::SHADER_INT64;
    Validator::new(ValidationFlags::all(), wanted)
        .validate(module)
        .map_err(|error| broken(&format!("{:?}", error.as_inner())))
}
