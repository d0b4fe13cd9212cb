//! Closed-form optical depths in `volume` and `scatter`: radiance against adaptive integration in f64, the error against the
//! number of steps beside that of samples, and what happens where there is no closed form.

use pullback_compiler::compile;
use pullback_compiler::lower::Precision;

use crate::camera::{Camera, Ray, Vec3, dot};
use crate::colour::Rgb;
use crate::drawing::{device, draw_linear};
use crate::scatter::{self, HAZE, integral};
use crate::volume::{self, CAMERA};

/// Greatest error of the radiance of a ray, as a part of it.
const BOUND: f64 = 1e-5;
/// Rays that pass less of the box are not judged: their ends are rounded.
const SHORTEST: f64 = 0.4;

/// World units: four roundings in single precision at the size of the box, however far away the camera is.
const MOVED: f64 = 4.0 * 1.2e-7;

/// The same box from 100 units away.
const FAR: Camera = Camera {
    distance: 100.0,
    fov: 3.2,
    ..CAMERA
};

/// A function, what it is in Rust, and the settings of its density.
struct Even {
    formula: &'static str,
    value: fn(Vec3) -> f64,
    power: f64,
    density: f64,
    signs: &'static str,
}

const fn even(
    formula: &'static str,
    value: fn(Vec3) -> f64,
    (power, density): (f64, f64),
    signs: &'static str,
) -> Even {
    Even {
        formula,
        value,
        power,
        density,
        signs,
    }
}

const EVEN: [Even; 12] = [
    even("0.5", |_| 0.5, (1.0, 1.2), "positive"),
    even("1e-6", |_| 1e-6, (1.0, 1.0), "positive"),
    even(
        "2 exp(-(x^2 + y^2 + z^2)/0.5)",
        |p| 2.0 * (-dot(p, p) / 0.5).exp(),
        (1.0, 3.0),
        "both",
    ),
    even(
        "1 - x^2 - y^2 - z^2",
        |p| 1.0 - dot(p, p),
        (1.0, 4.0),
        "positive",
    ),
    even(
        "1 - x^2 - y^2 - z^2",
        |p| 1.0 - dot(p, p),
        (1.0, 0.5),
        "both",
    ),
    even(
        "2 x^2 + y^2 + z^2 - 2",
        |[x, y, z]| 2.0 * x * x + y * y + z * z - 2.0,
        (2.0, 0.6),
        "negative",
    ),
    even(
        "sin(3 x) cos(2 y) + z/2",
        |[x, y, z]| (3.0 * x).sin() * (2.0 * y).cos() + 0.5 * z,
        (2.0, 1.5),
        "both",
    ),
    even(
        "x^3 - 3 x y^2 + z",
        |[x, y, z]| x * x * x - 3.0 * x * y * y + z,
        (2.0, 0.1),
        "both",
    ),
    even(
        "exp(-2.5 (z + 1))",
        |p| (-2.5 * (p[2] + 1.0)).exp(),
        (1.0, 0.5),
        "positive",
    ),
    even(
        "{ z < -1: 1, z < 0.5: 0.4 exp(-2 z), else: exp(-4 (z - 0.5)) }",
        |[_, _, z]| match z {
            z if z < -1.0 => 1.0,
            z if z < 0.5 => 0.4 * (-2.0 * z).exp(),
            z => (-4.0 * (z - 0.5)).exp(),
        },
        (1.0, 0.8),
        "positive",
    ),
    even(
        "0.1/(0.1 + x^2 + y^2 + z^2)",
        |p| 0.1 / (0.1 + dot(p, p)),
        (1.0, 2.0),
        "positive",
    ),
    even("z - x/2", |p| p[2] - 0.5 * p[0], (3.0, 0.2), "both"),
];

const COLOUR: Rgb = [0.9, 0.5, 0.2];

impl Even {
    fn source(&self, camera: &Camera, more: &str) -> String {
        let [r, g, b] = COLOUR;
        format!(
            "f(x, y, z) = {}\nshow volume(f) {{ color_scale = 0.8, power = {}, density = {}, signs = {}, \
             positive = ({r}, {g}, {b}), negative = ({r}, {g}, {b}), emission = even, exposure = 1, tone = none, \
             background = (0, 0, 0), edge_width = 0, {more}{} }}",
            self.formula,
            self.power,
            self.density,
            self.signs,
            camera.settings()
        )
    }

