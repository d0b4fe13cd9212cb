//! Generated programs, printed as WGSL and read back.
//!
//! `PROGRAMS=10000` in the environment takes so many, `SEED=7` others.

#[path = "../support/formulas.rs"]
mod formulas;

use std::collections::BTreeMap;

use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use pullback_compiler::lower::Precision;
use pullback_compiler::{Emission, EmitWhat, ParamsAs, Target, compile};

use crate::same::check_module;
use formulas::{any_real, holomorphic, smooth};

/// A program, and what is emitted of it.
#[derive(Clone, Debug)]
struct Case {
    text: String,
    parts: Vec<EmitWhat>,
    params: ParamsAs,
    precision: Precision,
}

/// Formulas of the plane, with parameters, clock, local names and helper functions.
fn plane() -> impl Strategy<Value = (String, &'static [EmitWhat])> {
    const PARTS: &[EmitWhat] = &[
        EmitWhat::Value,
        EmitWhat::Gradient,
        EmitWhat::Partials,
        EmitWhat::Directional,
    ];
    let two = || prop_oneof![smooth(), any_real()];
    (two(), smooth(), 0_u32..6, 2_u32..9).prop_map(|(a, b, form, n)| {
        let text = match form {
            0 => format!("f(x, y) = {a}"),
            1 => format!("param k = 0.75 in 0..{n}\nf(x, y) = k ({a}) + {b}"),
            2 => format!("g(x, y) = {b}\nf(x, y) = g(x, {a}) - g(y, x)"),
            3 => format!(
                "param speed = 1.5\nf(x, y) = u + {n} v where u = {a}, v = sin(speed time) ({b})"
            ),
            4 => format!("f(p: vec2) = {a} where x = p.x, y = p.y"),
            _ => format!("param c = {n}\nparam d = 2 in 1..3\nf(x, y) = c²/d ({b}) + {a} - pixel"),
        };
        (text, PARTS)
    })
}

/// Sums, products and iterations, which are loops.
fn loops() -> impl Strategy<Value = (String, &'static [EmitWhat])> {
    const PARTS: &[EmitWhat] = &[EmitWhat::Value, EmitWhat::Gradient, EmitWhat::Directional];
    (smooth(), smooth(), 0_u32..5, 2_u32..9).prop_map(|(a, b, form, n)| {
        let text = match form {
            0 => format!("f(x, y) = sum(j in 1..{n}, sin(j x)/j + {a}) - y"),
            1 => format!("f(x, y) = product(j in 1..{n}, 1 + cos(j y)/(j + 1)) + {b}"),
            2 => format!("f(x, y) = iterate({n}, s = {a}, sin(s) + 0.25 y)"),
            3 => format!(
                "f(x, y) = r.s - r.t + {b} where r = iterate({n}, s = x, t = y, \
                 (s² - t² + 0.1 x, 2 s t + 0.1) until s² + t² > 4)"
            ),
            _ => format!("f(x, y) = sum(j in 1..{n}, if j x < y then {a} else j) + {b}"),
        };
        (text, PARTS)
    })
}

/// Formulas of one real.
fn line() -> impl Strategy<Value = (String, &'static [EmitWhat])> {
    const PARTS: &[EmitWhat] = &[EmitWhat::Value, EmitWhat::Derivative, EmitWhat::Directional];
    any_real().prop_map(|a| (format!("f(x) = {a} where y = 2x - 1"), PARTS))
}

/// Formulas with second derivatives, which are long: short ones.
fn curved() -> impl Strategy<Value = (String, &'static [EmitWhat])> {
    const PARTS: &[EmitWhat] = &[EmitWhat::Hessian, EmitWhat::Value];
    smooth()
        .prop_filter("a short formula", |a| a.chars().count() < 60)
        .prop_map(|a| (format!("f(x, y) = {a}"), PARTS))
}

/// Formulas of space.
fn space() -> impl Strategy<Value = (String, &'static [EmitWhat])> {
    const PARTS: &[EmitWhat] = &[
        EmitWhat::Value,
        EmitWhat::Gradient,
        EmitWhat::Directional,
        EmitWhat::Integral,
        EmitWhat::Opacity,
    ];
    let number = || (1_u32..40).prop_map(|k| f64::from(k) / 8.0);
    (number(), number(), number(), 0_u32..6).prop_map(|(a, b, c, form)| {
        let text = match form {
            0 => format!("f(x, y, z) = {a:?} x² + {b:?} y z - {c:?}"),
            1 => format!("f(x, y, z) = exp(-{a:?} (x² + y² + z²)) ({b:?} + {c:?} z)"),
            2 => format!("f(x, y, z) = cos({a:?} x) + sin({b:?} y) cos({c:?} z)"),
            3 => format!("f(p: vec3) = 1/(|p - ({a:?}, {b:?}, 0)|² + {c:?})"),
            4 => format!("param k = {a:?}\nf(x, y, z) = k |{b:?} x + y| + max(z, {c:?})"),
            _ => format!("f(p: vec3) = {a:?} dot(p, p.zyx) + clamp({b:?} p.y, 0, {c:?})"),
        };
        (text, PARTS)
    })
}

