//! Integrals along rays against mpmath at 60 digits: tests/oracle/integrals_rays.py.

mod bad_input;
mod combinations;
#[cfg(feature = "gpu")]
mod gpu;
mod growth;
mod infinite;
mod language;
mod nodes;
mod peers;
mod poles;
mod price;
mod proof;
mod ridge;
mod rules;
mod shifted;
mod slopes;
mod stability;
mod textbook;

use std::fmt::Write as _;
use std::path::Path;

use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::{FieldIntegral, Otherwise, field_integral};
use pullback_compiler::ir::{Graph, Op, Ty, transcribe};
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
    /// Greatest error in binary32 beyond what the roundings of the ray do, as a part of ∫ |f|.
    beyond: f64,
    /// Greatest error of ∂I/∂b against f(o + b d), as a part of the greatest |∂I/∂b| and the mean of |f|.
    slope: f64,
    /// The binary32 errors of all rays.
    errors: Vec<f64>,
    complaints: String,
}

/// What an error in binary32 may be as a part of ∫ |f|, beside what comes of the roundings of o, d, a and b themselves.
const SINGLE: f64 = 1e-6;
/// What an error in f64 may be.
const DOUBLE: f64 = 1e-10;
/// How many roundings of each number of the ray, and of each term of the integrand, are allowed for.
const ROUNDINGS: f64 = 8.0;

fn points(rays: impl Iterator<Item = Vec<f64>>) -> Vec<Point> {
    let point = |args| Point {
        args,
        params: VALUES.to_vec(),
    };
    rays.map(point).collect()
}

/// How much the integral changes where each number of the ray is rounded: the sum over the eight numbers.
fn sensitivity(integral: &Formula, rays: &[Ray]) -> Vec<f64> {
    const ROUNDING: f64 = 6e-8;
    let moved = |ray: &Ray| {
        let args = ray.args.clone();
        (0..8).map(move |k| {
            let mut args = args.clone();
            args[k] += ROUNDING * args[k].abs();
            args
        })
    };
    let base = Machine::Reference.run(
        integral,
        What::Value,
        &points(rays.iter().map(|r| r.args.clone())),
    );
    let near = Machine::Reference.run(integral, What::Value, &points(rays.iter().flat_map(moved)));
    let (base, near) = (base.unwrap(), near.unwrap());
    let change = |(value, near): (&Vec<f64>, &[Vec<f64>])| {
        near.iter().map(|n| (n[0] - value[0]).abs()).sum()
    };
    base.iter().zip(near.chunks(8)).map(change).collect()
}

/// ∫ Σ |terms| of the products that the integrand was written as, by the midpoints of many pieces: the scale of the
/// roundings of the terms of f itself, where they cancel.
fn size_of_terms(of: &Formula, made: &FieldIntegral, rays: &[Ray]) -> Vec<f64> {
    const PIECES: usize = 100;
    let variable = |op: Op| made.point.iter().position(|&p| made.graph.node(p).op == op);
    let mut total = vec![0.0; rays.len()];
    let place = |ray: &Ray, k: usize| -> Vec<f64> {
        let t = ray.args[6] + (ray.args[7] - ray.args[6]) * (k as f64 + 0.5) / PIECES as f64;
        (0..3).map(|c| ray.args[c] + t * ray.args[3 + c]).collect()
    };
    let places = || {
        rays.iter()
            .flat_map(|ray| (0..PIECES).map(move |k| place(ray, k)))
    };
    for part in &made.integral.parts {
        let mut graph = Graph::new();
        let value = transcribe(
            &made.graph,
            &[part.integrand],
            &mut graph,
            |to, node, args| match node.op {
                Op::Apply(prim) => to.apply(prim, args),
                op => match variable(op) {
                    Some(k) => Formula::leaf(to, k, Ty::Real),
                    None => to.leaf(op, node.ty),
                },
            },
        );
        let one = Formula {
            graph,
            value: value.into(),
            ..of.clone()
        };
        let Ok(values) = Machine::Reference.run(&one, What::Value, &points(places())) else {
            continue;
        };
        for ((total, values), ray) in total.iter_mut().zip(values.chunks(PIECES)).zip(rays) {
            let sum: f64 = values
                .iter()
                .map(|v| v[0].abs())
                .filter(|v| v.is_finite())
                .sum();
            *total += sum * (ray.args[7] - ray.args[6]).abs() / PIECES as f64;
        }
    }
    total
}

