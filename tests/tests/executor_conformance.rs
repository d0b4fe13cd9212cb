//! Every construct of naga that our modules hold, in the executor: `tests/data/executor.txt`, which docs/executor.md shows.

use std::collections::BTreeSet;

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use pullback_compiler::lower::{Exactness, Format, Precision, Tier};
use pullback_compiler::{What, compile};
use pullback_runtime::executor::{
    Arithmetic, Component, Contraction, Limits, Machine, Options, Program, Start, Watched,
};
use pullback_tests::constructs::constructs;
use pullback_tests::corpus::{gallery, read, root};

/// A construct with a text that has it, and what it gives.
struct Row {
    constructs: Vec<String>,
    wgsl: String,
    cases: Vec<Case>,
}

/// Arguments, and results in both arithmetics.
struct Case {
    line: String,
    arguments: Vec<f64>,
    reference: Vec<f64>,
    ieee32: Vec<f64>,
}

fn numbers(text: &str) -> Vec<f64> {
    let number = |word: &str| word.parse().unwrap_or_else(|_| panic!("{word} in {text}"));
    text.split_whitespace().map(number).collect()
}

fn case(line: &str) -> Case {
    let (arguments, results) = line.split_once("->").expect("an arrow");
    let (reference, ieee32) = results.split_once('|').unwrap_or((results, results));
    Case {
        line: line.to_owned(),
        arguments: numbers(arguments),
        reference: numbers(reference),
        ieee32: numbers(ieee32),
    }
}

/// Whether a line is a case: of WGSL, only declarations have arrows.
fn is_case(line: &str) -> bool {
    line.contains("->") && !line.contains("fn ")
}

fn rows() -> Vec<Row> {
    let text = read(&root().join("tests/data/executor.txt"));
    let blocks = text.split("\n\n").skip(1);
    let row = |block: &str| {
        let mut lines = block.lines();
        let constructs = lines.next().expect("a line").split("; ");
        let (cases, wgsl): (Vec<&str>, Vec<&str>) = lines.partition(|line| is_case(line));
        Row {
            constructs: constructs.map(str::to_owned).collect(),
            wgsl: wgsl.join("\n"),
            cases: cases.into_iter().map(case).collect(),
        }
    };
    blocks.map(row).collect()
}

fn module(row: &Row) -> (naga::Module, ModuleInfo) {
    let wgsl = row.wgsl.as_str();
    let mut module =
        naga::front::wgsl::parse_str(wgsl).unwrap_or_else(|e| panic!("{}", e.emit_to_string(wgsl)));
    if row.constructs.iter().any(|c| c.contains("Logical")) {
        for (_, function) in module.functions.iter_mut() {
            function
                .expressions
                .iter_mut()
                .for_each(|(_, e)| use_logic(e));
        }
    }
    let capabilities = Capabilities::default() | Capabilities::FLOAT64 | Capabilities::SHADER_INT64;
    let info = Validator::new(ValidationFlags::all(), capabilities)
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(wgsl)));
    (module, info)
}

/// Operators of truth values that no text of WGSL is translated to.
fn use_logic(expression: &mut naga::Expression) {
    use naga::BinaryOperator as B;
    if let naga::Expression::Binary { op, .. } = expression {
        *op = match *op {
            B::And => B::LogicalAnd,
            B::InclusiveOr => B::LogicalOr,
            op => op,
        };
    }
}

fn program(row: &Row, arithmetic: Arithmetic) -> Program {
    let (module, info) = module(row);
    let options = Options {
        arithmetic,
        format: Format::Single,
        watched: Watched::Nothing,
        contraction: Contraction::None,
    };
    Program::new(&module, &info, Start::Function("test"), options)
        .unwrap_or_else(|e| panic!("{e}: {}", row.wgsl))
}

/// Runs every case alone, and then, unless they share a buffer, all in one group, so that lanes go different ways.
fn results(program: &Program, cases: &[Case]) -> Vec<Vec<f64>> {
    let together = program.buffers.is_empty().then_some(cases);
    let mut all = Vec::new();
    for part in cases.chunks(1).chain(together) {
        let mut machine = Machine::new(program);
        for (k, input) in program.inputs.iter().enumerate() {
            let first = if is_word(input) { 1.0 } else { 1.5 };
            machine.set_uniform(input, input.encode(k as f64 + first));
        }
        for (k, buffer) in program.buffers.iter().enumerate() {
            let words = [10.0, 11.0, 12.0].map(|x| buffer.encode(x));
            *machine.buffer(k).expect("a buffer") = words.to_vec();
        }
        for (lane, case) in part.iter().enumerate() {
            assert_eq!(
                case.arguments.len(),
                program.arguments.len(),
                "{}",
                case.line
            );
            for (k, (argument, &x)) in program.arguments.iter().zip(&case.arguments).enumerate() {
                machine.set_argument(k, lane, argument.encode(x));
            }
        }
        machine.run(part.len(), Limits::default()).expect("it runs");
        for lane in 0..part.len() {
            let result =
                |(k, component): (usize, &Component)| component.decode(machine.result(k, lane));
            all.push(program.results.iter().enumerate().map(result).collect());
        }
    }
    all
}

