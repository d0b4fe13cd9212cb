//! `scatter`: light that is scattered once, against closed forms and adaptive integration in f64.

use std::f64::consts::{PI, TAU};

use pullback_runtime::Gpu;

use crate::camera::{Camera, Ray, Vec3, dot};
use crate::colour::Rgb;
use crate::drawing::{device, draw_linear};

/// Half size of the box; coefficients are optical depths of this length.
const HALF: f64 = 2.0;
/// Of all pictures, so that no radiance is cut off.
const EXPOSURE: f64 = 0.2;

/// The ray of the pixel in the middle is along the x-axis.
const ALONG_X: Camera = Camera {
    yaw: 0.0,
    pitch: 0.0,
    fov: 4.0,
    distance: 12.0,
    size: [9, 9],
};

pub(super) const ASIDE: Camera = Camera {
    yaw: 32.0,
    pitch: 24.0,
    fov: 24.0,
    distance: 12.0,
    size: [16, 12],
};

/// A cloud and its light.
#[derive(Clone, Copy)]
pub(super) struct Case {
    pub(super) formula: &'static str,
    pub(super) density: fn(Vec3) -> f64,
    pub(super) absorption: Rgb,
    pub(super) scattering: Rgb,
    pub(super) g: f64,
    pub(super) light: Rgb,
    pub(super) ambient: Rgb,
    /// Degrees, yaw from that of the camera.
    pub(super) light_angles: [f64; 2],
}

const FOG: Case = Case {
    formula: "0.8",
    density: |_| 0.8,
    absorption: [0.1, 0.4, 0.0],
    scattering: [0.6, 1.5, 3.0],
    g: 0.4,
    light: [10.0, 8.0, 6.0],
    ambient: [0.0; 3],
    light_angles: [0.0, 0.0],
};

fn text([a, b, c]: Rgb) -> String {
    format!("({a}, {b}, {c})")
}

/// The phase function of Henyey and Greenstein (1941), per steradian.
fn phase_function(g: f64, cosine: f64) -> f64 {
    (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * cosine).powf(1.5))
}

/// The integral of f from a to b by Simpson's rule, halved until both halves agree with the whole.
pub(super) fn integral(f: &dyn Fn(f64) -> f64, a: f64, b: f64, tolerance: f64) -> f64 {
    let panels = 8;
    let width = (b - a) / f64::from(panels);
    (0..panels)
        .map(|k| {
            let (a, b) = (a + width * f64::from(k), a + width * f64::from(k + 1));
            let ends = [f(a), f(0.5 * (a + b)), f(b)];
            refined(f, [a, b], ends, tolerance / f64::from(panels), 20)
        })
        .sum()
}

fn refined(
    f: &dyn Fn(f64) -> f64,
    [a, b]: [f64; 2],
    [fa, fm, fb]: [f64; 3],
    tolerance: f64,
    depth: u32,
) -> f64 {
    let middle = 0.5 * (a + b);
    let (left, right) = (f(0.5 * (a + middle)), f(0.5 * (middle + b)));
    let whole = (b - a) / 6.0 * (fa + 4.0 * fm + fb);
    let halves = (b - a) / 12.0 * (fa + 4.0 * left + 2.0 * fm + 4.0 * right + fb);
    if depth == 0 || (whole - halves).abs() <= 15.0 * tolerance {
        return halves + (halves - whole) / 15.0;
    }
    refined(f, [a, middle], [fa, left, fm], 0.5 * tolerance, depth - 1)
        + refined(f, [middle, b], [fm, right, fb], 0.5 * tolerance, depth - 1)
}

impl Case {
    fn source(&self, camera: &Camera, more: &str) -> String {
        format!(
            "f(x, y, z) = {}\nshow scatter(f) {{ absorption = {}, scattering = {}, g = {}, light = {}, ambient = {}, \
             light_yaw = {}, light_pitch = {}, exposure = {EXPOSURE}, tone = none, edge_width = 0, \
             background = (0, 0, 0), backdrop = plain, {more}{} }}",
            self.formula,
            text(self.absorption),
            text(self.scattering),
            self.g,
            text(self.light),
            text(self.ambient),
            self.light_angles[0],
            self.light_angles[1],
            camera.settings()
        )
    }

