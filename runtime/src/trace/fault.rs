//! Which operation made a value NaN or infinite.

use super::relevance::relevant;
use super::site::{Operand, Site, Trace, Value};

/// An operation that makes a number that is none of numbers that are.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Index of the operation's site.
    pub site: usize,
    /// What it was given, all of it finite.
    pub operands: Vec<f64>,
    /// What it gave.
    pub value: Value,
}

/// The first operation whose operands are all finite and whose result is not, of those that have to do with what the
/// formula gives.
#[must_use]
pub fn first_fault(sites: &[Site], trace: &Trace) -> Option<Fault> {
    let odd: Vec<bool> = trace
        .events
        .iter()
        .map(|event| !event.value.is_finite())
        .collect();
    let relevant = relevant(sites, &trace.events, &odd);
    let mut latest: Vec<Option<Value>> = vec![None; sites.len()];
    for (event, is_relevant) in trace.events.iter().zip(relevant) {
        let site = sites.get(event.site)?;
        *latest.get_mut(event.site)? = Some(event.value);
        if !(is_relevant && site.is_operation) {
            continue;
        }
        if let Some(operands) = operands(site, &latest)
            && operands.iter().all(|x| x.is_finite())
        {
            return Some(Fault {
                site: event.site,
                operands,
                value: event.value,
            });
        }
    }
    None
}

/// The numbers that an operation was given; none where one was not told.
fn operands(site: &Site, latest: &[Option<Value>]) -> Option<Vec<f64>> {
    let mut all = Vec::new();
    for &operand in &site.operands {
        match operand {
            Operand::Number(x) => all.push(x),
            Operand::Site(of, None) => all.extend((*latest.get(of)?)?.numbers()),
            Operand::Site(of, Some(part)) => {
                let value = (*latest.get(of)?)?;
                all.push(*value.numbers().get(usize::from(part))?);
            }
        }
    }
    Some(all)
}
