//! Integrals along rays against mpmath at 60 digits: tests/oracle/integrals_rays.py.

use std::fmt::Write as _;
use std::path::Path;

use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::{FieldIntegral, Otherwise, field_integral};
use pullback_compiler::ir::{Graph, Op, Ty, transcribe};
use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Target, What, compile, compile_function};
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
        let error = (slope - value).abs() / slope.abs().max(value.abs()).max(mean).max(1e-30);
        if length > 0.0 {
            worst = worst.max(if error.is_nan() { f64::INFINITY } else { error });
        }
    }
    worst
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
    let terms = size_of_terms(&of, &made, &density.rays);
    let integral = made.into_formula(&of);
    out.slope = slope_error(&of, &integral, &density.rays);
    let moved = sensitivity(&integral, &density.rays);
    let allowed: Vec<f64> = moved
        .iter()
        .zip(&terms)
        .map(|(m, t)| ROUNDINGS * m + ROUNDINGS * 6e-8 * t)
        .collect();
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
fn scenes() {
    check("scenes");
}

#[test]
fn random() {
    check("random");
}

/// A density, and its antiderivative as a textbook has it, at t with the height v = o.y + t d.y, its rate w = d.y, and
/// q = A t^2 + 2 B t + C.
const TEXTBOOK: [(&str, &str); 12] = [
    ("sin(3 y)", "-cos(3 v)/(3 w)"),
    ("sin(3 y)^2", "t/2 - sin(6 v)/(12 w)"),
    ("exp(-2 y)", "-exp(-2 v)/(2 w)"),
    ("y exp(-y)", "-(v + 1) exp(-v)/w"),
    ("max(0, y)", "max(0, v)^2/(2 w)"),
    ("1/(y + 12)", "log(v + 12)/w"),
    (
        "(x^2 + y^2 + z^2 - 1)^2",
        "A^2 t^5/5 + A B t^4 + (4 B^2 + 2 A (C - 1)) t^3/3 + 2 B (C - 1) t^2 + (C - 1)^2 t",
    ),
    (
        "1/(x^2 + y^2 + z^2 + 0.01)",
        "atan((A t + B)/sqrt(D + 0.01 A))/sqrt(D + 0.01 A)",
    ),
    (
        "1/(x^2 + y^2 + z^2 + 0.01)^2",
        "(A t + B)/(2 k (q + 0.01)) + A atan((A t + B)/sqrt(k))/(2 k sqrt(k)) where k = D + 0.01 A",
    ),
    (
        "length((x, y, z))",
        "(A t + B) sqrt(q)/(2 A) + D log(A t + B + sqrt(A) sqrt(q))/(2 A sqrt(A))",
    ),
    (
        "1/length((x, y, z))",
        "log(A t + B + sqrt(A) sqrt(q))/sqrt(A)",
    ),
    (
        "exp(-(x^2 + y^2 + z^2))",
        "sqrt(pi)/(2 sqrt(A)) exp(-D/A) erf((A t + B)/sqrt(A))",
    ),
];

/// F(b) - F(a) as a function of the ray.
fn textbook(antiderivative: &str) -> Formula {
    let text = format!(
        "f(o: vec3, d: vec3, a: real, b: real) = F(o, d, b) - F(o, d, a)\n\
         F(o: vec3, d: vec3, t: real) = G(t, o.y + t d.y, d.y, dot(d, d), dot(o, d), dot(o, o))\n\
         G(t, v, w, A, B, C) = H(t, v, w, A, B, C, A C - B^2, A t^2 + 2 B t + C)\n\
         H(t, v, w, A, B, C, D, q) = {antiderivative}\n"
    );
    compile_function(&text).unwrap_or_else(|e| panic!("{text}: {e:?}"))
}

/// Rays whose height changes at any rate down to none: the generator is that of Knuth's MMIX.
fn some_rays(count: usize) -> Vec<Vec<f64>> {
    let mut state = 12345_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut between = |lo: f64, hi: f64| f64::from((lo + (hi - lo) * next()) as f32);
    let mut out = Vec::new();
    for k in 0..count {
        let angle = between(0.0, 6.25);
        let rate = match k % 4 {
            0 => between(-0.9, 0.9),
            1 => between(-1.0, 1.0) * 1e-3,
            2 => between(-1.0, 1.0) * 1e-6,
            _ => {
                if k % 8 == 3 {
                    0.0
                } else {
                    between(-1.0, 1.0) * 1e-2
                }
            }
        };
        let flat = (1.0 - rate * rate).sqrt();
        let d = [flat * angle.cos(), rate, flat * angle.sin()];
        let distance = if k % 5 == 0 { 8.0 } else { 0.0 };
        let o: Vec<f64> = (0..3)
            .map(|c| between(-2.0, 2.0) - distance * d[c])
            .collect();
        let length = 10_f64.powf(between(-3.0, 0.8));
        let a = if distance > 0.0 {
            6.0
        } else {
            between(-1.0, 1.0)
        };
        let numbers = o.into_iter().chain(d).chain([a, a + length]);
        out.push(numbers.map(|x| f64::from(x as f32)).collect());
    }
    out
}

