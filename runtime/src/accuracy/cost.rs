//! What one evaluation of a function takes, and how many of the tier `fast` that is.
//!
//! Every thread evaluates the function many times in a loop whose steps hang on one another, so that nothing can be
//! left out: x + t f(s) replaces s, where t is a uniform that is 0 and s stays x. The same loop without f is subtracted.
//! Tiers take turns, and the shortest of all turns counts: other work on the machine only adds.

use std::sync::{Mutex, PoisonError};

use pullback_compiler::lower::Precision;
use pullback_compiler::{EvalModule, What};

use super::evaluators::{Machine, Point};
use super::random::{Random, Spread};
use super::stopwatch::Timed;
use super::subjects::{Subject, formula};
use super::tables::Domain;
use crate::clock::Clock;
use crate::{Capabilities, Error, Gpu};

/// Most steps of a loop (docs/limits.md).
const MOST_STEPS: f64 = 100_000.0;
/// Steps of the first trial, from which the others are foreseen.
const FIRST_STEPS: f64 = 8.0;
/// A function that adds less than this share to the empty loop costs nothing that could be measured.
const NOTICED: f64 = 0.03;
/// Different arguments.
const ARGUMENTS: usize = 1000;

/// What one evaluation costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Seconds for each evaluation, all threads of the device at work.
    pub seconds: f64,
    /// How many evaluations of the tier `fast` take as long; `None` where those take no time that could be measured.
    pub relative: Option<f64>,
}

/// Times functions on a device.
#[derive(Debug)]
pub struct Meter<'g> {
    gpu: &'g Gpu,
    clock: Option<Clock>,
    rounds: usize,
    /// What a dispatch should take, in seconds.
    aim: f64,
    /// Threads of a dispatch.
    threads: u32,
}

/// The loops of a function on one tier.
struct Loops<'m> {
    full: Timed<'m>,
    empty: Timed<'m>,
    steps: f64,
    /// The shortest seconds for a step of each.
    whole: f64,
    idle: f64,
}

impl Loops<'_> {
    /// Seconds that an evaluation adds to an empty step.
    fn seconds(&self) -> f64 {
        (self.whole - self.idle).max(0.0)
    }
}

impl<'g> Meter<'g> {
    /// `quick` measures fewer and shorter rounds.
    ///
    /// # Errors
    /// The device's.
    pub fn new(gpu: &'g Gpu, quick: bool) -> Result<Self, Error> {
        let software = gpu.adapter().is_software();
        Ok(Self {
            gpu,
            clock: Clock::new(gpu)?,
            rounds: if quick { 5 } else { 9 },
            aim: if quick { 3e-3 } else { 6e-3 },
            threads: if software { 1 << 11 } else { 1 << 17 },
        })
    }

    /// Whether the device's clock is read, not ours.
    #[must_use]
    pub fn has_clock(&self) -> bool {
        self.clock.is_some()
    }

    /// The cost of a function on each tier. Timing waits for `alone`.
    ///
    /// # Errors
    /// It cannot be evaluated on this device; in words.
    pub fn costs(
        &self,
        subject: &Subject,
        tiers: &[Precision],
        alone: &Mutex<()>,
    ) -> Result<Vec<Cost>, String> {
        let points = points(subject)?;
        let mut all = vec![Precision::Fast];
        all.extend(tiers.iter().filter(|&&tier| tier != Precision::Fast));
        let mut loops: Vec<Loops> = all
            .iter()
            .map(|&tier| self.loops(subject, tier, &points))
            .collect::<Result<_, _>>()?;
        let second = &points[0].params;
        let _timing = alone.lock().unwrap_or_else(PoisonError::into_inner);
        for one in &mut loops {
            one.steps = self.steps(&one.full, second)?;
        }
        for _ in 0..self.rounds {
            for one in &mut loops {
                let evaluations = one.steps * f64::from(self.threads);
                let params = [&[0.0, one.steps], second.as_slice()].concat();
                let time = |timed: &Timed| timed.seconds(&params).map_err(|e| e.to_string());
                one.idle = one.idle.min(time(&one.empty)? / evaluations);
                one.whole = one.whole.min(time(&one.full)? / evaluations);
            }
        }
        let fast = loops.first().ok_or("no tiers")?;
        let noticed = fast.seconds() > NOTICED * fast.idle;
        let cost = |one: &Loops| Cost {
            seconds: one.seconds(),
            relative: noticed.then(|| one.seconds() / fast.seconds()),
        };
        let of = |tier: &Precision| {
            let place = all.iter().position(|known| known == tier);
            place.map(|place| cost(&loops[place]))
        };
        Ok(tiers.iter().filter_map(of).collect())
    }