/// Whether a uniform is a word of the storage that is read.
fn is_word(component: &Component) -> bool {
    component.path.starts_with("fixed")
}

/// Equal to the last place of `f64`, of which libraries disagree.
fn near(a: f64, b: f64) -> bool {
    a == b && a.is_sign_negative() == b.is_sign_negative()
        || a.is_nan() && b.is_nan()
        || (a - b).abs() <= f64::EPSILON * b.abs()
}

fn same(a: f64, b: f64) -> bool {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "results of single precision"
    )]
    let (single, expected) = (a as f32, b as f32);
    single.to_bits() == expected.to_bits() || single.is_nan() && expected.is_nan()
}

#[test]
fn every_row_gives_what_it_says() {
    let mut wrong = Vec::new();
    for row in rows() {
        for arithmetic in [Arithmetic::Reference, Arithmetic::Ieee32] {
            let program = program(&row, arithmetic);
            let wide = program
                .results
                .iter()
                .any(|c| c.encode(0.1) == 0.1f64.to_bits());
            let found = results(&program, &row.cases);
            for (case, found) in row.cases.iter().chain(&row.cases).zip(found) {
                let expected = match arithmetic {
                    Arithmetic::Reference => &case.reference,
                    Arithmetic::Ieee32 => &case.ieee32,
                };
                let fits = |(a, b): (&f64, &f64)| {
                    if arithmetic == Arithmetic::Ieee32 && !wide {
                        same(*a, *b)
                    } else {
                        near(*a, *b)
                    }
                };
                let fits = found.len() == expected.len() && found.iter().zip(expected).all(fits);
                if !fits {
                    wrong.push(format!(
                        "{arithmetic:?}: {}: {found:?}\n{}",
                        case.line, row.wgsl
                    ));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_row_has_its_constructs() {
    for row in rows() {
        let (module, info) = module(&row);
        let found = constructs(&module, &info);
        for construct in &row.constructs {
            assert!(
                found.contains(construct),
                "no `{construct}` in\n{}\nbut {found:#?}",
                row.wgsl
            );
        }
    }
}

#[test]
fn every_construct_of_our_modules_has_a_row() {
    let known: BTreeSet<String> = rows().into_iter().flat_map(|row| row.constructs).collect();
    let mut tiers: Vec<Tier> = Precision::ALL.map(Tier::from).to_vec();
    tiers.push(Tier {
        exactness: Exactness::DecoratedFused,
        ..Precision::Extended.into()
    });
    tiers.push(Tier {
        splits_fma: true,
        ..Precision::Accurate.into()
    });
    let mut missing = BTreeSet::new();
    for source in gallery() {
        let program = compile(&source.text).program.expect("the gallery compiles");
        for &tier in &tiers {
            let scenes = (0..program.pictures().len()).map(|k| program.scene_module(k, tier));
            let scenes = scenes.map(|scene| scene.map(|scene| (scene.module, scene.info)));
            let rows = program.eval_module(0, What::Value, tier);
            for module in scenes.chain([rows.map(|rows| (rows.module, rows.info))]) {
                let Ok((module, info)) = module else {
                    panic!("{} does not compile", source.name);
                };
                missing.extend(constructs(&module, &info).difference(&known).cloned());
            }
        }
    }
    assert!(missing.is_empty(), "no row for {missing:?}");
}

/// Where the table begins in the document.
const BEGIN: &str = "From [tests/data/executor.txt](../tests/data/executor.txt).\n\n";

/// The document shows every row with its first case; `BLESS=1` writes it.
#[test]
fn the_document_shows_the_table() {
    let path = root().join("docs/executor.md");
    let document = read(&path);
    let (before, _) = document.split_once(BEGIN).expect("the place of the table");
    let mut written =
        format!("{before}{BEGIN}| Constructs | Text | For example |\n| --- | --- | --- |\n");
    for row in rows() {
        let code = row.wgsl.split_whitespace().collect::<Vec<_>>().join(" ");
        let code = code.replace('|', "\\|");
        let case = row.cases[0].line.replace("->", "→").replace('|', "\\|");
        let constructs = row.constructs.join("; ");
        written += &format!("| {constructs} | `{code}` | {} |\n", case.trim());
    }
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, &written).expect("a document");
        return;
    }
    assert!(
        document == written,
        "docs/executor.md is not up to date: run with BLESS=1 and read the difference"
    );
}
