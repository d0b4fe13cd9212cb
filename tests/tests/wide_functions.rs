//! Every function of the operator table in the wide tiers, real and complex, against the tables of references and the
//! declared bounds: values and derivatives, by component or by norm as declared. Pairs are held to them at random arguments,
//! too, where the `f64` evaluator is the reference, which the tables hold.

use pullback_compiler::lower::Precision;
use pullback_compiler::table::Metric;
use pullback_tests::accuracy::bounds::{Declared, declared, violations};
use pullback_tests::accuracy::evaluators::{Machine, is_reference_adapter, suite_gpu};
use pullback_tests::accuracy::measure::{Measured, in_metric, measure_together};
use pullback_tests::accuracy::subjects::subjects;
use pullback_tests::accuracy::sweep::judged_by;

/// Random pairs of each kind for each function, beside the tables.
const EACH: usize = 600;

fn check(precision: Precision) {
    let Some(gpu) = suite_gpu() else { return };
    assert!(gpu.has(precision), "the software adapter has every tier");
    let tight = is_reference_adapter(&gpu);
    let machine = Machine::Gpu(Box::new(gpu), precision);
    let mut found = Vec::new();
    for subject in &subjects() {
        let subject = &match judged_by(subject, &machine, EACH) {
            Ok(subject) => subject,
            Err(reason) => panic!("{}: {reason}", subject.name()),
        };
        let name = format!("{} in {}", subject.name(), precision.name());
        match (
            measure_together(subject, &machine),
            declared(subject, &machine),
        ) {
            (Ok(measured), Ok(bounds)) => {
                println!("{name}: {}", largest(&measured));
                let mut wrong = violations(&measured, &bounds, false);
                if tight {
                    wrong.extend(loose(&measured, &bounds));
                }
                found.extend(wrong.into_iter().map(|v| format!("{name}: {v}")));
            }
            (Err(reason), _) | (_, Err(reason)) => found.push(format!("{name}: {reason}")),
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Bounds that would not notice the loss of two bits, of those that allow more than a few units at all.
fn loose(measured: &Measured, declared: &Declared) -> Vec<String> {
    let value = [("value", Some(&measured.value), declared.value)];
    let derivative = [(
        "derivative",
        measured.derivative.as_ref(),
        declared.derivative,
    )];
    let quantities = value.into_iter().chain(derivative);
    let loose = quantities.filter_map(|(what, errors, bound)| {
        let (most, bound) = (in_metric(errors?, bound?.metric).max(), bound?);
        let far = bound.units > 4.0 * most.max(1.0);
        far.then(|| format!("the {what} has a bound of {bound}, far above {most:.2}"))
    });
    loose.collect()
}

/// The largest errors of value and derivative in every metric.
fn largest(measured: &Measured) -> String {
    let quantities = [("value", Some(&measured.value))];
    let derivative = [("derivative", measured.derivative.as_ref())];
    let mut text = Vec::new();
    for (what, errors) in quantities.into_iter().chain(derivative) {
        let Some(errors) = errors else { continue };
        let cells = Metric::ALL.map(|metric| {
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
