//! Cameras: where known points are seen, which rays are parallel, and how fast a value changes from pixel to pixel.

use pullback_compiler::lower::Precision;
use pullback_runtime::executor::{Arithmetic, Event, Painter, Shown, SiteKind, Watched};
use pullback_runtime::{Frame, Pipeline, Size, View};

use crate::camera::{Ray, Vec3, add, dot};

const SIZE: Size = Size {
    width: 320,
    height: 240,
};

const POINTS: [Vec3; 6] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.5, -1.25, 0.5],
    [-2.0, 2.0, -2.0],
];

/// Settings, and the pixels at which the points are seen by matrices of view and projection of four dimensions, as OpenGL
/// 2.1 defines them (`gluLookAt`, `gluPerspective`, `glOrtho`), computed by another program (Python, numpy).
#[rustfmt::skip]
const SEEN: [(&str, [[f64; 2]; 6]); 8] = [
    (
        "yaw = 32, pitch = 24, fov = 28, distance = 12",
        [[160.000000, 120.000000], [137.279226, 134.789286], [195.443205, 129.008148], [160.000000, 82.074209], [80.569672, 111.059133], [259.025116, 176.351570]],
    ),
    (
        "yaw = -140, pitch = -35, fov = 60, distance = 7, center = (0.5, -0.25, 1)",
        [[142.927599, 143.021441], [163.928456, 154.208934], [120.739821, 152.548846], [144.363870, 116.112480], [202.972204, 134.649297], [18.587411, 212.923241]],
    ),
    (
        "camera = look_at, eye = (7, -3, 5), aim = (0.5, 0.25, -0.5), fov = 40",
        [[143.760791, 98.172778], [160.000000, 117.582867], [175.625518, 89.568015], [142.604601, 65.602775], [119.394310, 126.683065], [171.865736, 103.400219]],
    ),
    (
        "camera = look_at, eye = (0, 0, 9), up = (0, 1, 0), fov = 35",
        [[160.000000, 120.000000], [202.287931, 120.000000], [160.000000, 77.712069], [160.000000, 120.000000], [227.163184, 175.969320], [90.801568, 50.801568]],
    ),
    (
        "camera = look_at, eye = (-5, 4, 3), aim = (1, 0, 0), up = (1, 2, 3), fov = 50",
        [[168.098604, 141.948141], [160.000000, 120.000000], [138.165527, 129.132351], [191.408049, 115.795821], [194.369078, 114.226532], [58.602838, 241.711652]],
    ),
    (
        "projection = orthographic, yaw = 45, pitch = 30, extent = 6",
        [[160.000000, 120.000000], [131.715729, 134.142136], [188.284271, 134.142136], [160.000000, 85.358984], [82.218254, 106.215026], [273.137085, 189.282032]],
    ),
    (
        "projection = orthographic, camera = look_at, eye = (3, -8, 6), aim = (0, 1, 0), up = (1, 0, 1), extent = 9",
        [[166.117753, 134.715344], [184.471012, 116.729924], [160.000000, 120.000000], [147.764494, 121.635038], [192.118203, 119.591240], [153.882247, 167.416109]],
    ),
    (
        "projection = orthographic, yaw = 0, pitch = 0",
        [[160.000000, 120.000000], [160.000000, 120.000000], [195.347976, 120.000000], [160.000000, 84.652024], [115.815030, 102.326012], [230.695951, 190.695951]],
    ),
];

/// A ray of a sight, the way the camera looks, and what a pixel spans.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Sight {
    origin: Vec3,
    direction: Vec3,
    forward: Vec3,
    slope: f64,
    parallel: bool,
}

/// What `sight_at` and `screen_rate` gave at a pixel.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    sight: Sight,
    /// Distance, normal and gradient that a rate was asked for, and the rate; the first in the picture.
    rate: Option<(f64, Vec3, Vec3, f64)>,
    asked: Option<(f64, Vec3, Vec3)>,
}

fn numbers(event: &Event) -> Vec<f64> {
    let number = |shown: &Shown| match *shown {
        Shown::Real(x) => x,
        Shown::Truth(truth) => f64::from(u8::from(truth)),
        Shown::Integer(n) => n as f64,
    };
    event.values.iter().map(number).collect()
}

fn vector(values: &[f64]) -> Vec3 {
    [values[0], values[1], values[2]]
}

fn observe(seen: &mut [Seen], lane: usize, event: &Event) {
    let seen = &mut seen[lane];
    match (event.site.function_name.as_str(), event.site.kind) {
        ("sight_at", SiteKind::Leave) => {
            let v = numbers(event);
            assert_eq!(v.len(), 12, "ray, forward, slope, parallel, before");
            seen.sight = Sight {
                origin: vector(&v),
                direction: vector(&v[3..]),
                forward: vector(&v[6..]),
                slope: v[9],
                parallel: v[10] > 0.5,
            };
        }
        ("screen_rate", SiteKind::Enter) => {
            let v = numbers(event);
            assert_eq!(v.len(), 19, "sight, t, n, gradient");
            seen.asked = Some((v[12], vector(&v[13..]), vector(&v[16..])));
        }
        ("screen_rate", SiteKind::Leave) => {
            if let (Some((t, n, gradient)), None) = (seen.asked, seen.rate) {
                seen.rate = Some((t, n, gradient, numbers(event)[0]));
            }
        }
        _ => {}
    }
}

