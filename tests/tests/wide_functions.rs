//! Real functions of the operator table in the wide tiers, against the tables of references and the declared bounds.
//! The gamma family and complex functions take a shader compiler long in pairs; `pullback accuracy` measures those.

use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::bounds::{declared, violations};
use pullback_tests::accuracy::evaluators::{Machine, suite_gpu};
use pullback_tests::accuracy::measure::measure;
use pullback_tests::accuracy::subjects::subjects;
use pullback_tests::accuracy::tables::Domain;

/// Below this magnitude the lower word of a pair is subnormal, and flushed: docs/numerics.md.
const LEAST_OF_PAIRS: f64 = 1.0 / (1u128 << 80) as f64;

/// What `pullback accuracy` measures, and this suite does not.
const LONG: [&str; 4] = ["gamma", "lgamma", "digamma", "trigamma"];

fn check(precision: Precision) {
    let Some(gpu) = suite_gpu() else { return };
    assert!(gpu.has(precision), "the software adapter has every tier");
    let machine = Machine::Gpu(Box::new(gpu), precision);
    let mut found = Vec::new();
    for subject in &mut subjects() {
        if precision == Precision::Extended {
            let has_digits = |x: &f64| *x == 0.0 || x.is_nan() || x.abs() >= LEAST_OF_PAIRS;
            subject
                .cases
                .retain(|case| case.args.iter().all(has_digits));
        }
        if subject.domain != Domain::Real || LONG.contains(&subject.word) {
            continue;
        }
        let name = format!("{} in {}", subject.word, precision.name());
        match (measure(subject, &machine), declared(subject, &machine)) {
            (Ok(measured), Ok(bounds)) => {
                println!("{name}: {:.2}", measured.value[0].max());
                let wrong = violations(&measured, &bounds, false);
                found.extend(wrong.into_iter().map(|v| format!("{name}: {v}")));
            }
            (Err(reason), _) | (_, Err(reason)) => found.push(format!("{name}: {reason}")),
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn functions_in_pairs_keep_their_bounds() {
    check(Precision::Extended);
}

#[test]
fn functions_in_doubles_keep_their_bounds() {
    check(Precision::Double);
}