/// |∂I/∂b - f(o + b d)| as a part of the greater of both and the mean of |f|, by our exact derivative of the closed form.
fn slope_error(of: &Formula, integral: &Formula, rays: &[Ray]) -> f64 {
    let slopes = Machine::Reference
        .run(
            integral,
            What::Gradient,
            &points(rays.iter().map(|r| r.args.clone())),
        )
        .unwrap();
    let end = |ray: &Ray| {
        (0..3)
            .map(|k| ray.args[k] + ray.args[7] * ray.args[3 + k])
            .collect()
    };
    let values = Machine::Reference
        .run(of, What::Value, &points(rays.iter().map(end)))
        .unwrap();
    let mut worst: f64 = 0.0;
    for ((ray, slope), value) in rays.iter().zip(&slopes).zip(&values) {
        let length = (ray.args[7] - ray.args[6]).abs();
        let mean = if length > 0.0 { ray.size / length } else { 0.0 };
        let (slope, value) = (slope[8], value[0]);
        // both are roundings where f is 0 all along
        if ray.size == 0.0 && slope.abs() < 1e-14 && value == 0.0 {
            continue;
        }
        let error = (slope - value).abs() / slope.abs().max(value.abs()).max(mean).max(1e-30);
        if length > 0.0 {
            worst = worst.max(if error.is_nan() { f64::INFINITY } else { error });
            if error.is_nan() || error > 1e-7 {
                println!("    dI/db = {slope:e}, not {value:e} at {:?}", ray.args);
            }
        }
    }
    worst
}

/// The integral as a formula, and for each ray the error that the roundings of the ray and of the terms may make.
fn with_allowances(of: &Formula, made: FieldIntegral, rays: &[Ray]) -> (Formula, Vec<f64>) {
    let terms = size_of_terms(of, &made, rays);
    let integral = made.into_formula(of);
    let moved = sensitivity(&integral, rays);
    let allowed = moved
        .iter()
        .zip(&terms)
        .map(|(m, t)| ROUNDINGS * m + ROUNDINGS * 6e-8 * t)
        .collect();
    (integral, allowed)
}

fn measure(density: &Density) -> Measured {
    let of = formula(&density.text);
    let made = field_integral(&of, Otherwise::Quadrature)
        .unwrap_or_else(|e| panic!("{}: {e:?}", density.text));
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
        beyond: 0.0,
        slope: 0.0,
        errors: Vec::new(),
        complaints: String::new(),
    };
    out.rules.sort_unstable();
    out.rules.dedup();
    let (integral, allowed) = with_allowances(&of, made, &density.rays);
    out.slope = slope_error(&of, &integral, &density.rays);
    let at = points(density.rays.iter().map(|r| r.args.clone()));
    let machines = [
        Machine::Reference,
        Machine::Processor(Arithmetic::Ieee32, Precision::Accurate),
    ];
    for (k, machine) in machines.iter().enumerate() {
        let values = machine
            .run(&integral, What::Value, &at)
            .unwrap_or_else(|e| panic!("{}: {e}", density.text));
        for ((ray, value), allowed) in density.rays.iter().zip(&values).zip(&allowed) {
            let error = (value[0] - ray.exact).abs();
            let error = if error.is_nan() { f64::INFINITY } else { error };
            // what is below the least normal number of the format is 0
            let part = |error: f64| {
                if error < 1e-37 {
                    0.0
                } else {
                    error / ray.size.max(1e-37)
                }
            };
            out.worst[k] = out.worst[k].max(part(error));
            let beyond = if k == 1 {
                out.errors.push(part(error));
                let beyond = part((error - allowed).max(0.0));
                out.beyond = out.beyond.max(beyond);
                beyond
            } else {
                part(error)
            };
            if beyond > [DOUBLE, SINGLE][k] {
                let _ = writeln!(
                    out.complaints,
                    "    {} {:?}: {:e}, not {:e}: {:.1e} of {:e}, roundings {:.1e}",
                    ["f64", "f32"][k],
                    ray.args,
                    value[0],
                    ray.exact,
                    part(error),
                    ray.size,
                    part(*allowed)
                );
            }
            if ray.args[6] == ray.args[7] && value[0] != 0.0 {
                let _ = writeln!(out.complaints, "    an empty interval has {:e}", value[0]);
            }
        }
    }
    out
}

/// Measures every density of a class, prints what was found, and gives it.
fn survey(class: &str) -> Vec<Measured> {
    let out: Vec<Measured> = densities(class).iter().map(measure).collect();
    println!("{class}");
    for found in &out {
        println!(
            "  {:<60} f64 {:.0e}  f32 {:.0e}  beyond {:.0e}  slope {:.0e}  {}{:?}",
            found.text,
            found.worst[0],
            found.worst[1],
            found.beyond,
            found.slope,
            if found.numerical > 0 {
                "NUMERICAL "
            } else {
                ""
            },
            found.rules
        );
        print!("{}", found.complaints);
    }
    let errors: Vec<f64> = out.iter().flat_map(|f| f.errors.iter().copied()).collect();
    let good = errors.iter().filter(|&&e| e <= SINGLE).count();
    println!(
        "  {} densities, {} rays, {good} within 1e-6 of ∫ |f| in binary32",
        out.len(),
        errors.len()
    );
    out
}

