//! The tier `auto`: the cheapest one whose error cannot be seen in a view.
//!
//! At sample pixels the formula is evaluated on what draws, in each tier, and in f64 on the processor. A tier is chosen
//! where at every sample the colour differs by less than [`COLOUR`] and no line that passes near is displaced by more
//! than [`DISPLACEMENT`]. Where two wide tiers do, the one that is faster on this adapter is taken.

mod matter;
mod points;
mod sight;
mod space;
mod trier;

use std::fmt;
use std::time::{Duration, Instant};

use pullback_compiler::lower::Precision;
use pullback_compiler::scene::Space;
use pullback_compiler::{EvalModule, Evaluator, Program, SettingValue, What};
use pullback_grammar::Diagnostic;

use crate::evaluate::Surroundings;
use crate::{Error, Frame};

pub use points::{Sample, Subject};
pub use sight::{COLOUR, DISPLACEMENT, Sight};
pub use trier::Trier;

/// Rows in the batch whose time decides between tiers that are both good.
const TIMED: usize = 1 << 14;

/// What came of one tier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The adapter does not have it.
    NotOffered,
    /// It does not tell the points of neighbouring pixels apart.
    Unresolved,
    /// Its picture can be told from the true one at this many samples; what is seen at the worst of them, and where.
    Differs {
        /// Samples at which it can be told.
        count: usize,
        /// The greatest difference.
        worst: Sight,
        /// World coordinates of that sample.
        at: [f64; 3],
    },
    /// It cannot be told from the true one; the greatest differences.
    Same(Sight),
}

/// A tier, and what came of it.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// The tier.
    pub precision: Precision,
    /// What came of it.
    pub outcome: Outcome,
    /// How long a batch took, where two good tiers were timed.
    pub time: Option<Duration>,
}

/// Which tier to draw with, and why.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The tier.
    pub precision: Precision,
    /// What came of each that was tried, the cheapest first.
    pub trials: Vec<Trial>,
    /// Number of samples.
    pub samples: usize,
}

impl Verdict {
    /// Whether the picture cannot be told from the true one.
    #[must_use]
    pub fn is_true(&self) -> bool {
        self.trials
            .iter()
            .any(|t| t.precision == self.precision && matches!(t.outcome, Outcome::Same(_)))
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "auto: {}", self.precision.name())?;
        for trial in &self.trials {
            write!(f, "; {}: ", trial.precision.name())?;
            trial.outcome.write(f, self.samples)?;
            if let Some(time) = trial.time {
                write!(f, " ({:.2} ms a batch)", time.as_secs_f64() * 1e3)?;
            }
        }
        Ok(())
    }
}

impl Outcome {
    fn write(self, f: &mut fmt::Formatter<'_>, samples: usize) -> fmt::Result {
        match self {
            Self::NotOffered => f.write_str("not offered by the adapter"),
            Self::Unresolved => f.write_str("does not tell neighbouring pixels apart"),
            Self::Differs { count, worst, at } => {
                let [x, y, _] = at;
                write!(
                    f,
                    "{count} of {samples} samples differ, the worst by {worst} at ({x}, {y})"
                )
            }
            Self::Same(worst) => write!(f, "differs by at most {worst}"),
        }
    }
}

/// What the choice depends on.
#[derive(Clone, Copy, Debug)]
pub struct Scenery<'a> {
    /// The program.
    pub program: &'a Program,
    /// Which of its pictures.
    pub picture: usize,
    /// The settings that it is drawn with.
    pub settings: &'a [SettingValue],
    /// The view, the parameters and the clock.
    pub frame: &'a Frame<'a>,
}

/// Why no tier could be chosen.
#[derive(Debug)]
pub enum Failure {
    /// The formula lacks something, at its place.
    Program(Vec<Diagnostic>),
    /// The device failed.
    Device(Error),
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Device(error)
    }
}

impl From<Vec<Diagnostic>> for Failure {
    fn from(problems: Vec<Diagnostic>) -> Self {
        Self::Program(problems)
    }
}

/// Chooses the tier for a picture on a device, or on the processor.
///
/// # Errors
/// The formula has no derivative that its scene asks for, or the device fails.
pub fn choose<'t>(on: impl Into<Trier<'t>>, scenery: &Scenery) -> Result<Verdict, Failure> {
    let on = on.into();
    let what = what(scenery);
    let mut truth = scenery.program.evaluator(scenery.picture, what)?;
    let samples = points::samples(scenery, &mut truth);
    let true_values = evaluate_truth(scenery, &mut truth, &samples);
    let mut verdict = Verdict {
        precision: Precision::Accurate,
        trials: Vec::new(),
        samples: samples.len(),
    };
    for precision in Precision::ALL {
        let known = verdict.trials.iter().find(|t| t.is_good());
        // of the wide tiers either may be the faster one
        if known.is_some_and(|good| !good.precision.format().is_wide()) {
            break;
        }
        let outcome = compare(on, scenery, precision, &samples, &true_values)?;
        verdict.trials.push(Trial {
            precision,
            outcome,
            time: None,
        });
    }
    time_good_ones(on, scenery, what, &samples, &mut verdict.trials)?;
    verdict.precision = best(&verdict.trials);
    Ok(verdict)
}

