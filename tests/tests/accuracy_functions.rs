//! Every function of the operator table on every evaluator, against tables of references.

use pullback_compiler::check::{builtins, library_functions};
use pullback_compiler::lower::Precision;
use pullback_compiler::table::{Typing, rows};
use pullback_tests::accuracy::bounds::{declared, violations};
use pullback_tests::accuracy::evaluators::{Machine, is_reference_adapter, suite_gpu};
use pullback_tests::accuracy::formulas::{library, special};
use pullback_tests::accuracy::measure::measure;
use pullback_tests::accuracy::subjects::{Subject, subjects};
use pullback_tests::accuracy::sweep::judged_by;

/// Random points of each kind, beside the tables.
const EACH: usize = 600;

/// Runs every function, prints what was measured, and fails with every violation.
fn check(machine: &Machine, tight: bool) {
    let mut found = Vec::new();
    for subject in &subjects() {
        let name = format!("{} ({})", subject.word, subject.domain);
        let judged = judged_by(subject, machine, EACH);
        let measured = match judged.and_then(|subject| measure(&subject, machine)) {
            Ok(measured) => measured,
            Err(reason) => {
                found.push(format!("{name}: {reason}"));
                continue;
            }
        };
        println!("{name}: {:.2}", measured.value[0].max());
        match declared(subject, machine) {
            Ok(bounds) => {
                let wrong = violations(&measured, &bounds, tight);
                found.extend(wrong.into_iter().map(|v| format!("{name}: {v}")));
            }
            Err(reason) => found.push(format!("{name}: {reason}")),
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
fn functions_of_the_reference_keep_their_bounds() {
    check(&Machine::Reference, true);
}

#[test]
fn functions_on_the_gpu_keep_their_bounds() {
    let Some(gpu) = suite_gpu() else { return };
    let tight = is_reference_adapter(&gpu);
    check(&Machine::Gpu(Box::new(gpu), Precision::Accurate), tight);
}

/// Comparisons and logic give truth values: the choices of the library's formulas stand for them.
fn is_condition(typing: Typing) -> bool {
    matches!(typing, Typing::Order | Typing::Equality | Typing::Logic(_))
}

#[test]
fn every_function_has_references() {
    let formulas = library().into_iter().chain(special());
    let formulas: Vec<&str> = formulas.map(|t| t.name).collect();
    let subjects = subjects();
    let mut bare = Vec::new();
    // what only derivatives make is judged as the derivative that it is
    let written = rows().iter().filter(|r| r.is_written());
    for row in written.filter(|r| !is_condition(r.typing)) {
        let own: Vec<_> = subjects.iter().filter(|s| s.row.prim == row.prim).collect();
        let covered = formulas.contains(&row.mnemonic);
        if own.is_empty() && !covered {
            bare.push(row.usage.to_owned());
        }
        let thin = own.iter().filter(|s| s.cases.len() < 10);
        bare.extend(thin.map(|s| format!("{} ({}): {}", s.word, s.domain, s.cases.len())));
        for (domain, exists) in [
            ("real", row.real.is_some()),
            ("complex", row.complex.is_some()),
        ] {
            let judged = own.iter().any(|s| s.domain.to_string() == domain);
            if exists && !judged && !covered {
                bare.push(format!("{} ({domain})", row.usage));
            }
        }
    }
    let names = builtins()
        .iter()
        .map(|b| b.names[0])
        .chain(library_functions().map(|f| f.name));
    bare.extend(names.filter(|n| !formulas.contains(n)).map(str::to_owned));
    assert!(bare.is_empty(), "no references for {bare:?}");
}

/// The harness sees a value that is off by ten units, and a derivative that is zero where the value is right.
#[test]
fn wrong_functions_are_caught() {
    let all = subjects();
    let sine = all.iter().find(|s| s.word == "sin").expect("sin");
    let bounds = declared(sine, &Machine::Reference).expect("bounds of sin");
    let broken = |source: &str| {
        let wrong = Subject {
            source: source.to_owned(),
            ..sine.clone()
        };
        violations(
            &measure(&wrong, &Machine::Reference).expect(source),
            &bounds,
            false,
        )
    };
    assert!(broken("f(x: real) = sin(x)\n").is_empty());
    let off = broken("f(x: real) = sin(x) (1 + 2^-49)\n");
    assert!(
        off.iter().any(|v| v.starts_with("the value is off")),
        "{off:?}"
    );
    let flat = broken("f(x: real) = if x == floor(x) then sin(x) else sin(floor(2^60 x) / 2^60)\n");
    assert!(
        flat.iter().any(|v| v.starts_with("the derivative is off")),
        "{flat:?}"
    );
}
