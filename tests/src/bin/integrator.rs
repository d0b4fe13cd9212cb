//! How long the integrator takes: `cargo run --release -p pullback-tests --bin integrator`.
//!
//! The median time from a checked formula to its integral along a ray, for the densities of the oracle, and for
//! polynomials and products that grow.

use std::time::Instant;

use pullback_compiler::compile;
use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::{Otherwise, field_integral};

fn formula(text: &str) -> Option<Formula> {
    let text = format!("param p = 0.75\nparam q = -1.25\nparam r = 2.5\nf(x, y, z) = {text}");
    let program = compile(&text).program?;
    Some(program.pictures()[0].formula.clone())
}

/// Milliseconds, the median of five, and the nodes of the integral.
fn time(of: &Formula) -> Option<(f64, usize)> {
    let mut times: Vec<f64> = Vec::new();
    let mut nodes = 0;
    for _ in 0..5 {
        let started = Instant::now();
        let made = field_integral(of, Otherwise::Quadrature).ok()?;
        times.push(1e3 * started.elapsed().as_secs_f64());
        nodes = made.graph.compacted(&[made.integral.value]).0.nodes().len();
    }
    times.sort_by(f64::total_cmp);
    Some((times[2], nodes))
}

fn main() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("data/integrals");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .map(|found| found.flatten().map(|f| f.path()).collect())
        .unwrap_or_default();
    files.sort();
    let mut all: Vec<f64> = Vec::new();
    println!("| densities | | median, ms | worst, ms |\n| --- | ---: | ---: | ---: |");
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap_or_default();
        let densities = text.lines().filter_map(|l| l.strip_prefix("= "));
        let mut times: Vec<f64> = densities
            .filter_map(formula)
            .filter_map(|of| Some(time(&of)?.0))
            .collect();
        times.sort_by(f64::total_cmp);
        let (Some(median), Some(worst)) = (times.get(times.len() / 2), times.last()) else {
            continue;
        };
        let name = file.file_stem().map(|s| s.to_string_lossy().into_owned());
        let name = name.unwrap_or_default();
        println!("| {name} | {} | {median:.2} | {worst:.2} |", times.len());
        all.extend(times);
    }
    all.sort_by(f64::total_cmp);
    if let Some(median) = all.get(all.len() / 2) {
        let below = all.iter().filter(|&&t| t < 2.0).count();
        println!("| all | {} | {median:.2} | {below} below 2 ms |", all.len());
    }
    println!("\n| grows | ms | nodes |\n| --- | ---: | ---: |");
    for degree in [5, 10, 20, 40, 60] {
        row(&format!("(x + y + z)^{degree}"));
        row(&format!(
            "sum(k in 1..{degree}, x^k y^({degree} - k)) + x^{degree} + p y"
        ));
    }
    for factors in [2, 4, 6, 8, 10] {
        let list =
            |of: &dyn Fn(usize) -> String| (1..=factors).map(of).collect::<Vec<_>>().join(" * ");
        row(&list(&|k| format!("sin({k} x + y)")));
        row(&list(&|k| format!("(x + {k} y)")));
        row(&list(&|k| format!("exp(-{k} x) ")));
        row(&list(&|k| format!("max(0, x - {k}/7)")));
    }
}

fn row(text: &str) {
    let shown: String = text.chars().take(40).collect();
    match formula(text).as_ref().and_then(time) {
        Some((ms, nodes)) => println!("| `{shown}` | {ms:.2} | {nodes} |"),
        None => println!("| `{shown}` | refused | |"),
    }
}
