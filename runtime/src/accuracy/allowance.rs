//! What an adapter's arithmetic takes from declared bounds. Those hold where quotients and roots are rounded correctly and
//! subnormal numbers are kept. Vulkan promises neither (specification, "Precision and Operation of SPIR-V Instructions"):
//! quotients may be off by 2.5 ulp for divisors from 2⁻¹²⁶ to 2¹²⁶ and by anything beyond, and subnormal numbers may be zero.

use pullback_compiler::table::Bound;

use super::error::Format;
use super::subjects::Subject;
use super::tables::{Case, Expected};
use crate::capabilities::{Arithmetic, Capabilities};

/// The reciprocal of a divisor above this is subnormal.
const GREATEST_DIVISOR: f64 = (1u128 << 126) as f64;
/// Below this, what matters to a result may be subnormal: a term that is 24 or 48 bits smaller.
const LEAST_SINGLE: f64 = (1u64 << 24) as f64 * f32::MIN_POSITIVE as f64;
const LEAST_OF_PAIRS: f64 = (1u64 << 48) as f64 * f32::MIN_POSITIVE as f64;

/// What is taken from the bounds of one format on one adapter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Allowance {
    /// Units that are added to a bound, for functions that have a quotient and a root one after the other.
    pub units: f64,
    /// Whether subnormal numbers are lost.
    pub flushes: bool,
}

impl Allowance {
    /// What the probe found about the adapter.
    #[must_use]
    pub fn of(found: &Capabilities, format: Format) -> Self {
        let arithmetic = match format {
            Format::Single | Format::Pair => Some(&found.single),
            Format::Double => found.double.as_ref(),
        };
        let Some(arithmetic) = arithmetic else {
            return Self::default();
        };
        let units = match format {
            Format::Pair => excess_of_pairs(arithmetic),
            Format::Single | Format::Double => excess(arithmetic),
        };
        let special = &arithmetic.special;
        Self {
            units,
            flushes: !special.subnormal_results.is_empty()
                || !special.subnormal_arguments.is_empty(),
        }
    }

    /// A bound with what is added, rounded up to a tenth.
    #[must_use]
    pub fn raised(self, bound: Bound) -> Bound {
        // what is exact has no quotient
        if bound.units == 0.0 {
            return bound;
        }
        Bound {
            units: ((bound.units + self.units) * 10.0).ceil() / 10.0,
            ..bound
        }
    }

    /// The subject with only those cases and numbers that the adapter can be asked for.
    #[must_use]
    pub fn fair(self, mut subject: Subject, format: Format) -> Subject {
        if !self.flushes || format == Format::Double {
            return subject;
        }
        let least = match format {
            Format::Pair => LEAST_OF_PAIRS,
            Format::Single | Format::Double => LEAST_SINGLE,
        };
        subject.cases.retain(is_normal);
        for case in &mut subject.cases {
            for number in case.value.iter_mut().chain(&mut case.derivative) {
                if !is_plain(number, least) {
                    *number = Expected::Unstated;
                }
            }
        }
        subject
    }

    /// In words, for reports; empty where nothing is taken.
    #[must_use]
    pub fn words(self) -> String {
        let mut parts = Vec::new();
        if self.units > 0.0 {
            parts.push(format!(
                "bounds are {:.1} units wider, for its quotients and roots are not rounded correctly",
                self.units
            ));
        }
        if self.flushes {
            parts.push(
                "what is made of subnormal numbers, or of divisors above 2¹²⁶, is not judged"
                    .to_owned(),
            );
        }
        parts.join("; ")
    }
}

/// Twice what quotients and roots are off by beyond a half ulp.
fn excess(found: &Arithmetic) -> f64 {
    let rounding = &found.rounding;
    if rounding.is_correct() {
        return 0.0;
    }
    let beyond = |ulps: f64| (ulps - 0.5).max(0.0);
    2.0 * (beyond(rounding.quotient) + beyond(rounding.root))
}

