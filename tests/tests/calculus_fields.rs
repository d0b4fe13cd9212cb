//! Laplacians, curvatures and the identities of vector analysis: on the processor in `f64`, and on the GPU.

use pullback_compiler::What;
use pullback_tests::calculus::{Device, Noise, columns, devices, formula};

/// Solutions of Laplace's equation in the plane.
const PLANE: &[&str] = &[
    "ln(x² + y²)",
    "ln(hypot(x, y))",
    "exp(x) cos(y)",
    "exp(-2x) sin(2y)",
    "sin(x) sinh(y)",
    "atan2(y, x)",
    "x/(x² + y²)",
    "(x² - y²)/(x² + y²)²",
    "re((x + i y)^3)",
    "im((x + i y)^6)",
    "re(log(x + i y))",
    "im(sin(x + i y))",
    "re(exp((x + i y)²/4))",
    "arg(x + i y)",
    "ln(abs(x + i y))",
    "(a² - 3b²) a where a = x + y, b = x - y",
];

/// Solutions of Laplace's equation in space; the polynomials are spherical harmonics times a power of |p|.
const SPACE: &[&str] = &[
    "1/|(x, y, z)|",
    "1/√(x² + y² + z²)",
    "z/|(x, y, z)|^3",
    "(2z² - x² - y²)/|(x, y, z)|^5",
    "x y z",
    "2z³ - 3x² z - 3y² z",
    "x^4 - 6x² y² + y^4 + z",
    "35z^4 - 30z² r + 3r² where r = x² + y² + z²",
    "(x² - y²) (7z² - (x² + y² + z²))",
    "exp(3x/4 + y) sin(5z/4)",
    "ln(hypot(x, y)) + z",
    "ln(√(x² + y² + z²) + z)",
    "atan2(y, x) + 0 z",
];

/// What a laplacian may differ from zero, in rounding units times the sum of the sizes of all second derivatives, mixed
/// ones included: that sum does not depend on the axes, and where f_xx and f_yy happen to be small they are themselves
/// differences of what is as large as f_xy.
const HARMONIC_BOUND: f64 = 24.0;

/// A function of x, y (and z) whose second derivatives are asked for.
fn program(body: &str, dimension: usize) -> String {
    let inputs = if dimension == 2 { "x, y" } else { "x, y, z" };
    format!("f({inputs}) = {body}")
}

/// A formula in front of its `where`, in a call.
fn wrapped(operator: &str, body: &str) -> String {
    match body.split_once(" where ") {
        Some((value, locals)) => format!("{operator}({value}) where {locals}"),
        None => format!("{operator}({body})"),
    }
}

/// |Σ f_ii| against the sizes of the second derivatives, at random points.
fn laplacians(device: &Device, bodies: &[&str], dimension: usize) -> f64 {
    let mut worst = 0.0_f64;
    for body in bodies {
        let points = Noise::new(7).points(dimension, 200, 0.3);
        let laplacian = program(&wrapped("laplacian", body), dimension);
        let found = columns(device, &laplacian, What::Value, &points);
        let terms = columns(
            &Device::Reference,
            &program(body, dimension),
            What::Hessian,
            &points,
        );
        for ((found, terms), point) in found.iter().zip(&terms).zip(&points) {
            let sizes: f64 = terms[1 + dimension..].iter().map(|t| t.abs()).sum();
            let ratio = found[0].abs() / (sizes * device.unit()).max(f64::MIN_POSITIVE);
            assert!(
                ratio <= HARMONIC_BOUND,
                "{laplacian} at {point:?}: {} where the terms are {sizes}, a ratio of {ratio}",
                found[0]
            );
            worst = worst.max(ratio);
        }
    }
    worst
}

#[test]
fn harmonic_functions_have_no_laplacian() {
    for device in &devices() {
        let plane = laplacians(device, PLANE, 2);
        let space = laplacians(device, SPACE, 3);
        println!(
            "{}: {plane:.1} and {space:.1} of {HARMONIC_BOUND}",
            device.name()
        );
    }
}

/// The bound would not hold for a function that is nearly harmonic.
#[test]
fn a_laplacian_that_is_small_is_not_zero() {
    let points = Noise::new(7).points(2, 50, 0.3);
    let text = program("laplacian(x² - 1.0000001 y²)", 2);
    for row in columns(&Device::Reference, &text, What::Value, &points) {
        assert!((row[0] + 2e-7).abs() < 1e-14, "{row:?}");
    }
}

/// Relative error that curvatures may have, in rounding units, to the size of the sum of what they are made of.
const CURVATURE_BOUND: f64 = 16.0;

