//! Pictures of numbers: what a scene computes on the way to the middle of each pixel, on a device or on the processor.

use std::fmt::Write as _;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::available_parallelism;

use pullback_compiler::{SceneModule, SettingValue};

use super::instrument::Detail;
use super::recorders::Entry;
use super::{Recorders, Shape, Site, Traced, What};
use crate::executor::{self, Arithmetic, Machine, Observer, Painter, Shown, Watched, Window};
use crate::pool::spread;
use crate::{Error, Frame, Gpu, Pipeline, Renderer, Size};

const ENTRY: &str = include_str!("watch.wgsl");

/// What is kept of a scene, until it is complete; what comes after that is passed over.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    /// The function of the template or of the formula.
    pub function: &'static str,
    /// What is told of it.
    pub what: What,
    /// The name of the value or of the part of it, as a trace has it.
    pub name: &'static str,
    /// The first of the four numbers that it is put into; none is kept where that is 4.
    pub slot: usize,
    /// Whether all is complete with it.
    pub closes: bool,
}

/// Four numbers of each pixel; those that were not computed are 0.
pub type Numbers = Vec<[f64; 4]>;

/// Makes pictures of numbers on a device: settings may change from one to the next.
#[derive(Debug)]
pub struct GpuWatcher {
    renderer: Renderer,
}

impl GpuWatcher {
    /// Loads the scene, which must be for any settings, so that it tells what is to be kept.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the scene has nothing of that, and the device's.
    pub fn new(gpu: &Gpu, scene: &SceneModule, kept: &[Kept]) -> Result<Self, Error> {
        // sites have the same numbers whatever the recorders do
        let draft = instrumented(scene, &text(&[], kept), kept)?;
        expect_sites(&draft.sites, kept)?;
        let traced = instrumented(scene, &text(&draft.sites, kept), kept)?;
        let mut scene = scene.clone();
        (scene.module, scene.info) = (traced.module, traced.info);
        Ok(Self {
            renderer: Renderer::new(gpu, &scene)?,
        })
    }

    /// Rows of four `f32` a pixel, from top to bottom.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn rows(&mut self, frame: &Frame) -> Result<Vec<u8>, Error> {
        let frame = Frame {
            samples: 1,
            pipeline: Pipeline::Linear,
            ..frame.clone()
        };
        let mut rows = Vec::new();
        self.renderer.render(&frame, &mut rows)?;
        Ok(rows)
    }
}

/// The numbers of the pixels of parts of a picture, computed on the processor, until `cancel` is set.
///
/// # Errors
/// [`Error::Executor`], and [`Error::Invalid`] for a frame outside of the limits or a scene that has nothing of what is kept.
pub fn watch_on_cpu(
    arithmetic: Arithmetic,
    scene: &SceneModule,
    frame: &Frame,
    settings: &[SettingValue],
    kept: &[Kept],
    windows: &[Window],
    cancel: &AtomicBool,
) -> Result<Vec<Numbers>, Error> {
    frame.check()?;
    let traced = Traced::new(
        &scene.module,
        Recorders::Silent,
        scene.tier,
        "",
        detail(kept),
    )?;
    expect_sites(&traced.sites, kept)?;
    let keeps = keeps(&traced.sites, kept);
    let mut scene = scene.clone();
    (scene.module, scene.info) = (traced.module, traced.info);
    let recorders = Watched::Entries(Recorders::is_name);
    let painter = Painter::watched(&scene, arithmetic, recorders)?;
    let failed = AtomicBool::new(false);
    let work = |(): &mut (), window: &Window| {
        let stopped = || cancel.load(Ordering::Relaxed) || failed.load(Ordering::Relaxed);
        let found = window_on_cpu(&painter, frame, settings, &keeps, *window, &stopped);
        failed.fetch_or(found.is_err(), Ordering::Relaxed);
        found
    };
    let cores = available_parallelism().map_or(1, usize::from);
    let found = spread(vec![(); cores.min(windows.len())], windows, work, || ());
    let lost = || Error::from(executor::Fault::unsupported("a picture of this kind"));
    let mut fault = None;
    let mut out = Vec::new();
    for numbers in found {
        match numbers.ok_or_else(lost)? {
            Ok(Some(numbers)) => out.push(numbers),
            Ok(None) => fault = fault.or(Some(executor::Fault::Cancelled)),
            Err(error) => return Err(error),
        }
    }
    fault.map_or(Ok(out), |fault| Err(fault.into()))
}

/// Of one part; nothing where it is stopped on the way.
fn window_on_cpu(
    painter: &Painter,
    frame: &Frame,
    settings: &[SettingValue],
    keeps: &[Option<Keep>],
    window: Window,
    stopped: &dyn Fn() -> bool,
) -> Result<Option<Numbers>, Error> {
    let Size { width, height } = window.size;
    let places = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    let corner = [window.x, window.y];
    let middles: Vec<[f64; 2]> = places
        .map(|place| [0, 1].map(|k| f64::from(corner[k] + place[k]) + 0.5))
        .collect();
    let mut out = Vec::with_capacity(middles.len());
    for points in middles.chunks(Machine::LANES) {
        if stopped() {
            return Ok(None);
        }
        let mut keeper = Keeper {
            keeps,
            lanes: vec![([0.0; 4], false); points.len()],
        };
        painter.trace(frame, settings, points, &mut keeper)?;
        out.extend(keeper.lanes.iter().map(|(numbers, _)| *numbers));
    }
    Ok(Some(out))
}

