//! Lines of the plane scenes stand where the formula says, and are as wide as the settings say: position and width
//! measured in pictures against roots of closed forms in f64, at zooms from 1e-3 to 1e3.

use pullback_runtime::Gpu;
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::pictures::{Camera, Picture, Random};

/// A real function and its gradient.
type Field = fn(f64, f64) -> [f64; 3];

/// Half length of the scan across a line, in pixels. Another line may not be nearer than twice that.
const REACH: u32 = 6;
/// Tolerances: pixels, and share of the width.
const POSITION: f64 = 0.1;
const WIDTH: f64 = 0.05;

/// How a line shows in a picture: coverage of a pixel from its colour with the line and without.
struct Contrast<'p> {
    with: &'p Picture,
    without: &'p Picture,
    ink: [f64; 3],
    /// Opacity of the ink.
    strength: f64,
}

impl Contrast<'_> {
    fn coverage(&self, column: u32, row: u32) -> f64 {
        let (line, plain) = (
            self.with.linear(column, row),
            self.without.linear(column, row),
        );
        let changed: f64 = (0..3).map(|k| plain[k] - line[k]).sum();
        let full: f64 = (0..3).map(|k| plain[k] - self.ink[k]).sum();
        changed / full / self.strength
    }
}

/// Place and width of the line that a scan crosses, in pixels along it from its middle.
fn measure(scan: impl Fn(i64) -> f64) -> (f64, f64) {
    let reach = i64::from(REACH);
    let covered: Vec<(f64, f64)> = (-reach..=reach).map(|k| (k as f64, scan(k))).collect();
    let width: f64 = covered.iter().map(|c| c.1).sum();
    let place = covered.iter().map(|c| c.0 * c.1).sum::<f64>() / width;
    (place, width)
}

/// The place of the only sign change of `g` on [low, high] by bisection; `None` where samples show none or several.
fn only_root(g: impl Fn(f64) -> f64, low: f64, high: f64) -> Option<f64> {
    let steps = 400;
    let at = |k: usize| low + (high - low) * k as f64 / f64::from(steps);
    let mut found = None;
    for k in 0..steps as usize {
        if (g(at(k)) < 0.0) != (g(at(k + 1)) < 0.0) {
            if found.is_some() {
                return None;
            }
            found = Some((at(k), at(k + 1)));
        }
    }
    let (mut a, mut b) = found?;
    for _ in 0..80 {
        let middle = 0.5 * (a + b);
        if (g(middle) < 0.0) == (g(a) < 0.0) {
            a = middle;
        } else {
            b = middle;
        }
    }
    Some(0.5 * (a + b))
}

/// A pixel near a line, and the scan across it.
struct Crossing {
    column: u32,
    row: u32,
    across: bool,
    /// Where the line crosses the scan, in pixels from the pixel's middle.
    truth: f64,
    /// Cosine of the angle between scan and normal.
    slant: f64,
}

/// Random scans that cross exactly one line of the family `level = whole`, within half a pixel of their middle. `level`
/// gives a number that is whole on lines, and the gradient of it.
fn crossings(camera: Camera, level: impl Fn(f64, f64) -> [f64; 3], wanted: usize) -> Vec<Crossing> {
    let mut random = Random::default();
    let mut out = Vec::new();
    let [width, height] = camera.size;
    for _ in 0..400_000 {
        if out.len() == wanted {
            break;
        }
        let column = random.between(20, width - 20);
        let row = random.between(20, height - 20);
        let middle = (f64::from(column) + 0.5, f64::from(row) + 0.5);
        let [x, y] = camera.world(middle.0, middle.1);
        let [value, dx, dy] = level(x, y);
        let slope = dx.hypot(dy) * camera.pixel();
        let whole = value.round();
        // a line within a pixel, and its neighbours far away
        if !((value - whole).abs() < 1.5 * slope && slope * 30.0 < 1.0) {
            continue;
        }
        let across = dx.abs() >= dy.abs();
        let along = |t: f64| {
            let [x, y] = if across {
                camera.world(middle.0 + t, middle.1)
            } else {
                camera.world(middle.0, middle.1 + t)
            };
            level(x, y)
        };
        let far = 2.0 * f64::from(REACH);
        let Some(truth) = only_root(|t| along(t)[0] - whole, -far, far) else {
            continue;
        };
        if truth.abs() > 0.5 || (-24..=24).any(|k| along(f64::from(k) / 2.0)[0].round() != whole) {
            continue;
        }
        let [_, dx, dy] = along(truth);
        let slant = if across { dx } else { dy }.abs() / dx.hypot(dy);
        out.push(Crossing {
            column,
            row,
            across,
            truth,
            slant,
        });
    }
    out
}

