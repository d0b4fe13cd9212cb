//! The canonical format of every program that we have, and of many that nobody wrote: it says the same, and computes
//! the same numbers.

use pullback_compiler::check::is_builtin_function;
use pullback_compiler::compile;
use pullback_grammar::format;
use pullback_tests::corpus::{all_programs, gallery, special, surfaces};
use pullback_tests::formatting;
use pullback_tests::mutate::{Random, mutated};

#[test]
fn the_gallery_is_in_the_canonical_format() {
    let drawn = gallery().into_iter().chain(surfaces());
    for source in drawn.chain(special()) {
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

/// A line of the format is no longer than this.
const WIDTH: usize = 100;

#[test]
fn formatting_keeps_diagnostics() {
    let long = "x_of_the_first_of_all_points(x) * y_of_the_first_of_all_points(y)";
    let broken = format!("f(x, y) = {long} * {long} / 2 x where a = 1");
    for text in [
        // numbers too small, in ours and in another notation
        "f(x) = 1e-999 + x",
        "return 1e-999 + .0e5 + x",
        // divisions whose spaces say how they are read, on one line and on several
        "f(x, y) = y * 1/2 x",
        "f(x, y) = y * 1 / 2 x",
        "f(x, y) = 1/2(x) y",
        &broken.replace(" / ", "/"),
        &broken,
        // a name that one token stands for twice
        "float f(float x) { float s = x; s += unknown; return s; }",
        "float f(float x) { unknown += x; return unknown; }",
        "\\phi x",
    ] {
        let held = formatting::tree(text).and_then(|()| formatting::evaluation(text));
        held.unwrap_or_else(|problem| panic!("{problem}\n---\n{text}"));
        let formatted = format(text, &is_builtin_function).expect("no syntax errors");
        assert!(formatted.lines().all(|line| line.chars().count() <= WIDTH));
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
