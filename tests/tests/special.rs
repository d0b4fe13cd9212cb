//! Special functions that are defined in the language, in every tier, against tables of 60 digits.
//!
//! With K = 2 the scale of the tables is 16 u of the norm of a value and what one unit in the last place of the argument
//! moves, four times as much for derivatives.

use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Target, compile};
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::{Machine, suite_gpu};
use pullback_tests::accuracy::formulas::{MOST, Table, special};

/// In binary64: 2⁻⁴⁵ of the norm, far below the goal of 10⁻¹².
const MOST_DOUBLE: f64 = 32.0;
/// In pairs: 2⁻⁴² of the norm.
const MOST_EXTENDED: f64 = 8.0;

/// What K may be where it is not the goal: at negative reals an Airy function is the real part of a product with e^-ζ, whose
/// exponent has a rounded real part there.
/// Left of 0 the complex beta function is a product of many quotients.
const DECLARED: [(&str, f64); 3] = [
    ("airy_bi_real", 4.0),
    ("airy_ai_prime_real", 4.0),
    ("euler_beta", 4.0),
];

/// Violations of K ≤ `most` on a machine; prints what was measured.
fn violations(tables: &[Table], machine: &Machine, most: f64) -> Vec<String> {
    let mut found = Vec::new();
    for table in tables {
        let name = format!("{}, {machine}", table.name);
        let declared = DECLARED.iter().find(|(name, _)| *name == table.name);
        let most = declared.map_or(most, |(_, k)| k.max(most));
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

#[test]
fn special_functions_in_pairs_reach_the_goal() {
    check(
        &Machine::Processor(Arithmetic::Ieee32, Precision::Extended),
        MOST_EXTENDED,
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
