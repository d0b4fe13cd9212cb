//! The thin wgpu layer of pullback: devices, pictures in tiles, evaluation in batches, and image files.
//!
//! The compiler hands over validated shader modules; this crate runs them. Nothing here prints or exits, no
//! function panics on any input or on a failing device, and every failure is an [`Error`].

// A library neither prints nor gives up; tests may.
#![cfg_attr(
    not(test),
    warn(
        clippy::expect_used,
        clippy::panic,
        clippy::print_stderr,
        clippy::print_stdout,
        clippy::unreachable,
        clippy::unwrap_used
    )
)]

pub mod accuracy;
pub mod animation;
pub mod atomic_file;
pub mod auto;
pub mod bench;
pub mod capabilities;
pub mod decorate;
pub mod device;
pub mod difference;
pub mod error;
pub mod evaluate;
pub mod executor;
pub mod image_file;
pub mod kernel;
pub mod measure;
pub mod mesh;
pub mod probe;
pub mod render;
pub mod rows;
pub mod shader;
pub mod trace;
pub mod validators;

mod buffers;
mod clock;
mod pool;
mod scale;
mod tiles;
mod uniforms;

pub use atomic_file::AtomicFile;
pub use capabilities::Capabilities;
pub use device::{AdapterChoice, AdapterSummary, Gpu};
pub use error::Error;
pub use evaluate::GpuEvaluator;
pub use image_file::Metadata;
pub use pool::STACK;
pub use render::{Frame, Pipeline, Renderer, RowSink, Size, View};
pub use scale::fill_in_scale;
