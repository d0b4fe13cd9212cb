//! Where pictures in different tiers are compared.

use pullback_compiler::Evaluator;
use pullback_compiler::scene::Space;

use super::Scenery;
use super::space::{Room, setting};

/// Samples along each side of a view of the plane.
const SIDE: u32 = 48;
/// A point of the domain at which pictures are compared.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// World coordinates; those that the formula does not take are zero.
    pub point: [f64; 3],
    /// The footprint of a pixel there, world units.
    pub footprint: f64,
    /// What is seen there.
    pub subject: Subject,
}

/// What is seen of a value at a point.
#[derive(Clone, Copy, Debug)]
pub enum Subject {
    /// Colour and lines, all over the plane.
    Picture,
    /// A surface.
    Surface,
    /// Colour and lines on a plane with this normal.
    Drawn([f64; 3]),
    /// Lines alone, of the levels of a family, on such a plane.
    Lined([f64; 3]),
    /// A gas that emits and absorbs.
    Matter,
    /// A cloud.
    Cloud,
    /// Light around a surface.
    Light,
}

/// Sample points of a view: pixels of the plane or of the sphere, one in each cell of a grid; of space, what its scene shows.
pub fn samples(scenery: &Scenery, truth: &mut Evaluator) -> Vec<Sample> {
    let scene = scenery.program.pictures()[scenery.picture].scene;
    match scene.space {
        _ if scene.name == "sphere" => on_sphere(scenery),
        Space::Plane | Space::Complex => pixels(scenery),
        Space::Space => Room::new(scenery, truth).samples(scene.name),
    }
}

/// What the pixels of [`pixels`] show of the Riemann sphere: z = (X + iY)/(1 + Z) of the point that is seen. A step on the
/// sphere is (1 + |z|²)/2 of one in the plane of z, at right angles to the view.
fn on_sphere(scenery: &Scenery) -> Vec<Sample> {
    let of = |name: &str| setting(scenery.settings, name).unwrap_or_default();
    let angles = [of("yaw")[0], of("pitch")[0]].map(f64::to_radians);
    let [a, b, c] = of("rotation").map(f64::to_radians);
    let turn = c + (of("spin")[0] * scenery.frame.time).to_radians();
    let mut samples = pixels(scenery);
    samples.retain_mut(|sample| {
        let [x, y, _] = sample.point;
        let depth = (1.0 - x * x - y * y).sqrt();
        if depth.is_nan() {
            return false;
        }
        let world = from_view([x, y, depth], angles);
        let [x, y, z] = about_axes(world, [a, b, turn]);
        let below = (1.0 + z).max(1e-15);
        let point = [x / below, y / below];
        let stretch = 0.5 * (1.0 + point[0] * point[0] + point[1] * point[1]);
        sample.point = [point[0], point[1], 0.0];
        sample.footprint *= stretch;
        true
    });
    samples
}

/// A vector of the view (right, up, towards the viewer) in the world.
fn from_view([x, y, z]: [f64; 3], [yaw, pitch]: [f64; 2]) -> [f64; 3] {
    let (up, back) = (
        y * pitch.cos() + z * pitch.sin(),
        z * pitch.cos() - y * pitch.sin(),
    );
    [
        back * yaw.cos() - x * yaw.sin(),
        back * yaw.sin() + x * yaw.cos(),
        up,
    ]
}

/// A vector of the world in the coordinates of a body that is turned about x, then y, then z.
fn about_axes([x, y, z]: [f64; 3], [a, b, c]: [f64; 3]) -> [f64; 3] {
    let (x, y) = (x * c.cos() + y * c.sin(), y * c.cos() - x * c.sin());
    let (x, z) = (x * b.cos() - z * b.sin(), z * b.cos() + x * b.sin());
    [x, y * a.cos() + z * a.sin(), z * a.cos() - y * a.sin()]
}

/// The middle of one pixel in each cell of the grid, as the template places it: an offset in single precision from
/// the centre.
fn pixels(scenery: &Scenery) -> Vec<Sample> {
    let frame = scenery.frame;
    let footprint = frame.pixel();
    let [width, height] = [frame.size.width, frame.size.height];
    let mut random = Random::default();
    let mut samples = Vec::new();
    for cell in 0..SIDE * SIDE {
        let mut place = |cell: u32, side: u32| {
            let pixel = (f64::from(cell) + random.unit()) / f64::from(SIDE) * f64::from(side);
            f64::from((pixel.floor() + 0.5 - 0.5 * f64::from(side)) as f32 * footprint as f32)
        };
        let x = place(cell % SIDE, width);
        let y = -place(cell / SIDE, height);
        let [cx, cy] = frame.view.center;
        samples.push(Sample {
            point: [cx + x, cy + y, 0.0],
            footprint,
            subject: Subject::Picture,
        });
    }
    samples
}

/// Numbers in [0, 1), the same in every run: the additive recurrence by the golden ratio.
#[derive(Default)]
pub(super) struct Random(u32);

impl Random {
    pub(super) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(2_654_435_769);
        // scrambled, so that successive numbers are not on a line (the finaliser of MurmurHash3, A. Appleby)
        let mut word = self.0;
        word = (word ^ word >> 16).wrapping_mul(0x85eb_ca6b);
        word = (word ^ word >> 13).wrapping_mul(0xc2b2_ae35);
        f64::from(word ^ word >> 16) / 4_294_967_296.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With the axes of compiler/shaders/scenes/sphere.wgsl, written out.
    #[test]
    fn axes_are_those_of_the_sphere() {
        let [a, b, c] = [0.3_f64, -0.7, 1.9];
        let (sines, cosines) = ([a, b, c].map(f64::sin), [a, b, c].map(f64::cos));
        let ([sa, sb, sc], [ca, cb, cc]) = (sines, cosines);
        let axes = [
            [cb * cc, cb * sc, -sb],
            [sa * sb * cc - ca * sc, sa * sb * sc + ca * cc, sa * cb],
            [ca * sb * cc + sa * sc, ca * sb * sc - sa * cc, ca * cb],
        ];
        let v = [0.2, -0.5, 0.8];
        let found = about_axes(v, [a, b, c]);
        for (axis, found) in axes.iter().zip(found) {
            let wanted: f64 = axis.iter().zip(v).map(|(a, v)| a * v).sum();
            assert!((found - wanted).abs() < 1e-14);
        }
        let (yaw, pitch) = (0.4_f64, 0.9_f64);
        let back = [
            pitch.cos() * yaw.cos(),
            pitch.cos() * yaw.sin(),
            pitch.sin(),
        ];
        let found = from_view([0.0, 0.0, 1.0], [yaw, pitch]);
        assert!((0..3).all(|k| (found[k] - back[k]).abs() < 1e-14));
        let right = from_view([1.0, 0.0, 0.0], [yaw, pitch]);
        assert!((right[0] + yaw.sin()).abs() < 1e-14 && right[2].abs() < 1e-14);
        let up = from_view([0.0, 1.0, 0.0], [yaw, pitch]);
        assert!((up[2] - pitch.cos()).abs() < 1e-14);
    }

    #[test]
    fn random_numbers_fill_the_interval() {
        let mut random = Random::default();
        let numbers: Vec<f64> = (0..4096).map(|_| random.unit()).collect();
        assert!(numbers.iter().all(|x| (0.0..1.0).contains(x)));
        let mean = numbers.iter().sum::<f64>() / 4096.0;
        assert!((mean - 0.5).abs() < 0.02, "{mean}");
    }
}
