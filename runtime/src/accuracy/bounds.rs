//! What may be declared as a bound, and what breaks one.

use pullback_compiler::lower::Precision;
use pullback_compiler::table::{Bound, Bounds, Metric, bounds_of};

use super::error::Format;
use super::evaluators::Machine;
use super::measure::{Errors, Measured, in_metric};
use super::subjects::Subject;
use super::tables::Domain;

/// Bounds of one function on one sort of machine.
#[derive(Clone, Copy, Debug)]
pub struct Declared {
    /// Of the value; `None` where nothing is promised: on the tier `fast`.
    pub value: Option<Bound>,
    /// Of the derivative; `None` also where there is no rule, or no reference.
    pub derivative: Option<Bound>,
    /// How errors of the value and of the derivative are divided; on the tier `fast` as on `accurate`.
    pub metrics: [Metric; 2],
    /// Why a bound is high, or not by component; may be empty.
    pub reason: &'static str,
}

/// Above this a bound needs a reason: of a real function, and of each component of a complex one. For pairs of
/// float32 it is 2⁻⁴² of the result.
fn ordinary(format: Format, domain: Domain) -> f64 {
    match (format, domain) {
        (Format::Pair, _) => 64.0,
        (_, Domain::Real) => 4.0,
        (_, Domain::Complex) => 8.0,
    }
}

/// No reason is good enough for more.
fn cap(format: Format) -> f64 {
    match format {
        Format::Single => 96.0,
        Format::Double => 128.0,
        Format::Pair => 1024.0,
    }
}

/// The bounds of a function on a machine.
///
/// # Errors
/// There are none, or they break the rules for bounds; in words.
pub fn declared(subject: &Subject, machine: &Machine) -> Result<Declared, String> {
    let bounds: &Bounds =
        bounds_of(subject.word, subject.domain == Domain::Complex).ok_or("no bound is declared")?;
    let precision = machine.precision();
    let like = match precision {
        Some(Precision::Fast) => Some(Precision::Accurate),
        other => other,
    };
    let metric = |bound: Option<Bound>| bound.map_or(Metric::Component, |b| b.metric);
    let found = Declared {
        value: bounds.value(precision),
        derivative: bounds.derivative(precision),
        metrics: [bounds.value(like), bounds.derivative(like)].map(metric),
        reason: bounds.reason,
    };
    let format = machine.format();
    // derivatives of the wide tiers may be off by four times as much as values
    let share = if precision.is_some() && format.is_wide() {
        0.25
    } else {
        1.0
    };
    let derivative = found.derivative.map(|bound| Bound {
        units: share * bound.units,
        ..bound
    });
    for bound in [found.value, derivative].into_iter().flatten() {
        permitted(bound, subject.domain, format, bounds.reason)?;
    }
    Ok(found)
}

/// Whether a bound may be declared at all.
///
/// # Errors
/// It is above the cap, or needs a reason; in words.
pub fn permitted(bound: Bound, domain: Domain, format: Format, reason: &str) -> Result<(), String> {
    let plain = bound.units <= ordinary(format, domain) && bound.metric.word().is_empty();
    if !plain && reason.is_empty() {
        return Err(format!("the bound {bound} needs a reason"));
    }
    let cap = cap(format);
    if bound.units.is_nan() || bound.units > cap {
        return Err(format!("the bound {bound} is above the cap of {cap}"));
    }
    Ok(())
}

/// Everything that is wrong with what was measured; `tight` says whether bounds must not be far above it.
#[must_use]
pub fn violations(measured: &Measured, declared: &Declared, tight: bool) -> Vec<String> {
    let mut found = quantity("value", &measured.value, declared.value, tight);
    match &measured.derivative {
        Some(derivative) => {
            found.extend(quantity(
                "derivative",
                derivative,
                declared.derivative,
                tight,
            ));
        }
        None if declared.derivative.is_some() => {
            found.push("a bound of the derivative, but no rule".to_owned());
        }
        None => {}
    }
    found
}

fn quantity(what: &str, errors: &[Errors; 3], bound: Option<Bound>, tight: bool) -> Vec<String> {
    let Some(bound) = bound else {
        let cases = errors[0].count() > 0;
        let missing = format!("no bound of the {what} is declared");
        return cases.then_some(missing).into_iter().collect();
    };
    let errors = in_metric(errors, bound.metric);
    let wrong = errors.wrong.iter();
    let mut found: Vec<String> = wrong
        .map(|w| format!("the {what} is of the wrong class: {w}"))
        .collect();
    let (most, worst) = (errors.max(), &errors.worst);
    if most > bound.units {
        found.push(format!(
            "the {what} is off by {most:.2}, not {bound} at most: {worst}"
        ));
    }
    if tight && bound.units > 2.0 * most + 1.0 {
        found.push(format!(
            "the {what} has a bound of {bound}, far above {most:.2}"
        ));
    }
    if errors.count() == 0 {
        found.push(format!(
            "a bound of the {what} is declared, but there are no cases"
        ));
    }
    found
}
