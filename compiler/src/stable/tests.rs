//! What the rules make of formulas, as text: tests/data/rewrites.txt, which `BLESS=1` writes.

use super::{Phase, Rewrites, stabilise};
use crate::ir::{LeafNames, to_infix, verify};

/// The formula as it is computed.
fn rewritten(text: &str) -> String {
    let compiled = crate::compile(text);
    let program = compiled
        .program
        .unwrap_or_else(|| panic!("{text}: {:?}", compiled.diagnostics));
    let formula = &program.pictures()[0].formula;
    let stable = stabilise(&formula.graph, &formula.value, Rewrites::ON, Phase::Late);
    verify(&stable.graph).unwrap_or_else(|e| panic!("{text}: {e:?}"));
    let inputs: Vec<String> = formula.inputs.iter().map(|i| i.name.clone()).collect();
    let names = LeafNames {
        inputs: &inputs,
        params: &[],
    };
    to_infix(&stable.graph, &stable.roots, names)
}

#[test]
fn formulas_become_what_is_written_down() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/rewrites.txt");
    let golden = std::fs::read_to_string(path).unwrap();
    let formulas = golden.lines().filter(|line| !line.starts_with(' '));
    let found: String = formulas
        .map(|text| format!("{text}\n    {}\n", rewritten(text).replace('\n', "\n    ")))
        .collect();
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(path, &found).unwrap();
        return;
    }
    assert!(golden == found, "{found}");
}

/// A sum of two thousand terms, and powers of powers: no pass may take long.
#[test]
fn large_formulas_take_no_time() {
    let terms: Vec<String> = (0..2000)
        .map(|k| format!("sin({k} x) sqrt(x + {k})"))
        .collect();
    let text = format!("f(x: real) = {}", terms.join(" - "));
    let compiled = crate::compile(&text);
    let program = compiled.program.expect("a program");
    let formula = &program.pictures()[0].formula;
    let start = std::time::Instant::now();
    let stable = stabilise(&formula.graph, &formula.value, Rewrites::ON, Phase::Late);
    assert!(stable.graph.nodes().len() < 3 * formula.graph.nodes().len());
    assert!(start.elapsed().as_secs_f64() < 2.0, "{:?}", start.elapsed());
}
