//! Every loop of our shaders ends, because it counts towards a bound: devices are not asked to check it.
//!
//! A `for` over a variable that changes by a fixed amount up to a bound says so by itself, if its body leaves the variable alone.
//! Every other loop must say why it ends, in a comment above it. Loops of formulas are written by the compiler, and count.

use std::fs;
use std::path::{Path, PathBuf};

use pullback_tests::corpus::root;

/// What a reason begins with.
const REASON: &str = "// ends: ";

#[test]
fn every_loop_counts_or_says_why_it_ends() {
    let mut files = Vec::new();
    for folder in ["compiler/shaders", "runtime/src"] {
        add_shaders(&root().join(folder), &mut files);
    }
    assert!(files.len() > 60, "only {} shaders found", files.len());
    let mut loops = 0;
    for file in &files {
        let text = fs::read_to_string(file).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        for (k, line) in lines.iter().enumerate() {
            if !is_loop(line) {
                continue;
            }
            loops += 1;
            let says_why = k > 0 && lines[k - 1].trim_start().starts_with(REASON);
            assert!(
                says_why || counts(&lines[k..]),
                "{}:{}: say why this loop ends:\n{line}",
                file.display(),
                k + 1
            );
        }
    }
    assert!(loops > 100, "only {loops} loops found");
}

/// Texts of shaders, but those of programs that are measured beside ours.
fn add_shaders(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() && !path.ends_with("bench") {
            add_shaders(&path, out);
        } else if path.extension().is_some_and(|e| e == "wgsl") {
            out.push(path);
        }
    }
}

fn is_loop(line: &str) -> bool {
    let first = line.split_whitespace().next();
    matches!(first, Some("for" | "while" | "loop"))
}

/// Whether a loop has a variable that goes by a fixed amount, to a bound, and that nothing else changes.
fn counts(lines: &[&str]) -> bool {
    let Some(variable) = counter(lines[0]) else {
        return false;
    };
    let indent = lines[0].len() - lines[0].trim_start().len();
    let end = format!("{}}}", " ".repeat(indent));
    let body = lines[1..].iter().take_while(|line| **line != end);
    let changes = |line: &&&str| {
        let rest = line.trim_start().strip_prefix(variable);
        rest.is_some_and(|rest| {
            let rest = rest.trim_start();
            let assigns = ["=", "+=", "-=", "*=", "++", "--", ">>=", "<<="];
            assigns.iter().any(|sign| rest.starts_with(sign)) && !rest.starts_with("==")
        })
    };
    body.filter(changes).count() == 0
}

/// The variable of `for (var k = …; k < …; k++)`, or of one that counts otherwise.
fn counter(line: &str) -> Option<&str> {
    let head = line.trim_start().strip_prefix("for (var ")?;
    let (first, rest) = head.split_once("; ")?;
    let (condition, step) = rest.split_once("; ")?;
    let variable = first.split([' ', ':']).next()?;
    let counted = condition.trim_start_matches('(').strip_prefix(variable)?;
    let is_bounded = [" < ", " <= ", " > ", " >= "]
        .iter()
        .any(|sign| counted.starts_with(sign));
    let step = step.strip_prefix(variable)?;
    let is_fixed = ["++", "--", " += ", " -= ", " >>= "]
        .iter()
        .any(|sign| step.starts_with(sign));
    // a condition of several parts holds no longer than its first
    (is_bounded && is_fixed && !condition.contains("||")).then_some(variable)
}

#[test]
fn a_loop_that_does_not_count_is_told() {
    assert!(counts(&["    for (var k = 0u; k < 3u; k++) {", "    }"]));
    assert!(!counts(&[
        "    for (var k = 0u; k < 3u; k++) {",
        "        k = 1u;",
        "    }"
    ]));
    assert!(!counts(&["    for (var k = 0u; k != 3u; k++) {", "    }"]));
    assert!(!counts(&[
        "    for (var k = 0u; k < 3u || more; k++) {",
        "    }"
    ]));
    assert!(!counts(&["    while more {", "    }"]));
    assert!(is_loop("  loop {") && !is_loop("// loop"));
}
