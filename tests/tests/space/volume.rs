//! `volume`: transmittance against closed forms, radiance against adaptive integration in f64, and the error against the
//! number of steps.

use pullback_runtime::Gpu;

use crate::camera::{Camera, Ray, Vec3, dot, unit};
use crate::colour::{Rgb, encoded};
use crate::drawing::{Picture, device, draw};

pub(super) const CAMERA: Camera = Camera {
    yaw: 32.0,
    pitch: 24.0,
    fov: 24.0,
    distance: 12.0,
    size: [96, 72],
};

/// Side of the blocks of pixels whose means are compared: 8 bits with their dither tell a mean of 36 well.
const BLOCK: u32 = 6;
/// Steps of a picture that says nothing.
const STEPS: u32 = 200;

/// A function, its density and how extinction grows with it. The colour scale is 1.
pub(super) struct Case {
    pub(super) formula: &'static str,
    value: fn(Vec3) -> f64,
    power: f64,
    density: f64,
}

pub(super) const CASES: [Case; 6] = [
    Case {
        formula: "0.5",
        value: |_| 0.5,
        power: 1.0,
        density: 1.2,
    },
    Case {
        formula: "2 exp(-(x^2 + y^2 + z^2)/0.5)",
        value: |p| 2.0 * (-dot(p, p) / 0.5).exp(),
        power: 1.0,
        density: 3.0,
    },
    Case {
        formula: "max(0, 1 - x^2 - y^2 - z^2)",
        value: |p| (1.0 - dot(p, p)).max(0.0),
        power: 1.0,
        density: 4.0,
    },
    Case {
        formula: "sin(3 x) cos(2 y) + z/2",
        value: |[x, y, z]| (3.0 * x).sin() * (2.0 * y).cos() + 0.5 * z,
        power: 2.0,
        density: 3.0,
    },
    Case {
        formula: "exp(-40 (√(x^2 + y^2 + z^2) - 1)^2)",
        value: |p| (-40.0 * (dot(p, p).sqrt() - 1.0).powi(2)).exp(),
        power: 1.0,
        density: 5.0,
    },
    Case {
        formula: "x^3 - 3 x y^2 + z",
        value: |[x, y, z]| x * x * x - 3.0 * x * y * y + z,
        power: 1.5,
        density: 0.5,
    },
];

pub(super) const POSITIVE: Rgb = [0.48, 0.4, 0.3];
pub(super) const NEGATIVE: Rgb = [0.3, 0.4, 0.48];

impl Case {
    pub(super) fn source(&self, steps: u32, more: &str) -> String {
        format!(
            "f(x, y, z) = {}\nshow volume(f) {{ color_scale = 1, power = {}, density = {}, core = 0, lighting = 0, \
             exposure = 1, tone = none, edge_width = 0, steps = {steps}, {more}, {} }}",
            self.formula,
            self.power,
            self.density,
            CAMERA.settings()
        )
    }

    /// Radiance and transmittance of a ray: dτ/dt = σ and dL/dt = c σ exp(-τ), integrated by Runge and Kutta's rule of
    /// order four with steps that are halved until they agree.
    pub(super) fn integrated(&self, ray: &Ray) -> (Rgb, f64) {
        let Some([near, far]) = ray.cube(2.0) else {
            return ([0.0; 3], 1.0);
        };
        let rate = |t: f64, y: [f64; 4]| {
            let value = (self.value)(ray.at(t));
            let x = value.abs();
            // the density is of half the side of the box, 2
            let extinction = 0.5 * self.density * x.powf(self.power);
            let colour = if value < 0.0 { NEGATIVE } else { POSITIVE };
            let emission = extinction * (-y[3]).exp() * 2.0 * x / (1.0 + x);
            [
                emission * colour[0],
                emission * colour[1],
                emission * colour[2],
                extinction,
            ]
        };
        let mut state = [0.0; 4];
        let mut t = near;
        let mut step = (far - near) / 64.0;
        while t < far {
            step = step.min(far - t);
            let whole = advance(&rate, t, state, step);
            let half = advance(&rate, t, state, 0.5 * step);
            let halves = advance(&rate, t + 0.5 * step, half, 0.5 * step);
            let error = (0..4)
                .map(|k| (whole[k] - halves[k]).abs())
                .fold(0.0, f64::max);
            if error > 1e-8 && step > 1e-6 {
                step *= 0.5;
                continue;
            }
            t += step;
            state = halves;
            step *= 1.6;
        }
        ([state[0], state[1], state[2]], (-state[3]).exp())
    }
}

