//! Size of the module, and time from text to WGSL, of each function that is defined in the language: a table in Markdown.

use std::time::{Duration, Instant};

use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Target, compile};
use pullback_tests::special::{SpecialFormula, functions_of, special_formulas};

const TIMES: usize = 9;

fn main() {
    println!(
        "| function | functions in the module | WGSL, KB | with derivative, KB | `double`, KB | compiled in, ms |"
    );
    println!("| --- | --- | --- | --- | --- | --- |");
    let mut all = Vec::new();
    for formula in special_formulas() {
        let value = emit(&formula, EmitWhat::Value, Precision::Accurate);
        let slope = emit(&formula, EmitWhat::Derivative, Precision::Accurate);
        let double = emit(&formula, EmitWhat::Value, Precision::Double);
        let time = median((0..TIMES).map(|_| time(&formula)).collect());
        println!(
            "| `{}` | {} | {:.1} | {:.1} | {:.1} | {:.2} |",
            formula.name,
            functions_of(&value).len(),
            kilobytes(&value),
            kilobytes(&slope),
            kilobytes(&double),
            milliseconds(time)
        );
        all.push(time);
    }
    println!("\nMedian of all: {:.2} ms.", milliseconds(median(all)));
}

fn emit(formula: &SpecialFormula, what: EmitWhat, precision: Precision) -> String {
    let program = compile(&formula.text).program;
    let text = program.and_then(|p| p.emit(0, what, Target::Wgsl, precision).ok());
    text.and_then(|t| String::from_utf8(t).ok())
        .unwrap_or_default()
}

fn time(formula: &SpecialFormula) -> Duration {
    let start = Instant::now();
    let text = emit(formula, EmitWhat::Value, Precision::Accurate);
    let taken = start.elapsed();
    assert!(!text.is_empty(), "{}", formula.text);
    taken
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    times.get(times.len() / 2).copied().unwrap_or_default()
}

fn kilobytes(text: &str) -> f64 {
    f64::from(u32::try_from(text.len()).unwrap_or(u32::MAX)) / 1000.0
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
