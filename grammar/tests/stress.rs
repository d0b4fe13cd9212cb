//! Texts of every kind and shape: no panic, no overflow of a small stack, no time beyond linear.

mod support;

use std::time::{Duration, Instant};

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use pullback_grammar::{format, parse_bytes, print, render};
use support::{check_structure, is_function, read};

const PIECES: &[&str] = &[
    "x",
    "y",
    "z",
    "f",
    "a",
    "k1",
    "sin",
    "max",
    "π",
    "e",
    "i",
    "1",
    "2.5",
    "3i",
    ".5",
    "1e999",
    "²",
    "⁻¹",
    "'",
    "+",
    "-",
    "*",
    "/",
    "^",
    "!",
    "√",
    "(",
    "(",
    ")",
    ")",
    "{",
    "}",
    "|",
    ",",
    ";",
    ":",
    ".",
    "..",
    "=",
    "<",
    "<=",
    ">",
    "==",
    "!=",
    "param",
    "in",
    "where",
    "show",
    "if",
    "then",
    "else",
    "and",
    "or",
    "not",
    "\n",
    " ",
    "// c\n",
    "/*",
    "*/",
    "@",
    "é",
    "–",
    "[",
    "]",
    "&",
    "\u{0}",
    "f(x) = ",
    "a = ",
    "where a = ",
    "sum(k in 1..n, ",
    "sum(",
    "∑(",
    "k in 1..3, ",
    "z = 0, ",
    "iterate(9, z = 0, ",
    "until",
    "integral(",
    "integral(t in 0..1, ",
    ", t, 0, 1)",
    "grad(f)(",
    "where p.xy = ",
    "for ",
    "surface(",
    ":=",
    "\r\n",
    "{ x < 0: ",
    "else: ",
    "=<",
    "漢",
];

