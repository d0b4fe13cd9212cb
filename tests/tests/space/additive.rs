//! `additive`: radiance against integrals in f64 between the ends that the shape itself tells, for solids, meshes, copies, walls,
//! and cameras near, far away and inside.

use std::fmt::Write as _;

use pullback_runtime::{Gpu, mesh};

use crate::camera::{Camera, Ray, Vec3, add, dot};
use crate::colour::Rgb;
use crate::drawing::{device, draw_linear, draw_mesh};

const CAMERA: Camera = Camera {
    yaw: 32.0,
    pitch: 24.0,
    fov: 20.0,
    distance: 9.0,
    size: [25, 19],
};
/// Greatest error of a pixel, as a part of ∫|f| on its ray (or of what f = [`FAINT`] gives, if that is more), beside what a ray has that is moved by [`MOVED`].
const BOUND: f64 = 1e-5;
const FAINT: f64 = 1e-3;
/// World units: four steps of single precision at the size of the solids. Chords near a silhouette are that badly conditioned.
const MOVED: f64 = 4.0 * 1.2e-7;

/// A density in the language and in Rust.
struct Density {
    formula: &'static str,
    value: fn(Vec3) -> f64,
}

const DENSITIES: [Density; 6] = [
    Density {
        formula: "0.25",
        value: |_| 0.25,
    },
    Density {
        formula: "0.1 + 0.1 sin(7 z - 2)",
        value: |p| 0.1 + 0.1 * (7.0 * p[2] - 2.0).sin(),
    },
    Density {
        formula: "0.2 clamp((1 - z)/2, 0, 1)^2",
        value: |p| 0.2 * ((1.0 - p[2]) / 2.0).clamp(0.0, 1.0).powi(2),
    },
    Density {
        formula: "0.3 exp(-2 (x^2 + y^2 + z^2))",
        value: |p| 0.3 * (-2.0 * dot(p, p)).exp(),
    },
    Density {
        formula: "0.05/(0.1 + x^2 + y^2 + z^2)",
        value: |p| 0.05 / (0.1 + dot(p, p)),
    },
    Density {
        formula: "0.2 max(0, x y + 0.3)",
        value: |p| 0.2 * (p[0] * p[1] + 0.3).max(0.0),
    },
];

/// A solid: how settings name it, and how often a point is inside of it.
struct Solid {
    settings: &'static str,
    inside: fn(Vec3) -> u32,
}

const SOLIDS: [Solid; 4] = [
    Solid {
        settings: "shape = box, box = (1, 0.7, 0.9)",
        inside: |p| u32::from(p[0].abs() <= 1.0 && p[1].abs() <= 0.7 && p[2].abs() <= 0.9),
    },
    Solid {
        settings: "shape = ball, box = (1, 0.8, 0.6)",
        inside: |p| {
            u32::from((p[0] / 1.0).powi(2) + (p[1] / 0.8).powi(2) + (p[2] / 0.6).powi(2) <= 1.0)
        },
    },
    Solid {
        settings: "shape = cylinder, box = (0.7, 0.5, 1)",
        inside: |p| {
            u32::from((p[0] / 0.7).powi(2) + (p[1] / 0.5).powi(2) <= 1.0 && p[2].abs() <= 1.0)
        },
    },
    Solid {
        settings: "shape = cone, box = (0.7, 0.9, 1)",
        inside: |p| {
            let w = 0.5 - 0.5 * p[2];
            let round = (p[0] / 0.7).powi(2) + (p[1] / 0.9).powi(2);
            u32::from(p[2].abs() <= 1.0 && round <= w * w)
        },
    },
];

/// Where the number of solids around a point changes along a ray, between `ends`, found by halving.
fn changes(ray: &Ray, ends: [f64; 2], inside: &dyn Fn(Vec3) -> u32) -> Vec<f64> {
    const SAMPLES: u32 = 3000;
    let at = |k: u32| ends[0] + (ends[1] - ends[0]) * f64::from(k) / f64::from(SAMPLES);
    let count = |t: f64| inside(ray.at(t));
    let mut out = vec![ends[0]];
    for k in 0..SAMPLES {
        let (mut low, mut high) = (at(k), at(k + 1));
        let before = count(low);
        if before == count(high) {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if count(middle) == before {
                low = middle;
            } else {
                high = middle;
            }
        }
        out.push(high);
    }
    out.push(ends[1]);
    out
}

