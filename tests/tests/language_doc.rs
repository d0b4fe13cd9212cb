//! The programs of `docs/language.md` and `README.md`: they compile, or fail where they say so.

use pullback_compiler::compile;
use pullback_grammar::render;
use pullback_tests::corpus::{Block, blocks};
use pullback_tests::holds;

/// What is wrong with a block, if anything.
fn complaint(document: &str, block: &Block) -> Option<String> {
    let answer = compile(&block.text);
    let place = format!("{document}:{}", block.line);
    if let Err(problem) = holds::compilation(&block.text, &answer) {
        return Some(format!("{place}: {problem}"));
    }
    let shown = render(&answer.diagnostics, &place, &block.text, false);
    match (block.info.as_str(), answer.program.is_some()) {
        // an example is clean: a warning in it would teach the wrong thing
        ("pull", true) if answer.diagnostics.is_empty() => None,
        ("pull error", false) => None,
        ("pull warning", true) if !answer.diagnostics.is_empty() => None,
        ("pull" | "pull warning", _) => Some(format!("{place}: unexpected answer\n{shown}")),
        ("pull error", true) => Some(format!("{place}: compiles, but says that it fails")),
        (other, _) => Some(format!("{place}: unknown kind of block `{other}`")),
    }
}

fn check(document: &str, at_least: usize) {
    let blocks: Vec<Block> = blocks(document)
        .into_iter()
        .filter(|b| b.info.starts_with("pull"))
        .collect();
    assert!(
        blocks.len() >= at_least,
        "{document} has only {} programs",
        blocks.len()
    );
    let complaints: Vec<String> = blocks
        .iter()
        .filter_map(|b| complaint(document, b))
        .collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn programs_of_the_language_reference() {
    check("docs/language.md", 20);
}

#[test]
fn every_block_of_the_language_reference_is_a_program() {
    let other: Vec<String> = blocks("docs/language.md")
        .iter()
        .filter(|b| !b.info.starts_with("pull"))
        .map(|b| format!("line {}: ```{}", b.line, b.info))
        .collect();
    assert!(other.is_empty(), "{}", other.join("\n"));
}
