//! Colours mean what the scenes say: stripes against quadrature of the Gaussian footprint, domain colours and the sphere's
//! read back to argument and modulus.

use std::f64::consts::TAU;

use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::pictures::{Camera, Picture, Random, apart, hue_and_value, turns};

// ------------------------------------------------------------------------------------------------------------------
// bands

/// ∫ φ over [a, b], φ the density of the normal distribution, by Simpson's rule.
fn normal_mass(a: f64, b: f64) -> f64 {
    let (a, b) = (a.max(-9.0), b.min(9.0));
    if a >= b {
        return 0.0;
    }
    let steps = 2 * ((b - a) / 0.05).ceil() as usize;
    let h = (b - a) / steps as f64;
    let density = |t: f64| (-0.5 * t * t).exp() / TAU.sqrt();
    let inner: f64 = (1..steps)
        .map(|k| density(a + k as f64 * h) * if k % 2 == 1 { 4.0 } else { 2.0 })
        .sum();
    (density(a) + inner + density(b)) * h / 3.0
}

/// The mean of the stripes around u under a footprint of standard deviation `spread`, both in stripes.
fn true_mean(colours: &[[f64; 3]], u: f64, spread: f64) -> [f64; 3] {
    let (first, last) = (
        (u - 9.0 * spread).floor() as i64,
        (u + 9.0 * spread).floor() as i64,
    );
    let mut sum = [0.0; 3];
    for k in first..=last {
        let mass = normal_mass((k as f64 - u) / spread, (k as f64 + 1.0 - u) / spread);
        let colour = colours[k.rem_euclid(colours.len() as i64) as usize];
        for (s, c) in sum.iter_mut().zip(colour) {
            *s += mass * c;
        }
    }
    sum
}

const OWN: [[f64; 3]; 4] = [
    [0.0, 0.2, 0.9],
    [1.0, 0.05, 0.3],
    [0.4, 0.9, 0.0],
    [0.02, 0.0, 0.1],
];

fn own_colours() -> String {
    let name =
        |(k, c): (usize, &[f64; 3])| format!("color_{} = ({}, {}, {})", k + 1, c[0], c[1], c[2]);
    OWN.iter()
        .enumerate()
        .map(name)
        .collect::<Vec<_>>()
        .join(", ")
}

/// One world unit a pixel.
fn strip(samples: u32) -> Camera {
    Camera {
        center: [0.0; 2],
        height: 24.0,
        size: [320, 24],
        samples,
    }
}

/// Of linear light, as the template states it: Φ is exact to 1.9e-5, and up to eight edges count at a time; edges beyond the reach
/// are off by 4.8e-5 on either side, which is more than what the harmonics that are left out, and the mean that stands for all, are.
const STEP: f64 = 8.0 * 1.9e-5 + 2.0 * 4.8e-5;

#[test]
fn stripes_are_the_mean_under_the_footprint() {
    let Some(gpu) = suite_gpu() else { return };
    let mut worst = 0.0_f64;
    for count in 2..=4 {
        // stripes per pixel along x; the gradient is twice as long along (3, 4)/5
        for rate in [0.003, 0.04, 0.21, 0.47, 0.93, 1.31, 2.2, 12.0] {
            for footprint in [0.5, 1.0] {
                let source = format!(
                    "show bands(({rate}) x + {}y + 0.3) {{ period = 1, count = {count}, footprint = {footprint}, {} }}",
                    rate * 4.0 / 3.0,
                    own_colours()
                );
                let picture = Picture::draw(&gpu, &source, strip(1));
                for column in (0..320).step_by(7) {
                    let [x, y] = picture.camera.world(f64::from(column) + 0.5, 7.5);
                    let u = rate * (x + 4.0 / 3.0 * y) + 0.3;
                    let spread = footprint * rate * 5.0 / 3.0;
                    let wanted = true_mean(&OWN[..count], u, spread);
                    let found = picture.linear(column, 7);
                    for k in 0..3 {
                        let off = (found[k] - wanted[k]).abs();
                        worst = worst.max(off);
                        assert!(
                            off <= STEP,
                            "{count} colours, {rate} a pixel, column {column}: {found:?}, not {wanted:?}"
                        );
                    }
                }
            }
        }
    }
    println!("off by at most {worst:.1e} of 1");
}

