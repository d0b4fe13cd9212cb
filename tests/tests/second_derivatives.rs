//! Second derivatives of every operation, against tables of references, in `f64` and on the GPU.

use pullback_compiler::What;
use pullback_compiler::derive::{ComplexVariable, forward, jet};
use pullback_compiler::formula::Formula;
use pullback_compiler::ir::{Graph, Id, Prim, Ty};
use pullback_compiler::lower::Precision;
use pullback_compiler::table::{Derivative, Metric, Typing, rows};
use pullback_compiler::types::Type;
use pullback_tests::accuracy::evaluators::{Machine, Point, is_reference_adapter, suite_gpu};
use pullback_tests::accuracy::second::{declared, directional, hessian, measure, seconds};
use pullback_tests::accuracy::subjects::formula;

/// Runs every operation, prints what was measured, and fails with every violation.
fn check(machine: &Machine, tight: bool) {
    let mut found = Vec::new();
    for second in &seconds() {
        let name = format!("{} ({:?})", second.word, second.way);
        let errors = match measure(second, machine) {
            Ok(errors) => errors,
            Err(reason) => {
                found.push(format!("{name}: {reason}"));
                continue;
            }
        };
        let [component, norm, unit] = errors.each_ref().map(|e| e.max());
        println!("{name}: {component:.2} {norm:.2} norm {unit:.2} unit");
        let bound = match declared(second, machine) {
            Ok(bound) => bound,
            Err(reason) => {
                found.push(format!("{name}: {reason}: {}", errors[0].worst));
                found.extend(errors[0].wrong.iter().map(|w| format!("wrong class: {w}")));
                continue;
            }
        };
        let place = Metric::ALL.iter().position(|m| *m == bound.metric);
        let errors = &errors[place.unwrap_or(0)];
        found.extend(
            errors
                .wrong
                .iter()
                .map(|w| format!("{name}: wrong class: {w}")),
        );
        if errors.max() > bound.units {
            let (max, worst) = (errors.max(), &errors.worst);
            found.push(format!(
                "{name}: {max:.2} ulp, not {}: {worst}",
                bound.units
            ));
        }
        if tight && bound.units > 2.0 * errors.max() + 1.0 {
            let (max, bound) = (errors.max(), bound.units);
            found.push(format!(
                "{name}: the bound {bound} is far above {max:.2} ulp"
            ));
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
fn second_derivatives_of_the_reference_keep_their_bounds() {
    check(&Machine::Reference, true);
}

#[test]
fn second_derivatives_on_the_gpu_keep_their_bounds() {
    let Some(gpu) = suite_gpu() else { return };
    let tight = is_reference_adapter(&gpu);
    check(&Machine::Gpu(Box::new(gpu), Precision::Accurate), tight);
}

/// Every operation that is not locally constant or linear has references of its second derivatives.
#[test]
fn every_operation_has_references() {
    let seconds = seconds();
    let mut bare = Vec::new();
    for row in rows().iter().filter(|r| r.is_written()) {
        let linear = matches!(
            row.typing,
            Typing::MakeComplex
                | Typing::Order
                | Typing::Equality
                | Typing::Logic(_)
                | Typing::Select
        );
        let flat = matches!(row.derivative, Derivative::Zero);
        // judged by value and first derivative, in the suite `special`
        let defined = (row.is_defined(true) || row.is_defined(false)) && row.real.is_none();
        let own = seconds.iter().filter(|s| s.prim == row.prim);
        let cases: usize = own.map(|s| s.cases.len()).sum();
        if !linear && !flat && !defined && !LINEAR.contains(&row.mnemonic) && cases < 10 {
            bare.push(row.usage);
        }
    }
    assert!(bare.is_empty(), "no references for {bare:?}");
}

/// Operations whose derivative is their own form again.
const LINEAR: [&str; 6] = ["neg", "re", "im", "conj", "fract", "mod"];

const FORMULAS: &str = include_str!("../data/functions/second_formulas.txt");

/// What the largest factor of [`random_formulas`] may be: scale counts each operation once.
const LIMIT: f64 = 12.0;

/// Largest |computed - reference| over unit · scale of random formulas: each second partial derivative in both orders,
/// or f″ by the jet of the jet and the Laplacians of |f|, log |f| and re f.
fn random_formulas(machine: &Machine, unit: f64) -> f64 {
    let mut worst = 0.0_f64;
    let lines: Vec<&str> = FORMULAS.lines().filter(|l| !l.starts_with('#')).collect();
    let blocks = lines.chunk_by(|_, next| !next.starts_with("f("));
    let mut count = 0;
    for block in blocks {
        let (source, rows) = block.split_first().expect("a formula");
        let rows: Vec<Vec<f64>> = rows
            .iter()
            .map(|row| row.split('\t').map(|c| c.parse().expect(c)).collect())
            .collect();
        let points: Vec<Point> = rows
            .iter()
            .map(|row| Point {
                args: row[..2].to_vec(),
                params: Vec::new(),
            })
            .collect();
        for (formula, column) in asked(source) {
            let found = machine.run(&formula, What::Value, &points).expect(source);
            for (row, found) in rows.iter().zip(found) {
                let scale = row[row.len() - 1];
                for (k, got) in found.iter().enumerate() {
                    let wanted = column.map_or(0.0, |c| row[c + k]);
                    let factor = (got - wanted).abs() / (unit * scale);
                    assert!(
                        factor.is_finite(),
                        "{source} at {:?}: {got} for {wanted}",
                        &row[..2]
                    );
                    if factor > worst {
                        worst = factor;
                        println!(
                            "{source} at {:?}: {got} for {wanted}, {factor:.1}",
                            &row[..2]
                        );
                    }
                }
            }
        }
        count += 1;
    }
    assert_eq!(count, 84);
    worst
}

/// Formulas for what a block's columns hold, and the first column of each; `None` where it is 0.
fn asked(source: &str) -> Vec<(Formula, Option<usize>)> {
    let plain = formula(source);
    let mut g = plain.graph.clone();
    let value = plain.value[0];
    let build = |g: &Graph, root: Id, complex: bool, plain: &Formula| Formula {
        graph: g.clone(),
        value: [root].into_iter().collect(),
        ty: if complex { Type::Complex } else { Type::Real },
        ..plain.clone()
    };
    if plain.inputs.len() == 2 {
        let [x, y] = [0, 1].map(|k| Formula::leaf(&mut g, k, Ty::Real));
        let [fx, fy] = [x, y].map(|leaf| directional(&mut g, value, leaf));
        let pairs = [(fx, x, 2), (fx, y, 3), (fy, x, 3), (fy, y, 4)];
        return pairs
            .into_iter()
            .map(|(slope, leaf, column)| {
                let root = directional(&mut g, slope, leaf);
                (build(&g, root, false, &plain), Some(column))
            })
            .collect();
    }
    let z = ComplexVariable::Whole(Formula::leaf(&mut g, 0, Ty::Complex));
    let first = jet(&mut g, value, z).expect("a rule").dz;
    let second = jet(&mut g, first, z).expect("a rule");
    assert!(second.dzbar.is_none(), "{source}");
    let mut out = vec![(build(&g, second.dz, true, &plain), Some(2))];
    let body = source.split_once("= ").expect("a body").1;
    for (head, column) in [("abs", Some(4)), ("re", None)] {
        let source = format!(
            "f(x, y) = {head}(w) where w = {}\n",
            body.replace('z', "(x + i y)")
        );
        let real = formula(&source);
        let mut g = real.graph.clone();
        let second = hessian(&mut g, real.value[0], 2);
        let laplacian = g.add(second[0], second[2]);
        out.push((build(&g, laplacian, false, &real), column));
    }
    out
}

#[test]
fn hessians_of_random_formulas_on_the_reference() {
    let worst = random_formulas(&Machine::Reference, f64::EPSILON / 2.0);
    println!("largest factor in f64: {worst:.2}");
    assert!(worst <= LIMIT, "{worst}");
}

#[test]
fn hessians_of_random_formulas_on_the_gpu() {
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    let worst = random_formulas(&machine, f64::from(f32::EPSILON) / 2.0);
    println!("largest factor on the GPU: {worst:.2}");
    assert!(worst <= LIMIT, "{worst}");
}

/// Second derivatives by x at kinks and at the ends of pieces: those of the arm that is taken, 0 at sign changes of |x|.
#[test]
fn kinks_follow_the_documented_convention() {
    let cases = [
        ("|x|", 0.0, 0.0),
        ("x |x|", 0.0, 0.0),
        ("x |x|", -1e-30, -2.0),
        ("x^2 |x|", 0.0, 0.0),
        ("sign(x) x^2", 0.0, 0.0),
        ("sqrt(x^2)", 2.0, 0.0),
        ("min(x^2, x^3)", 1.0, 2.0),
        ("max(x^3, x^2)", 1.0, 6.0),
        ("clamp(x, 0, 1)^2", 0.0, 2.0),
        ("clamp(x, 0, 1)^2", 1.0, 2.0),
        ("clamp(x, 0, 1)^2", 1.5, 0.0),
        ("smoothstep(0, 1, x)", 0.0, 6.0),
        ("smoothstep(0, 1, x)", 1.0, -6.0),
        ("smoothstep(0, 1, x)", -0.5, 0.0),
        ("smoothstep(0, 2, x)", 0.5, 0.75),
        ("if x < 0 then x^3 else x^2", 0.0, 2.0),
        ("{ x < 0: sqrt(x), x >= 0: x^2 }", 0.0, 2.0),
        ("if x > 0 then x log(x) else x^2", 0.0, 2.0),
        ("{ x > 0: sin(x)/x, x == 0: 1, x < 0: x }", 0.0, 0.0),
        ("hypot(x, 0)", 0.0, 0.0),
        ("x^1", 0.0, 0.0),
        ("x^2", 0.0, 2.0),
        ("x^3", 0.0, 0.0),
        ("pow(x, 2 + 0 x)", 0.0, 2.0),
        ("sinc(x)", 0.0, -1.0 / 3.0),
        ("expm1(x)", 0.0, 1.0),
        ("sqrt(x)", 0.0, f64::NEG_INFINITY),
        ("cbrt(x)", 0.0, f64::NEG_INFINITY),
        ("cbrt(x)", -0.0, f64::INFINITY),
        ("asin(x)", 1.0, f64::INFINITY),
        ("acosh(x)", 1.0, f64::NEG_INFINITY),
        ("tanh(x)", 1000.0, 0.0),
        ("sech(x)", -1000.0, 0.0),
        ("csch(x)", 1000.0, 0.0),
    ];
    for (body, at, wanted) in cases {
        let plain = formula(&format!("f(x: real) = {body}\n"));
        let mut g = plain.graph.clone();
        let root = hessian(&mut g, plain.value[0], 1)[0];
        let second = Formula {
            graph: g,
            value: [root].into_iter().collect(),
            ..plain
        };
        let point = Point {
            args: vec![at],
            params: Vec::new(),
        };
        let got = Machine::Reference
            .run(&second, What::Value, &[point])
            .expect(body)[0][0];
        assert!(
            got == wanted || (got - wanted).abs() < 1e-15,
            "{body} at {at}: {got} for {wanted}"
        );
    }
}

/// The derivatives of the gamma family end with an error, not with a wrong number.
#[test]
fn the_last_polygamma_has_no_derivative() {
    let plain = formula("f(x: real) = trigamma(x)\n");
    let mut g = plain.graph.clone();
    let x = Formula::leaf(&mut g, 0, Ty::Real);
    let one = g.real(1.0);
    let mut value = plain.value[0];
    for _ in 0..4 {
        value = forward(&mut g, &[value], &[(x, one)]).expect("a rule")[0].expect("a slope");
    }
    let missing = forward(&mut g, &[value], &[(x, one)]);
    assert_eq!(missing.expect_err("no rule").prim, Prim::Polygamma(5));
}
