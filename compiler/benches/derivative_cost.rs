//! Operations of value and derivative together over those of the value alone, for each gallery formula, after
//! common subexpressions, with integer powers counted as products.
//!
//! `cargo bench -p pullback-compiler --bench derivative_cost`

use pullback_compiler::compile;
use pullback_compiler::ir::cost;
use pullback_compiler::module::{What, evaluation};
use pullback_compiler::types::Type;

fn main() {
    println!(
        "| formula | value | with derivative | ratio | value, weighted | with derivative | ratio |"
    );
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: |");
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/gallery");
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .expect("the gallery")
        .flatten()
        .map(|e| e.path())
        .collect();
    paths.sort();
    let (mut plain, mut weighted) = (Vec::new(), Vec::new());
    for path in paths
        .iter()
        .filter(|p| p.extension().is_some_and(|e| e == "pull"))
    {
        let text = std::fs::read_to_string(path).expect("a file");
        let program = compile(&text).program.expect("a program without errors");
        let formula = &program.pictures()[0].formula;
        let complex = formula.inputs.iter().any(|i| i.ty == Type::Complex);
        let what = if complex {
            What::Derivative
        } else {
            What::Gradient
        };
        let both = evaluation(formula, what).expect("a derivative");
        let value = cost(&formula.graph, &formula.value);
        let both = cost(&both.graph, &both.roots);
        let ratio = f64::from(both.operations) / f64::from(value.operations.max(1));
        let heavy = f64::from(both.weighted) / f64::from(value.weighted.max(1));
        plain.push(ratio);
        weighted.push(heavy);
        let name = path
            .file_stem()
            .map(|s| s.to_string_lossy().into_owned())
            .unwrap_or_default();
        println!(
            "| {name} | {} | {} | {ratio:.2} | {} | {} | {heavy:.2} |",
            value.operations, both.operations, value.weighted, both.weighted
        );
    }
    println!(
        "| **median** | | | {:.2} | | | {:.2} |",
        median(plain),
        median(weighted)
    );
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
