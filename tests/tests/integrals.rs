//! Integrals along rays against mpmath at 60 digits: tests/oracle/integrals_rays.py.

use std::fmt::Write as _;
use std::path::Path;

use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::{FieldIntegral, Otherwise, field_integral};
use pullback_compiler::lower::Precision;
use pullback_compiler::{What, compile};
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::{Machine, Point};

/// Values of p, q and r, as the oracle has them.
const PARAMETERS: &str = "param p = 0.75\nparam q = -1.25\nparam r = 2.5\n";
const VALUES: [f64; 3] = [0.75, -1.25, 2.5];

/// A density with rays and their integrals.
struct Density {
    text: String,
    rays: Vec<Ray>,
}

#[derive(Clone)]
struct Ray {
    /// o, d, a, b.
    args: Vec<f64>,
    exact: f64,
    /// ∫ |f|
    size: f64,
}

fn densities(class: &str) -> Vec<Density> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("data/integrals/{class}.tsv"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut out: Vec<Density> = Vec::new();
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        if let Some(text) = line.strip_prefix("= ") {
            out.push(Density {
                text: text.to_owned(),
                rays: Vec::new(),
            });
            continue;
        }
        let numbers: Vec<f64> = line.split(' ').map(|n| n.parse().unwrap()).collect();
        assert_eq!(numbers.len(), 10, "{line}");
        let ray = Ray {
            args: numbers[..8].to_vec(),
            exact: numbers[8],
            size: numbers[9],
        };
        out.last_mut().unwrap().rays.push(ray);
    }
    out
}

fn formula(text: &str) -> Formula {
    let answer = compile(&format!("{PARAMETERS}f(x, y, z) = {text}"));
    let program = answer
        .program
        .unwrap_or_else(|| panic!("{text}: {:?}", answer.diagnostics));
    program.pictures()[0].formula.clone()
}

/// Errors of one density.
struct Measured {
    text: String,
    rules: Vec<&'static str>,
    numerical: usize,
    /// Greatest error in f64 and in binary32, each as a part of ∫ |f|.
    worst: [f64; 2],
    /// The binary32 errors of all rays.
    errors: Vec<f64>,
    complaints: String,
}

fn measure(density: &Density) -> Measured {
    let of = formula(&density.text);
    let made: FieldIntegral = field_integral(&of, Otherwise::Quadrature)
        .unwrap_or_else(|e| panic!("{}: {:?}", density.text, e));
    let mut out = Measured {
        text: density.text.clone(),
        rules: made
            .integral
            .parts
            .iter()
            .map(|p| p.rule.record().name)
            .collect(),
        numerical: made.integral.numerical.len(),
        worst: [0.0; 2],
        errors: Vec::new(),
        complaints: String::new(),
    };
    out.rules.sort_unstable();
    out.rules.dedup();
    let integral = made.into_formula(&of);
    let points: Vec<Point> = density
        .rays
        .iter()
        .map(|ray| Point {
            args: ray.args.clone(),
            params: VALUES.to_vec(),
        })
        .collect();
    let machines = [
        Machine::Reference,
        Machine::Processor(Arithmetic::Ieee32, Precision::Accurate),
    ];
    for (k, machine) in machines.iter().enumerate() {
        let values = machine
            .run(&integral, What::Value, &points)
            .unwrap_or_else(|e| panic!("{}: {e}", density.text));
        for (ray, value) in density.rays.iter().zip(&values) {
            let error = (value[0] - ray.exact).abs();
            let relative = if error == 0.0 {
                0.0
            } else {
                error / ray.size.max(1e-37)
            };
            let relative = if relative.is_nan() {
                f64::INFINITY
            } else {
                relative
            };
            out.worst[k] = out.worst[k].max(relative);
            if k == 1 {
                out.errors.push(relative);
            }
            let limit = if k == 0 { 1e-9 } else { 1e-6 };
            if relative > limit {
                let _ = writeln!(
                    out.complaints,
                    "    {} {:?}: {:e}, not {:e}: {relative:.1e} of {:e}",
                    if k == 0 { "f64" } else { "f32" },
                    ray.args,
                    value[0],
                    ray.exact,
                    ray.size
                );
            }
        }
    }
    out
}

#[test]
fn survey() {
    let only = std::env::var("ONLY").unwrap_or_default();
    let mut closed = 0;
    let mut all = 0;
    for class in [
        "polynomials",
        "waves",
        "exponentials",
        "mixed",
        "pieces",
        "algebraic",
        "affine",
        "bells",
        "scenes",
        "random",
    ] {
        if !only.is_empty() && !only.split(',').any(|o| o == class) {
            continue;
        }
        println!("{class}");
        for density in densities(class) {
            let found = measure(&density);
            all += 1;
            closed += usize::from(found.numerical == 0);
            println!(
                "  {:<60} f64 {:.1e} f32 {:.1e} {}{:?}",
                found.text,
                found.worst[0],
                found.worst[1],
                if found.numerical > 0 {
                    "NUMERICAL "
                } else {
                    ""
                },
                found.rules
            );
            if std::env::var("DETAILS").is_ok() {
                print!("{}", found.complaints);
            }
        }
    }
    println!("{closed} of {all}");
}
