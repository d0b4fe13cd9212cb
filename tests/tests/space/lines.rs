//! Lines on planes: where they are, and how wide on the screen.

use crate::camera::{Camera, Ray, Vec3, dot, unit};
use crate::drawing::{Picture, device, draw};

/// A function whose zero lines have closed forms, a plane, and a camera.
struct Case {
    formula: &'static str,
    value: fn(Vec3) -> f64,
    axis: Vec3,
    position: f64,
    camera: Camera,
}

const NEAR: Camera = Camera {
    yaw: 20.0,
    pitch: 35.0,
    fov: 90.0,
    distance: 4.5,
    size: [240, 180],
};

const FAR: Camera = Camera {
    yaw: -70.0,
    pitch: 20.0,
    fov: 12.0,
    distance: 30.0,
    size: [240, 180],
};

const CASES: [Case; 4] = [
    Case {
        formula: "x + 2 y - 0.3",
        value: |[x, y, _]| x + 2.0 * y - 0.3,
        axis: [0.0, 0.0, 1.0],
        position: -0.2,
        camera: NEAR,
    },
    Case {
        formula: "1000 (x^2 + y^2 + z^2 - 2.25)",
        value: |[x, y, z]| 1000.0 * (x * x + y * y + z * z - 2.25),
        axis: [0.0, 0.0, 1.0],
        position: 0.1,
        camera: NEAR,
    },
    Case {
        formula: "0.001 (x y - z)",
        value: |[x, y, z]| 0.001 * (x * y - z),
        axis: [1.0, -2.0, 1.0],
        position: 0.05,
        camera: FAR,
    },
    Case {
        formula: "sin(2 x) + z",
        value: |[x, _, z]| (2.0 * x).sin() + z,
        axis: [0.2, -1.0, 0.4],
        position: 0.0,
        camera: FAR,
    },
];

/// Pixels. A line is placed by value over slope, which is of first order: where the slope changes by a part c from pixel to
/// pixel, its middle is off by c width²/8.
const WIDTH: f64 = 2.0;
/// Pixels to both sides of a line that are looked at.
const REACH: u32 = 4;

impl Case {
    fn plane(&self) -> (Vec3, f64) {
        let n = unit(self.axis);
        (
            n,
            self.position * n.iter().map(|c| 2.0 * c.abs()).sum::<f64>(),
        )
    }

    /// The value at a point of the image, given along and across the lines of pixels that are looked at: rows, or
    /// columns where `turned`.
    fn at(&self, turned: bool, along: f64, across: f64) -> f64 {
        let (n, offset) = self.plane();
        let ray = self.ray(turned, along, across);
        (self.value)(ray.at(ray.plane(n, offset)))
    }

    fn ray(&self, turned: bool, along: f64, across: f64) -> Ray {
        if turned {
            self.camera.ray(across, along)
        } else {
            self.camera.ray(along, across)
        }
    }

    /// Whether the plane is seen well inside of the cube.
    fn inside(&self, turned: bool, along: f64, across: f64) -> bool {
        let ray = self.ray(turned, along, across);
        let (n, offset) = self.plane();
        ray.at(ray.plane(n, offset)).iter().all(|c| c.abs() < 1.9)
    }

    /// White planes with one black line.
    fn source(&self) -> String {
        let [a, b, c] = self.axis;
        format!(
            "f(x, y, z) = {}\nshow slices(f) {{ axis = ({a}, {b}, {c}), position = {}, reference = none, \
             color_scale = 1e20, line_opacity = 0, zero_width = {WIDTH}, edge_width = 0, ink = (0, 0, 0), {} }}",
            self.formula,
            self.position,
            self.camera.settings()
        )
    }