    fn loops(
        &self,
        subject: &Subject,
        tier: Precision,
        points: &[Point],
    ) -> Result<Loops<'_>, String> {
        let timed = |step: &str| {
            let formula = formula(&program(subject, step))?;
            let best = Capabilities::tier(self.gpu, tier).map_err(|e| e.to_string())?;
            let module =
                EvalModule::new(&formula, What::Value, best).map_err(|e| format!("{e:?}"))?;
            let rows = rows(points, tier, self.threads as usize);
            Timed::new(self.gpu, self.clock.as_ref(), &module, &rows, self.threads)
                .map_err(|error| error.to_string())
        };
        Ok(Loops {
            full: timed(call(subject))?,
            empty: timed("s")?,
            steps: FIRST_STEPS,
            whole: f64::INFINITY,
            idle: f64::INFINITY,
        })
    }

    /// Steps that take as long as a dispatch should.
    fn steps(&self, full: &Timed, second: &[f64]) -> Result<f64, String> {
        // the first dispatch of a pipeline says little; the second is believed
        let trial = |steps: f64| {
            let params = [&[0.0, steps], second].concat();
            full.seconds(&params).map_err(|e| e.to_string())
        };
        trial(1.0)?;
        let once = trial(FIRST_STEPS)?.max(1e-9);
        let foreseen = FIRST_STEPS * self.aim / once;
        let steps = if foreseen < MOST_STEPS / 64.0 {
            foreseen
        } else {
            // too short to be believed: most of it is the dispatch
            let steps = foreseen / 16.0;
            let twice = trial(steps.clamp(1.0, MOST_STEPS).floor())?.max(1e-9);
            steps * self.aim / twice
        };
        Ok(steps.clamp(2.0, MOST_STEPS).floor())
    }
}

/// The loop with a step that replaces s.
fn program(subject: &Subject, step: &str) -> String {
    let (head, x) = match (subject.domain, subject.arity) {
        (Domain::Real, 1) => ("x: real", "x"),
        (Domain::Real, _) => ("x, y", "x"),
        (Domain::Complex, _) => ("z: complex", "z"),
    };
    let second = if subject.domain == Domain::Complex && subject.arity == 2 {
        "param a = 0\nparam b = 0\n"
    } else {
        ""
    };
    format!(
        "param tie = 0\nparam steps = 1 in 1..100000\n{second}g({head}) = {}\n\
         f({head}) = iterate(steps, s = {x}, {x} + tie * {step})\nshow {}(f)\n",
        subject.body,
        match (subject.domain, subject.arity) {
            (Domain::Complex, _) => "domain",
            _ => "levels",
        },
    )
}

/// A call of the function with the loop's state.
fn call(subject: &Subject) -> &'static str {
    match (subject.domain, subject.arity) {
        (Domain::Real, 2) => "g(s, y)",
        _ => "g(s)",
    }
}

/// Arguments of ordinary size for which the function is finite.
fn points(subject: &Subject) -> Result<Vec<Point>, String> {
    let mut random = Random::default();
    let mut number = || random.single(Spread::Ordinary);
    let columns = if subject.domain == Domain::Complex {
        2
    } else {
        subject.arity
    };
    let second = subject.domain == Domain::Complex && subject.arity == 2;
    let params: Vec<f64> = (0..if second { 2 } else { 0 }).map(|_| number()).collect();
    let points: Vec<Point> = (0..ARGUMENTS)
        .map(|_| Point {
            args: (0..columns).map(|_| number()).collect(),
            params: params.clone(),
        })
        .collect();
    let values = Machine::Reference.run(&formula(&subject.source)?, What::Value, &points)?;
    let finite = |v: &Vec<f64>| v.iter().all(|x| x.is_finite());
    let kept = points.into_iter().zip(values).filter(|(_, v)| finite(v));
    let kept: Vec<Point> = kept.map(|(point, _)| point).collect();
    if kept.is_empty() {
        return Err("no ordinary argument has a finite value".to_owned());
    }
    Ok(kept)
}

/// As many rows as there are threads, as the shader reads them.
fn rows(points: &[Point], tier: Precision, threads: usize) -> Vec<u8> {
    let numbers = points.iter().cycle().take(threads).flat_map(|p| &p.args);
    let format = tier.format();
    let width = if format.is_wide() { 2 } else { 1 };
    let words = numbers.flat_map(|&x| format.words(x).into_iter().take(width));
    words.flat_map(u32::to_ne_bytes).collect()
}
