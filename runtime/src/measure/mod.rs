//! What each choice between speed and accuracy costs and what it gives, for one picture on one adapter.
//!
//! The truth is the picture's own shader in `f64` on the processor, with more steps and more samples than any choice has, at
//! parts of the picture that are spread over it, as many as the budget allows. Every choice is drawn on the adapter and judged
//! there; then all are timed in turns, in an order that changes, so that drift hits all alike.

mod again;
mod choice;
mod judgement;
mod layout;
mod numbers;
mod readings;
mod referee;
mod timing;
mod truth;
mod verdict;

use std::fmt;
use std::time::{Duration, Instant};

use pullback_compiler::lower::{Precision, Tier};
use pullback_compiler::{Picture, SceneModule, SettingValue};

use crate::difference::Bitmap;
use crate::render::{Frame, Pipeline};
use crate::{Capabilities, Error, Gpu, Renderer};

pub use again::{Again, Check};
pub use choice::{Choice, choices};
pub use judgement::{Judgement, Spread};
pub use numbers::Number;
pub use readings::Quantity;
pub use timing::Time;
pub use verdict::Advice;

use judgement::{Parts, judge};
use layout::Layout;
use referee::Referee;
use timing::Runner;
use truth::Truth;

/// A FLIP that cannot be seen: about that of two steps of 255 in a wide area of middle grey (0.048; one has 0.030).
pub const SEEN: f64 = 0.05;

/// Shares of the budget for the truth, for drawing all choices, for their numbers, for timing them, and for drawing again
/// what is recommended. What one leaves is for the next.
const TRUTH: f64 = 0.35;
const PICTURES: f64 = 0.25;
const NUMBERS: f64 = 0.1;
const TIMES: f64 = 0.2;
const AGAIN: f64 = 0.1;

/// Makes a scene's shader for settings and a tier; what is wrong in words.
pub type MakeScene<'a> = dyn Fn(&[SettingValue], Tier) -> Result<SceneModule, String> + 'a;

/// What is to be measured.
pub struct Job<'a> {
    /// The adapter.
    pub gpu: &'a Gpu,
    /// What is shown.
    pub picture: &'a Picture,
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
    /// How far the numbers are from the true ones that it is made of; none where they were not compared.
    pub numbers: Vec<Number>,
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
    /// Whether what is recommended holds in a second run.
    pub again: Again,
    /// Why there are no numbers, or none of some choices.
    pub numbers_note: Option<String>,
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

impl Report {
    /// Whether the truth is known at enough pixels to say what cannot be seen.
    #[must_use]
    pub fn is_enough(&self) -> bool {
        verdict::is_enough(self.pixels)
    }
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
        match drawn(job, choice, &truth.layout, Some(pictures)) {
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
    let numbers = until(TRUTH + PICTURES + NUMBERS, NUMBERS);
    let numbers = judge_numbers(job, &truth, &mut rows, numbers, listener);
    let times = until(1.0 - AGAIN, TIMES);
    timing::take_turns(job, &mut runners, &mut rows, times, listener);
    verdict::mark_front(&mut rows);
    let size = job.frame.size;
    let pixels = [
        truth.pixels(),
        u64::from(size.width) * u64::from(size.height),
    ];
    let advice = verdict::advice(&rows, pixels);
    let again = match job.gpu.is_lost() {
        true => Again {
            note: Some("the adapter is lost".to_owned()),
            ..Again::default()
        },
        false => {
            let deadline = until(1.0, AGAIN);
            again::again(job, &truth, &rows, &runners, advice, deadline, listener)
        }
    };
    if job.gpu.is_lost() {
        for row in rows.iter_mut().filter(|row| row.error.is_none()) {
            row.note
                .get_or_insert_with(|| "not drawn: the adapter is lost".to_owned());
        }
    }
    Ok(Report {
        advice,
        again,
        numbers_note: numbers.err().map(|error| error.to_string()),
        rows,
        true_samples: truth.samples,
        more_steps: truth.more_steps,
        pixels,
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
            numbers: Vec::new(),
            note: None,
            on_front: false,
        }
    }
}

/// Compares the numbers of all choices that were drawn, until the deadline.
fn judge_numbers(
    job: &Job,
    truth: &Truth,
    rows: &mut [Row],
    deadline: Instant,
    listener: &mut Listener,
) -> Result<(), Trouble> {
    listener("computing true numbers", 0, 1);
    let Some(mut referee) = Referee::new(job, truth, deadline)? else {
        return Ok(());
    };
    let total = rows.len() as u64;
    let mut trouble = None;
    for (k, (row, choice)) in (0..).zip(rows.iter_mut().zip(job.choices)) {
        listener("comparing numbers", k, total);
        if row.error.is_none() {
            continue;
        }
        if k > 0 && Instant::now() > deadline {
            trouble = Some(Trouble::Choice("the budget is spent".to_owned()));
            break;
        }
        match referee.judge(choice) {
            Ok(numbers) => row.numbers = numbers,
            Err(found) => trouble = Some(found),
        }
        if job.gpu.is_lost() {
            break;
        }
    }
    trouble.map_or(Ok(()), Err)
}

/// Why a choice was not drawn.
enum Trouble {
    /// The choice cannot be had.
    Choice(String),
    /// The device failed.
    Device(Error),
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Choice(note) => f.write_str(note),
            Self::Device(error) => error.fmt(f),
        }
    }
}

impl From<Error> for Trouble {
    fn from(error: Error) -> Self {
        Self::Device(error)
    }
}

/// A choice, ready to be timed, and the parts of its picture, if that can be had by the deadline.
fn drawn(
    job: &Job,
    choice: &Choice,
    layout: &Layout,
    deadline: Option<Instant>,
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
    if let Some(deadline) = deadline {
        fits(runner.expected(&job.frame)?, deadline)?;
    }
    let mut rows = Vec::new();
    runner.draw(&job.frame, &mut rows)?;
    let parts = layout.cut(&rows, job.frame.size.width);
    Ok((runner, Parts::new(layout, parts)?))
}

/// Whether a picture that takes so long is there by the deadline.
fn fits(expected: Duration, deadline: Instant) -> Result<(), Trouble> {
    if expected <= deadline.saturating_duration_since(Instant::now()) {
        return Ok(());
    }
    let seconds = expected.as_secs_f64();
    let digits = usize::from(seconds < 10.0);
    Err(Trouble::Choice(format!(
        "not drawn: a picture would take about {seconds:.digits$} s, more than the budget has left"
    )))
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
