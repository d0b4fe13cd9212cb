//! Undefined and infinite values, constants and formulas without derivatives look as the scenes say, in every scene of the
//! plane and of complex functions.

use pullback_runtime::Gpu;
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::pictures::{Camera, Picture, encoded};

const PLANE: [&str; 4] = ["levels", "logcontours", "bands", "implicit"];
const COMPLEX: [&str; 4] = ["domain", "checker", "grid", "sphere"];

/// The middle of a picture, where a sphere fills it, too.
const CAMERA: Camera = Camera {
    center: [0.1, 0.2],
    height: 0.9,
    size: [64, 48],
    samples: 1,
};

fn draw(gpu: &Gpu, scene: &str, formula: &str, settings: &str) -> Picture {
    let plain = if scene == "sphere" {
        "light = 0, graticule = 0"
    } else {
        ""
    };
    let comma = if plain.is_empty() || settings.is_empty() {
        ""
    } else {
        ", "
    };
    let inputs = if COMPLEX.contains(&scene) {
        "z"
    } else {
        "x, y"
    };
    let source = format!("f({inputs}) = {formula}\nshow {scene}(f) {{ {plain}{comma}{settings} }}");
    Picture::draw(gpu, &source, CAMERA)
}

/// Least and greatest of each component.
fn range(picture: &Picture) -> [(f64, f64); 3] {
    [0, 1, 2].map(|k| {
        picture
            .pixels()
            .map(|c| c[k])
            .fold((255.0_f64, 0.0_f64), |(lo, hi), x| (lo.min(x), hi.max(x)))
    })
}

#[test]
fn undefined_values_are_a_quiet_grey_hatch() {
    let Some(gpu) = suite_gpu() else { return };
    let nan = |scenes: [&'static str; 4], formulas: [&'static str; 2]| {
        scenes
            .into_iter()
            .flat_map(move |s| formulas.map(|f| (s, f)))
    };
    let plane = nan(PLANE, ["√(-1 - x²)", "log(-1 - y²) + x"]);
    let complex = nan(COMPLEX, ["√(-1 - re(z)²) + z", "0 z/(0 conj(z))"]);
    let (dark, light) = (255.0 * encoded(0.47), 255.0 * encoded(0.60));
    for (scene, formula) in plane.chain(complex) {
        let picture = draw(&gpu, scene, formula, "");
        for [r, g, b] in picture.pixels() {
            let grey = (r - g).abs() <= 2.0 && (g - b).abs() <= 2.0;
            assert!(
                grey && r >= dark - 1.5 && r <= light + 1.5,
                "{scene}, {formula}: {r} {g} {b}"
            );
        }
        let (low, high) = range(&picture)[0];
        assert!(high - low > 10.0, "{scene}, {formula}: no hatch");
    }
}

#[test]
fn infinities_are_told_from_undefined_values_and_from_one_another() {
    let Some(gpu) = suite_gpu() else { return };
    for scene in PLANE {
        let above = draw(&gpu, scene, "1e38 * 1e38 * (1 + x²)", "");
        let below = draw(&gpu, scene, "-1e38 * 1e38 * (1 + x²)", "");
        for (picture, sign) in [(&above, "+"), (&below, "-")] {
            let [red, _, blue] = range(picture);
            let hatch = (red.1 - red.0).max(blue.1 - blue.0);
            assert!(hatch > 4.0 && hatch < 120.0, "{scene}, {sign}∞: {hatch}");
        }
        let differ = above
            .pixels()
            .zip(below.pixels())
            .any(|(a, b)| (a[0] - b[0]).abs() > 20.0);
        // stripes repeat without end: both ends are their mean
        assert_eq!(differ, scene != "bands", "{scene}: both infinities");
    }
    for scene in COMPLEX {
        for formula in [
            "1e38 * 1e38 * (1 + z conj(z))",
            "1e38 i * 1e38 * (1 + z conj(z))",
        ] {
            let [red, green, _] = range(&draw(&gpu, scene, formula, ""));
            assert!(
                red.0 > 230.0 && green.1 > 253.0 && red.1 - red.0 > 4.0,
                "{scene}, {formula}: {red:?}"
            );
        }
    }
}

