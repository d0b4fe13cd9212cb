//! What a pixel of a picture costs in instructions, ours and the twin's, counted by the executor.

use std::collections::BTreeMap;

use naga::Module;
use naga::valid::ModuleInfo;
use pullback_compiler::lower::{Format, Precision};
use pullback_compiler::scene::setting_component;
use pullback_runtime::executor::{
    Arithmetic, Component, Contraction, Kind, Limits, Machine, Options, Program, Start, WARP,
    Watched,
};
use pullback_runtime::{Error, Size};

use super::Twin;
use crate::stills::Still;

/// Side of a workgroup.
const SIDE: u32 = 8;
/// Every so many workgroups in a row, and in a column, one is counted.
const APART: u32 = 7;

/// Issue slots a pixel, by function and kind.
#[derive(Clone, Debug, Default)]
pub struct Count {
    /// Of each function and kind.
    pub charges: BTreeMap<(String, Kind), f64>,
}

impl Count {
    /// All of a kind.
    #[must_use]
    pub fn of(&self, kind: Kind) -> f64 {
        let of_kind = self.charges.iter().filter(|((_, k), _)| *k == kind);
        of_kind.map(|(_, slots)| slots).sum()
    }

    /// All that is computed for every pixel.
    #[must_use]
    pub fn total(&self) -> f64 {
        let kinds = Kind::ALL.into_iter().filter(|&kind| kind != Kind::Uniform);
        kinds.map(|kind| self.of(kind)).sum()
    }

    /// Functions with what they cost by themselves, the dearest first.
    #[must_use]
    pub fn functions(&self) -> Vec<(String, f64)> {
        let mut all: BTreeMap<&str, f64> = BTreeMap::new();
        for ((name, kind), slots) in &self.charges {
            if *kind != Kind::Uniform {
                *all.entry(name).or_default() += slots;
            }
        }
        let mut all: Vec<_> = all.into_iter().map(|(n, s)| (n.to_owned(), s)).collect();
        all.sort_by(|a, b| b.1.total_cmp(&a.1));
        all
    }
}

/// What pixels of our picture cost in a precision, and of the twin's; `general`: by the shader that reads its settings.
///
/// # Errors
/// The executor's.
pub fn count(
    twin: &Twin,
    size: Size,
    precision: Precision,
    general: bool,
) -> Result<[Count; 2], Error> {
    let still = twin.still(size, precision);
    let scene = still.shader(general);
    let (module, info) = twin.module()?;
    Ok([
        counted(&scene.module, &scene.info, &still)?,
        counted(&module, &info, &still)?,
    ])
}

fn counted(module: &Module, info: &ModuleInfo, still: &Still) -> Result<Count, Error> {
    let options = Options {
        arithmetic: Arithmetic::Ieee32,
        contraction: Contraction::None,
        format: Format::Single,
        watched: Watched::Nothing,
    };
    let program = Program::new(module, info, Start::EntryPoint("compute_main"), options)?;
    let mut machine = Machine::new(&program);
    for component in &program.inputs {
        let value = input(component, still);
        machine.set_uniform(component, component.encode(value));
    }
    let Size { width, height } = still.size;
    for name in ["image", "wide", "mesh"] {
        if let Some(buffer) = program.buffer(name).and_then(|k| machine.buffer(k)) {
            buffer.resize(width as usize * height as usize, 0);
        }
    }
    machine.count_issued();
    let mut warps = 0;
    for y in (0..height).step_by((SIDE * APART) as usize) {
        for x in (0..width).step_by((SIDE * APART) as usize) {
            for (k, lane) in (0..SIDE * SIDE).zip(0..) {
                machine.set_argument(0, lane, (x + k % SIDE).into());
                machine.set_argument(1, lane, (y + k / SIDE).into());
            }
            machine.run(Machine::LANES, Limits::default())?;
            warps += Machine::LANES / WARP;
        }
    }
    let mut count = Count::default();
    if let Some(issued) = machine.issued() {
        for charge in program.charges(issued) {
            let slots = charge.slots as f64 / warps as f64;
            count.charges.insert((charge.function, charge.kind), slots);
        }
    }
    Ok(count)
}

fn input(component: &Component, still: &Still) -> f64 {
    let k = component.index;
    if let Some(path) = component.path.strip_prefix("settings.") {
        let name = path.rsplit('.').next().unwrap_or(path);
        return setting_component(&still.settings, name, k).unwrap_or(0.0);
    }
    let size = [still.size.width, still.size.height].map(f64::from);
    let at = |values: &[f64]| values.get(k).copied().unwrap_or(0.0);
    match component.path.as_str() {
        "view.center" => at(&still.view.center),
        "view.size" | "view.tile_size" => at(&size),
        "view.pixel" => still.view.height / size[1],
        "view.samples" => 1.0,
        "params" => at(&still.params),
        _ => 0.0,
    }
}
