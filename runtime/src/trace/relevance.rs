//! Which of the values that stand out have to do with the result.
//!
//! A shader computes values that it then does not choose, and errors that later operations swallow. Where something stands
//! out (it differs, or is no number), it is relevant if what is computed from it stands out, too, down to a result.

use super::site::{Choice, Event, Operand, Site, Value};

/// Whether each event that stands out is relevant. Where it is not known what becomes of a value, it counts as relevant.
pub(super) fn relevant(sites: &[Site], events: &[Event], stands_out: &[bool]) -> Vec<bool> {
    let mut has_users = vec![false; sites.len()];
    for operand in sites.iter().flat_map(|site| &site.operands) {
        if let Operand::Site(of, _) = *operand
            && let Some(slot) = has_users.get_mut(of)
        {
            *slot = true;
        }
    }
    let chosen = choices(sites, events);
    let mut found = vec![false; events.len()];
    // whether a later event that is relevant takes the latest value of the site
    let mut wanted = vec![false; sites.len()];
    for (k, event) in events.iter().enumerate().rev() {
        let Some(site) = sites.get(event.site) else {
            continue;
        };
        let is_wanted = std::mem::take(&mut wanted[event.site]) || !has_users[event.site];
        if !(stands_out.get(k) == Some(&true) && is_wanted) {
            continue;
        }
        found[k] = true;
        for (place, operand) in site.operands.iter().enumerate() {
            if let Operand::Site(of, _) = *operand
                && site.takes(place, chosen[k])
                && let Some(slot) = wanted.get_mut(of)
            {
                *slot = true;
            }
        }
    }
    found
}

impl Site {
    /// Whether an operand counts, given which of its two values a choice takes.
    fn takes(&self, place: usize, accepts: Option<bool>) -> bool {
        match (self.choice, accepts) {
            (Some(Choice { reject, .. }), Some(true)) => place < reject,
            (Some(Choice { accept, reject }), Some(false)) => place < accept || place >= reject,
            _ => true,
        }
    }
}

/// Of each event that is a choice, whether it accepts.
fn choices(sites: &[Site], events: &[Event]) -> Vec<Option<bool>> {
    let mut latest: Vec<Option<Value>> = vec![None; sites.len()];
    let mut all = Vec::with_capacity(events.len());
    for event in events {
        let site = sites.get(event.site);
        let condition = site.filter(|site| site.choice.is_some()).and_then(|site| {
            let &Operand::Site(of, None) = site.operands.first()? else {
                return None;
            };
            let value = (*latest.get(of)?)?;
            Some(*value.numbers().first()? != 0.0)
        });
        all.push(condition);
        if let Some(slot) = latest.get_mut(event.site) {
            *slot = Some(event.value);
        }
    }
    all
}