/// A step of Runge and Kutta's rule of order four.
fn advance(rate: &impl Fn(f64, [f64; 4]) -> [f64; 4], t: f64, y: [f64; 4], h: f64) -> [f64; 4] {
    let along = |k: [f64; 4], part: f64| [0, 1, 2, 3].map(|j| y[j] + part * h * k[j]);
    let a = rate(t, y);
    let b = rate(t + 0.5 * h, along(a, 0.5));
    let c = rate(t + 0.5 * h, along(b, 0.5));
    let d = rate(t + h, along(c, 1.0));
    [0, 1, 2, 3].map(|j| y[j] + h / 6.0 * (a[j] + 2.0 * b[j] + 2.0 * c[j] + d[j]))
}

/// The greatest relative error of the linear light of a block of pixels, over blocks that are neither dark nor white.
fn worst(picture: &Picture, wanted: impl Fn(u32, u32) -> Rgb) -> f64 {
    let mut worst = 0.0f64;
    let mut count = 0;
    let [columns, rows] = CAMERA.size.map(|side| side / BLOCK);
    for block in 0..columns * rows {
        let (left, top) = (block % columns * BLOCK, block / columns * BLOCK);
        let mut sums = [[0.0; 2]; 3];
        let mut inside = [true; 3];
        for pixel in 0..BLOCK * BLOCK {
            let (x, y) = (left + pixel % BLOCK, top + pixel / BLOCK);
            let (found, linear) = (picture.srgb(x, y), wanted(x, y));
            for k in 0..3 {
                inside[k] &= linear[k] > 0.12 && linear[k] < 0.95;
                sums[k][0] += found[k];
                sums[k][1] += encoded(linear[k]);
            }
        }
        for k in (0..3).filter(|&k| inside[k]) {
            let [found, wanted] =
                sums[k].map(|s| crate::colour::decoded(s / f64::from(BLOCK * BLOCK)));
            worst = worst.max((found / wanted - 1.0).abs());
            count += 1;
        }
    }
    assert!(count >= 10, "{count} blocks");
    worst
}

fn centre(x: u32, y: u32) -> Ray {
    CAMERA.ray(f64::from(x) + 0.5, f64::from(y) + 0.5)
}

/// The radiance of every pixel by the reference; the picture has a black background.
fn radiances(case: &Case) -> Vec<Rgb> {
    let [width, height] = CAMERA.size;
    (0..width * height)
        .map(|k| case.integrated(&centre(k % width, k / width)).0)
        .collect()
}

fn error(gpu: &Gpu, case: &Case, steps: u32, jitter: f64, radiances: &[Rgb]) -> f64 {
    let text = |[r, g, b]: Rgb| format!("({r}, {g}, {b})");
    let more = format!(
        "background = (0, 0, 0), positive = {}, negative = {}, jitter = {jitter}",
        text(POSITIVE),
        text(NEGATIVE)
    );
    let picture = draw(gpu, &case.source(steps, &more), CAMERA.size, 1, 0.0);
    worst(&picture, |x, y| {
        radiances[(y * CAMERA.size[0] + x) as usize]
    })
}

/// Prints the table of docs/volumes.md.
#[test]
fn radiance_converges_to_the_integral() {
    let Some(gpu) = device() else { return };
    for case in &CASES {
        let truth = radiances(case);
        let counts = [12, 25, 50, 100, STEPS, 400];
        let errors = counts.map(|steps| error(&gpu, case, steps, 1.0, &truth));
        let percent: Vec<String> = errors.iter().map(|e| format!("{:.2}", 100.0 * e)).collect();
        println!("| `{}` | {} |", case.formula, percent.join(" | "));
        assert!(errors[4] < 0.01, "{}: {errors:?}", case.formula);
        assert!(errors[5] < 0.006, "{}: {errors:?}", case.formula);
        let even = error(&gpu, case, STEPS, 0.0, &truth);
        assert!(even < 0.01, "{}: {even} without jitter", case.formula);
    }
}

#[test]
fn the_opacity_of_a_step_is_right_for_any_length() {
    let Some(gpu) = device() else { return };
    let fog = &CASES[0];
    let truth = radiances(fog);
    for steps in [4, 8192] {
        let error = error(&gpu, fog, steps, 1.0, &truth);
        assert!(error < 0.004, "{steps} steps: {error}");
    }
}

/// Optical depth of a chord at a distance from the centre.
type Depth = fn(f64) -> f64;

/// The transmittance of a medium that emits nothing, in front of a white background, against its closed forms.
#[test]
fn transmittance_has_its_closed_forms() {
    let Some(gpu) = device() else { return };
    let forms: [(usize, Depth); 2] = [
        (1, |b| {
            2.0 * (0.5 * std::f64::consts::PI).sqrt() * (-b * b / 0.5).exp()
        }),
        (2, |b| 4.0 / 3.0 * (1.0 - b * b).max(0.0).powf(1.5)),
    ];
    for (case, depth) in forms {
        let case = &CASES[case];
        let dark = "background = (1, 1, 1), positive = (0, 0, 0), negative = (0, 0, 0)";
        let picture = draw(&gpu, &case.source(STEPS, dark), CAMERA.size, 1, 0.0);
        let error = worst(&picture, |x, y| {
            let ray = centre(x, y);
            let along = dot(ray.origin, ray.direction);
            let b = (dot(ray.origin, ray.origin) - along * along).sqrt();
            [(-0.5 * case.density * depth(b)).exp(); 3]
        });
        println!("{}: {:.2} %", case.formula, 100.0 * error);
        assert!(error < 0.01, "{}: {error}", case.formula);
    }
}

