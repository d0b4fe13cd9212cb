//! Where pictures in different tiers are compared.

use pullback_compiler::Evaluator;
use pullback_compiler::scene::Space;

use super::Scenery;

/// Samples along each side of a view of the plane.
const SIDE: u32 = 48;
/// Lines through the box of a scene of space.
const LINES: u32 = 1024;
/// Places at which each of them is looked at for a change of sign.
const STEPS: u32 = 48;

/// A point of the domain at which pictures are compared.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// World coordinates; those that the formula does not take are zero.
    pub point: [f64; 3],
    /// The footprint of a pixel there, world units.
    pub footprint: f64,
}

/// Sample points of a view: pixels of the plane, one in each cell of a grid; of space, points of the surface.
pub fn samples(scenery: &Scenery, truth: &mut Evaluator) -> Vec<Sample> {
    match scenery.program.pictures()[scenery.picture].scene.space {
        Space::Plane | Space::Complex => pixels(scenery),
        Space::Space => crossings(scenery, truth),
    }
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
        });
    }
    samples
}

/// Points of the surface f = level on random lines through the box, by bisection in f64.
fn crossings(scenery: &Scenery, truth: &mut Evaluator) -> Vec<Sample> {
    let value = |name, missing| {
        let found = scenery.settings.iter().find(|s| s.spec.name == name);
        found.map_or(missing, |s| s.value.to_array())
    };
    let (half, center) = (value("box", [1.0; 3]), value("center", [0.0; 3]));
    let [level, ..] = value("level", [0.0; 3]);
    let size = scenery.frame.size;
    // the box fills the shorter side of the picture, or is smaller
    let footprint =
        2.0 * half.into_iter().fold(0.0, f64::max) / f64::from(size.width.min(size.height).max(1));
    let inputs = truth.inputs().len();
    let mut row = vec![f64::NAN; truth.outputs().len()];
    let frame = scenery.frame;
    let mut field = |p: [f64; 3]| {
        truth.eval(
            frame.params,
            frame.time,
            frame.pixel(),
            &p[..inputs],
            &mut row,
        );
        row.first().copied().unwrap_or(f64::NAN) - level
    };
    let mut random = Random::default();
    let mut samples = Vec::new();
    for _ in 0..LINES {
        let mut inside = || [0, 1, 2].map(|k| center[k] + half[k] * (2.0 * random.unit() - 1.0));
        let (a, b) = (inside(), inside());
        let on = |t: f64| [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k]));
        if let Some(t) = first_root(|t| field(on(t))) {
            samples.push(Sample {
                point: on(t),
                footprint,
            });
        }
    }
    samples
}

/// The first change of sign on [0, 1] that [`STEPS`] samples show, by bisection.
fn first_root(mut f: impl FnMut(f64) -> f64) -> Option<f64> {
    let mut before = f(0.0);
    for k in 1..=STEPS {
        let (mut low, mut high) = (
            f64::from(k - 1) / f64::from(STEPS),
            f64::from(k) / f64::from(STEPS),
        );
        let after = f(high);
        if before * after < 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if f(middle) * before > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            return Some(0.5 * (low + high));
        }
        before = after;
    }
    None
}

/// Numbers in [0, 1), the same in every run: the additive recurrence by the golden ratio.
#[derive(Default)]
struct Random(u32);

impl Random {
    fn unit(&mut self) -> f64 {
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

    #[test]
    fn roots_are_found_by_bisection() {
        let root = first_root(|t| t * t - 0.5).unwrap();
        assert!((root - 0.5f64.sqrt()).abs() < 1e-15);
        assert_eq!(first_root(|t| t + 1.0), None);
        assert_eq!(first_root(|_| f64::NAN), None);
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
