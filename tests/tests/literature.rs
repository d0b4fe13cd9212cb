//! Formulas that were published before this language was: each is compiled, and evaluated with its derivatives in f64
//! and on the GPU, against tables of 60-digit arithmetic.

use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::evaluators::{Machine, suite_gpu};
use pullback_tests::accuracy::formulas::{Factors, MOST};
use pullback_tests::accuracy::literature::{Published, published};

/// As many formulas as the corpus has at least, those with loops, and those with a vector that is updated by parts.
const LEAST: (usize, usize, usize) = (120, 35, 8);
/// Rows that must be judged of every table.
const ROWS: usize = 8;

/// Formulas with a greater bound than [`MOST`]: `name reference gpu reason`.
const BOUNDS: &str = include_str!("../data/literature/bounds.txt");

fn bound(name: &str, machine: &Machine) -> f64 {
    let line = BOUNDS
        .lines()
        .find(|line| line.split_whitespace().next() == Some(name));
    let place = if matches!(machine, Machine::Reference) {
        1
    } else {
        2
    };
    line.and_then(|line| line.split_whitespace().nth(place)?.parse().ok())
        .unwrap_or(MOST)
}

type Measure = fn(&Published, &Machine) -> Result<Factors, String>;

fn check(formulas: &[Published], machine: &Machine, measure: Measure) -> Vec<String> {
    let mut found = Vec::new();
    for formula in formulas {
        let name = &formula.name;
        let bound = bound(name, machine);
        match measure(formula, machine) {
            Err(reason) => found.push(format!("{name}: {reason}")),
            Ok(factors) => {
                println!(
                    "{name}: K = {:.2}, {:.2}",
                    factors.value, factors.derivative
                );
                let most = factors.value.max(factors.derivative);
                if most > bound {
                    found.push(format!(
                        "{name}: K = {most:.2}, not {bound}: {}",
                        factors.worst
                    ));
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
    assert!(
        found.is_empty(),
        "{} violations\n{}",
        found.len(),
        found.join("\n")
    );
}

#[test]
fn published_formulas_in_f64_are_as_good_as_their_roundings() {
    report(&check(
        &published(),
        &Machine::Reference,
        Published::measure,
    ));
}

fn on_the_gpu(loops: bool) {
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    let mut formulas = published();
    formulas.retain(|f| f.loops() == loops);
    report(&check(&formulas, &machine, Published::measure));
}

#[test]
fn second_derivatives_of_published_formulas_are_as_good_as_their_roundings() {
    let mut formulas = published();
    formulas.retain(Published::second);
    assert!(formulas.len() >= 40, "{}", formulas.len());
    report(&check(
        &formulas,
        &Machine::Reference,
        Published::measure_second,
    ));
}

#[test]
fn the_corpus_is_as_large_as_promised() {
    let formulas = published();
    let loops = formulas.iter().filter(|f| f.loops()).count();
    let updates = formulas.iter().filter(|f| f.updates()).count();
    println!(
        "{} formulas, {loops} with loops, {updates} with vectors updated by parts",
        formulas.len()
    );
    let (all, least_loops, least_updates) = LEAST;
    assert!(formulas.len() >= all && loops >= least_loops && updates >= least_updates);
    for formula in &formulas {
        assert!(
            formula.source.contains("// source: "),
            "{} has no source",
            formula.name
        );
    }
}

#[test]
fn published_formulas_on_the_gpu_are_as_good_as_their_roundings() {
    on_the_gpu(false);
}

#[test]
fn published_loops_on_the_gpu_are_as_good_as_their_roundings() {
    on_the_gpu(true);
}
