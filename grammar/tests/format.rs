//! The canonical text of a program: how it looks, and that it says the same.

mod support;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use pullback_grammar::ast::MAX_SOURCE_BYTES;
use pullback_grammar::token::comments;
use pullback_grammar::{format, print, same_tree};
use support::generate::{Random, program as random_program, with_comments};
use support::{fixture, is_function, read};

/// Columns of a line.
const WIDTH: usize = 100;

/// The canonical text, which says the same, keeps every comment and is its own canonical text.
fn canonical(text: &str) -> String {
    let parsed = read(text);
    assert!(!parsed.has_errors(), "{text}: {:?}", parsed.diagnostics);
    let formatted = format(text, &is_function).expect("a text without errors");
    let again = read(&formatted);
    assert!(
        !again.has_errors() && same_tree(&parsed.file, &again.file),
        "{text}\nbecomes\n{formatted}\n{:?}",
        again.diagnostics
    );
    let of = |text: &str| -> Vec<String> {
        let words = |comment: &str| comment.split_whitespace().collect::<Vec<_>>().join(" ");
        comments(text).iter().map(|c| words(c.text(text))).collect()
    };
    assert_eq!(of(text), of(&formatted), "{text}\nbecomes\n{formatted}");
    let twice = format(&formatted, &is_function);
    assert_eq!(twice.as_deref(), Some(formatted.as_str()), "of {text}");
    for line in formatted.lines() {
        assert_eq!(line, line.trim_end(), "{formatted}");
    }
    formatted
}

#[test]
fn canonical_texts() {
    let count = fixture::check("format.txt", canonical);
    assert!(count >= 25, "{count}");
}

#[test]
fn texts_with_errors_have_no_format() {
    assert_eq!(format("f(x", &is_function), None);
    assert_eq!(format("", &is_function), None);
}

#[test]
fn texts_that_grow_beyond_the_bound() {
    let note = |text: &str, length: usize| format!("{text}//{}", "n".repeat(length));
    for (text, expected) in [
        ("f(x)=x+PI", "f(x) = x + pi"),
        ("f(x)=x^2+1", "f(x) = x^2 + 1"),
    ] {
        let length = MAX_SOURCE_BYTES - text.len() - 2;
        let expected = note(&format!("{expected}  "), length) + "\n";
        let formatted = format(&note(text, length), &is_function);
        assert!(formatted == Some(expected), "{text}");
    }
}

#[test]
fn line_breaks_of_other_systems() {
    let text = "a = 1\r\n\r\nf(x) = x /* one\r\n two */ + 1\r\n// three\r\n";
    let expected = "a = 1\n\nf(x) = x /* one\n two */ + 1\n// three\n";
    assert_eq!(canonical(text), expected);
    assert_eq!(canonical("\u{FEFF}a = 1\rb=2"), "a = 1\nb = 2\n");
}

#[test]
fn random_trees() {
    for seed in 0..3000 {
        let random = &mut Random::new(seed);
        let printed = print(&random_program(random));
        canonical(&printed);
        canonical(&with_comments(&printed, random));
    }
}

#[test]
fn long_and_deep_texts() {
    let sum = format!("x{}", " + x".repeat(20_000));
    assert!(canonical(&sum).lines().count() > 10_000);
    // Every level of operators in every bracket, on the smallest stack that threads have by default.
    let level = "a < 0 or b and c < d + e * (";
    for (open, count) in [
        (level, 26),
        ("max(1, -", 60),
        ("(x + ", 190),
        ("{a < 1: ", 99),
    ] {
        let close = match open.chars().next() {
            Some('{') => ", else: 2}",
            _ => ")",
        };
        let deep = format!("{}x{}", open.repeat(count), close.repeat(count));
        let worker = std::thread::Builder::new().stack_size(2 << 20);
        let thread = worker.spawn(move || canonical(&deep).len());
        assert!(thread.expect("a thread").join().expect("no overflow") > 500);
    }
}

/// A blank between two tokens that can stand side by side; inside of brackets, lines may end.
fn blank(inside: bool) -> BoxedStrategy<&'static str> {
    if inside {
        prop::sample::select(
            &[
                "",
                "",
                " ",
                "  ",
                "\n",
                " // note\n",
                "\n# a\n  # b\n",
                " /**/ ",
                " /* a\n b */ ",
            ][..],
        )
        .boxed()
    } else {
        prop::sample::select(&["", "  "][..]).boxed()
    }
}

