//! The true picture, in `f64` on the processor.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::thread::{self, available_parallelism};
use std::time::{Duration, Instant};

use pullback_compiler::SettingValue;
use pullback_compiler::lower::Precision;

use super::choice::best;
use super::judgement::{Judgement, Parts, judge};
use super::layout::{Layout, parts};
use super::{Job, Listener, frame};
use crate::Error;
use crate::executor::{Arithmetic, Painter, Window};
use crate::render::{MAX_SAMPLES, Pipeline, Size};

/// By how much more steps the truth has than the default, and the truth that it is held against.
const STEPS: [f64; 2] = [8.0, 4.0];
/// Parts at which the truth is held against one with less of everything.
const CHECKED: usize = 4;

/// How long that may take where the parts have taken all the time that there was.
const PATIENCE: Duration = Duration::from_secs(2);
/// Sides of parts, from the usual ones to one group of lanes.
const SIDES: [u32; 2] = [32, 16];
const SMALLEST: u32 = 8;
/// How many times as long as there is a first part may take before it is made smaller.
const HOPELESS: f64 = 4.0;
/// Seconds of a group below which it is tried with more samples.
const SHORT: f64 = 0.02;
/// Parts that are tried for how long they take.
const TRIED: usize = 3;
/// Parts that the truth should have, even if it then has fewer samples.
const WANTED: usize = 16;

/// What computes the truth, with as many samples as leave time for enough parts: twice as many along each axis as any
/// choice has, or at least one more.
/// The parts are smaller where even one of them with the least samples would take too long.
fn affordable(job: &Job, all: &mut [Window], deadline: Instant) -> Result<(Maker, u32), Error> {
    let most = job.choices.iter().map(|c| c.samples).max().unwrap_or(1);
    let [least, wanted] = [most + 1, 2 * most].map(|n| n.clamp(2, MAX_SAMPLES));
    let mut maker = Maker::new(job, STEPS[0], 1)?;
    let each = mean_pixel(job, &mut maker, all, deadline)?;
    let cores = available_parallelism().map_or(1, usize::from);
    let left = deadline
        .saturating_duration_since(Instant::now())
        .as_secs_f64();
    let shot = each * f64::from(least * least);
    let is_short = |side: &u32| shot * f64::from(side * side) <= HOPELESS * left;
    let side = SIDES.into_iter().find(is_short).unwrap_or(SMALLEST);
    for window in all.iter_mut() {
        *window = middle(*window, side);
    }
    let pixels: u32 = all
        .iter()
        .take(WANTED)
        .map(|w| w.size.width * w.size.height)
        .sum();
    let one = each * f64::from(pixels) / cores as f64;
    let fits = |n: &u32| one * f64::from(n * n) <= left;
    let enough = (least..=wanted.max(least)).rev().find(fits);
    // what takes minutes has a truth of few samples, which says how far off it is itself
    let group = each * f64::from(SMALLEST * SMALLEST);
    let some = (2..=least)
        .rev()
        .find(|n| group * f64::from(n * n) <= HOPELESS * left);
    let samples = enough.or(some).unwrap_or(2);
    maker.samples = samples;
    Ok((maker, samples))
}

/// Parts of the picture, and their pixels.
type Made = (Vec<Window>, Vec<Vec<[f32; 4]>>);

/// The middle of a part, of at most this side.
fn middle(part: Window, side: u32) -> Window {
    let Size { width, height } = part.size;
    let size = Size {
        width: width.min(side),
        height: height.min(side),
    };
    Window {
        x: part.x + (width - size.width) / 2,
        y: part.y + (height - size.height) / 2,
        size,
    }
}

/// Seconds of a pixel of one sample, the mean of one group of lanes each in the middle of the picture and of its first
/// parts, as some parts of a picture are empty.
fn mean_pixel(
    job: &Job,
    maker: &mut Maker,
    all: &[Window],
    deadline: Instant,
) -> Result<f64, Error> {
    let whole = Window {
        x: 0,
        y: 0,
        size: job.frame.size,
    };
    let mut tried = Vec::new();
    for part in [whole].iter().chain(all.iter().take(TRIED)) {
        let group = middle(*part, SMALLEST);
        let pixels = f64::from(group.size.width * group.size.height);
        maker.samples = 1;
        let mut seconds = maker.seconds(job, group, deadline)?;
        if seconds < SHORT {
            // what it takes to begin is no part of a pixel
            maker.samples = 4;
            seconds = maker.seconds(job, group, deadline)? / 16.0;
        }
        tried.push(seconds / pixels);
        if Instant::now() > deadline {
            break;
        }
    }
    Ok(tried.iter().sum::<f64>() / tried.len() as f64)
}

/// The true picture at some of its parts.
pub(super) struct Truth {
    pub(super) layout: Layout,
    pub(super) parts: Parts,
    pub(super) samples: u32,
    pub(super) more_steps: bool,
    pub(super) own: Option<Judgement>,
    maker: Maker,
    /// All parts of the picture, those that are known first.
    all: Vec<Window>,
}