    /// Radiance of each pixel as the scene draws it.
    pub(super) fn drawn(&self, gpu: &Gpu, camera: &Camera, more: &str) -> Vec<Rgb> {
        draw_linear(gpu, &self.source(camera, more), camera.size, 1)
            .into_iter()
            .map(|pixel| pixel.map(|c| c / EXPOSURE))
            .collect()
    }

    /// The pixel in the middle.
    fn middle(&self, gpu: &Gpu, camera: &Camera, more: &str) -> Rgb {
        let pixels = self.drawn(gpu, camera, more);
        pixels[pixels.len() / 2]
    }

    fn light_direction(&self, camera: &Camera) -> Vec3 {
        let yaw = (camera.yaw + self.light_angles[0]).to_radians();
        let pitch = self.light_angles[1].to_radians();
        [
            pitch.cos() * yaw.cos(),
            pitch.cos() * yaw.sin(),
            pitch.sin(),
        ]
    }

    /// Scattering and extinction per world unit of a channel.
    fn coefficients(&self, k: usize) -> [f64; 2] {
        [
            self.scattering[k] / HALF,
            (self.scattering[k] + self.absorption[k]) / HALF,
        ]
    }

    fn column(&self, ray: &Ray, from: f64, to: f64) -> f64 {
        integral(&|t| (self.density)(ray.at(t)).max(0.0), from, to, 1e-6)
    }

    /// Radiance of a ray in a channel:
    /// ∫ σ_s f (p E exp(-σ_t ∫ f to the light) + ambient) exp(-σ_t ∫ f to the eye) dt.
    pub(super) fn radiance(&self, camera: &Camera, ray: &Ray, k: usize) -> f64 {
        let Some([near, far]) = ray.cube(HALF) else {
            return 0.0;
        };
        let light = self.light_direction(camera);
        let direct = self.light[k] * phase_function(self.g, dot(light, ray.direction));
        let [scattering, extinction] = self.coefficients(k);
        let source = |t: f64| {
            let density = (self.density)(ray.at(t)).max(0.0);
            if density == 0.0 {
                return 0.0;
            }
            let way = Ray {
                origin: ray.at(t),
                direction: light,
            };
            let end = way.cube(HALF + 1e-9).map_or(0.0, |[_, end]| end);
            let sun = direct * (-extinction * self.column(&way, 0.0, end)).exp();
            let seen = (-extinction * self.column(ray, near, t)).exp();
            scattering * density * (sun + self.ambient[k]) * seen
        };
        integral(&source, near, far, 1e-5)
    }
}

/// Greatest relative difference.
fn apart(found: Rgb, wanted: Rgb) -> f64 {
    (0..3)
        .map(|k| (found[k] / wanted[k] - 1.0).abs())
        .fold(0.0, f64::max)
}

/// A uniform cube, 4 long, seen along an axis: with the light from above it is 2 to the light from everywhere; from
/// behind the eye as far as the ray has come; from ahead what remains.
#[test]
fn uniform_media_have_their_closed_forms() {
    let Some(gpu) = device() else { return };
    type Form = fn(f64) -> f64;
    let forms: [([f64; 2], f64, Form); 3] = [
        ([0.0, 90.0], 0.0, |s| {
            (-2.0 * s).exp() * (1.0 - (-4.0 * s).exp()) / s
        }),
        ([0.0, 0.0], -1.0, |s| (1.0 - (-8.0 * s).exp()) / (2.0 * s)),
        ([180.0, 0.0], 1.0, |s| 4.0 * (-4.0 * s).exp()),
    ];
    for (light_angles, cosine, form) in forms {
        let case = Case {
            light_angles,
            ..FOG
        };
        let wanted = [0, 1, 2].map(|k| {
            let [scattering, extinction] = case.coefficients(k).map(|c| 0.8 * c);
            scattering * case.light[k] * phase_function(case.g, cosine) * form(extinction)
        });
        for steps in [
            "",
            "steps = 4, light_steps = 1, ",
            "steps = 4096, light_steps = 7, jitter = 0, ",
        ] {
            let found = case.middle(&gpu, &ALONG_X, steps);
            let error = apart(found, wanted);
            println!("{light_angles:?} {steps}: {error:.1e}");
            assert!(
                error < 1e-3,
                "{light_angles:?}, {steps}: {found:?}, not {wanted:?}"
            );
        }
    }
}

