//! The points at which a machine is judged: the cases of the tables that its format can hold, and many points that no
//! table has, where the `f64` reference, which the tables hold to its bounds, says what is right.

use pullback_compiler::What;
use pullback_compiler::table::Derivative;

use super::error::{Format, OVERFLOW};
use super::evaluators::{Machine, Point};
use super::measure::demand;
use super::random::{Random, Spread};
use super::subjects::{Subject, formula};
use super::tables::{Case, Domain, Expected, WIDE};

/// Beyond this the complex gamma function of the shader library is NaN (docs/numerics.md).
const GAMMA_FAR: f64 = 1e30;
/// The remark of a case of a sweep.
pub const NOTE: &str = "sweep";
/// Runs of points with the same parameters: each is a dispatch.
const RUNS: usize = 4;

/// Below this magnitude the lower word of a pair is subnormal, and flushed: docs/numerics.md.
const LEAST_OF_PAIRS: f64 = 1.0 / (1u128 << 80) as f64;

/// Whether a format has all its digits for the arguments of a case. Of complex numbers those in tables are not asked: a part
/// far below the other is what makes them hard.
#[must_use]
pub fn has_digits(subject: &Subject, format: Format, case: &Case) -> bool {
    // a power in a divisor has to have them, too: x³ of a derivative
    let least = match subject.word {
        "inverse_square" => LEAST_OF_PAIRS.cbrt(),
        _ => LEAST_OF_PAIRS,
    };
    let enough = |x: &f64| *x == 0.0 || x.is_nan() || x.abs() >= least;
    let table = subject.domain == Domain::Complex && case.notes != NOTE;
    format != Format::Pair || table || case.args.iter().all(enough)
}

/// A subject with the cases that a machine is judged by. `each` random points are of every size that float32 has, as
/// many are of about 1, and as many close to whole and half numbers. For `f64` there are none: nothing better than
/// the tables could judge them.
///
/// # Errors
/// The reference cannot evaluate it; in words.
pub fn judged_by(subject: &Subject, machine: &Machine, each: usize) -> Result<Subject, String> {
    let format = machine.format();
    let holds = |case: &&Case| format != Format::Single || case.notes != WIDE;
    let mut cases: Vec<Case> = subject.cases.iter().filter(holds).cloned().collect();
    if format != Format::Double {
        cases.extend(swept(subject, format, each)?);
    }
    cases.retain(|case| has_digits(subject, format, case));
    Ok(Subject {
        cases,
        ..subject.clone()
    })
}

fn swept(subject: &Subject, format: Format, each: usize) -> Result<Vec<Case>, String> {
    let points = points(subject, format, each)?;
    let formula = formula(&subject.source)?;
    let columns = formula.ty.columns();
    let what = match subject.row.derivative {
        Derivative::Missing => What::Value,
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
    Ok(points.into_iter().zip(results).map(case).collect())
}

/// Random arguments of a function.
///
/// # Errors
/// It has no case that says how many there are; in words.
pub fn points(subject: &Subject, format: Format, each: usize) -> Result<Vec<Point>, String> {
    let first = subject.cases.first().ok_or("no cases")?;
    let params = subject.cases.iter().map(|c| c.params.len()).max();
    let mut random = Random::default();
    let mut number = |spread: Spread| match format {
        Format::Pair => random.pair(spread),
        Format::Single | Format::Double => random.single(spread),
    };
    let mut points = Vec::new();
    for spread in Spread::ALL {
        let mut values = Vec::new();
        for k in 0..each {
            if k % (each / RUNS).max(1) == 0 {
                values = (0..params.unwrap_or(0))
                    .map(|_| number(Spread::Ordinary))
                    .collect();
            }
            let args: Vec<f64> = first.args.iter().map(|_| number(spread)).collect();
            if is_beyond(subject, &args, &values) {
                continue;
            }
            // here the reference is off by more than its bound: |w log z| ulps
            let far = format == Format::Pair && spread == Spread::Sizes;
            if subject.name() == "pow (complex)" && far {
                continue;
            }
            points.push(Point {
                args,
                params: values.clone(),
            });
        }
    }
    Ok(points)
}

/// Whether arguments are where nothing is promised (docs/numerics.md, known limits).
fn is_beyond(subject: &Subject, args: &[f64], params: &[f64]) -> bool {
    match (subject.word, args, params) {
        ("gamma", args, _) => args.iter().any(|x| x.abs() > GAMMA_FAR),
        // a c - b d overflows in a term and not as a whole
        ("mul", &[a, b], &[c, d]) => a.hypot(b) * c.hypot(d) > OVERFLOW,
        // the derivative by c is about 1/c², a difference of subnormal numbers
        ("gaussmassx", &[c, _], _) => c.abs() > 1e15,
        // a remainder may be subnormal, and counts as 0
        ("mod", &[_, b], _) => b.abs() < 1e-30 && b != 0.0,
        _ => false,
    }
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
        rest: 0.0,
        signed: value.abs() > 1.0,
    }
}