/// `volumecut` of a fog: what comes through tells how much of a ray is kept.
#[test]
fn a_cut_leaves_the_part_behind_its_plane() {
    let Some(gpu) = device() else { return };
    for (normal, position) in [
        ([1.0, 0.0, 0.0], 0.2),
        ([-1.0, 0.3, -0.5], -0.1),
        ([0.2, -1.0, -0.6], 0.1),
    ] {
        let [a, b, c] = normal;
        let source = format!(
            "f(x, y, z) = 0.5\nshow volumecut(f) {{ normal = ({a}, {b}, {c}), position = {position}, color_scale = 1, \
             power = 1, density = 1, positive = (0, 0, 0), core = 0, background = (1, 1, 1), edge_width = 0, cut_opacity = 0, \
             {} }}",
            CAMERA.settings()
        );
        let picture = draw(&gpu, &source, CAMERA.size, 1, 0.0);
        let n = unit(normal);
        let offset = position * n.iter().map(|c| 2.0 * c.abs()).sum::<f64>();
        let error = worst(&picture, |x, y| {
            let ray = centre(x, y);
            let Some([near, far]) = ray.cube(2.0) else {
                return [1.0; 3];
            };
            let t = ray.plane(n, offset);
            let kept = if dot(n, ray.direction) < 0.0 {
                far - near.max(t)
            } else {
                far.min(t) - near
            };
            [(-0.25 * kept.max(0.0)).exp(); 3]
        });
        assert!(error < 0.01, "{normal:?}: {error}");
    }
}

/// The colours on the cut are those of the values of its plane.
#[test]
fn the_cut_of_a_medium_has_the_values_of_its_plane() {
    let Some(gpu) = device() else { return };
    let source = format!(
        "f(x, y, z) = y + z\nshow volumecut(f) {{ normal = (1, 0.2, 0.4), position = 0.1, color_scale = 1, \
         positive = (1, 0, 0), negative = (0, 0, 1), density = 0, line_opacity = 0, zero_width = 0, cut_opacity = 1, \
         background = (0, 0, 0), edge_width = 0, {} }}",
        CAMERA.settings()
    );
    let picture = draw(&gpu, &source, CAMERA.size, 1, 0.0);
    let n = unit([1.0, 0.2, 0.4]);
    let offset = 0.1 * n.iter().map(|c| 2.0 * c.abs()).sum::<f64>();
    let mut seen = 0;
    for y in 0..CAMERA.size[1] {
        for x in 0..CAMERA.size[0] {
            let ray = centre(x, y);
            let p = ray.at(ray.plane(n, offset));
            let value = p[1] + p[2];
            // not at the border, nor where both colours share a pixel
            if p.iter().any(|c| c.abs() > 1.8) || value.abs() < 0.2 {
                continue;
            }
            let size = encoded(value.abs() / value.hypot(1.0));
            let wanted = if value > 0.0 {
                [size, 0.0, 0.0]
            } else {
                [0.0, 0.0, size]
            };
            for (c, w) in picture.srgb(x, y).into_iter().zip(wanted) {
                assert!((c - w).abs() < 2.0 / 255.0, "pixel {x}, {y}: {c}, not {w}");
            }
            seen += 1;
        }
    }
    assert!(seen > 200, "{seen}");
}

#[test]
fn signs_are_chosen_and_undefined_values_are_empty() {
    let Some(gpu) = device() else { return };
    let shown = |formula: &str, signs: &str| {
        let source = format!(
            "f(x, y, z) = {formula}\nshow volume(f) {{ signs = {signs}, background = (0, 0, 0), edge_width = 0, {} }}",
            CAMERA.settings()
        );
        let picture = draw(&gpu, &source, CAMERA.size, 1, 0.0);
        picture.srgb(CAMERA.size[0] / 2, CAMERA.size[1] / 2)
    };
    let [red, _, blue] = shown("1", "both");
    assert!(red > blue + 0.2);
    let [red, _, blue] = shown("-1", "both");
    assert!(blue > red + 0.2);
    for (formula, signs) in [
        ("1", "negative"),
        ("-1", "positive"),
        ("√(-1 - x²)", "both"),
        ("0", "both"),
    ] {
        let seen = shown(formula, signs);
        assert!(
            seen.iter().all(|c| *c < 2.0 / 255.0),
            "{formula}, {signs}: {seen:?}"
        );
    }
}
