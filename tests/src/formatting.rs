//! What holds for the canonical text of a program.

use std::collections::BTreeMap;

use pullback_compiler::check::is_builtin_function;
use pullback_compiler::{Compilation, Program, What, compile};
use pullback_grammar::token::{TokenKind, comments, tokenize};
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
    codes(text, &before, &formatted, &after)?;
    match (&before.program, &after.program) {
        (Some(before), Some(after)) if values(before) != values(after) => {
            Err(format!("formatting changes values:\n{formatted}"))
        }
        (Some(_), None) | (None, Some(_)) => Err("a program on one side alone".into()),
        _ => Ok(()),
    }
}

/// Says which diagnostics are others than before formatting, if any, by their codes.
fn codes(
    text: &str,
    before: &Compilation,
    formatted: &str,
    after: &Compilation,
) -> Result<(), String> {
    let counts = |found: &Compilation| {
        let mut counts = BTreeMap::new();
        for diagnostic in &found.diagnostics {
            *counts.entry(diagnostic.code).or_insert(0_usize) += 1;
        }
        counts
    };
    let (before, after) = (counts(before), counts(after));
    if before.contains_key("too-many-problems") {
        // which of them are listed depends on those that spaces answer
        return Ok(());
    }
    let is_converted = words(text) != words(formatted);
    for code in before.keys().chain(after.keys()) {
        let count = |counts: &BTreeMap<_, _>| counts.get(code).copied().unwrap_or(0);
        let (was, is) = (count(&before), count(&after));
        let holds = match *code {
            // answered by the canonical spaces, which show how a division is read
            "ambiguous-division" => is <= was,
            // about a pasted `\phi`, which is `φ` now
            "constant-letter" => is == 0,
            // a pasted token may stand for two, as the name in `a += b`: they have one place, and are complained of
            // once, but two places where they are written out
            _ if is_converted => is >= was && (is == 0) == (was == 0),
            _ => is == was,
        };
        if !holds {
            return Err(format!("{was} {code} become {is} of\n{formatted}"));
        }
    }
    Ok(())
}

/// The tokens of a text but for those that formatting may leave out: `;`, and a comma before `}`.
fn words(text: &str) -> Vec<&str> {
    let tokens = tokenize(text).0;
    let mut words: Vec<&str> = Vec::with_capacity(tokens.len());
    for token in tokens
        .iter()
        .filter(|token| token.kind != TokenKind::Semicolon)
    {
        if token.kind == TokenKind::RBrace && words.last() == Some(&",") {
            words.pop();
        }
        words.push(token.span.text(text));
    }
    words
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
