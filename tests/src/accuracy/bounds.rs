//! Declared bounds of every function, and what they are held to.

use super::evaluators::Machine;
use super::measure::{Errors, Measured, Metric};
use super::subjects::Subject;
use super::tables::Domain;

/// `function domain reference-value reference-derivative gpu-value gpu-derivative reason`
const TABLE: &str = include_str!("bounds.tsv");

/// Above this a bound needs a reason: of a real function, and of each component of a complex one.
const ORDINARY: (f64, f64) = (4.0, 8.0);
/// No reason is good enough for more: on a GPU, and in the reference, whose unit is 2²⁹ times smaller.
const CAP: (f64, f64) = (96.0, 128.0);

/// A declared bound in units in the last place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// The largest error.
    pub ulps: f64,
    /// What it is divided by.
    pub metric: Metric,
}

/// Bounds of one function on one sort of machine.
#[derive(Clone, Copy, Debug)]
pub struct Declared {
    /// Of the value.
    pub value: Bound,
    /// Of the derivative; `None` where there is no rule, or no reference.
    pub derivative: Option<Bound>,
    /// Why a bound is high, or not by component; may be empty.
    pub reason: &'static str,
}

/// The bounds of a function on a machine.
///
/// # Errors
/// There are none, or they break the rules for bounds; in words.
pub fn declared(subject: &Subject, machine: &Machine) -> Result<Declared, String> {
    let domain = subject.domain.to_string();
    let row = TABLE
        .lines()
        .map(|line| line.split('\t').collect::<Vec<_>>())
        .find(|cells| cells.len() == 7 && cells[0] == subject.word && cells[1] == domain)
        .ok_or("no bound is declared")?;
    let first = if matches!(machine, Machine::Reference) {
        2
    } else {
        4
    };
    let reason = if row[6] == "-" { "" } else { row[6] };
    let value = bound(row[first]).ok_or("the value has no bound")?;
    let declared = Declared {
        value,
        derivative: bound(row[first + 1]),
        reason,
    };
    for bound in [Some(declared.value), declared.derivative]
        .into_iter()
        .flatten()
    {
        permitted(bound, subject.domain, machine, reason)?;
    }
    Ok(declared)
}

/// Whether a bound may be declared at all.
///
/// # Errors
/// It is above the cap, or needs a reason; in words.
pub(super) fn permitted(
    bound: Bound,
    domain: Domain,
    machine: &Machine,
    reason: &str,
) -> Result<(), String> {
    let ordinary = if domain == Domain::Real {
        ORDINARY.0
    } else {
        ORDINARY.1
    };
    let plain = bound.ulps <= ordinary && bound.metric == Metric::Component;
    if !plain && reason.is_empty() {
        return Err(format!("{bound:?} needs a reason"));
    }
    let cap = if matches!(machine, Machine::Reference) {
        CAP.1
    } else {
        CAP.0
    };
    if bound.ulps.is_nan() || bound.ulps > cap {
        return Err(format!("{bound:?} is above the cap of {cap}"));
    }
    Ok(())
}

/// A bound as tables write it: a number, and the metric where it is not by component.
pub(super) fn bound(cell: &str) -> Option<Bound> {
    let (number, word) = cell.split_once(' ').unwrap_or((cell, ""));
    let metric = Metric::ALL.into_iter().find(|m| m.word() == word)?;
    Some(Bound {
        ulps: number.parse().ok()?,
        metric,
    })
}

/// Everything that is wrong with what was measured; `tight` says whether bounds must not be far above it.
#[must_use]
pub fn violations(measured: &Measured, declared: &Declared, tight: bool) -> Vec<String> {
    let mut found = Vec::new();
    let mut check = |what: &str, errors: &[Errors; 3], bound: Option<Bound>| {
        let place = |metric| Metric::ALL.iter().position(|m| *m == metric).unwrap_or(0);
        let errors = &errors[bound.map_or(0, |b| place(b.metric))];
        found.extend(
            errors
                .wrong
                .iter()
                .map(|w| format!("{what} of the wrong class: {w}")),
        );
        let Some(Bound { ulps, .. }) = bound else {
            if errors.count() > 0 {
                found.push(format!("no bound of the {what} is declared"));
            }
            return;
        };
        if errors.max() > ulps {
            found.push(format!(
                "{what}: {:.2} ulp, not {ulps}: {}",
                errors.max(),
                errors.worst
            ));
        }
        if tight && ulps > 2.0 * errors.max() + 1.0 {
            found.push(format!(
                "{what}: the bound {ulps} is far above {:.2} ulp",
                errors.max()
            ));
        }
        if errors.count() == 0 {
            found.push(format!(
                "a bound of the {what} is declared, but there are no cases"
            ));
        }
    };
    check("value", &measured.value, Some(declared.value));
    match &measured.derivative {
        Some(derivative) => check("derivative", derivative, declared.derivative),
        None if declared.derivative.is_some() => {
            found.push("a bound of the derivative, but no rule".to_owned());
        }
        None => {}
    }
    found
}