/// What a picture of a program sees at some pixels, in exact float32.
fn seen(source: &str, pixels: &[[f64; 2]]) -> Vec<Seen> {
    let compiled = pullback_compiler::compile(source);
    let program = compiled
        .program
        .unwrap_or_else(|| panic!("{source}: {:?}", compiled.diagnostics));
    let scene = program
        .scene_module(0, Precision::Accurate)
        .expect("a scene");
    let settings = &program.pictures()[0].settings;
    let frame = Frame {
        view: View {
            center: [0.0; 2],
            height: 2.0,
        },
        params: &[],
        settings: &scene.pack_settings(settings),
        size: SIZE,
        samples: 1,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let painter =
        Painter::watched(&scene, Arithmetic::Ieee32, Watched::Everything).expect("a painter");
    let mut found = vec![Seen::default(); pixels.len()];
    let mut observer = |lane: usize, event: &Event| observe(&mut found, lane, event);
    painter
        .trace(&frame, settings, pixels, &mut observer)
        .expect("colours");
    found
}

#[test]
fn points_are_seen_where_they_are_projected() {
    for scene in ["slices", "surface", "glow"] {
        for (settings, expected) in SEEN {
            let source = format!("f(x, y, z) = x + y + z\nshow {scene}(f) {{ {settings} }}");
            for (point, seen) in POINTS.iter().zip(seen(&source, &expected)) {
                let Sight {
                    origin, direction, ..
                } = seen.sight;
                let way = add(*point, origin, -1.0);
                let t = dot(way, direction);
                let aside = add(way, direction, -t);
                let off = dot(aside, aside).sqrt() / t;
                assert!(
                    t > 0.0 && off < 2e-6,
                    "{settings}: {point:?} is off by {off}"
                );
            }
        }
    }
}

#[test]
fn orthographic_rays_are_parallel_and_evenly_spaced() {
    for (settings, _) in SEEN.iter().filter(|s| s.0.contains("orthographic")) {
        let source = format!("f(x, y, z) = x + y + z\nshow slices(f) {{ {settings} }}");
        let found = seen(
            &source,
            &[[160.0, 120.0], [0.0, 0.0], [161.0, 120.0], [160.0, 121.0]],
        );
        let [middle, corner, right, down] = [0, 1, 2, 3].map(|k| found[k].sight);
        assert!(middle.parallel);
        for other in [corner, right, down] {
            assert_eq!(other.direction, middle.direction, "{settings}");
            assert_eq!(other.direction, other.forward, "{settings}");
        }
        // every ray begins on one plane, a pixel from its neighbours
        for other in [right, down] {
            let step = add(other.origin, middle.origin, -1.0);
            let length = dot(step, step).sqrt();
            assert!(
                (length / middle.slope - 1.0).abs() < 1e-3,
                "{settings}: {length}"
            );
            assert!(
                dot(step, middle.direction).abs() < 1e-3 * length,
                "{settings}"
            );
        }
        let extent = settings
            .split("extent = ")
            .nth(1)
            .map_or(1.96 * 12f64.sqrt(), |rest| {
                rest.split(',')
                    .next()
                    .and_then(|n| n.parse().ok())
                    .expect("a number")
            });
        assert!(
            (middle.slope * 240.0 / extent - 1.0).abs() < 1e-6,
            "{settings}"
        );
    }
}

/// The rate of `screen_rate` against differences of the value where neighbouring rays meet the plane, in f64.
#[test]
fn values_change_from_pixel_to_pixel_as_they_are_said_to() {
    let mut judged = 0;
    for (settings, places) in SEEN {
        let source = format!(
            "f(x, y, z) = 1.25 x - 0.5 y + 2 z\nshow slices(f) {{ axis = (1, 2, 3), reference = none, {settings} }}"
        );
        for [x, y] in places {
            let around = [
                [x, y],
                [x + 1.0, y],
                [x - 1.0, y],
                [x, y + 1.0],
                [x, y - 1.0],
            ];
            let found = seen(&source, &around);
            let Some((t, n, gradient, rate)) = found[0].rate else {
                continue;
            };
            let ray = |k: usize| Ray {
                origin: found[k].sight.origin,
                direction: found[k].sight.direction,
            };
            let offset = dot(n, ray(0).at(t));
            let value = |k: usize| dot(gradient, ray(k).at(ray(k).plane(n, offset)));
            let change = [value(1) - value(2), value(3) - value(4)].map(|c| 0.5 * c);
            let expected = change[0].hypot(change[1]);
            judged += 1;
            assert!(
                (rate / expected - 1.0).abs() < 2e-3,
                "{settings} at {x}, {y}: {rate}, not {expected}"
            );
        }
    }
    assert!(judged > 20, "{judged} places");
}
