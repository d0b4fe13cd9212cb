//! Looking for pixels at which a formula's value is NaN or infinite, on a device or on the processor.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::available_parallelism;

use pullback_compiler::module::DEMANDS;
use pullback_compiler::{SceneModule, SettingValue};

use super::instrument::Detail;
use super::recorders::Entry;
use super::{Recorders, Traced};
use crate::executor::{self, Arithmetic, Machine, Observer, Painter, Shown, Watched};
use crate::pool::spread;
use crate::{Error, Frame, Gpu, Pipeline, Renderer, RowSink, Size};

const SCAN: &str = include_str!("scan.wgsl");
const NAN: u8 = 1;
const INFINITE: u8 = 2;

/// Where in a picture the formula, or a derivative that its scene asks for, gave something else than a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Oddities {
    /// Of the picture.
    pub size: Size,
    flags: Vec<u8>,
}

impl Oddities {
    /// Pixels at which something was NaN, rows from top to bottom.
    pub fn nans(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.places(NAN)
    }

    /// Pixels at which something was infinite, and nothing was NaN.
    pub fn infinities(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.places(INFINITE)
    }

    fn places(&self, wanted: u8) -> impl Iterator<Item = [u32; 2]> + '_ {
        let width = self.size.width.max(1) as usize;
        let kind = |flags: u8| {
            if flags & NAN == 0 {
                flags & INFINITE
            } else {
                NAN
            }
        };
        let found = self.flags.iter().enumerate();
        let found = found.filter(move |&(_, &flags)| kind(flags) == wanted);
        found.map(move |(at, _)| [(at % width) as u32, (at / width) as u32])
    }
}

/// Computes a picture at the middle of each pixel, and looks at every value of the formula on the way.
///
/// # Errors
/// As [`Renderer::render`].
pub fn scan(
    gpu: &Gpu,
    scene: &SceneModule,
    frame: &Frame,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Oddities, Error> {
    let traced = Traced::with_recorders(
        &scene.module,
        (SCAN, Entry::Recorders),
        scene.tier,
        "",
        results,
    )?;
    let mut scene = scene.clone();
    (scene.module, scene.info) = (traced.module, traced.info);
    let frame = Frame {
        samples: 1,
        pipeline: Pipeline::Compute,
        ..frame.clone()
    };
    let mut sink = Flags {
        flags: Vec::new(),
        progress,
    };
    Renderer::new(gpu, &scene)?.render(&frame, &mut sink)?;
    Ok(Oddities {
        size: frame.size,
        flags: sink.flags,
    })
}

/// [`scan`] on the processor, on all cores; `settings` are those that the scene is drawn with.
///
/// # Errors
/// [`Error::Executor`], and [`Error::Invalid`] for a frame outside of the limits.
pub fn scan_on_cpu(
    arithmetic: Arithmetic,
    scene: &SceneModule,
    frame: &Frame,
    settings: &[SettingValue],
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Oddities, Error> {
    frame.check()?;
    let traced = Traced::new(&scene.module, Recorders::Silent, scene.tier, "", results)?;
    let mut scene = scene.clone();
    (scene.module, scene.info) = (traced.module, traced.info);
    let recorders = Watched::Entries(Recorders::is_name);
    let painter = Painter::watched(&scene, arithmetic, recorders)?;
    let rows: Vec<u32> = (0..frame.size.height).collect();
    let failed = AtomicBool::new(false);
    let look = |(): &mut (), &row: &u32| {
        if failed.load(Ordering::Relaxed) {
            return Ok(None);
        }
        let seen = row_on_cpu(&painter, frame, settings, row);
        failed.fetch_or(seen.is_err(), Ordering::Relaxed);
        seen.map(Some)
    };
    let cores = available_parallelism().map_or(1, usize::from);
    let mut done = 0;
    let seen = spread(vec![(); cores.min(rows.len())], &rows, look, || {
        done += 1;
        progress(done, rows.len() as u64);
    });
    let mut flags = Vec::new();
    for row in seen {
        let lost = || executor::Fault::unsupported("a picture of this kind");
        flags.extend(row.ok_or_else(lost)??.unwrap_or_default());
    }
    Ok(Oddities {
        size: frame.size,
        flags,
    })
}

/// Flags of the pixels of a row.
fn row_on_cpu(
    painter: &Painter,
    frame: &Frame,
    settings: &[SettingValue],
    row: u32,
) -> Result<Vec<u8>, Error> {
    let middles: Vec<[f64; 2]> = (0..frame.size.width)
        .map(|x| [x, row].map(|k| f64::from(k) + 0.5))
        .collect();
    let mut flags = vec![0; middles.len()];
    let groups = middles.chunks(Machine::LANES);
    for (points, flags) in groups.zip(flags.chunks_mut(Machine::LANES)) {
        painter.trace(frame, settings, points, &mut Seen(flags))?;
    }
    Ok(flags)
}

/// Of the formula's functions, what they give.
fn results(name: &str) -> Detail {
    if DEMANDS.contains(&name) {
        Detail::Result
    } else {
        Detail::Nothing
    }
}

/// Flags by lane.
struct Seen<'a>(&'a mut [u8]);

impl Observer for Seen<'_> {
    fn event(&mut self, lane: usize, event: &executor::Event) {
        for value in event.values {
            if let (Shown::Real(x), Some(flags)) = (value, self.0.get_mut(lane))
                && !x.is_finite()
            {
                *flags |= if x.is_nan() { NAN } else { INFINITE };
            }
        }
    }
}

struct Flags<'a> {
    flags: Vec<u8>,
    progress: &'a mut dyn FnMut(u64, u64),
}

impl RowSink for Flags<'_> {
    fn rows(&mut self, rgba: &[u8]) -> io::Result<()> {
        let words = rgba.as_chunks::<4>().0.iter();
        self.flags.extend(words.map(|&[flags, ..]| flags));
        Ok(())
    }

    fn progress(&mut self, done: u64, total: u64) {
        (self.progress)(done, total);
    }
}
