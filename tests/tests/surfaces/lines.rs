//! The 27 lines of Clebsch's diagonal cubic. In five coordinates of sum 0, of which the fourth is 1 in the program and the fifth
//! is minus the sum of the others, the surface is Σ xₖ³ = 0, and the lines are the images of two under all permutations.

use crate::program::Subject;

/// (a, -a, b, -b, 0): 15 lines.
fn of_fifteen(a: f64, b: f64) -> [f64; 5] {
    [a, -a, b, -b, 0.0]
}

/// 12 lines, the double six: Hilbert and Cohn-Vossen, "Anschauliche Geometrie", § 25.
fn of_twelve(a: f64, b: f64) -> [f64; 5] {
    let phi = 0.5 + 1.25f64.sqrt();
    [a, b, -(phi * a + b), -(a + phi * b), phi * (a + b)]
}

fn permutations(n: usize) -> Vec<Vec<usize>> {
    if n == 0 {
        return vec![Vec::new()];
    }
    let shorter = permutations(n - 1);
    let with = |p: &Vec<usize>| {
        let insert = |k: usize| {
            let mut longer = p.clone();
            longer.insert(k, n - 1);
            longer
        };
        (0..n).map(insert).collect::<Vec<_>>()
    };
    shorter.iter().flat_map(with).collect()
}

/// Plücker's coordinates of the line through two points, of length 1 and with the first that is not 0 positive.
fn line_through(p: &[f64], q: &[f64]) -> [f64; 6] {
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    let line = pairs.map(|(j, k)| p[j] * q[k] - p[k] * q[j]);
    let length = line.iter().map(|c| c * c).sum::<f64>().sqrt();
    let first = line.iter().find(|c| c.abs() > 1e-9 * length);
    let sign = first.map_or(1.0, |c| c.signum());
    line.map(|c| sign * c / length)
}

#[test]
fn clebsch_holds_27_lines() {
    let f = Subject::of("clebsch").polynomial(&[]);
    let mut lines: Vec<[f64; 6]> = Vec::new();
    for family in [of_fifteen, of_twelve] {
        for order in permutations(5) {
            let at = |a: f64, b: f64| {
                let p = family(a, b);
                [0, 1, 2, 3].map(|k| p[order[k]])
            };
            for (a, b) in [(0.3, 1.1), (-0.7, 0.2), (1.9, -0.45)] {
                let [x, y, z, w] = at(a, b);
                // At infinity there is nothing to evaluate.
                if w != 0.0 {
                    let there = f.at([x / w, y / w, z / w]);
                    assert!(there.value.abs() <= 1e-13 * there.size, "{there:?}");
                }
            }
            let line = line_through(&at(1.0, 0.25), &at(-0.5, 1.0));
            let same = |other: &[f64; 6]| line.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-9);
            if !lines.iter().any(same) {
                lines.push(line);
            }
        }
    }
    assert_eq!(lines.len(), 27);
}
