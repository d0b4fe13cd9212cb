//! Which choices are worth taking.

use super::layout::SIDE;
use super::{Row, SEEN, Time};

/// What a user should take, by place in the rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Advice {
    /// The fastest whose error cannot be seen.
    pub unseen: Option<usize>,
    /// Of those that take at most half the time of the default, the one with the least error.
    pub half: Option<usize>,
}

/// Pixels of which 99.9 % means something: those of eight parts of the picture, as one may show its background alone.
const ENOUGH: u64 = 8 * (SIDE as u64) * (SIDE as u64);

/// Whether the truth is known at enough of a picture's pixels to say what cannot be seen.
pub(super) fn is_enough([known, all]: [u64; 2]) -> bool {
    known >= ENOUGH.min(all)
}

/// Marks the rows that no other beats in time and in error.
pub(super) fn mark_front(rows: &mut [Row]) {
    let known: Vec<Option<(Time, f64)>> = rows
        .iter()
        .map(|row| Some((row.time?, row.error?.seen.mean)))
        .collect();
    for (row, here) in rows.iter_mut().zip(&known) {
        row.on_front = here.is_some_and(|(time, error)| {
            // times spread: of equal pictures one is faster only if most of its turns are
            let beats = |(other, less): &(Time, f64)| {
                (other.high < time.low && *less <= error)
                    || (other.median <= time.median && *less < error)
            };
            !known.iter().flatten().any(beats)
        });
    }
}

/// What to take. What cannot be seen is not known where the truth is at less than [`ENOUGH`] of the picture's pixels.
pub(super) fn advice(rows: &[Row], [known, all]: [u64; 2]) -> Advice {
    let measured = || {
        rows.iter()
            .enumerate()
            .filter_map(|(k, row)| Some((k, row, place(row)?)))
    };
    let unseen = measured()
        .filter(|(_, row, _)| row.is_unseen() && is_enough([known, all]))
        .min_by(|a, b| a.2.0.total_cmp(&b.2.0));
    let default = measured().find(|(k, ..)| *k == 0).map(|(.., here)| here.0);
    let half = default.and_then(|time| {
        measured()
            .filter(|(.., here)| here.0 <= 0.5 * time)
            .min_by(|a, b| a.2.1.total_cmp(&b.2.1))
    });
    Advice {
        unseen: unseen.map(|(k, ..)| k),
        half: half.map(|(k, ..)| k),
    }
}

/// Time and error of a row that has both.
fn place(row: &Row) -> Option<(f64, f64)> {
    Some((row.time?.median, row.error?.seen.mean))
}

impl Row {
    /// Whether 99.9 % of the pixels differ by less from the truth than can be seen.
    #[must_use]
    pub fn is_unseen(&self) -> bool {
        self.error.is_some_and(|error| error.seen.p999 <= SEEN)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Judgement, Spread};
    use super::*;

    fn row(time: f64, error: f64) -> Row {
        let spread = Spread {
            mean: error,
            p999: error,
            max: error,
        };
        Row {
            name: String::new(),
            time: Some(Time {
                median: time,
                low: time,
                high: time,
                turns: 1,
                by_device: false,
            }),
            error: Some(Judgement {
                light: spread,
                seen: spread,
                doubt: 0.0,
            }),
            numbers: Vec::new(),
            note: None,
            on_front: false,
        }
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let mut rows = [
            row(4.0, 0.01),
            row(2.0, 0.02),
            row(3.0, 0.02),
            row(1.0, 0.5),
            row(5.0, 0.01),
            row(2.0, 0.02),
        ];
        rows[3].error = None;
        mark_front(&mut rows);
        let marks = rows.each_ref().map(|row| row.on_front);
        assert_eq!(marks, [true, true, false, false, false, true]);
        // as accurate and a little faster, by less than the times of either spread
        let mut near = [row(4.0, 0.01), row(3.9, 0.01)];
        near[0].time.as_mut().unwrap().low = 3.8;
        mark_front(&mut near);
        assert!(near[0].on_front && near[1].on_front);
    }

    #[test]
    fn advice_is_the_fastest_unseen_and_the_best_of_half_the_time() {
        let rows = [
            row(4.0, 0.5 * SEEN),
            row(3.0, 0.9 * SEEN),
            row(2.0, 2.0 * SEEN),
            row(1.0, 0.5),
        ];
        let found = advice(&rows, [5000; 2]);
        assert_eq!((found.unseen, found.half), (Some(1), Some(2)));
        assert_eq!(advice(&rows[..2], [5000; 2]).half, None);
        assert_eq!(advice(&rows[2..], [5000; 2]).unseen, None);
        // of a few pixels nothing is said, but where they are all
        assert_eq!(advice(&rows, [128, 5000]).unseen, None);
        assert_eq!(advice(&rows, [128, 128]).unseen, Some(1));
    }
}