#[test]
fn curvatures_are_those_of_the_fundamental_forms() {
    let table = include_str!("../data/calculus/curvature.tsv");
    let rows: Vec<Vec<&str>> = table
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split('\t').collect())
        .collect();
    assert_eq!(rows.len(), 144);
    for device in &devices() {
        let mut worst = [0.0_f64; 2];
        for run in rows.chunk_by(|a, b| a[0] == b[0]) {
            let dimension = if run[0][3] == "-" { 2 } else { 3 };
            let points: Vec<Vec<f64>> = run
                .iter()
                .map(|row| {
                    row[1..=dimension]
                        .iter()
                        .map(|x| x.parse().expect("a number"))
                        .collect()
                })
                .collect();
            let kinds = ["mean_curvature", "gaussian_curvature"];
            let kinds = &kinds[..dimension - 1];
            for (k, kind) in kinds.iter().enumerate() {
                let text = program(&format!("{kind}({})", run[0][0]), dimension);
                let found = columns(device, &text, What::Value, &points);
                for (row, found) in run.iter().zip(&found) {
                    let expected: f64 = row[4 + k].parse().expect("a number");
                    // both curvatures are made of κ₁ and κ₂, which the other one bounds from below
                    let mean: f64 = row[4].parse().expect("a number");
                    let size = if k == 0 {
                        mean.abs().max(0.25)
                    } else {
                        expected.abs().max(mean * mean).max(0.25)
                    };
                    let ratio = (found[0] - expected).abs() / (device.unit() * size);
                    assert!(
                        ratio <= CURVATURE_BOUND,
                        "{text} at {row:?} on {}: {} instead of {expected}, a ratio of {ratio}",
                        device.name(),
                        found[0]
                    );
                    worst[k] = worst[k].max(ratio);
                }
            }
        }
        println!("{}: {worst:.1?} of {CURVATURE_BOUND}", device.name());
    }
}

/// A surface that is scaled keeps its curvature: where |∇f|³ or |∇f|⁴ would overflow or underflow in `f32`.
#[test]
fn curvatures_do_not_overflow_early() {
    let points = vec![vec![1.0, 2.0, 2.0]];
    for device in &devices() {
        for scale in ["1e30", "1e-30", "1"] {
            for (kind, expected) in [
                ("mean_curvature", 1.0 / 3.0),
                ("gaussian_curvature", 1.0 / 9.0),
            ] {
                let text = program(&format!("{kind}({scale} (x² + y² + z²))"), 3);
                let found = columns(device, &text, What::Value, &points)[0][0];
                assert!(
                    (found - expected).abs() < 1e-6,
                    "{text}: {found} on {}",
                    device.name()
                );
            }
        }
    }
}

#[test]
fn curvatures_are_undefined_without_a_normal() {
    let origin = vec![vec![0.0, 0.0, 0.0]];
    for device in &devices() {
        for kind in ["mean_curvature", "gaussian_curvature"] {
            let text = program(&format!("{kind}(x² + y² + z²)"), 3);
            let found = columns(device, &text, What::Value, &origin)[0][0];
            assert!(found.is_nan(), "{text}: {found} on {}", device.name());
        }
    }
}

/// Functions and the sizes of their second derivatives, by which identities are judged.
const SMOOTH: &[&str] = &[
    "sin(x y) exp(z/3)",
    "x³ y² z + cos(x + 2y - z)",
    "√(1 + x² + y² z²)",
    "atan2(y + 3, x z + 4)",
    "1/(3 + sin(x) cos(y z))",
    "sum(k in 1..4, sin(k x + y) z^k/k)",
    "iterate(3, w = x/2, sin(w) + y z/4)",
];

/// What both sides of an identity may differ, in rounding units times the size of the derivatives in it, of which at
/// most three are multiplied.
const IDENTITY_BOUND: f64 = 4.0;

/// Both sides of an identity, given one function or three; the sizes are those of the derivatives up to the third
/// order, estimated by those of the second.
fn identity(device: &Device, left: &str, right: &str, scale: &str) -> f64 {
    let points = Noise::new(11).points(3, 100, 0.2);
    let of = |device: &Device, text: &str| columns(device, &program(text, 3), What::Value, &points);
    let (left_values, right_values) = (of(device, left), of(device, right));
    let sizes = of(&Device::Reference, scale);
    let mut worst = 0.0_f64;
    for ((l, r), (size, point)) in left_values
        .iter()
        .zip(&right_values)
        .zip(sizes.iter().zip(&points))
    {
        let ratio = (l[0] - r[0]).abs() / (device.unit() * (size[0] + l[0].abs() + 1e-3));
        assert!(
            ratio <= IDENTITY_BOUND,
            "{left} = {} and {right} = {} at {point:?} on {}: a ratio of {ratio}",
            l[0],
            r[0],
            device.name()
        );
        worst = worst.max(ratio);
    }
    worst
}

