//! A second run: whether what is recommended holds at other parts of the picture and in other turns.

use std::time::Instant;

use super::judgement::{Judgement, Parts, judge};
use super::layout::Layout;
use super::timing::{self, Runner};
use super::truth::Truth;
use super::{Advice, Job, Listener, Row, drawn};
use crate::bench::{Ratio, ratio};
use crate::{Error, executor::Window};

/// Parts of the picture that the second run looks at, at most, and at least where they are not all.
const PARTS: usize = 16;
const FEWEST: usize = 4;
/// Standard errors of a difference of two means of FLIP beyond which it is no chance.
const SIGMAS: f64 = 3.0;
/// Turns with these numbers are others than those of the first run.
const TURNS_BEGIN: u64 = 1 << 20;

/// What the second run says of a choice.
#[derive(Clone, Debug)]
pub struct Check {
    /// Its place in the rows.
    pub choice: usize,
    /// Its error there.
    pub error: Option<Judgement>,
    /// By how much the means of FLIP of both runs may differ by chance.
    pub allowed: f64,
    /// Whether they differ by no more.
    pub error_holds: Option<bool>,
    /// Its time relative to that of the default in both runs.
    pub times: Option<[Ratio; 2]>,
    /// Whether both may be the same; nothing where too few turns were timed to tell, and for the default.
    pub time_holds: Option<bool>,
}

/// What came of the second run.
#[derive(Clone, Debug, Default)]
pub struct Again {
    /// The default, and what is recommended beside it.
    pub checks: Vec<Check>,
    /// Whether the parts of the picture are others than in the first run; else it is all of the picture in both.
    pub elsewhere: bool,
    /// Why there is none, or less.
    pub note: Option<String>,
}

/// Draws the default and what is recommended anew, until the deadline.
pub(super) fn again(
    job: &Job,
    truth: &Truth,
    rows: &[Row],
    first: &[Option<Runner>],
    advice: Advice,
    deadline: Instant,
    listener: &mut Listener,
) -> Again {
    let mut wanted: Vec<usize> = [Some(0), advice.unseen, advice.half]
        .into_iter()
        .flatten()
        .collect();
    wanted.dedup();
    wanted.retain(|&k| rows.get(k).is_some_and(|row| row.error.is_some()));
    if wanted.is_empty() {
        return Again::without("nothing was drawn");
    }
    listener("drawing again", 0, wanted.len() as u64);
    match run(job, truth, rows, first, (&wanted, deadline), listener) {
        Ok(again) => again,
        Err(error) => Again::without(&error.to_string()),
    }
}

impl Again {
    fn without(note: &str) -> Self {
        Self {
            note: Some(note.to_owned()),
            ..Self::default()
        }
    }
}

fn run(
    job: &Job,
    truth: &Truth,
    rows: &[Row],
    first: &[Option<Runner>],
    (wanted, deadline): (&[usize], Instant),
    listener: &mut Listener,
) -> Result<Again, Error> {
    let (layout, true_parts) = if truth.layout.is_whole() {
        (truth.layout.clone(), truth.parts.clone())
    } else {
        let now = Instant::now();
        let half = now + deadline.saturating_duration_since(now) / 2;
        match truth.others(job, PARTS, half, listener)? {
            Some((windows, made)) if windows.len() >= FEWEST => true_there(job, windows, made)?,
            _ => return Ok(Again::without("the budget is spent")),
        }
    };
    let mut runners: Vec<Option<Runner>> = Vec::new();
    let mut checks = Vec::new();
    let mut note = None;
    for &k in wanted {
        // the first run has shown that this fits
        let (runner, error) = match drawn(job, &job.choices[k], &layout, None) {
            Ok((runner, parts)) => {
                let (error, _) = judge(&layout, &true_parts, &parts)?;
                (Some(runner), Some(error))
            }
            Err(trouble) => {
                note = Some(trouble.to_string());
                (None, None)
            }
        };
        runners.push(runner);
        checks.push(Check::new(k, rows[k].error, error));
    }
    timing::turns(
        job,
        &mut runners,
        TURNS_BEGIN,
        deadline,
        listener,
        &mut |_, error| {
            note = Some(error.to_string());
        },
    );
    for (check, runner) in checks.iter_mut().zip(&runners).skip(1) {
        let before = relative(first.first(), first.get(check.choice));
        let now = relative(runners.first(), Some(runner));
        check.times = before.zip(now).map(|(before, now)| [before, now]);
        check.time_holds = check.times.and_then(both_may_be_the_same);
    }
    Ok(Again {
        checks,
        elsewhere: !truth.layout.is_whole(),
        note,
    })
}