impl Truth {
    /// As many parts as are done by the deadline, and one for every core at least.
    pub(super) fn new(
        job: &Job,
        deadline: Instant,
        listener: &mut Listener,
    ) -> Result<Self, Error> {
        let mut all = parts(job.frame.size);
        let cores = available_parallelism().map_or(1, usize::from);
        let mut known: Vec<Vec<[f32; 4]>> = Vec::new();
        let (maker, samples) = affordable(job, &mut all, deadline)?;
        for group in all.chunks(cores) {
            listener(
                "computing the truth in f64",
                known.len() as u64,
                all.len() as u64,
            );
            match maker.made(job, group, deadline, known.is_empty())? {
                Some(made) => known.extend(made),
                None => break,
            }
            if Instant::now() > deadline {
                break;
            }
        }
        let layout = Layout::new(all[..known.len()].to_vec(), job.frame.size);
        let own = Self::own_error(job, &layout, &known, samples, deadline)?;
        Ok(Self {
            parts: Parts::new(&layout, known)?,
            layout,
            samples,
            more_steps: maker.settings.iter().any(|s| s.spec.trades),
            own,
            maker,
            all,
        })
    }

    /// The settings that it is computed with.
    pub(super) fn settings(&self) -> &[SettingValue] {
        &self.maker.settings
    }

    /// Other parts than those that are known, as many as are done by the deadline and at most so many; nothing where none is.
    pub(super) fn others(
        &self,
        job: &Job,
        most: usize,
        deadline: Instant,
        listener: &mut Listener,
    ) -> Result<Option<Made>, Error> {
        let others = &self.all[self.layout.windows.len().min(self.all.len())..];
        let others = &others[..others.len().min(most)];
        let cores = available_parallelism().map_or(1, usize::from);
        let mut made = Vec::new();
        for group in others.chunks(cores) {
            listener(
                "computing the truth in f64 elsewhere",
                made.len() as u64,
                others.len() as u64,
            );
            match self.maker.made(job, group, deadline, false)? {
                Some(more) => made.extend(more),
                None => break,
            }
        }
        Ok((!made.is_empty()).then(|| (others[..made.len()].to_vec(), made)))
    }

    /// How far the first parts are from those with half the steps and half the samples.
    fn own_error(
        job: &Job,
        layout: &Layout,
        known: &[Vec<[f32; 4]>],
        samples: u32,
        deadline: Instant,
    ) -> Result<Option<Judgement>, Error> {
        let windows = layout
            .windows
            .iter()
            .copied()
            .take(CHECKED)
            .collect::<Vec<_>>();
        let lesser = Maker::new(job, STEPS[1], samples / 2)?;
        // an eighth of what the parts have cost, or nothing
        let patience = deadline.max(Instant::now() + PATIENCE);
        let Some(made) = lesser.made(job, &windows, patience, false)? else {
            return Ok(None);
        };
        let first = Layout::new(windows, job.frame.size);
        let truth = Parts::new(&first, known[..made.len()].to_vec())?;
        let (judgement, _) = judge(&first, &truth, &Parts::new(&first, made)?)?;
        Ok(Some(judgement))
    }

    pub(super) fn pixels(&self) -> u64 {
        let pixels = |w: &Window| u64::from(w.size.width) * u64::from(w.size.height);
        self.layout.windows.iter().map(pixels).sum()
    }
}

/// What computes parts of the picture with so many times the default's steps.
struct Maker {
    painter: Painter,
    settings: Vec<SettingValue>,
    samples: u32,
}

impl Maker {
    fn new(job: &Job, factor: f64, samples: u32) -> Result<Self, Error> {
        let default = job.choices.first().ok_or_else(|| Error::Invalid {
            reason: "no choices are given".to_owned(),
        })?;
        let settings = best(&default.settings, factor);
        let scene = (job.scene)(&settings, Precision::Double.into())
            .map_err(|reason| Error::Invalid { reason })?;
        Ok(Self {
            painter: Painter::new(&scene, Arithmetic::Reference, Pipeline::Linear)?,
            settings,
            samples,
        })
    }

    /// Seconds that a part takes.
    fn seconds(&self, job: &Job, part: Window, deadline: Instant) -> Result<f64, Error> {
        let start = Instant::now();
        self.made(job, &[part], deadline, true)?;
        Ok(start.elapsed().as_secs_f64())
    }

    /// Some parts, or nothing where that takes until after the deadline, unless it `must`.
    fn made(
        &self,
        job: &Job,
        windows: &[Window],
        deadline: Instant,
        must: bool,
    ) -> Result<Option<Vec<Vec<[f32; 4]>>>, Error> {
        let cancel = AtomicBool::new(false);
        let (done, waiting) = mpsc::channel::<()>();
        thread::scope(|scope| {
            let cancel = &cancel;
            if !must {
                scope.spawn(move || {
                    let left = deadline.saturating_duration_since(Instant::now());
                    if waiting.recv_timeout(left) == Err(mpsc::RecvTimeoutError::Timeout) {
                        cancel.store(true, Ordering::Relaxed);
                    }
                });
            }
            let frame = frame(&job.frame, &[], self.samples);
            let made = self
                .painter
                .windows(&frame, &self.settings, windows, cancel);
            drop(done);
            match made {
                Err(_) if cancel.load(Ordering::Relaxed) => Ok(None),
                made => made.map(Some),
            }
        })
    }
}