/// Every density of a class is integrated in closed form, and right.
fn check(class: &str) {
    for found in survey(class) {
        assert_eq!(found.numerical, 0, "{}: {:?}", found.text, found.rules);
        assert!(
            found.complaints.is_empty(),
            "{}\n{}",
            found.text,
            found.complaints
        );
        assert!(
            found.slope < 1e-7,
            "{}: dI/db is off by {:e}",
            found.text,
            found.slope
        );
    }
}

#[test]
fn polynomials() {
    check("polynomials");
}

#[test]
fn waves() {
    check("waves");
}

#[test]
fn exponentials() {
    check("exponentials");
}

#[test]
fn mixed() {
    check("mixed");
}

#[test]
fn pieces() {
    check("pieces");
}

#[test]
fn algebraic() {
    check("algebraic");
}

#[test]
fn affine() {
    check("affine");
}

#[test]
fn bells() {
    check("bells");
}

#[test]
fn products() {
    check("products");
}

#[test]
fn gaussians() {
    check("gaussians");
}

#[test]
fn fractions() {
    check("fractions");
}

#[test]
fn scenes() {
    check("scenes");
}

#[test]
fn random() {
    check("random");
}

/// Rays at the edges of what binary32 holds: where the integral is finite in f64 it is no NaN or infinity in
/// binary32, as long as f itself is a finite number in binary32 at both ends and in the middle.
#[test]
fn extreme_rays_give_numbers() {
    const DIRECTIONS: [f64; 9] = [0.0, 1e-40, 1e-30, 1e-20, 1e-8, 1e-5, 1e-3, 1e-1, 1.0];
    const LENGTHS: [f64; 7] = [1e-7, 1e-4, 1e-2, 1.0, 10.0, 1e3, 1e4];
    const ORIGINS: [f64; 4] = [0.0, 1.0, 10.0, 100.0];
    let mut rays = Vec::new();
    for (k, length) in LENGTHS.iter().cycle().take(126).enumerate() {
        let pick = |n: usize, sign: bool| DIRECTIONS[n % 9] * if sign { -1.0 } else { 1.0 };
        let d = [
            pick(k / 7, k % 2 == 0),
            pick(k / 5 + 3, k % 3 == 0),
            pick(k / 2 + 7, k % 5 == 0),
        ];
        let scale = ORIGINS[k / 3 % 4];
        let o = [0.61 * scale, -0.23 * scale, 0.37 * scale];
        let a = [0.0, -0.5, 2.0][k % 3];
        let ends = if k % 11 == 0 {
            [a + length, a]
        } else {
            [a, a + length]
        };
        let numbers = o.into_iter().chain(d).chain(ends);
        rays.push(numbers.map(|x| f64::from(x as f32)).collect::<Vec<f64>>());
    }
    let at = points(rays.into_iter());
    let (mut checked, mut wrong) = (0, String::new());
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
        "products",
        "gaussians",
        "random",
    ] {
        for density in densities(class) {
            let of = formula(&density.text);
            let integral = field_integral(&of, Otherwise::Quadrature)
                .unwrap()
                .into_formula(&of);
            let exact = Machine::Reference.run(&integral, What::Value, &at).unwrap();
            let single = Machine::Processor(Arithmetic::Ieee32, Precision::Accurate);
            let found = single.run(&integral, What::Value, &at).unwrap();
            let on_ray = |point: &Point| {
                let args = point.args.clone();
                [0.0, 0.5, 1.0].map(|part| {
                    let t = args[6] + part * (args[7] - args[6]);
                    (0..3)
                        .map(|c| args[c] + t * args[3 + c])
                        .collect::<Vec<f64>>()
                })
            };
            let places = points(at.iter().flat_map(on_ray));
            let values = single.run(&of, What::Value, &places).unwrap();
            for (((exact, found), point), values) in
                exact.iter().zip(&found).zip(&at).zip(values.chunks(3))
            {
                if exact[0].abs() < 1e30 && values.iter().all(|v| v[0].is_finite()) {
                    checked += 1;
                    if !found[0].is_finite() {
                        let _ = writeln!(
                            wrong,
                            "{}: {} at {:?}, not {}",
                            density.text, found[0], point.args, exact[0]
                        );
                    }
                }
            }
        }
    }
    println!("{checked} finite integrals");
    assert!(
        wrong.is_empty(),
        "{} of {checked}:\n{wrong}",
        wrong.lines().count()
    );
}
