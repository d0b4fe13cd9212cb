//! One function on one machine: the largest errors of its value and derivative.

use pullback_compiler::What;
use pullback_compiler::formula::Formula;
use pullback_compiler::table::{Bound, Derivative, Metric, bounds_of};

use super::error::{Format, Judge};
use super::evaluators::{Machine, Point};
use super::subjects::{Subject, formula};
use super::sweep;
use super::tables::{Case, Domain, Expected};

/// One case with what came out.
#[derive(Clone, Debug, Default)]
pub struct Witness {
    /// What was evaluated.
    pub what: String,
    /// The arguments, then the second complex operand if there is one.
    pub at: Vec<f64>,
    /// What came out.
    pub got: Vec<f64>,
    /// What is right.
    pub expected: Vec<Expected>,
}

impl std::fmt::Display for Witness {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            what,
            at,
            got,
            expected,
        } = self;
        let right = words(expected);
        write!(f, "{what} at {at:?}: {got:?} for {right}")
    }
}

/// Errors over all cases.
#[derive(Clone, Debug, Default)]
pub struct Errors {
    /// One error for each case, the largest of its components.
    errors: Vec<f64>,
    largest: f64,
    /// The case of the largest error.
    pub worst: Witness,
    /// Cases of the wrong class.
    pub wrong: Vec<Witness>,
}

impl Errors {
    /// Counts a case; an infinite error is one of the wrong class.
    pub fn add(&mut self, error: f64, describe: impl FnOnce() -> Witness) {
        if error.is_infinite() {
            self.wrong.push(describe());
            return;
        }
        if self.errors.is_empty() || error > self.largest {
            self.worst = describe();
            self.largest = error;
        }
        self.errors.push(error);
    }

    /// Cases that were judged.
    #[must_use]
    pub fn count(&self) -> usize {
        self.errors.len() + self.wrong.len()
    }

    /// The largest error, of those that are finite.
    #[must_use]
    pub fn max(&self) -> f64 {
        self.largest
    }

    /// The error that a share of all cases does not exceed: 0.999 for that which one in a thousand is above.
    #[must_use]
    pub fn quantile(&self, share: f64) -> f64 {
        let mut sorted = self.errors.clone();
        sorted.sort_by(f64::total_cmp);
        let place = (sorted.len() as f64 * share).ceil() as usize;
        sorted.get(place.saturating_sub(1)).copied().unwrap_or(0.0)
    }
}

/// Both quantities in every metric, in the order of [`Metric::ALL`].
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// Of the value.
    pub value: [Errors; 3],
    /// Of the derivative; `None` where the function has no derivative rule.
    pub derivative: Option<[Errors; 3]>,
}

/// Of the errors in every metric those in one.
#[must_use]
pub fn in_metric(errors: &[Errors; 3], metric: Metric) -> &Errors {
    match metric {
        Metric::Component => &errors[0],
        Metric::Norm => &errors[1],
        Metric::Unit => &errors[2],
    }
}

/// What is asked to get a subject's derivative.
pub(super) fn demand(subject: &Subject) -> What {
    if subject.domain == Domain::Real && subject.cases.iter().any(|c| c.args.len() > 1) {
        What::Gradient
    } else {
        What::Derivative
    }
}

/// Runs every case of a function, its value alone and its derivative.
///
/// # Errors
/// The machine cannot evaluate it; in words.
pub fn measure(subject: &Subject, machine: &Machine) -> Result<Measured, String> {
    let run = Run::new(subject, machine)?;
    let values = machine.run(&run.formula, What::Value, &run.points)?;
    run.judged(&values, &run.slopes()?)
}

/// Runs every case of a function once, for the value as it comes with the derivative, and the derivative: half the work of
/// a shader compiler.
///
/// # Errors
/// The machine cannot evaluate it; in words.
pub fn measure_together(subject: &Subject, machine: &Machine) -> Result<Measured, String> {
    let run = Run::new(subject, machine)?;
    let slopes = run.slopes()?;
    let columns = run.formula.ty.columns();
    let values = match &slopes {
        Some(both) => both.iter().map(|row| row[..columns].to_vec()).collect(),
        None => machine.run(&run.formula, What::Value, &run.points)?,
    };
    run.judged(&values, &slopes)
}

/// A function on a machine, and where it is evaluated.
struct Run<'s> {
    subject: &'s Subject,
    machine: &'s Machine,
    formula: Formula,
    points: Vec<Point>,
}

impl<'s> Run<'s> {
    fn new(subject: &'s Subject, machine: &'s Machine) -> Result<Self, String> {
        let point = |c: &Case| Point {
            args: c.args.clone(),
            params: c.params.clone(),
        };
        Ok(Self {
            subject,
            machine,
            formula: formula(&subject.source)?,
            points: subject.cases.iter().map(point).collect(),
        })
    }

