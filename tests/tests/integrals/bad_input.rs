//! Integrals that have no value, integrands that have none, and what is refused: each names its part.

use std::time::Instant;

use pullback_compiler::integrate::{Otherwise, Reason, field_integral};
use pullback_compiler::{What, compile};
use pullback_tests::accuracy::evaluators::Machine;

use super::{Ray, densities, formula, points};

fn along(text: &str, ray: [f64; 8]) -> f64 {
    let of = formula(text);
    let made = field_integral(&of, Otherwise::Quadrature).unwrap();
    let integral = made.into_formula(&of);
    let at = points(std::iter::once(ray.to_vec()));
    Machine::Reference.run(&integral, What::Value, &at).unwrap()[0][0]
}

/// From -1 to 1 along x, through the origin.
const THROUGH: [f64; 8] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 1.0];

/// What is singular on the ray is what mathematics says: infinite where the integrand has one sign and no integral, a
/// number where it has one, NaN where infinities of both signs meet.
#[test]
fn singular_densities() {
    let finite = [
        ("log(length((x, y, z)))", -2.0),
        ("log(x^2 + y^2)", -4.0),
        ("x^2/(x^2 + y^2 + z^2)^(1/2)", 1.0),
        ("length((x, y, z))", 1.0),
        ("abs(x)^1.5", 0.8),
        ("x^2/(x^2 + y^2 + z^2)", 2.0),
    ];
    for (text, exact) in finite {
        let value = along(text, THROUGH);
        assert!((value - exact).abs() < 1e-9, "{text}: {value}, not {exact}");
    }
    for text in [
        "1/(x^2 + y^2 + z^2)",
        "1/(x^2 + y^2)^2",
        "1/length((x, y, z))",
        "1/length((x, y, z))^3",
        "1/x^2",
        "x^-4",
    ] {
        let value = along(text, THROUGH);
        assert_eq!(value, f64::INFINITY, "{text}");
        let back = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, -1.0];
        assert_eq!(along(text, back), f64::NEG_INFINITY, "{text} from 1 to -1");
    }
    for text in ["1/x", "x^-3", "sqrt(x)", "log(x)", "x^0.5", "1/(x - 0.5)"] {
        let value = along(text, THROUGH);
        assert!(value.is_nan(), "{text}: {value}");
    }
    // an end at the singular place
    let from = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    for (text, exact) in [("sqrt(x)", 2.0 / 3.0), ("x^-0.5", 2.0), ("log(x)", -1.0)] {
        let value = along(text, from);
        assert!((value - exact).abs() < 1e-9, "{text}: {value}, not {exact}");
    }
}

