//! All members of the families that closed forms of ray integrals are made of, most of which have no name in the language:
//! values and derivatives on every tier against 60 digits (tests/oracle/integrals.py).

use std::collections::BTreeMap;

use pullback_compiler::What;
use pullback_compiler::formula::Formula;
use pullback_compiler::ir::Prim;
use pullback_compiler::lower::{Format, Precision};
use pullback_compiler::table::rows;
use pullback_tests::accuracy::error::Judge;
use pullback_tests::accuracy::evaluators::{Machine, Point, suite_gpu};
use pullback_tests::accuracy::subjects::formula;
use pullback_tests::accuracy::tables::{Expected, slope, value};

const TABLE: &str = include_str!("../data/functions/integral_families.tsv");

/// What was measured in the `f64` reference, and a tenth more.
const REFERENCE: Limits = [
    ("atanq", [4.8, 17.0]),
    ("log1prel", [17.0, 31.0]),
    ("erfcx", [7.3, 9.3]),
    ("spherical_j", [7.4, 9.0]),
    ("spherical_i_scaled", [5.3, 7.3]),
    ("gauss", [0.6, 0.8]),
];

/// On lavapipe in single precision.
const ACCURATE: Limits = [
    ("atanq", [4.7, 27.0]),
    ("log1prel", [14.0, 16.0]),
    ("erfcx", [16.5, 22.0]),
    ("spherical_j", [9.2, 9.8]),
    ("spherical_i_scaled", [6.6, 8.0]),
    ("gauss", [0.6, 0.8]),
];

/// In pairs, orders 0, 1, 2, 5 and 12.
const EXTENDED: Limits = [
    ("atanq", [3.0, 29.0]),
    ("log1prel", [33.0, 42.0]),
    ("erfcx", [77.0, 137.0]),
    ("spherical_j", [10.5, 9.5]),
    ("spherical_i_scaled", [6.3, 4.7]),
    ("gauss", [0.5, 0.5]),
];

/// In doubles, the same orders.
const DOUBLE: Limits = [
    ("atanq", [4.7, 17.0]),
    ("log1prel", [17.0, 31.0]),
    ("erfcx", [21.0, 21.0]),
    ("spherical_j", [17.0, 10.2]),
    ("spherical_i_scaled", [4.5, 4.7]),
    ("gauss", [0.6, 0.8]),
];

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

/// What errors of value and slope are divided by where they are smaller: waves and slopes vanish where nothing of their
/// computation does.
fn sizes(family: &str, order: u8, case: &Case) -> [f64; 2] {
    let number = |expected: Expected| match expected {
        Expected::Number { value, .. } => value.abs(),
        Expected::Unstated => 0.0,
    };
    let x = case.at.abs();
    match family {
        "gauss" => [f64::from(f32::MIN_POSITIVE); 2],
        // the amplitude
        "spherical_j" if x > f64::from(order) => [1.0 / x; 2],
        // far out the slope is a small difference of values
        "spherical_i_scaled" => [0.0, number(case.value)],
        _ => [0.0; 2],
    }
}

/// The largest errors of value and derivative of a member, with where they are.
fn errors(machine: &Machine, family: &str, order: u8, cases: &[Case]) -> [(f64, f64); 2] {
    let point = |case: &Case| Point {
        args: vec![case.at],
        params: Vec::new(),
    };
    let points: Vec<Point> = cases.iter().map(point).collect();
    let results = machine
        .run(
            &formula_of(member(family, order)),
            What::Derivative,
            &points,
        )
        .expect("it runs");
    [0, 1].map(|column| {
        let all = cases.iter().zip(&results).map(|(case, result)| {
            let expected = [case.value, case.slope][column];
            let size = sizes(family, order, case)[column];
            let error = machine.format().error(result[column], expected, size);
            (error, case.at)
        });
        all.max_by(|a, b| a.0.total_cmp(&b.0)).expect("a case")
    })
}

/// Families, and the largest errors of value and slope that a member may have, in units of the format (docs/numerics.md). High
/// orders start from recurrences that cancel by a few bits.
type Limits = [(&'static str, [f64; 2]); 6];

fn check(machine: &Machine, limits: &Limits) {
    let mut found = Vec::new();
    // the shader compiler takes its time for the wide tiers
    let is_wide = machine
        .precision()
        .is_some_and(|p| p.format() != Format::Single);
    let asked = |order: u8| !is_wide || [0, 1, 2, 5, 12].contains(&order);
    for ((family, order), cases) in cases().into_iter().filter(|c| asked(c.0.1)) {
        let worst = errors(machine, family, order, &cases);
        println!("{family} {order}: {worst:.2?}");
        let limit = limits.iter().find(|l| l.0 == family).expect("limits").1;
        let names = ["value", "slope"];
        for ((name, (error, at)), limit) in names.iter().zip(worst).zip(limit) {
            if error > limit {
                found.push(format!(
                    "{family} {order}: the {name} is off by {error:.2} at {at}, not {limit}"
                ));
            }
        }
    }
    assert!(found.is_empty(), "{machine}\n{}", found.join("\n"));
}

#[test]
fn families_of_the_reference() {
    check(&Machine::Reference, &REFERENCE);
}

fn on_gpu(precision: Precision, limits: &Limits) {
    let Some(gpu) = suite_gpu() else { return };
    check(&Machine::Gpu(Box::new(gpu), precision), limits);
}

#[test]
fn families_in_single_precision() {
    on_gpu(Precision::Accurate, &ACCURATE);
}

#[test]
fn families_in_pairs() {
    on_gpu(Precision::Extended, &EXTENDED);
}

#[test]
fn families_in_doubles() {
    on_gpu(Precision::Double, &DOUBLE);
}
