//! Special functions that are defined in the language, in every tier, against tables of 60 digits.
//!
//! With K = 2 the scale of the tables is 16 u of the norm of a value and what one unit in the last place of the argument
//! moves, four times as much for derivatives.

use std::collections::BTreeSet;

use pullback_compiler::defined::{Digits, Key, definition, shader_name, shader_names};
use pullback_compiler::ir::{Op, Prim, Ty};
use pullback_compiler::lower::Precision;
use pullback_compiler::table;
use pullback_compiler::{EmitWhat, Target, compile};
use pullback_runtime::executor::{Arithmetic, Contraction};
use pullback_tests::accuracy::evaluators::{Machine, suite_gpu};
use pullback_tests::accuracy::formulas::{MOST, Table, special};
use pullback_tests::corpus::{read, root};
use pullback_tests::special::{MOST_DOUBLE, MOST_EXTENDED, functions_of, special_formulas};
use pullback_tests::special_batches::{Place, batches};
use pullback_tests::special_cost::{between, rows};

/// Violations of K ≤ `most` on a machine; prints what was measured.
fn violations(tables: &[Table], machine: &Machine, most: f64) -> Vec<String> {
    let mut found = Vec::new();
    for table in tables {
        let name = format!("{}, {machine}", table.name);
        match table.measure(machine) {
            Err(reason) => found.push(format!("{name}: {reason}")),
            Ok(factors) => {
                let (value, slope) = (factors.value, factors.derivative);
                println!("{name}: K = {value:.2}, {slope:.2}");
                if value.max(slope) > most {
                    found.push(format!(
                        "{name}: K = {value:.2}, {slope:.2}: {}",
                        factors.worst
                    ));
                }
                if factors.rows < 8 {
                    found.push(format!("{name}: only {} rows were judged", factors.rows));
                }
                found.extend(factors.wrong.iter().map(|w| format!("{name}: {w}")));
            }
        }
    }
    found
}

