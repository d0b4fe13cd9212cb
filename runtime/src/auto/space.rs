//! What is visible in scenes of space, and on the sphere: the points that pictures in different tiers are compared at.

use pullback_compiler::{Evaluator, SettingValue};

use super::Scenery;
use super::points::{Random, Sample, Subject};

/// Points of a scene of space.
const POINTS: u32 = 1024;
/// Lines through the box on which levels are looked for.
const LINES: u32 = 1024;
/// Places at which each of them is looked at for a change of sign.
const STEPS: u32 = 48;
/// Levels of a family that a line is looked at for.
const LEVELS: usize = 64;

type Vec3 = [f64; 3];

/// The settings of a scene of space, and the formula in f64.
pub struct Room<'a, 'e> {
    scenery: &'a Scenery<'a>,
    truth: &'e mut Evaluator,
    row: Vec<f64>,
    half: Vec3,
    center: Vec3,
    footprint: f64,
    random: Random,
    samples: Vec<Sample>,
}

/// The value of a setting, where the scene has it.
pub fn setting(settings: &[SettingValue], name: &str) -> Option<Vec3> {
    let found = settings.iter().find(|s| s.spec.name == name);
    found.map(|s| s.value.to_array())
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn unit(v: Vec3) -> Option<Vec3> {
    let length = dot(v, v).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|c| c / length))
}

impl<'a, 'e> Room<'a, 'e> {
    pub fn new(scenery: &'a Scenery<'a>, truth: &'e mut Evaluator) -> Self {
        let value = |name, missing| setting(scenery.settings, name).unwrap_or(missing);
        let (half, center) = (value("box", [1.0; 3]), value("center", [0.0; 3]));
        let row = vec![f64::NAN; truth.outputs().len()];
        Self {
            scenery,
            truth,
            row,
            half,
            center,
            footprint: footprint(scenery, half),
            random: Random::default(),
            samples: Vec::new(),
        }
    }

    /// The points at which a scene of this name is compared.
    pub fn samples(mut self, scene: &str) -> Vec<Sample> {
        match scene {
            "slices" => {
                self.slices();
            }
            "nested" => {
                self.levels(None);
                self.walls();
            }
            "cutaway" => {
                let cut = self.plane("normal");
                self.levels(cut);
                self.on_plane(cut, POINTS / 2, Subject::Drawn);
            }
            "volume" => self.inside(None, Subject::Matter),
            "volumecut" => {
                let cut = self.plane("normal");
                self.inside(cut, Subject::Matter);
                self.on_plane(cut, POINTS / 2, Subject::Drawn);
            }
            "scatter" => self.inside(None, Subject::Cloud),
            "glow" => {
                self.inside(None, Subject::Light);
                self.crossings(&[0.0], None, Subject::Light);
            }
            _ => {
                let [level, ..] = self.setting("level");
                self.crossings(&[level], None, Subject::Surface);
            }
        }
        self.samples
    }

    fn setting(&self, name: &str) -> Vec3 {
        setting(self.scenery.settings, name).unwrap_or_default()
    }

    fn field(&mut self, p: Vec3) -> f64 {
        let inputs = self.truth.inputs().len();
        let frame = self.scenery.frame;
        let (params, time, pixel) = (frame.params, frame.time, frame.pixel());
        self.truth
            .eval(params, time, pixel, &p[..inputs], &mut self.row);
        self.row.first().copied().unwrap_or(f64::NAN)
    }

    fn anywhere(&mut self) -> Vec3 {
        [0, 1, 2].map(|k| self.center[k] + self.half[k] * (2.0 * self.random.unit() - 1.0))
    }

    fn add(&mut self, point: Vec3, subject: Subject) {
        self.samples.push(Sample {
            point,
            footprint: self.footprint,
            subject,
        });
    }

    /// The plane of the settings `position`, `sweep` and of this normal, at the clock's time: unit normal and offset.
    fn plane(&self, normal: &str) -> Option<(Vec3, f64)> {
        let n = unit(self.setting(normal))?;
        let [position, ..] = self.setting("position");
        let [sweep, ..] = self.setting("sweep");
        let [period, ..] = setting(self.scenery.settings, "period").unwrap_or([1.0; 3]);
        let turn = (self.scenery.frame.time / period.max(1e-6)).fract();
        let swung = position + sweep * (std::f64::consts::TAU * turn).sin();
        Some((n, self.offset(n, swung.clamp(-1.0, 1.0))))
    }

    /// Offset of a plane at a place between where it leaves the box, -1, and where it does on the other side, 1.
    fn offset(&self, n: Vec3, position: f64) -> f64 {
        dot(n, self.center) + position * (0..3).map(|k| n[k].abs() * self.half[k]).sum::<f64>()
    }

    fn holds(&self, p: Vec3) -> bool {
        (0..3).all(|k| (p[k] - self.center[k]).abs() <= self.half[k] * (1.0 + 1e-9))
    }

