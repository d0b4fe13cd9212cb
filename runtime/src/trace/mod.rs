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
mod parts;
mod recorders;
mod relevance;
mod scan;
mod site;
mod text;
mod traced;
mod watch;

pub use cpu::{pixel_on_cpu, row_on_cpu};
pub use fault::{Fault, first_fault};
pub use gpu::GpuTracer;
pub use inputs::{Access, Buffer, Inputs};
pub use instrument::Detail;
pub use parting::{Parting, Row, distance, parting, rows};
pub use recorders::Recorders;
pub use scan::{Oddities, scan, scan_on_cpu};
pub use site::{Event, Operand, Shape, Site, Trace, Value, What};
pub use traced::Traced;
pub use watch::{GpuWatcher, Kept, Numbers, watch_on_cpu};

use pullback_compiler::link::is_stub;
use pullback_compiler::module::DEMANDS;
use pullback_compiler::{EvalModule, Picture, SceneModule};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::Error;
use copies::{Standing, standings};

/// Copies of a small function in a shader, beyond which it does not tell what it does where room is limited.
const MAX_COPIES: u64 = 2;

/// A scene that tells everything that has a name in its template, and every operation of the formula. What the libraries of
/// drawing and of numbers do by themselves is not told. `source` is the user's text.
///
/// Drivers copy a function to where it is called, and some take minutes to compile a shader that tells at a thousand places.
/// With a `limit` on places, functions of the template that are called from many places, and then those that are deepest in
/// calls, do not tell what they do; the formula always does.
///
/// # Errors
/// [`Error::Invalid`] if the module is not valid.
pub fn traced_scene(
    picture: &Picture,
    scene: &SceneModule,
    source: &str,
    recorders: Recorders,
    limit: Option<u64>,
) -> Result<Traced, Error> {
    let template = picture.scene.module();
    let is_own = |name: &str| {
        let mut functions = template.functions.iter();
        functions.any(|(_, f)| f.name.as_deref() == Some(name) && !is_stub(f))
    };
    let detail = |name: &str| {
        if DEMANDS.contains(&name) {
            Detail::Operations
        } else if is_own(name) {
            Detail::Names
        } else {
            Detail::Nothing
        }
    };
    let all = Traced::new(&scene.module, recorders, scene.tier, source, detail)?;
    let Some(limit) = limit else {
        return Ok(all);
    };
    let quiet = quiet(&scene.module, &all.sites, limit);
    if quiet.is_empty() {
        return Ok(all);
    }
    Traced::new(&scene.module, recorders, scene.tier, source, |name| {
        if quiet.contains(name) {
            Detail::Nothing
        } else {
            detail(name)
        }
    })
}

/// The functions that must not tell, so that those that do tell at `limit` places at most.
fn quiet(module: &naga::Module, sites: &[Site], limit: u64) -> FxHashSet<String> {
    let mut places: FxHashMap<&str, u64> = FxHashMap::default();
    for site in sites {
        *places.entry(&site.function).or_default() += 1;
    }
    let standings = standings(module);
    let standing = |name: &str| {
        let nowhere = Standing {
            copies: 0,
            depth: 0,
        };
        standings.get(name).copied().unwrap_or(nowhere)
    };
    let mut order: Vec<(&str, u64)> = places.into_iter().collect();
    order.sort_by_key(|&(name, _)| (!DEMANDS.contains(&name), standing(name).depth, name));
    let mut used = 0u64;
    let mut quiet = FxHashSet::default();
    for (name, count) in order {
        let Standing { copies, .. } = standing(name);
        let cost = count.saturating_mul(copies);
        let is_formula = DEMANDS.contains(&name);
        if is_formula || copies <= MAX_COPIES && used.saturating_add(cost) <= limit {
            used = used.saturating_add(cost);
        } else {
            quiet.insert(name.to_owned());
        }
    }
    quiet
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
