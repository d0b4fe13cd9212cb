//! Texts and what is read from them.

mod support;

use std::collections::HashSet;
use std::fmt::Write as _;

use pullback_grammar::token::comments;
use pullback_grammar::{Diagnostic, Parsed, format, parse_bytes, print, render};
use support::{fixture, is_function, read, show_file};

fn complaints(text: &str, parsed: &Parsed) -> String {
    let mut out = String::new();
    for Diagnostic {
        code,
        message,
        span,
        hint,
        related,
        ..
    } in &parsed.diagnostics
    {
        let _ = writeln!(out, "{code} `{}` {message}", span.text(text).escape_debug());
        for (span, remark) in related {
            let _ = writeln!(out, "  at `{}` {remark}", span.text(text));
        }
        if let Some(hint) = hint {
            let _ = writeln!(out, "  help: {hint}");
        }
    }
    out
}

#[test]
fn well_formed_texts() {
    let count = fixture::check("parse.txt", |text| {
        let parsed = read(text);
        assert!(!parsed.has_errors(), "{text}: {:?}", parsed.diagnostics);
        let printed = print(&parsed.file);
        let again = read(&printed);
        assert_eq!(show_file(&parsed.file), show_file(&again.file), "{printed}");
        assert_eq!(printed, print(&again.file));
        let formatted = format(text, &is_function).expect("a text without errors");
        assert_eq!(
            format(&formatted, &is_function).as_ref(),
            Some(&formatted),
            "{text}"
        );
        assert_eq!(
            show_file(&parsed.file),
            show_file(&read(&formatted).file),
            "{formatted}"
        );
        assert_eq!(
            comments(text).len(),
            comments(&formatted).len(),
            "{formatted}"
        );
        format!(
            "{}\n  is {}\n{}",
            show_file(&parsed.file),
            printed.trim_end().replace('\n', "\n     "),
            complaints(text, &parsed)
        )
    });
    assert!(count >= 60, "{count}");
}

#[test]
fn pasted_texts() {
    let count = fixture::check("pasted.txt", |text| {
        let parsed = read(text);
        let printed = print(&parsed.file);
        if !parsed.has_errors() {
            let again = read(&printed);
            assert_eq!(again.diagnostics, [], "{text}\n{printed}");
            assert_eq!(show_file(&parsed.file), show_file(&again.file), "{printed}");
            let formatted = format(text, &is_function).expect("a text without errors");
            let again = read(&formatted);
            assert_eq!(
                show_file(&parsed.file),
                show_file(&again.file),
                "{formatted}"
            );
            assert_eq!(again.diagnostics, [], "{text}\n{formatted}");
            assert!(
                !formatted.contains(['\\', '$', '?', '[', ';']),
                "{formatted}"
            );
            assert_eq!(format(&formatted, &is_function), Some(formatted), "{text}");
        }
        format!("{}\n{}", printed.trim_end(), complaints(text, &parsed))
    });
    assert!(count >= 100, "{count}");
}

#[test]
fn malformed_texts() {
    let mut codes = HashSet::new();
    let seen = std::cell::RefCell::new(&mut codes);
    let count = fixture::check("malformed.txt", |text| {
        let parsed = read(text);
        assert!(parsed.has_errors(), "{text}");
        seen.borrow_mut()
            .extend(parsed.diagnostics.iter().map(|d| d.code));
        let tree = show_file(&parsed.file).replace('\n', "\n  ");
        format!("{}  {tree}", complaints(text, &parsed))
    });
    assert!(count >= 45, "{count}");
    assert!(codes.len() >= 40, "{}", codes.len());
}

#[test]
fn rendered_diagnostics() {
    fixture::check("render.txt", |text| {
        render(&read(text).diagnostics, "formula.pull", text, false)
    });
}

#[test]
fn colored_diagnostics_have_escapes() {
    let parsed = read("(x");
    assert!(render(&parsed.diagnostics, "a", "(x", true).contains("\u{1b}["));
    assert!(!render(&parsed.diagnostics, "a", "(x", false).contains('\u{1b}'));
}

#[test]
fn rendering_takes_any_span() {
    use pullback_grammar::Span;
    let sources = [
        "",
        "\n",
        "\r\n",
        "x",
        "a\tb(漢字 x\r\n\tfoo\n",
        "é",
        "x\n\n",
        "\u{0}\u{7}\u{202e}",
    ];
    for source in sources {
        for start in 0..20 {
            for end in 0..20 {
                let span = Span::new(start, end);
                let diagnostic = Diagnostic::error("code", span, "message")
                    .with_label("label")
                    .with_hint("hint")
                    .with_related(Span::new(end, start), "related");
                assert!(render(&[diagnostic], "a", source, false).contains("error[code]: message"));
            }
        }
    }
}

#[test]
fn long_lines_are_cut() {
    let text = format!("{}(", "x + ".repeat(200_000));
    let shown = render(&read(&text).diagnostics, "a.pull", &text, false);
    assert!(shown.len() < 1000, "{}", shown.len());
    assert!(shown.contains("a.pull:1:800001"), "{shown}");
}

#[test]
fn bytes_that_are_no_text() {
    let parsed = parse_bytes(b"x + \xff", &is_function);
    let first = &parsed.diagnostics[0];
    assert_eq!(first.code, "not-utf8");
    assert_eq!(
        first.message,
        "the file is not UTF-8: byte 0xff at offset 4"
    );
    assert_eq!((first.span.start, first.span.end), (4, 4));
    let wide = parse_bytes(b"\xff\xfex\0", &is_function);
    assert!(
        wide.diagnostics[0]
            .hint
            .as_ref()
            .is_some_and(|hint| hint.contains("UTF-16"))
    );
    assert!(
        parse_bytes("π x".as_bytes(), &is_function)
            .diagnostics
            .is_empty()
    );
}

#[test]
fn too_much_text_is_refused() {
    let text = "x".repeat(pullback_grammar::ast::MAX_SOURCE_BYTES + 1);
    for parsed in [read(&text), parse_bytes(text.as_bytes(), &is_function)] {
        assert_eq!(parsed.diagnostics[0].code, "source-too-large");
        assert_eq!(parsed.diagnostics.len(), 1);
    }
}

#[test]
fn many_problems_are_counted() {
    let parsed = read(&"@ x\n".repeat(100_000));
    assert_eq!(parsed.diagnostics.len(), 201);
    let last = parsed.diagnostics.last().expect("a summary");
    assert_eq!(last.code, "too-many-problems");
    assert_eq!(last.message, "there are more than 200 errors");
}

#[test]
fn formatting_keeps_comments() {
    let text = "// one\n\n\nparam   k=1   // two\n/* three */ f(x)=k*x+ /* four */ 1\n\n\n\n# five\na=1;// six\n-x // seven\n\n//eight\n";
    let expected = "// one\n\nparam k = 1  // two\n/* three */\nf(x)=k*x+ /* four */ 1\n\n# five\na = 1;  // six\n-x  // seven\n\n//eight\n";
    assert_eq!(format(text, &is_function).as_deref(), Some(expected));
    assert_eq!(format(expected, &is_function).as_deref(), Some(expected));
    assert_eq!(format("f(x", &is_function), None);
}