/// What is kept at a site.
#[derive(Clone, Copy, Debug)]
struct Keep {
    slot: usize,
    count: usize,
    closes: bool,
}

/// By site.
fn keeps(sites: &[Site], kept: &[Kept]) -> Vec<Option<Keep>> {
    let of = |site: &Site| {
        kept.iter().find(|k| k.is(site)).map(|k| Keep {
            slot: k.slot,
            count: components(site.shape).min(4usize.saturating_sub(k.slot)),
            closes: k.closes,
        })
    };
    sites.iter().map(of).collect()
}

fn components(shape: Shape) -> usize {
    match shape {
        Shape::Single(count) => count.into(),
        _ => 1,
    }
}

impl Kept {
    fn is(&self, site: &Site) -> bool {
        self.function == site.function && self.what == site.what && self.name == site.name
    }
}

/// Keeps the numbers of each lane.
struct Keeper<'k> {
    keeps: &'k [Option<Keep>],
    lanes: Vec<([f64; 4], bool)>,
}

impl Observer for Keeper<'_> {
    fn event(&mut self, lane: usize, event: &executor::Event) {
        let Some((Shown::Integer(site), values)) = event.values.split_first() else {
            return;
        };
        let keep = usize::try_from(*site).ok().and_then(|k| self.keeps.get(k));
        let (Some(Some(keep)), Some((numbers, closed))) = (keep, self.lanes.get_mut(lane)) else {
            return;
        };
        if *closed {
            return;
        }
        let slots = numbers.iter_mut().skip(keep.slot).take(keep.count);
        for (number, shown) in slots.zip(values) {
            *number = match *shown {
                Shown::Real(x) => x,
                Shown::Integer(n) => n as f64,
                Shown::Truth(t) => f64::from(u8::from(t)),
            };
        }
        *closed = keep.closes;
    }
}

/// What functions tell of themselves so that this can be kept.
fn detail(kept: &[Kept]) -> impl Fn(&str) -> Detail + '_ {
    |name| {
        let of_it = || kept.iter().filter(|k| k.function == name);
        if of_it().next().is_none() {
            Detail::Nothing
        } else if of_it().all(|k| k.what == What::Result) {
            Detail::Result
        } else {
            Detail::Names
        }
    }
}

fn instrumented(scene: &SceneModule, text: &str, kept: &[Kept]) -> Result<Traced, Error> {
    let entry = (text, Entry::Recorders);
    Traced::with_recorders(&scene.module, entry, scene.tier, "", detail(kept))
}

fn expect_sites(sites: &[Site], kept: &[Kept]) -> Result<(), Error> {
    let missing = kept.iter().find(|k| !sites.iter().any(|site| k.is(site)));
    missing.map_or(Ok(()), |k| {
        let reason = format!("the scene does not tell {} of {}", k.name, k.function);
        Err(Error::Invalid { reason })
    })
}

/// The entry point, and recorders that keep what is wanted at these sites.
fn text(sites: &[Site], kept: &[Kept]) -> String {
    let mut text = ENTRY.to_owned();
    let keeps = keeps(sites, kept);
    for (shape, ty) in [
        (Shape::Single(1), "f32"),
        (Shape::Single(2), "vec2f"),
        (Shape::Single(3), "vec3f"),
        (Shape::Single(4), "vec4f"),
        (Shape::Word, "u32"),
        (Shape::Integer, "i32"),
        (Shape::Truth, "bool"),
    ] {
        let of_shape = (0..).zip(sites).zip(&keeps);
        let of_shape = of_shape.filter(|((_, site), _)| site.shape == shape);
        let cases = of_shape.filter_map(|((k, _), keep)| keep.map(|keep| (k, keep)));
        recorder(&mut text, shape, ty, cases);
    }
    text
}

fn recorder(text: &mut String, shape: Shape, ty: &str, cases: impl Iterator<Item = (u32, Keep)>) {
    let name = shape.recorder();
    // writing to a string cannot fail
    let _ = writeln!(text, "fn {name}(site: u32, value: {ty}) {{");
    text.push_str("    if closed { return; }\n    switch site {\n");
    for (site, keep) in cases {
        let _ = write!(text, "        case {site}u: {{ ");
        for (from, to) in (0..keep.count).zip(keep.slot..) {
            let part = match shape {
                Shape::Single(1) => "value".to_owned(),
                Shape::Single(_) => format!("value.{}", ["x", "y", "z", "w"][from]),
                _ => "f32(value)".to_owned(),
            };
            let _ = write!(text, "numbers.{} = {part}; ", ["x", "y", "z", "w"][to]);
        }
        if keep.closes {
            text.push_str("closed = true; ");
        }
        text.push_str("}\n");
    }
    text.push_str("        default: {}\n    }\n}\n");
}