/// Complex formulas, holomorphic ones and others.
fn complex() -> impl Strategy<Value = (String, &'static [EmitWhat])> {
    const PARTS: &[EmitWhat] = &[EmitWhat::Value, EmitWhat::Derivative];
    (holomorphic(), holomorphic(), 0_u32..4).prop_map(|(a, b, form)| {
        let text = match form {
            0 | 1 => format!("f(z) = {a}"),
            2 => format!("param k = 0.5\nf(z) = k ({a}) + conj({b})"),
            _ => format!("f(z) = iterate(3, w = z, w² + {a}/4) - |z|"),
        };
        (text, PARTS)
    })
}

fn cases() -> impl Strategy<Value = Case> {
    let program = prop_oneof![
        5 => plane().boxed(),
        2 => loops().boxed(),
        1 => line().boxed(),
        1 => curved().boxed(),
        2 => space().boxed(),
        2 => complex().boxed(),
    ];
    let precision = prop_oneof![
        // the others bring long library functions with them, which are the same every time
        30 => Just(Precision::Fast),
        4 => Just(Precision::Accurate),
        1 => Just(Precision::Extended),
    ];
    let params = prop::sample::select(vec![
        ParamsAs::Arguments,
        ParamsAs::Uniform,
        ParamsAs::Constants,
    ]);
    (program, any::<u8>(), precision, params).prop_map(
        |((text, all), chosen, precision, params)| {
            let mut parts = vec![all[usize::from(chosen) % all.len()]];
            // one in three has two functions in one module
            let other = all[usize::from(chosen / 8) % all.len()];
            if chosen % 3 == 0 && other != parts[0] {
                parts.push(other);
            }
            Case {
                text,
                parts,
                params,
                precision,
            }
        },
    )
}

fn number(variable: &str, otherwise: usize) -> usize {
    let asked = std::env::var(variable).ok();
    asked.and_then(|n| n.parse().ok()).unwrap_or(otherwise)
}

fn sampled(count: usize, seed: usize) -> Vec<Case> {
    let mut bytes = [0_u8; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let strategy = cases();
    (0..count)
        .map(|_| strategy.new_tree(&mut runner).expect("a program").current())
        .collect()
}

fn check(case: &Case) -> Result<(), String> {
    let fail = |problem: String| Err(format!("{case:?}\n{problem}"));
    let answer = compile(&case.text);
    let Some(program) = answer.program else {
        return fail(format!("{:?}", answer.diagnostics));
    };
    let emission = case.parts[1..].iter().fold(
        Emission::new(case.parts[0], Target::Wgsl)
            .precision(case.precision)
            .params(case.params),
        |all, &part| all.and(part),
    );
    match program.emitted_module(&emission) {
        Ok(module) => check_module(&case.text, &module).or_else(fail),
        Err(problems) => fail(format!("{problems:?}")),
    }
}

#[test]
#[allow(clippy::print_stderr, reason = "the count is what is asked for")]
fn generated_programs_read_back() {
    let cases = sampled(number("PROGRAMS", 3000), number("SEED", 0));
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let found: Vec<String> = std::thread::scope(|scope| {
        let share = cases.len().div_ceil(workers).max(1);
        let all: Vec<_> = cases
            .chunks(share)
            .map(|part| scope.spawn(|| part.iter().filter_map(|c| check(c).err()).collect()))
            .collect();
        let joined = all.into_iter();
        joined
            .flat_map(|worker| -> Vec<String> { worker.join().expect("a worker") })
            .collect()
    });
    let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
    for case in &cases {
        *kinds.entry(format!("{:?}", case.parts[0])).or_default() += 1;
    }
    eprintln!("{} programs, first functions: {kinds:?}", cases.len());
    assert!(
        found.is_empty(),
        "{} of {} differ\n{}",
        found.len(),
        cases.len(),
        found[..found.len().min(12)].join("\n\n")
    );
}
