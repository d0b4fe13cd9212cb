//! What is no ordinary number, in every scene: undefined and infinite values, constants.

use pullback_runtime::Gpu;

use crate::colour::{Rgb, diverging, encoded};
use crate::drawing::{Picture, device, draw};

const SIZE: [u32; 2] = [64, 48];

/// A picture without edges and grid, and its middle: a plane through the origin, or what is around it.
fn picture(gpu: &Gpu, scene: &str, formula: &str, settings: &str) -> Picture {
    let source =
        format!("f(x, y, z) = {formula}\nshow {scene}(f) {{ edge_width = 0, {settings} }}");
    draw(gpu, &source, SIZE, 1, 0.0)
}

/// The pixels around the middle.
fn middle(picture: &Picture) -> Vec<Rgb> {
    let [x, y] = SIZE.map(|side| side / 2 - 4);
    (0..64)
        .map(|k| picture.srgb(x + k % 8, y + k / 8))
        .collect()
}

fn greyness([r, g, b]: Rgb) -> f64 {
    (r - g).abs().max((g - b).abs())
}

/// Two tones, some pixels of each: a hatch.
fn is_hatched(pixels: &[Rgb]) -> bool {
    let tones: Vec<f64> = pixels.iter().map(|p| p.iter().sum()).collect();
    let (low, high) = tones
        .iter()
        .fold((f64::MAX, f64::MIN), |(a, b), &t| (a.min(t), b.max(t)));
    high - low > 0.05
}

fn is_even(pixels: &[Rgb]) -> bool {
    let close = |p: &Rgb| (0..3).all(|k| (p[k] - pixels[0][k]).abs() < 2.0 / 255.0);
    pixels.iter().all(close)
}

const NAN: &str = "√(-1 - x²)";
const INFINITE: &str = "1/(x - x + y - y)";

#[test]
fn planes_hatch_what_is_undefined_and_what_is_infinite() {
    let Some(gpu) = device() else { return };
    for (scene, settings) in [
        ("slices", "reference = none, axis = (1, 0.5, 0.5)"),
        (
            "cutaway",
            "normal = (1, 0.5, 0.5), cut_below = 1, cut_above = 1",
        ),
    ] {
        let undefined = middle(&picture(&gpu, scene, NAN, settings));
        assert!(
            undefined.iter().all(|p| greyness(*p) < 0.02),
            "{scene}: {undefined:?}"
        );
        assert!(is_hatched(&undefined), "{scene}");
        for sign in ["", "-"] {
            let formula = format!("{sign}{INFINITE}");
            let infinite = middle(&picture(&gpu, scene, &formula, settings));
            assert!(is_hatched(&infinite), "{scene}: {infinite:?}");
            let end = diverging(if sign.is_empty() { 1.0 } else { -1.0 });
            for pixel in infinite {
                for k in 0..3 {
                    // the end of the palette, and on the stripes 13 % white with it
                    let range = [end[k], 0.87 * end[k] + 0.13].map(|c| encoded(c.clamp(0.0, 1.0)));
                    let inside = pixel[k] > range[0] - 0.01 && pixel[k] < range[1] + 0.01;
                    assert!(inside, "{scene}: {pixel:?}, not in {range:?}");
                }
            }
        }
        // a constant has the colour of its value, and no lines: 3 is three quarters of an automatic scale of 4, or so
        let constant = middle(&picture(
            &gpu,
            scene,
            "3",
            &format!("{settings}, color_scale = 4"),
        ));
        let wanted = diverging(0.6).map(encoded);
        assert!(is_even(&constant), "{scene}: {constant:?}");
        for k in 0..3 {
            assert!(
                (constant[0][k] - wanted[k]).abs() < 2.0 / 255.0,
                "{scene}: {constant:?}"
            );
        }
    }
}

#[test]
fn what_has_no_level_has_no_surface() {
    let Some(gpu) = device() else { return };
    for scene in ["nested", "cutaway"] {
        let cut = if scene == "cutaway" {
            "cut_below = 0, cut_above = 0,"
        } else {
            ""
        };
        let settings = format!(
            "{cut} level = 1, wall_opacity = 0, backdrop = plain, background = (0.2, 0.3, 0.4)"
        );
        let background = [0.2, 0.3, 0.4].map(encoded);
        for formula in [NAN, INFINITE, "1", "3", "-1e38"] {
            let pixels = middle(&picture(&gpu, scene, formula, &settings));
            assert!(is_even(&pixels), "{scene}, {formula}: {pixels:?}");
            for k in 0..3 {
                assert!(
                    (pixels[0][k] - background[k]).abs() < 2.0 / 255.0,
                    "{scene}, {formula}: {pixels:?}"
                );
            }
        }
        // a pole and a jump are no surfaces, although the sign changes there
        for formula in ["1/(x + 0.1 y + 0.1)", "5 sign(x + 0.1 y + 0.1)"] {
            let settings =
                format!("{settings}, level = 0, count = 1").replacen("level = 1,", "", 1);
            let pixels = middle(&picture(&gpu, scene, formula, &settings));
            assert!(is_even(&pixels), "{scene}, {formula}: {pixels:?}");
        }
    }
}

#[test]
fn a_medium_is_empty_where_it_is_undefined_and_densest_where_it_is_infinite() {
    let Some(gpu) = device() else { return };
    for scene in ["volume", "volumecut"] {
        let cut = if scene == "volume" {
            ""
        } else {
            "cut_opacity = 0, position = 0.3,"
        };
        let settings = format!("{cut} background = (0.2, 0.3, 0.4), lighting = 0");
        let background = [0.2, 0.3, 0.4].map(encoded);
        let empty = middle(&picture(&gpu, scene, NAN, &settings));
        for k in 0..3 {
            assert!(
                (empty[0][k] - background[k]).abs() < 2.0 / 255.0,
                "{scene}: {empty:?}"
            );
        }
        let [infinite, largest] = [INFINITE, "1e38"].map(|formula| {
            middle(&picture(
                &gpu,
                scene,
                formula,
                &format!("{settings}, color_scale = 1"),
            ))
        });
        for pixels in [&infinite, &largest] {
            assert!(is_even(pixels), "{scene}: {pixels:?}");
            assert!(pixels[0][0] > pixels[0][2] + 0.2, "{scene}: {pixels:?}");
        }
        for k in 0..3 {
            assert!(
                (infinite[0][k] - largest[0][k]).abs() < 2.0 / 255.0,
                "{scene}"
            );
        }
    }
}
