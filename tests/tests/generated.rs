//! Wrong programs that are too large to store: `tests/data/errors/generated.md`. Each runs on a thread of 2 MiB,
//! in bounded time.

use std::fmt::Write as _;
use std::time::{Duration, Instant};

use pullback_compiler::{Compilation, compile, compile_bytes};
use pullback_grammar::Diagnostic;
use pullback_tests::corpus::gallery;
use pullback_tests::holds;

/// Longest that one program may take, on a slow machine that does other things too.
const LIMIT: Duration = Duration::from_secs(60);

/// Runs on the smallest stack that threads have by default.
fn on_small_stack<T: Send + 'static>(name: &str, run: impl FnOnce() -> T + Send + 'static) -> T {
    let builder = std::thread::Builder::new()
        .name(name.to_owned())
        .stack_size(2 << 20);
    let thread = builder.spawn(run).expect("a thread");
    thread.join().expect("no panic")
}

/// Compiles on a small stack; holds what every answer has, the time, and the codes of its diagnostics.
fn answer(name: &str, text: String) -> Compilation {
    let name = name.to_owned();
    on_small_stack(&name.clone(), move || {
        let start = Instant::now();
        let answer = compile(&text);
        let took = start.elapsed();
        assert!(took < LIMIT, "{name} took {took:?}");
        if let Err(problem) = holds::compilation(&text, &answer) {
            panic!("{name}: {problem}");
        }
        // what is rendered is bounded, too
        let shown = pullback_grammar::render(&answer.diagnostics, "x.pull", &text, false);
        assert!(
            shown.len() < 200_000,
            "{name}: {} bytes are rendered",
            shown.len()
        );
        answer
    })
}

fn codes(answer: &Compilation) -> Vec<&'static str> {
    answer.diagnostics.iter().map(|d| d.code).collect()
}

/// One of the lists of codes is given; an empty one means a program without a remark.
fn check(name: &str, text: impl Into<String>, expected: &[&[&str]]) {
    let answer = answer(name, text.into());
    let found = codes(&answer);
    let fits = expected.contains(&found.as_slice());
    assert!(
        fits,
        "{name}: found {found:?}\n{:?}",
        answer.diagnostics.first()
    );
}

const MANY: usize = 100_000;

#[test]
fn deep_nesting_is_an_error_that_names_the_bound() {
    let deep: &[&[&str]] = &[&["too-deep"]];
    check(
        "brackets",
        format!("{}x{}", "(".repeat(MANY), ")".repeat(MANY)),
        deep,
    );
    check("opening brackets", "(".repeat(MANY), deep);
    check(
        "bars",
        format!("{}x", "|".repeat(MANY)),
        &[&["too-deep"], &["missing-closing"]],
    );
    check("braces", "{".repeat(MANY), deep);
    for prefix in ["-", "not ", "√", "- √ "] {
        check(prefix, format!("{}x", prefix.repeat(MANY)), deep);
    }
    check("powers", format!("{}2", "2^".repeat(MANY)), deep);
    check(
        "conditionals",
        format!("{}2", "if x < 0 then 1 else ".repeat(MANY)),
        deep,
    );
    check("conditions", format!("{}x", "if ".repeat(MANY)), deep);
    check(
        "calls",
        format!("{}x{}", "sin(".repeat(MANY), ")".repeat(MANY)),
        deep,
    );
    check("mixed", "sin(|{x < (".repeat(MANY), deep);
    let answer = answer("brackets", "(".repeat(MANY));
    assert!(
        answer.diagnostics[0].message.contains("200"),
        "{:?}",
        answer.diagnostics[0]
    );
}

#[test]
fn long_chains_are_no_nesting() {
    let fine: &[&[&str]] = &[&[]];
    check("sum", format!("x{}", " + x".repeat(MANY)), fine);
    check("difference", format!("x{}", " - y".repeat(MANY)), fine);
    check("product", format!("x{}", " x".repeat(MANY)), fine);
    check("quotient", format!("x{}", " / y".repeat(MANY)), fine);
    check(
        "comparisons",
        format!("if x{} then 1 else 0", " < y".repeat(MANY)),
        fine,
    );
    check(
        "conjunction",
        format!("if x < y{} then 1 else 0", " and x < y".repeat(MANY)),
        fine,
    );
    check(
        "superscripts",
        format!("x{}", "²".repeat(MANY)),
        &[&["number-too-large"]],
    );
    check(
        "squares",
        format!("x{}", " ²".repeat(MANY)),
        &[&[], &["too-deep"]],
    );
    check(
        "factorials",
        format!("x{}", "!".repeat(MANY)),
        &[&[], &["too-deep"]],
    );
    check(
        "members",
        format!("p{}", ".xyz".repeat(MANY)),
        &[&["wrong-result-type"], &["too-deep"]],
    );
    check(
        "primes",
        format!("f{}(x)", "'".repeat(MANY)),
        &[&["unknown-function"], &["not-yet", "unknown-function"]],
    );
}

