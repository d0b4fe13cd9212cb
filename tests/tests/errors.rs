//! Wrong programs: each mistake gives its diagnostic, at its place, once.

use pullback_compiler::compile;
use pullback_grammar::Diagnostic;
use pullback_tests::corpus::{Expected, WrongProgram, read, root, wrong_groups, wrong_programs};
use pullback_tests::holds;

/// Codes that are warnings.
const WARNINGS: [&str; 3] = ["ambiguous-division", "outside-domain", "shadows-builtin"];

fn fits(expected: &Expected, found: &Diagnostic, text: &str) -> bool {
    found.code == expected.code
        && (expected.spanned.is_empty() || found.span.text(text) == expected.spanned)
        && (expected.hint.is_empty()
            || found
                .hint
                .as_ref()
                .is_some_and(|hint| hint.contains(&expected.hint)))
        && found.is_error() != WARNINGS.contains(&found.code)
}

fn show(found: &Diagnostic, text: &str) -> String {
    let hint = found.hint.as_deref().unwrap_or("");
    format!(
        "{} \"{}\" : {hint}   [{}]",
        found.code,
        found.span.text(text),
        found.message
    )
}

/// What is wrong with the answer to a wrong program.
fn complaints(case: &WrongProgram) -> Vec<String> {
    let answer = compile(&case.text);
    let mut out: Vec<String> = holds::compilation(&case.text, &answer)
        .err()
        .into_iter()
        .collect();
    let mut found: Vec<&Diagnostic> = answer.diagnostics.iter().collect();
    for expected in &case.expected {
        match found.iter().position(|f| fits(expected, f, &case.text)) {
            Some(at) => {
                found.remove(at);
            }
            None => out.push(format!(
                "missing {} \"{}\" : {}",
                expected.code, expected.spanned, expected.hint
            )),
        }
    }
    out.extend(
        found
            .iter()
            .map(|f| format!("unexpected {}", show(f, &case.text))),
    );
    out
}

#[test]
fn every_wrong_program_gives_its_diagnostics() {
    let cases = wrong_programs();
    assert!(cases.len() >= 370, "only {} wrong programs", cases.len());
    let mut failures = Vec::new();
    for case in &cases {
        let complaints = complaints(case);
        if !complaints.is_empty() {
            let (group, name) = (&case.group, &case.name);
            failures.push(format!("{group}/{name}\n  {}", complaints.join("\n  ")));
        }
    }
    assert!(
        failures.is_empty(),
        "{} of {} programs:\n{}",
        failures.len(),
        cases.len(),
        failures.join("\n")
    );
}

#[test]
fn the_table_of_groups_is_complete() {
    let readme = read(&root().join("tests/data/errors/README.md"));
    let row = |line: &str| {
        let (group, rest) = line.strip_prefix("| `")?.split_once("` | ")?;
        let (mistake, count) = rest.strip_suffix(" |")?.rsplit_once(" | ")?;
        assert!(!mistake.trim().is_empty(), "{group}: which mistake?");
        Some((group.to_owned(), count.parse::<usize>().ok()?))
    };
    let listed: Vec<(String, usize)> = readme.lines().filter_map(row).collect();
    let cases = wrong_programs();
    let count = |group: &String| cases.iter().filter(|c| c.group == *group).count();
    let groups = wrong_groups().into_iter();
    let found: Vec<(String, usize)> = groups.map(|g| (g.clone(), count(&g))).collect();
    assert_eq!(listed, found);
    let mut names: Vec<&str> = cases.iter().map(|c| c.name.as_str()).collect();
    names.sort_unstable();
    let twice = names.windows(2).find(|pair| pair[0] == pair[1]);
    assert_eq!(twice, None, "a name of two programs");
}

/// The text that a hint gives for what lies under the span: "write `…`" or "did you mean `…`?", where nothing is left
/// out of it.
fn replacement(found: &Diagnostic) -> Option<&str> {
    let hint = found.hint.as_deref()?;
    let rest = hint
        .strip_prefix("write `")
        .or_else(|| hint.strip_prefix("did you mean `"))?;
    let (text, _) = rest.split_once('`')?;
    (!text.contains('…')).then_some(text)
}

/// What is wrong with the hints of a program: where each of them gives a text, and that is put in, no diagnostic may be
/// left.
fn bad_replacement(case: &WrongProgram) -> Option<String> {
    let mut found = compile(&case.text).diagnostics;
    found.sort_by_key(|d| std::cmp::Reverse(d.span.start));
    let mut mended = case.text.clone();
    for problem in &found {
        let range = problem.span.start as usize..problem.span.end as usize;
        mended.replace_range(range, replacement(problem)?);
    }
    let left = compile(&mended).diagnostics;
    let shown: Vec<String> = left.iter().map(|d| show(d, &mended)).collect();
    let name = &case.name;
    (!left.is_empty()).then(|| format!("{name}\n  {mended}  {}", shown.join("\n  ")))
}

#[test]
fn what_hints_say_compiles() {
    let cases = wrong_programs();
    let replaced = |case: &&WrongProgram| {
        let found = compile(&case.text).diagnostics;
        found.iter().all(|d| replacement(d).is_some())
    };
    let count = cases.iter().filter(replaced).count();
    assert!(count >= 88, "only {count} hints give a text");
    let bad: Vec<String> = cases.iter().filter_map(bad_replacement).collect();
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

/// Prints every diagnostic of the suite for a review:
/// `cargo test -p pullback-tests --test errors -- --ignored --nocapture every_diagnostic_for_review`
#[test]
#[ignore = "prints a text to be read"]
fn every_diagnostic_for_review() {
    for case in wrong_programs() {
        println!("=== {}/{}\n{}", case.group, case.name, rendered(&case.text));
    }
}

/// Rendered as the command line shows them, without colour.
fn rendered(text: &str) -> String {
    pullback_grammar::render(&compile(text).diagnostics, "picture.pull", text, false)
}

fn of_corpus(name: &str) -> String {
    let cases = wrong_programs();
    let case = cases
        .iter()
        .find(|c| c.name == name)
        .unwrap_or_else(|| panic!("no case {name}"));
    rendered(&case.text)
}

#[test]
fn diagnostics_read_well() {
    let names = [
        "unknown-function-sine",
        "stages",
        "ambiguous-division",
        "missing-closing-call",
        "duplicate-function",
        "recursion-of-three",
        "comparison-of-complex-chained",
        "levels-of-space-function",
        "param-outside-its-range",
        "setting-needs-vector",
        "stray-character-question",
        "unmatched-closing-crossed",
        "complex-argument-of-real-parameter",
        "formal-without-comma",
        "empty-file",
        "where-local-before-definition",
    ];
    let shown: Vec<String> = names
        .iter()
        .map(|n| format!("=== {n}\n{}", of_corpus(n)))
        .collect();
    insta::assert_snapshot!(shown.join("\n"));
}

#[test]
fn every_diagnostic_says_what_to_do() {
    let mut silent: Vec<String> = Vec::new();
    for case in wrong_programs() {
        let found = compile(&case.text).diagnostics;
        let without = found.iter().filter(|d| d.hint.is_none());
        silent.extend(without.map(|d| format!("{}: {}", case.name, show(d, &case.text))));
    }
    assert!(silent.is_empty(), "no hint:\n{}", silent.join("\n"));
}
