//! What the scene `surface` finds on rays, computed by the executor in exact float32, beside the roots along them.

use pullback_compiler::SettingValue;
use pullback_compiler::lower::Precision;
use pullback_runtime::executor::{Arithmetic, Event, Painter, Shown, SiteKind, Watched};
use pullback_runtime::{Frame, Pipeline, Size, View, fill_in_scale};

use crate::facts::Surface;
use crate::group::Vec3;
use crate::polynomial::Polynomial;
use crate::program::Subject;
use crate::roots::{Root, Series};

pub const SIZE: Size = Size {
    width: 28,
    height: 20,
};

/// Rays that the executor works on together.
const GROUP: usize = 64;
/// A depth is right within this part of the box's diagonal.
const DEPTH: f64 = 1e-3;
/// Of the greatest value on a ray: less is zero at an extremum.
const NOISE: f64 = 1e-12;

/// How many rays meet the surface, and on how many the scene is wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// The ray meets the surface in the box.
    pub hits: usize,
    /// Rays whose first root is double to rounding, or nearly so: not judged.
    pub grazing: usize,
    /// It meets it, but the scene shows none.
    pub missed: usize,
    /// The scene shows one where there is none.
    pub invented: usize,
    /// It shows another than the first.
    pub displaced: usize,
    /// Greatest error of the depths that are right, in millionths of the box's diagonal, rounded up.
    pub off: usize,
    /// The depth is right, the normal off by more than a degree.
    pub tilted: usize,
}

impl Counts {
    fn worse(a: &Self, b: &Self) -> Self {
        assert_eq!(a.hits, b.hits, "the rays are the same");
        Self {
            hits: a.hits,
            grazing: a.grazing.max(b.grazing),
            missed: a.missed.max(b.missed),
            invented: a.invented.max(b.invented),
            displaced: a.displaced.max(b.displaced),
            off: a.off.max(b.off),
            tilted: a.tilted.max(b.tilted),
        }
    }
}

/// What the scene found on a ray.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    hit: Option<Vec3>,
    normal: Vec3,
}

fn reals(event: &Event) -> Vec<f64> {
    let number = |shown: &Shown| match *shown {
        Shown::Real(x) => x,
        Shown::Truth(truth) => f64::from(u8::from(truth)),
        Shown::Integer(n) => n as f64,
    };
    event.values.iter().map(number).collect()
}