    fn depth(&self, ray: &Ray, [near, far]: [f64; 2]) -> f64 {
        let density = |t: f64| {
            let value = (self.value)(ray.at(t));
            let counts = match self.signs {
                "positive" => value > 0.0,
                "negative" => value < 0.0,
                _ => true,
            };
            let size = if counts { (value / 0.8).abs() } else { 0.0 };
            0.5 * self.density * size.powf(self.power)
        };
        let rough = integral(&density, near, far, 1e-4);
        integral(&density, near, far, 1e-8 * rough)
    }

    /// How far the optical depth changes with a ray that is moved by [`MOVED`].
    fn moved(&self, ray: &Ray, [near, far]: [f64; 2], depth: f64) -> f64 {
        let aside = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]].map(|axis| {
            let moved = Ray {
                origin: crate::camera::add(ray.origin, across(ray, axis), MOVED),
                ..*ray
            };
            (self.depth(&moved, [near, far]) - depth).abs()
        });
        let longer = self.depth(ray, [near - MOVED, near + MOVED])
            + self.depth(ray, [far - MOVED, far + MOVED]);
        aside[0] + aside[1] + 0.5 * longer
    }
}

/// A vector across the ray.
fn across(ray: &Ray, axis: Vec3) -> Vec3 {
    let along = dot(axis, ray.direction);
    crate::camera::unit(crate::camera::add(axis, ray.direction, -along))
}

/// The rays of every thirteenth pixel that pass enough of the box, with the places of the pixels.
fn rays(camera: &Camera) -> Vec<(usize, Ray, [f64; 2])> {
    let [width, height] = camera.size;
    (0..width * height)
        .step_by(13)
        .filter_map(|k| {
            let (x, y) = (f64::from(k % width) + 0.5, f64::from(k / width) + 0.5);
            let ray = camera.ray(x, y);
            let span = ray.cube(2.0)?;
            (span[1] - span[0] > SHORTEST).then_some((k as usize, ray, span))
        })
        .collect()
}

/// 1 - exp(-∫σ) times the colour, of the whole ray at once, from near and far.
#[test]
fn even_emission_is_the_closed_form_of_the_whole_ray() {
    let Some(gpu) = device() else { return };
    let views = [CAMERA, FAR];
    for (case, camera) in EVEN.iter().flat_map(|case| views.map(|view| (case, view))) {
        let pixels = draw_linear(&gpu, &case.source(&camera, ""), camera.size, 1);
        let mut worst = 0.0f64;
        for (k, ray, span) in rays(&camera) {
            let depth = case.depth(&ray, span);
            let opacity = -(-depth).exp_m1();
            let allowed = (-depth).exp() * case.moved(&ray, span, depth) / opacity;
            for (found, colour) in pixels[k].iter().zip(COLOUR) {
                let error = (found / (colour * opacity) - 1.0).abs();
                worst = worst.max(error - allowed);
            }
        }
        println!(
            "{}, {}, from {}: {worst:.1e}",
            case.formula, case.signs, camera.distance
        );
        assert!(
            worst < BOUND,
            "{} from {}: {worst:e}",
            case.formula,
            camera.distance
        );
    }
}