/// One tone, but for the step of dither: no lines, no edges.
#[test]
fn constants_are_one_tone() {
    let Some(gpu) = suite_gpu() else { return };
    let check = |scene: &str, formula: &str| {
        for (low, high) in range(&draw(&gpu, scene, formula, "")) {
            assert!(high - low <= 1.0, "{scene}, {formula}: {low} to {high}");
        }
    };
    for scene in PLANE {
        for formula in ["2.3", "-0.7", "1e30", "-1e-30"] {
            check(scene, formula);
        }
        if scene != "implicit" {
            check(scene, "0");
        }
    }
    for scene in COMPLEX {
        for formula in ["0.7 + 0.4i", "-1.3i", "0", "2e30", "-1e-30i"] {
            check(scene, formula);
        }
    }
}

/// Zero with all derivatives says nothing about a curve: a hatch of two tones that no side has.
#[test]
fn where_nothing_is_known_the_implicit_scene_says_so() {
    let Some(gpu) = suite_gpu() else { return };
    let sides = ["1", "-1"].map(|f| draw(&gpu, "implicit", f, "").displayed(20, 20));
    for formula in ["0", "max(x, 50) - 50", "exp(-1e6 (1 + x²))"] {
        let picture = draw(&gpu, "implicit", formula, "");
        let [red, _, blue] = range(&picture);
        assert!(
            red.1 > blue.1 + 40.0,
            "{formula}: {red:?}, {blue:?} are not amber"
        );
        assert!(blue.1 - blue.0 > 15.0, "{formula}: no hatch");
        for pixel in picture.pixels() {
            for side in sides {
                let away = (0..3)
                    .map(|k| (pixel[k] - side[k]).abs())
                    .fold(0.0, f64::max);
                assert!(away > 8.0, "{formula}: {pixel:?} looks like a side");
            }
        }
    }
}

/// Where f keeps its sign, the curve has the other colour; where it changes it, and at no pole, its own.
#[test]
fn curves_without_a_change_of_sign_look_different() {
    let Some(gpu) = suite_gpu() else { return };
    let inks = "ink = (0, 0, 0), touch = (1, 0, 0), doubt = (0, 1, 0), above = 1, below = 1";
    let count = |formula: &str| {
        let picture = draw(&gpu, "implicit", formula, inks);
        let mut found = [0; 3];
        for [r, g, b] in picture.pixels() {
            if r < 60.0 && g < 60.0 && b < 60.0 {
                found[0] += 1;
            } else if r > 180.0 && g < 60.0 && b < 60.0 {
                found[1] += 1;
            } else if g > r + 40.0 && g > b + 40.0 {
                found[2] += 1;
            }
        }
        found
    };
    let [simple, touching, doubtful] = [0, 1, 2];
    for (formula, kind) in [
        ("y - x²", simple),
        ("(y - x²)^3", simple),
        ("(y - x²)^5", simple),
        ("(y - x²)^2", touching),
        ("-(y - x²)^4", touching),
        ("(sin(y) - x)^2 exp(x)", touching),
        ("|y - x²|^2", touching),
    ] {
        let found = count(formula);
        assert!(found[kind] > 40, "{formula}: {found:?}");
        let others = found.iter().sum::<usize>() - found[kind];
        assert!(others * 20 <= found[kind], "{formula}: {found:?}");
    }
    for pole in ["1/(y - x²)", "-1/(y - x²)^2", "(2 + x)/(y - x²)^3"] {
        let found = count(pole);
        assert!(found.iter().sum::<usize>() <= 2, "{pole}: {found:?}");
    }
    let dense = count("sin(3000 x + 1000 y)");
    assert!(
        dense[doubtful] > 1000,
        "lines finer than a pixel: {dense:?}"
    );
}

/// A layer of strength 0 is not there, and one of strength 1 is, of each of the six.
#[test]
fn every_layer_of_the_grid_can_be_taken_away() {
    let Some(gpu) = suite_gpu() else { return };
    let layers = [
        "phase",
        "light",
        "checker",
        "first_lines",
        "second_lines",
        "axes",
    ];
    let draw_with = |shown: &[&str], shape: &str| {
        let settings: Vec<String> = layers
            .iter()
            .map(|l| format!("{l} = {}", u8::from(shown.contains(l))))
            .collect();
        let settings = format!("shape = {shape}, fade_octaves = 1, {}", settings.join(", "));
        draw(&gpu, "grid", "6 (z - 0.1) (1 + z/3)", &settings)
    };
    for shape in ["rectangular", "polar"] {
        let none = draw_with(&[], shape);
        for (low, high) in range(&none) {
            assert!(high - low <= 1.0, "{shape}: {low} to {high} without layers");
        }
        for layer in layers {
            let changed = draw_with(&[layer], shape)
                .pixels()
                .zip(none.pixels())
                .filter(|(a, b)| (0..3).any(|k| (a[k] - b[k]).abs() > 8.0))
                .count();
            assert!(changed > 20, "{shape}: `{layer}` changes {changed} pixels");
        }
    }
}