/// Compares the lines of a picture with the truth.
fn check_lines(name: &str, contrast: &Contrast, width: f64, crossings: &[Crossing]) {
    assert!(
        crossings.len() >= 20,
        "{name}: {} crossings",
        crossings.len()
    );
    let (mut worst_place, mut worst_width) = (0.0_f64, 0.0_f64);
    for c in crossings {
        let (place, found) = measure(|k| {
            let moved = |from: u32| u32::try_from(i64::from(from) + k).expect("inside");
            if c.across {
                contrast.coverage(moved(c.column), c.row)
            } else {
                contrast.coverage(c.column, moved(c.row))
            }
        });
        // distance at right angles to the line
        worst_place = worst_place.max((place - c.truth).abs() * c.slant);
        worst_width = worst_width.max((found * c.slant / width - 1.0).abs());
    }
    println!(
        "{name}: {} crossings, position within {worst_place:.3} px, width within {:.1} %",
        crossings.len(),
        100.0 * worst_width
    );
    assert!(
        worst_place <= POSITION,
        "{name}: off by {worst_place} pixels"
    );
    assert!(worst_width <= WIDTH, "{name}: width off by {worst_width}");
}

fn camera(center: [f64; 2], height: f64) -> Camera {
    Camera {
        center,
        height,
        size: [320, 240],
        samples: 3,
    }
}

/// For pictures without lines, which change slowly.
fn plain(camera: Camera) -> Camera {
    Camera {
        samples: 1,
        ..camera
    }
}

fn suite() -> Option<Gpu> {
    suite_gpu()
}

const PAPER: &str = "ink = 0, line_width = 3";

// ------------------------------------------------------------------------------------------------------------------
// implicit

fn check_implicit(gpu: &Gpu, name: &str, formula: &str, field: Field, camera: Camera) {
    let source = |width: f64| {
        format!("show implicit({formula}) {{ fill = 0, ink = 0, touch = 0, line_width = {width} }}")
    };
    let with = Picture::draw(gpu, &source(3.0), camera);
    let without = Picture::draw(gpu, &source(0.0), plain(camera));
    let contrast = Contrast {
        with: &with,
        without: &without,
        ink: [0.0; 3],
        strength: 1.0,
    };
    // whole only at 0, and of slope 1/100 per pixel there
    let level = |x: f64, y: f64| {
        let [f, dx, dy] = field(x, y);
        // not near a node, where two branches meet
        let size = |a: f64, b: f64| {
            let [_, dx, dy] = field(x + 16.0 * a * camera.pixel(), y + 16.0 * b * camera.pixel());
            dx.hypot(dy) / field(x, y)[1].hypot(field(x, y)[2])
        };
        if [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)]
            .iter()
            .any(|&(a, b)| (size(a, b) - 1.0).abs() > 0.4)
        {
            return [f64::NAN; 3];
        }
        let slope = 100.0 * dx.hypot(dy).max(1e-300) * camera.pixel();
        [(f / slope).clamp(-0.49, 0.49), dx / slope, dy / slope]
    };
    check_lines(name, &contrast, 3.0, &crossings(camera, level, 60));
}