impl Trial {
    fn is_good(&self) -> bool {
        matches!(self.outcome, Outcome::Same(_))
    }

    /// Samples at which it can be told from the truth.
    fn differing(&self) -> usize {
        match self.outcome {
            Outcome::Same(_) => 0,
            Outcome::Differs { count, .. } => count,
            Outcome::Unresolved => usize::MAX - 1,
            Outcome::NotOffered => usize::MAX,
        }
    }
}

/// The fastest of the good ones, else the one that differs at the fewest samples.
fn best(trials: &[Trial]) -> Precision {
    let good = trials.iter().filter(|t| t.is_good());
    good.min_by_key(|t| t.time)
        .or_else(|| trials.iter().min_by_key(|t| t.differing()))
        .map_or(Precision::Accurate, |t| t.precision)
}

/// What the scene asks of the formula: its value, and how fast it changes.
fn what(scenery: &Scenery) -> What {
    match scenery.program.pictures()[scenery.picture].scene.space {
        Space::Complex => What::Derivative,
        Space::Plane | Space::Space => What::Gradient,
    }
}

fn evaluate_truth(scenery: &Scenery, truth: &mut Evaluator, samples: &[Sample]) -> Vec<f64> {
    let columns = truth.outputs().len();
    let mut values = vec![f64::NAN; columns * samples.len()];
    let inputs = truth.inputs().len();
    for (sample, out) in samples.iter().zip(values.chunks_exact_mut(columns.max(1))) {
        let frame = scenery.frame;
        truth.eval(
            frame.params,
            frame.time,
            frame.pixel(),
            &sample.point[..inputs],
            out,
        );
    }
    values
}

/// Compares a tier with true values: for each sample those of the formula and of its derivatives, as the scene asks for
/// them.
///
/// # Errors
/// The formula has no derivative that its scene asks for, or the device fails.
pub fn compare<'t>(
    on: impl Into<Trier<'t>>,
    scenery: &Scenery,
    precision: Precision,
    samples: &[Sample],
    true_values: &[f64],
) -> Result<Outcome, Failure> {
    let on = on.into();
    let space = scenery.program.pictures()[scenery.picture].scene.space;
    if !on.has(precision) {
        return Ok(Outcome::NotOffered);
    }
    if space != Space::Space && !scenery.frame.is_resolved(precision.format()) {
        return Ok(Outcome::Unresolved);
    }
    let what = what(scenery);
    let module = scenery
        .program
        .eval_module(scenery.picture, what, on.tier(precision)?)?;
    let values = evaluate(on, scenery, &module, samples)?;
    let columns = module.outputs.len().max(1);
    let eye = sight::Eye::new(scenery);
    let mut worst = (Sight::default(), [0.0; 3]);
    let mut most = Sight::default();
    let mut count = 0;
    for (k, sample) in samples.iter().enumerate() {
        let row = k * columns..(k + 1) * columns;
        let seen = eye.difference(sample, &true_values[row.clone()], &values[row]);
        count += usize::from(seen.is_visible());
        most = most.max(seen);
        if seen.rank() > worst.0.rank() {
            worst = (seen, sample.point);
        }
    }
    Ok(if count == 0 {
        Outcome::Same(most)
    } else {
        Outcome::Differs {
            count,
            worst: worst.0,
            at: worst.1,
        }
    })
}

fn evaluate(
    on: Trier,
    scenery: &Scenery,
    module: &EvalModule,
    samples: &[Sample],
) -> Result<Vec<f64>, Error> {
    let mut evaluator = on.evaluator(module)?;
    let inputs = module.inputs.len();
    let rows: Vec<f64> = samples
        .iter()
        .flat_map(|s| s.point[..inputs].iter().copied())
        .collect();
    let mut values = Vec::new();
    evaluator.eval(surroundings(scenery), samples.len(), &rows, &mut values)?;
    Ok(values)
}

fn surroundings<'a>(scenery: &Scenery<'a>) -> Surroundings<'a> {
    Surroundings {
        params: scenery.frame.params,
        time: scenery.frame.time,
        pixel: scenery.frame.pixel(),
    }
}

/// Times the good tiers against each other, where there are several.
fn time_good_ones(
    on: Trier,
    scenery: &Scenery,
    what: What,
    samples: &[Sample],
    trials: &mut [Trial],
) -> Result<(), Failure> {
    if trials.iter().filter(|t| t.is_good()).count() < 2 {
        return Ok(());
    }
    for trial in trials.iter_mut().filter(|t| t.is_good()) {
        let module =
            scenery
                .program
                .eval_module(scenery.picture, what, on.tier(trial.precision)?)?;
        let mut evaluator = on.evaluator(&module)?;
        let inputs = module.inputs.len();
        let many = samples.iter().cycle().take(TIMED);
        let rows: Vec<f64> = many
            .flat_map(|s| s.point[..inputs].iter().copied())
            .collect();
        // The first batches warm up, and teach the evaluator how many rows it may send at once.
        let mut best = Duration::MAX;
        for _ in 0..4 {
            let start = Instant::now();
            evaluator.eval(surroundings(scenery), TIMED, &rows, &mut Vec::new())?;
            best = best.min(start.elapsed());
        }
        trial.time = Some(best);
    }
    Ok(())
}
