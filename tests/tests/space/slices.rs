//! `slices`: planes are where they are said to be, and values on them have their colours.

use crate::camera::{Camera, Vec3, add, dot, unit};
use crate::colour::{Rgb, diverging, encoded};
use crate::drawing::{Picture, device, draw};

const CAMERA: Camera = Camera {
    yaw: 32.0,
    pitch: 24.0,
    fov: 40.0,
    distance: 9.0,
    size: [80, 60],
};

/// A linear function: what a plane shows of it says where the plane is.
const VALUE: Vec3 = [0.7, -0.4, 0.5];

fn picture(settings: &str, time: f64) -> Option<Picture> {
    let gpu = device()?;
    let [a, b, c] = VALUE;
    let source = format!(
        "f(x, y, z) = {a} x + {b} y + {c} z\nshow slices(f) {{ {settings}, color_scale = 1, line_opacity = 0, \
         zero_width = 0, edge_width = 0, axis_width = 0, grid_opacity = 0, reference_strength = 1, {} }}",
        CAMERA.settings()
    );
    Some(draw(&gpu, &source, CAMERA.size, 2, time))
}

/// The mean colour of a plane in a pixel, sRGB.
fn colour([x, y]: [u32; 2], n: Vec3, offset: f64) -> Rgb {
    let mut mean = [0.0; 3];
    for k in 0..64 {
        let place = |j: u32| (f64::from(j) + 0.5) / 8.0;
        let ray = CAMERA.ray(f64::from(x) + place(k % 8), f64::from(y) + place(k / 8));
        let value = dot(VALUE, ray.at(ray.plane(n, offset)));
        mean = add(mean, diverging(value / value.hypot(1.0)), 1.0 / 64.0);
    }
    mean.map(|c| encoded(c.clamp(0.0, 1.0)))
}

fn check(picture: &Picture, pixel: [u32; 2], n: Vec3, offset: f64) {
    let (found, wanted) = (picture.srgb(pixel[0], pixel[1]), colour(pixel, n, offset));
    for k in 0..3 {
        assert!(
            (found[k] - wanted[k]).abs() < 2.0 / 255.0,
            "plane {n:?} at {offset}, pixel {pixel:?}: {found:?}, not {wanted:?}"
        );
    }
}

/// How many pixels show a plane, each with the colour of the value at the point that its ray meets; a point at the border of
/// the cube counts for nothing.
fn matches(picture: &Picture, n: Vec3, offset: f64) -> usize {
    let mut seen = 0;
    for y in 0..CAMERA.size[1] {
        for x in 0..CAMERA.size[0] {
            let ray = CAMERA.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let p = ray.at(ray.plane(n, offset));
            if p.iter().any(|c| c.abs() > 1.8) {
                continue;
            }
            check(picture, [x, y], n, offset);
            seen += 1;
        }
    }
    seen
}

#[test]
fn the_active_slice_is_where_it_is_said_to_be() {
    for (axis, position) in [
        ([0.0, 0.0, 1.0], 0.25),
        ([1.0, 0.0, 0.0], -0.6),
        ([1.0, 2.0, -1.5], 0.3),
    ] {
        let [a, b, c] = axis;
        let settings = format!("axis = ({a}, {b}, {c}), position = {position}, reference = none");
        let Some(picture) = picture(&settings, 0.0) else {
            return;
        };
        let n = unit(axis);
        let reach: f64 = n.iter().map(|c| 2.0 * c.abs()).sum();
        assert!(matches(&picture, n, position * reach) > 300);
    }
}

#[test]
fn the_active_slice_sweeps() {
    // an eighth of the period: sin 45°
    let settings = "axis = (0, 1, 0), position = 0.1, sweep = 0.5, period = 4, reference = none";
    let Some(picture) = picture(settings, 0.5) else {
        return;
    };
    let position = 0.1 + 0.5 * std::f64::consts::FRAC_1_SQRT_2;
    assert!(matches(&picture, [0.0, 1.0, 0.0], 2.0 * position) > 300);
}

#[test]
fn of_the_planes_the_nearest_is_seen() {
    let settings =
        "axis = (0, 0, 1), position = -1, reference = planes, planes = (0.5, -0.25, 0.75)";
    let Some(picture) = picture(settings, 0.0) else {
        return;
    };
    let planes: [(Vec3, f64); 4] = [
        ([0.0, 0.0, 1.0], -2.0),
        ([1.0, 0.0, 0.0], 1.0),
        ([0.0, 1.0, 0.0], -0.5),
        ([0.0, 0.0, 1.0], 1.5),
    ];
    let nearest = |x: f64, y: f64| {
        let ray = CAMERA.ray(x, y);
        let met = planes
            .iter()
            .enumerate()
            .map(|(k, &(n, offset))| (ray.plane(n, offset), k));
        met.filter(|(t, _)| ray.at(*t).iter().all(|c| c.abs() < 2.0001))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, k)| k)
    };
    let mut seen = [0; 4];
    for y in 0..CAMERA.size[1] {
        for x in 0..CAMERA.size[0] {
            let at = |k: u32| {
                let place = |j: u32| f64::from(j) / 3.0;
                nearest(f64::from(x) + place(k % 4), f64::from(y) + place(k / 4))
            };
            // a pixel at a border shows both sides of it
            let Some(k) = at(0).filter(|_| (1..16).all(|k| at(k) == at(0))) else {
                continue;
            };
            seen[k] += 1;
            let (n, offset) = planes[k];
            check(&picture, [x, y], n, offset);
        }
    }
    assert!(seen.iter().all(|&n| n > 50), "{seen:?}");
}
