//! From a compiled module to a shader on a device.

use std::borrow::Cow;

use naga::Module;
use naga::valid::ModuleInfo;
use pullback_compiler::lower::Tier;

use crate::{Error, Gpu, decorate};

/// Hands a validated module to the device, its arithmetic decorated where the tier's exact steps need that.
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
    gpu.guarded("loading the shader", || {
        gpu.device()
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("formula"),
                source: wgpu::ShaderSource::Naga(Cow::Owned(module.clone())),
            })
    })
}
