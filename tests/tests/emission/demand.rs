//! Of a formula and the libraries a module has only what its template asks for.

use naga::Module;
use naga::valid::Capabilities;
use pullback_compiler::lower::Precision;
use pullback_compiler::module::SceneModule;

use crate::{function_names, program, size, validate};

/// A template with these stubs, whose picture calls them.
fn template(space: &str, stubs: &str, picture: &str) -> Module {
    let text = format!(
        "struct View {{ center: vec2f, size: vec2f, tile: vec2f, pixel: f32, time: f32, samples: u32, zero: u32, tile_size: vec2u }}
         @group(0) @binding(0) var<uniform> view: View;
         @group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
         {stubs}
         fn shade(pixel: vec2f) -> vec4f {{ let p = vec{space}f(pixel.x); return vec4f({picture}); }}"
    );
    naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)))
}

/// A formula's module in a template, without what nothing uses.
fn spliced(template: &Module, text: &str) -> Module {
    let program = program(text, text);
    let mut module = SceneModule::splice(
        template,
        &program.pictures()[0].formula,
        Precision::Accurate.into(),
    )
    .unwrap_or_else(|error| panic!("{text}: {error:?}"));
    naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
    validate(text, &module, Capabilities::default());
    module
}

const VALUE: &str = "fn field(p: vec2f) -> f32 { return 0.0; }";
const GRADIENT: &str = "fn field_grad(p: vec2f) -> vec3f { return vec3f(); }";

#[test]
fn a_template_without_a_gradient_gets_no_tangents() {
    let text = "f(x, y) = gamma(x) exp(y)";
    let value = spliced(&template("2", VALUE, "field(p)"), text);
    let names = function_names(&value);
    assert!(!names.iter().any(|n| n == "field_grad"), "{names:?}");
    // the derivative of the gamma function needs the digamma function, the value does not
    assert!(!names.iter().any(|n| n.contains("digamma")), "{names:?}");
    let both = spliced(&template("2", GRADIENT, "field_grad(p), 1.0"), text);
    let all = function_names(&both);
    assert!(all.iter().any(|n| n.contains("digamma")), "{all:?}");
    assert!(size(&value, "field") < size(&both, "field_grad"));
    // a stub that is declared and not called is not compiled either
    let unused = spliced(
        &template("2", &format!("{VALUE}\n{GRADIENT}"), "field(p)"),
        text,
    );
    assert_eq!(function_names(&unused), names);
}

#[test]
fn one_tangent_along_a_ray_not_three() {
    let ray = "fn field_ray(o: vec3f, d: vec3f, t: f32) -> vec2f { return vec2f(); }";
    let gradient = "fn field_grad(p: vec3f) -> vec4f { return vec4f(); }";
    let text = "f(x, y, z) = sin(x y) + sin(y z) + sin(z x) + x^5 y^3 z";
    let ray = spliced(&template("3", ray, "field_ray(p, p, 1.0), 0.0, 1.0"), text);
    let gradient = spliced(&template("3", gradient, "field_grad(p)"), text);
    assert!(!function_names(&ray).iter().any(|n| n == "field_grad"));
    assert!(!function_names(&gradient).iter().any(|n| n == "field_ray"));
}

#[test]
fn a_formula_carries_only_the_functions_that_it_uses() {
    let scene = |text: &str| {
        let program = program(text, text);
        let scene = program
            .scene_module(0, Precision::Accurate)
            .expect("a scene");
        function_names(&scene.module)
    };
    let has = |text: &str, word: &str| scene(text).iter().any(|n| n.contains(word));
    assert!(!has("f(x, y) = sin(x) y", "gamma"));
    assert!(has("f(x, y) = gamma(x) y", "gamma"));
    assert!(!has("f(x, y) = x² + y²", "sin"));
    assert!(!has("f(z) = z² + 1", "complex_log"));
    assert!(has("f(z) = log(z)", "log"));
    assert!(!has("f(x, y, z) = x² + y² - z", "exp"));
    // nothing of another scene
    assert!(!has("f(x, y) = x y", "refine_crossing"));
    assert!(!has("f(z) = z", "field"));
}

#[test]
fn scenes_of_space_carry_nothing_of_one_another() {
    for (scene, present, absent) in [
        (
            "slices",
            &["field_grad", "contour_colour"][..],
            &["field_ray", "walk_on", "matter_of"][..],
        ),
        (
            "nested",
            &["field", "field_ray", "field_grad", "walk_on"],
            &["contour_colour", "kept_part", "matter_of"],
        ),
        (
            "cutaway",
            &["field", "field_ray", "contour_colour", "kept_part"],
            &["matter_of"],
        ),
        (
            "volume",
            &["field_grad", "matter_of"],
            &["field_ray", "contour_opacity", "walk_on", "kept_part"],
        ),
        (
            "volumecut",
            &["field_grad", "matter_of", "contour_opacity"],
            &["field_ray", "walk_on", "mean_value_colour"],
        ),
        (
            "scatter",
            &["field", "stretch_at"],
            &["field_grad", "field_ray", "matter_of", "walk_on"],
        ),
        (
            "glow",
            &["field_grad", "mean_glow"],
            &["field_ray", "walk_on", "matter_of", "screen_rate"],
        ),
        (
            "additive",
            &["field_integral", "mesh_next"],
            &["field", "field_grad", "field_ray", "walk_on", "matter_of"],
        ),
    ] {
        let text = format!("f(x, y, z) = x y + z\nshow {scene}(f)");
        let program = program(&text, &text);
        let module = program
            .scene_module(0, Precision::Accurate)
            .expect("a scene")
            .module;
        let names = function_names(&module);
        for name in present {
            assert!(names.iter().any(|n| n == name), "{scene} lacks {name}");
        }
        let alone = ["field", "search_step"];
        let others = alone.iter().filter(|name| !present.contains(name));
        for name in absent.iter().chain(others) {
            assert!(!names.iter().any(|n| n == name), "{scene} carries {name}");
        }
    }
}
