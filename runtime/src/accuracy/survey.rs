//! Every function on every tier: what was measured, and which bounds do not hold.

use pullback_compiler::lower::Precision;

use super::bounds::{Declared, declared, violations};
use super::cost::{Cost, Meter};
use super::error::Format;
use super::evaluators::Machine;
use super::measure::{Measured, measure};
use super::subjects::Subject;
use super::sweep::judged_by;
use crate::{Error, Gpu};

/// Random points of each kind, beside the tables.
const EACH: usize = 20_000;
/// Those of a quick survey.
const EACH_QUICK: usize = 600;

/// What is surveyed.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The functions.
    pub subjects: Vec<Subject>,
    /// The tiers; `None` is the `f64` reference.
    pub tiers: Vec<Option<Precision>>,
    /// Whether fewer points and shorter rounds are enough.
    pub quick: bool,
}

/// A function on a tier.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The tier; `None` is the `f64` reference.
    pub tier: Option<Precision>,
    /// The format of its numbers.
    pub format: Format,
    /// What is declared.
    pub declared: Declared,
    /// What was measured.
    pub measured: Measured,
    /// What an evaluation costs; `None` for the reference, and where it could not be timed.
    pub cost: Option<Cost>,
}

/// A function on all tiers.
#[derive(Clone, Debug)]
pub struct Row {
    /// The function, without its cases.
    pub subject: Subject,
    /// In the order of the plan.
    pub findings: Vec<Finding>,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Survey {
    /// The adapter in words; empty where there was none to judge.
    pub adapter: String,
    /// Whether times are by the device's clock.
    pub device_clock: bool,
    /// Whether it was a quick one.
    pub quick: bool,
    /// Random points for each function on each tier but `double`, beside the tables.
    pub random_points: usize,
    /// Every function.
    pub rows: Vec<Row>,
    /// Bounds that do not hold and what could not be measured, a sentence each.
    pub exceptions: Vec<String>,
}

/// The name of a tier, as the command line has it.
#[must_use]
pub fn tier_name(tier: Option<Precision>) -> &'static str {
    tier.map_or("reference", Precision::name)
}

/// Runs a plan; without a device only the reference can be judged. `progress` is told what part of all is done.
///
/// # Errors
/// The device's, where it cannot time anything.
pub fn survey(
    gpu: Option<&Gpu>,
    plan: &Plan,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<Survey, Error> {
    let each = if plan.quick { EACH_QUICK } else { EACH };
    let meter = gpu.map(|gpu| Meter::new(gpu, plan.quick)).transpose()?;
    let machines: Vec<Machine> = plan
        .tiers
        .iter()
        .filter_map(|tier| match (tier, gpu) {
            (None, _) => Some(Machine::Reference),
            (Some(tier), Some(gpu)) => Some(Machine::Gpu(Box::new(gpu.clone()), *tier)),
            (Some(_), None) => None,
        })
        .collect();
    let tiers: Vec<Precision> = machines.iter().filter_map(Machine::precision).collect();
    let mut out = Survey {
        adapter: gpu.map(|gpu| gpu.adapter().to_string()).unwrap_or_default(),
        device_clock: meter.as_ref().is_some_and(Meter::has_clock),
        quick: plan.quick,
        random_points: 3 * each,
        rows: Vec::new(),
        exceptions: Vec::new(),
    };
    let steps = machines.len() + 1;
    let total = plan.subjects.len() * steps;
    for (k, subject) in plan.subjects.iter().enumerate() {
        let mut findings = Vec::new();
        for (m, machine) in machines.iter().enumerate() {
            progress(k * steps + m, total);
            match judge(subject, machine, each) {
                Ok(finding) => {
                    out.exceptions.extend(exceptions(subject, &finding));
                    findings.push(finding);
                }
                Err(reason) => {
                    let tier = tier_name(machine.precision());
                    let name = subject.name();
                    out.exceptions.push(format!("{name}, {tier}: {reason}"));
                }
            }
        }
        progress(k * steps + machines.len(), total);
        if let Some(meter) = &meter {
            match meter.costs(subject, &tiers) {
                Ok(costs) => {
                    for (tier, cost) in tiers.iter().zip(costs) {
                        let mut of_tier = findings.iter_mut().filter(|f| f.tier == Some(*tier));
                        if let Some(finding) = of_tier.next() {
                            finding.cost = Some(cost);
                        }
                    }
                }
                Err(reason) => {
                    let name = subject.name();
                    out.exceptions
                        .push(format!("{name} could not be timed: {reason}"));
                }
            }
        }
        out.rows.push(Row {
            subject: Subject {
                cases: Vec::new(),
                ..subject.clone()
            },
            findings,
        });
    }
    progress(total, total);
    Ok(out)
}

fn judge(subject: &Subject, machine: &Machine, each: usize) -> Result<Finding, String> {
    let declared = declared(subject, machine)?;
    let judged = judged_by(subject, machine, each)?;
    Ok(Finding {
        tier: machine.precision(),
        format: machine.format(),
        declared,
        measured: measure(&judged, machine)?,
        cost: None,
    })
}

/// Bounds that a function breaks; on `fast` nothing is promised.
fn exceptions(subject: &Subject, finding: &Finding) -> Vec<String> {
    if finding.tier == Some(Precision::Fast) {
        return Vec::new();
    }
    let tier = tier_name(finding.tier);
    violations(&finding.measured, &finding.declared, false)
        .into_iter()
        .map(|what| format!("{}, {tier}: {what}", subject.name()))
        .collect()
}
