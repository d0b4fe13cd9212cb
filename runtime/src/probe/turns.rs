//! How many turns loops may make.
//!
//! llvmpipe counts the turns of all loops of an invocation together and, when they are used up, lets every loop end
//! after its next turn, without an error (Mesa, `src/gallium/auxiliary/gallivm/lp_bld_ir_common.c`). What is computed
//! by such a loop is wrong, and a short loop at the end tells.

use std::sync::{Mutex, PoisonError};

use crate::capabilities::Key;
use crate::kernel::{Contraction, Kernel};
use crate::{Error, Gpu};

/// The text that is run.
pub(super) const TEXT: &str = include_str!("turns.wgsl");

/// Turns that are tried: about ten milliseconds on a GPU.
const TRIED: u32 = 1 << 20;

/// Findings of this process.
static KNOWN: Mutex<Vec<(Key, Option<u32>)>> = Mutex::new(Vec::new());

/// The number of turns after which the adapter ends all loops of an invocation without an error; none where 2²⁰ turns
/// are made. It is tried once in a process.
///
/// # Errors
/// The device's; and where loops end early, but later ones do not tell of it, so that no picture could be trusted.
pub(crate) fn limit(gpu: &Gpu) -> Result<Option<u32>, Error> {
    let key = Key::of(gpu);
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, limit)) = known().iter().find(|(other, _)| *other == key) {
        return Ok(*limit);
    }
    let limit = try_out(gpu)?;
    known().push((key, limit));
    Ok(limit)
}

fn try_out(gpu: &Gpu) -> Result<Option<u32>, Error> {
    let kernel = Kernel::new(gpu, TEXT, Contraction::Allowed)?;
    let job = kernel.job(1, [TRIED, 0], &[1], 2)?;
    match kernel.results(&job)?[..] {
        [TRIED, 2] => Ok(None),
        [turns, 1] if turns < TRIED => Ok(Some(turns)),
        ref made => Err(Error::Device {
            during: "probing loops",
            reason: format!("loops of {TRIED} and 2 turns made {made:?} turns"),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::AdapterChoice;

    #[test]
    fn mesas_software_adapter_ends_loops() {
        let Ok(gpu) = Gpu::open(&AdapterChoice::Software) else {
            return;
        };
        let found = limit(&gpu).unwrap();
        if gpu.adapter().driver.contains("Mesa 22") {
            assert!((65_000..66_000).contains(&found.unwrap()), "{found:?}");
        }
        assert_eq!(limit(&gpu).unwrap(), found);
    }
}