/// `f0(x) = x`, and each next calls the one before, `wrap`ped in something.
fn chain(count: usize, wrap: impl Fn(&str) -> String) -> String {
    let mut text = "f0(x) = x\n".to_owned();
    for k in 1..=count {
        let _ = writeln!(text, "f{k}(x) = {}", wrap(&format!("f{}(x)", k - 1)));
    }
    let _ = writeln!(text, "show levels(f{count}(x) + y)");
    text
}

#[test]
fn long_chains_of_calls_are_bounded() {
    check("50 calls", chain(50, str::to_owned), &[&[]]);
    check("66 calls", chain(66, str::to_owned), &[&["too-deep"]]);
    check(
        "10000 calls",
        chain(10_000, str::to_owned),
        &[&["too-deep"]],
    );
    let nested = |call: &str| format!("{}{call}{}", "sin(".repeat(180), ")".repeat(180));
    check(
        "60 calls, each nested 180 deep",
        chain(60, nested),
        &[&[], &["too-deep"]],
    );
    let mut constants = "a0 = 1\n".to_owned();
    for k in 1..200 {
        let _ = writeln!(constants, "a{k} = a{} + 1", k - 1);
    }
    check(
        "200 constants",
        constants + "x + y + a199",
        &[&["too-deep"]],
    );
}

#[test]
fn shared_parts_are_computed_once() {
    let doubled = |call: &str| format!("{call} + {call}");
    check("60 doublings", chain(60, doubled), &[&[]]);
    let mut constants = "a0(x) = x\n".to_owned();
    for k in 1..60 {
        let _ = writeln!(constants, "a{k}(x) = a{0}(x) + a{0}(x)", k - 1);
    }
    check(
        "60 doublings of functions",
        constants + "a59(x) + y",
        &[&[]],
    );
}

#[test]
fn explosions_hit_the_budget() {
    let mut text = "g0(x) = sin(x)\n".to_owned();
    for k in 1..=40 {
        let _ = writeln!(text, "g{k}(x) = g{0}(x + 1) + g{0}(x^2 - {k})", k - 1);
    }
    text.push_str("show levels(g40(x) + y)");
    let answer = answer("explosion", text);
    assert_eq!(codes(&answer), ["too-large"]);
    assert!(
        answer.diagnostics[0].message.contains("2000000"),
        "{:?}",
        answer.diagnostics[0]
    );
}

#[test]
fn long_cycles_are_reported_once() {
    let mut text = "x + y\n".to_owned();
    for k in 0..10_000 {
        let _ = writeln!(text, "a{k} = a{} + 1", (k + 1) % 10_000);
    }
    check("cycle of constants", text, &[&["cyclic-constant"]]);
    let mut text = "x + y\n".to_owned();
    for k in 0..10_000 {
        let _ = writeln!(text, "g{k}(x) = g{}(x) + 1", (k + 1) % 10_000);
    }
    check("cycle of functions", text, &[&["recursion"]]);
}

#[test]
fn bounds_of_the_program() {
    let mut text = String::new();
    for k in 0..65 {
        let _ = writeln!(text, "param k{k} = 1");
    }
    text.push_str("x + y");
    let found = answer("65 params", text.clone());
    assert_eq!(codes(&found), ["too-many-params"]);
    assert_eq!(found.diagnostics[0].span.text(&text), "k64");
    check("64 params", text.replace("param k64 = 1\n", ""), &[&[]]);
    let letters: Vec<String> = (0..17).map(|k| format!("a{k}")).collect();
    let text = format!("f({}) = {}", letters.join(", "), letters.join(" + "));
    check("17 arguments", text, &[&["no-scene"]]);
}

#[test]
fn bounds_of_the_text() {
    let limit = 4 << 20;
    check(
        "beyond the bound",
        " ".repeat(limit + 1),
        &[&["source-too-large"]],
    );
    // an answer, whatever it is
    for c in [" ", "x", "\n", "/", "*"] {
        answer(c, c.repeat(limit));
    }
    for c in ["(", "|", "1", ";", "$", "π", "f(", "x,", "²", "'"] {
        answer(c, c.repeat(limit / 16));
    }
    check(
        "a million separators",
        ";".repeat(1_000_000),
        &[&["empty-source"], &["nothing-to-show"]],
    );
    check("a long name", "a".repeat(1_000_000), &[&["unknown-name"]]);
    check(
        "a long function",
        format!("{}(x)", "a".repeat(1_000_000)),
        &[&["unknown-function"]],
    );
    check(
        "a long number",
        format!("x + {}", "1".repeat(1_000_000)),
        &[&["number-too-large"]],
    );
    check(
        "a long one",
        format!("x + 1{}e-400", "0".repeat(400)),
        &[&[]],
    );
}

