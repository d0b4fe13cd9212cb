//! Operations of value and derivatives together over those of the value alone, for each gallery formula, after
//! common subexpressions, with integer powers counted as products: first derivatives, and first and second ones.
//!
//! `cargo bench -p pullback-compiler --bench derivative_cost`

use pullback_compiler::compile;
use pullback_compiler::derive::{ComplexVariable, forward, jet};
use pullback_compiler::formula::Formula;
use pullback_compiler::ir::{Cost, Graph, Id, Ty, cost};
use pullback_compiler::module::{Evaluation, What, evaluation};
use pullback_compiler::types::Type;

fn main() {
    println!(
        "| formula | value | with first | ratio | with second | ratio | value, weighted | with first | ratio | with second \
         | ratio |"
    );
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/gallery");
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .expect("the gallery")
        .flatten()
        .map(|e| e.path())
        .collect();
    paths.sort();
    let mut ratios: [Vec<f64>; 4] = Default::default();
    for path in paths
        .iter()
        .filter(|p| p.extension().is_some_and(|e| e == "pull"))
    {
        let text = std::fs::read_to_string(path).expect("a file");
        let program = compile(&text).program.expect("a program without errors");
        let formula = &program.pictures()[0].formula;
        let [value, first, second] = costs(formula);
        let over = |a: u32, b: u32| f64::from(a) / f64::from(b.max(1));
        let found = [
            over(first.operations, value.operations),
            over(second.operations, value.operations),
            over(first.weighted, value.weighted),
            over(second.weighted, value.weighted),
        ];
        for (all, &ratio) in ratios.iter_mut().zip(&found) {
            all.push(ratio);
        }
        let name = path
            .file_stem()
            .map(|s| s.to_string_lossy().into_owned())
            .unwrap_or_default();
        println!(
            "| {name} | {} | {} | {:.2} | {} | {:.2} | {} | {} | {:.2} | {} | {:.2} |",
            value.operations,
            first.operations,
            found[0],
            second.operations,
            found[1],
            value.weighted,
            first.weighted,
            found[2],
            second.weighted,
            found[3]
        );
    }
    let [plain, plain2, heavy, heavy2] = ratios.map(median);
    println!("| **median** | | | {plain:.2} | | {plain2:.2} | | | {heavy:.2} | | {heavy2:.2} |");
}

/// Of the value, the value with its first derivatives, and with its second ones, too.
fn costs(formula: &Formula) -> [Cost; 3] {
    let complex = formula.inputs.iter().any(|i| i.ty == Type::Complex);
    let what = if complex {
        What::Derivative
    } else {
        What::Gradient
    };
    let Evaluation {
        mut graph, roots, ..
    } = evaluation(formula, what).expect("a derivative");
    let first = cost(&graph, &roots);
    let derivatives = &roots[formula.value.len()..];
    let further = if complex {
        second_jets(&mut graph, derivatives)
    } else {
        hessian(&mut graph, derivatives)
    };
    let all: Vec<Id> = roots.iter().copied().chain(further).collect();
    let second = cost(&graph, &all);
    [cost(&formula.graph, &formula.value), first, second]
}

/// The upper triangle of the Hessian, by forward mode on the gradient.
fn hessian(g: &mut Graph, gradient: &[Id]) -> Vec<Id> {
    let count = gradient.len();
    let leaves: Vec<Id> = (0..count).map(|k| Formula::leaf(g, k, Ty::Real)).collect();
    let one = g.real(1.0);
    let mut out = Vec::new();
    for (k, &slope) in gradient.iter().enumerate() {
        for &leaf in &leaves[k..] {
            out.extend(forward(g, &[slope], &[(leaf, one)]).expect("a rule")[0]);
        }
    }
    out
}

/// f″ of a holomorphic function; ∂²f/∂z², ∂²f/∂z∂z̄ and ∂²f/∂z̄² of others.
fn second_jets(g: &mut Graph, derivatives: &[Id]) -> Vec<Id> {
    let z = ComplexVariable::Whole(Formula::leaf(g, 0, Ty::Complex));
    let mut out = Vec::new();
    for (k, &derivative) in derivatives.iter().enumerate() {
        let jet = jet(g, derivative, z).expect("a rule");
        if k == 0 {
            out.push(jet.dz);
        }
        out.extend(jet.dzbar);
    }
    out
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
