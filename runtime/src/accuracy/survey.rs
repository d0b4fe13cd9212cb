//! Every function on every tier: what was measured, and which bounds do not hold.

use std::sync::Mutex;

use pullback_compiler::lower::Precision;

use super::allowance::Allowance;
use super::bounds::{Declared, declared, violations};
use super::cost::{Cost, Meter};
use super::error::Format;
use super::evaluators::Machine;
use super::measure::{Measured, measure};
use super::subjects::Subject;
use super::sweep::judged_by;
use crate::{Capabilities, Error, Gpu, pool};

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
    /// What each tier is allowed for the adapter's arithmetic, in words, where it is anything.
    pub allowances: Vec<String>,
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

/// Runs a plan, each device on a thread of its own; without a device only the reference can be judged. `progress` is
/// told what part of all is done.
///
/// # Errors
/// The device's, where it cannot time anything.
pub fn survey(
    gpus: &[Gpu],
    plan: &Plan,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<Survey, Error> {
    let each = if plan.quick { EACH_QUICK } else { EACH };
    let tiers: Vec<Option<Precision>> = plan
        .tiers
        .iter()
        .copied()
        .filter(|tier| tier.is_none() || !gpus.is_empty())
        .collect();
    let tasks = tasks(plan.subjects.len(), &tiers);
    let timed = if gpus.is_empty() {
        0
    } else {
        plan.subjects.len()
    };
    let total = tasks.len() + timed;
    let mut done = 0;
    let mut step = || {
        done += 1;
        progress(done, total);
    };
    let mut out = Survey {
        adapter: gpus
            .first()
            .map(|gpu| gpu.adapter().to_string())
            .unwrap_or_default(),
        allowances: allowances(gpus.first(), &tiers)?,
        device_clock: false,
        quick: plan.quick,
        random_points: 3 * each,
        rows: Vec::new(),
        exceptions: Vec::new(),
    };
    let judge_one = |gpu: &mut Option<&Gpu>, &(subject, tier): &(usize, usize)| {
        let machine = match (tiers[tier], gpu) {
            (Some(tier), Some(gpu)) => Machine::Gpu(Box::new(gpu.clone()), tier),
            _ => Machine::Reference,
        };
        judge(&plan.subjects[subject], &machine, each)
    };
    let judges = if gpus.is_empty() {
        vec![None]
    } else {
        gpus.iter().map(Some).collect()
    };
    let mut judged = pool::spread(judges, &tasks, judge_one, &mut step);
    for (k, subject) in plan.subjects.iter().enumerate() {
        let mut findings = Vec::new();
        for (m, tier) in tiers.iter().enumerate() {
            let place = tasks.iter().position(|&task| task == (k, m));
            let found = place.and_then(|place| judged[place].take());
            match found.unwrap_or_else(|| Err("the measurement crashed".into())) {
                Ok(finding) => {
                    out.exceptions.extend(exceptions(subject, &finding));
                    findings.push(finding);
                }
                Err(reason) => {
                    let tier = tier_name(*tier);
                    let name = subject.name();
                    out.exceptions.push(format!("{name}, {tier}: {reason}"));
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
    if !gpus.is_empty() {
        let tiers: Vec<Precision> = tiers.into_iter().flatten().collect();
        price(gpus, plan, &tiers, &mut out, &mut step)?;
    }
    Ok(out)
}

fn allowances(gpu: Option<&Gpu>, tiers: &[Option<Precision>]) -> Result<Vec<String>, Error> {
    let Some(gpu) = gpu else {
        return Ok(Vec::new());
    };
    let found = Capabilities::of(gpu)?;
    let promised = tiers
        .iter()
        .flatten()
        .filter(|&&tier| tier != Precision::Fast);
    let words = promised.map(|tier| (tier, Allowance::of(&found, tier.format()).words()));
    Ok(words
        .filter(|(_, words)| !words.is_empty())
        .map(|(tier, words)| format!("{}: {words}", tier.name()))
        .collect())
}

/// Subjects with places of tiers, those first that take the longest: the finest tiers.
fn tasks(subjects: usize, tiers: &[Option<Precision>]) -> Vec<(usize, usize)> {
    let finest_first = (0..tiers.len()).rev();
    finest_first
        .flat_map(|tier| (0..subjects).map(move |subject| (subject, tier)))
        .collect()
}

/// Adds what evaluations cost. Pipelines are made on all threads, but timed one after another.
fn price(
    gpus: &[Gpu],
    plan: &Plan,
    tiers: &[Precision],
    out: &mut Survey,
    step: &mut dyn FnMut(),
) -> Result<(), Error> {
    let alone = Mutex::new(());
    // Where shaders run on the processor, compiling others at the same time would cost them time.
    let threads = if gpus[0].adapter().is_software() {
        1
    } else {
        gpus.len()
    };
    let meters = gpus[..threads]
        .iter()
        .map(|gpu| Meter::new(gpu, plan.quick))
        .collect::<Result<Vec<_>, _>>()?;
    out.device_clock = meters[0].has_clock();
    let cost = |meter: &mut Meter, subject: &Subject| meter.costs(subject, tiers, &alone);
    let costs = pool::spread(meters, &plan.subjects, cost, step);
    for (row, costs) in out.rows.iter_mut().zip(costs) {
        match costs.unwrap_or_else(|| Err("the timing crashed".into())) {
            Ok(costs) => {
                for (tier, cost) in tiers.iter().zip(costs) {
                    let mut of_tier = row.findings.iter_mut().filter(|f| f.tier == Some(*tier));
                    if let Some(finding) = of_tier.next() {
                        finding.cost = Some(cost);
                    }
                }
            }
            Err(reason) => {
                let name = row.subject.name();
                out.exceptions
                    .push(format!("{name} could not be timed: {reason}"));
            }
        }
    }
    Ok(())
}

fn judge(subject: &Subject, machine: &Machine, each: usize) -> Result<Finding, String> {
    let format = machine.format();
    let allowance = allowance(machine).map_err(|e| e.to_string())?;
    let mut declared = declared(subject, machine)?;
    declared.value = declared.value.map(|bound| allowance.raised(bound));
    declared.derivative = declared.derivative.map(|bound| allowance.raised(bound));
    let judged = allowance.fair(judged_by(subject, machine, each)?, format);
    Ok(Finding {
        tier: machine.precision(),
        format,
        declared,
        measured: measure(&judged, machine)?,
        cost: None,
    })
}

/// What the machine's adapter is allowed.
fn allowance(machine: &Machine) -> Result<Allowance, Error> {
    match machine {
        // exact binary32 takes no liberties either
        Machine::Reference | Machine::Processor(..) => Ok(Allowance::default()),
        Machine::Gpu(gpu, _) => Ok(Allowance::of(&*Capabilities::of(gpu)?, machine.format())),
    }
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