/// Keeps what `look_at_base` is asked, and what it answers: the point and whether it is a hit; the gradient and value, then the
/// normal.
fn observe(found: &mut [Found], lane: usize, event: &Event) {
    if event.site.function_name != "look_at_base" {
        return;
    }
    match event.site.kind {
        SiteKind::Enter => {
            let values = reals(event);
            assert_eq!(values.len(), 11, "base, direction, hit, on_ground");
            let hit = values[8] > 0.5;
            found[lane].hit = hit.then(|| [values[0], values[1], values[2]]);
        }
        SiteKind::Leave => {
            let values = reals(event);
            assert_eq!(values.len(), 10, "jet, spot, closed");
            found[lane].normal = [values[4], values[5], values[6]];
        }
        SiteKind::Expression(_) | SiteKind::Store(_) => {}
    }
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn along(origin: Vec3, direction: Vec3, t: f64) -> Vec3 {
    [0, 1, 2].map(|k| origin[k] + t * direction[k])
}

/// The camera of the settings, as docs/scenes.md describes it.
struct Camera {
    eye: Vec3,
    /// To the right, up, and towards the viewer.
    axes: [Vec3; 3],
    /// A pixel: at distance 1 in perspective.
    slope: f64,
    parallel: bool,
    center: Vec3,
    half: Vec3,
}

#[derive(Clone, Copy)]
struct Ray {
    origin: Vec3,
    direction: Vec3,
}

fn unit(v: Vec3) -> Vec3 {
    v.map(|c| c / dot(v, v).sqrt())
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

impl Camera {
    fn new(settings: &[SettingValue]) -> Self {
        let value = |name: &str| {
            let found = settings.iter().find(|s| s.spec.name == name);
            found.expect("a setting").value.to_array()
        };
        let number = |name: &str| value(name)[0];
        let (center, half) = (value("center"), value("box"));
        let radius = dot(half, half).sqrt();
        let parallel = number("projection") > 0.5;
        let half_fov = 0.5 * number("fov").to_radians();
        let or = |set: f64, automatic: f64| if set > 0.0 { set } else { automatic };
        let distance = or(number("distance"), 0.98 * radius / half_fov.sin());
        let (eye, axes) = if number("camera") > 0.5 {
            let back = unit(along(value("eye"), value("aim"), -1.0));
            let right = unit(cross(value("up"), back));
            (value("eye"), [right, cross(back, right), back])
        } else {
            let (yaw, pitch) = (number("yaw").to_radians(), number("pitch").to_radians());
            let (across, above) = (pitch.cos(), pitch.sin());
            let back = [across * yaw.cos(), across * yaw.sin(), above];
            let up = [-above * yaw.cos(), -above * yaw.sin(), across];
            let away = if parallel { 8.0 * radius } else { distance };
            let eye = along(center, back, away);
            (eye, [[-yaw.sin(), yaw.cos(), 0.0], up, back])
        };
        let across = if parallel {
            or(number("extent"), 1.96 * radius)
        } else {
            2.0 * half_fov.tan()
        };
        Self {
            eye,
            axes,
            slope: across / f64::from(SIZE.width.min(SIZE.height)),
            parallel,
            center,
            half,
        }
    }

    fn ray(&self, pixel: [f64; 2]) -> Ray {
        let x = self.slope * (pixel[0] - 0.5 * f64::from(SIZE.width));
        let y = -self.slope * (pixel[1] - 0.5 * f64::from(SIZE.height));
        let [right, up, back] = self.axes;
        let aside = along([0, 1, 2].map(|k| x * right[k]), up, y);
        if self.parallel {
            return Ray {
                origin: along(self.eye, aside, 1.0),
                direction: back.map(|c| -c),
            };
        }
        Ray {
            origin: self.eye,
            direction: unit(along(aside, back, -1.0)),
        }
    }

    /// Where the ray is in the box.
    fn span(&self, ray: Ray) -> Option<[f64; 2]> {
        let mut span = [0.0, f64::INFINITY];
        for (k, step) in ray.direction.iter().enumerate() {
            let wall = |side: f64| (self.center[k] + side * self.half[k] - ray.origin[k]) / step;
            let (a, b) = (wall(-1.0), wall(1.0));
            span = [span[0].max(a.min(b)), span[1].min(a.max(b))];
        }
        (span[0] < span[1]).then_some(span)
    }
}

/// The first root on a ray, as a distance.
fn first_root(subject: &mut Subject, degree: u32, camera: &Camera, ray: Ray) -> Option<Root> {
    let [enter, leave] = camera.span(ray)?;
    let place = |x: f64| 0.5 * (enter + leave) + 0.5 * x * (leave - enter);
    let series = Series::fitted(degree as usize, |x| {
        subject.value(along(ray.origin, ray.direction, place(x)))
    });
    let root = *series.roots(NOISE * series.size()).first()?;
    Some(Root {
        at: place(root.at),
        ..root
    })
}

/// Draws a surface ray by ray, and judges what was found, by the shader for any settings and by that for these, which may know
/// more of the surface: what is worse of both counts. `changes` are settings that replace those of its file.
pub fn measure(surface: &Surface, changes: &[(&str, Vec3)]) -> Counts {
    let mut subject = Subject::of(surface.name);
    let picture = &subject.program.pictures()[0];
    let view = View {
        center: [0.0; 2],
        height: 2.0,
    };
    let mut settings = picture.settings.clone();
    fill_in_scale(&mut settings, picture, &view, SIZE, &subject.params, 0.0);
    for setting in &mut settings {
        // No ray of light is of interest here.
        if setting.spec.name == "shadow" {
            setting.value.x = 0.0;
        }
        if let Some((_, value)) = changes.iter().find(|c| c.0 == setting.spec.name) {
            setting.value = (*value).into();
        }
    }
    let scene = subject.program.scene_module(0, Precision::Accurate);
    let scene = scene.unwrap_or_else(|_| panic!("{} has no scene", surface.name));
    let bytes = scene.pack_settings(&settings);
    let params = subject.params.clone();
    let frame = Frame {
        view,
        params: &params,
        settings: &bytes,
        size: SIZE,
        samples: 1,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let camera = Camera::new(&settings);
    let polynomial = subject.polynomial(&[]);
    let gradient = [0, 1, 2].map(|k| polynomial.derivative(k));
    let own = scene.specialised(&settings, 1);
    let shaders = [scene, own.expect("a module for settings")];
    let counts = shaders.map(|scene| {
        let painter =
            Painter::watched(&scene, Arithmetic::Ieee32, Watched::Everything).expect("a painter");
        let mut counts = Counts::default();
        for group in pixels().chunks(GROUP) {
            let mut found = [Found::default(); GROUP];
            let mut observer = |lane: usize, event: &Event| observe(&mut found, lane, event);
            painter
                .trace(&frame, &settings, group, &mut observer)
                .expect("colours");
            for (pixel, found) in group.iter().zip(found) {
                let ray = camera.ray(*pixel);
                let root = first_root(&mut subject, surface.degree, &camera, ray);
                judge(&mut counts, &camera, ray, root, found, &gradient);
            }
        }
        counts
    });
    Counts::worse(&counts[0], &counts[1])
}

fn pixels() -> Vec<[f64; 2]> {
    let rows = (0..SIZE.height).map(|y| f64::from(y) + 0.5);
    let row = |y: f64| (0..SIZE.width).map(move |x| [f64::from(x) + 0.5, y]);
    rows.flat_map(row).collect()
}

fn judge(
    counts: &mut Counts,
    camera: &Camera,
    ray: Ray,
    root: Option<Root>,
    found: Found,
    gradient: &[Polynomial; 3],
) {
    let Some(root) = root else {
        counts.invented += usize::from(found.hit.is_some());
        return;
    };
    if !root.crosses {
        counts.grazing += 1;
        return;
    }
    counts.hits += 1;
    let Some(hit) = found.hit else {
        counts.missed += 1;
        return;
    };
    let depth = dot(along(hit, ray.origin, -1.0), ray.direction);
    let diagonal = 2.0 * dot(camera.half, camera.half).sqrt();
    let off = (depth - root.at).abs() / diagonal;
    if off > DEPTH {
        counts.displaced += 1;
        return;
    }
    counts.off = counts.off.max((1e6 * off).ceil() as usize);
    let p = along(ray.origin, ray.direction, root.at);
    let slope = [0, 1, 2].map(|k| gradient[k].at(p).value);
    let cosine = dot(slope, found.normal).abs() / dot(slope, slope).sqrt();
    counts.tilted += usize::from(cosine < 1f64.to_radians().cos());
}
