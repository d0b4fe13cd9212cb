//! Where two traces of one shader part.

use super::relevance::relevant;
use super::site::{Shape, Site, Trace, Value, What};

/// Where two traces part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Parting {
    /// A value differs by more than is allowed; all before agree.
    Value {
        /// Index of its event in both traces.
        event: usize,
        /// Index of its site.
        site: usize,
        /// What each has there.
        values: [Value; 2],
        /// By how many units in the last place.
        ulps: f64,
    },
    /// The shader goes on elsewhere, though no value differs by more than is allowed.
    Way {
        /// Index of the first event that is of another site.
        event: usize,
        /// Index of the last site that both told.
        site: usize,
    },
}

impl Parting {
    /// Index of the site.
    #[must_use]
    pub fn site(&self) -> usize {
        match *self {
            Self::Value { site, .. } | Self::Way { site, .. } => site,
        }
    }
}

/// The first place where traces part: a value that differs by more than `ulps` units in the last place, or another way.
/// A value that is not chosen, or whose error later operations swallow, does not count. The second trace is the one that
/// counts as true. A truth value or whole number differs if it is not the same.
#[must_use]
pub fn parting(sites: &[Site], traces: [&Trace; 2], ulps: f64) -> Option<Parting> {
    let [a, b] = traces.map(|trace| trace.events.as_slice());
    let together = a
        .iter()
        .zip(b)
        .take_while(|(x, y)| x.site == y.site)
        .count();
    let distances: Vec<f64> = a
        .iter()
        .zip(b)
        .take(together)
        .map(|(x, y)| {
            let site = sites.get(x.site);
            site.map_or(0.0, |site| distance(site.shape, x.value, y.value))
        })
        .collect();
    let parted: Vec<bool> = distances.iter().map(|&found| found > ulps).collect();
    let relevant = relevant(sites, &b[..together], &parted);
    if let Some(event) = relevant.iter().position(|&is| is) {
        return Some(Parting::Value {
            event,
            site: b[event].site,
            values: [a[event].value, b[event].value],
            ulps: distances[event],
        });
    }
    let is_cut = traces.iter().any(|trace| trace.is_cut);
    let ends =
        together == a.len() && together == b.len() || is_cut && together == a.len().min(b.len());
    (!ends).then(|| Parting::Way {
        event: together,
        site: together.checked_sub(1).map_or(0, |last| b[last].site),
    })
}

/// The greatest distance of the components of two values, in units in the last place of the second one's format: 2⁻²³
/// of the power of two below the number, subnormals included, and for doubles 2⁻⁵². Infinite where one is a number and
/// the other is not, or where one is another whole number or truth value.
#[must_use]
pub fn distance(shape: Shape, a: Value, b: Value) -> f64 {
    let pairs = a.numbers().iter().zip(b.numbers());
    pairs
        .map(|(&a, &b)| match shape {
            Shape::Single(_) => units(a, b, SINGLE),
            Shape::Pair => units(a, b, PAIR),
            Shape::Double => units(a, b, DOUBLE),
            Shape::Word | Shape::Integer | Shape::Truth if a == b => 0.0,
            Shape::Word | Shape::Integer | Shape::Truth => f64::INFINITY,
        })
        .fold(0.0, f64::max)
}

/// Digits of a format: bits behind the first, exponent of the least unit, and the greatest number.
struct Digits {
    bits: i32,
    least: i32,
    largest: f64,
}

const SINGLE: Digits = Digits {
    bits: 23,
    least: -149,
    largest: f32::MAX as f64,
};
const PAIR: Digits = Digits {
    bits: 47,
    least: -149,
    largest: f32::MAX as f64,
};
const DOUBLE: Digits = Digits {
    bits: 52,
    least: -1074,
    largest: f64::MAX,
};

fn units(a: f64, b: f64, digits: Digits) -> f64 {
    // what overflows in the format counts as infinite
    let limited = |x: f64| {
        if x.abs() > digits.largest {
            f64::INFINITY.copysign(x)
        } else {
            x
        }
    };
    let (a, b) = (limited(a), limited(b));
    if a == b || a.is_nan() && b.is_nan() {
        return 0.0;
    }
    if !(a.is_finite() && b.is_finite()) {
        return f64::INFINITY;
    }
    // the scale is that of the true value, or of the format's least number
    let exponent = if b == 0.0 {
        digits.least
    } else {
        (exponent(b) - digits.bits).max(digits.least)
    };
    (scaled(a, exponent) - scaled(b, exponent)).abs()
}

fn exponent(x: f64) -> i32 {
    let (x, shift) = if x.is_subnormal() {
        (x * 2f64.powi(64), -64)
    } else {
        (x, 0)
    };
    (x.to_bits() >> 52 & 0x7ff) as i32 - 1023 + shift
}

/// x / 2^exponent, in steps that do not overflow by themselves.
fn scaled(x: f64, exponent: i32) -> f64 {
    let half = -exponent / 2;
    x * 2f64.powi(half) * 2f64.powi(-exponent - half)
}

/// One row of a table of traces: what a site told in each.
#[derive(Clone, Debug)]
pub struct Row {
    /// Index of the site.
    pub site: usize,
    /// Its events in each trace, in order.
    pub values: Vec<Vec<Value>>,
}

/// The sites in the order in which they first told something in any trace, with what they told.
#[must_use]
pub fn rows(sites: &[Site], traces: &[&Trace]) -> Vec<Row> {
    let mut place: Vec<Option<usize>> = vec![None; sites.len()];
    let mut rows: Vec<Row> = Vec::new();
    for (column, trace) in traces.iter().enumerate() {
        for event in &trace.events {
            let Some(slot) = place.get_mut(event.site) else {
                continue;
            };
            let at = *slot.get_or_insert_with(|| {
                rows.push(Row {
                    site: event.site,
                    values: vec![Vec::new(); traces.len()],
                });
                rows.len() - 1
            });
            rows[at].values[column].push(event.value);
        }
    }
    rows
}

impl Site {
    /// Whether it tells something with a name, rather than an operation on the way.
    #[must_use]
    pub fn is_named(&self) -> bool {
        self.what != What::Operation
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn real(x: f64) -> Value {
        Value::new(&[x])
    }

    #[test]
    fn distances() {
        let check = |a: f64, b: f64, expected: f64| {
            let found = distance(Shape::Single(1), real(a), real(b));
            assert_eq!(found, expected, "{a} and {b}");
        };
        let ulp = 2f64.powi(-23);
        check(1.0 + ulp, 1.0, 1.0);
        check(1.0, 1.0 + 0.25 * ulp, 0.25);
        check(-2.0 - 6.0 * ulp, -2.0, 3.0);
        check(0.0, 1e-40, 1e-40 / 2f64.powi(-149));
        check(2f64.powi(-149), 0.0, 1.0);
        check(-0.0, 0.0, 0.0);
        check(f64::NAN, f64::NAN, 0.0);
        check(f64::INFINITY, 1e39, 0.0);
        check(f64::NEG_INFINITY, 1e39, f64::INFINITY);
        check(f64::NAN, 1.0, f64::INFINITY);
        let wide = distance(Shape::Double, real(1.0 + 2f64.powi(-52)), real(1.0));
        assert_eq!(wide, 1.0);
        assert_eq!(distance(Shape::Truth, real(1.0), real(0.0)), f64::INFINITY);
        let vector = distance(
            Shape::Single(2),
            Value::new(&[1.0, 2.0 + 4.0 * ulp]),
            Value::new(&[1.0, 2.0]),
        );
        assert_eq!(vector, 2.0);
    }
}