/// The integral from b to a is that from a to b with the sign turned, to the last rounding but few.
#[test]
fn turned_ends_turn_the_sign() {
    let mut wrong = String::new();
    for class in ["waves", "pieces", "algebraic", "bells", "products"] {
        for density in densities(class) {
            let of = formula(&density.text);
            let made = field_integral(&of, Otherwise::Quadrature).unwrap();
            let integral = made.into_formula(&of);
            let turned = |ray: &Ray| {
                let mut args = ray.args.clone();
                args.swap(6, 7);
                args
            };
            let [there, back] = [
                points(density.rays.iter().map(|r| r.args.clone())),
                points(density.rays.iter().map(turned)),
            ]
            .map(|at| Machine::Reference.run(&integral, What::Value, &at).unwrap());
            for ((there, back), ray) in there.iter().zip(&back).zip(&density.rays) {
                let error = (there[0] + back[0]).abs() / ray.size.max(1e-30);
                if error.is_nan() || error > 1e-10 {
                    wrong += &format!(
                        "{} {:?}: {} {}\n",
                        density.text, ray.args, there[0], back[0]
                    );
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// Every refusal stands at the part that it is about, and says why.
#[test]
fn every_refusal_names_its_part() {
    for (density, part, why) in [
        ("z + tan(x) y", "tan(x)", "rules"),
        ("exp(-x^4)/2 + 1", "exp(-x^4)", "Liouville"),
        ("3 + sin(x y) + y", "sin(x y)", "Fresnel"),
        ("cos(exp(x))", "cos(exp(x))", "Liouville"),
        ("exp(sin(x)) + x", "exp(sin(x))", "Liouville"),
        (
            "y + exp(-length((x, y, z)))",
            "exp(-length((x, y, z)))",
            "Liouville",
        ),
        ("1 + sqrt(1 + x^4)", "sqrt(1 + x^4)", "elliptic"),
        ("z + sqrt(1 + x^6)", "sqrt(1 + x^6)", "hyperelliptic"),
        ("exp(x)/(y + 9)", "exp(x)/(y + 9)", "exponential"),
        ("log(y + 9) sin(x)", "log(y + 9) sin(x)", "integral"),
        ("sin(x)/(x^2 + 1)", "sin(x)/(x^2 + 1)", "integral"),
        (
            "exp(-x)/(x^2 + y^2 + 1)",
            "exp(-x)/(x^2 + y^2 + 1)",
            "integral",
        ),
        ("(2 + x^2 + y^2)^0.3", "(2 + x^2 + y^2)^0.3", "1/2"),
        ("floor(3 x) + z", "floor(3 x)", "jumps"),
        ("fract(y)^2 + z", "fract(y)", "jumps"),
        ("max(sin(x), 0) + y", "sin(x)", "order"),
        ("abs(x^3 + y)", "x^3 + y", "order"),
        ("noise((x, y, z))", "noise((x, y, z))", ""),
        ("gamma(x + 9) + 1", "gamma(x + 9)", "rules"),
        ("x^17 exp(y)", "x^17 exp(y)", "at most 16"),
        ("x^61 + 1", "x^61", "at most"),
        ("iterate(5, v = x, v^2 - 1)", "", ""),
        ("re(exp(i x)) + 1", "", ""),
    ] {
        let text = format!("f(x, y, z) = {density}");
        let answer = compile(&text);
        let program = answer
            .program
            .unwrap_or_else(|| panic!("{text}: {:?}", answer.diagnostics));
        let of = program.pictures()[0].formula.clone();
        let Err(problem) = field_integral(&of, Otherwise::Refuse) else {
            panic!("{text} is integrated");
        };
        let place = problem.span.text(&text);
        let words = problem.reason.in_words();
        println!("{density}: `{place}`: {words}");
        assert!(!words.is_empty());
        if !part.is_empty() {
            assert_eq!(place, part, "{text}: {problem:?}");
            assert!(words.contains(why), "{text}: {words}");
        }
        assert!(!place.is_empty(), "{text}: {problem:?}");
    }
}

/// Thousands of terms are refused soon, or integrated.
#[test]
fn thousands_of_terms() {
    let many = |n: usize, term: &dyn Fn(usize) -> String| {
        (1..=n).map(term).collect::<Vec<_>>().join(" + ")
    };
    for (text, is_refused) in [
        (many(3000, &|k| format!("sin({k} x + y)")), true),
        (many(200, &|k| format!("sin({k} x + y)")), false),
        (many(3000, &|k| format!("{k} x^{}", k % 20 + 1)), false),
        ("sum(k in 1..5000, sin(k x)/k)".to_owned(), false),
        ("product(k in 1..40, 1 + sin(k x))".to_owned(), true),
        (
            format!("({})^8", many(12, &|k| format!("cos({k} x)"))),
            true,
        ),
        (many(40, &|k| format!("abs(x - {k}/7)")), false),
        (many(3000, &|k| format!("abs(x - {k}/7)")), true),
        (
            format!("max({}, 3)", many(20, &|k| format!("abs(x - {k}/7)"))),
            true,
        ),
    ] {
        let shown: String = text.chars().take(60).collect();
        let of = formula(&text);
        let started = Instant::now();
        let made = field_integral(&of, Otherwise::Refuse);
        let seconds = started.elapsed().as_secs_f64();
        assert!(seconds < 20.0, "{shown}: {seconds} s");
        match made {
            Ok(_) => assert!(!is_refused, "{shown}"),
            Err(problem) => {
                assert!(is_refused, "{shown}: {problem:?}");
                let is_known = matches!(problem.reason, Reason::Bound(..) | Reason::Loop);
                assert!(is_known, "{shown}: {problem:?}");
            }
        }
    }
}

/// What is no function of space is refused in words.
#[test]
fn no_density() {
    for text in ["f(z: complex) = z^2", "f(x, y) = (x, y)"] {
        let answer = compile(text);
        let Some(program) = answer.program else {
            continue;
        };
        let of = program.pictures()[0].formula.clone();
        let problem = field_integral(&of, Otherwise::Refuse).unwrap_err();
        assert_eq!(problem.reason, Reason::NoField, "{text}");
    }
}