/// Pieces of other notations.
const FOREIGN: &[&str] = &[
    "\\frac",
    "\\frac{",
    "}{",
    "}",
    "{",
    "\\sqrt",
    "\\sqrt[3]",
    "\\sqrt[",
    "]",
    "[",
    "\\sin",
    "\\sin ",
    "\\ln",
    "\\log_",
    "\\log_{",
    "^{",
    "^",
    "_{",
    "_",
    "x_{",
    "\\alpha",
    "\\pi",
    "\\phi_1",
    "\\left(",
    "\\right)",
    "\\left|",
    "\\right|",
    "\\left",
    "\\right",
    "\\{",
    "\\}",
    "\\lfloor",
    "\\rfloor",
    "\\lvert",
    "\\rvert",
    "|",
    "||",
    "\\cdot",
    "\\le",
    "\\,",
    "\\\\",
    "\\ ",
    "\\",
    "\\sum",
    "\\sum_{k=1}^{n}",
    "\\prod_{k=",
    "\\int",
    "\\int_0^1",
    "dx",
    "\\mathrm{d}x",
    "\\begin{cases}",
    "\\end{cases}",
    "\\begin{aligned}",
    "\\end{aligned}",
    "\\begin{pmatrix}",
    "&",
    "\\text{if }",
    "\\text{otherwise}",
    "\\operatorname{",
    "\\operatorname{f}",
    "\\bar",
    "\\bar{z}",
    "\\foo",
    "\\lim",
    "\\prime",
    "$",
    "$$",
    "?",
    ":",
    "c ? a : b",
    " if ",
    " else ",
    "np.",
    "np.sin(",
    "np.where(",
    "Math.PI",
    "std::",
    "1.0f",
    "2.",
    "3u",
    "2j",
    "f",
    "h",
    "vec3<f32>(",
    "vec3f(",
    "float(",
    "float ",
    "let ",
    "return ",
    "float f(vec3 p) {",
    "def f(x): return ",
    "lambda x: ",
    "f[x_] := ",
    "Sin[",
    "x.^2",
    " .* ",
    ":=",
    "a += 1;",
    "x",
    "y",
    "1",
    "12",
    "(",
    ")",
    "+",
    "-",
    "*",
    "/",
    "=",
    ",",
    ";",
    "\n",
    " ",
    "// c\n",
    "f(x) = ",
    "where a = ",
    "{ x < 0: ",
    "PI",
    "tg(",
    "atan(y, x)",
    "==",
    "<",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, rng_seed: RngSeed::Fixed(20), ..ProptestConfig::default() })]

    #[test]
    fn any_tokens(
        pieces in prop_oneof![
            prop::collection::vec(prop::sample::select(PIECES), 0..8),
            prop::collection::vec(prop::sample::select(PIECES), 0..60),
        ],
        spaced in any::<bool>(),
    ) {
        let text = pieces.join(if spaced { " " } else { "" });
        let parsed = read(&text);
        let _ = print(&parsed.file);
        let _ = render(&parsed.diagnostics, "x", &text, false);
        if !parsed.has_errors() {
            let printed = print(&parsed.file);
            let again = read(&printed);
            prop_assert_eq!(support::show_file(&parsed.file), support::show_file(&again.file), "{}\n{}", text, printed);
            prop_assert_eq!(print(&again.file), printed);
            let formatted = format(&text, &is_function).unwrap_or_default();
            prop_assert_eq!(support::show_file(&parsed.file), support::show_file(&read(&formatted).file), "{}\n{}", text, formatted);
            let again = format(&formatted, &is_function);
            prop_assert_eq!(again, Some(formatted), "{}", text);
        }
    }

    #[test]
    fn any_foreign_tokens(
        pieces in prop_oneof![
            prop::collection::vec(prop::sample::select(FOREIGN), 0..8),
            prop::collection::vec(prop::sample::select(FOREIGN), 0..50),
        ],
        spaced in any::<bool>(),
    ) {
        let text = pieces.join(if spaced { " " } else { "" });
        let parsed = read(&text);
        let _ = render(&parsed.diagnostics, "x", &text, false);
        let printed = print(&parsed.file);
        if !parsed.has_errors() {
            let again = read(&printed);
            prop_assert_eq!(support::show_file(&parsed.file), support::show_file(&again.file), "{}\n{}", text, printed);
            let formatted = format(&text, &is_function).unwrap_or_default();
            prop_assert_eq!(support::show_file(&parsed.file), support::show_file(&read(&formatted).file), "{}\n{}", text, formatted);
            let again = format(&formatted, &is_function);
            prop_assert_eq!(again, Some(formatted), "{}", text);
        }
    }

    #[test]
    fn any_text(text in "\\PC{0,80}") {
        read(&text);
    }

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let parsed = parse_bytes(&bytes, &is_function);
        check_structure(&String::from_utf8_lossy(&bytes), &parsed);
    }
}

/// Runs on a stack of 2 MiB, as threads have by default.
fn on_small_stack(body: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().stack_size(2 << 20);
    thread
        .spawn(body)
        .expect("a thread")
        .join()
        .expect("no panic");
}

fn codes(text: &str) -> Vec<&'static str> {
    let start = Instant::now();
    let parsed = read(text);
    assert!(
        start.elapsed() < Duration::from_secs(5),
        "{:?}",
        text.get(..20)
    );
    let _ = print(&parsed.file);
    parsed
        .diagnostics
        .iter()
        .map(|diagnostic| diagnostic.code)
        .collect()
}