#[test]
fn identities_of_vector_analysis() {
    for device in &devices() {
        let mut worst = 0.0_f64;
        for (k, e) in SMOOTH.iter().enumerate() {
            let (b, c) = (
                SMOOTH[(k + 1) % SMOOTH.len()],
                SMOOTH[(k + 2) % SMOOTH.len()],
            );
            let second =
                format!("|grad(diff({e}, x))| + |grad(diff({e}, y))| + |grad(diff({e}, z))|");
            let third = |e: &str| {
                ["x, y", "x, z", "y, z"]
                    .map(|by| format!("|diff({e}, {by})|"))
                    .join(" + ")
            };
            let cases = [
                // curl grad = 0, div grad = Δ
                (
                    format!("|curl(grad({e}))|"),
                    "0 x y z".to_owned(),
                    second.clone(),
                ),
                (
                    format!("div(grad({e}))"),
                    format!("laplacian({e})"),
                    second.clone(),
                ),
                // div curl = 0
                (
                    format!("div(curl(({e}, {b}, {c})))"),
                    "0 x y z".to_owned(),
                    [third(e), third(b), third(c)].join(" + "),
                ),
                // the Hessian is the Jacobian of the gradient
                (
                    format!("hessian({e})"),
                    format!("jacobian(grad({e}))"),
                    format!("(1 + {second})³"),
                ),
                // Δ(a b) = a Δb + 2 ∇a · ∇b + b Δa
                (
                    format!("laplacian(({e}) ({b}))"),
                    format!(
                        "({e}) laplacian({b}) + 2 dot(grad({e}), grad({b})) + ({b}) laplacian({e})"
                    ),
                    format!(
                        "(1 + |{e}| + |grad({e})| + {second}) (1 + |{b}| + |grad({b})| + |grad(diff({b}, x))| + |grad(diff({b}, y))| + |grad(diff({b}, z))|)"
                    ),
                ),
                // Schwarz: second derivatives do not depend on the order
                (
                    format!("diff({e}, x, y, z)"),
                    format!("diff({e}, z, y, x)"),
                    format!("1 + {second}"),
                ),
                // H of the level surface is the divergence of the normal
                (
                    format!("mean_curvature({e})"),
                    format!("div(normalize(grad({e})))/2"),
                    format!("({second})/|grad({e})|"),
                ),
            ];
            for (left, right, scale) in cases {
                worst = worst.max(identity(device, &left, &right, &scale));
            }
        }
        println!("{}: {worst:.1} of {IDENTITY_BOUND}", device.name());
    }
}

/// The determinant of ∂(re, im)/∂(x, y) of a holomorphic function is |f′|².
#[test]
fn jacobians_of_holomorphic_functions() {
    for device in &devices() {
        for w in [
            "z³ + 2z",
            "exp(z)/2",
            "sin(z)",
            "1/(z + 5)",
            "log(z + 4)",
            "√(z + 4i)",
            "z^(1 + i/2)",
        ] {
            let definition = format!("w(z) = {w}\n");
            let points = Noise::new(3).points(2, 100, 0.3);
            let of = |body: &str| {
                let text = format!("{definition}f(x, y) = {body}");
                columns(device, &text, What::Value, &points)
            };
            let (jacobian, slope) = (of("jacobian(w(x + i y))"), of("abs(w'(x + i y))²"));
            for ((j, s), p) in jacobian.iter().zip(&slope).zip(&points) {
                let ratio = (j[0] - s[0]).abs() / (device.unit() * s[0]);
                assert!(
                    ratio <= 64.0,
                    "{w} at {p:?} on {}: {} and {}",
                    device.name(),
                    j[0],
                    s[0]
                );
            }
        }
    }
}

/// `--what hessian`: the columns, their names, and that they are the derivatives that the language takes.
#[test]
fn second_derivatives_at_points() {
    let body = "x³ y² z + cos(x + 2y - z)";
    let (found, _) = formula(&program(body, 3)).unwrap_or_else(|e| panic!("{e}"));
    let evaluator = pullback_compiler::Evaluator::new(&found, What::Hessian);
    let evaluator = evaluator.unwrap_or_else(|e| panic!("{e:?}"));
    assert_eq!(
        evaluator.outputs(),
        [
            "f", "df/dx", "df/dy", "df/dz", "d2f/dxdx", "d2f/dxdy", "d2f/dxdz", "d2f/dydy",
            "d2f/dydz", "d2f/dzdz"
        ]
    );
    let points = Noise::new(5).points(3, 20, 0.2);
    for device in &devices() {
        let all = columns(device, &program(body, 3), What::Hessian, &points);
        for (k, by) in ["x, x", "x, y", "x, z", "y, y", "y, z", "z, z"]
            .iter()
            .enumerate()
        {
            let one = columns(
                &Device::Reference,
                &program(&format!("diff({body}, {by})"), 3),
                What::Value,
                &points,
            );
            for (all, one) in all.iter().zip(&one) {
                let bound = 64.0 * device.unit() * (10.0 + one[0].abs());
                assert!(
                    (all[4 + k] - one[0]).abs() <= bound,
                    "{by}: {} and {}",
                    all[4 + k],
                    one[0]
                );
            }
        }
    }
}