/// ∫ w f dt and ∫ w |f| dt along a ray, with w the number of solids around the point: Gauss and Legendre's rule of five nodes in
/// many short pieces.
fn integral(
    ray: &Ray,
    ends: [f64; 2],
    inside: &dyn Fn(Vec3) -> u32,
    value: &dyn Fn(Vec3) -> f64,
) -> [f64; 2] {
    const PIECES: u32 = 100;
    const NODES: [(f64, f64); 5] = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
        (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    let mut sum = [0.0; 2];
    for pair in changes(ray, ends, inside).windows(2) {
        let weight = f64::from(inside(ray.at(0.5 * (pair[0] + pair[1]))));
        let half = 0.5 * (pair[1] - pair[0]) / f64::from(PIECES);
        for k in 0..PIECES {
            let middle = pair[0] + half * f64::from(2 * k + 1);
            for (node, share) in NODES {
                let f = weight * half * share * value(ray.at(middle + half * node));
                sum = [sum[0] + f, sum[1] + f.abs()];
            }
        }
    }
    sum
}

/// Holds every pixel to the integral, channel by channel; gives the greatest error as a part of ∫|f|.
fn hold(
    what: &str,
    pixels: &[Rgb],
    camera: &Camera,
    end: &dyn Fn(&Ray) -> f64,
    inside: &dyn Fn(Vec3) -> u32,
    values: [&dyn Fn(Vec3) -> f64; 3],
) -> f64 {
    let [width, height] = camera.size;
    let (mut worst, mut judged) = (0.0f64, 0);
    let step = MOVED / camera.pixel();
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let sums = |value: &dyn Fn(Vec3) -> f64, [dx, dy]: [f64; 2]| {
            let ray = camera.ray(f64::from(x) + 0.5 + dx, f64::from(y) + 0.5 + dy);
            let near = (camera.distance - 4.0).max(0.0);
            let far = end(&ray).min(camera.distance + 4.0);
            integral(&ray, [near, far], inside, value)
        };
        let seen = pixels[(y * width + x) as usize];
        let way = sums(&|_| 1.0, [0.0; 2])[0];
        if way == 0.0 {
            assert_eq!(
                seen, [0.0; 3],
                "{what}: light beside the solids at {x}, {y}"
            );
            continue;
        }
        // one channel alone where all have the same density
        let count = if seen[0] == seen[2] { 1 } else { 3 };
        for (channel, value) in values.into_iter().enumerate().take(count) {
            let [sum, size] = sums(value, [0.0; 2]);
            let allowed = [[step, 0.0], [0.0, step], [-step, 0.0], [0.0, -step]]
                .map(|by| (sums(value, by)[0] - sum).abs())
                .into_iter()
                .fold(0.0, f64::max);
            let found = seen[channel];
            let error =
                ((found - sum.clamp(0.0, 1.0)).abs() - allowed).max(0.0) / size.max(FAINT * way);
            assert!(
                error <= BOUND,
                "{what}: {found} for {sum} ± {allowed:.1e} at {x}, {y}"
            );
            worst = worst.max(error);
            judged += 1;
        }
    }
    assert!(judged > 30, "{what}: {judged} values");
    worst
}

fn source(density: &Density, settings: &str, camera: &Camera) -> String {
    format!(
        "f(x, y, z) = {}\nshow additive(f) {{ {settings}, color = (1, 1, 1), exposure = 1, tone = none, \
         background = (0, 0, 0), {} }}",
        density.formula,
        camera.settings()
    )
}

fn far(_: &Ray) -> f64 {
    f64::INFINITY
}

#[test]
fn every_solid_gives_the_integral_of_every_density() {
    let Some(gpu) = device() else { return };
    for solid in &SOLIDS {
        let mut worst = 0.0f64;
        for density in &DENSITIES {
            let what = format!("{} in {}", density.formula, solid.settings);
            let pixels = draw_linear(
                &gpu,
                &source(density, solid.settings, &CAMERA),
                CAMERA.size,
                1,
            );
            let error = hold(
                &what,
                &pixels,
                &CAMERA,
                &far,
                &solid.inside,
                [&density.value; 3],
            );
            worst = worst.max(error);
        }
        println!("{}: at most {worst:.1e} of the integral", solid.settings);
    }
}

#[test]
fn cameras_inside_and_far_away_lose_nothing() {
    let Some(gpu) = device() else { return };
    let inside = Camera {
        distance: 0.3,
        fov: 70.0,
        ..CAMERA
    };
    let away = Camera {
        distance: 1000.0,
        fov: 1.0,
        ..CAMERA
    };
    // the narrowest field of view is a degree: a solid large enough to fill it
    let large = Camera {
        distance: 100.0,
        fov: 1.6,
        ..CAMERA
    };
    for (camera, name) in [(inside, "inside"), (large, "100 away")] {
        for density in &DENSITIES {
            let what = format!("{} from {name}", density.formula);
            let pixels = draw_linear(
                &gpu,
                &source(density, SOLIDS[1].settings, &camera),
                camera.size,
                1,
            );
            hold(
                &what,
                &pixels,
                &camera,
                &far,
                &SOLIDS[1].inside,
                [&density.value; 3],
            );
        }
    }
    let density = &DENSITIES[1];
    let pixels = draw_linear(
        &gpu,
        &source(density, SOLIDS[1].settings, &away),
        away.size,
        1,
    );
    let middle = pixels[9 * 25 + 12][0];
    let ray = away.ray(12.5, 9.5);
    let [sum, size] = integral(&ray, [996.0, 1004.0], &SOLIDS[1].inside, &density.value);
    assert!(
        (middle - sum).abs() <= BOUND * size,
        "{middle} for {sum} from 1000 away"
    );
}

