//! Every bound of the language, met and passed by one: what is just within it is accepted, what is just beyond it is
//! refused with its code. `docs/limits.md` lists them.

use std::fmt::Write as _;

use pullback_compiler::check::{
    MAX_CALL_DEPTH, MAX_DEPTH, MAX_LOOP_NESTING, MAX_ORDER, MAX_PARAMS, MAX_STEPS,
};
use pullback_compiler::formula::{Formula, Input};
use pullback_compiler::ir::Graph;
use pullback_compiler::lower::Precision;
use pullback_compiler::module::{EvalModule, MAX_COLUMNS, MAX_RESULTS};
use pullback_compiler::program::{MAX_SHOWS, MAX_UNUSED};
use pullback_compiler::types::Type;
use pullback_compiler::{Compilation, What, compile};
use pullback_grammar::ast::{MAX_NESTING, MAX_SOURCE_BYTES};
use pullback_grammar::diagnostic::MAX_DIAGNOSTICS;
use pullback_tests::corpus::{read, root};
use pullback_tests::holds;

fn answer(text: &str) -> Compilation {
    let answer = compile(text);
    holds::compilation(text, &answer).unwrap_or_else(|problem| panic!("{problem}"));
    answer
}

fn codes(text: &str) -> Vec<&'static str> {
    answer(text).diagnostics.iter().map(|d| d.code).collect()
}

/// `at` builds a program of some size: one of the bound is accepted, one beyond it has one error, of this code, which
/// names the bound.
fn bound(most: usize, code: &str, at: impl Fn(usize) -> String) {
    assert_eq!(codes(&at(most)), [""; 0], "{most}");
    assert_eq!(codes(&at(most + 1)), [code], "{}", most + 1);
}

#[test]
fn source_bytes() {
    bound(MAX_SOURCE_BYTES, "source-too-large", |size| {
        let text = "x + y //";
        format!("{text}{}", "-".repeat(size - text.len()))
    });
}

#[test]
fn nesting() {
    for (open, close) in [("(", ")"), ("-", ""), ("|", "|"), ("sin(", ")"), ("x^", "")] {
        bound(MAX_NESTING, "too-deep", |depth| {
            format!("f(x, y) = {}x{}", open.repeat(depth), close.repeat(depth))
        });
    }
}

#[test]
fn call_depth() {
    bound(MAX_CALL_DEPTH, "too-deep", |count| {
        let mut text = "f1(x) = x\n".to_owned();
        for k in 2..=count {
            let _ = writeln!(text, "f{k}(x) = f{}(x)", k - 1);
        }
        text + &format!("show levels(f{count}(x) + y)")
    });
}

#[test]
fn expression_depth() {
    // Functions, each within the bound on nesting, with two calls and one operand.
    bound(MAX_DEPTH, "too-deep", |depth| {
        let nested = |depth: usize, inner: &str| {
            format!("{}{inner}{}", "sin(".repeat(depth), ")".repeat(depth))
        };
        let rest = depth - 3 - 2 * 150;
        format!(
            "g(x) = {}\nh(x) = {}\nf(x, y) = {}",
            nested(150, "x"),
            nested(150, "g(x)"),
            nested(rest, "h(x)")
        )
    });
}

#[test]
fn operations() {
    // Each call of g, with another argument, adds as many operations.
    let terms: Vec<String> = (1..=2000).map(|k| format!("sin(x + {k})")).collect();
    let program = |calls: usize| {
        let calls: Vec<String> = (1..=calls).map(|k| format!("g(y + {k}/7)")).collect();
        format!(
            "g(x) = {}\nf(x, y) = x + {}",
            terms.join(" + "),
            calls.join(" + ")
        )
    };
    let size = |calls: usize| {
        let answer = compile(&program(calls));
        answer
            .program
            .map(|p| p.pictures()[0].formula.graph.nodes().len())
    };
    let (one, two) = (size(1).expect("a program"), size(2).expect("a program"));
    let most = 2 + (Graph::MAX_NODES - two) / (two - one);
    let greatest = size(most).expect("a program of almost the greatest size");
    assert!(
        greatest <= Graph::MAX_NODES && greatest > Graph::MAX_NODES - (two - one),
        "{greatest}"
    );
    assert_eq!(codes(&program(most + 1)), ["too-large"]);
}

#[test]
fn params() {
    bound(MAX_PARAMS, "too-many-params", |count| {
        let params: String = (0..count).map(|k| format!("param k{k} = 1\n")).collect();
        params + "x + y"
    });
}

#[test]
fn shows() {
    bound(MAX_SHOWS, "too-many-shows", |count| {
        "show levels(x y)\n".repeat(count)
    });
}

#[test]
fn components() {
    bound(4, "long-vector", |count| {
        let numbers: Vec<String> = (0..count).map(|k| k.to_string()).collect();
        format!("x + y + |({})|", numbers.join(", "))
    });
}

#[test]
fn numbers() {
    assert_eq!(codes(&format!("x + {:e}", f64::MAX)), [""; 0]);
    assert_eq!(codes("x + 1e309"), ["number-too-large"]);
}

#[test]
fn diagnostics() {
    let unknown = |count: usize| {
        let names: Vec<String> = (0..count).map(|k| format!("unknown{k}")).collect();
        codes(&format!("f(x, y) = x + {}", names.join(" + ")))
    };
    assert_eq!(unknown(MAX_DIAGNOSTICS), ["unknown-name"; MAX_DIAGNOSTICS]);
    let more = unknown(MAX_DIAGNOSTICS + 1);
    assert_eq!(more.len(), MAX_DIAGNOSTICS + 1);
    assert_eq!(more.last(), Some(&"too-many-problems"));
}