/// Where the rings of a zone plate are nearly as fine as pixels they would come back as slow ones, from the mean of a few
/// samples, too: a box lets a part of sin(π f)/(π f) through, the Gaussian exp(-2 (π f/2)²) of that.
#[test]
fn stripes_as_fine_as_pixels_leave_no_rings() {
    let Some(gpu) = suite_gpu() else { return };
    let source = "show bands(x^2 + y^2) { period = 0.2 }";
    for samples in [1, 2, 4] {
        let camera = Camera {
            center: [0.0; 2],
            height: 12.0,
            size: [300, 225],
            samples,
        };
        let picture = Picture::draw(&gpu, source, camera);
        let mean = picture.linear(0, 112);
        let mut worst = 0.0_f64;
        for row in 0..225 {
            for column in 0..300 {
                let [x, y] = camera.world(f64::from(column) + 0.5, f64::from(row) + 0.5);
                // cycles of four stripes in a pixel
                let fineness = 2.0 * x.hypot(y) * camera.pixel() / 0.8;
                if fineness > 0.8 {
                    let found = picture.linear(column, row);
                    let off = (0..3)
                        .map(|k| (found[k] - mean[k]).abs())
                        .fold(0.0, f64::max);
                    worst = worst.max(off);
                }
            }
        }
        println!("{samples} samples: {worst:.4}");
        assert!(worst < 0.025, "{samples} samples: rings of {worst}");
    }
}

/// The colours of the other palettes are those that constants have; they, too, give way to their mean.
#[test]
fn stripes_of_every_palette_fade_to_their_mean() {
    let Some(gpu) = suite_gpu() else { return };
    for (palette, count) in [
        ("sequential", 8),
        ("diverging", 5),
        ("wheel", 8),
        ("wheel", 3),
    ] {
        let draw = |formula: String| {
            let source = format!(
                "show bands({formula}) {{ period = 1, count = {count}, palette = {palette} }}"
            );
            Picture::draw(&gpu, &source, strip(1))
        };
        let colours: Vec<[f64; 3]> = (0..count)
            .map(|k| draw(format!("{k} + 0.5")).linear(100, 10))
            .collect();
        let mut distinct: Vec<_> = colours
            .iter()
            .map(|c| c.map(|x| (x * 1e3) as i64))
            .collect();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), count, "{palette}");
        for rate in [0.05, 0.6, 9.0] {
            let picture = draw(format!("{rate} x"));
            for column in (0..320).step_by(7) {
                let [x, _] = picture.camera.world(f64::from(column) + 0.5, 7.5);
                let wanted = true_mean(&colours, rate * x, 0.5 * rate);
                let found = picture.linear(column, 7);
                for k in 0..3 {
                    let off = (found[k] - wanted[k]).abs();
                    assert!(off <= STEP, "{palette}, {rate}: {found:?}, not {wanted:?}");
                }
            }
        }
    }
}

/// The stripe below zero has the last colour, however near to zero it is, and edges belong to the stripe above.
#[test]
fn constants_have_the_colour_of_their_stripe() {
    let Some(gpu) = suite_gpu() else { return };
    for (value, index) in [
        ("-1e-9", 3),
        ("0", 0),
        ("1e-9", 0),
        ("-1", 3),
        ("-1.0000001", 2),
        ("3", 3),
        ("4", 0),
        ("-4", 0),
        ("-400000.5", 3),
    ] {
        let source = format!("show bands({value}) {{ period = 1, {} }}", own_colours());
        let found = Picture::draw(&gpu, &source, strip(1)).linear(30, 9);
        for k in 0..3 {
            let wanted = OWN[index][k];
            assert!(
                (found[k] - wanted).abs() <= STEP,
                "{value}: {found:?}, not colour {index}"
            );
        }
    }
}

// ------------------------------------------------------------------------------------------------------------------
// domain and sphere

type Complex = [f64; 2];
/// A complex function.
type Map = fn(Complex) -> Complex;

