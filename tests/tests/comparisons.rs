//! Comparisons as IEEE 754 has them: with a NaN none holds but `!=`, zeros of either sign are equal. In every evaluator,
//! because shading languages promise nothing about NaN, and naga writes `!=` as an ordered comparison.

use pullback_compiler::What;
use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::evaluators::{Machine, Point, suite_gpu};
use pullback_tests::accuracy::subjects::formula;

const NUMBERS: [f64; 8] = [
    0.0,
    -0.0,
    1.0,
    -2.5,
    1e30,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// A condition on x and y in the language, and the same in Rust.
type Condition = (&'static str, fn(f64, f64) -> bool);

#[allow(
    clippy::nonminimal_bool,
    clippy::neg_cmp_op_on_partial_ord,
    reason = "the negations are what is tested"
)]
const CONDITIONS: [Condition; 17] = [
    ("x < y", |x, y| x < y),
    ("x <= y", |x, y| x <= y),
    ("x > y", |x, y| x > y),
    ("x >= y", |x, y| x >= y),
    ("x == y", |x, y| x == y),
    ("x != y", |x, y| x != y),
    ("x != 1", |x, _| x != 1.0),
    ("not (x < y)", |x, y| !(x < y)),
    ("not (x <= y)", |x, y| !(x <= y)),
    ("not (x > 1)", |x, _| !(x > 1.0)),
    ("not (x >= y)", |x, y| !(x >= y)),
    ("not (x == y)", |x, y| !(x == y)),
    ("not (x != y)", |x, y| !(x != y)),
    ("not (x < y) and not (x > y)", |x, y| !(x < y) && !(x > y)),
    ("not (x < y or x >= y)", |x, y| !(x < y || x >= y)),
    ("x != x", |x, _| x.is_nan()),
    ("x == x", |x, _| !x.is_nan()),
];

fn machines() -> Vec<Machine> {
    let mut machines = vec![Machine::Reference];
    if let Some(gpu) = suite_gpu() {
        let on_gpu = |tier| Machine::Gpu(Box::new(gpu.clone()), tier);
        machines.extend(Precision::ALL.map(on_gpu));
    }
    machines
}

/// What is wrong with the values of conditions, in every evaluator.
fn wrong(conditions: &[Condition]) -> Vec<String> {
    let pairs: Vec<(f64, f64)> = NUMBERS
        .iter()
        .flat_map(|&x| NUMBERS.map(|y| (x, y)))
        .collect();
    let point = |&(x, y): &(f64, f64)| Point {
        args: vec![x, y],
        params: Vec::new(),
    };
    let points: Vec<Point> = pairs.iter().map(point).collect();
    let mut wrong = Vec::new();
    for machine in machines() {
        let tier = machine.precision().map_or("reference", Precision::name);
        for (condition, holds) in conditions {
            let text = format!("f(x: real, y: real) = if {condition} then 1 else 0");
            let rows = machine
                .run(&formula(&text), What::Value, &points)
                .expect(&text);
            for (&(x, y), row) in pairs.iter().zip(&rows) {
                if row[0] != f64::from(u8::from(holds(x, y))) {
                    wrong.push(format!("{tier}: {text} at {x}, {y} gives {}", row[0]));
                }
            }
        }
    }
    wrong
}

#[test]
fn comparisons_with_nan_hold_as_ieee_says() {
    let found = wrong(&CONDITIONS);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn complex_numbers_differ_where_a_part_does() {
    let equality: [Condition; 4] = [
        ("complex(x, 2) == complex(y, 2)", |x, y| x == y),
        ("complex(x, 2) != complex(y, 2)", |x, y| x != y),
        ("complex(3, x) == complex(3, y)", |x, y| x == y),
        ("complex(3, x) != complex(3, y)", |x, y| x != y),
    ];
    let found = wrong(&equality);
    assert!(found.is_empty(), "{}", found.join("\n"));
}
