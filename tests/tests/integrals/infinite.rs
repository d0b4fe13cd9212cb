//! Integrals to infinity against mpmath at 60 digits (tests/oracle/integrals_to_infinity.py), and those that diverge.

use std::path::Path;

use pullback_compiler::integrate::{Otherwise, field_integral};
use pullback_compiler::lower::Precision;
use pullback_compiler::{What, compile};
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::{Machine, Point};

use super::{densities, formula, points};

/// What an error may be as a part of ∫ |f|: in f64, and in binary32.
const BOUNDS: [f64; 2] = [1e-11, 2e-6];

#[test]
fn integrals_to_infinity() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/integrals/to_infinity.tsv");
    let text = std::fs::read_to_string(&path).unwrap();
    let mut of = None;
    let (mut count, mut worst, mut wrong) = (0, [0.0_f64; 2], String::new());
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        if let Some(case) = line.strip_prefix("= ") {
            let [lower, upper, integrand] = case.split('\t').collect::<Vec<_>>()[..] else {
                panic!("{line}");
            };
            let text = format!("f(x, y) = integral({integrand}, t, {lower}, {upper}) + 0 x + 0 y");
            let answer = compile(&text);
            let program = answer
                .program
                .unwrap_or_else(|| panic!("{text}: {:?}", answer.diagnostics));
            of = Some((text, program.pictures()[0].formula.clone()));
            continue;
        }
        let numbers: Vec<f64> = line.split(' ').map(|n| n.parse().unwrap()).collect();
        let (text, formula) = of.as_ref().unwrap();
        let at = [Point {
            args: numbers[..2].to_vec(),
            params: Vec::new(),
        }];
        let machines = [
            Machine::Reference,
            Machine::Processor(Arithmetic::Ieee32, Precision::Accurate),
        ];
        for (k, machine) in machines.iter().enumerate() {
            let value = machine.run(formula, What::Value, &at).unwrap()[0][0];
            let error = (value - numbers[2]).abs() / numbers[3];
            worst[k] = worst[k].max(error);
            count += 1;
            if error.is_nan() || error > BOUNDS[k] {
                wrong += &format!(
                    "{text} at {:?}: {value:e}, {error:e}: {line}\n",
                    &numbers[..2]
                );
            }
        }
    }
    println!("{count} integrals to infinity, worst {worst:?}");
    assert!(count > 450 && wrong.is_empty(), "{wrong}");
}

/// Each integral, the part that is named, and a part of the reason.
#[test]
fn what_has_no_integral_to_infinity_is_named() {
    for (text, code, part, why) in [
        (
            "integral(1/t, t, 1, inf)",
            "divergent-integral",
            "1/t",
            "faster than 1/t",
        ),
        (
            "integral(exp(-t) + sin(t), t, 0, inf)",
            "divergent-integral",
            "sin(t)",
            "no limit",
        ),
        (
            "integral(3, t, 0, inf)",
            "divergent-integral",
            "3",
            "does not fall",
        ),
        (
            "integral(exp(t) t, t, 0, inf)",
            "divergent-integral",
            "exp(t) t",
            "does not fall",
        ),
        (
            "integral(exp(t^2), t, -inf, 0)",
            "divergent-integral",
            "exp(t^2)",
            "does not fall",
        ),
        (
            "integral(sqrt(1 + t^2), t, 0, inf)",
            "divergent-integral",
            "sqrt(1 + t^2)",
            "1/t",
        ),
        (
            "integral(t/(1 + t^2), t, 0, inf)",
            "divergent-integral",
            "t/(1 + t^2)",
            "1/t",
        ),
        (
            "integral(log(2 + t), t, 0, inf)",
            "divergent-integral",
            "log(2 + t)",
            "1/t",
        ),
        (
            "integral(atan(t), t, 0, inf)",
            "divergent-integral",
            "atan(t)",
            "tend to 0",
        ),
        (
            "integral(max(t, 1), t, 0, inf)",
            "divergent-integral",
            "t",
            "does not fall",
        ),
        (
            "integral(tanh(t) - 1, t, 0, inf)",
            "no-closed-form",
            "tanh(t) - 1",
            "cancel",
        ),
        (
            "integral(exp(-t^3), t, 0, inf)",
            "no-closed-form",
            "exp(-t^3)",
            "Liouville",
        ),
        (
            "quadrature(exp(-t), t, 0, inf)",
            "no-closed-form",
            "inf",
            "infinite",
        ),
    ] {
        let program = format!("f(x, y) = {text} + x y");
        let answer = compile(&program);
        assert!(answer.program.is_none(), "{text}");
        let [problem] = answer.diagnostics.as_slice() else {
            panic!("{text}: {:?}", answer.diagnostics);
        };
        assert_eq!(
            (problem.code, problem.span.text(&program)),
            (code, part),
            "{text}"
        );
        let label = format!("{:?}", problem);
        assert!(label.contains(why), "{label}");
    }
}