#[test]
fn zero_curves_have_their_place_and_width() {
    let Some(gpu) = suite() else { return };
    let circle: Field = |x, y| [x * x + y * y - 2.0, 2.0 * x, 2.0 * y];
    for multiplicity in 1..=4 {
        let formula = format!("(x² + y² - 2)^{multiplicity}");
        let name = format!("implicit, circle, multiplicity {multiplicity}");
        check_implicit(&gpu, &name, &formula, circle, camera([0.0, 0.0], 4.0));
    }
    let name = "implicit, circle at zoom 1e3";
    check_implicit(&gpu, name, "x² + y² - 2", circle, camera([1.0, 1.0], 4e-3));
    let name = "implicit, double circle at zoom 30";
    check_implicit(
        &gpu,
        name,
        "(x² + y² - 2)²",
        circle,
        camera([1.0, 1.0], 0.13),
    );
    let huge: Field = |x, y| [x * x + y * y - 2e6, 2.0 * x, 2.0 * y];
    let name = "implicit, circle at zoom 1e-3";
    check_implicit(
        &gpu,
        name,
        "x² + y² - 2000000",
        huge,
        camera([0.0, 0.0], 4e3),
    );
    let waves: Field = |x, y| {
        [
            x.sin() + (x * y).cos(),
            x.cos() - y * (x * y).sin(),
            -x * (x * y).sin(),
        ]
    };
    check_implicit(
        &gpu,
        "implicit, waves",
        "sin(x) + cos(x y)",
        waves,
        camera([0.3, 0.2], 5.0),
    );
    let cubic: Field = |x, y| {
        [
            x * x * x + y * y * y - 3.0 * x * y,
            3.0 * x * x - 3.0 * y,
            3.0 * y * y - 3.0 * x,
        ]
    };
    check_implicit(
        &gpu,
        "implicit, folium",
        "x³ + y³ - 3x y",
        cubic,
        camera([0.3, 0.2], 5.0),
    );
    let tiny: Field = |x, y| [x - y * y, 1.0, -2.0 * y];
    check_implicit(
        &gpu,
        "implicit, tiny values",
        "(x - y²) * 1e-36",
        tiny,
        camera([0.0, 0.0], 3.0),
    );
    check_implicit(
        &gpu,
        "implicit, huge values",
        "(x - y²) * 1e36",
        tiny,
        camera([0.0, 0.0], 3.0),
    );
}

/// Distance of a point from the half strip |x - t y| ≤ 1, y ≤ 0, that is from its three edges, and from its corners.
fn from_half_strip([x, y]: [f64; 2], t: f64) -> [f64; 2] {
    let from = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| {
        let (dx, dy) = (bx - ax, by - ay);
        let along = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy);
        let along = along.clamp(0.0, 1.0);
        (x - ax - along * dx).hypot(y - ay - along * dy)
    };
    let corners = [[-1.0, 0.0], [1.0, 0.0]];
    let sides = corners.map(|corner| from(corner, [corner[0] - 9.0 * t, -9.0]));
    let edge = from(corners[0], corners[1]).min(sides[0]).min(sides[1]);
    let corner = corners.map(|[cx, cy]| (x - cx).hypot(y - cy));
    [edge, corner[0].min(corner[1])]
}

/// Above the end of the strip the branches of its sides are less than that of its end, but for a sliver where they hold and are
/// 16 times as steep: their zeros beside it are none of the function. Inside of the strip it is the end's branch that holds there,
/// which knows nothing of a side that is nearer: only the outer half of a line is asked for.
#[test]
fn corners_of_branches_have_no_spikes() {
    let Some(gpu) = suite() else { return };
    for (formula, t) in [
        ("max(8 (|x| - 1), y/2)", 0.0),
        ("max(max(8 (x - 0.4 y - 1), -8 (x - 0.4 y + 1)), y/2)", 0.4),
        ("-min(min(8 - 8 x - 6 y, 8 + 8 x + 6 y), -y/2)", -0.75),
    ] {
        let source = format!("show implicit({formula}) {{ fill = 0, ink = 0, line_width = 3 }}");
        let camera = camera([0.3, 0.2], 4.0);
        let picture = Picture::draw(&gpu, &source, camera);
        let paper = picture.linear(160, 5)[0];
        for (column, row) in (0..240).flat_map(|row| (0..320).map(move |column| (column, row))) {
            let point = camera.world(f64::from(column) + 0.5, f64::from(row) + 0.5);
            let [edge, corner] = from_half_strip(point, t).map(|d| d / camera.pixel());
            let covered = 1.0 - picture.linear(column, row)[0] / paper;
            let [x, y] = point;
            let is_outside = (x - t * y).abs() > 1.0 || y > 0.0;
            let is_line = is_outside && (0.6..0.9).contains(&edge) && corner > 5.0;
            let wrong = (edge > 3.0 && covered > 0.02) || (is_line && covered < 0.85);
            assert!(
                !wrong,
                "{formula}: {covered} at {column}, {row}, {edge} pixels away"
            );
        }
    }
}

