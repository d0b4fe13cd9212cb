//! The evaluators that the suites run, and the GPU for them.

pub use pullback_runtime::accuracy::evaluators::{Machine, Point};
use pullback_runtime::{AdapterChoice, Gpu};

/// The GPU that the suites run on: the one that `PULLBACK_ADAPTER` names, else the reference adapter, lavapipe,
/// else the best. `None` where there is none and `PULLBACK_ALLOW_NO_GPU` is 1, which is printed.
///
/// # Panics
/// There is no adapter and none may be missing.
#[must_use]
pub fn suite_gpu() -> Option<Gpu> {
    let opened = match std::env::var("PULLBACK_ADAPTER") {
        Ok(name) => Gpu::open(&name.parse().unwrap_or_default()),
        Err(_) => Gpu::open(&AdapterChoice::Software).or_else(|_| Gpu::open(&AdapterChoice::Auto)),
    };
    match opened {
        Ok(gpu) => {
            println!("adapter: {}", gpu.adapter());
            Some(gpu)
        }
        Err(error) if std::env::var("PULLBACK_ALLOW_NO_GPU").as_deref() == Ok("1") => {
            println!("SKIPPED: nothing was tested on a GPU: {error}");
            None
        }
        Err(error) => panic!("{error}; set PULLBACK_ALLOW_NO_GPU=1 to do without a GPU"),
    }
}

/// Whether bounds are held to be tight on this adapter.
#[must_use]
pub fn is_reference_adapter(gpu: &Gpu) -> bool {
    gpu.adapter().name.contains("llvmpipe")
}
