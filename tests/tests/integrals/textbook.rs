//! The closed forms beside the difference of two values of the antiderivative.

use std::path::Path;

use pullback_compiler::What;
use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::{Otherwise, field_integral};
use pullback_compiler::lower::Precision;
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::stability::textbook;

use super::{formula, points};

/// A density, and its antiderivative as a textbook has it, at t with the height v = o.y + t d.y, its rate w = d.y, and
/// q = A t^2 + 2 B t + C.
const TEXTBOOK: [(&str, &str); 12] = [
    ("sin(3 y)", "-cos(3 v)/(3 w)"),
    ("sin(3 y)^2", "t/2 - sin(6 v)/(12 w)"),
    ("exp(-2 y)", "-exp(-2 v)/(2 w)"),
    ("y exp(-y)", "-(v + 1) exp(-v)/w"),
    ("max(0, y)", "max(0, v)^2/(2 w)"),
    ("1/(y + 12)", "log(v + 12)/w"),
    (
        "(x^2 + y^2 + z^2 - 1)^2",
        "A^2 t^5/5 + A B t^4 + (4 B^2 + 2 A (C - 1)) t^3/3 + 2 B (C - 1) t^2 + (C - 1)^2 t",
    ),
    (
        "1/(x^2 + y^2 + z^2 + 0.01)",
        "atan((A t + B)/sqrt(D + 0.01 A))/sqrt(D + 0.01 A)",
    ),
    (
        "1/(x^2 + y^2 + z^2 + 0.01)^2",
        "(A t + B)/(2 k (q + 0.01)) + A atan((A t + B)/sqrt(k))/(2 k sqrt(k)) where k = D + 0.01 A",
    ),
    (
        "length((x, y, z))",
        "(A t + B) sqrt(q)/(2 A) + D log(A t + B + sqrt(A) sqrt(q))/(2 A sqrt(A))",
    ),
    (
        "1/length((x, y, z))",
        "log(A t + B + sqrt(A) sqrt(q))/sqrt(A)",
    ),
    (
        "exp(-(x^2 + y^2 + z^2))",
        "sqrt(pi)/(2 sqrt(A)) exp(-D/A) erf((A t + B)/sqrt(A))",
    ),
];

/// Rays whose height changes at any rate down to none: the generator is that of Knuth's MMIX.
fn some_rays(count: usize) -> Vec<Vec<f64>> {
    let mut state = 12345_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut between = |lo: f64, hi: f64| f64::from((lo + (hi - lo) * next()) as f32);
    let mut out = Vec::new();
    for k in 0..count {
        let angle = between(0.0, 6.25);
        let rate = match k % 4 {
            0 => between(-0.9, 0.9),
            1 => between(-1.0, 1.0) * 1e-3,
            2 => between(-1.0, 1.0) * 1e-6,
            _ => {
                if k % 8 == 3 {
                    0.0
                } else {
                    between(-1.0, 1.0) * 1e-2
                }
            }
        };
        let flat = (1.0 - rate * rate).sqrt();
        let d = [flat * angle.cos(), rate, flat * angle.sin()];
        let distance = if k % 5 == 0 { 8.0 } else { 0.0 };
        let o: Vec<f64> = (0..3)
            .map(|c| between(-2.0, 2.0) - distance * d[c])
            .collect();
        let length = 10_f64.powf(between(-3.0, 0.8));
        let a = if distance > 0.0 {
            6.0
        } else {
            between(-1.0, 1.0)
        };
        let numbers = o.into_iter().chain(d).chain([a, a + length]);
        out.push(numbers.map(|x| f64::from(x as f32)).collect());
    }
    out
}

/// Median and greatest error as a part of ∫ |f|, told with one digit.
fn told(mut errors: Vec<f64>) -> (String, [f64; 2]) {
    errors.sort_by(f64::total_cmp);
    let (median, worst) = (errors[errors.len() / 2], errors[errors.len() - 1]);
    let digit = |x: f64| {
        if x.is_finite() {
            format!("{x:.0e}")
        } else {
            "∞".to_owned()
        }
    };
    (
        format!("{} | {}", digit(median), digit(worst)),
        [median, worst],
    )
}

/// The table of `docs/integrals.md`: the closed forms against F(b) - F(a) on the same 400 rays in binary32. `BLESS=1`
/// writes it.
#[test]
fn closed_forms_against_the_textbook() {
    const BEGIN: &str = "| density | textbook, median | worst | closed form, median | worst |\n| --- | --- | --- | --- | --- |\n";
    let machine = Machine::Processor(Arithmetic::Ieee32, Precision::Accurate);
    let rays = points(some_rays(400).into_iter());
    let mut table = BEGIN.to_owned();
    for (density, antiderivative) in TEXTBOOK {
        let of = formula(density);
        let integral = field_integral(&of, Otherwise::Refuse)
            .unwrap()
            .into_formula(&of);
        let sized = formula(&format!("abs({density})"));
        let size = field_integral(&sized, Otherwise::Quadrature)
            .unwrap()
            .into_formula(&sized);
        let run = |machine: &Machine, formula: &Formula| -> Vec<f64> {
            let rows = machine
                .run(formula, What::Value, &rays)
                .unwrap_or_else(|e| panic!("{density}: {e}"));
            rows.iter().map(|row| row[0]).collect()
        };
        let exact = run(&Machine::Reference, &integral);
        let size = run(&Machine::Reference, &size);
        let errors = |found: Vec<f64>| {
            let error = |((f, e), s): ((&f64, &f64), &f64)| {
                let error = if f == e { 0.0 } else { (f - e).abs() / s };
                if error.is_nan() { f64::INFINITY } else { error }
            };
            told(found.iter().zip(&exact).zip(&size).map(error).collect())
        };
        let (naive, [_, bad]) = errors(run(&machine, &textbook(antiderivative)));
        let (ours, [median, worst]) = errors(run(&machine, &integral));
        table += &format!("| `{density}` | {naive} | {ours} |\n");
        // what is left comes of the roundings of rays that meet a zero of f
        assert!(
            median < 5e-7 && worst < 1e-2 * bad,
            "{density}: {ours}, textbook {naive}"
        );
    }
    println!("{table}");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/integrals.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let start = page.find(BEGIN).expect("the head of the table");
    let end = page[start..]
        .find("\n\n")
        .map_or(page.len(), |n| start + n + 1);
    let now = format!("{}{table}{}", &page[..start], &page[end..]);
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, now).unwrap();
    } else {
        assert!(
            page == now,
            "docs/integrals.md is not up to date: run with BLESS=1 and read the difference"
        );
    }
}
