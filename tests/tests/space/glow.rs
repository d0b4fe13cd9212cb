//! `glow`: the light of a ray against the integral of its emission in f64.

use crate::camera::{Camera, Ray, Vec3, dot};
use crate::colour::encoded;
use crate::drawing::{device, draw};

const CAMERA: Camera = Camera {
    yaw: 32.0,
    pitch: 24.0,
    fov: 24.0,
    distance: 12.0,
    size: [64, 48],
};

/// Half size of the box, and the width of the surface in it.
const HALF: f64 = 2.0;
const EPSILON: f64 = 0.05 * HALF;
const GAIN: f64 = 0.3;

/// A distance, and the formula that has it.
struct Case {
    formula: &'static str,
    estimate: &'static str,
    distance: fn(Vec3) -> f64,
}

const CASES: [Case; 4] = [
    Case {
        formula: "√(x^2 + y^2 + z^2) - 1",
        estimate: "value",
        distance: |p| dot(p, p).sqrt() - 1.0,
    },
    // by its gradient, of any height
    Case {
        formula: "1000 (x + 2 y - z/2)",
        estimate: "distance",
        distance: |[x, y, z]| (x + 2.0 * y - 0.5 * z) / 5.25f64.sqrt(),
    },
    Case {
        formula: "x^2 + y^2 + z^2 - 1",
        estimate: "distance",
        distance: |p| (dot(p, p) - 1.0) / (2.0 * dot(p, p).sqrt()),
    },
    Case {
        formula: "0.7",
        estimate: "value",
        distance: |_| 0.7,
    },
];

/// The integral of the emission over a ray's way through the box, by Simpson's rule with 1000 panels.
fn light(case: &Case, square: bool, ray: &Ray) -> f64 {
    let Some([near, far]) = ray.cube(HALF) else {
        return 0.0;
    };
    let emission = |t: f64| {
        let width = (case.distance)(ray.at(t)).abs() + EPSILON;
        if square {
            EPSILON / (width * width)
        } else {
            1.0 / width
        }
    };
    let panels = 1000;
    let h = (far - near) / f64::from(panels);
    let sum: f64 = (0..panels)
        .map(|k| {
            let t = near + f64::from(k) * h;
            emission(t) + 4.0 * emission(t + 0.5 * h) + emission(t + h)
        })
        .sum();
    GAIN * sum * h / 6.0
}

/// Narkowicz's curve.
fn filmic(c: f64) -> f64 {
    (c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14)).clamp(0.0, 1.0)
}

#[test]
fn the_light_of_a_ray_is_the_integral_of_its_emission() {
    let Some(gpu) = device() else { return };
    for case in &CASES {
        for falloff in ["square", "inverse"] {
            let source = format!(
                "f(x, y, z) = {}\nshow glow(f) {{ box = {HALF}, estimate = {}, falloff = {falloff}, epsilon = 0.05, \
                 gain = {GAIN}, hot = (1, 1, 1), body = (1, 1, 1), halo = (1, 1, 1), fade = 0, vignette = 0, \
                 background = (0, 0, 0), {} }}",
                case.formula,
                case.estimate,
                CAMERA.settings()
            );
            let picture = draw(&gpu, &source, CAMERA.size, 1, 0.0);
            let mut worst = 0.0f64;
            let mut seen = 0;
            for y in (0..CAMERA.size[1]).step_by(3) {
                for x in (0..CAMERA.size[0]).step_by(3) {
                    let ray = CAMERA.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
                    let wanted = filmic(light(case, falloff == "square", &ray));
                    let found = picture.linear(x, y)[1];
                    if wanted > 0.01 {
                        // less what 8 bits round
                        let step = crate::colour::decoded(encoded(wanted) + 1.0 / 255.0) - wanted;
                        worst = worst.max(((found - wanted).abs() - step) / wanted);
                        seen += 1;
                    }
                }
            }
            println!(
                "{}, {falloff}: {seen} pixels, {:.2} %",
                case.formula,
                100.0 * worst
            );
            assert!(seen > 80, "{}: {seen}", case.formula);
            assert!(worst < 0.01, "{}, {falloff}: {worst}", case.formula);
        }
    }
}

#[test]
fn what_is_undefined_emits_nothing() {
    let Some(gpu) = device() else { return };
    for formula in ["√(-1 - x²)", "1/(x - x)", "-1/(x - x)", "3"] {
        let source = format!(
            "f(x, y, z) = {formula}\nshow glow(f) {{ background = (0, 0, 0), {} }}",
            CAMERA.settings()
        );
        let picture = draw(&gpu, &source, CAMERA.size, 1, 0.0);
        for pixel in [[32, 24], [20, 20], [3, 3]] {
            assert!(
                picture.bytes(pixel[0], pixel[1]).iter().all(|b| *b < 2),
                "{formula}"
            );
        }
    }
}
