//! The hash of lattice points: exact values, and whether it looks like chance. Everything is deterministic; a truly
//! random function would exceed some of the limits in less than one of a thousand trials.

use crate::reference::hash::hash;

const TABLE: &str = include_str!("../../../../tests/data/functions/hash.tsv");

#[test]
fn values_are_those_of_the_table() {
    let rows = TABLE.lines().filter(|l| !l.starts_with('#'));
    let mut count = 0;
    for row in rows {
        let cells: Vec<f64> = row.split('\t').map(|c| c.parse().unwrap()).collect();
        assert_eq!(hash(&cells[..4]) * 16_777_216.0, cells[4], "{row}");
        count += 1;
    }
    assert_eq!(count, 200);
}

#[test]
fn coordinates_are_rounded_down_and_zeros_are_alike() {
    assert_eq!(
        hash(&[-0.25, 1.75, -0.0, 3.0]),
        hash(&[-1.0, 1.0, 0.0, 3.0])
    );
    assert_eq!(hash(&[-1e-45, 0.0, 0.0, 0.0]), hash(&[-1.0, 0.0, 0.0, 0.0]));
    assert_ne!(hash(&[1e30, 0.0, 0.0, 0.0]), hash(&[2e30, 0.0, 0.0, 0.0]));
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        for place in 0..4 {
            let mut point = [1.0; 4];
            point[place] = wrong;
            assert!(hash(&point).is_nan());
        }
    }
}

/// Lattice points along each axis, about a diagonal, and in blocks near and far from the origin.
fn lattices() -> Vec<(&'static str, Vec<[f64; 4]>)> {
    let line = |axis: usize| {
        let mut at = [0.0; 4];
        (-32_768..32_768).map(move |k| {
            at[axis] = f64::from(k);
            at
        })
    };
    let block = |from: f64| {
        (0..65_536).map(move |k: u32| {
            let digit = |shift: u32| from + f64::from((k >> shift) & 15);
            [digit(0), digit(4), digit(8), digit(12)]
        })
    };
    let diagonal = (0..65_536).map(|k| [f64::from(k), f64::from(-k), f64::from(k), 0.0]);
    vec![
        ("x", line(0).collect()),
        ("y", line(1).collect()),
        ("z", line(2).collect()),
        ("w", line(3).collect()),
        ("near", block(-8.0).collect()),
        ("far", block(1_000_000.0).collect()),
        ("diagonal", diagonal.collect()),
    ]
}

/// Mean 1/2 and variance 1/12 to 5 standard deviations; 256 classes equally full by χ² (255 degrees of freedom: standard
/// deviation 22.6).
#[test]
fn values_are_spread_evenly() {
    for (name, points) in lattices() {
        let n = points.len() as f64;
        let values: Vec<f64> = points.iter().map(|p| hash(p)).collect();
        let mean = values.iter().sum::<f64>() / n;
        assert!(
            (mean - 0.5).abs() < 5.0 * (1.0 / 12.0 / n).sqrt(),
            "{name}: {mean}"
        );
        let variance = values.iter().map(|v| (v - 0.5).powi(2)).sum::<f64>() / n;
        // the variance of (v - 1/2)² is 1/80 - 1/144 = 1/180
        let limit = 5.0 * (1.0 / 180.0 / n).sqrt();
        assert!((variance - 1.0 / 12.0).abs() < limit, "{name}: {variance}");
        // the first and the last eight bits
        for scale in [256.0, 16_777_216.0] {
            let mut classes = [0.0; 256];
            for v in &values {
                classes[(v * scale) as usize % 256] += 1.0;
            }
            let expected = n / 256.0;
            let chi: f64 = classes
                .iter()
                .map(|c| (c - expected) * (c - expected) / expected)
                .sum();
            assert!((chi - 255.0).abs() < 5.0 * 22.6, "{name}: χ² = {chi}");
        }
    }
}

/// Neighbours along each axis are uncorrelated, to 5 standard deviations.
#[test]
fn neighbours_are_uncorrelated() {
    for (name, points) in lattices() {
        for axis in 0..4 {
            let n = points.len() as f64;
            let product = |p: &[f64; 4]| {
                let mut next = *p;
                next[axis] += 1.0;
                (hash(p) - 0.5) * (hash(&next) - 0.5)
            };
            let correlation = 12.0 * points.iter().map(product).sum::<f64>() / n;
            assert!(
                correlation.abs() < 5.0 / n.sqrt(),
                "{name}, {axis}: {correlation}"
            );
        }
    }
}

/// A change of one bit of a coordinate changes each bit of the value in half of the cases (avalanche): 24 bits by 4
/// coordinates by 20 bits of theirs, each over 4096 points, to 6 standard deviations.
#[test]
fn every_bit_depends_on_every_bit() {
    let word = |p: &[f64; 4]| (hash(p) * 16_777_216.0) as u32;
    let points: Vec<[f64; 4]> = (0..4096_u32)
        .map(|k| [k, 3 * k + 1, 7 * k + 2, 5 * k].map(f64::from))
        .collect();
    for axis in 0..4 {
        for bit in 0..20 {
            let mut flips = [0_u32; 24];
            for p in &points {
                let mut other = *p;
                other[axis] = f64::from(p[axis] as u32 ^ (1 << bit));
                let change = word(p) ^ word(&other);
                for (k, flip) in flips.iter_mut().enumerate() {
                    *flip += (change >> k) & 1;
                }
            }
            for (k, flip) in flips.iter().enumerate() {
                let share = f64::from(*flip) / 4096.0;
                assert!(
                    (share - 0.5).abs() < 6.0 / 128.0,
                    "axis {axis}, bit {bit} to {k}: {share}"
                );
            }
        }
    }
}
