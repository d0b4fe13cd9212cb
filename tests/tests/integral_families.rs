//! All members of the families that closed forms of ray integrals are made of, most of which have no name in the language:
//! values and derivatives on every tier against 60 digits (tests/oracle/integrals.py).

use std::collections::BTreeMap;

use pullback_compiler::What;
use pullback_compiler::formula::Formula;
use pullback_compiler::ir::Prim;
use pullback_compiler::lower::Precision;
use pullback_compiler::table::{Metric, rows};
use pullback_tests::accuracy::evaluators::{Machine, Point, suite_gpu};
use pullback_tests::accuracy::measure::case_error;
use pullback_tests::accuracy::subjects::formula;
use pullback_tests::accuracy::tables::{Expected, slope, value};

const TABLE: &str = include_str!("../data/functions/integral_families.tsv");

struct Case {
    at: f64,
    value: Expected,
    slope: Expected,
}

fn cases() -> BTreeMap<(&'static str, u8), Vec<Case>> {
    let mut out: BTreeMap<_, Vec<Case>> = BTreeMap::new();
    for line in TABLE.lines().filter(|line| !line.starts_with('#')) {
        let cells: Vec<&'static str> = line.split('\t').collect();
        let &[family, order, at, of, slope_of] = cells.as_slice() else {
            panic!("{line}");
        };
        let case = Case {
            at: at.parse().expect("an argument"),
            value: value(of).expect("a value"),
            slope: slope(slope_of).expect("a slope"),
        };
        let key = (family, order.parse().expect("an order"));
        out.entry(key).or_default().push(case);
    }
    out
}

fn member(family: &str, order: u8) -> Prim {
    let row = rows().iter().find(|row| row.mnemonic == family);
    row.expect("a family").prim.with_order(order)
}

/// The function of one real argument that a primitive is.
fn formula_of(prim: Prim) -> Formula {
    let mut formula = formula("f(x: real) = x\n");
    let argument = formula.value[0];
    formula.value[0] = formula.graph.apply(prim, &[argument]);
    formula
}

/// The largest errors of value and derivative of a member, with where they are.
fn errors(machine: &Machine, prim: Prim, cases: &[Case]) -> [(f64, f64); 2] {
    let points: Vec<Point> = cases
        .iter()
        .map(|case| Point {
            args: vec![case.at],
            params: Vec::new(),
        })
        .collect();
    let results = machine
        .run(&formula_of(prim), What::Derivative, &points)
        .expect("it runs");
    [0, 1].map(|column| {
        let all = cases.iter().zip(&results).map(|(case, result)| {
            let (expected, metric) = match column {
                0 => (case.value, Metric::Component),
                _ => (case.slope, Metric::Unit),
            };
            let error = case_error(
                machine.format(),
                &result[column..=column],
                &[expected],
                metric,
            );
            (error, case.at)
        });
        all.max_by(|a, b| a.0.total_cmp(&b.0)).expect("a case")
    })
}

fn check(machine: &Machine) {
    for ((family, order), cases) in cases() {
        let [value, slope] = errors(machine, member(family, order), &cases);
        println!(
            "{machine} {family} {order}: {:.2} at {}, slope {:.2} at {}",
            value.0, value.1, slope.0, slope.1
        );
    }
}

#[test]
fn families_of_the_reference() {
    check(&Machine::Reference);
}

#[test]
fn families_in_single_precision() {
    let Some(gpu) = suite_gpu() else { return };
    check(&Machine::Gpu(Box::new(gpu), Precision::Accurate));
}
