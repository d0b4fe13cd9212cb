//! Undefined, infinite and constant fields in every scene. What each scene makes of them is tested beside its other
//! colours (`scene_values`, `space`); here is what holds for all of them, and for `surface`.

use pullback_compiler::scene::{self, Space};
use pullback_runtime::{Gpu, Pipeline, Size};
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::stills::{Machine, Still};

const SIZE: Size = Size {
    width: 48,
    height: 36,
};

/// Linear rgb and alpha of every pixel.
fn draw(gpu: &Gpu, scene: &str, parameters: &str, formula: &str, settings: &str) -> Vec<[f32; 4]> {
    let source = format!("f({parameters}) = {formula}\nshow {scene}(f) {{ {settings} }}");
    let still = Still::new(&source, SIZE, 1);
    let machine = Machine::Adapter(gpu.clone());
    let bytes = still
        .draw(&machine, Pipeline::Linear)
        .unwrap_or_else(|error| panic!("{source}: {error}"));
    let words = bytes.as_chunks::<4>().0.iter();
    let values: Vec<f32> = words.map(|word| f32::from_le_bytes(*word)).collect();
    values.as_chunks::<4>().0.to_vec()
}

fn most_apart(a: &[[f32; 4]], b: &[[f32; 4]]) -> f32 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// Parameters, two ways to be undefined, and other fields that are no ordinary ones.
fn fields(space: Space) -> (&'static str, [&'static str; 2], [&'static str; 4]) {
    match space {
        Space::Plane => (
            "x, y",
            ["√(-1 - x²)", "0/(x - x)"],
            ["1/(x - x)", "-1/(x - x)", "0", "1e-38 x"],
        ),
        Space::Complex => (
            "z",
            ["√(-1 - re(z)²) + z", "0 z/(0 conj(z))"],
            [
                "1e38 * 1e38 * (1 + z conj(z))",
                "-1e38 i * 1e38 * (1 + z conj(z))",
                "0",
                "1e-38 z",
            ],
        ),
        Space::Space => (
            "x, y, z",
            ["√(-1 - x²)", "0/(x - x + y - y)"],
            ["1/(x - x + y - y)", "-1/(x - x + y - y)", "0", "1e-38 x"],
        ),
    }
}

#[test]
fn every_scene_draws_every_field_and_what_is_undefined_in_one_way() {
    let Some(gpu) = suite_gpu() else { return };
    for scene in scene::scenes() {
        let (parameters, undefined, others) = fields(scene.space);
        let show = |formula| {
            let pixels = draw(&gpu, scene.name, parameters, formula, "");
            for pixel in &pixels {
                let [.., a] = *pixel;
                // highlights may be brighter than what is displayed
                let shown = pixel.iter().all(|c| c.is_finite() && *c > -0.1) && a == 1.0;
                assert!(shown, "{}, {formula}: {pixel:?}", scene.name);
            }
            pixels
        };
        let pictures = undefined.map(show);
        let apart = most_apart(&pictures[0], &pictures[1]);
        assert!(apart < 1e-5, "{}: {apart}", scene.name);
        for formula in others {
            show(formula);
        }
    }
}

/// No surface and no shadow, but walls that are hatched where f is undefined, and even where it is not.
#[test]
fn what_has_no_level_is_no_surface() {
    let Some(gpu) = suite_gpu() else { return };
    let plain = "edge_width = 0, occlusion = 0, isoline_spacing = 0";
    let show = |formula, more: &str| {
        let settings = format!("{plain}, {more}");
        draw(&gpu, "surface", "x, y, z", formula, &settings)
    };
    // with nothing on the walls, all that is left is the ground
    let bare = "wall_opacity = 0";
    let ground = show("7", bare);
    for formula in [
        "√(-1 - x²)",
        "1/(x - x + y - y)",
        "-1/(x - x + y - y)",
        "-3",
        "1e38",
        "1/(x + 0.1 y + 0.1)",
        "if x + 0.1 y + 0.1 < 0 then -5 else 5",
    ] {
        let apart = most_apart(&ground, &show(formula, bare));
        assert!(apart < 1e-5, "{formula}: {apart}");
    }
    let rough = |pixels: &[[f32; 4]], away: [usize; 2]| {
        // along a row through the middle of the box, where walls are smooth
        let row = &pixels[18 * 48..19 * 48][away[0]..away[1]];
        let steps = row.windows(2).map(|w| (w[0][1] - w[1][1]).abs());
        steps.fold(0.0, f32::max)
    };
    let hatched = rough(&show("√(-1 - x²)", ""), [18, 30]);
    assert!(hatched > 0.01, "{hatched}");
    for formula in ["1/(x - x + y - y)", "0.65", "-1e30"] {
        let even = rough(&show(formula, ""), [18, 30]);
        assert!(even < 0.3 * hatched, "{formula}: {even}, not {hatched}");
    }
    // the tint is that of the side
    let middle = |formula| show(formula, "")[18 * 48 + 24];
    let (above, below) = (middle("1/(x - x + y - y)"), middle("-1/(x - x + y - y)"));
    assert!(
        above[0] > above[2] && below[2] > below[0],
        "{above:?} {below:?}"
    );
}

/// A constant distance glows evenly; a constant that is to be made a distance by its gradient has none.
#[test]
fn a_constant_glows_where_it_is_a_distance() {
    let Some(gpu) = suite_gpu() else { return };
    let show = |formula, more: &str| {
        let settings =
            format!("background = (0, 0, 0), fade = 0, jitter = 0, vignette = 0, {more}");
        draw(&gpu, "glow", "x, y, z", formula, &settings)
    };
    let middle = |pixels: &[[f32; 4]]| pixels[18 * 48 + 24];
    assert!(middle(&show("0.2", ""))[0] < 1e-6);
    let haze = show("0.2", "estimate = value");
    assert!(middle(&haze)[0] > 1e-3, "{:?}", middle(&haze));
    for (x, y) in [(22, 17), (26, 19), (24, 16)] {
        let (a, b) = (haze[y * 48 + x], middle(&haze));
        assert!((a[0] - b[0]).abs() < 0.1 * b[0], "{a:?} {b:?}");
    }
    for formula in ["√(-1 - x²)", "1/(x - x + y - y)"] {
        assert!(
            middle(&show(formula, "estimate = value"))[0] < 1e-6,
            "{formula}"
        );
    }
}