/// Where a slider or a coordinate decides whether an integral converges, it is NaN where it does not.
#[test]
fn divergence_at_run_time_is_not_a_number() {
    for (text, x) in [
        ("integral(exp(x t), t, 0, inf)", 0.5),
        ("integral(exp(x t), t, 0, inf)", 0.0),
        ("integral(exp(x t^2), t, -inf, inf)", 0.5),
        ("integral((1 + t)^x, t, 0, inf)", -0.5),
        ("integral(1/(1 + exp(x t)), t, 0, inf)", -1.0),
        ("integral(1/(t^2 - x), t, 0, inf)", 1.0),
        ("integral(1/(t - x), t, 0, inf) + 0/0", 1.0),
    ] {
        let Some(program) = compile(&format!("f(x, y) = {text} + 0 y")).program else {
            continue;
        };
        let at = [Point {
            args: vec![x, 0.0],
            params: Vec::new(),
        }];
        let formula = &program.pictures()[0].formula;
        let value = Machine::Reference.run(formula, What::Value, &at).unwrap()[0][0];
        assert!(value.is_nan(), "{text} at {x}: {value}");
    }
}

/// A ray whose far end is infinite only at run time: the integral is NaN or infinite, or the limit, and no other number.
#[test]
fn infinite_ends_at_run_time_give_no_wrong_number() {
    const FAR: f64 = 1e12;
    let rays = [
        [0.1, -0.2, 0.3, 0.5, 0.4, 0.7],
        [0.1, -0.2, 0.3, 0.0, 0.0, 1.0],
        [0.5, 2.0, -1.0, -0.6, 0.0, 0.8],
    ];
    let to = |end: f64| points(rays.iter().map(move |r| [&r[..], &[0.0, end]].concat()));
    let mut finite = 0;
    let mut wrong = String::new();
    for class in [
        "polynomials",
        "waves",
        "exponentials",
        "algebraic",
        "affine",
        "bells",
        "pieces",
    ] {
        for density in densities(class) {
            let of = formula(&density.text);
            let integral = field_integral(&of, Otherwise::Quadrature)
                .unwrap()
                .into_formula(&of);
            let [at, near] = [f64::INFINITY, FAR].map(|end| {
                Machine::Reference
                    .run(&integral, What::Value, &to(end))
                    .unwrap()
            });
            for ((at, near), ray) in at.iter().zip(&near).zip(&rays) {
                if at[0].is_finite() {
                    finite += 1;
                    let error = (at[0] - near[0]).abs() / near[0].abs().max(1e-3);
                    if error.is_nan() || error > 1e-6 {
                        wrong += &format!("{} {ray:?}: {} {}\n", density.text, at[0], near[0]);
                    }
                }
            }
        }
    }
    println!("{finite} finite values");
    assert!(wrong.is_empty(), "{wrong}");
}