/// Prints the first table of docs/volumes.md on steps.
#[test]
fn steps_with_exact_depths_are_better_than_samples() {
    let Some(gpu) = device() else { return };
    let text = |[r, g, b]: Rgb| format!("({r}, {g}, {b})");
    let [width, height] = CAMERA.size;
    for case in volume::CASES.iter().take(4) {
        let truth: Vec<Rgb> = (0..width * height)
            .map(|k| {
                let (x, y) = (f64::from(k % width) + 0.5, f64::from(k / width) + 0.5);
                case.integrated(&CAMERA.ray(x, y)).0
            })
            .collect();
        let mut lines = Vec::new();
        for by in ["samples", "integral"] {
            let errors = [4, 8, 16, 32, 64, 128].map(|steps| {
                let more = format!(
                    "background = (0, 0, 0), positive = {}, negative = {}, steps_by = {by}",
                    text(volume::POSITIVE),
                    text(volume::NEGATIVE)
                );
                let found = draw_linear(&gpu, &case.source(steps, &more), CAMERA.size, 1);
                scatter::worst(&found, &truth)
            });
            let percent: Vec<String> = errors.iter().map(|e| format!("{:.3}", 100.0 * e)).collect();
            println!("| `{}` | {by} | {} |", case.formula, percent.join(" | "));
            lines.push(errors);
        }
        // half as many stretches have as many points; what ends a ray early is 0.0005
        for (k, by_samples) in lines[0].iter().enumerate().skip(3) {
            assert!(
                lines[1][k - 1] < by_samples + 6e-4,
                "{}: {lines:?}",
                case.formula
            );
        }
    }
}

/// The light from straight above, of which all ways end at the upper wall: the form for plane layers is exact. The fogs are thin, so
/// that no ray ends early.
#[test]
fn layers_of_fog_are_exact_in_any_number_of_steps() {
    let Some(gpu) = device() else { return };
    type Density = fn(Vec3) -> f64;
    let cases: [(&str, Density); 3] = [
        ("exp(-1.5 (z + 2))", |p| (-1.5 * (p[2] + 2.0)).exp()),
        ("{ z < -0.5: 1, z < 1: 0.3, else: 0 }", |p| match p[2] {
            z if z < -0.5 => 1.0,
            z if z < 1.0 => 0.3,
            _ => 0.0,
        }),
        ("(z - 2)^2/20", |p| 0.05 * (p[2] - 2.0).powi(2)),
    ];
    for (formula, density) in cases {
        let case = scatter::Case {
            formula,
            density,
            light_angles: [0.0, 90.0],
            ..HAZE
        };
        let [width, height] = scatter::ASIDE.size;
        let far = Camera {
            distance: 100.0,
            fov: scatter::ASIDE.fov * scatter::ASIDE.distance / 100.0,
            ..scatter::ASIDE
        };
        for (steps, camera) in [(4, scatter::ASIDE), (60, scatter::ASIDE), (4, far)] {
            let settings = format!("steps_by = integral, steps = {steps}, ");
            let found = case.drawn(&gpu, &camera, &settings);
            let brightest = found.iter().flatten().fold(0.0, |a: f64, b| a.max(*b));
            let mut worst = 0.0f64;
            for k in (0..width * height).step_by(3) {
                let (x, y) = (f64::from(k % width) + 0.5, f64::from(k / width) + 0.5);
                let ray = camera.ray(x, y);
                if ray.cube(2.0).is_none_or(|[a, b]| b - a < SHORTEST) {
                    continue;
                }
                for (channel, found) in found[k as usize].iter().enumerate() {
                    let wanted = case.radiance(&camera, &ray, channel);
                    worst = worst.max((found - wanted).abs() / brightest);
                }
            }
            println!(
                "{formula}, {steps} steps from {}: {worst:.1e}",
                camera.distance
            );
            // the integrals in f64 are good to 1e-5 of absolute depths
            assert!(worst < 3.0 * BOUND, "{formula}, {steps} steps: {worst:e}");
        }
    }
}

/// Prints the second table of docs/volumes.md on steps.
#[test]
fn light_by_columns_converges_faster_than_by_samples() {
    let Some(gpu) = device() else { return };
    let [width, height] = scatter::ASIDE.size;
    for case in &scatter::CASES {
        if case.formula.contains("sin") {
            // its positive part has no closed form
            continue;
        }
        let wanted: Vec<Rgb> = (0..width * height)
            .map(|k| {
                let (x, y) = (f64::from(k % width) + 0.5, f64::from(k / width) + 0.5);
                let ray = scatter::ASIDE.ray(x, y);
                [0, 1, 2].map(|k| case.radiance(&scatter::ASIDE, &ray, k))
            })
            .collect();
        let counts = [12, 25, 50, 128, 200, 400];
        let errors = counts.map(|steps| {
            let settings = format!("steps_by = integral, steps = {steps}, ");
            scatter::worst(&case.drawn(&gpu, &scatter::ASIDE, &settings), &wanted)
        });
        let percent: Vec<String> = errors.iter().map(|e| format!("{:.2}", 100.0 * e)).collect();
        println!("| `{}` | {} |", case.formula, percent.join(" | "));
        assert!(errors[3] < 0.003, "{}: {errors:?}", case.formula);
        assert!(errors[5] < 0.001, "{}: {errors:?}", case.formula);
    }
}

