//! The formulas of the gallery, and those that cover the language's library, on every evaluator: value and
//! derivatives against tables, in units of the error that rounding every step once would make.

use std::collections::BTreeSet;
use std::path::Path;

use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::evaluators::{Machine, suite_gpu};
use pullback_tests::accuracy::formulas::{MOST, Table, gallery, library};

fn check(tables: &[Table], machine: &Machine) {
    let mut found = Vec::new();
    for table in tables {
        let name = format!(
            "{} ({})",
            table.name,
            table.source.lines().last().unwrap_or("")
        );
        match table.measure(machine) {
            Err(reason) => found.push(format!("{name}: {reason}")),
            Ok(factors) => {
                println!(
                    "{name}: K = {:.2}, {:.2}",
                    factors.value, factors.derivative
                );
                let most = factors.value.max(factors.derivative);
                if most > MOST {
                    found.push(format!(
                        "{name}: K = {most:.2}, not {MOST}: {}",
                        factors.worst
                    ));
                }
                if factors.rows < 20 {
                    found.push(format!("{name}: only {} rows were judged", factors.rows));
                }
                found.extend(factors.wrong.iter().map(|w| format!("{name}: {w}")));
            }
        }
    }
    assert!(
        found.is_empty(),
        "{} violations\n{}",
        found.len(),
        found.join("\n")
    );
}

#[test]
fn formulas_in_f64_are_as_good_as_their_roundings() {
    check(&gallery(), &Machine::Reference);
    check(&library(), &Machine::Reference);
}

#[test]
fn formulas_on_the_gpu_are_as_good_as_their_roundings() {
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    check(&gallery(), &machine);
    check(&library(), &machine);
}

#[test]
fn every_formula_of_the_gallery_has_a_table() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/gallery");
    let names = |extension: &'static str, folder: &Path| -> BTreeSet<String> {
        let files = std::fs::read_dir(folder)
            .expect("a folder")
            .map(|f| f.expect("a file").path());
        files
            .filter(|f| f.extension().is_some_and(|e| e == extension))
            .filter_map(|f| Some(f.file_stem()?.to_str()?.to_owned()))
            .collect()
    };
    let measured: BTreeSet<String> = gallery().iter().map(|t| t.name.to_owned()).collect();
    assert_eq!(names("pull", &folder), measured);
}
