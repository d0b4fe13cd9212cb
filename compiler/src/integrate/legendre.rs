//! Gauss-Legendre nodes and weights.

use std::f64::consts::PI;

/// One node of a rule on [-1, 1] that stands for itself and its mirror image; the middle node stands for itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Place in [0, 1].
    pub place: f64,
    /// Weight of the node, not of the pair.
    pub weight: f64,
}

/// The nodes with place ≥ 0 of the rule with `count` nodes, which is exact to degree 2 count - 1 and has positive
/// weights. Newton's method on the three-term recurrence from Tricomi's first guess; nodes and weights are right to
/// a few units of 10⁻¹⁶.
///
/// Davis and Rabinowitz, Methods of Numerical Integration, 2nd edition, section 2.7; NIST DLMF 3.5(v).
#[must_use]
pub fn gauss_legendre(count: usize) -> Vec<Node> {
    let count = count.max(1);
    let n = as_f64(count);
    let mut nodes = Vec::with_capacity(count.div_ceil(2));
    for k in 0..count / 2 {
        let mut x = (PI * (as_f64(k) + 0.75) / (n + 0.5)).cos();
        for _ in 0..8 {
            let (value, slope) = legendre(count, x);
            x -= value / slope;
        }
        let (_, slope) = legendre(count, x);
        nodes.push(Node {
            place: x,
            weight: 2.0 / ((1.0 - x * x) * slope * slope),
        });
    }
    if count % 2 == 1 {
        let (_, slope) = legendre(count, 0.0);
        nodes.push(Node {
            place: 0.0,
            weight: 2.0 / (slope * slope),
        });
    }
    nodes
}

/// P_n(x) and its derivative, |x| < 1.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut last, mut value) = (1.0, x);
    for k in 2..=n {
        let k = as_f64(k);
        (last, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * last) / k);
    }
    (value, as_f64(n) * (last - x * value) / (1.0 - x * x))
}

/// The smallest number of nodes with which the rule is right to `tolerance` for e^(λ s) p(s) on [-1, 1] with |λ| ≤
/// `size` and p of this degree, relative to the greatest value of e^|λ s| |p|: exact for the polynomial, and the
/// remainder of the exponential by its derivative of order 2n.
///
/// Error term: NIST DLMF 3.5.19.
#[must_use]
pub fn nodes_for_exponential(size: f64, degree: usize, tolerance: f64) -> usize {
    let mut count = 1;
    loop {
        let n = as_f64(count);
        // ln of size²ⁿ 2²ⁿ⁺¹ n!⁴ / ((2n + 1) (2n)!³)
        let remainder =
            2.0 * n * size.ln() + (2.0 * n + 1.0) * 2f64.ln() + 4.0 * ln_factorial(count)
                - (2.0 * n + 1.0).ln()
                - 3.0 * ln_factorial(2 * count);
        if remainder < tolerance.ln() || count >= 64 {
            return count + degree.div_ceil(2);
        }
        count += 1;
    }
}

fn ln_factorial(n: usize) -> f64 {
    (2..=n).map(|k| as_f64(k).ln()).sum()
}

#[allow(clippy::cast_precision_loss, reason = "counts of nodes are small")]
fn as_f64(n: usize) -> f64 {
    n as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ xᵏ over [-1, 1] is 2/(k + 1) for even k, to degree 2n - 1.
    #[test]
    fn powers_are_integrated_exactly() {
        for count in 1..=34 {
            let nodes = gauss_legendre(count);
            for power in (0..2 * count).step_by(2) {
                let pair = |node: &Node| {
                    let one = node.weight * node.place.powi(i32::try_from(power).unwrap());
                    if node.place == 0.0 { one } else { 2.0 * one }
                };
                let found: f64 = nodes.iter().map(pair).sum();
                let exact = 2.0 / (as_f64(power) + 1.0);
                assert!(
                    (found - exact).abs() < 4e-15,
                    "{count} nodes, x^{power}: {found}"
                );
            }
        }
    }

    #[test]
    fn enough_nodes_are_taken_for_an_exponential() {
        for size in [0.5, 1.0, 2.0, 4.0, 8.0_f64] {
            let nodes = gauss_legendre(nodes_for_exponential(size, 0, 1e-11));
            let pair = |node: &Node| {
                if node.place == 0.0 {
                    node.weight
                } else {
                    2.0 * node.weight * (size * node.place).cosh()
                }
            };
            let found: f64 = nodes.iter().map(pair).sum();
            let exact = 2.0 * size.sinh() / size;
            assert!(
                (found - exact).abs() < 1e-11 * size.exp(),
                "{size}: {found} {exact}"
            );
        }
    }
}
