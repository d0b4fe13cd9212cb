//! Integrals as the language and the compiler give them: values, shader text, refusals, bounds.

use pullback_compiler::integrate::{Otherwise, field_integral};
use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Target, What, compile};
use pullback_tests::accuracy::evaluators::{Machine, Point};

use super::formula;

/// Integrals that stand in formulas, at x = 2, y = 1; by mpmath's quad.
pub const OF_THE_LANGUAGE: [(&str, f64); 11] = [
    (
        "integral(exp(-t) sin(2 t)^2, t, 0, x)",
        0.386_589_075_958_063,
    ),
    (
        "integral(max(0, 1 - |t - y|)^2 exp(-t^2), t, -1, x)",
        0.264_626_483_727_039,
    ),
    ("quadrature(t + sin(t^2), t, 0, x)", 2.804_776_489_343_756),
    ("integral(sqrt(1 + t^2), t, x, -y)", -4.105_679_289_785_514),
    (
        "integral((cos(t), t^3), t, 0, x).x",
        0.909_297_426_825_681_7,
    ),
    ("integral((cos(t), t^3), t, 0, x).y", 4.0),
    (
        "integral(integral(t u + t^2, t, 0, u), u, 0, x)",
        10.0 / 3.0,
    ),
    ("integral(t in 0..x, exp(-t^2))", 0.882_081_390_762_421_7),
    (
        "integral(sum(k in 1..5, sin(k t)/k), t, 0, x)",
        1.979_139_878_744_656_8,
    ),
    ("integral(g(t), t, 0, x)\ng(t) = t^2", 8.0 / 3.0),
    (
        "diff(integral(exp(-t^2), t, 0, x), x)",
        0.018_315_638_888_734_18,
    ),
];

#[test]
fn integrals_of_the_language() {
    for (text, exact) in OF_THE_LANGUAGE {
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
                    text.contains("fn f_integral(o: vec3f, d: vec3f, a: f32, b: f32"),
                    "{text}"
                );
            }
        }
    }
}

/// Transmittance and opacity along a ray in every shading language.
#[test]
fn transmittance_and_opacity_are_emitted() {
    let program = compile("f(x, y, z) = exp(-2 y) + 1/(x^2 + z^2 + 1)")
        .program
        .unwrap();
    for (what, name) in [
        (EmitWhat::Transmittance, "f_transmittance"),
        (EmitWhat::Opacity, "f_opacity"),
    ] {
        for target in [
            Target::Wgsl,
            Target::Glsl,
            Target::Hlsl,
            Target::Msl,
            Target::Spirv,
        ] {
            let made = program.emit(0, what, target, Precision::Accurate);
            let made = made.unwrap_or_else(|e| panic!("{name}: {e:?}"));
            if target == Target::Wgsl {
                let text = String::from_utf8(made).unwrap();
                let signature = format!("fn {name}(o: vec3f, d: vec3f, a: f32, b: f32");
                assert!(text.contains(&signature), "{text}");
                // the opacity is the negative of an expm1
                let own = text.rsplit("fn f_").next().unwrap_or("");
                let negative = own.contains("return -");
                assert_eq!(negative, what == EmitWhat::Opacity, "{text}");
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