#[test]
fn steps() {
    let most = usize::try_from(MAX_STEPS).expect("a count");
    bound(most, "too-many-steps", |count| {
        format!("y + sum(k in 1..{count}, x/k)")
    });
    bound(most, "too-many-steps", |count| {
        format!("f(z) = iterate({count}, w = z, w^2 + z until |w| > 2)")
    });
    // Loops within one another multiply.
    bound(most / 100, "too-many-steps", |count| {
        format!("y + sum(j in 1..100, product(k in 1..{count}, x + j/k))")
    });
}

#[test]
fn loop_nesting() {
    bound(MAX_LOOP_NESTING, "too-deep", |depth| {
        let open: String = (0..depth)
            .map(|k| format!("sum(k{k} in 1..2, x + "))
            .collect();
        format!("y + {open}k0{}", ")".repeat(depth))
    });
}

#[test]
fn derivative_order() {
    bound(MAX_ORDER as usize, "too-many-derivatives", |order| {
        format!("q(t) = t^9\nf(x, y) = q{}(x) + y", "'".repeat(order))
    });
    bound(MAX_ORDER as usize, "too-many-derivatives", |order| {
        let variables: Vec<&str> = ["x", "y"].into_iter().cycle().take(order).collect();
        format!("f(x, y) = diff(x^9 y^9, {})", variables.join(", "))
    });
}

/// The first of so many arguments.
fn first_of(count: usize) -> Formula {
    let mut graph = Graph::new();
    let ty = pullback_compiler::ir::Ty::Real;
    let first = Formula::leaf(&mut graph, 0, ty);
    let inputs = (0..count).map(|k| Input {
        name: format!("x{k}"),
        ty: Type::Real,
    });
    Formula {
        name: "f".into(),
        inputs: inputs.collect(),
        value: [first].into_iter().collect(),
        graph,
        ty: Type::Real,
        span: pullback_grammar::Span::default(),
        rewrites: pullback_compiler::stable::Rewrites::default(),
        derived: None,
    }
}

#[test]
fn columns() {
    let module = |count| EvalModule::new(&first_of(count), What::Value, Precision::Fast);
    let within = module(MAX_COLUMNS).expect("a module");
    assert_eq!(within.inputs.len(), MAX_COLUMNS);
    let problem = module(MAX_COLUMNS + 1).expect_err("one column too many");
    let diagnostic = problem.diagnostic(&first_of(MAX_COLUMNS + 1));
    assert_eq!(diagnostic.code, "wrong-demand");
    let bound = format!("at most {MAX_COLUMNS} columns in and {MAX_RESULTS} columns out");
    assert!(diagnostic.message.contains(&bound), "{diagnostic:?}");
}

#[test]
fn unused_functions() {
    let program = |count: usize| {
        let mut text = String::new();
        for k in 1..count {
            let _ = writeln!(text, "g{k}(x: real) = x + {k}");
        }
        codes(&(text + "wrong(p: vec2) = p.z\nx + y"))
    };
    assert_eq!(program(MAX_UNUSED), ["bad-swizzle"]);
    assert_eq!(program(MAX_UNUSED + 1), [""; 0], "not looked at");
}

/// A number as the page writes it.
fn written(bound: usize) -> String {
    let digits = bound.to_string();
    let groups: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .filter_map(|group| std::str::from_utf8(group).ok())
        .collect();
    groups.join(",")
}

#[test]
fn the_page_lists_every_bound() {
    let page = read(&root().join("docs/limits.md"));
    let source = read(&root().join("tests/tests/limits.rs"));
    let bounds = [
        ("source_bytes", MAX_SOURCE_BYTES, "source-too-large"),
        ("nesting", MAX_NESTING, "too-deep"),
        ("call_depth", MAX_CALL_DEPTH, "too-deep"),
        ("expression_depth", MAX_DEPTH, "too-deep"),
        ("operations", Graph::MAX_NODES, "too-large"),
        ("steps", MAX_STEPS as usize, "too-many-steps"),
        ("loop_nesting", MAX_LOOP_NESTING, "too-deep"),
        (
            "derivative_order",
            MAX_ORDER as usize,
            "too-many-derivatives",
        ),
        ("params", MAX_PARAMS, "too-many-params"),
        ("shows", MAX_SHOWS, "too-many-shows"),
        ("components", 4, "long-vector"),
        ("columns", MAX_COLUMNS, "wrong-demand"),
        ("diagnostics", MAX_DIAGNOSTICS, "too-many-problems"),
        ("unused_functions", MAX_UNUSED, "none"),
    ];
    let rows = page.lines().filter(|line| line.ends_with("` |"));
    assert_eq!(rows.count(), bounds.len() + 1, "with `numbers`");
    for (test, bound, code) in bounds {
        assert!(source.contains(&format!("fn {test}()")), "{test}");
        let row = page
            .lines()
            .find(|line| line.ends_with(&format!("| `{test}` |")));
        let row = row.unwrap_or_else(|| panic!("no row for {test}"));
        assert!(row.contains(&format!("| {} ", written(bound))), "{row}");
        assert!(row.contains(code), "{row}");
    }
}
