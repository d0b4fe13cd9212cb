//! The canonical format of every program that we have, and of many that nobody wrote: it says the same, and computes
//! the same numbers.

use pullback_compiler::check::is_builtin_function;
use pullback_compiler::compile;
use pullback_grammar::format;
use pullback_tests::corpus::{all_programs, gallery};
use pullback_tests::formatting;
use pullback_tests::mutate::{Random, mutated};

#[test]
fn the_gallery_is_in_the_canonical_format() {
    for source in gallery() {
        let formatted = format(&source.text, &is_builtin_function);
        assert_eq!(formatted.as_ref(), Some(&source.text), "{}", source.name);
        assert!(
            source.text.lines().all(|l| l.chars().count() <= 120),
            "{}",
            source.name
        );
    }
}

/// The same program with other blanks and line breaks.
fn squeezed(text: &str) -> String {
    let code: Vec<&str> = text.lines().filter(|l| !l.starts_with("//")).collect();
    code.join("\n")
        .replace("  where ", " where ")
        .replace(",\n", ",")
        .replace(" + ", "+")
        .replace(" = ", "=")
        .replace(", ", ",")
}

#[test]
fn formatting_keeps_every_number() {
    for source in gallery() {
        let program = compile(&source.text).program.expect("a program");
        let wanted = formatting::values(&program);
        assert!(wanted.len() >= 8, "{}", source.name);
        let rough = squeezed(&source.text);
        assert_ne!(rough, source.text);
        let formatted = format(&rough, &is_builtin_function).expect("no errors");
        assert_ne!(formatted, rough, "{}", source.name);
        let program = compile(&formatted).program.expect("a program");
        assert_eq!(formatting::values(&program), wanted, "{}", source.name);
        formatting::tree(&rough).unwrap_or_else(|problem| panic!("{}: {problem}", source.name));
    }
}

#[test]
fn formatting_keeps_what_random_programs_mean() {
    let corpus = all_programs();
    let mut random = Random::new(3);
    let (mut formatted, mut computed) = (0, 0);
    for _ in 0..12_000 {
        let bytes = mutated(&corpus, &mut random);
        let Ok(text) = std::str::from_utf8(&bytes) else {
            continue;
        };
        let held = formatting::tree(text).and_then(|()| formatting::evaluation(text));
        held.unwrap_or_else(|problem| panic!("{problem}\n---\n{text}"));
        formatted += usize::from(format(text, &is_builtin_function).is_some());
        let program = compile(text).program;
        computed += usize::from(program.is_some_and(|p| !formatting::values(&p).is_empty()));
    }
    assert!(
        formatted >= 1000 && computed >= 200,
        "only {formatted} programs, {computed} of them computed"
    );
}
