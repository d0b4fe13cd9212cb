//! How long each choice takes, all in turns.

use std::time::{Duration, Instant};

use super::layout::mixed;
use super::{Job, Listener, Row, frame};
use crate::render::{Frame, RowSink, Size};
use crate::{Error, Renderer};

/// Turns at most.
const TURNS: u64 = 25;
/// A submission that is timed by the device should take this long.
const LONG: f64 = 2e-3;
/// Longest picture that is drawn in one submission.
const SHORT: f64 = 0.25;
/// Most pictures in one submission.
const MOST: f64 = 64.0;
/// By how much the sides of a first, small picture are divided.
const DIVISOR: u32 = 8;

/// Seconds that a picture takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// The median.
    pub median: f64,
    /// A quarter of the turns was faster than that.
    pub low: f64,
    /// A quarter was slower.
    pub high: f64,
    /// How many turns.
    pub turns: usize,
    /// By the device's clock; else by ours, from the call until the pixels are here.
    pub by_device: bool,
}

/// A choice that can be drawn.
pub(super) struct Runner {
    renderer: Renderer,
    settings: Vec<u8>,
    samples: u32,
    /// Seconds of each turn.
    times: Vec<f64>,
    by_device: bool,
    repeats: u32,
}

impl Runner {
    pub(super) fn new(renderer: Renderer, settings: Vec<u8>, samples: u32) -> Self {
        Self {
            renderer,
            settings,
            samples,
            times: Vec::new(),
            by_device: false,
            repeats: 1,
        }
    }

    /// What a picture will take, from a small one.
    pub(super) fn expected(&mut self, whole: &Frame) -> Result<Duration, Error> {
        let small = Frame {
            size: Size {
                width: (whole.size.width / DIVISOR).max(1),
                height: (whole.size.height / DIVISOR).max(1),
            },
            ..whole.clone()
        };
        // the first one may still compile
        self.draw(&small, &mut Vec::new())?;
        let start = Instant::now();
        self.draw(&small, &mut Vec::new())?;
        Ok(start.elapsed() * DIVISOR * DIVISOR)
    }

    pub(super) fn draw(&mut self, whole: &Frame, sink: &mut dyn RowSink) -> Result<(), Error> {
        let frame = frame(whole, &self.settings, self.samples);
        self.renderer.render(&frame, sink)
    }

    /// Finds out by which clock, and how many pictures make a submission.
    fn prepare(&mut self, whole: &Frame) -> Result<f64, Error> {
        let start = Instant::now();
        self.draw(whole, &mut Vec::new())?;
        let by_us = start.elapsed().as_secs_f64();
        if by_us > SHORT {
            return Ok(by_us);
        }
        let frame = frame(whole, &self.settings, self.samples);
        if let Some(seconds) = self.renderer.device_time(&frame, 1)? {
            self.by_device = true;
            self.repeats = (LONG / seconds.max(1e-6)).ceil().clamp(1.0, MOST) as u32;
        }
        Ok(by_us)
    }

    fn turn(&mut self, whole: &Frame) -> Result<(), Error> {
        let seconds = if self.by_device {
            let frame = frame(whole, &self.settings, self.samples);
            self.renderer
                .device_time(&frame, self.repeats)?
                .unwrap_or(f64::NAN)
        } else {
            let start = Instant::now();
            self.draw(whole, &mut Vec::new())?;
            start.elapsed().as_secs_f64()
        };
        self.times.push(seconds);
        Ok(())
    }

    /// Seconds of each turn.
    pub(super) fn times(&self) -> &[f64] {
        &self.times
    }

    fn time(&self) -> Option<Time> {
        let mut sorted = self.times.clone();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| {
            sorted
                .get((share * (sorted.len() - 1) as f64).round() as usize)
                .copied()
        };
        if sorted.is_empty() {
            return None;
        }
        Some(Time {
            median: at(0.5)?,
            low: at(0.25)?,
            high: at(0.75)?,
            turns: sorted.len(),
            by_device: self.by_device,
        })
    }
}

/// Times all choices until the deadline, each once at least where a turn of it fits; what there is goes into the rows.
pub(super) fn take_turns(
    job: &Job,
    runners: &mut [Option<Runner>],
    rows: &mut [Row],
    deadline: Instant,
    listener: &mut Listener,
) {
    turns(job, runners, 0, deadline, listener, &mut |k, error| {
        rows[k].note = Some(error.to_string());
    });
    for (row, runner) in rows.iter_mut().zip(runners) {
        row.time = runner.as_ref().and_then(Runner::time);
    }
}

/// Times what can be drawn until the deadline, in turns that are numbered from `first` on; `failed` hears of what cannot.
pub(super) fn turns(
    job: &Job,
    runners: &mut [Option<Runner>],
    first: u64,
    deadline: Instant,
    listener: &mut Listener,
    failed: &mut dyn FnMut(usize, Error),
) {
    let mut ready: Vec<(usize, f64)> = Vec::new();
    for (k, runner) in runners.iter_mut().enumerate() {
        let Some(runner) = runner else { continue };
        listener("timing", 0, TURNS);
        match runner.prepare(&job.frame) {
            Ok(seconds) => ready.push((k, seconds)),
            Err(error) => failed(k, error),
        }
    }
    for turn in 0..TURNS {
        listener("timing", turn, TURNS);
        // another order each time, so that none always follows the same one
        ready.sort_by_key(|(k, _)| mixed((first + turn) << 32 | *k as u64));
        ready.retain(|&(k, seconds)| {
            let left = deadline
                .saturating_duration_since(Instant::now())
                .as_secs_f64();
            if turn > 0 && seconds > left {
                return true;
            }
            let Some(runner) = &mut runners[k] else {
                return false;
            };
            match runner.turn(&job.frame) {
                Ok(()) => true,
                Err(error) => {
                    failed(k, error);
                    false
                }
            }
        });
        if Instant::now() > deadline {
            break;
        }
    }
}
