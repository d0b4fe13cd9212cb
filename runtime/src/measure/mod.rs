//! What each choice between speed and accuracy costs and what it gives, for one picture on one adapter.
//!
//! The truth is the picture's own shader in `f64` on the processor, with more steps and more samples than any choice has, at
//! parts of the picture that are spread over it, as many as the budget allows. Every choice is drawn on the adapter and judged
//! there; then all are timed in turns, in an order that changes, so that drift hits all alike.

mod choice;
mod judgement;
mod layout;
mod timing;
mod truth;
mod verdict;

use std::time::{Duration, Instant};

use pullback_compiler::lower::{Precision, Tier};
use pullback_compiler::{SceneModule, SettingValue};

use crate::difference::Bitmap;
use crate::render::{Frame, Pipeline};
use crate::{Capabilities, Error, Gpu, Renderer};

pub use choice::{Choice, choices};
pub use judgement::{Judgement, Spread};
pub use timing::Time;
pub use verdict::Advice;

use judgement::{Parts, judge};
use timing::Runner;
use truth::Truth;

/// A FLIP that cannot be seen: about that of two steps of 255 in a wide area of middle grey (0.048; one has 0.030).
pub const SEEN: f64 = 0.05;

/// Shares of the budget for the truth, for drawing all choices, and for timing them. What one leaves is for the next.
const TRUTH: f64 = 0.4;
const PICTURES: f64 = 0.3;
const TIMES: f64 = 0.3;

/// Makes a scene's shader for settings and a tier; what is wrong in words.
pub type MakeScene<'a> = dyn Fn(&[SettingValue], Tier) -> Result<SceneModule, String> + 'a;

/// What is to be measured.
pub struct Job<'a> {
    /// The adapter.
    pub gpu: &'a Gpu,
    /// The picture: its view, size, parameters and clock; samples and settings are those of the choices.
    pub frame: Frame<'a>,
    /// The choices, the default first.
    pub choices: &'a [Choice],
    /// Makes the scene's shader; what is wrong in words.
    pub scene: &'a MakeScene<'a>,
    /// How long all may take.
    pub budget: Duration,
}

/// What came of one choice.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its name.
    pub name: String,
    /// How long a picture takes, where it was timed.
    pub time: Option<Time>,
    /// How far the picture is from the truth, where it was drawn.
    pub error: Option<Judgement>,
    /// Why something is missing.
    pub note: Option<String>,
    /// Whether no other choice is as fast and as accurate.
    pub on_front: bool,
}

/// What came of all of them.
#[derive(Debug)]
pub struct Report {
    /// The choices in the order in which they were given.
    pub rows: Vec<Row>,
    /// What to take.
    pub advice: Advice,
    /// Samples along each axis of a pixel of the truth.
    pub true_samples: u32,
    /// Whether the truth has more steps than the default; else the scene has none.
    pub more_steps: bool,
    /// Pixels at which the truth is known, and how many the picture has.
    pub pixels: [u64; 2],
    /// How far the truth with half the steps and half the samples is from it: more than that is not known.
    pub own: Option<Judgement>,
    /// The parts of the true picture, of the default one, and FLIP of each pixel.
    pub shown: Option<Shown>,
}

/// Pictures for a report.
#[derive(Debug)]
pub struct Shown {
    /// Parts of the true picture, side by side.
    pub truth: Bitmap,
    /// The same of the default.
    pub default: Bitmap,
    /// FLIP of each pixel of these.
    pub seen: Vec<f32>,
}

/// Hears what is being done, and how many parts of how many are done.
pub type Listener<'a> = dyn FnMut(&str, u64, u64) + 'a;

