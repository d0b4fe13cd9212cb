//! Many points that no table has: the GPU against the `f64` reference, which the tables hold.

use pullback_compiler::table::Derivative;

use super::error::OVERFLOW;
use super::evaluators::{Machine, Point};
use super::measure::demand;
use super::subjects::{Subject, formula};
use super::tables::{Case, Expected};

/// Points of each kind.
const EACH: usize = 600;
/// Beyond this the complex gamma function of the shader library is NaN (docs/numerics.md).
const GAMMA_FAR: f64 = 1e30;
/// The remark of a case of a sweep.
pub const NOTE: &str = "sweep";

/// A subject with more cases: random points with the answers of the `f64` reference. They are of every size that
/// float32 has, of about 1, and close to whole and half numbers.
///
/// # Errors
/// The reference cannot evaluate it; in words.
pub fn sweep(subject: &Subject) -> Result<Subject, String> {
    let first = subject.cases.first().ok_or("no cases")?;
    let second = subject
        .cases
        .iter()
        .map(|c| c.params.len())
        .max()
        .unwrap_or(0);
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut points = Vec::new();
    for kind in 0..3 {
        // parameters stay for a while: each change is a dispatch
        let mut params = Vec::new();
        for k in 0..EACH {
            if k % (EACH / 4) == 0 {
                params = (0..second).map(|_| random.number(1)).collect();
            }
            let args: Vec<f64> = first.args.iter().map(|_| random.number(kind)).collect();
            if subject.word == "gamma" && args.iter().any(|x| x.abs() > GAMMA_FAR) {
                continue;
            }
            points.push(Point {
                args,
                params: params.clone(),
            });
        }
    }
    let formula = formula(&subject.source);
    let columns = formula.ty.columns();
    let what = match subject.row.derivative {
        Derivative::Missing => pullback_compiler::What::Value,
        _ => demand(subject),
    };
    let results = Machine::Reference.run(&formula, what, &points)?;
    let case = |(point, result): (Point, Vec<f64>)| {
        let value: Vec<Expected> = result[..columns].iter().map(|&v| expected(v)).collect();
        // a NaN has no derivative
        let known = result[..columns].iter().all(|v| !v.is_nan());
        let slopes = result[columns..].iter().filter(|_| known);
        let derivative = slopes.map(|&v| expected(v)).collect();
        Case {
            args: point.args,
            params: point.params,
            value,
            derivative,
            notes: NOTE,
        }
    };
    let cases = points.into_iter().zip(results).map(case);
    Ok(Subject {
        cases: subject.cases.iter().cloned().chain(cases).collect(),
        source: subject.source.clone(),
        ..*subject
    })
}

/// The signs of numbers that vanish are left to the tables.
fn expected(value: f64) -> Expected {
    let value = if value.abs() >= OVERFLOW {
        value * f64::INFINITY
    } else {
        value
    };
    Expected::Number {
        value,
        signed: value.abs() > 1.0,
    }
}

/// Xorshift (G. Marsaglia, "Xorshift RNGs", 2003).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// In [0, 1).
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A normal float32.
    fn number(&mut self, kind: usize) -> f64 {
        let sign = if self.next() >> 63 == 0 { 1.0 } else { -1.0 };
        let size = match kind {
            0 => 2f64.powf(self.unit() * 253.0 - 126.0),
            1 => 8.0 * self.unit(),
            _ => (self.unit() * 9.0).floor() / 2.0 + 2f64.powf(-24.0 * self.unit()) * 0.5,
        };
        f64::from((sign * size.max(f64::from(f32::MIN_POSITIVE))) as f32)
    }
}
