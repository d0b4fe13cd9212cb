//! Whether times of two runs differ.

use std::hint::black_box;
use std::time::Instant;

/// Steps of the loop that tells how fast the machine is at the moment.
const STEPS: u64 = 2_000_000;

/// Standard errors beyond which a difference is no chance, in one of 500 cases or so.
const SIGMAS: f64 = 3.1;

/// How two runs' times of one case compare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratio {
    /// The second run's time by the first one's, each relative to its calibration.
    pub value: f64,
    /// Between these it lies beyond doubt.
    pub range: [f64; 2],
}

/// Seconds of a fixed loop of integers and floats on one core: what the machine is worth while others work, too.
#[must_use]
pub fn calibration() -> f64 {
    let start = Instant::now();
    let (mut state, mut sum) = (0x9e37_79b9_7f4a_7c15_u64, 0.0_f64);
    for k in 0..black_box(STEPS) {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        sum = sum.mul_add(0.999, (state ^ k) as f64);
    }
    black_box((state, sum));
    start.elapsed().as_secs_f64()
}

/// The middle of some numbers.
#[must_use]
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let upper = sorted.get(sorted.len() / 2).copied();
    let lower = sorted.get((sorted.len().saturating_sub(1)) / 2).copied();
    upper.zip(lower).map_or(f64::NAN, |(a, b)| 0.5 * (a + b))
}

/// Compares a case of two runs, turn by turn relative to the calibrations of the same turns. The ratio is the median of the
/// ratios of all pairs of turns, and its range is that of Hodges and Lehmann ("Estimates of location based on rank tests",
/// Ann. Math. Stat. 34, 1963), which asks nothing of how times spread: the pairs are in order, and as many are left out at
/// both ends as the test of Mann and Whitney allows. With less than eight turns in each run nothing is beyond doubt. `None`
/// where a run has none.
#[must_use]
pub fn ratio(base: [&[f64]; 2], now: [&[f64]; 2]) -> Option<Ratio> {
    let [base, now] = [relative(base), relative(now)];
    let mut pairs: Vec<f64> = now
        .iter()
        .flat_map(|now| base.iter().map(move |base| now / base))
        .collect();
    if pairs.is_empty() {
        return None;
    }
    pairs.sort_by(f64::total_cmp);
    let [m, n] = [base.len(), now.len()].map(|count| count as f64);
    let deviation = (m * n * (m + n + 1.0) / 12.0).sqrt();
    let left_out = (0.5 * m * n - SIGMAS * deviation).floor();
    let range = if left_out < 1.0 {
        [0.0, f64::INFINITY]
    } else {
        let k = left_out as usize;
        [pairs[k - 1], pairs[pairs.len() - k]]
    };
    Some(Ratio {
        value: median(&pairs),
        range,
    })
}

/// Times by the calibrations of their turns.
fn relative([times, calibrations]: [&[f64]; 2]) -> Vec<f64> {
    let all = times
        .iter()
        .zip(calibrations)
        .map(|(time, unit)| time / unit);
    all.filter(|ratio| ratio.is_finite() && *ratio > 0.0)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Times that spread by a few percent, the same in every run.
    fn times(of: f64, seed: u64) -> Vec<f64> {
        let mut state = seed;
        let mut next = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        (0..25)
            .map(|_| of * (1.0 + 0.06 * next() * next()))
            .collect()
    }

    #[test]
    fn equal_runs_are_equal_and_slower_ones_are_found() {
        let unit = vec![1.0; 25];
        let mut chance = 0;
        for seed in 1..1000 {
            let (base, same) = (times(0.01, seed), times(0.01, seed + 1000));
            let found = ratio([&base, &unit], [&same, &unit]).unwrap();
            chance += usize::from(found.range[0] >= 1.0 || found.range[1] <= 1.0);
            let slower = times(0.011, seed + 2000);
            let found = ratio([&base, &unit], [&slower, &unit]).unwrap();
            assert!(
                found.range[0] > 1.03 && (found.value - 1.1).abs() < 0.03,
                "{found:?}"
            );
        }
        assert!(chance <= 6, "{chance} of 999");
    }

    #[test]
    fn a_slower_machine_is_no_slower_program() {
        let (base, now) = (times(0.01, 3), times(0.02, 4));
        let found = ratio([&base, &[1.0; 25]], [&now, &[2.0; 25]]).unwrap();
        assert!(found.range[0] < 1.0 && found.range[1] > 1.0, "{found:?}");
        let few = ratio([&base[..3], &[1.0; 3]], [&now, &[1.0; 25]]).unwrap();
        assert_eq!(few.range, [0.0, f64::INFINITY]);
        assert!(ratio([&[], &[]], [&now, &[1.0; 25]]).is_none());
    }

    #[test]
    fn medians() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert!(median(&[]).is_nan());
    }
}