fn true_there(
    job: &Job,
    windows: Vec<Window>,
    made: Vec<Vec<[f32; 4]>>,
) -> Result<(Layout, Parts), Error> {
    let layout = Layout::new(windows, job.frame.size);
    let parts = Parts::new(&layout, made)?;
    Ok((layout, parts))
}

impl Check {
    fn new(choice: usize, told: Option<Judgement>, found: Option<Judgement>) -> Self {
        let doubts = told
            .zip(found)
            .map(|(told, found)| told.doubt.hypot(found.doubt));
        let allowed = SIGMAS * doubts.unwrap_or(0.0);
        let differ = told
            .zip(found)
            .map(|(told, found)| (told.seen.mean - found.seen.mean).abs());
        Self {
            choice,
            error: found,
            allowed,
            error_holds: differ.map(|differ| differ <= allowed),
            times: None,
            time_holds: None,
        }
    }

    /// Whether nothing that is known is otherwise than it was told.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.error_holds != Some(false) && self.time_holds != Some(false)
    }
}

/// A choice's time relative to the default's.
fn relative(default: Option<&Option<Runner>>, choice: Option<&Option<Runner>>) -> Option<Ratio> {
    let times = |runner: Option<&Option<Runner>>| Some(runner?.as_ref()?.times().to_vec());
    let (default, choice) = (times(default)?, times(choice)?);
    // turn by turn nothing is known of how fast the machine was
    let [by_default, by_choice] = [&default, &choice].map(|times| vec![1.0; times.len()]);
    ratio([&default, &by_default], [&choice, &by_choice])
}

/// Whether the intervals of two ratios meet; nothing where one is not known.
fn both_may_be_the_same([a, b]: [Ratio; 2]) -> Option<bool> {
    let is_known = |ratio: Ratio| ratio.range[1].is_finite();
    (is_known(a) && is_known(b)).then(|| a.range[0] <= b.range[1] && b.range[0] <= a.range[1])
}

#[cfg(test)]
mod tests {
    use super::super::Spread;
    use super::*;

    fn judged(mean: f64, doubt: f64) -> Judgement {
        let spread = Spread {
            mean,
            p999: mean,
            max: mean,
        };
        Judgement {
            light: spread,
            seen: spread,
            doubt,
        }
    }

    #[test]
    fn means_may_differ_by_their_doubts() {
        let check = |a, b| Check::new(1, Some(a), Some(b));
        let near = check(judged(0.010, 0.001), judged(0.014, 0.001));
        assert!(near.error_holds == Some(true) && near.holds(), "{near:?}");
        let far = check(judged(0.010, 0.001), judged(0.015, 0.001));
        assert!(far.error_holds == Some(false) && !far.holds(), "{far:?}");
        // known everywhere: the same picture is equally far
        assert_eq!(
            check(judged(0.01, 0.0), judged(0.01, 0.0)).error_holds,
            Some(true)
        );
        assert_eq!(
            check(judged(0.01, 0.0), judged(0.0101, 0.0)).error_holds,
            Some(false)
        );
        let unknown = Check::new(1, Some(judged(0.01, 0.0)), None);
        assert!(unknown.error_holds.is_none() && unknown.holds());
    }

    #[test]
    fn ratios_hold_where_their_intervals_meet() {
        let ratio = |low: f64, high: f64| Ratio {
            value: 0.5 * (low + high),
            range: [low, high],
        };
        assert_eq!(
            both_may_be_the_same([ratio(0.4, 0.6), ratio(0.5, 0.7)]),
            Some(true)
        );
        assert_eq!(
            both_may_be_the_same([ratio(0.4, 0.6), ratio(0.7, 0.8)]),
            Some(false)
        );
        assert_eq!(
            both_may_be_the_same([ratio(0.4, 0.6), ratio(0.0, f64::INFINITY)]),
            None
        );
    }
}