/// An expression that can stand in any operand: in brackets, where there is need.
fn operand() -> impl Strategy<Value = String> {
    let leaf = prop::sample::select(
        &[
            "x",
            "y",
            "θ₁",
            "2",
            "0.50",
            "1e-3",
            ".5",
            "2i",
            "π",
            "x²",
            "n!",
            "p.xy",
            "a_rather_long_name",
        ][..],
    )
    .prop_map(str::to_owned);
    leaf.prop_recursive(5, 80, 6, |inner| {
        let gap = blank(true);
        let sign = prop::sample::select(
            &["+", "-", "*", "/", "^", "·", "**", "−", "÷", "+ -", "/ -", " k(y) +", " |y|·", " √y −"][..],
        );
        let sum = prop::collection::vec((sign, gap.clone(), gap.clone(), inner.clone()), 1..8);
        let items = prop::collection::vec((gap.clone(), inner.clone()), 1..5);
        let arms = prop::collection::vec((inner.clone(), gap.clone(), inner.clone()), 1..4);
        let compare = prop::sample::select(&["<", "<=", "≥", "==", "!="][..]);
        let join = prop::sample::select(&[" and ", " or ", "∧", " ∨ ", "&&"][..]);
        let list = |items: Vec<(&str, String)>| {
            let items: Vec<String> = items.iter().map(|(gap, item)| format!("{gap}{item}")).collect();
            items.join(",")
        };
        prop_oneof![
            4 => (inner.clone(), sum).prop_map(|(first, rest)| {
                let rest: String = rest.iter().map(|(sign, a, b, x)| format!("{a}{sign}{b}{x}")).collect();
                format!("({first}{rest})")
            }),
            2 => items.clone().prop_map(move |items| format!("max({})", list(items))),
            1 => inner.clone().prop_map(|x| format!("(|{x}|)")),
            1 => inner.clone().prop_map(|x| format!("√{x}")),
            1 => (blank(false), inner.clone()).prop_map(|(gap, x)| format!("sin{gap}({x})")),
            1 => (compare, join, [inner.clone(), inner.clone(), inner.clone(), inner.clone()]).prop_map(
                |(c, j, [a, b, x, y])| format!("(if {a} {c} {b}{j}not {b}<{a} then {x} else {y})")
            ),
            1 => (arms, gap.clone(), inner.clone()).prop_map(|(arms, gap, other)| {
                let arms: String = arms.iter().map(|(a, gap, x)| format!("{gap}{a} < 1:{x},")).collect();
                format!("{{{arms}{gap}else:{other},{gap}}}")
            }),
            1 => (gap.clone(), inner.clone(), inner.clone()).prop_map(|(gap, n, x)| {
                format!("sum (k{gap} in 1{gap}..{n},{gap}product(j in k..2 ,{x}))")
            }),
            1 => (gap.clone(), inner.clone(), inner.clone(), inner.clone()).prop_map(|(gap, n, x, y)| {
                format!("iterate({n},{gap}z={x},w =1,{gap}({y}, z){gap} until{gap} z<{n}{gap})")
            }),
            1 => (gap.clone(), inner.clone(), inner.clone()).prop_map(|(gap, x, y)| {
                format!("(p{gap} where p=({x},1),{gap}p . x ={gap}{y})")
            }),
            1 => (gap, inner.clone(), inner.clone(), inner).prop_map(|(gap, x, a, b)| {
                format!("({x}{gap} where{gap} a={a},{gap}b = {b})")
            }),
        ]
    })
}

/// A program with every kind of statement.
fn program() -> impl Strategy<Value = String> {
    let operands = prop::collection::vec(operand(), 6..7);
    (operands, blank(false), blank(true), prop::sample::select(&["\n", " ;", "; // note\n", "\n\n\n// a\n\n"][..])).prop_map(
        |(e, a, b, end)| {
            let outside = if b.contains('\n') { b } else { "\n" };
            format!(
                "f(x,{b}y:complex){a}={b}{}{outside}+{b}{}{outside}where a={},{b}c = {}{end}param k={a}1{a} in {a}0..3{end}\
                 show{a} levels(f){{{b}height=2..{},{b}spacing={b}1,{b}}}{end}c={}\n",
                e[0], e[1], e[2], e[3], e[4], e[5]
            )
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, rng_seed: RngSeed::Fixed(7), ..ProptestConfig::default() })]

    #[test]
    fn programs(text in program()) {
        canonical(&text);
    }

    #[test]
    fn lines_are_short(terms in prop::collection::vec(prop::sample::select(&["sin(x)", "y²", "exp(-x² - y²)/3"][..]), 1..60)) {
        // Whatever can be broken is.
        let sum = terms.join("+");
        let text = canonical(&format!("f(x, y) = max({sum}, {sum}) * ({sum}) where a = {sum}, b = {{x < {sum}: {sum}, else: 1}}"));
        for line in text.lines() {
            prop_assert!(line.chars().count() <= WIDTH, "{line}\nof\n{text}");
        }
    }
}
