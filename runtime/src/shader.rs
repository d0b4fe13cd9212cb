//! From a compiled module to a shader on a device.

use std::borrow::Cow;

use naga::Module;
use naga::valid::ModuleInfo;
use pullback_compiler::lower::Tier;
use wgpu::ShaderRuntimeChecks;

use crate::{Error, Gpu, decorate};

/// What the device checks while it runs a shader of ours: everything but whether its loops end. All of them do, because each
/// counts towards a bound (`--test loops`), and the counter of 64 bits that wgpu adds to every loop takes two registers and six
/// operations a turn: half of what a short step of a ray takes.
pub(crate) const CHECKS: ShaderRuntimeChecks = ShaderRuntimeChecks {
    force_loop_bounding: false,
    ..ShaderRuntimeChecks::checked()
};

/// Hands a validated module of ours, whose loops end, to the device, its arithmetic decorated where the tier's exact steps need that.
///
/// # Errors
/// The device's, and [`Error::Invalid`] where it takes no decorated modules.
pub fn load(
    gpu: &Gpu,
    module: &Module,
    info: &ModuleInfo,
    tier: Tier,
) -> Result<wgpu::ShaderModule, Error> {
    if tier.is_decorated() {
        return decorate::load(gpu, module, info);
    }
    plain(gpu, module.clone())
}

/// Hands a validated module of ours to the device as it is.
///
/// # Errors
/// The device's.
pub(crate) fn plain(gpu: &Gpu, module: Module) -> Result<wgpu::ShaderModule, Error> {
    gpu.guarded("loading the shader", || {
        // SAFETY: loops end, and everything else is checked.
        #[allow(unsafe_code)]
        unsafe {
            gpu.device()
                .create_shader_module_trusted(described(module), CHECKS)
        }
    })
}

/// Hands a validated module of anyone's to the device, with every check.
///
/// # Errors
/// The device's.
pub(crate) fn checked(gpu: &Gpu, module: Module) -> Result<wgpu::ShaderModule, Error> {
    gpu.guarded("loading a shader", || {
        gpu.device().create_shader_module(described(module))
    })
}

fn described(module: Module) -> wgpu::ShaderModuleDescriptor<'static> {
    wgpu::ShaderModuleDescriptor {
        label: Some("formula"),
        source: wgpu::ShaderSource::Naga(Cow::Owned(module)),
    }
}