    /// The zero between two places on a line of pixels, with the change of the value per pixel along and across.
    fn zero(&self, turned: bool, across: f64, [mut low, mut high]: [f64; 2]) -> (f64, [f64; 2]) {
        let at = |along: f64, across: f64| self.at(turned, along, across);
        let sign = at(low, across) > 0.0;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (at(middle, across) > 0.0) == sign {
                low = middle;
            } else {
                high = middle;
            }
        }
        let h = 1e-4;
        let slope = [
            (at(low + h, across) - at(low - h, across)) / (2.0 * h),
            (at(low, across + h) - at(low, across - h)) / (2.0 * h),
        ];
        (low, slope)
    }

    /// Whether the value changes its sign in a pixel of a line of pixels.
    fn changes(&self, turned: bool, pixel: u32, across: f64) -> bool {
        let sign = |k: u32| self.at(turned, f64::from(k), across) > 0.0;
        sign(pixel) != sign(pixel + 1)
    }

    /// Errors of place and width where the line crosses a line of pixels at a steep angle, alone and well inside of
    /// the plane.
    fn errors(&self, picture: &Picture, turned: bool, line: u32) -> Vec<[f64; 2]> {
        let length = self.camera.size[usize::from(turned)];
        let across = f64::from(line) + 0.5;
        let mut errors = Vec::new();
        for pixel in REACH..length - REACH - 1 {
            let window = pixel - REACH..pixel + REACH + 1;
            if window
                .clone()
                .filter(|&k| self.changes(turned, k, across))
                .ne([pixel])
            {
                continue;
            }
            let ends = [f64::from(pixel), f64::from(pixel + 1)];
            let (zero, [along, aside]) = self.zero(turned, across, ends);
            let ends = [zero - f64::from(REACH), zero + f64::from(REACH)];
            let inside = ends.into_iter().all(|end| {
                [-1.0, 1.0]
                    .into_iter()
                    .all(|e| self.inside(turned, end, across + e))
            });
            if inside && along.abs() >= aside.abs() {
                let (place, covered) = measured(picture, turned, line, window);
                let wanted = WIDTH * along.hypot(aside) / along.abs();
                errors.push([(place - zero).abs(), (covered / wanted - 1.0).abs()]);
            }
        }
        errors
    }
}

/// Centre and total coverage of the line on some pixels of a line of pixels.
fn measured(
    picture: &Picture,
    turned: bool,
    line: u32,
    pixels: std::ops::Range<u32>,
) -> (f64, f64) {
    let white = crate::colour::diverging(0.0)[1];
    let mut sum = 0.0;
    let mut moment = 0.0;
    for k in pixels {
        let [x, y] = if turned { [line, k] } else { [k, line] };
        let covered = 1.0 - picture.linear(x, y)[1] / white;
        sum += covered;
        moment += covered * (f64::from(k) + 0.5);
    }
    (moment / sum, sum)
}

#[test]
fn zero_lines_are_in_place_and_of_constant_width_on_the_screen() {
    let Some(gpu) = device() else { return };
    for case in &CASES {
        let picture = draw(&gpu, &case.source(), case.camera.size, 4, 0.0);
        let [width, height] = case.camera.size;
        let rows = (0..height).flat_map(|y| case.errors(&picture, false, y));
        let columns = (0..width).flat_map(|x| case.errors(&picture, true, x));
        let errors: Vec<[f64; 2]> = rows.chain(columns).collect();
        let worst = |k: usize| errors.iter().map(|e| e[k]).fold(0.0, f64::max);
        let (place, thickness, count) = (worst(0), worst(1), errors.len());
        println!(
            "{}: {count} crossings, off by {place:.3} pixels, width by {:.1} %",
            case.formula,
            100.0 * thickness
        );
        assert!(count > 20, "{}: {count} crossings", case.formula);
        assert!(place < 0.1, "{}: off by {place} pixels", case.formula);
        assert!(
            thickness < 0.05,
            "{}: width off by {thickness}",
            case.formula
        );
    }
}

/// The value's gradient has a part across the plane that must not count.
#[test]
fn a_gradient_across_the_plane_makes_no_line_thinner() {
    let Some(gpu) = device() else { return };
    let camera = FAR;
    let sums = ["x", "x + 40 (z - 0.5)"].map(|formula| {
        let source = format!(
            "f(x, y, z) = {formula}\nshow slices(f) {{ axis = (0, 0, 1), position = 0.25, reference = none, \
             color_scale = 1e20, line_opacity = 0, zero_width = 4, edge_width = 0, ink = (0, 0, 0), {} }}",
            camera.settings()
        );
        let picture = draw(&gpu, &source, camera.size, 2, 0.0);
        let (n, offset) = ([0.0, 0.0, 1.0], 0.5);
        let mut dark = 0.0;
        for y in 0..camera.size[1] {
            for x in 0..camera.size[0] {
                let ray = camera.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let p = ray.at(ray.plane(n, offset));
                if dot(p, [1.0, 0.0, 0.0]).abs() < 1.5 && p[1].abs() < 1.5 {
                    dark += 1.0 - picture.linear(x, y)[1] / 0.92;
                }
            }
        }
        dark
    });
    assert!(
        sums[0] > 100.0 && (sums[1] / sums[0] - 1.0).abs() < 0.02,
        "{sums:?}"
    );
}