fn problem(source: &str) -> String {
    let compiled = compile(source);
    let program = compiled.program.expect("a program");
    let problems = program
        .scene_module(0, Precision::Accurate)
        .expect_err("no closed form");
    let [problem] = problems.as_slice() else {
        panic!("{problems:?}");
    };
    let place = problem.span.text(source);
    format!(
        "{}: {place}: {}",
        problem.code,
        problem.hint.clone().unwrap_or_default()
    )
}

#[test]
fn densities_without_a_closed_form_are_refused_with_their_place() {
    for (formula, scene, place) in [
        (
            "exp(-|p|) + 1",
            "scatter(f) { steps_by = integral }",
            "exp(-|p|)",
        ),
        (
            "0.2 + exp(sin(p.x))",
            "volume(f) { steps_by = integral, power = 1 }",
            "exp(sin(p.x))",
        ),
        ("fbm(p)", "volume(f) { steps_by = integral }", ""),
    ] {
        let found = problem(&format!("f(p: vec3) = {formula}\nshow {scene}"));
        assert!(found.starts_with("no-closed-form"), "{found}");
        assert!(found.contains(place), "{found}");
        assert!(found.contains("steps_by = samples"), "{found}");
    }
}

/// What has no closed form, and where that is no number, is drawn by samples.
#[test]
fn samples_stand_in_where_a_column_is_no_number() {
    let Some(gpu) = device() else { return };
    for (formula, settings) in [
        ("√x", "power = 1, signs = positive, emission = even"),
        (
            "exp(60 x + 60)",
            "power = 1, signs = positive, emission = even",
        ),
        ("fbm((x, y, z))", "signs = positive, emission = even"),
        (
            "1/(x - x + y - y)",
            "power = 1, signs = both, emission = even, negative = (1, 0.22, 0.02)",
        ),
    ] {
        let drawn = |by: &str| {
            let source = format!(
                "f(x, y, z) = {formula}\nshow volume(f) {{ color_scale = 1, {settings}, steps_by = {by}, edge_width = 0, {} }}",
                CAMERA.settings()
            );
            draw_linear(&gpu, &source, CAMERA.size, 1)
        };
        let (auto, samples) = (drawn("auto"), drawn("samples"));
        // samples are no measure of what rises that steeply
        let steep = formula.starts_with("exp");
        for (a, s) in auto.iter().zip(&samples) {
            for k in 0..3 {
                assert!(a[k].is_finite(), "{formula}: {a:?}");
                assert!(
                    steep || (a[k] - s[k]).abs() < 2e-2,
                    "{formula}: {a:?}, not {s:?}"
                );
            }
        }
    }
}

/// A setting that was compiled in and has another value now, as in an animation.
#[test]
fn columns_of_another_power_are_not_used() {
    let Some(gpu) = device() else { return };
    let source = |power: u32, by: &str| {
        format!(
            "f(x, y, z) = exp(-x^2 - y^2 - z^2)\nshow volume(f) {{ color_scale = 1, signs = positive, emission = even, \
             power = {power}, steps_by = {by}, {} }}",
            CAMERA.settings()
        )
    };
    let compiled = compile(&source(2, "auto")).program.expect("a program");
    let other = compile(&source(3, "auto")).program.expect("a program");
    let scene = compiled
        .scene_module(0, Precision::Accurate)
        .expect("a scene");
    let found = crate::drawing::draw_scene(&gpu, &scene, &other.pictures()[0], CAMERA.size);
    let wanted = draw_linear(&gpu, &source(3, "samples"), CAMERA.size, 1);
    for (f, w) in found.iter().zip(&wanted) {
        for k in 0..3 {
            assert!((f[k] - w[k]).abs() < 1e-6, "{f:?}, not {w:?}");
        }
    }
}
