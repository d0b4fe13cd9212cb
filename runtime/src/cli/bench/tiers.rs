//! What a picture takes in each tier.

use std::time::{Duration, Instant};

use pullback_compiler::lower::Precision;
use pullback_runtime::bench::median;
use pullback_runtime::{Capabilities, Error, Frame, Gpu, Renderer, Size};

use crate::cli::Console;
use crate::cli::failure::Failure;
use crate::cli::subject::Subject;

/// Turns at most.
const TURNS: usize = 9;
/// By how much the sides of a picture are divided at most, where it takes too long.
const SMALLEST: u32 = 16;
/// A submission that is timed by the device should take this long, in seconds, and holds so many pictures at most.
const LONG: f64 = 2e-3;
const MOST: f64 = 64.0;

/// The head of the table.
pub(super) fn head(adapter: &str, size: Size) -> String {
    let names = Precision::ALL.map(Precision::name);
    format!(
        "{adapter}; {}x{} pixels of one sample, or fewer where that takes too long (said in brackets), in linear light: \
         milliseconds in {}, and the times of the others relative to that\n\n\
         | scene | {}, ms | {} |\n| --- | ---: | ---: | ---: | ---: |\n",
        size.width,
        size.height,
        names[0],
        names[0],
        names[1..].join(" | ")
    )
}

/// The line of a picture, from turns of so much time.
pub(super) fn line(
    subject: &Subject,
    gpu: &Gpu,
    seconds: f64,
    console: &Console,
) -> Result<String, Failure> {
    let limit = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX / 4);
    let deadline = Instant::now() + limit;
    let mut tiers = Vec::new();
    for precision in Precision::ALL {
        let made = match gpu.has(precision) {
            // one at least, whatever that takes
            true if tiers.is_empty() || Instant::now() < deadline => {
                Some(Tier::new(subject, gpu, precision, console)?)
            }
            _ => None,
        };
        tiers.push(made);
    }
    let size = affordable(subject, &mut tiers, seconds)?;
    for turn in 0..TURNS {
        if turn > 0 && Instant::now() > deadline {
            break;
        }
        for tier in tiers.iter_mut().flatten() {
            tier.turn(subject, size)?;
        }
    }
    let times: Vec<Option<f64>> = tiers
        .iter()
        .map(|tier| Some(median(&tier.as_ref()?.seconds)))
        .collect();
    Ok(written(subject, size, &times))
}

fn written(subject: &Subject, size: Size, times: &[Option<f64>]) -> String {
    let whole = subject.frame(&[]).size;
    let first = times.first().copied().flatten();
    let mut line = format!("| {} |", subject.source.stem);
    line += &first.map_or_else(
        || " -".to_owned(),
        |seconds| format!(" {:.3}", 1e3 * seconds),
    );
    if size != whole {
        line += &format!(" ({}×{})", size.width, size.height);
    }
    for time in times.get(1..).unwrap_or_default() {
        line += &match time.zip(first) {
            Some((time, first)) => format!(" | {:.2}", time / first),
            None => " | -".to_owned(),
        };
    }
    line + " |\n"
}

/// The largest size of the picture of which a turn of all tiers takes a sixth of the time at most.
fn affordable(
    subject: &Subject,
    tiers: &mut [Option<Tier>],
    seconds: f64,
) -> Result<Size, Failure> {
    let whole = subject.frame(&[]).size;
    let divided = |by: u32| Size {
        width: (whole.width / by).max(1),
        height: (whole.height / by).max(1),
    };
    let mut by = SMALLEST;
    loop {
        let mut turn = 0.0;
        for tier in tiers.iter_mut().flatten() {
            // a software adapter compiles while it draws the first one
            if by == SMALLEST {
                tier.once(subject, divided(by))?;
            }
            turn += tier.once(subject, divided(by))?;
        }
        // twice the sides are four times the pixels
        if by == 1 || 4.0 * turn > seconds / 6.0 {
            return Ok(divided(by));
        }
        by /= 2;
    }
}

/// A picture in one tier.
struct Tier {
    renderer: Renderer,
    settings: Vec<u8>,
    seconds: Vec<f64>,
}

impl Tier {
    fn new(
        subject: &Subject,
        gpu: &Gpu,
        precision: Precision,
        console: &Console,
    ) -> Result<Self, Failure> {
        let scene = subject.scene(Capabilities::tier(gpu, precision)?, console)?;
        Ok(Self {
            renderer: Renderer::for_settings(gpu, &scene, &subject.settings, 1)?,
            settings: scene.pack_settings(&subject.settings),
            seconds: Vec::new(),
        })
    }

    /// Seconds of a picture, by our clock.
    fn once(&mut self, subject: &Subject, size: Size) -> Result<f64, Error> {
        let frame = frame(subject, &self.settings, size);
        let start = Instant::now();
        self.renderer.render(&frame, &mut Vec::new())?;
        Ok(start.elapsed().as_secs_f64())
    }

    /// Times it once, by the device's clock where it has one.
    fn turn(&mut self, subject: &Subject, size: Size) -> Result<(), Error> {
        let by_us = self.once(subject, size)?;
        let frame = frame(subject, &self.settings, size);
        let by_device = match self.renderer.device_time(&frame, 1)? {
            Some(once) => {
                let repeats = (LONG / once.max(1e-6)).ceil().clamp(1.0, MOST) as u32;
                self.renderer.device_time(&frame, repeats)?
            }
            None => None,
        };
        self.seconds.push(by_device.unwrap_or(by_us));
        Ok(())
    }
}

fn frame<'a>(subject: &'a Subject, settings: &'a [u8], size: Size) -> Frame<'a> {
    Frame {
        size,
        pipeline: pullback_runtime::Pipeline::Linear,
        ..subject.single(settings)
    }
}
