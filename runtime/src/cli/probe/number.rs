//! Numbers of a trace, as people read them.

use pullback_runtime::trace::{Shape, Value};

/// A value in the digits of its format.
pub(super) fn written(shape: Shape, value: Value) -> String {
    let all: Vec<String> = value.numbers().iter().map(|&x| one(shape, x)).collect();
    match all.len() {
        1 => all.concat(),
        _ => format!("({})", all.join(", ")),
    }
}

pub(super) fn one(shape: Shape, x: f64) -> String {
    match shape {
        Shape::Truth => (x != 0.0).to_string(),
        Shape::Word | Shape::Integer => x.to_string(),
        Shape::Single(_) | Shape::Pair | Shape::Double => real(x),
    }
}

/// The fewest digits that tell a number from its neighbours: those of single precision where it is one.
pub(super) fn real(x: f64) -> String {
    let single = x as f32;
    let plain = x == 0.0 || !x.is_finite() || (1e-4..1e7).contains(&x.abs());
    match (f64::from(single) == x || x.is_nan(), plain) {
        (true, true) => single.to_string(),
        (true, false) => format!("{single:e}"),
        (false, true) => x.to_string(),
        (false, false) => format!("{x:e}"),
    }
}

/// A distance in units in the last place.
pub(super) fn units(ulps: f64) -> String {
    if ulps == 0.0 {
        "0".into()
    } else if !ulps.is_finite() {
        "∞".into()
    } else if !(0.01..1e5).contains(&ulps) {
        format!("{ulps:.0e}")
    } else if ulps < 10.0 {
        format!("{ulps:.2}")
    } else {
        format!("{ulps:.0}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers() {
        assert_eq!(real(f64::from(0.1f32)), "0.1");
        assert_eq!(real(0.1), "0.1");
        assert_eq!(real(0.1 + 0.2), "0.30000000000000004");
        assert_eq!(real(f64::from(1e-40f32)), "1e-40");
        assert_eq!(real(-0.0), "-0");
        assert_eq!(real(f64::NAN), "NaN");
        assert_eq!(real(f64::NEG_INFINITY), "-inf");
        assert_eq!(real(1e300), "1e300");
        assert_eq!(written(Shape::Truth, Value::new(&[1.0])), "true");
        assert_eq!(
            written(Shape::Single(2), Value::new(&[1.0, 2.5])),
            "(1, 2.5)"
        );
        assert_eq!(
            [0.0, 0.5, 25.0, 3e7, f64::INFINITY].map(units),
            ["0", "0.50", "25", "3e7", "∞"]
        );
    }
}