/// Median and greatest error as a part of ∫ |f|, told with one digit.
fn told(mut errors: Vec<f64>) -> (String, [f64; 2]) {
    errors.sort_by(f64::total_cmp);
    let (median, worst) = (errors[errors.len() / 2], errors[errors.len() - 1]);
    let digit = |x: f64| {
        if x.is_finite() {
            format!("{x:.0e}")
        } else {
            "∞".to_owned()
        }
    };
    (
        format!("{} | {}", digit(median), digit(worst)),
        [median, worst],
    )
}

/// The table of `docs/integrals.md`: the closed forms against F(b) - F(a) on the same 400 rays in binary32. `BLESS=1`
/// writes it.
#[test]
fn closed_forms_against_the_textbook() {
    const BEGIN: &str = "| density | textbook, median | worst | closed form, median | worst |\n| --- | --- | --- | --- | --- |\n";
    let machine = Machine::Processor(Arithmetic::Ieee32, Precision::Accurate);
    let rays = points(some_rays(400).into_iter());
    let mut table = BEGIN.to_owned();
    for (density, antiderivative) in TEXTBOOK {
        let of = formula(density);
        let integral = field_integral(&of, Otherwise::Refuse)
            .unwrap()
            .into_formula(&of);
        let sized = formula(&format!("abs({density})"));
        let size = field_integral(&sized, Otherwise::Quadrature)
            .unwrap()
            .into_formula(&sized);
        let run = |machine: &Machine, formula: &Formula| -> Vec<f64> {
            let rows = machine
                .run(formula, What::Value, &rays)
                .unwrap_or_else(|e| panic!("{density}: {e}"));
            rows.iter().map(|row| row[0]).collect()
        };
        let exact = run(&Machine::Reference, &integral);
        let size = run(&Machine::Reference, &size);
        let errors = |found: Vec<f64>| {
            let error = |((f, e), s): ((&f64, &f64), &f64)| {
                let error = if f == e { 0.0 } else { (f - e).abs() / s };
                if error.is_nan() { f64::INFINITY } else { error }
            };
            told(found.iter().zip(&exact).zip(&size).map(error).collect())
        };
        let (naive, [_, bad]) = errors(run(&machine, &textbook(antiderivative)));
        let (ours, [median, worst]) = errors(run(&machine, &integral));
        table += &format!("| `{density}` | {naive} | {ours} |\n");
        // what is left comes of the roundings of rays that meet a zero of f
        assert!(
            median < 5e-7 && worst < 1e-2 * bad,
            "{density}: {ours}, textbook {naive}"
        );
    }
    println!("{table}");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/integrals.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let start = page.find(BEGIN).expect("the head of the table");
    let end = page[start..]
        .find("\n\n")
        .map_or(page.len(), |n| start + n + 1);
    let now = format!("{}{table}{}", &page[..start], &page[end..]);
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, now).unwrap();
    } else {
        assert!(
            page == now,
            "docs/integrals.md is not up to date: run with BLESS=1 and read the difference"
        );
    }
}

/// Integrals that stand in formulas, at x = 2, y = 1; by mpmath's quad.
#[test]
fn integrals_of_the_language() {
    for (text, exact) in [
        (
            "integral(exp(-t) sin(2 t)^2, t, 0, x)",
            0.386_589_075_958_063_04,
        ),
        (
            "integral(max(0, 1 - |t - y|)^2 exp(-t^2), t, -1, x)",
            0.264_626_483_727_039,
        ),
        ("quadrature(t + sin(t^2), t, 0, x)", 2.804_776_489_343_756_1),
        (
            "integral(sqrt(1 + t^2), t, x, -y)",
            -4.105_679_289_785_513_9,
        ),
        (
            "integral((cos(t), t^3), t, 0, x).x",
            0.909_297_426_825_681_7,
        ),
        ("integral((cos(t), t^3), t, 0, x).y", 4.0),
        (
            "integral(integral(t u + t^2, t, 0, u), u, 0, x)",
            10.0 / 3.0,
        ),
        ("integral(t in 0..x, exp(-t^2))", 0.882_081_390_762_421_68),
        (
            "integral(sum(k in 1..5, sin(k t)/k), t, 0, x)",
            1.979_139_878_744_656_8,
        ),
        ("integral(g(t), t, 0, x)\ng(t) = t^2", 8.0 / 3.0),
        (
            "diff(integral(exp(-t^2), t, 0, x), x)",
            0.018_315_638_888_734_18,
        ),
    ] {
        let program = compile(&format!("f(x, y) = {text}"));
        let program = program
            .program
            .unwrap_or_else(|| panic!("{text}: {:?}", program.diagnostics));
        let point = [Point {
            args: vec![2.0, 1.0],
            params: Vec::new(),
        }];
        let formula = &program.pictures()[0].formula;
        let found = Machine::Reference
            .run(formula, What::Value, &point)
            .unwrap()[0][0];
        assert!(
            (found - exact).abs() < 1e-12,
            "{text}: {found}, not {exact}"
        );
    }
}