#[test]
fn deep_texts_are_refused_once() {
    on_small_stack(|| {
        let deep = [
            "(",
            "-",
            "+",
            "√",
            "not ",
            "x^",
            "2^-",
            "if x then y else ",
            "if ",
            "if x then ",
            "|",
            "{",
            "{ x: ",
            "{ else: ",
            "sin(",
            "foo(",
            "f'(",
            "sin²(",
            "x(",
            "(x, ",
            "max(x, ",
            "(x where a = ",
            "grad(",
            "grad(sin)(",
            "sum(",
            "sum(k in ",
            "sum(k in 1..",
            "sum(k in 1..2, ",
            "sum(k = ",
            "sum(k, {k, ",
            "iterate(",
            "iterate(9, z = ",
            "iterate(9, z = 0, ",
            "iterate(9, z = 0, z until ",
            "sum(k in 1..2, iterate(9, z = 0, ",
            "integral(",
            "integral(x, t, ",
            "integral(t in 0..",
            "integral(t in 0..1, ",
            "x where p.x = (",
            "x + (",
            "-(",
            "√-",
            "x where a = (",
            "x^sin(",
            "not (not ",
            "{ x < (",
        ];
        for piece in deep {
            let text = piece.repeat(100_000);
            assert_eq!(
                codes(&text)
                    .iter()
                    .filter(|code| **code == "too-deep")
                    .count(),
                1,
                "{piece}"
            );
            let codes = codes(&format!("f(x) = {text}x\ng(x) = @"));
            assert_eq!(
                codes.iter().filter(|code| **code == "too-deep").count(),
                1,
                "{piece}"
            );
        }
        for piece in ["!", "²", ".x", " where a = 1", "² "] {
            let found = codes(&format!("x{}", piece.repeat(100_000)));
            let expected: &[&str] = if piece == "²" {
                &["number-too-large"]
            } else {
                &["too-deep"]
            };
            assert_eq!(found, expected, "{piece}");
        }
    });
}

#[test]
fn deep_foreign_texts_are_refused_once() {
    on_small_stack(|| {
        let deep = [
            "\\frac{",
            "\\frac{x}{",
            "\\frac12 + \\sqrt{",
            "\\sqrt{",
            "\\sqrt[n]{",
            "\\left(",
            "\\left|",
            "\\lfloor ",
            "\\{",
            "\\bar{",
            "\\sin{",
            "\\sin\\cos ",
            "\\sin^n\\cos ",
            "x^{x + ",
            "\\log_{x + ",
            "\\begin{cases} ",
            "\\begin{cases} x & x < ",
            "\\sum_{k=1}^3 ",
            "\\sum_{k=",
            "\\int_0^1 ",
            "np.where(",
            "np.where(x < 1, ",
            "x ? ",
            "x ? y : ",
            "(x ? y : ",
            "x if y else ",
            "x if (",
            "Sin[",
            "vec3<f32>(",
        ];
        for piece in deep {
            for text in [
                piece.repeat(50_000),
                format!("f(x) = {}x\ng(x) = @", piece.repeat(1000)),
            ] {
                let found = codes(&text);
                let deep = found.iter().filter(|code| **code == "too-deep").count();
                assert!(deep == 1, "{piece}: {found:?}");
            }
        }
    });
}

#[test]
fn long_damaged_foreign_texts_are_read_in_linear_time() {
    on_small_stack(|| {
        for piece in FOREIGN {
            let _ = codes(&piece.repeat(40_000));
            for text in [
                format!("x {piece} y "),
                format!("({piece} x) \n"),
                format!("{{{piece}"),
            ] {
                let _ = codes(&text.repeat(4_000));
            }
        }
        let mut mebibyte = "\\frac{".repeat((1 << 20) / 6);
        let _ = codes(&mebibyte);
        mebibyte.push_str(&"}".repeat(1000));
        let _ = codes(&mebibyte);
    });
}

#[test]
fn the_bound_on_nesting_is_met() {
    on_small_stack(|| {
        let nest = |open: &str, close: &str, depth: usize| {
            format!("{}x{}", open.repeat(depth), close.repeat(depth))
        };
        for (open, close) in [
            ("(", ")"),
            ("-", ""),
            ("sin(", ")"),
            ("|", "|"),
            ("x^", ""),
            ("{ else: ", "}"),
        ] {
            assert_eq!(codes(&nest(open, close, 200)), [""; 0], "{open}");
            assert_eq!(codes(&nest(open, close, 201)), ["too-deep"], "{open}");
        }
        // A level of these counts six: each right operand is one deeper than its user.
        let worst = "x or x and x < x + x * x^(";
        assert_eq!(
            codes(&format!("{}x{}", worst.repeat(33), ")".repeat(33))),
            [""; 0]
        );
        let mixed = "{ not not x: if x then |-√(1 + 2 sin(";
        let _ = codes(&mixed.repeat(1000));
    });
}