// ------------------------------------------------------------------------------------------------------------------
// levels

#[test]
fn level_lines_have_their_place_and_width() {
    let Some(gpu) = suite() else { return };
    let circle: Field = |x, y| [x * x + y * y, 2.0 * x, 2.0 * y];
    let waves: Field = |x, y| {
        [
            x.sin() + (x * y).cos(),
            x.cos() - y * (x * y).sin(),
            -x * (x * y).sin(),
        ]
    };
    for (formula, field, camera, spacing) in [
        ("x² + y²", circle, camera([0.0; 2], 4.0), 1.0),
        ("x² + y²", circle, camera([0.6, 0.3], 4e-3), 1e-3),
        ("x² + y²", circle, camera([0.0; 2], 4e3), 1e6),
        ("sin(x) + cos(x y)", waves, camera([0.3, 0.2], 3.0), 0.5),
    ] {
        let source = |width: f64| {
            format!(
                "show levels({formula}) {{ ink = 0, palette = paper, major = 0, zero_width = 0, line_opacity = 1, spacing = {spacing}, line_width = {width} }}"
            )
        };
        let with = Picture::draw(&gpu, &source(3.0), camera);
        let without = Picture::draw(&gpu, &source(0.0), plain(camera));
        let contrast = Contrast {
            with: &with,
            without: &without,
            ink: [0.0; 3],
            strength: 1.0,
        };
        let level = |x: f64, y: f64| field(x, y).map(|v| v / spacing);
        let name = format!("levels, {formula}, height {}", camera.height);
        check_lines(&name, &contrast, 3.0, &crossings(camera, level, 60));
    }
}

// ------------------------------------------------------------------------------------------------------------------
// logcontours

/// log2 |f| in units of twice the finest spacing, where lines have their full weight; NaN where the finest spacing is about
/// to change. Spacing 8 pixels, two divisions, two octaves.
fn strong_level(field: Field, camera: Camera) -> impl Fn(f64, f64) -> [f64; 3] {
    move |x, y| {
        let [f, dx, dy] = field(x, y);
        let ln2 = std::f64::consts::LN_2;
        let (dx, dy) = (dx / f / ln2, dy / f / ln2);
        let place = (dx.hypot(dy) * camera.pixel() * 16.0).log2();
        if !place.is_finite() || (place - place.round()).abs() < 0.1 {
            return [f64::NAN; 3];
        }
        let unit = 2.0_f64.powi(place.ceil() as i32 + 1);
        [f.abs().log2() / unit, dx / unit, dy / unit]
    }
}

fn check_logarithm(gpu: &Gpu, name: &str, formula: &str, field: Field, camera: Camera) {
    let source = |opacity: f64| {
        format!(
            "show logcontours({formula}) {{ {PAPER}, palette = paper, line_opacity = {opacity}, divisions = 2, octaves = 2, spacing = 16 }}"
        )
    };
    let with = Picture::draw(gpu, &source(1.0), camera);
    let without = Picture::draw(gpu, &source(0.0), plain(camera));
    // finer lines are fainter: the scan takes what is darker than they can be
    let contrast = Contrast {
        with: &with,
        without: &without,
        ink: [0.0; 3],
        strength: 1.0,
    };
    check_lines(
        name,
        &contrast,
        3.0,
        &crossings(camera, strong_level(field, camera), 60),
    );
}

