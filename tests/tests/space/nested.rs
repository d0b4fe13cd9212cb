//! `nested`: the layers of each ray against a list of the closed-form roots, sorted, composited from back to front in f64.

use pullback_runtime::Gpu;

use crate::camera::{Camera, Ray, Vec3, add, dot, unit};
use crate::colour::{Rgb, diverging, encoded};
use crate::drawing::{device, draw};

pub const CAMERA: Camera = Camera {
    yaw: 32.0,
    pitch: 24.0,
    fov: 34.0,
    distance: 10.0,
    size: [96, 72],
};

/// A quadric a x² + b y² + c z² + d x y + e x + g z: on a ray a polynomial of degree two.
#[derive(Clone, Copy)]
pub struct Quadric(pub [f64; 6]);

impl Quadric {
    pub fn value(self, [x, y, z]: Vec3) -> f64 {
        let [a, b, c, d, e, g] = self.0;
        a * x * x + b * y * y + c * z * z + d * x * y + e * x + g * z
    }

    pub fn gradient(self, [x, y, z]: Vec3) -> Vec3 {
        let [a, b, c, d, e, g] = self.0;
        [
            2.0 * a * x + d * y + e,
            2.0 * b * y + d * x,
            2.0 * c * z + g,
        ]
    }

    pub fn formula(self) -> String {
        let [a, b, c, d, e, g] = self.0;
        format!("{a} x^2 + {b} y^2 + {c} z^2 + {d} x y + {e} x + {g} z")
    }

    /// Distances at which a ray meets a level.
    pub fn roots(self, ray: &Ray, level: f64) -> Vec<f64> {
        let constant = self.value(ray.origin) - level;
        let linear = dot(self.gradient(ray.origin), ray.direction);
        let square = self.value(ray.direction) - dot(self.gradient([0.0; 3]), ray.direction);
        if square.abs() < 1e-12 {
            return vec![-constant / linear];
        }
        let discriminant = linear * linear - 4.0 * square * constant;
        if discriminant < 0.0 {
            return Vec::new();
        }
        let q = -0.5 * (linear + discriminant.sqrt().copysign(linear));
        vec![q / square, constant / q]
    }
}

/// The family of a case, and how it is drawn.
pub struct Family {
    pub quadric: Quadric,
    pub level: f64,
    pub spacing: f64,
    pub count: usize,
    /// From the lowest, from 1.
    pub highlight: usize,
    pub highlight_opacity: f64,
    pub ghost_opacity: f64,
}

impl Family {
    pub fn settings(&self) -> String {
        format!(
            "level = {}, spacing = {}, count = {}, highlight = {}, highlight_opacity = {}, ghost_opacity = {}, \
             lighting = 0, backdrop = plain, background = (0.1, 0.4, 0.2), isoline_width = 0, wall_opacity = 0, \
             edge_width = 0, {}",
            self.level,
            self.spacing,
            self.count,
            self.highlight,
            self.highlight_opacity,
            self.ghost_opacity,
            CAMERA.settings()
        )
    }

    pub fn value_of(&self, k: usize) -> f64 {
        self.level + (k as f64 - 0.5 * (self.count as f64 - 1.0)) * self.spacing
    }

    /// Distance, level, colour and opacity of each layer within a part of a ray, from the front.
    pub fn layers(&self, ray: &Ray, [from, to]: [f64; 2]) -> Vec<(f64, usize, Rgb, f64)> {
        let mut layers = Vec::new();
        for k in 0..self.count {
            for t in self.quadric.roots(ray, self.value_of(k)) {
                if t > from && t < to {
                    let (colour, opacity) = self.layer(k, ray, t);
                    layers.push((t, k, colour, opacity));
                }
            }
        }
        layers.sort_by(|a, b| a.0.total_cmp(&b.0));
        layers
    }