#[test]
fn chains_have_any_length() {
    on_small_stack(|| {
        for piece in [
            "x + ", "x * ", "x / ", "x ", "x - ", "x and ", "x or ", "x < ", "y (x) ", "x - -",
            "|x| ",
        ] {
            assert_eq!(
                codes(&format!("{}x", piece.repeat(100_000))),
                [""; 0],
                "{piece}"
            );
        }
        let found = codes(&format!("{}x", "x/2y * ".repeat(100_000)));
        assert_eq!(found.len(), 201);
    });
}

#[test]
fn long_damaged_texts_are_read_in_linear_time() {
    on_small_stack(|| {
        let pieces = [
            ")",
            "}",
            ",",
            "=",
            ":",
            ";",
            "then ",
            "where ",
            "param ",
            "show ",
            "..",
            "a = ",
            "f(x) = ",
            "f(",
            "f(\n",
            "(}",
            "{)",
            "x y = ",
            "@ ",
            "é",
            "x where a = 1, ",
            "f(x) = (\n",
            "a(b, ",
            "a(b,\n",
            "a\nb(",
            "1 2 ",
            "sin ",
            "f(x = ",
            "/*",
            "'",
            "²",
            "!",
            ".",
            "x.",
            "1/2x ",
            "in ",
            "else ",
            "(x) = ",
            "f(a)(",
            "show s(",
            "show s(f) {a = 1\n",
            "[",
            "]",
            "|x ",
            "(|",
            "f'",
            "x + not ",
            "sum(k, 1, 2) ",
            "sum(x, ",
            "x where a = 1 where b = 2 ",
            "x where a = 1, b = 2, ",
            "where p.x = ",
            "p.x = ",
            "iterate(z) ",
            "iterate(9, z = 0, z, z) ",
            "until ",
            "x until ",
            "integral(x, ",
            "integral(x, t) ",
            "for ",
            "for x ",
            "∑ ",
            "{k, ",
        ];
        for piece in pieces {
            let _ = codes(&piece.repeat(100_000));
        }
        for piece in ["x, ", "k = 1, ", "k in 1..2, ", "x until "] {
            for open in ["sum(", "sum(k in 1..2, ", "iterate(9, ", "integral("] {
                let _ = codes(&format!("{open}{}", piece.repeat(50_000)));
            }
        }
        for piece in ["sum(k in ", "sum(x ", "iterate(9, z = 0, ", "integral(x + "] {
            let count = pullback_grammar::ast::MAX_SOURCE_BYTES / piece.len();
            let _ = codes(&piece.repeat(count));
        }
    });
}

#[test]
fn long_tokens_are_read() {
    on_small_stack(|| {
        for piece in ["a", "1", ".1e1", " ", "\n", "²", "α", "\t\u{a0}", "é", "'"] {
            let _ = codes(&format!("x{}", piece.repeat(500_000)));
        }
        for text in ["# ", "// ", "/* ", "/* */ + "] {
            let _ = codes(&format!("x {text}{}", "a".repeat(1_000_000)));
        }
    });
}

#[test]
fn functions_of_c_that_are_too_deep_are_refused() {
    on_small_stack(|| {
        for (depth, fits) in [(150, true), (199, false), (260, false)] {
            let (open, close) = ("(".repeat(depth), ")".repeat(depth));
            let text =
                format!("float s(vec3 p, float r) {{ return length({open}p{close}) - r; }}\n");
            let parsed = read(&text);
            check_structure(&text, &parsed);
            assert_eq!(!parsed.has_errors(), fits, "{depth}");
        }
    });
}