    /// Values with derivatives; none where there is no rule.
    fn slopes(&self) -> Result<Option<Vec<Vec<f64>>>, String> {
        let found = self
            .machine
            .run(&self.formula, demand(self.subject), &self.points);
        match (self.subject.row.derivative, found) {
            (Derivative::Missing, Ok(_)) => Err("there is a derivative, but no rule".to_owned()),
            (Derivative::Missing, Err(_)) => Ok(None),
            (_, found) => found.map(Some),
        }
    }

    fn judged(
        &self,
        values: &[Vec<f64>],
        slopes: &Option<Vec<Vec<f64>>>,
    ) -> Result<Measured, String> {
        let format = self.machine.format();
        let declared = bounds_of(self.subject.word, self.subject.domain == Domain::Complex);
        let judged = |results: &[Vec<f64>], from: usize, of: fn(&Case) -> &[Expected]| {
            // what the reference evaluator is worth, which judges the cases of a sweep
            let swept = declared.and_then(|bounds| match from {
                0 => bounds.value(None),
                _ => bounds.derivative(None),
            });
            Metric::ALL.map(|metric| judge(self.subject, format, results, from, of, metric, swept))
        };
        // where the value of binary32 overflows, what is computed from it is not judged
        let slopes_of: fn(&Case) -> &[Expected] = |case| {
            if case.value.iter().any(overflows) {
                &[]
            } else {
                &case.derivative
            }
        };
        Ok(Measured {
            value: judged(values, 0, |c| &c.value),
            derivative: slopes
                .as_ref()
                .map(|slopes| judged(slopes, self.formula.ty.columns(), slopes_of)),
        })
    }
}

fn judge(
    subject: &Subject,
    format: Format,
    results: &[Vec<f64>],
    from: usize,
    of: fn(&Case) -> &[Expected],
    metric: Metric,
    swept: Option<Bound>,
) -> Errors {
    let mut errors = Errors::default();
    let of_sweep = match swept {
        Some(bound) if format == Format::Pair => metric.max(bound.metric),
        _ => metric,
    };
    for (case, result) in subject.cases.iter().zip(results) {
        let got = &result[from..];
        if of(case).iter().all(|e| *e == Expected::Unstated) {
            continue;
        }
        let metric = if case.notes == sweep::NOTE {
            of_sweep
        } else {
            metric
        };
        let mut error = case_error(format, got, of(case), metric);
        if case.notes == sweep::NOTE && format == Format::Pair {
            // the reference may be off itself, by ulps of 2⁻⁵² of which sixteen are a unit of pairs
            error = (error - swept.map_or(0.0, |bound| bound.units / 16.0)).max(0.0);
        }
        if case.notes == sweep::NOTE
            && subject.domain == Domain::Complex
            && of(case).iter().any(overflows)
        {
            // an infinite complex number has no direction that counts (C99 Annex G.3)
            let infinite = got.iter().take(of(case).len()).any(|x| !x.is_finite());
            error = if infinite { 0.0 } else { f64::INFINITY };
        }
        if format != Format::Double
            && let Some(flushed) = flushed(subject, case)
        {
            error = error.min(case_error(format, got, of(flushed), metric));
        }
        errors.add(error, || Witness {
            what: subject.name(),
            at: [&case.args[..], &case.params].concat(),
            got: got.to_vec(),
            expected: of(case).to_vec(),
        });
    }
    errors
}

/// The largest error of the components of one case.
#[must_use]
pub fn case_error(format: Format, got: &[f64], expected: &[Expected], metric: Metric) -> f64 {
    let size = match metric {
        Metric::Component => 0.0,
        Metric::Norm => expected.iter().map(size).fold(0.0, f64::max),
        Metric::Unit => expected.iter().map(size).fold(1.0, f64::max),
    };
    got.iter()
        .zip(expected)
        .map(|(&got, &e)| format.error(got, e, size))
        .fold(0.0, f64::max)
}

fn overflows(expected: &Expected) -> bool {
    matches!(expected, Expected::Number { value, .. } if value.is_infinite())
}

fn size(expected: &Expected) -> f64 {
    match expected {
        Expected::Number { value, .. } if value.is_finite() => value.abs(),
        _ => 0.0,
    }
}

/// The case whose subnormal arguments are zeros of the same sign: a GPU may take them for that.
fn flushed<'s>(subject: &'s Subject, case: &Case) -> Option<&'s Case> {
    let least = f64::from(f32::MIN_POSITIVE);
    let flush = |x: &f64| {
        if x.abs() < least {
            0f64.copysign(*x)
        } else {
            *x
        }
    };
    let args: Vec<f64> = case.args.iter().map(flush).collect();
    let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
    if same(&args, &case.args) {
        return None;
    }
    subject
        .cases
        .iter()
        .find(|c| same(&c.args, &args) && c.params == case.params)
}

/// References in words.
fn words(expected: &[Expected]) -> String {
    let each = |e: &Expected| match e {
        Expected::Unstated => "-".to_owned(),
        Expected::Number { value, .. } => format!("{value:?}"),
    };
    format!(
        "[{}]",
        expected.iter().map(each).collect::<Vec<_>>().join(", ")
    )
}