    fn layer(&self, k: usize, ray: &Ray, t: f64) -> (Rgb, f64) {
        let toward = -dot(unit(self.quadric.gradient(ray.at(t))), ray.direction);
        let middle = 0.5 * (self.count as f64 - 1.0);
        let own = diverging(0.85 * (k as f64 - middle) / middle.max(0.5));
        let colour = if toward > 0.0 {
            own
        } else {
            own.map(|c| 0.7 * c + 0.3)
        };
        let opacity = if k + 1 == self.highlight {
            self.highlight_opacity
        } else {
            1.0 - (1.0 - self.ghost_opacity).powf(1.0 / toward.abs().max(0.125))
        };
        (colour, opacity)
    }
}

/// Layers in front of a background, from back to front.
pub fn composited(layers: &[(f64, usize, Rgb, f64)], background: Rgb) -> Rgb {
    let mut light = background;
    for (_, _, colour, opacity) in layers.iter().rev() {
        light = add(light.map(|l| l * (1.0 - opacity)), *colour, *opacity);
    }
    light
}

/// The levels of the layers of a ray, for telling pixels at a silhouette.
fn order(layers: &[(f64, usize, Rgb, f64)]) -> Vec<usize> {
    layers.iter().map(|l| l.1).collect()
}

fn check(gpu: &Gpu, family: &Family) {
    let source = format!(
        "f(x, y, z) = {}\nshow nested(f) {{ {} }}",
        family.quadric.formula(),
        family.settings()
    );
    let picture = draw(gpu, &source, CAMERA.size, 1, 0.0);
    let mut compared = 0;
    let mut deepest = 0;
    for y in 0..CAMERA.size[1] {
        for x in 0..CAMERA.size[0] {
            let layers = |dx: f64, dy: f64| {
                let ray = CAMERA.ray(f64::from(x) + dx, f64::from(y) + dy);
                ray.cube(2.0)
                    .map_or_else(Vec::new, |span| family.layers(&ray, span))
            };
            let here = layers(0.5, 0.5);
            let corners = [(0.4, 0.4), (0.6, 0.4), (0.4, 0.6), (0.6, 0.6)];
            if corners
                .into_iter()
                .any(|(dx, dy)| order(&layers(dx, dy)) != order(&here))
            {
                continue;
            }
            let wanted = composited(&here, [0.1, 0.4, 0.2]);
            let found = picture.srgb(x, y);
            for k in 0..3 {
                let error = (found[k] - encoded(wanted[k].clamp(0.0, 1.0))).abs();
                assert!(
                    error < 2.0 / 255.0,
                    "{}, pixel {x}, {y}: {found:?}, not {:?} of {} layers",
                    family.quadric.formula(),
                    wanted.map(encoded),
                    here.len()
                );
            }
            compared += 1;
            deepest = deepest.max(here.len());
        }
    }
    println!(
        "{}: {compared} pixels, up to {deepest} layers",
        family.quadric.formula()
    );
    assert!(compared > 6000, "{compared}");
    assert!(deepest >= family.count, "{deepest} layers");
}

#[test]
fn layers_are_composited_in_the_order_of_the_ray() {
    let Some(gpu) = device() else { return };
    let family = |quadric, level, spacing, count, highlight, highlight_opacity| Family {
        quadric: Quadric(quadric),
        level,
        spacing,
        count,
        highlight,
        highlight_opacity,
        ghost_opacity: 0.3,
    };
    for family in [
        // concentric spheres, the innermost opaque
        family([1.0, 1.0, 1.0, 0.0, 0.0, 0.0], 2.0, 0.75, 5, 1, 1.0),
        // planes, many and close to one another, none opaque
        family([0.0, 0.0, 0.0, 0.0, 1.0, 0.5], 0.0, 0.02, 40, 7, 0.5),
        // a saddle, and hyperboloids through their cone
        family([0.0, 0.0, 0.0, 1.0, 0.0, 0.3], 0.1, 0.5, 6, 3, 1.0),
        family([1.0, 1.0, -1.0, 0.0, 0.0, 0.0], 0.2, 0.4, 5, 5, 0.8),
    ] {
        check(&gpu, &family);
    }
}
