//! What the rules make of formulas, as text.

use super::{Phase, Rewrites, stabilise};
use crate::ir::{LeafNames, to_infix, verify};

/// The formula as it is computed.
fn rewritten(text: &str, phase: Phase) -> String {
    let compiled = crate::compile(text);
    let program = compiled
        .program
        .unwrap_or_else(|| panic!("{text}: {:?}", compiled.diagnostics));
    let formula = &program.pictures()[0].formula;
    let stable = stabilise(&formula.graph, &formula.value, Rewrites::ON, phase);
    verify(&stable.graph).unwrap_or_else(|e| panic!("{text}: {e:?}"));
    let inputs: Vec<String> = formula.inputs.iter().map(|i| i.name.clone()).collect();
    let names = LeafNames {
        inputs: &inputs,
        params: &[],
    };
    to_infix(&stable.graph, &stable.roots, names)
}

#[test]
fn show_all() {
    for text in include_str!("../../tests/data/rewrites.txt").lines() {
        let late = rewritten(text, Phase::Late);
        println!("{text}\n    {}", late.replace('\n', "\n    "));
        let early = rewritten(text, Phase::Early);
        if early != late {
            println!("  early {}", early.replace('\n', "\n    "));
        }
    }
}
