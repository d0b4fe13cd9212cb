//! Formulas that were published before this language was: each is compiled, and evaluated with its derivatives in f64
//! and on the GPU, against tables of 60-digit arithmetic.

use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::evaluators::{Machine, suite_gpu};
use pullback_tests::accuracy::formulas::MOST;
use pullback_tests::accuracy::literature::{Published, published};

/// As many formulas as the corpus has at least, those with loops, and those with a vector that is updated by parts.
const LEAST: (usize, usize, usize) = (120, 35, 8);
/// Rows that must be judged of every table.
const ROWS: usize = 8;

fn check(formulas: &[Published], machine: &Machine) -> Vec<String> {
    let mut found = Vec::new();
    for formula in formulas {
        let name = &formula.name;
        match formula.measure(machine) {
            Err(reason) => found.push(format!("{name}: {reason}")),
            Ok(factors) => {
                println!("{name}: K = {:.2}, {:.2}", factors.value, factors.derivative);
                let most = factors.value.max(factors.derivative);
                if most > MOST {
                    found.push(format!("{name}: K = {most:.2}, not {MOST}: {}", factors.worst));
                }
                if factors.rows < ROWS {
                    found.push(format!("{name}: only {} rows were judged", factors.rows));
                }
                found.extend(factors.wrong.iter().map(|w| format!("{name}: {w}")));
            }
        }
    }
    found
}

fn report(found: &[String]) {
    assert!(found.is_empty(), "{} violations\n{}", found.len(), found.join("\n"));
}

#[test]
fn published_formulas_in_f64_are_as_good_as_their_roundings() {
    report(&check(&published(), &Machine::Reference));
}

fn on_the_gpu(loops: bool) {
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    let mut formulas = published();
    formulas.retain(|f| f.loops() == loops);
    report(&check(&formulas, &machine));
}

#[test]
fn published_formulas_on_the_gpu_are_as_good_as_their_roundings() {
    on_the_gpu(false);
}

#[test]
fn published_loops_on_the_gpu_are_as_good_as_their_roundings() {
    on_the_gpu(true);
}
