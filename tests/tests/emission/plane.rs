//! What scenes of the plane carry.

use pullback_compiler::lower::Precision;

use crate::{function_names, program, size};

/// The bodies of `map_jet` for a formula of z.
fn jet_size(text: &str) -> usize {
    let program = program(text, text);
    let scene = program
        .scene_module(0, Precision::Accurate)
        .expect("a scene");
    size(&scene.module, "map_jet")
}

/// What each scene of the plane needs of formula and library, and some of what others need.
#[test]
fn a_scene_carries_only_what_it_uses() {
    let check = |text: &str, needed: &[&str], foreign: &[&str]| {
        let program = program(text, text);
        let scene = program
            .scene_module(0, Precision::Accurate)
            .expect("a scene");
        let names = function_names(&scene.module);
        let has = |name: &str| names.iter().any(|n| n == name);
        for name in needed {
            assert!(has(name), "{text}: no `{name}` in {names:?}");
        }
        for name in foreign {
            assert!(!has(name), "{text}: `{name}` in {names:?}");
        }
        let stubs = [
            "field",
            "field_grad",
            "field_jet2",
            "map",
            "map_jet",
            "chart_jet",
            "chart_jet_inverse",
        ];
        for stub in stubs {
            assert_eq!(has(stub), needed.contains(&stub), "{text}: `{stub}`");
        }
    };
    let real = "x³ - y";
    let complex = "z³ + 1";
    let no_waves = [
        "real_sin",
        "real_cos",
        "complex_exp",
        "complex_log",
        "complex_gamma",
    ];
    let foreign = |more: &[&'static str]| [more, &no_waves].concat();
    check(
        &format!("show logcontours({real})"),
        &["field_grad", "octave_lines", "log2_parts"],
        &foreign(&["normal_cdf", "polar_from_jet", "hsv_wheel"]),
    );
    check(
        &format!("show bands({real})"),
        &["field_grad", "normal_cdf"],
        &foreign(&["octave_lines", "log2_parts", "polar_from_jet", "hsv_wheel"]),
    );
    check(
        &format!("show implicit({real})"),
        &["field_jet2", "line_coverage"],
        &foreign(&["octave_lines", "diverging_ramp", "key_at", "normal_cdf"]),
    );
    check(
        &format!("f(z) = {complex}\nshow checker(f)"),
        &["map_jet", "square_train", "part_rates"],
        &foreign(&[
            "octave_lines",
            "blend_extremes",
            "normal_cdf",
            "complex_divide",
        ]),
    );
    check(
        &format!("f(z) = {complex}\nshow grid(f)"),
        &["map_jet", "octave_lines", "blend_extremes"],
        &foreign(&["normal_cdf", "saw_train", "wrap_diffuse", "diverging_ramp"]),
    );
    check(
        &format!("f(z) = {complex}\nshow sphere(f)"),
        &[
            "chart_jet",
            "chart_jet_inverse",
            "domain_colour",
            "wrap_diffuse",
        ],
        &foreign(&["octave_lines", "normal_cdf", "orbit_ray", "diverging_ramp"]),
    );
}

#[test]
fn a_holomorphic_function_has_no_wirtinger_pair() {
    let jet = |text: &str| {
        let program = program(text, text);
        let scene = program
            .scene_module(0, Precision::Accurate)
            .expect("a scene");
        let (_, function) = scene
            .module
            .functions
            .iter()
            .find(|(_, f)| f.name.as_deref() == Some("map_jet"))
            .expect("a jet");
        // the last component of what is returned is a zero that nothing computes
        let naga::Statement::Return { value: Some(value) } = function.body.last().expect("a body")
        else {
            panic!("no value is returned");
        };
        let naga::Expression::Compose { ref components, .. } = function.expressions[*value] else {
            panic!("no structure is returned");
        };
        matches!(
            function.expressions[components[2]],
            naga::Expression::ZeroValue(_)
        )
    };
    for text in [
        "f(z) = z^3 - 1",
        "f(z) = exp(sin(z))/z",
        "f(z) = log(z) + gamma(z)",
        "f(z) = 2",
    ] {
        assert!(jet(text), "{text} carries ∂f/∂z̄");
    }
    for text in ["f(z) = conj(z)", "f(z) = abs(z) z", "f(z) = z + re(z)"] {
        assert!(!jet(text), "{text} lacks ∂f/∂z̄");
    }
    assert!(jet_size("f(z) = z^3") < jet_size("f(z) = conj(z)^3 + z^3"));
}