/// The function of an integral along a ray in every shading language.
#[test]
fn integrals_are_emitted() {
    let densities = [
        "0.5 + 0.5 sin(16 y - 8 time)",
        "if 0 < y + 1 and y + 1 < 2 then (y + 1)^2 else 0",
        "x^2 exp(-y) + max(0, 1 - |x|) + 1/(x^2 + y^2 + z^2 + 0.1)^2",
        "exp(-x^2 - y^2) z + sqrt(x^2 + z^2) + sum(k in 1..3, sin(k x)/k)",
        "exp(-x^3)",
    ];
    for density in densities {
        let program = compile(&format!("f(x, y, z) = {density}")).program.unwrap();
        for target in [
            Target::Wgsl,
            Target::Glsl,
            Target::Hlsl,
            Target::Msl,
            Target::Spirv,
        ] {
            let made = program.emit(0, EmitWhat::Integral, target, Precision::Accurate);
            let made = made.unwrap_or_else(|e| panic!("{density}: {e:?}"));
            if target == Target::Wgsl {
                let text = String::from_utf8(made).unwrap();
                assert!(
                    text.contains("fn f_integral(o: vec3<f32>, d: vec3<f32>, a: f32, b: f32"),
                    "{text}"
                );
            }
        }
    }
}

/// What has no closed form is named, and whether that is proven.
#[test]
fn refusals_name_the_part() {
    for (density, part, is_proven) in [
        ("x + exp(-x^3)", "exp(-x^3)", true),
        ("y sin(x y)", "sin(x y)", true),
        ("z + tan(x)", "tan(x)", false),
        ("exp(x)/(y + 4)", "exp(x)/(y + 4)", true),
        ("sqrt(x^3 + y + 20)", "sqrt(x^3 + y + 20)", true),
        ("(1 + x^2)^0.3", "(1 + x^2)^0.3", false),
        ("floor(x) + y", "floor(x)", false),
        ("max(sin(x), 0) + y", "sin(x)", false),
    ] {
        let text = format!("f(x, y, z) = {density}");
        let of = compile(&text).program.unwrap().pictures()[0]
            .formula
            .clone();
        let problem = field_integral(&of, Otherwise::Refuse).unwrap_err();
        assert_eq!(
            (problem.span.text(&text), problem.reason.is_proven()),
            (part, is_proven),
            "{problem:?}"
        );
        let made = field_integral(&of, Otherwise::Quadrature).unwrap();
        assert_eq!(made.integral.numerical.len(), 1, "{density}");
    }
}

/// Bounds are errors that say so, and come soon.
#[test]
fn bounds_are_errors() {
    for (density, what) in [
        ("product(k in 1..9, sin(k x))*exp(tan(y))", "none"),
        (
            "(sin(x) + sin(2 x) + sin(3 x) + cos(y) + cos(2 y) + cos(3 z))^9",
            "at most",
        ),
        (
            "sin(x) sin(2 x) sin(3 x) sin(4 x) sin(5 x) sin(6 x) sin(7 x) sin(8 x) sin(9 y) sin(10 y) sin(11 z) sin(12 z)",
            "at most",
        ),
        ("x^17 exp(y)", "at most"),
        ("sin(x)^40", "at most"),
        ("(x^30 + y) (y^40 + z)", "at most"),
    ] {
        let of = formula(density);
        let started = std::time::Instant::now();
        let problem = field_integral(&of, Otherwise::Refuse).unwrap_err();
        assert!(started.elapsed().as_secs() < 20, "{density}");
        assert!(
            problem.reason.in_words().contains(what) || what == "none",
            "{density}: {problem:?}"
        );
    }
}

/// Rays at the edges of what binary32 holds: where the integral is finite in f64 it is no NaN or infinity in binary32, as
/// long as f itself is a finite number in binary32 at both ends and in the middle.
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
