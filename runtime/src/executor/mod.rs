//! Running the modules that the compiler makes on the processor: the truth that pictures are measured against, a debugger,
//! and the renderer of last resort. Nothing here knows of a graphics device. See `docs/executor.md`.
//!
//! A module's function is translated once, to flat code for registers ([`Program`]); a [`Machine`] runs it for a group of
//! lanes at a time, with masks where lanes go different ways.

mod code;
mod cost;
mod fault;
mod float;
mod hash;
mod integer;
mod kernels;
mod lanes;
mod library;
mod lifetime;
mod machine;
mod painter;
mod program;
mod rows;
mod shape;
mod trace;
mod translate;

pub use cost::{Charge, Issued, Kind, WARP};
pub use fault::{Fault, LoopKind, LoopSite};
pub use machine::{Limits, MAX_FORMULA_TURNS, MAX_STEPS, MAX_TURNS, Machine};
pub use painter::{Painter, Window};
pub use program::{Buffer, Component, Contraction, Options, Program, Start, Watched};
pub use rows::Rows;
pub use trace::{Event, Observer, Shown, Site, SiteKind};

/// What numbers are computed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Arithmetic {
    /// `f64` throughout: every `f32` of the module is an `f64`, and the functions of the shader library that stand for
    /// operations of the operator table are those of the table.
    Reference,
    /// Exact IEEE 754 binary32 as the module is written: every operation rounded once, nothing fused, flushed or
    /// reassociated. What IEEE 754 does not define is computed in `f64` and rounded.
    Ieee32,
}

impl Arithmetic {
    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Reference => "reference",
            Self::Ieee32 => "ieee32",
        }
    }
}
