//! The examples of the README: its programs, and its Rust, which is this file's.

use pullback_compiler::compile;
use pullback_tests::corpus::blocks;

#[test]
fn programs_of_the_readme_compile() {
    for block in blocks("README.md").iter().filter(|b| b.info == "pull") {
        let answer = compile(&block.text);
        assert!(
            answer.diagnostics.is_empty(),
            "line {}: {:?}",
            block.line,
            answer.diagnostics
        );
    }
}

#[rustfmt::skip]
#[test]
fn the_library_works_as_the_readme_says() {
    // README begins
    use pullback_compiler::lower::Precision;
    use pullback_compiler::{EmitWhat, Target, What, compile};

    let compilation = compile("f(x, y) = x^2 sin(y)");
    for problem in &compilation.diagnostics {
        // severity, code, message, span, hint: data, to be shown as you like
        println!("{}", problem.message);
    }
    let program = compilation.program.expect("no errors");
    let wgsl = program.emit(0, EmitWhat::Gradient, Target::Wgsl, Precision::Accurate).expect("a gradient");

    let mut gradient = program.evaluator(0, What::Gradient).expect("it is smooth");
    let mut row = [0.0; 3];
    gradient.eval(&[], 0.0, 0.0, &[2.0, 1.0], &mut row); // value, df/dx, df/dy
    // README ends
    assert!(String::from_utf8_lossy(&wgsl).contains("fn f_gradient"));
    assert!((row[0] - 4.0 * 1.0_f64.sin()).abs() < 1e-15);
    assert!((row[1] - 4.0 * 1.0_f64.sin()).abs() < 1e-15);
    assert!((row[2] - 4.0 * 1.0_f64.cos()).abs() < 1e-15);
}

#[test]
fn the_readme_shows_this_file() {
    let source = include_str!("readme.rs");
    let part = source
        .split("// README begins\n")
        .nth(1)
        .and_then(|s| s.split("// README ends").next());
    let lines: Vec<&str> = part
        .expect("the example")
        .lines()
        .map(str::trim_end)
        .collect();
    let example: Vec<&str> = lines
        .iter()
        .map(|l| l.strip_prefix("    ").unwrap_or(l))
        .collect();
    let block = blocks("README.md")
        .into_iter()
        .find(|b| b.info == "rust")
        .expect("Rust in the README");
    assert_eq!(block.text.trim(), example.join("\n").trim());
}