    /// Points of a plane in the box.
    fn on_plane(&mut self, plane: Option<(Vec3, f64)>, count: u32, subject: fn(Vec3) -> Subject) {
        let Some((n, offset)) = plane else { return };
        for _ in 0..count {
            let p = self.anywhere();
            let away = offset - dot(n, p);
            let q = [0, 1, 2].map(|k| p[k] + away * n[k]);
            if self.holds(q) {
                self.add(q, subject(n));
            }
        }
    }

    /// Points of the active slice and of the planes or walls that stand still.
    fn slices(&mut self) {
        let active = self.plane("axis");
        self.on_plane(active, POINTS, Subject::Drawn);
        let [reference, ..] = self.setting("reference");
        let planes = self.setting("planes");
        for (k, plane) in planes.into_iter().enumerate() {
            let n = [0, 1, 2].map(|c| f64::from(u8::from(c == k)));
            let places: &[f64] = match reference as u32 {
                0 => &[-1.0, 1.0],
                1 => &[plane],
                _ => &[],
            };
            for &place in places {
                let plane = Some((n, self.offset(n, place)));
                self.on_plane(plane, POINTS / 8, Subject::Drawn);
            }
        }
    }

    /// Points of the walls, on which the levels have lines.
    fn walls(&mut self) {
        for k in 0..3 {
            let n = [0, 1, 2].map(|c| f64::from(u8::from(c == k)));
            for place in [-1.0, 1.0] {
                let plane = Some((n, self.offset(n, place)));
                self.on_plane(plane, POINTS / 8, Subject::Lined);
            }
        }
    }

    /// Points of the box, or of the part of it that a plane leaves.
    fn inside(&mut self, cut: Option<(Vec3, f64)>, subject: Subject) {
        for _ in 0..POINTS {
            let p = self.anywhere();
            if is_left(p, cut) {
                self.add(p, subject);
            }
        }
    }

    /// Points of each level of the family.
    fn levels(&mut self, cut: Option<(Vec3, f64)>) {
        let family = family(self.scenery.settings);
        self.crossings(&family, cut, Subject::Surface);
    }

    /// Where random lines through the box meet levels first, by bisection in f64, in the part that a plane leaves.
    fn crossings(&mut self, levels: &[f64], cut: Option<(Vec3, f64)>, subject: Subject) {
        let lines = LINES as usize;
        for k in 0..lines.max(levels.len()) {
            let level = levels[k % levels.len().max(1)];
            let (a, b) = (self.anywhere(), self.anywhere());
            let on = |t: f64| [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k]));
            if let Some(t) = first_root(|t| self.field(on(t)) - level)
                && is_left(on(t), cut)
            {
                self.add(on(t), subject);
            }
        }
    }
}

fn is_left(p: Vec3, cut: Option<(Vec3, f64)>) -> bool {
    cut.is_none_or(|(n, offset)| dot(n, p) <= offset)
}

/// The scale of colours, and the value between the levels of a family.
pub fn scale_and_spacing(settings: &[SettingValue]) -> (f64, f64) {
    let number = |name| setting(settings, name).map_or(0.0, |v| v[0]);
    let or = |set: f64, automatic: f64| if set > 0.0 { set } else { automatic };
    let scale = or(number("color_scale"), 1.0);
    (scale, or(number("spacing"), 0.5 * scale))
}

/// The levels of `nested` and `cutaway`.
fn family(settings: &[SettingValue]) -> Vec<f64> {
    let number = |name| setting(settings, name).map_or(0.0, |v| v[0]);
    let (_, spacing) = scale_and_spacing(settings);
    let count = (number("count") as usize).clamp(1, LEVELS);
    let lowest = number("level") - 0.5 * (count as f64 - 1.0) * spacing;
    (0..count).map(|k| lowest + k as f64 * spacing).collect()
}

/// World units of a pixel at the middle of what the camera sees.
fn footprint(scenery: &Scenery, half: Vec3) -> f64 {
    let number = |name| setting(scenery.settings, name).map_or(0.0, |v| v[0]);
    let size = scenery.frame.size;
    let side = f64::from(size.width.min(size.height).max(1));
    let radius = dot(half, half).sqrt();
    let (fov, extent) = (0.5 * number("fov").to_radians(), number("extent"));
    if number("projection") > 0.5 {
        return if extent > 0.0 { extent } else { 1.96 * radius } / side;
    }
    let vector = |name| setting(scenery.settings, name).unwrap_or_default();
    let (eye, aim, distance) = (vector("eye"), vector("aim"), number("distance"));
    let away = if number("camera") > 0.5 {
        let way = [0, 1, 2].map(|k| eye[k] - aim[k]);
        dot(way, way).sqrt()
    } else if distance > 0.0 {
        distance
    } else {
        0.98 * radius / fov.sin().max(1e-9)
    };
    2.0 * fov.tan() * away / side
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
}