/// Measures all choices, within the budget as far as single steps allow.
///
/// # Errors
/// The truth cannot be computed, or nothing at all can be drawn. What befalls one choice is in its row.
pub fn run(job: &Job, listener: &mut Listener) -> Result<Report, Error> {
    let start = Instant::now();
    // a part that cannot be shortened does not cost the next one its time
    let until = |shares: f64, own: f64| {
        (start + job.budget.mul_f64(shares)).max(Instant::now() + job.budget.mul_f64(own))
    };
    let truth = Truth::new(job, until(TRUTH, TRUTH), listener)?;
    let pictures = until(TRUTH + PICTURES, PICTURES);
    let mut rows: Vec<Row> = job.choices.iter().map(Row::new).collect();
    let mut runners: Vec<Option<Runner>> = job.choices.iter().map(|_| None).collect();
    let mut shown = None;
    for (k, choice) in job.choices.iter().enumerate() {
        listener("drawing", k as u64, job.choices.len() as u64);
        if k > 0 && Instant::now() > pictures {
            rows[k].note = Some("not drawn: the budget is spent".to_owned());
            continue;
        }
        match drawn(job, choice, &truth, pictures) {
            Ok((runner, parts)) => {
                let (judgement, map) = judge(&truth.layout, &truth.parts, &parts)?;
                rows[k].error = Some(judgement);
                runners[k] = Some(runner);
                if k == 0 {
                    shown = Some(Shown {
                        truth: truth.parts.seen.clone(),
                        default: parts.seen,
                        seen: map,
                    });
                }
            }
            Err(Trouble::Choice(note)) => rows[k].note = Some(note),
            Err(Trouble::Device(error)) => {
                // what the device does not survive ends the run, with what there is
                rows[k].note = Some(error.to_string());
                if job.gpu.is_lost() {
                    break;
                }
            }
        }
    }
    timing::take_turns(job, &mut runners, &mut rows, until(1.0, TIMES), listener);
    verdict::mark_front(&mut rows);
    let size = job.frame.size;
    Ok(Report {
        advice: verdict::advice(&rows),
        rows,
        true_samples: truth.samples,
        more_steps: truth.more_steps,
        pixels: [
            truth.pixels(),
            u64::from(size.width) * u64::from(size.height),
        ],
        own: truth.own,
        shown,
    })
}

impl Row {
    fn new(choice: &Choice) -> Self {
        Self {
            name: choice.name(),
            time: None,
            error: None,
            note: None,
            on_front: false,
        }
    }
}

/// Why a choice was not drawn.
enum Trouble {
    /// The choice cannot be had.
    Choice(String),
    /// The device failed.
    Device(Error),
}

impl From<Error> for Trouble {
    fn from(error: Error) -> Self {
        Self::Device(error)
    }
}

/// A choice, ready to be timed, and the parts of its picture.
fn drawn(
    job: &Job,
    choice: &Choice,
    truth: &Truth,
    deadline: Instant,
) -> Result<(Runner, Parts), Trouble> {
    if !job.gpu.has(choice.precision) {
        return Err(Trouble::Choice("the adapter does not have it".to_owned()));
    }
    let tier = Capabilities::tier(job.gpu, choice.precision)?;
    let scene = (job.scene)(&choice.settings, tier).map_err(Trouble::Choice)?;
    let renderer = Renderer::for_settings(job.gpu, &scene, &choice.settings, choice.samples)?;
    let mut runner = Runner::new(
        renderer,
        scene.pack_settings(&choice.settings),
        choice.samples,
    );
    let left = deadline.saturating_duration_since(Instant::now());
    let expected = runner.expected(&job.frame)?;
    if expected > left {
        let seconds = expected.as_secs_f64();
        let digits = usize::from(seconds < 10.0);
        return Err(Trouble::Choice(format!(
            "not drawn: a picture would take about {seconds:.digits$} s, more than the budget has left"
        )));
    }
    let mut rows = Vec::new();
    runner.draw(&job.frame, &mut rows)?;
    let parts = truth.layout.cut(&rows, job.frame.size.width);
    Ok((runner, Parts::new(&truth.layout, parts)?))
}

/// The frame of a choice.
fn frame<'a>(frame: &Frame<'a>, settings: &'a [u8], samples: u32) -> Frame<'a> {
    Frame {
        settings,
        samples,
        pipeline: Pipeline::Linear,
        ..frame.clone()
    }
}

/// The tiers that an adapter has.
#[must_use]
pub fn tiers(gpu: &Gpu) -> Vec<Precision> {
    let all = Precision::ALL.into_iter();
    all.filter(|&precision| gpu.has(precision)).collect()
}
