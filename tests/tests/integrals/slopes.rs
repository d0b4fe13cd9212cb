//! Derivatives of integrals by both ends against mpmath at 40 digits (tests/oracle/integrals_slopes.py), above all of ways
//! along which the integrand does not change.

use std::fmt::Write as _;
use std::path::Path;

use pullback_compiler::lower::Precision;
use pullback_compiler::{What, compile};
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::{Machine, Point};

/// What an error may be beside the greatest of the value and both derivatives, and 1: in f64, and in binary32. The
/// Gaussian counts as constant where its exponent changes by less than 1e-7, which its derivative has to first order.
const BOUNDS: [f64; 2] = [1e-8, 4e-6];
/// Roundings of numbers of both machines.
const ROUNDINGS: [f64; 2] = [1.1e-16, 6e-8];

#[test]
fn slopes_by_both_ends() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/integrals/slopes.tsv");
    let text = std::fs::read_to_string(&path).unwrap();
    let (mut formula, mut integrand) = (None, "");
    let (mut count, mut worst, mut wrong) = (0, [0.0_f64; 2], String::new());
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        if let Some(case) = line.strip_prefix("= ") {
            integrand = case;
            let source = format!("f(x, y) = integral({}, t, 0, 1)", inlined(case));
            let answer = compile(&source);
            let program = answer
                .program
                .unwrap_or_else(|| panic!("{source}: {:?}", answer.diagnostics));
            formula = program.pictures().first().map(|p| p.formula.clone());
            continue;
        }
        let numbers: Vec<f64> = line.split(' ').map(|n| n.parse().unwrap()).collect();
        let at = [Point {
            args: numbers[..2].to_vec(),
            params: Vec::new(),
        }];
        let (exact, size) = (
            &numbers[2..5],
            numbers[2..5].iter().fold(1.0_f64, |m, v| m.max(v.abs())),
        );
        let machines = [
            Machine::Reference,
            Machine::Processor(Arithmetic::Ieee32, Precision::Accurate),
        ];
        for (k, machine) in machines.iter().enumerate() {
            // parts of a range that is cut are differences of ends over their distance
            let distance = (numbers[1] - numbers[0]).abs();
            let is_cut = integrand.contains("max") && distance > 0.0;
            let cancelled = if is_cut {
                4.0 * ROUNDINGS[k] / distance
            } else {
                0.0
            };
            let found = &machine
                .run(formula.as_ref().unwrap(), What::Gradient, &at)
                .unwrap()[0];
            assert_eq!(found.len(), 3, "{integrand}");
            for (value, exact) in found.iter().zip(exact) {
                let error = (value - exact).abs() / size;
                worst[k] = worst[k].max(error);
                count += 1;
                if error.is_nan() || error > BOUNDS[k] + cancelled {
                    let _ = writeln!(
                        wrong,
                        "{integrand}: {error:.1e}, {machine}: {found:?}, {line}"
                    );
                }
            }
        }
    }
    println!("{count} values and derivatives, worst {worst:?}");
    assert!(count > 2900 && wrong.is_empty(), "{wrong}");
}

/// An integrand of u as one of t.
fn inlined(case: &str) -> String {
    let is_word = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    let letters: Vec<char> = case.chars().collect();
    let mut out = String::new();
    for (k, &letter) in letters.iter().enumerate() {
        let before = k.checked_sub(1).map(|k| letters[k]);
        if letter == 'u' && !is_word(before) && !is_word(letters.get(k + 1).copied()) {
            out += "(x + t (y - x))";
        } else {
            out.push(letter);
        }
    }
    out
}
