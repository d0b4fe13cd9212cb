//! Pictures without a background: laid over a colour they are what is drawn in front of that colour.

use pullback_compiler::lower::Precision;
use pullback_runtime::{Frame, Gpu, Pipeline, Renderer, Size, View, fill_in_scale};

use crate::colour::decoded;
use crate::drawing::device;

const SIZE: Size = Size {
    width: 56,
    height: 42,
};

/// Linear rgb, premultiplied, and alpha.
type Pixel = [f64; 4];

/// What is drawn, and whether its alpha is all that it hides.
const SCENES: [(&str, &str); 8] = [
    ("surface", "x^2 + y^2 + z^2 - 3"),
    ("surface", "x y z - 0.2"),
    ("slices", "x y - z"),
    ("nested", "x^2 + y^2 + z^2"),
    ("cutaway", "x^2 + y^2 - z"),
    ("volume", "2 exp(-x^2 - y^2 - z^2)"),
    ("volumecut", "2 exp(-x^2 - y^2 - z^2)"),
    ("scatter", "1.5 - x^2 - y^2 - z^2"),
];
const GROUNDS: [[f64; 3]; 2] = [[0.02, 0.05, 0.4], [0.8, 0.55, 0.1]];

fn drawn(gpu: &Gpu, source: &str, pipeline: Pipeline) -> Vec<u8> {
    let compiled = pullback_compiler::compile(source);
    let program = compiled
        .program
        .unwrap_or_else(|| panic!("{source}: {:?}", compiled.diagnostics));
    let picture = &program.pictures()[0];
    let scene = program
        .scene_module(0, Precision::Accurate)
        .expect("a scene");
    let view = View {
        center: [0.0; 2],
        height: 2.3,
    };
    let mut settings = picture.settings.clone();
    fill_in_scale(&mut settings, picture, &view, SIZE, &[], 0.0);
    let frame = Frame {
        view,
        params: &[],
        settings: &scene.pack_settings(&settings),
        size: SIZE,
        samples: 3,
        time: 0.0,
        pipeline,
    };
    let mut rows = Vec::new();
    Renderer::new(gpu, &scene)
        .and_then(|mut r| r.render(&frame, &mut rows))
        .expect("a picture");
    rows
}

/// As the shader computes it, premultiplied.
fn linear(gpu: &Gpu, source: &str) -> Vec<Pixel> {
    let number = |at: &[u8]| f64::from(f32::from_le_bytes([at[0], at[1], at[2], at[3]]));
    drawn(gpu, source, Pipeline::Linear)
        .chunks_exact(16)
        .map(|pixel| [0, 4, 8, 12].map(|at| number(&pixel[at..at + 4])))
        .collect()
}

/// From 8 bits of sRGB, which are not premultiplied.
fn from_bytes(gpu: &Gpu, source: &str) -> Vec<Pixel> {
    drawn(gpu, source, Pipeline::Compute)
        .chunks_exact(4)
        .map(|pixel| {
            let a = f64::from(pixel[3]) / 255.0;
            let [r, g, b] = [0, 1, 2].map(|k| a * decoded(f64::from(pixel[k]) / 255.0));
            [r, g, b, a]
        })
        .collect()
}

fn over(pixel: Pixel, ground: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| pixel[k] + (1.0 - pixel[3]) * ground[k])
}

fn source(scene: &str, formula: &str, ground: [f64; 3], backdrop: &str) -> String {
    let [r, g, b] = ground;
    format!(
        "f(x, y, z) = {formula}\nshow {scene}(f) {{ background = ({r}, {g}, {b}), backdrop = {backdrop} }}"
    )
}

/// Greatest difference of a component, the number of pixels that something shines through but not all, and those left out
/// because they are brighter than a picture or than their alpha.
fn compared(transparent: &[Pixel], opaque: &[Pixel], ground: [f64; 3]) -> (f64, usize, usize) {
    let (mut worst, mut partial, mut bright) = (0.0_f64, 0, 0);
    for (pixel, wanted) in transparent.iter().zip(opaque) {
        assert!(
            wanted[3] >= 0.9999,
            "an opaque picture has alpha {}",
            wanted[3]
        );
        let largest = pixel[0].max(pixel[1]).max(pixel[2]);
        if wanted[..3].iter().any(|&c| c > 0.99) || largest > 0.98 * pixel[3] && pixel[3] > 0.0 {
            bright += 1;
            continue;
        }
        partial += usize::from(pixel[3] > 0.02 && pixel[3] < 0.98);
        let found = over(*pixel, ground);
        for k in 0..3 {
            worst = worst.max((found[k] - wanted[k]).abs());
        }
    }
    (worst, partial, bright)
}