fn mul(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn div(a: Complex, b: Complex) -> Complex {
    let q = b[0] * b[0] + b[1] * b[1];
    let n = mul(a, [b[0], -b[1]]);
    [n[0] / q, n[1] / q]
}

fn identity(z: Complex) -> Complex {
    z
}

/// (z² - 1)/(z + i)
fn rational(z: Complex) -> Complex {
    let s = mul(z, z);
    div([s[0] - 1.0, s[1]], [z[0], z[1] + 1.0])
}

/// conj(z)² + 1/z
fn dipole(z: Complex) -> Complex {
    let (s, r) = (mul([z[0], -z[1]], [z[0], -z[1]]), div([1.0, 0.0], z));
    [s[0] + r[0], s[1] + r[1]]
}

/// z (2z⁵ + 3)/(3z⁵ + 2), twice
fn halley(z: Complex) -> Complex {
    (0..2).fold(z, |z, _| {
        let p = mul(mul(mul(z, z), mul(z, z)), z);
        mul(
            z,
            div(
                [2.0 * p[0] + 3.0, 2.0 * p[1]],
                [3.0 * p[0] + 2.0, 3.0 * p[1]],
            ),
        )
    })
}

/// Rings of steps, HSV hues, and as good as no shading of zeros and poles.
const READABLE: &str =
    "palette = hsv, rings = steps, ring_depth = 0.35, ring_octaves = 1, fade_octaves = 1000000";

/// Argument in turns and fraction of log2 |f| of a colour drawn by `READABLE`. What is left of the shading of zeros and poles
/// at |f| near 1 is 0.88/65 of black and of white.
fn read_back(colour: [f64; 3]) -> (f64, f64) {
    let rest = 0.88 / 65.0;
    let plain = colour.map(|c| ((c - rest) / (1.0 - rest) / (1.0 - rest)).max(0.0));
    let (hue, light) = hue_and_value(plain);
    (hue, 1.0 - (1.0 - light) / 0.35)
}

/// How far a picture is from the truth at a pixel: turns, and octaves. `None` next to a ring's edge or where hue or
/// modulus change fast (`step`: the greatest change of log f to the neighbouring pixels).
fn errors(colour: [f64; 3], value: Complex, step: f64) -> Option<(f64, f64)> {
    let octaves = value[0].hypot(value[1]).log2();
    let fraction = octaves.rem_euclid(1.0);
    if step > 0.1 || fraction < 2.0 * step || fraction > 1.0 - 2.0 * step {
        return None;
    }
    let (hue, found) = read_back(colour);
    Some((apart(hue, turns(value)), (found - fraction).abs()))
}

/// |log f(a) - log f(b)|, in the greater of octaves and radians.
fn log_step(a: Complex, b: Complex) -> f64 {
    let q = div(a, b);
    q[0].hypot(q[1]).log2().abs().max((q[1].atan2(q[0])).abs())
}

/// Bounds on what is read back, in turns and octaves: the shader's colours are in f32, and a hundredth of a step of 8 bits.
const TURNS: f64 = 2e-5;
const OCTAVES: f64 = 2e-4;

#[test]
fn domain_colours_are_argument_and_modulus() {
    let Some(gpu) = suite_gpu() else { return };
    let cases: [(&str, Map); 4] = [
        ("z", identity),
        ("(z^2 - 1)/(z + i)", rational),
        ("conj(z)^2 + 1/z", dipole),
        ("iterate(2, w = z, w (2w⁵ + 3)/(3w⁵ + 2))", halley),
    ];
    for (formula, f) in cases {
        for height in [3.0, 0.02] {
            let camera = Camera {
                center: [0.4, 0.3],
                height,
                size: [160, 120],
                samples: 1,
            };
            let source = format!("f(z) = {formula}\nshow domain(f) {{ {READABLE} }}");
            let picture = Picture::draw(&gpu, &source, camera);
            let mut random = Random::default();
            let mut judged = 0;
            for _ in 0..600 {
                let (column, row) = (random.between(0, 160), random.between(0, 120));
                let at = |dx: f64, dy: f64| {
                    f(camera.world(f64::from(column) + 0.5 + dx, f64::from(row) + 0.5 + dy))
                };
                let here = at(0.0, 0.0);
                let step = log_step(here, at(1.0, 0.0)).max(log_step(here, at(0.0, 1.0)));
                let Some((turn, octave)) = errors(picture.linear(column, row), here, step) else {
                    continue;
                };
                judged += 1;
                assert!(
                    turn <= TURNS && octave <= OCTAVES,
                    "{formula} at {column}, {row}: off by {turn} turns, {octave} octaves"
                );
            }
            assert!(judged > 200, "{formula}: {judged} pixels");
        }
    }
}

/// The coordinate that the sphere shows at a place of the picture's plane, by the definition in the settings, and whether
/// it is in the southern chart.
struct Globe {
    yaw: f64,
    pitch: f64,
    rotation: [f64; 3],
}

impl Globe {
    fn point(&self, [x, y]: [f64; 2]) -> Option<[f64; 3]> {
        let depth = (1.0 - x * x - y * y).max(-1.0);
        if depth < 0.12 {
            return None;
        }
        let depth = depth.sqrt();
        let ((sy, cy), (sp, cp)) = (
            self.yaw.to_radians().sin_cos(),
            self.pitch.to_radians().sin_cos(),
        );
        let (right, up, back) = (
            [-sy, cy, 0.0],
            [-sp * cy, -sp * sy, cp],
            [cp * cy, cp * sy, sp],
        );
        let mut p = [0, 1, 2].map(|k| x * right[k] + y * up[k] + depth * back[k]);
        // undo the rotations, the last one first
        for axis in [2, 1, 0] {
            let (s, c) = (-self.rotation[axis]).to_radians().sin_cos();
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            (p[i], p[j]) = (p[i] * c - p[j] * s, p[i] * s + p[j] * c);
        }
        Some(p)
    }

    fn coordinate(&self, at: [f64; 2]) -> Option<(Complex, bool)> {
        let [x, y, z] = self.point(at)?;
        Some((div([x, y], [1.0 + z, 0.0]), z < 0.0))
    }
}

#[test]
fn the_sphere_s_colours_are_argument_and_modulus_in_both_charts() {
    let Some(gpu) = suite_gpu() else { return };
    let cases: [(&str, Map); 4] = [
        ("z", identity),
        ("(z^2 - 1)/(z + i)", rational),
        ("conj(z)^2 + 1/z", dipole),
        ("iterate(2, w = z, w (2w⁵ + 3)/(3w⁵ + 2))", halley),
    ];
    let globes = [
        Globe {
            yaw: 20.0,
            pitch: 0.0,
            rotation: [0.0; 3],
        },
        Globe {
            yaw: -130.0,
            pitch: 35.0,
            rotation: [40.0, 110.0, -25.0],
        },
    ];
    for (formula, f) in cases {
        for globe in &globes {
            let [a, b, c] = globe.rotation;
            let source = format!(
                "f(z) = {formula}\nshow sphere(f) {{ {READABLE}, light = 0, graticule = 0, yaw = {}, pitch = {}, rotation = ({a}, {b}, {c}) }}",
                globe.yaw, globe.pitch
            );
            let camera = Camera {
                center: [0.0; 2],
                height: 2.3,
                size: [220, 180],
                samples: 1,
            };
            let picture = Picture::draw(&gpu, &source, camera);
            let mut random = Random::default();
            let (mut north, mut south, mut border) = (0, 0, 0);
            for _ in 0..3000 {
                let (column, row) = (random.between(0, 219), random.between(0, 179));
                let at = |dx: f64, dy: f64| {
                    globe.coordinate(
                        camera.world(f64::from(column) + 0.5 + dx, f64::from(row) + 0.5 + dy),
                    )
                };
                let (Some((z, below)), Some((right, _)), Some((down, _))) =
                    (at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0))
                else {
                    continue;
                };
                let here = f(z);
                let step = log_step(here, f(right)).max(log_step(here, f(down)));
                let Some((turn, octave)) = errors(picture.linear(column, row), here, step) else {
                    continue;
                };
                *(if below { &mut south } else { &mut north }) += 1;
                border += i32::from((z[0].hypot(z[1]) - 1.0).abs() < 0.1);
                assert!(
                    turn <= TURNS && octave <= OCTAVES,
                    "{formula} at z = {z:?}: off by {turn} turns, {octave} octaves"
                );
            }
            assert!(
                north > 60 && south > 60 && border > 15,
                "{formula}: {north}, {south}, {border} pixels"
            );
        }
    }
}