#[test]
fn many_mistakes_are_counted_not_listed() {
    let mut names = "f(x, y) = x".to_owned();
    for k in 0..10_000 {
        let _ = write!(names, " + unknown{k}");
    }
    for (name, text) in [
        ("names", names),
        ("strays", format!("x + y {}", "@ ".repeat(10_000))),
    ] {
        let found = answer(name, text);
        assert!(
            (100..=210).contains(&found.diagnostics.len()),
            "{name}: {}",
            found.diagnostics.len()
        );
        let last = found.diagnostics.last().map(|d| d.code);
        assert_eq!(last, Some("too-many-problems"), "{name}");
    }
}

#[test]
fn many_definitions_take_linear_time() {
    let locals: Vec<String> = (0..20_000).map(|k| format!("a{k} = x + {k}")).collect();
    check(
        "locals",
        format!("f(x, y) = y + a0 where {}", locals.join(", ")),
        &[&[]],
    );
    let mut unknown = "f(x, y) = x".to_owned();
    let mut defined = String::new();
    for k in 0..10_000 {
        let _ = write!(unknown, " + unknown{k}");
        let _ = writeln!(defined, "defined{k} = {k}");
    }
    answer("unknown beside defined", format!("{defined}{unknown}"));
    let mut functions = String::new();
    for k in 0..10_000 {
        let _ = writeln!(functions, "g{k}(a, b) = a.x + (b < 1)");
    }
    answer("unused functions with errors", format!("{functions}x + y"));
    answer("formulas", "x + y\n".repeat(50_000));
    let shows = "show levels(x y)\n".repeat(10_000);
    check("shows", shows, &[&["too-many-shows"]]);
    answer("params", "param a = 1\n".repeat(50_000));
    let settings = "height = 2, ".repeat(50_000);
    answer("settings", format!("show levels(x y) {{ {settings} }}"));
    // unused functions that explode must not each use up the budget
    let mut explosive = "g0(x) = sin(x)\n".to_owned();
    for k in 1..=300 {
        let _ = writeln!(
            explosive,
            "g{k}(x) = g{0}(x + 1) + g{0}(x^2 - {k})",
            (k - 1) % 15
        );
    }
    answer("explosive unused functions", format!("{explosive}x + y"));
}

#[test]
fn bytes_that_are_no_text() {
    let check = |bytes: &[u8], hint: &str| {
        let found = compile_bytes(bytes);
        assert_eq!(codes(&found), ["not-utf8"], "{bytes:?}");
        assert!(
            found.diagnostics[0]
                .hint
                .as_deref()
                .is_some_and(|h| h.contains(hint))
        );
        assert!(found.program.is_none());
        found.diagnostics[0].span.start
    };
    assert_eq!(check(b"f(x)=\xff\xfe", "UTF-8"), 5);
    assert_eq!(check(b"\xff\xfex\0+\0y\0", "save it as UTF-8"), 0);
    assert_eq!(check(b"\xfe\xff\0x\0+\0y", "save it as UTF-8"), 0);
    assert_eq!(check(b"x + y // \xc3\x28", "UTF-8"), 9);
}

#[test]
fn blanks_of_other_systems() {
    let fine: &[&[&str]] = &[&[]];
    check("byte order mark", "\u{FEFF}x + y", fine);
    check("CRLF", "a = 1\r\nf(x, y) = a x +\r\n y\r\n", fine);
    check("CR", "a = 1\rf(x, y) = a x + y", fine);
    check("form feed", "x\u{C} + y", fine);
    check("NUL", "x + \0y", &[&["stray-character"]]);
}

#[test]
fn damaged_gallery_files_are_answered() {
    on_small_stack("damaged", || {
        for source in gallery() {
            for text in damaged(&source.text) {
                let answer = compile(&text);
                if let Err(problem) = holds::compilation(&text, &answer) {
                    panic!("{} damaged: {problem}\n{text}", source.name);
                }
                let silent = |d: &Diagnostic| d.code == "internal-silent";
                assert!(
                    !answer.diagnostics.iter().any(silent),
                    "no error for\n{text}"
                );
            }
        }
    });
}

/// Prefixes, and the text with one character deleted, doubled or swapped with its neighbour. Comments are left out.
fn damaged(text: &str) -> Vec<String> {
    let code: Vec<&str> = text
        .lines()
        .filter(|l| !l.trim_start().starts_with("//"))
        .collect();
    let letters: Vec<char> = code.join("\n").chars().collect();
    let mut out = Vec::new();
    for k in 0..letters.len() {
        let (head, tail) = letters.split_at(k);
        let text = |parts: &[&[char]]| parts.concat().iter().collect::<String>();
        out.push(text(&[head]));
        out.push(text(&[head, &tail[1..]]));
        out.push(text(&[head, &tail[..1], tail]));
        if tail.len() > 1 {
            out.push(text(&[head, &[tail[1], tail[0]], &tail[2..]]));
        }
    }
    out
}
