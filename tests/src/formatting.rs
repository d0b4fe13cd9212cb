//! What holds for the canonical text of a program.

use pullback_compiler::check::is_builtin_function;
use pullback_compiler::{Program, What, compile};
use pullback_grammar::token::comments;
use pullback_grammar::{format, parse, same_tree};

/// Points at which formulas are compared; a formula takes as many numbers of them as it needs.
const POINTS: [[f64; 4]; 4] = [
    [0.3, -0.7, 1.1, 0.5],
    [-2.25, 0.5, 1e-9, -1.0],
    [1e6, -1e3, 0.125, 3.0],
    [0.0, -0.0, f64::INFINITY, f64::NAN],
];
/// Larger formulas are not evaluated.
const MAX_NODES: usize = 20_000;

/// Says what is wrong with the canonical text of a text without syntax errors, if anything: it has another tree, other
/// comments, or is not its own canonical text. Nothing is held of a text with errors but that it has no format.
///
/// # Errors
/// What does not hold.
pub fn tree(text: &str) -> Result<(), String> {
    let parsed = parse(text, &is_builtin_function);
    let formatted = format(text, &is_builtin_function);
    if parsed.has_errors() {
        return match formatted {
            None => Ok(()),
            Some(formatted) => Err(format!("a text with errors becomes\n{formatted}")),
        };
    }
    let Some(formatted) = formatted else {
        return Err("a text without errors cannot be formatted".into());
    };
    let again = parse(&formatted, &is_builtin_function);
    if again.has_errors() || !same_tree(&parsed.file, &again.file) {
        return Err(format!(
            "formatting changes the meaning:\n{formatted}\n{:?}",
            again.diagnostics
        ));
    }
    if comments(text).len() != comments(&formatted).len() {
        return Err(format!("formatting loses comments:\n{formatted}"));
    }
    if format(&formatted, &is_builtin_function).as_ref() != Some(&formatted) {
        return Err(format!("formatting twice changes the text:\n{formatted}"));
    }
    Ok(())
}

/// Says what is wrong with the canonical text of a program, if anything: other diagnostics than before, or a value or
/// derivative that is not the same number, bit for bit.
///
/// # Errors
/// What does not hold.
pub fn evaluation(text: &str) -> Result<(), String> {
    let Some(formatted) = format(text, &is_builtin_function) else {
        return Ok(());
    };
    let (before, after) = (compile(text), compile(&formatted));
    let codes = |found: &pullback_compiler::Compilation| {
        let mut codes: Vec<_> = found.diagnostics.iter().map(|d| d.code).collect();
        // the note about a pasted `\phi`, and a number too small for others than 0, which the canonical text has no
        // more, and the warning about a division whose canonical spaces show how it is read
        let is_moot = |code| {
            matches!(
                code,
                "constant-letter" | "number-too-small" | "ambiguous-division"
            )
        };
        codes.retain(|&code| !is_moot(code));
        codes.sort_unstable();
        // a token that stands for two, as the name in a pasted `+=`, has one place and is complained of once
        codes.dedup();
        codes
    };
    if codes(&before) != codes(&after) {
        return Err(format!(
            "{:?} become {:?} of\n{formatted}",
            codes(&before),
            codes(&after)
        ));
    }
    match (&before.program, &after.program) {
        (Some(before), Some(after)) if values(before) != values(after) => {
            Err(format!("formatting changes values:\n{formatted}"))
        }
        (Some(_), None) | (None, Some(_)) => Err("a program on one side alone".into()),
        _ => Ok(()),
    }
}

/// The bits of every value and derivative at the points.
#[must_use]
pub fn values(program: &Program) -> Vec<u64> {
    let params: Vec<f64> = program.params().iter().map(|param| param.default).collect();
    let mut found = Vec::new();
    for (index, picture) in program.pictures().iter().enumerate() {
        if picture.formula.graph.nodes().len() > MAX_NODES {
            continue;
        }
        for what in [What::Value, What::Gradient, What::Derivative] {
            let Ok(mut evaluator) = program.evaluator(index, what) else {
                continue;
            };
            let mut out = vec![0.0; evaluator.outputs().len()];
            for point in &POINTS {
                evaluator.eval(&params, 0.25, 0.01, point, &mut out);
                found.extend(out.iter().map(|value| value.to_bits()));
            }
        }
    }
    found
}