#[test]
fn a_picture_over_a_colour_is_that_in_front_of_it() {
    let Some(gpu) = device() else { return };
    for (scene, formula) in SCENES {
        for ground in GROUNDS {
            let clear = source(scene, formula, ground, "transparent");
            let plain = linear(&gpu, &source(scene, formula, ground, "plain"));
            let (exact, partial, _) = compared(&linear(&gpu, &clear), &plain, ground);
            let (read, _, bright) = compared(&from_bytes(&gpu, &clear), &plain, ground);
            println!("{scene}: {exact:.1e}, 8 bits {read:.4}, {partial} partial, {bright} bright");
            assert!(exact < 2e-6, "{scene}, {formula}: {exact}");
            // half a step of 8 bits in alpha, and one and the dither in the colour, where sRGB is steepest: 2.3/255
            assert!(
                read < 0.5 / 255.0 + 1.0 * 2.3 / 255.0,
                "{scene}, {formula}: {read}"
            );
            assert!(partial > 40, "{scene}: {partial} pixels of the silhouette");
        }
    }
}

/// Of the gas alpha is what it takes from the light behind it: 1 - exp(-2 h σ) across a cube of even density.
#[test]
fn the_alpha_of_a_medium_is_one_less_its_transmittance() {
    let Some(gpu) = device() else { return };
    let text = "show volume(1 + 0 x y z) { box = 1, density = 0.35, color_scale = 1, edge_width = 0, yaw = 0, pitch = 0, \
                projection = orthographic, extent = 1, backdrop = transparent }";
    let pixels = linear(&gpu, text);
    let expected = 1.0 - (-2.0 * 0.35_f64).exp();
    for pixel in pixels {
        assert!(
            (pixel[3] - expected).abs() < 2e-5,
            "{}, not {expected}",
            pixel[3]
        );
    }
}

/// Light that hides nothing has the alpha that shows it as it is on black.
#[test]
fn a_glow_is_right_on_black() {
    let Some(gpu) = device() else { return };
    let glow = |backdrop| source("glow", "√(x^2 + y^2 + z^2) - 1", [0.0; 3], backdrop);
    let plain = linear(&gpu, &glow("plain"));
    let clear = from_bytes(&gpu, &glow("transparent"));
    for (pixel, wanted) in clear.iter().zip(&plain) {
        for k in 0..3 {
            assert!(
                (pixel[k] - wanted[k]).abs() < 3.0 / 255.0,
                "{pixel:?}, not {wanted:?}"
            );
        }
    }
    assert!(clear.iter().any(|p| p[3] > 0.1 && p[3] < 0.9));
}

#[test]
fn a_sphere_lies_on_any_ground() {
    let Some(gpu) = device() else { return };
    let draw = |ground: [f64; 3], backdrop: &str| {
        let [r, g, b] = ground;
        let settings = format!("background = ({r}, {g}, {b}), backdrop = {backdrop}");
        linear(
            &gpu,
            &format!("f(z) = z^2\nshow sphere(f) {{ {settings} }}"),
        )
    };
    // the corners of an opaque picture are darker: a black ground is even
    let plain = draw([0.0; 3], "plain");
    let clear = draw([0.0; 3], "transparent");
    let (worst, partial, _) = compared(&clear, &plain, [0.0; 3]);
    assert!(worst < 2e-6 && partial > 20, "{worst}, {partial}");
    assert_eq!(clear[0], [0.0; 4]);
}

/// A curve with its sides lies on anything: over the colour of its paper it is what is drawn on that.
#[test]
fn a_curve_lies_on_any_ground() {
    const PAPER: [f64; 3] = [0.93, 0.92, 0.89];
    let Some(gpu) = device() else { return };
    for formula in [
        "x^2 + y^2 - 0.5",
        "(x - y)^2",
        "x/(y + 0.3) + sqrt(x + 0.7)",
        "sin(1/(x^2 + y^2))",
    ] {
        for fill in [0.0, 0.4] {
            let source = |backdrop: &str| {
                format!(
                    "f(x, y) = {formula}\nshow implicit(f) {{ fill = {fill}, backdrop = {backdrop} }}"
                )
            };
            let clear = linear(&gpu, &source("transparent"));
            let (exact, partial, _) = compared(&clear, &linear(&gpu, &source("plain")), PAPER);
            println!("{formula}: {exact:.1e}, {partial} partial");
            assert!(exact < 2e-6, "{formula}: {exact}");
            assert!(
                partial > 40,
                "{formula}: {partial} pixels of the line's edge"
            );
            let empty = clear.iter().any(|pixel| pixel[3] == 0.0);
            assert_eq!(empty, fill == 0.0, "{formula}");
        }
    }
}
