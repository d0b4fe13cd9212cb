//! Real roots of a polynomial on an interval: those of its derivative separate them, and so on down to a line. Between two
//! neighbours the polynomial is monotonic, and bisection finds the one root or none.

use std::f64::consts::PI;

/// A polynomial on -1..1 by its coefficients in Chebyshev polynomials (Trefethen, "Approximation Theory and Approximation
/// Practice", 2013).
#[derive(Clone, Debug)]
pub struct Series(Vec<f64>);

/// A root, or a place where the polynomial is zero to rounding without changing its sign for sure.
#[derive(Clone, Copy, Debug)]
pub struct Root {
    pub at: f64,
    pub crosses: bool,
}

impl Series {
    /// The polynomial of this degree that has the values of `f`, from its values at the Chebyshev nodes.
    pub fn fitted(degree: usize, mut f: impl FnMut(f64) -> f64) -> Self {
        let n = degree + 1;
        let angles: Vec<f64> = (0..n).map(|j| PI * (j as f64 + 0.5) / n as f64).collect();
        let values: Vec<f64> = angles.iter().map(|a| f(a.cos())).collect();
        let coefficient = |k: usize| {
            let terms = values.iter().zip(&angles);
            let sum: f64 = terms.map(|(v, a)| v * (k as f64 * a).cos()).sum();
            sum * if k == 0 { 1.0 } else { 2.0 } / n as f64
        };
        Self((0..n).map(coefficient).collect())
    }

    /// The value, by Clenshaw's recurrence.
    pub fn at(&self, x: f64) -> f64 {
        let (mut b, mut c) = (0.0, 0.0);
        for a in self.0.iter().skip(1).rev() {
            (b, c) = (a + 2.0 * x * b - c, b);
        }
        self.0[0] + x * b - c
    }

    /// Sum of the coefficients' absolute values, a bound of the polynomial.
    pub fn size(&self) -> f64 {
        self.0.iter().map(|a| a.abs()).sum()
    }

    fn derivative(&self) -> Self {
        let n = self.0.len();
        let mut out = vec![0.0; n + 1];
        for k in (1..n).rev() {
            out[k - 1] = out[k + 1] + 2.0 * k as f64 * self.0[k];
        }
        out[0] *= 0.5;
        out.truncate((n - 1).max(1));
        Self(out)
    }

    /// Where it is zero, in ascending order. What is below `noise` is zero at an extremum.
    pub fn roots(&self, noise: f64) -> Vec<Root> {
        let mut chain = vec![self.clone()];
        while chain[chain.len() - 1].0.len() > 2 {
            chain.push(chain[chain.len() - 1].derivative());
        }
        let mut places: Vec<f64> = Vec::new();
        while let Some(series) = chain.pop() {
            if chain.is_empty() {
                return series.between(&places, noise);
            }
            places = series.between(&places, 0.0).iter().map(|r| r.at).collect();
        }
        Vec::new()
    }

    /// Roots, given the places where the derivative is zero.
    fn between(&self, places: &[f64], noise: f64) -> Vec<Root> {
        let mut ends = vec![-1.0];
        ends.extend(places);
        ends.push(1.0);
        let mut out: Vec<Root> = Vec::new();
        for (k, pair) in ends.windows(2).enumerate() {
            let values = [self.at(pair[0]), self.at(pair[1])];
            let inner = k > 0;
            if inner && values[0].abs() <= noise {
                out.push(Root {
                    at: pair[0],
                    crosses: false,
                });
            }
            if (values[0] < 0.0) != (values[1] < 0.0) {
                let sure = (inner && values[0].abs() <= noise) || values[1].abs() <= noise;
                out.push(Root {
                    at: self.bisected(pair[0], pair[1]),
                    crosses: !sure,
                });
            }
        }
        out
    }

    fn bisected(&self, mut low: f64, mut high: f64) -> f64 {
        let negative = self.at(low) < 0.0;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (self.at(middle) < 0.0) == negative {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

#[test]
fn planted_roots_are_found() {
    let planted = [-0.9, -0.31, -0.3, 0.2, 0.75];
    let f = |x: f64| planted.iter().map(|r| x - r).product::<f64>() * (x * x + 0.01);
    let series = Series::fitted(7, f);
    let roots = series.roots(1e-14);
    assert_eq!(roots.len(), planted.len(), "{roots:?}");
    for (root, planted) in roots.iter().zip(planted) {
        assert!(
            (root.at - planted).abs() < 1e-11 && root.crosses,
            "{root:?}"
        );
    }
}

#[test]
fn a_double_root_is_no_crossing() {
    let series = Series::fitted(4, |x| (x - 0.25) * (x - 0.25) * (x * x + 1.0));
    let roots = series.roots(1e-14);
    assert!(
        !roots.is_empty() && roots.iter().all(|r| !r.crosses),
        "{roots:?}"
    );
    assert!(Series::fitted(4, |x| x * x + 1e-3).roots(1e-14).is_empty());
}