#[test]
fn light_of_copies_adds_up_and_walls_hide_it() {
    let Some(gpu) = device() else { return };
    let settings = "shape = ball, box = 0.7, copies = 3, step = (0.5, 0.1, -0.2), ball = 0.4, ball_at = (0.3, 0, 0.1)";
    let copies = |p: Vec3| {
        (-1..=1)
            .map(|k| {
                let q = add(p, [0.5, 0.1, -0.2], -f64::from(k));
                u32::from(dot(q, q) <= 0.49)
            })
            .sum()
    };
    let wall = |ray: &Ray| {
        let from = add(ray.origin, [0.3, 0.0, 0.1], -1.0);
        let (b, c) = (dot(from, ray.direction), dot(from, from) - 0.16);
        let discriminant = b * b - c;
        if discriminant < 0.0 {
            f64::INFINITY
        } else {
            -b - discriminant.sqrt()
        }
    };
    let density = &DENSITIES[3];
    let text = source(density, settings, &CAMERA);
    let pixels = draw_linear(&gpu, &text, CAMERA.size, 1);
    // the wall has a colour of its own, which is taken away; beside its edge nothing is known
    let bare = draw_linear(&gpu, &text.replace("0.3 exp", "0 exp"), CAMERA.size, 1);
    let lights: Vec<Rgb> = pixels
        .iter()
        .zip(&bare)
        .map(|(a, b)| [0, 1, 2].map(|k| a[k] - b[k]))
        .collect();
    hold(
        "copies",
        &lights,
        &CAMERA,
        &wall,
        &copies,
        [&density.value; 3],
    );
}

#[test]
fn channels_are_shifted() {
    let Some(gpu) = device() else { return };
    let density = &DENSITIES[1];
    let settings = format!("{}, shift = (0, 0.05, 0.2)", SOLIDS[0].settings);
    let pixels = draw_linear(&gpu, &source(density, &settings, &CAMERA), CAMERA.size, 1);
    let at = |p: Vec3, sign: f64| (density.value)(add(p, [0.0, 0.05, 0.2], sign));
    hold(
        "shifted",
        &pixels,
        &CAMERA,
        &far,
        &SOLIDS[0].inside,
        [&|p| at(p, -1.0), &density.value, &|p| at(p, 1.0)],
    );
}

/// Words of a mesh of vertices and triangles.
fn packed(vertices: &[Vec3], triangles: &[[usize; 3]]) -> Vec<[u32; 4]> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mesh.obj");
    let mut text = String::new();
    for [x, y, z] in vertices {
        writeln!(text, "v {x} {y} {z}").expect("a string");
    }
    for [a, b, c] in triangles {
        writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).expect("a string");
    }
    std::fs::write(&path, text).expect("a file");
    mesh::load(&path).expect("a mesh")
}

/// Two octahedra that overlap, |x ∓ 0.25| + |y| + |z| ≤ 0.75, whose common box is the unit box in x.
fn octahedra() -> Vec<[u32; 4]> {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for middle in [-0.25, 0.25] {
        let first = vertices.len();
        for axis in 0..3 {
            for side in [-0.75, 0.75] {
                let mut p = [middle, 0.0, 0.0];
                p[axis] += side;
                vertices.push(p);
            }
        }
        for (x, y, z) in [
            (0, 0, 0),
            (1, 0, 0),
            (0, 1, 0),
            (1, 1, 0),
            (0, 0, 1),
            (1, 0, 1),
            (0, 1, 1),
            (1, 1, 1),
        ] {
            let corners = [first + x, first + 2 + y, first + 4 + z];
            let outward = (x + y + z) % 2 == 1;
            triangles.push(if outward {
                corners
            } else {
                [corners[0], corners[2], corners[1]]
            });
        }
    }
    packed(&vertices, &triangles)
}

fn octahedra_around(p: Vec3) -> u32 {
    [-0.25, 0.25]
        .into_iter()
        .map(|middle| u32::from((p[0] - middle).abs() + p[1].abs() + p[2].abs() <= 0.75))
        .sum()
}

fn holds_of_meshes(gpu: &Gpu, camera: &Camera, name: &str) {
    let mut worst = 0.0f64;
    for density in &DENSITIES {
        let text = source(density, "shape = mesh, box = 1", camera);
        let pixels = draw_mesh(gpu, &text, camera.size, octahedra());
        let what = format!("{} in a mesh, {name}", density.formula);
        let error = hold(
            &what,
            &pixels,
            camera,
            &far,
            &octahedra_around,
            [&density.value; 3],
        );
        worst = worst.max(error);
    }
    println!("a mesh, {name}: at most {worst:.1e} of the integral");
}

#[test]
fn light_in_overlapping_parts_of_a_mesh_counts_twice() {
    let Some(gpu) = device() else { return };
    holds_of_meshes(&gpu, &CAMERA, "from outside");
    let inside = Camera {
        distance: 0.2,
        fov: 60.0,
        ..CAMERA
    };
    holds_of_meshes(&gpu, &inside, "from inside");
    // rays through vertices and along edges
    let straight = Camera {
        yaw: 0.0,
        pitch: 0.0,
        size: [25, 19],
        ..CAMERA
    };
    holds_of_meshes(&gpu, &straight, "through its vertices");
}