#[test]
fn logarithmic_lines_have_their_place_and_width() {
    let Some(gpu) = suite() else { return };
    let radius: Field = |x, y| [x * x + y * y, 2.0 * x, 2.0 * y];
    for (zoom, center) in [
        (1.0, [0.0; 2]),
        (1e3, [0.0; 2]),
        (1e-3, [0.0; 2]),
        (1e3, [0.6, 0.3]),
    ] {
        let name = format!("logcontours, x² + y² at zoom {zoom} around {center:?}");
        check_logarithm(&gpu, &name, "x² + y²", radius, camera(center, 4.0 / zoom));
    }
    let rational: Field = |x, y| {
        let (n, d) = (x * x - y * y - 1.0, x * x + y * y + x - 0.5);
        let f = n / d;
        [
            f,
            (2.0 * x - f * (2.0 * x + 1.0)) / d,
            (-2.0 * y - f * 2.0 * y) / d,
        ]
    };
    check_logarithm(
        &gpu,
        "logcontours, quotient",
        "(x² - y² - 1)/(x² + y² + x - 0.5)",
        rational,
        camera([0.3, 0.2], 6.0),
    );
    let steep: Field = |x, y| {
        [
            (20.0 * x + y).exp(),
            20.0 * (20.0 * x + y).exp(),
            (20.0 * x + y).exp(),
        ]
    };
    check_logarithm(
        &gpu,
        "logcontours, e^(20x + y)",
        "exp(20x + y)",
        steep,
        camera([0.0; 2], 3.0),
    );
}

/// The picture of a power of the radius is the same at zooms by powers of the period of its lines.
#[test]
fn logarithmic_lines_are_the_same_at_every_zoom() {
    let Some(gpu) = suite() else { return };
    let source = "show logcontours(x² + y²) { palette = paper }";
    let base = Picture::draw(&gpu, source, camera([0.0; 2], 4.0));
    // |f| changes by twice as many octaves, a multiple of 8, the longest spacing outside of the middle
    for zoom in [2.0_f64.powi(-12), 2.0_f64.powi(-20), 2.0_f64.powi(20)] {
        let other = Picture::draw(&gpu, source, camera([0.0; 2], 4.0 * zoom));
        let mut colours = std::collections::BTreeSet::new();
        for (column, row) in (0..320).flat_map(|c| (0..240).map(move |r| (c, r))) {
            if (f64::from(column) - 159.5).hypot(f64::from(row) - 119.5) < 24.0 {
                continue;
            }
            let (a, b) = (base.displayed(column, row), other.displayed(column, row));
            colours.insert(a[0] as u8);
            for k in 0..3 {
                assert!(
                    (a[k] - b[k]).abs() <= 2.0,
                    "zoom {zoom}: {a:?}, {b:?} at {column}, {row}"
                );
            }
        }
        assert!(colours.len() > 40, "{} colours", colours.len());
    }
}

// ------------------------------------------------------------------------------------------------------------------
// checker and grid

/// A complex function of z = x + iy: value, and rows of its Jacobian (re by x, y; im by x, y).
type Map = fn(f64, f64) -> [f64; 6];

fn square(x: f64, y: f64) -> [f64; 6] {
    [
        x * x - y * y,
        2.0 * x * y,
        2.0 * x,
        -2.0 * y,
        2.0 * y,
        2.0 * x,
    ]
}

/// z + conj(z)/2 + z conj(z) / 4: neither part is harmonic.
fn sheared(x: f64, y: f64) -> [f64; 6] {
    let q = (x * x + y * y) / 4.0;
    [1.5 * x + q, 0.5 * y, 1.5 + 0.5 * x, 0.5 * y, 0.0, 0.5]
}

fn sine(x: f64, y: f64) -> [f64; 6] {
    let (re, im) = (x.sin() * y.cosh(), x.cos() * y.sinh());
    let (dre, dim) = (x.cos() * y.cosh(), -x.sin() * y.sinh());
    [re, im, dre, -dim, dim, dre]
}