/// Light from all around in a uniform medium: the albedo's part of what does not come through.
#[test]
fn ambient_light_has_its_closed_form() {
    let Some(gpu) = device() else { return };
    let case = Case {
        light: [0.0; 3],
        ambient: [0.5, 1.0, 2.0],
        ..FOG
    };
    let wanted = [0, 1, 2].map(|k| {
        let [scattering, extinction] = case.coefficients(k);
        case.ambient[k] * scattering / extinction * (1.0 - (-4.0 * 0.8 * extinction).exp())
    });
    let found = case.middle(&gpu, &ALONG_X, "");
    assert!(apart(found, wanted) < 1e-3, "{found:?}, not {wanted:?}");
}

/// Nodes and weights of Gauss' rule on -1..1: zeros of Legendre's polynomial by Newton's method.
fn gauss_rule(count: u32) -> Vec<[f64; 2]> {
    (0..count)
        .map(|k| {
            let n = f64::from(count);
            let mut x = (PI * (f64::from(k) + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..20 {
                let (mut before, mut value) = (1.0, x);
                for j in 2..=count {
                    let j = f64::from(j);
                    (before, value) = (
                        value,
                        ((2.0 * j - 1.0) * x * value - (j - 1.0) * before) / j,
                    );
                }
                slope = n * (x * value - before) / (x * x - 1.0);
                x -= value / slope;
            }
            [x, 2.0 / ((1.0 - x * x) * slope * slope)]
        })
        .collect()
}

/// The phase function as the shader has it, from pictures of a fog with light from many sides: its values, and that as
/// much light is scattered as there was.
#[test]
fn the_phase_function_sums_to_one() {
    let Some(gpu) = device() else { return };
    for g in [-0.6, 0.0, 0.7] {
        let mut sum = 0.0;
        for [cosine, weight] in gauss_rule(14) {
            let case = Case {
                g,
                // the ray is along -x
                light_angles: [(-cosine).acos().to_degrees(), 0.0],
                absorption: [0.1; 3],
                scattering: [0.4; 3],
                light: [10.0; 3],
                ..FOG
            };
            let [radiance, _, _] = case.middle(&gpu, &ALONG_X, "");
            let even = Case { g: 0.0, ..case };
            let ray = ALONG_X.ray(4.5, 4.5);
            let geometry = even.radiance(&ALONG_X, &ray, 0) * 4.0 * PI;
            let phase = radiance / geometry;
            let wanted = phase_function(g, cosine);
            assert!(
                (phase / wanted - 1.0).abs() < 2e-3,
                "g = {g}, cosine {cosine}: {phase}, not {wanted}"
            );
            sum += TAU * weight * phase;
        }
        println!("g = {g}: {sum}");
        assert!((sum - 1.0).abs() < 2e-3, "g = {g}: {sum}");
    }
}

pub(super) const HAZE: Case = Case {
    formula: "2 exp(-(x^2 + y^2 + z^2)/0.5)",
    density: |p| 2.0 * (-dot(p, p) / 0.5).exp(),
    absorption: [0.5, 1.0, 0.0],
    scattering: [3.0, 2.0, 6.0],
    g: 0.5,
    light: [12.0, 12.0, 12.0],
    ambient: [0.1, 0.2, 0.3],
    light_angles: [70.0, 30.0],
};

pub(super) const CASES: [Case; 4] = [
    Case {
        light_angles: [70.0, 30.0],
        ambient: [0.1; 3],
        ..FOG
    },
    HAZE,
    Case {
        formula: "1 - x^2 - y^2 - z^2",
        density: |p| 1.0 - dot(p, p),
        g: -0.3,
        light_angles: [-40.0, 50.0],
        ..HAZE
    },
    Case {
        formula: "sin(3 x) cos(2 y) + z/2",
        density: |[x, y, z]| (3.0 * x).sin() * (2.0 * y).cos() + 0.5 * z,
        light_angles: [160.0, 10.0],
        ..HAZE
    },
];

/// Greatest error of a pixel, as a part of the brightest of its channel.
pub(super) fn worst(found: &[Rgb], wanted: &[Rgb]) -> f64 {
    let mut worst = 0.0f64;
    for k in 0..3 {
        let brightest = wanted.iter().map(|p| p[k]).fold(0.0, f64::max);
        for (f, w) in found.iter().zip(wanted) {
            worst = worst.max((f[k] - w[k]).abs() / brightest);
        }
    }
    worst
}

/// Prints the table of docs/volumes.md.
#[test]
fn scattered_light_converges_to_the_integral() {
    let Some(gpu) = device() else { return };
    let [width, height] = ASIDE.size;
    for case in &CASES {
        let wanted: Vec<Rgb> = (0..width * height)
            .map(|k| {
                let (x, y) = (f64::from(k % width) + 0.5, f64::from(k / width) + 0.5);
                let ray = ASIDE.ray(x, y);
                [0, 1, 2].map(|k| case.radiance(&ASIDE, &ray, k))
            })
            .collect();
        let errors = [
            [12, 5],
            [25, 10],
            [50, 20],
            [128, 40],
            [200, 80],
            [400, 160],
        ]
        .map(|[steps, light_steps]| {
            let settings =
                format!("steps_by = samples, steps = {steps}, light_steps = {light_steps}, ");
            worst(&case.drawn(&gpu, &ASIDE, &settings), &wanted)
        });
        let percent: Vec<String> = errors.iter().map(|e| format!("{:.2}", 100.0 * e)).collect();
        println!("| `{}` | {} |", case.formula, percent.join(" | "));
        assert!(errors[3] < 0.01, "{}: {errors:?}", case.formula);
        assert!(errors[5] < 0.002, "{}: {errors:?}", case.formula);
        let even = worst(
            &case.drawn(&gpu, &ASIDE, "steps_by = samples, jitter = 0, "),
            &wanted,
        );
        assert!(even < 0.01, "{}: {even} without jitter", case.formula);
    }
}

/// What only absorbs lets through what `volume` lets through.
#[test]
fn without_scattering_it_is_the_transmittance_of_volume() {
    let Some(gpu) = device() else { return };
    let case = Case {
        absorption: [3.0; 3],
        scattering: [0.0; 3],
        ..HAZE
    };
    let white = "background = (1, 1, 1), edge_width = 0, steps = 150";
    let cloud = case
        .source(&ASIDE, "steps = 150, ")
        .replace("background = (0, 0, 0)", "background = (1, 1, 1)");
    let gas = format!(
        "f(x, y, z) = {}\nshow volume(f) {{ power = 1, color_scale = 1, density = 3, positive = (0, 0, 0), core = 0, \
         {white}, {} }}",
        case.formula,
        ASIDE.settings()
    );
    let [cloud, gas] = [cloud, gas].map(|source| draw_linear(&gpu, &source, ASIDE.size, 1));
    let through = |p: &&Rgb| p[0] < 0.9;
    assert!(gas.iter().filter(through).count() > 10);
    for (c, g) in cloud.iter().zip(&gas) {
        for k in 0..3 {
            assert!((c[k] - g[k]).abs() < 1e-5, "{c:?}, not {g:?}");
        }
    }
}

/// Undefined and negative densities are none; infinite ones are as the largest, of which the light from behind the eye
/// finds half of the albedo.
#[test]
fn clouds_are_empty_where_they_are_undefined_and_densest_where_they_are_infinite() {
    let Some(gpu) = device() else { return };
    let shown = |formula| Case { formula, ..FOG }.drawn(&gpu, &ALONG_X, "");
    for formula in ["√(-1 - x²)", "-1", "-1/(x - x + y - y)", "-1e38", "0"] {
        let pixels = shown(formula);
        assert!(
            pixels.iter().flatten().all(|c| *c < 1e-15),
            "{formula}: {pixels:?}"
        );
    }
    let wanted = [0, 1, 2].map(|k| {
        let [scattering, extinction] = FOG.coefficients(k);
        0.5 * scattering / extinction * FOG.light[k] * phase_function(FOG.g, -1.0)
    });
    for formula in ["1/(x - x + y - y)", "1e38", "1e3"] {
        for pixel in shown(formula) {
            let error = apart(pixel, wanted);
            assert!(error < 0.01, "{formula}: {pixel:?}, not {wanted:?}");
        }
    }
}

/// A ray that ends early leaves out next to nothing of what is behind, and of light, however bright it is.
#[test]
fn rays_end_where_nothing_more_is_seen() {
    let Some(gpu) = device() else { return };
    let black = Case {
        absorption: [12.0; 3],
        scattering: [0.0; 3],
        ..FOG
    };
    let white = black
        .source(&ALONG_X, "")
        .replace("background = (0, 0, 0)", "background = (1, 1, 1)");
    for pixel in draw_linear(&gpu, &white, ALONG_X.size, 1) {
        assert!(pixel.iter().all(|c| *c < 6e-4), "{pixel:?}");
    }
    // seen from behind the light most of it comes from far inside, and is as much as it takes to be seen
    let bright = Case {
        absorption: [0.0; 3],
        scattering: [16.0; 3],
        light: [1e6; 3],
        ambient: [0.0; 3],
        light_angles: [180.0, 0.0],
        ..FOG
    };
    let wanted = [0, 1, 2].map(|k| {
        let [scattering, _] = bright.coefficients(k).map(|c| 0.8 * c);
        bright.light[k]
            * phase_function(bright.g, 1.0)
            * scattering
            * 4.0
            * (-4.0 * scattering).exp()
    });
    let found = bright.middle(&gpu, &ALONG_X, "");
    assert!(wanted[0] > 1e-5);
    let left_out = EXPOSURE * (wanted[0] - found[0]).abs();
    assert!(left_out < 6e-4, "{found:?}, not {wanted:?}");
}

/// The samples of a pixel are the pixels of a larger picture: no loop ends before its time because of how many there are.
#[test]
fn supersamples_of_a_cloud_of_noise_are_whole() {
    let Some(gpu) = device() else { return };
    let gallery = include_str!("../../../docs/gallery/cloud.pull");
    let plain = "f(p: vec3) = 0.3 + fbm(1.5 p)\nshow scatter(f) { edge_width = 0 }";
    for source in [gallery, plain] {
        let [width, height] = [16, 12];
        let coarse = draw_linear(&gpu, source, [width, height], 2);
        let fine = draw_linear(&gpu, source, [2 * width, 2 * height], 1);
        for (k, found) in (0u32..).zip(&coarse) {
            let at = (4 * width * (k / width) + 2 * (k % width)) as usize;
            let row = 2 * width as usize;
            let four = [at, at + 1, at + row, at + row + 1];
            for channel in 0..3 {
                let wanted: f64 = four.iter().map(|&p| 0.25 * fine[p][channel]).sum();
                let error = (found[channel] - wanted).abs();
                assert!(error < 1e-4, "{source}, pixel {k}: {found:?}, not {wanted}");
            }
        }
    }
}