fn check(machine: &Machine, most: f64) {
    let found = violations(&special(), machine, most);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn special_functions_in_f64_reach_the_goal() {
    check(&Machine::Reference, MOST_DOUBLE);
}

#[test]
fn special_functions_in_single_precision_reach_the_goal() {
    check(
        &Machine::Processor(Arithmetic::Ieee32, Precision::Accurate),
        MOST,
    );
}

/// With products fused into sums, as drivers may: those on the left, or those on the right.
#[test]
fn special_functions_with_fused_products_reach_the_goal() {
    for contraction in [Contraction::Left, Contraction::Right] {
        let place = Place::Processor(contraction);
        let judged = batches(special())
            .into_iter()
            .flat_map(|batch| batch.judge(&place, Precision::Accurate));
        let wrong = judged.filter_map(|j| Some(format!("{}: {}", j.name, j.problem?)));
        let wrong: Vec<String> = wrong.collect();
        assert!(wrong.is_empty(), "{place}\n{}", wrong.join("\n"));
    }
}

#[test]
fn special_functions_in_pairs_reach_the_goal() {
    check(
        &Machine::Processor(Arithmetic::Ieee32, Precision::Extended),
        MOST_EXTENDED,
    );
}

/// By the shader in binary64.
#[test]
fn special_functions_in_doubles_reach_the_goal() {
    check(
        &Machine::Processor(Arithmetic::Ieee32, Precision::Double),
        MOST_DOUBLE,
    );
}

/// On an adapter those whose shaders compile quickly.
#[test]
fn special_functions_on_the_gpu_reach_the_goal() {
    let Some(gpu) = suite_gpu() else { return };
    let mut tables = special();
    let quick = [
        "erfc",
        "elliptic_k",
        "dedekind_eta",
        "besselk_1",
        "e1",
        "spherical_harmonic",
    ];
    tables.retain(|table| quick.contains(&table.name));
    let machine = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    let found = violations(&tables, &machine, MOST);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// A function that is off by a ten-thousandth of a percent is seen.
#[test]
fn wrong_functions_are_caught() {
    let mut tables = special();
    tables.retain(|table| table.name == "erfc");
    for table in &mut tables {
        table.source = table.source.replace("erfc(z)", "erfc(z) (1 + 2^-40)");
    }
    assert!(!violations(&tables, &Machine::Reference, MOST_DOUBLE).is_empty());
}

/// The emitted text of a formula has the functions that it needs and no others.
#[test]
fn only_what_is_used_is_emitted() {
    let families = [
        "faddeeva",
        "zeta",
        "airy",
        "elliptic",
        "eisenstein",
        "weierstrass",
        "lambertw",
        "bessel",
        "expint",
        "fresnel",
        "beta",
        "gegenbauer",
    ];
    let check = |formula: &str, used: &[&str]| {
        let program = compile(formula).program.expect(formula);
        let text = program
            .emit(0, EmitWhat::Value, Target::Wgsl, Precision::Accurate)
            .expect(formula);
        let text = String::from_utf8(text).expect(formula);
        for family in families {
            assert_eq!(
                text.contains(family),
                used.contains(&family),
                "{family} in {formula}"
            );
        }
    };
    check("f(z) = erfc(z)", &["faddeeva"]);
    check("f(z) = zeta(z)", &["zeta"]);
    check("f(z) = airy_ai(z)", &["airy"]);
    check("f(x: real) = besselj(1, x)", &["bessel"]);
    check("f(z) = si(z)", &["expint"]);
    check("f(z) = fresnel_s(z)", &["faddeeva", "fresnel"]);
    check("f(x: real) = beta(x, 2)", &["beta"]);
    check("f(x: real) = legendre_p(4, x)", &["gegenbauer"]);
    check("f(z) = z^2", &[]);
}

/// The functions in shaders that a defined operation on complex numbers needs, itself among them: those that definitions call.
fn needed(prim: Prim) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut open = vec![(prim, true)];
    while let Some((prim, complex)) = open.pop() {
        if !found.insert(shader_name(prim, complex)) {
            continue;
        }
        let key = Key {
            prim,
            complex,
            digits: Digits::Single,
        };
        let definition = definition(key).expect("a definition");
        let graph = &definition.graph;
        let used = graph.reachable(&[definition.root]);
        for id in graph.ids().filter(|id| used[id.index()]) {
            let complex = graph.ty(id) == Ty::Complex;
            if let Op::Apply(prim) = graph.node(id).op
                && table::row(prim).is_defined(complex)
            {
                open.push((prim, complex));
            }
        }
    }
    found
}

/// Of every function that is defined in the language: its module has what its definition calls and nothing else, and no function
/// that is not called.
#[test]
fn a_module_carries_only_what_its_function_needs() {
    let all: BTreeSet<String> = table::rows()
        .iter()
        .flat_map(|row| shader_names(row).into_iter().map(|(_, name)| name))
        .collect();
    for formula in special_formulas() {
        let program = compile(&formula.text).program.expect(&formula.text);
        let text = program
            .emit(0, EmitWhat::Value, Target::Wgsl, Precision::Accurate)
            .expect(&formula.text);
        let text = String::from_utf8(text).expect("a text");
        let functions = functions_of(&text);
        let carried: BTreeSet<String> = functions
            .iter()
            .map(|(name, _)| name.trim_end_matches('_').to_owned())
            .filter(|name| all.contains(name))
            .collect();
        assert_eq!(carried, needed(formula.prim), "{}", formula.text);
        let entry = functions.last().map_or("", |(name, _)| name);
        for (name, _) in functions.iter().filter(|(name, _)| *name != entry) {
            let call = format!("{name}(");
            let called = functions.iter().any(|(_, body)| body.contains(&call));
            assert!(called, "{name} in {}", formula.text);
        }
    }
}

/// The table of docs/special.md has every function with the size that its module has now, no frame of 100 ms and a median time to WGSL
/// below 3 ms.
#[test]
fn the_table_of_costs_is_current() {
    let page = read(&root().join("docs/special.md"));
    let begin = "<!-- cost of special functions, by the command above -->\n";
    let [_, table, _] = between(&page, [begin, "<!-- end of the cost -->\n"]).expect("a table");
    let rows = rows(table);
    let mut compiled = Vec::new();
    for formula in special_formulas() {
        let name = formula.name;
        let row = rows
            .get(name)
            .unwrap_or_else(|| panic!("{name} has no row"));
        let number = |k: usize| row[k].parse::<f64>().expect(name);
        let program = compile(&formula.text).program.expect(name);
        let text = program
            .emit(0, EmitWhat::Value, Target::Wgsl, Precision::Accurate)
            .expect(name);
        let kilobytes = f64::from(u32::try_from(text.len()).expect("a size")) / 1000.0;
        assert!(
            (kilobytes - number(2)).abs() <= 0.06 * kilobytes,
            "{name}: {kilobytes} KB, {row:?}: by special_cost --markdown anew"
        );
        compiled.push(number(5));
        assert!(number(6) < 100.0, "{name}: {row:?}");
    }
    compiled.sort_by(f64::total_cmp);
    assert!(compiled[compiled.len() / 2] < 3.0, "{compiled:?}");
}
