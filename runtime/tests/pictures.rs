//! Pictures show what the formula says: colours at places where they are known beforehand.

use pullback_compiler::lower::Precision;
use pullback_runtime::{AdapterChoice, Frame, Gpu, Pipeline, Renderer, Size, View, fill_in_scale};

const SIZE: Size = Size {
    width: 96,
    height: 72,
};

/// An sRGB pixel of a drawn formula, by world coordinates of a plane view 3 units high.
struct Picture {
    rows: Vec<u8>,
}

impl Picture {
    fn pixel(&self, column: u32, row: u32) -> [i32; 3] {
        let at = 4 * (row * SIZE.width + column) as usize;
        [0, 1, 2].map(|k| i32::from(self.rows[at + k]))
    }

    fn at(&self, x: f64, y: f64) -> [i32; 3] {
        let pixel = 3.0 / f64::from(SIZE.height);
        let column = (x / pixel + f64::from(SIZE.width) / 2.0).floor();
        let row = (f64::from(SIZE.height) / 2.0 - y / pixel).floor();
        self.pixel(column as u32, row as u32)
    }
}

/// Draws a program on the software adapter; `None` where there is no adapter and that is allowed.
fn draw(source: &str) -> Option<Picture> {
    let gpu = match Gpu::open(&AdapterChoice::Software) {
        Ok(gpu) => gpu,
        Err(_) if std::env::var_os("PULLBACK_ALLOW_NO_GPU").is_some() => return None,
        Err(error) => panic!("{error}"),
    };
    let program = pullback_compiler::compile(source)
        .program
        .expect("a program");
    let picture = &program.pictures()[0];
    let scene = program
        .scene_module(0, Precision::Accurate)
        .expect("a scene");
    let view = View {
        center: [0.0, 0.0],
        height: 3.0,
    };
    let mut settings = picture.settings.clone();
    fill_in_scale(&mut settings, picture, &view, SIZE, &[], 0.0);
    let bytes = scene.pack_settings(&settings);
    let frame = Frame {
        view,
        params: &[],
        settings: &bytes,
        size: SIZE,
        samples: 2,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let mut rows = Vec::new();
    Renderer::new(&gpu, &scene)
        .and_then(|mut r| r.render(&frame, &mut rows))
        .expect("a picture");
    Some(Picture { rows })
}

fn is_red([r, g, b]: [i32; 3]) -> bool {
    r > g + 30 && r > b + 30
}

fn is_blue([r, g, b]: [i32; 3]) -> bool {
    b > r + 30 && b > g
}

fn brightness([r, g, b]: [i32; 3]) -> i32 {
    r + g + b
}

#[test]
fn levels_are_red_above_zero_blue_below_and_dark_at_zero() {
    let Some(picture) = draw("x + y/4 + 0.01") else {
        return;
    };
    for y in [-1.0, 0.0, 0.9] {
        assert!(is_red(picture.at(1.1, y)), "{:?}", picture.at(1.1, y));
        assert!(is_blue(picture.at(-1.1, y)), "{:?}", picture.at(-1.1, y));
        let line = picture.at(-y / 4.0 - 0.01, y);
        assert!(brightness(line) < 250, "the zero line at y = {y}: {line:?}");
    }
}

#[test]
fn undefined_values_look_undefined() {
    let Some(picture) = draw("√x + 5") else {
        return;
    };
    assert!(is_red(picture.at(1.0, 0.0)));
    for y in [-1.0, 0.3] {
        let [r, g, b] = picture.at(-1.0, y);
        assert!(
            (r - g).abs() < 12 && (g - b).abs() < 12,
            "grey, not {r} {g} {b}"
        );
    }
}

#[test]
fn domain_colours_turn_with_the_argument() {
    let Some(picture) = draw("f(z) = z") else {
        return;
    };
    let (right, left) = (picture.at(1.2, 0.05), picture.at(-1.2, 0.05));
    assert!(is_red(right), "the positive axis is red: {right:?}");
    assert!(
        left[0] + 40 < left[1].max(left[2]),
        "the negative axis is cyan: {left:?}"
    );
    // no seam where the argument jumps from π to -π
    let (above, below) = (picture.at(-1.2, 0.02), picture.at(-1.2, -0.02));
    for k in 0..3 {
        assert!((above[k] - below[k]).abs() < 30, "{above:?} {below:?}");
    }
    // the argument of the conjugate turns the other way
    let Some(turned) = draw("f(z) = conj(z)") else {
        return;
    };
    for (x, y) in [(0.7, 0.8), (-0.6, 0.4)] {
        let (one, other) = (picture.at(x, y), turned.at(x, -y));
        for k in 0..3 {
            assert!(
                (one[k] - other[k]).abs() < 40,
                "{one:?} {other:?} at {x}, {y}"
            );
        }
    }
}

#[test]
fn zeros_are_dark_and_poles_are_light() {
    let Some(picture) = draw("f(z) = (z - 0.8)^9 / (z + 0.8)^9") else {
        return;
    };
    // the fade stops at 88 %, so that rings still show
    assert!(brightness(picture.at(0.8, 0.0)) < 200);
    assert!(brightness(picture.at(-0.8, 0.0)) > 620);
}

#[test]
fn a_sphere_shows_its_outside() {
    let Some(picture) = draw("show surface(x² + y² + z² - 2) { box = 2, steps = 40 }") else {
        return;
    };
    let middle = picture.pixel(SIZE.width / 2, SIZE.height / 2);
    assert!(is_red(middle), "the outside is orange: {middle:?}");
    let sky = picture.pixel(2, 2);
    assert!(
        brightness(sky) > 500 && (sky[0] - sky[2]).abs() < 40,
        "the sky is pale: {sky:?}"
    );
    // turned inside out, the same surface shows the other side
    let Some(picture) = draw("show surface(2 - x² - y² - z²) { box = 2, steps = 40 }") else {
        return;
    };
    let middle = picture.pixel(SIZE.width / 2, SIZE.height / 2);
    assert!(is_blue(middle), "the inside is blue: {middle:?}");
}

#[test]
fn an_empty_scene_and_a_formula_of_nan_are_drawn() {
    for formula in [
        "show surface(x² + 1) { steps = 40 }",
        "show surface(√(-1 - x²)) { steps = 40 }",
    ] {
        let Some(picture) = draw(formula) else { return };
        for (column, row) in [(3, 3), (48, 36), (90, 60)] {
            let pixel = picture.pixel(column, row);
            assert!(brightness(pixel) > 300, "{formula}: {pixel:?}");
        }
    }
}
