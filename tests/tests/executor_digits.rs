//! The executor in f64 on generated programs, against values of 60 digits of `tests/oracle/generated.py`.

#[path = "support/formulas.rs"]
mod formulas;
#[path = "support/listing.rs"]
mod listing;

use listing::{Generated, listing, programs};
use pullback_compiler::What;
use pullback_compiler::compile;
use pullback_compiler::lower::Precision;
use pullback_compiler::stable::Rewrites;
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::{Machine, Point};
use pullback_tests::accuracy::formulas::MOST;

const TABLE: &str = include_str!("../data/generated.tsv");

/// The rounding unit of float64.
const UNIT: f64 = f64::EPSILON / 2.0;

/// Rows without a value that the table may have: rounding decides them, or no first-order bound holds, or they overflow.
const MOST_OPEN: usize = 50;

/// What a program must give: none where the table says why there is no such number.
struct Expected {
    parts: Vec<f64>,
    /// What rounding may do to it, in units of [`UNIT`].
    scale: f64,
}

/// FNV-1a of 64 bits (Fowler, Noll, Vo).
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |state, &byte| {
        (state ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    })
}

fn expected(line: &str) -> Option<Expected> {
    let mut columns = line.split('\t');
    let mut next = || columns.next().expect("three columns");
    let (value, scale, note) = (next(), next(), next());
    if note != "-" {
        assert!(["jump", "coarse", "overflow"].contains(&note), "{line}");
        return None;
    }
    let number = |text: &str| text.parse().expect("a number");
    Some(Expected {
        parts: value.split(' ').map(number).collect(),
        scale: number(scale),
    })
}

/// What the executor gives for a program, with or without rewrites.
fn executed(program: &Generated, rewrites: Rewrites) -> Vec<f64> {
    let Generated {
        is_complex,
        body,
        point,
    } = program;
    let head = if *is_complex { "f(z)" } else { "f(x, y)" };
    let compiled = compile(&format!("{head} = {body}"));
    let compiled = compiled.program.expect("a program").with_rewrites(rewrites);
    let machine = Machine::Processor(Arithmetic::Reference, Precision::Double);
    let point = Point {
        args: point.to_vec(),
        params: Vec::new(),
    };
    let formula = &compiled.pictures()[0].formula;
    let mut found = machine
        .run(formula, What::Value, &[point])
        .expect("it runs");
    found.remove(0)
}

/// The least K with |found - expected| <= 2 K u scale + 2⁻¹⁰²², of complex numbers in norm.
fn factor(expected: &Expected, found: &[f64]) -> f64 {
    let apart = (0..expected.parts.len().max(found.len())).fold(0.0f64, |sum, k| {
        let part = |parts: &[f64]| parts.get(k).copied().unwrap_or(0.0);
        sum.hypot(part(&expected.parts) - part(found))
    });
    let beyond = apart - f64::MIN_POSITIVE;
    if beyond <= 0.0 {
        0.0
    } else {
        beyond / (2.0 * UNIT * expected.scale)
    }
}

#[test]
fn generated_programs_in_f64_against_60_digits() {
    let programs = programs();
    let (head, lines) = TABLE.split_once('\n').expect("a header");
    let sum = format!("{:016x}", checksum(listing(&programs).as_bytes()));
    assert!(
        head.ends_with(&sum),
        "the programs have changed, to {sum}: run tests/oracle/generated.py again"
    );
    let lines: Vec<&str> = lines.lines().skip(1).collect();
    assert_eq!(lines.len(), programs.len());
    let rows: Vec<(&Generated, &str)> = programs.iter().zip(lines).collect();
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let check = |part: &[(&Generated, &str)]| {
        let (mut open, mut worst) = (0, (0.0f64, String::new()));
        let mut wrong = Vec::new();
        for &(program, line) in part {
            let Some(expected) = expected(line) else {
                open += 1;
                continue;
            };
            for rewrites in [Rewrites::OFF, Rewrites::ON] {
                let found = executed(program, rewrites);
                let factor = factor(&expected, &found);
                let told = format!(
                    "{} at {:?}: {found:?}, not {:?} ± {:e}: K = {factor:.2}",
                    program.body, program.point, expected.parts, expected.scale
                );
                if factor.is_nan() || factor > MOST {
                    wrong.push(told.clone());
                }
                if factor > worst.0 {
                    worst = (factor, told);
                }
            }
        }
        (open, worst, wrong)
    };
    let parts: Vec<_> = std::thread::scope(|scope| {
        let parts = rows.chunks(rows.len().div_ceil(cores));
        let running: Vec<_> = parts.map(|part| scope.spawn(|| check(part))).collect();
        let join = |thread: std::thread::ScopedJoinHandle<_>| thread.join().expect("no panic");
        running.into_iter().map(join).collect()
    });
    let open: usize = parts.iter().map(|(open, ..)| open).sum();
    for (_, (_, told), _) in &parts {
        println!("{told}");
    }
    let wrong: Vec<&String> = parts.iter().flat_map(|(.., wrong)| wrong).collect();
    assert!(wrong.is_empty(), "{} are wrong: {wrong:#?}", wrong.len());
    assert!(open <= MOST_OPEN, "{open} have no value");
}