/// A quotient of pairs is that of the upper words and a quotient of its rest: off by the product of what both are off by,
/// in units of 2⁻⁴⁸ four times the square of the ulps; a root likewise.
fn excess_of_pairs(found: &Arithmetic) -> f64 {
    let rounding = &found.rounding;
    if rounding.is_correct() {
        return 0.0;
    }
    let beyond = |ulps: f64| 4.0 * (ulps * ulps - 0.25).max(0.0);
    beyond(rounding.quotient) + beyond(rounding.root)
}

/// Whether no argument is subnormal or has a subnormal reciprocal, and no result is too large for a divisor.
fn is_normal(case: &Case) -> bool {
    // a quarter of an argument is normal, too
    let least = 4.0 * f64::from(f32::MIN_POSITIVE);
    let plain =
        |x: f64| x == 0.0 || !x.is_finite() || (least..=GREATEST_DIVISOR).contains(&x.abs());
    let small = |e: &Expected| match e {
        Expected::Number { value, .. } => !value.is_finite() || value.abs() <= GREATEST_DIVISOR,
        Expected::Unstated => true,
    };
    let arguments = case.args.iter().chain(&case.params);
    arguments.copied().all(plain) && case.value.iter().all(small)
}

/// Whether nothing that a result of this size is made of need be subnormal or have a subnormal reciprocal.
fn is_plain(expected: &Expected, least: f64) -> bool {
    match expected {
        Expected::Number { value, .. } if *value != 0.0 && value.is_finite() => {
            (least..=GREATEST_DIVISOR).contains(&value.abs())
        }
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capabilities::tests::ideal;
    use pullback_compiler::table::Metric;

    const BOUND: Bound = Bound {
        units: 2.0,
        metric: Metric::Norm,
    };

    #[test]
    fn correct_arithmetic_is_allowed_nothing() {
        for format in [Format::Single, Format::Pair, Format::Double] {
            let none = Allowance::of(&ideal(), format);
            assert_eq!(none, Allowance::default());
            assert_eq!(none.raised(BOUND), BOUND);
            assert_eq!(none.words(), "");
        }
    }

    #[test]
    fn wide_quotients_and_lost_subnormals_are_allowed() {
        let mut found = ideal();
        found.single.rounding.quotient = 2.0;
        found.single.rounding.root = 1.0;
        found.single.special.subnormal_results.push("x".into());
        let single = Allowance::of(&found, Format::Single);
        assert_eq!(single.raised(BOUND).units, 6.0);
        assert_eq!(
            single
                .raised(Bound {
                    units: 0.0,
                    ..BOUND
                })
                .units,
            0.0
        );
        assert!(single.flushes);
        let pair = Allowance::of(&found, Format::Pair);
        assert_eq!(pair.units, 15.0 + 3.0);
        assert!(pair.flushes);
        assert_eq!(Allowance::of(&found, Format::Double), Allowance::default());
    }

    #[test]
    fn only_what_can_be_asked_for_is_judged() {
        let number = |value| Expected::Number {
            value,
            rest: 0.0,
            signed: true,
        };
        let case = |x: f64, value: f64| Case {
            args: vec![x],
            params: Vec::new(),
            value: vec![number(value), number(1.0)],
            derivative: vec![number(1e-40)],
            notes: "",
        };
        let mut subject = super::super::subjects::subjects().unwrap().remove(0);
        subject.cases = vec![
            case(1.0, 1.0),
            case(1e-40, 1.0),
            case(1e38, 1.0),
            case(0.0, 2e-38),
            case(f64::INFINITY, 0.0),
            case(1.0, 2e38),
        ];
        let lost = Allowance {
            units: 0.0,
            flushes: true,
        };
        let fair = lost.fair(subject.clone(), Format::Single);
        let values: Vec<Expected> = fair.cases.iter().map(|c| c.value[0]).collect();
        assert_eq!(values, [number(1.0), Expected::Unstated, number(0.0)]);
        assert!(fair.cases.iter().all(|c| c.value[1] == number(1.0)));
        assert!(
            fair.cases
                .iter()
                .all(|c| c.derivative[0] == Expected::Unstated)
        );
        let kept = Allowance::default().fair(subject.clone(), Format::Single);
        assert_eq!(kept.cases.len(), subject.cases.len());
    }
}
