//! Where light comes from, how strong it is, and what colours it.

use pullback_compiler::lower::Precision;
use pullback_runtime::executor::{Arithmetic, Event, Painter, Shown, SiteKind, Watched};
use pullback_runtime::{Frame, Pipeline, Size, View};

use crate::camera::{Vec3, dot};
use crate::drawing::{device, draw_linear};

/// The direction of the light of a picture, in exact float32.
fn light(settings: &str) -> Vec3 {
    let source = format!("show surface(x^2 + y^2 + z^2 - 3) {{ {settings} }}");
    let program = pullback_compiler::compile(&source)
        .program
        .expect("a program");
    let scene = program
        .scene_module(0, Precision::Accurate)
        .expect("a scene");
    let settings = &program.pictures()[0].settings;
    let frame = Frame {
        view: View {
            center: [0.0; 2],
            height: 2.0,
        },
        params: &[],
        settings: &scene.pack_settings(settings),
        size: Size {
            width: 8,
            height: 8,
        },
        samples: 1,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let painter =
        Painter::watched(&scene, Arithmetic::Ieee32, Watched::Everything).expect("a painter");
    let mut found = [f64::NAN; 3];
    let mut observer = |_: usize, event: &Event| {
        if event.site.function_name == "light_toward" && event.site.kind == SiteKind::Leave {
            for (slot, value) in found.iter_mut().zip(event.values) {
                if let Shown::Real(x) = value {
                    *slot = *x;
                }
            }
        }
    };
    painter
        .trace(&frame, settings, &[[4.0, 4.0]], &mut observer)
        .expect("colours");
    found
}

#[test]
fn light_comes_from_where_it_is_said_to() {
    let angles = "light_yaw = 35, light_pitch = 20";
    for (settings, yaw) in [
        ("yaw = 70", 105.0_f64),
        ("yaw = 70, light_from = world", 35.0),
        ("camera = look_at, eye = (0, 6, 2)", 125.0),
        (
            "camera = look_at, eye = (0, 6, 2), light_from = world",
            35.0,
        ),
        ("camera = look_at, eye = (0, 0, 9), up = (0, 1, 0)", 35.0),
    ] {
        let (yaw, pitch) = (yaw.to_radians(), 20_f64.to_radians());
        let wanted = [
            pitch.cos() * yaw.cos(),
            pitch.cos() * yaw.sin(),
            pitch.sin(),
        ];
        let found = light(&format!("{settings}, {angles}"));
        assert!(
            dot(found, wanted) > 1.0 - 1e-6,
            "{settings}: {found:?}, not {wanted:?}"
        );
    }
}

/// Light adds up: what sun and sky give alone is, together, what both give, and without either a surface is black.
#[test]
fn sun_and_sky_add_up() {
    let Some(gpu) = device() else { return };
    for scene in ["surface", "nested"] {
        let one = if scene == "nested" {
            "count = 1, lighting = 1, "
        } else {
            ""
        };
        let drawn = |strength: f64, ambient: f64| {
            let lamp = format!("light_strength = {strength}, ambient = {ambient}");
            let plain = "backdrop = transparent, wall_opacity = 0, edge_width = 0";
            let source = format!("show {scene}(x^2 + y^2 + z^2 - 2) {{ {one}{plain}, {lamp} }}");
            draw_linear(&gpu, &source, [40, 30], 1)
        };
        let [both, sun, sky, none] = [(0.4, 0.4), (0.4, 0.0), (0.0, 0.4), (0.0, 0.0)]
            .map(|(strength, ambient)| drawn(strength, ambient));
        let mut lit = 0;
        for k in 0..both.len() {
            for c in 0..3 {
                let off = (both[k][c] - sun[k][c] - sky[k][c]).abs();
                assert!(off < 2e-6, "{scene}: {off}");
                assert!(none[k][c].abs() < 1e-7, "{scene}: light from nowhere");
            }
            lit += usize::from(sun[k][0] > 0.05);
        }
        assert!(lit > 60, "{scene}: {lit} lit pixels");
    }
}

/// A function of the point colours a glow: a vector is the colour, a number a place between the three colours.
#[test]
fn a_function_colours_a_glow() {
    let Some(gpu) = device() else { return };
    let drawn = |ink: &str| {
        let own = if ink.is_empty() { "" } else { "color = ink, " };
        let source = format!(
            "f(x, y, z) = √(x^2 + y^2 + z^2) - 1\n{ink}\n\
             show glow(f) {{ {own}hot = (1, 0.5, 0), body = (0.2, 0.4, 0.6), halo = (0, 0, 0.9), background = 0, vignette = 0 }}"
        );
        draw_linear(&gpu, &source, [40, 30], 1)
    };
    let same = |a: &str, b: &str| {
        let (a, b) = (drawn(a), drawn(b));
        let off = |(x, y): (&[f64; 3], &[f64; 3])| {
            (0..3).map(|k| (x[k] - y[k]).abs()).fold(0.0, f64::max)
        };
        a.iter().zip(&b).map(off).fold(0.0, f64::max)
    };
    // smoothstep(0, 1/2, 1/4) and smoothstep(1/2, 1, 3/4) are 1/2
    for (place, colour) in [
        ("0", "(1, 0.5, 0)"),
        ("0.25", "(0.6, 0.45, 0.3)"),
        ("0.5", "(0.2, 0.4, 0.6)"),
        ("0.75", "(0.1, 0.2, 0.75)"),
        ("7", "(0, 0, 0.9)"),
    ] {
        let off = same(
            &format!("ink(p: vec3) = {place}"),
            &format!("ink(p: vec3) = {colour}"),
        );
        assert!(off < 1e-6, "{place}: {off}");
    }
    // where it is undefined the light has the colours by distance
    assert_eq!(same("ink(p: vec3) = √(-1 - |p|)", ""), 0.0);
    // it depends on the point: red on one side, blue on the other
    let halves = drawn("ink(x, y, z) = if z > 0 then (1, 0, 0) else (0, 0, 1)");
    let (above, below) = (halves[11 * 40 + 20], halves[19 * 40 + 20]);
    assert!(above[0] > 0.01 && above[0] > 2.0 * above[2], "{above:?}");
    assert!(below[2] > 0.01 && below[2] > 2.0 * below[0], "{below:?}");
}

/// Without such a function a module has none, and its formula is compiled once.
#[test]
fn a_glow_without_a_function_carries_none() {
    let built = |text: &str| {
        let program = pullback_compiler::compile(text).program.expect("a program");
        let module = program
            .scene_module(0, Precision::Accurate)
            .expect("a scene")
            .module;
        let found = module
            .functions
            .iter()
            .find(|(_, f)| f.name.as_deref() == Some("field_colour"));
        found.expect("the stub's function").1.expressions.len()
    };
    let ink = "ink(x, y, z) = 0.5 sin(3 x) + y z\n";
    assert_eq!(built(&format!("{ink}show glow(x + y + z)")), 1);
    assert!(built(&format!("{ink}show glow(x + y + z) {{ color = ink }}")) > 6);
}