/// Levels of re f (part 0) or im f in units; NaN within twelve pixels of a line of the other part.
fn part_level(map: Map, unit: f64, part: usize, camera: Camera) -> impl Fn(f64, f64) -> [f64; 3] {
    move |x, y| {
        let all = map(x, y);
        let other = all[1 - part] / unit;
        let rate = all[4 - 2 * part].hypot(all[5 - 2 * part]) / unit * camera.pixel();
        if (other - other.round()).abs() < 12.0 * rate {
            return [f64::NAN; 3];
        }
        [
            all[part] / unit,
            all[2 + 2 * part] / unit,
            all[3 + 2 * part] / unit,
        ]
    }
}

#[test]
fn lines_of_the_board_have_their_place_and_width() {
    let Some(gpu) = suite() else { return };
    let cases: [(&str, Map, Camera, f64); 6] = [
        ("z²", square, camera([0.2, 0.1], 4.0), 1.0),
        ("z²", square, camera([0.7, 0.5], 4e-3), 2e-3),
        ("z²", square, camera([20.0, 10.0], 4e3), 1e6),
        (
            "z + conj(z)/2 + z conj(z)/4",
            sheared,
            camera([0.2, 0.1], 8.0),
            1.0,
        ),
        ("sin(z)", sine, camera([0.2, 0.1], 4.0), 0.5),
        ("sin(z)", sine, camera([0.4, 0.3], 4e-3), 2e-3),
    ];
    for (formula, map, camera, unit) in cases {
        let source = |width: f64| {
            format!(
                "f(z) = {formula}\nshow checker(f) {{ unit = {unit}, subdivision = 1, contrast = 0, ink = 0, line_opacity = 1, line_width = {width} }}"
            )
        };
        let with = Picture::draw(&gpu, &source(3.0), camera);
        let without = Picture::draw(&gpu, &source(0.0), plain(camera));
        let contrast = Contrast {
            with: &with,
            without: &without,
            ink: [0.0; 3],
            strength: 1.0,
        };
        for part in 0..2 {
            let name = format!("checker, {formula}, height {}, part {part}", camera.height);
            let found = crossings(camera, part_level(map, unit, part, camera), 40);
            check_lines(&name, &contrast, 3.0, &found);
        }
    }
}

/// Levels in units of the spacing whose lines have their full weight, of a coordinate with its gradient.
fn strong(
    level: impl Fn(f64, f64) -> [f64; 3],
    base: f64,
    camera: Camera,
) -> impl Fn(f64, f64) -> [f64; 3] {
    move |x, y| {
        let [u, dx, dy] = level(x, y);
        let place = (dx.hypot(dy) * camera.pixel() * 16.0).ln() / base.ln();
        if !place.is_finite() || (place - place.round()).abs() < 0.05 {
            return [f64::NAN; 3];
        }
        let unit = base.powi(place.ceil() as i32 + 1);
        [u / unit, dx / unit, dy / unit]
    }
}

#[test]
fn lines_of_the_grid_have_their_place_and_width() {
    let Some(gpu) = suite() else { return };
    let rectangular: [(&str, Map, Camera); 4] = [
        ("z²", square, camera([0.2, 0.1], 4.0)),
        ("z²", square, camera([0.7, 0.5], 4e-3)),
        ("z²", square, camera([20.0, 10.0], 4e3)),
        (
            "z + conj(z)/2 + z conj(z)/4",
            sheared,
            camera([0.2, 0.1], 6.0),
        ),
    ];
    let only = "phase = 0, light = 0, checker = 0, axes = 0, spacing = 16, divisions = 4, octaves = 2, ink = 0";
    for (formula, map, camera) in rectangular {
        for part in 0..2 {
            let strength = |s: f64| {
                let (first, second) = if part == 0 { (s, 0.0) } else { (0.0, s) };
                format!(
                    "f(z) = {formula}\nshow grid(f) {{ {only}, line_width = 3, first_lines = {first}, second_lines = {second} }}"
                )
            };
            let with = Picture::draw(&gpu, &strength(1.0), camera);
            let without = Picture::draw(&gpu, &strength(0.0), plain(camera));
            let contrast = Contrast {
                with: &with,
                without: &without,
                ink: [0.0; 3],
                strength: 1.0,
            };
            let level = |x: f64, y: f64| {
                let all = map(x, y);
                [all[part], all[2 + 2 * part], all[3 + 2 * part]]
            };
            let found = crossings(camera, strong(level, 4.0, camera), 40);
            let name = format!("grid, {formula}, height {}, part {part}", camera.height);
            check_lines(&name, &contrast, 3.0, &found);
        }
    }
}