/// A colour key changes the lower right corner and nothing else.
#[test]
fn keys_are_in_their_corner() {
    let Some(gpu) = suite_gpu() else { return };
    let scenes = [
        ("levels", "x y"),
        ("logcontours", "x y"),
        ("bands", "x y"),
        ("domain", "z² - 1"),
        ("checker", "z² - 1"),
        ("grid", "z² - 1"),
        ("sphere", "z² - 1"),
    ];
    for (scene, formula) in scenes {
        let (plain, keyed) = (
            draw(&gpu, scene, formula, ""),
            draw(&gpu, scene, formula, "key = 0.4"),
        );
        let mut inside = 0;
        for (column, row) in (0..64).flat_map(|c| (0..48).map(move |r| (c, r))) {
            let (a, b) = (plain.displayed(column, row), keyed.displayed(column, row));
            let differs = (0..3).any(|k| (a[k] - b[k]).abs() > 1.0);
            // 19 pixels, a margin of 4 and half of the border
            assert!(!differs || row >= 23, "{scene}: {column}, {row}");
            inside += usize::from(differs);
        }
        assert!(inside > 150, "{scene}: {inside} pixels");
    }
}

/// The characters of the keys' font by their cells, drawn by hand: rows from the top.
const FONT: [(char, &str); 13] = [
    ('0', "### #.# #.# #.# ###"),
    ('1', ".#. ##. .#. .#. ###"),
    ('2', "### ..# ### #.. ###"),
    ('3', "### ..# ### ..# ###"),
    ('4', "#.# #.# ### ..# ..#"),
    ('5', "### #.. ### ..# ###"),
    ('6', "### #.. ### #.# ###"),
    ('7', "### ..# ..# .#. .#."),
    ('8', "### #.# ### #.# ###"),
    ('9', "### #.# ### ..# ###"),
    ('-', "... ... ### ... ..."),
    ('.', "... ... ... ... .#."),
    ('e', "... ### ### #.. ###"),
];

/// Reads the number at the right end of a bar key whose height is 120 pixels of a picture of 1200 by 240.
fn right_label(picture: &Picture) -> String {
    let cell = 10;
    // margin 4, half size 480 by 60, a gap of two cells
    let (right, top) = (1200 - 4 - 2 * cell, 240 - 4 - 60 - 25);
    let mut text = Vec::new();
    for k in 0.. {
        let glyph: Vec<String> = (0..5)
            .map(|row| {
                let cells = (0..3).map(|column| {
                    let (x, y) = (
                        right - 4 * cell * k - cell * (3 - column) + 5,
                        top + cell * row + 5,
                    );
                    let [r, g, b] = picture.linear(x, y);
                    let is_ink = r == g && g == b && (r == 0.0 || r == 1.0);
                    if is_ink { '#' } else { '.' }
                });
                cells.collect()
            })
            .collect();
        let glyph = glyph.join(" ");
        match FONT.iter().find(|(_, cells)| *cells == glyph) {
            Some((character, _)) => text.push(*character),
            None => break,
        }
    }
    text.iter().rev().collect()
}

#[test]
fn keys_say_their_values() {
    let Some(gpu) = suite_gpu() else { return };
    for (scale, label) in [
        ("1", "4"),
        ("0.025", "0.1"),
        ("250", "1000"),
        ("0.03125", "0.125"),
        ("0.0003125", "0.00125"),
        ("61725", "247000"),
        ("2.5e8", "1e9"),
        ("3.0864e20", "1.23e21"),
        ("2.5e-12", "1e-11"),
        ("1.7e-30", "6.8e-30"),
        ("249.9", "1000"),
        ("0.2499", "1"),
    ] {
        let camera = Camera {
            center: [0.0; 2],
            height: 3.0,
            size: [1200, 240],
            samples: 1,
        };
        let source = format!(
            "show levels(x - y) {{ color_scale = {scale}, key = 0.5, line_opacity = 0, zero_width = 0 }}"
        );
        assert_eq!(
            right_label(&Picture::draw(&gpu, &source, camera)),
            label,
            "{scale}"
        );
    }
}