/// Deep in a zoom at infinity, where z and its powers overflow, rational functions have their limits.
#[test]
fn infinity_is_as_good_as_zero() {
    let Some(gpu) = suite_gpu() else { return };
    let draw_with = |formula: &str, height: f64, settings: &str| {
        let source = format!(
            "f(z) = {formula}\nshow sphere(f) {{ {settings}, light = 0, graticule = 0, pitch = -90, yaw = -90 }}"
        );
        let camera = Camera {
            center: [0.0; 2],
            height,
            // the middle of the middle pixel is the pole
            size: [31, 31],
            samples: 1,
        };
        Picture::draw(&gpu, &source, camera)
    };
    let draw = |formula: &str, height: f64| draw_with(formula, height, READABLE);
    let limits: [(&str, Complex); 4] = [
        ("(3z^2 - 1)/(2z^2 + i)", [1.5, 0.0]),
        ("1.3i z^40/(z^40 - 3)", [0.0, 1.3]),
        ("(z - (z^3 - 1)/(3z^2))/z - 2", [-4.0 / 3.0, 0.0]),
        (
            "iterate(3, w = z, w (2w⁵ + 3)/(3w⁵ + 2))/z + 1",
            [1.0 + 8.0 / 27.0, 0.0],
        ),
    ];
    for (formula, limit) in limits {
        for height in [1e-3, 1e-6, 1e-12] {
            let picture = draw(formula, height);
            for (column, row) in [(15, 15), (0, 0), (22, 7), (30, 12)] {
                let errors = errors(picture.linear(column, row), limit, 0.01);
                let Some((turn, octave)) = errors else {
                    panic!("{formula}: a ring's edge");
                };
                assert!(
                    turn <= TURNS && octave <= OCTAVES,
                    "{formula}, height {height}, {column}, {row}: {turn}, {octave}"
                );
            }
        }
    }
    // two pixels beside a zero it is as dark, and beside a pole as light, as it gets
    let middle =
        |formula: &str| draw_with(formula, 0.05, "ring_depth = 0, fade_octaves = 1").linear(17, 15);
    for zero in ["1/z", "(z - 1)/(z^3 + 1)"] {
        assert!(middle(zero).iter().all(|c| *c <= 0.125), "{zero}");
    }
    for pole in ["z", "z^3 + 2z"] {
        assert!(middle(pole).iter().all(|c| *c >= 0.87), "{pole}");
    }
}