#[test]
fn polar_lines_have_their_place_and_width() {
    let Some(gpu) = suite() else { return };
    let only = "shape = polar, phase = 0, light = 0, checker = 0, axes = 0, spacing = 16, divisions = 4, octaves = 2, ink = 0";
    let around: Field = |x, y| {
        let q = (x * x + y * y) * std::f64::consts::TAU;
        [y.atan2(x) / std::f64::consts::TAU, -y / q, x / q]
    };
    let outward: Field = |x, y| {
        let q = (x * x + y * y) * std::f64::consts::LN_2;
        [x.hypot(y).log2(), x / q, y / q]
    };
    for (part, field) in [outward, around].into_iter().enumerate() {
        for height in [4.0, 4e-3, 4e3] {
            let camera = camera([0.0, 0.0], height);
            let source = |s: f64| {
                let (first, second) = if part == 0 { (s, 0.0) } else { (0.0, s) };
                format!(
                    "f(z) = z\nshow grid(f) {{ {only}, line_width = 3, first_lines = {first}, second_lines = {second} }}"
                )
            };
            let with = Picture::draw(&gpu, &source(1.0), camera);
            let without = Picture::draw(&gpu, &source(0.0), plain(camera));
            let contrast = Contrast {
                with: &with,
                without: &without,
                ink: [0.0; 3],
                strength: 1.0,
            };
            let name = format!("grid, polar, part {part}, height {height}");
            check_lines(
                &name,
                &contrast,
                3.0,
                &crossings(camera, strong(field, 4.0, camera), 40),
            );
        }
    }
}

/// The picture of f(z) = z around the negative axis, where arg f jumps from π to -π, is the one around the imaginary axis,
/// where it does not, turned by a quarter: lines and cells divide the circle by multiples of four, but for the coarsest cells,
/// half circles, which are only in the middle. Hue has no step either.
#[test]
fn the_polar_grid_has_no_seam() {
    let Some(gpu) = suite() else { return };
    let layers = [
        "phase",
        "light",
        "checker",
        "first_lines",
        "second_lines",
        "axes",
    ];
    let side = 240;
    for shown in layers {
        let settings: Vec<String> = layers
            .iter()
            .map(|layer| format!("{layer} = {}", u8::from(*layer == shown)))
            .collect();
        let source = format!(
            "f(z) = z\nshow grid(f) {{ shape = polar, divisions = 4, {} }}",
            settings.join(", ")
        );
        let camera = Camera {
            center: [0.0; 2],
            height: 4.0,
            size: [side; 2],
            samples: 4,
        };
        let picture = Picture::draw(&gpu, &source, camera);
        let mut tones = std::collections::BTreeSet::new();
        for (column, row) in (0..70).flat_map(|c| (100..140).map(move |r| (c, r))) {
            let here = picture.displayed(column, row);
            // the axis of arg = π lies between rows 119 and 120
            let other = if shown == "phase" {
                picture.displayed(column, (row + 1).min(120))
            } else {
                // a quarter turn clockwise
                picture.displayed(side - 1 - row, column)
            };
            let most = (0..3)
                .map(|k| (here[k] - other[k]).abs())
                .fold(0.0, f64::max);
            let allowed = if shown == "phase" { 12.0 } else { 0.5 };
            if shown != "phase" || row == 119 {
                assert!(most <= allowed, "{shown}: {most} at {column}, {row}");
            }
            tones.insert(here[0] as u8);
        }
        // at least paper and one line, cell or hue
        assert!(tones.len() >= 2, "{shown}: {} tones", tones.len());
    }
}
