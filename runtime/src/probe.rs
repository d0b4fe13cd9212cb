//! What an adapter does to arithmetic, found out by trying.

mod arithmetic;
mod format;
mod rows;
mod special;
mod steps;
pub(crate) mod turns;

use crate::capabilities::{Capabilities, Key, Offered};
use crate::decorate::can_decorate;
use crate::kernel::Contraction;
use crate::{Error, Gpu};

/// Every text that is run: another text is another probe, whose findings replace older ones.
pub(crate) const TEXTS: [&str; 5] = [
    include_str!("probe/arithmetic.wgsl"),
    include_str!("probe/steps.wgsl"),
    include_str!("probe/single.wgsl"),
    include_str!("probe/double.wgsl"),
    turns::TEXT,
];

/// Tries the arithmetic of a device: a handful of small dispatches.
///
/// # Errors
/// The device's.
pub fn capabilities(gpu: &Gpu) -> Result<Capabilities, Error> {
    let features = gpu.device().features();
    let offered = Offered {
        f64: features.contains(wgpu::Features::SHADER_F64),
        u64: features.contains(wgpu::Features::SHADER_INT64),
        decorations: can_decorate(gpu),
    };
    let (free, strict) = (Contraction::Allowed, Contraction::Forbidden);
    let doubles = offered.f64 && offered.u64;
    Ok(Capabilities {
        adapter: Key::of(gpu),
        single: arithmetic::try_out::<f32>(gpu, free)?,
        double: doubles
            .then(|| arithmetic::try_out::<f64>(gpu, free))
            .transpose()?,
        // A driver that chokes on decorated words has none that are of use; the others need not suffer.
        single_decorated: offered
            .decorations
            .then(|| arithmetic::try_out::<f32>(gpu, strict).ok())
            .flatten(),
        double_decorated: (offered.decorations && doubles)
            .then(|| arithmetic::try_out::<f64>(gpu, strict).ok())
            .flatten(),
        forms: steps::try_out(gpu, offered.decorations)?,
        turns: turns::limit(gpu)?,
        offered,
    })
}
