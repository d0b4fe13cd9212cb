//! A trace on the processor: the executor shows every call of a recorder.

use pullback_compiler::{EvalModule, SceneModule, SettingValue};

use super::inputs::check;
use super::site::{Event, Site, Trace};
use super::{Recorders, Traced};
use crate::evaluate::Surroundings;
use crate::executor::{self, Arithmetic, Observer, Painter, Rows, Shown, Watched};
use crate::{Error, Frame};

/// Events that are kept.
const MOST: usize = 1 << 20;

/// What a scene computes on the way to the middle of a pixel. `traced` is the scene with [silent](Recorders::Silent)
/// recorders.
///
/// # Errors
/// [`Error::Executor`], and [`Error::Invalid`] for a frame outside of the limits or a pixel outside of it.
pub fn pixel_on_cpu(
    arithmetic: Arithmetic,
    scene: &SceneModule,
    traced: &Traced,
    frame: &Frame,
    settings: &[SettingValue],
    pixel: [u32; 2],
) -> Result<Trace, Error> {
    check(frame, pixel)?;
    let mut scene = scene.clone();
    (scene.module, scene.info) = (traced.module.clone(), traced.info.clone());
    let middle = pixel.map(|k| f64::from(k) + 0.5);
    let mut log = Log::new(traced);
    let recorders = Watched::Entries(Recorders::is_name);
    Painter::watched(&scene, arithmetic, recorders)?.trace(frame, settings, &[middle], &mut log)?;
    Ok(log.trace)
}

/// What an evaluation computes of a row. `traced` is the module with [silent](Recorders::Silent) recorders.
///
/// # Errors
/// [`Error::Executor`], and [`Error::Invalid`] if the row has not as many numbers as the module has inputs.
pub fn row_on_cpu(
    arithmetic: Arithmetic,
    module: &EvalModule,
    traced: &Traced,
    around: Surroundings,
    row: &[f64],
) -> Result<Trace, Error> {
    let mut module = module.clone();
    (module.module, module.info) = (traced.module.clone(), traced.info.clone());
    let mut log = Log::new(traced);
    let recorders = Watched::Entries(Recorders::is_name);
    Rows::watched(&module, arithmetic, recorders)?.trace(around, row, &mut log)?;
    Ok(log.trace)
}

/// Keeps what recorders are called with.
struct Log<'t> {
    sites: &'t [Site],
    trace: Trace,
}

impl<'t> Log<'t> {
    fn new(traced: &'t Traced) -> Self {
        Self {
            sites: &traced.sites,
            trace: Trace::default(),
        }
    }
}

impl Observer for Log<'_> {
    fn event(&mut self, _: usize, event: &executor::Event) {
        let Some((Shown::Integer(index), values)) = event.values.split_first() else {
            return;
        };
        let index = usize::try_from(*index).unwrap_or(usize::MAX);
        let Some(site) = self.sites.get(index) else {
            return;
        };
        if self.trace.events.len() >= MOST {
            self.trace.is_cut = true;
            return;
        }
        let number = |shown: &Shown| match *shown {
            Shown::Real(x) => x,
            Shown::Integer(n) => n as f64,
            Shown::Truth(t) => f64::from(u8::from(t)),
        };
        let numbers: Vec<f64> = values.iter().take(4).map(number).collect();
        self.trace.events.push(Event {
            site: index,
            value: site.shape.value(&numbers),
        });
    }
}
