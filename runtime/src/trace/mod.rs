//! What a shader computes on the way to a pixel, value by value, on any machine that runs it.
//!
//! [`Traced`] is a copy of a shader that tells its values; it is run for one pixel ([`Inputs::pixel`]) or one row of
//! numbers ([`Inputs::row`]), on a device by a [`GpuTracer`], on the processor by [`pixel_on_cpu`] and [`row_on_cpu`]. As every
//! machine runs the same copy, their values stand side by side by construction, and [`parting()`] finds the first place where they part.

mod copies;
mod cpu;
mod fault;
mod gpu;
mod inputs;
mod instrument;
mod operands;
mod parting;
mod relevance;
mod scan;
mod site;
mod text;

pub use cpu::{pixel_on_cpu, row_on_cpu};
pub use fault::{Fault, first_fault};
pub use gpu::GpuTracer;
pub use inputs::{Access, Buffer, Inputs};
pub use instrument::{Detail, Recorders, Traced};
pub use parting::{Parting, Row, distance, parting, rows};
pub use scan::{Oddities, scan};
pub use site::{Event, Operand, Shape, Site, Trace, Value, What};

use pullback_compiler::module::DEMANDS;
use pullback_compiler::{EvalModule, Picture, SceneModule};

use crate::Error;
use copies::copies;

/// Drivers copy a function to where it is called; one of which there would be more copies than this does not tell what it
/// does, which would take too long to compile.
const MAX_COPIES: u64 = 2;

/// A scene that tells everything that has a name in its template, and every operation of the formula.
/// What the libraries of drawing and of numbers do by themselves is not told, nor small functions that are called from many
/// places. `source` is the user's text.
///
/// # Errors
/// [`Error::Invalid`] if the module is not valid.
pub fn traced_scene(
    picture: &Picture,
    scene: &SceneModule,
    source: &str,
    recorders: Recorders,
) -> Result<Traced, Error> {
    let template = picture.scene.module();
    let own = |name: &str| {
        let mut functions = template
            .functions
            .iter()
            .filter(|(_, f)| f.name.as_deref() == Some(name));
        functions.any(|(_, f)| !pullback_compiler::link::is_stub(f))
    };
    let copies = copies(&scene.module);
    Traced::new(&scene.module, recorders, scene.tier, source, |name| {
        if DEMANDS.contains(&name) {
            Detail::Operations
        } else if copies.get(name).is_some_and(|&n| n > MAX_COPIES) {
            Detail::Nothing
        } else if own(name) {
            Detail::Names
        } else {
            Detail::Nothing
        }
    })
}

/// An evaluation that tells every operation of the formula. `source` is the user's text.
///
/// # Errors
/// [`Error::Invalid`] if the module is not valid.
pub fn traced_evaluation(
    module: &EvalModule,
    source: &str,
    recorders: Recorders,
) -> Result<Traced, Error> {
    let mut traced = Traced::new(
        &module.module,
        recorders,
        module.tier,
        source,
        |name| match name {
            "evaluate" => Detail::Operations,
            _ => Detail::Nothing,
        },
    )?;
    for site in &mut traced.sites {
        let column = site
            .name
            .strip_prefix('[')
            .and_then(|n| n.strip_suffix(']'));
        let column = column.and_then(|n| n.parse::<usize>().ok());
        if let (What::Result, Some(k)) = (site.what, column)
            && let Some(name) = module.outputs.get(k)
        {
            site.name.clone_from(name);
        }
    }
    Ok(traced)
}
