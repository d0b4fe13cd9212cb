//! How long the integrator takes for each density of the test tables, and what the integrals of well-known densities
//! cost beside formulas that are derived by hand.
//!
//! `cargo bench -p pullback-compiler --bench integrals`

use std::time::{Duration, Instant};

use pullback_compiler::compile;
use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::{Otherwise, field_integral};
use pullback_compiler::ir::cost;

/// Well-known densities, with the operations that the usual formula of the definite integral has, o + t d included and
/// a call counted as one.
const BY_HAND: [(&str, u32); 4] = [
    // d
    ("1", 1),
    // (d - (cos(v1) - cos(v0))/(2 w))/2: o.y + t d.y twice, two scales, two cosines
    ("0.5 + 0.5 sin(16 y - 8 time)", 17),
    // clamped ends, then a e + b e²/2 at both
    ("if 0 < y + 1 and y + 1 < 2 then y + 1 else 0", 22),
    // clamped ends, then (a + b e)³/(3 b) at both
    ("if 0 < y + 1 and y + 1 < 2 then (y + 1)^2 else 0", 24),
];

fn formula(text: &str) -> Option<Formula> {
    let text = format!("param p = 0.75\nparam q = -1.25\nparam r = 2.5\nf(x, y, z) = {text}");
    let program = compile(&text).program?;
    Some(program.pictures().first()?.formula.clone())
}

fn main() {
    let mut times: Vec<(Duration, String)> = Vec::new();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/integrals");
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .expect("the tables")
        .flatten()
        .map(|e| e.path())
        .collect();
    paths.sort();
    for path in paths {
        let text = std::fs::read_to_string(path).expect("a table");
        for density in text.lines().filter_map(|l| l.strip_prefix("= ")) {
            let formula = formula(density).expect(density);
            let start = Instant::now();
            let made = field_integral(&formula, Otherwise::Quadrature).expect(density);
            times.push((start.elapsed(), density.to_owned()));
            drop(made);
        }
    }
    times.sort();
    let (median, worst) = (&times[times.len() / 2], &times[times.len() - 1]);
    println!(
        "{} densities: median {:?}, greatest {:?} for {}",
        times.len(),
        median.0,
        worst.0,
        worst.1
    );
    println!("\n| density | operations | by hand |\n| --- | ---: | ---: |");
    for (text, by_hand) in BY_HAND {
        let made = field_integral(&formula(text).expect(text), Otherwise::Refuse).expect(text);
        let found = cost(&made.graph, &[made.integral.value]);
        println!("| `{text}` | {} | {by_hand} |", found.operations);
    }
}
