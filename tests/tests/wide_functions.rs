//! Every function of the operator table in the wide tiers, real and complex, against the tables of references and the
//! declared bounds: values and derivatives, by component or by norm as declared.

use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::bounds::{declared, violations};
use pullback_tests::accuracy::evaluators::{Machine, is_reference_adapter, suite_gpu};
use pullback_tests::accuracy::measure::{Measured, in_metric, measure_together};
use pullback_tests::accuracy::subjects::subjects;

fn check(precision: Precision) {
    let Some(gpu) = suite_gpu() else { return };
    assert!(gpu.has(precision), "the software adapter has every tier");
    let tight = is_reference_adapter(&gpu);
    let machine = Machine::Gpu(Box::new(gpu), precision);
    let mut found = Vec::new();
    for subject in &subjects() {
        let name = format!("{} in {}", subject.name(), precision.name());
        match (
            measure_together(subject, &machine),
            declared(subject, &machine),
        ) {
            (Ok(measured), Ok(bounds)) => {
                println!("{name}: {}", largest(&measured));
                let wrong = violations(&measured, &bounds, tight);
                found.extend(wrong.into_iter().map(|v| format!("{name}: {v}")));
            }
            (Err(reason), _) | (_, Err(reason)) => found.push(format!("{name}: {reason}")),
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// The largest errors of value and derivative in every metric.
fn largest(measured: &Measured) -> String {
    let quantities = [("value", Some(&measured.value))];
    let derivative = [("derivative", measured.derivative.as_ref())];
    let mut text = Vec::new();
    for (what, errors) in quantities.into_iter().chain(derivative) {
        let Some(errors) = errors else { continue };
        let cells = pullback_compiler::table::Metric::ALL.map(|metric| {
            let errors = in_metric(errors, metric);
            let wrong = if errors.wrong.is_empty() {
                ""
            } else {
                " and wrong"
            };
            format!("{:.2}{wrong} {}", errors.max(), metric.word())
        });
        text.push(format!("{what} {}", cells.join(", ").trim_end()));
    }
    text.join("; ")
}

#[test]
fn functions_in_pairs_keep_their_bounds() {
    check(Precision::Extended);
}

#[test]
fn functions_in_doubles_keep_their_bounds() {
    check(Precision::Double);
}
