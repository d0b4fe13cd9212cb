//! Whole programs written by hand, one for each scene, beside what the compiler makes: how long a frame takes and how
//! far it is from the f64 reference.

mod canvas;
mod clock;
mod count;

use std::fmt;

use naga::Module;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use pullback_compiler::lower::Precision;
use pullback_runtime::difference::{Bitmap, compare};
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::{Error, Gpu, Pipeline, Size};

use crate::stills::{Machine, Still};
pub use canvas::{Canvas, Stage};
pub use count::{Count, count};

/// A scene's twin, and the program whose picture it is.
#[derive(Clone, Copy, Debug)]
pub struct Twin {
    /// The scene.
    pub scene: &'static str,
    /// The file of the gallery.
    pub formula: &'static str,
    /// Its text.
    program: &'static str,
    /// Settings that are automatic there, as the twin has them.
    automatic: &'static [(&'static str, f64)],
    /// The twin's text, after the common one.
    parts: &'static [&'static str],
}

macro_rules! twin {
    ($scene:literal, $formula:literal, $automatic:expr, $($part:literal),+) => {
        Twin {
            scene: $scene,
            formula: $formula,
            program: include_str!(concat!("../../docs/gallery/", $formula, ".pull")),
            automatic: &$automatic,
            parts: &[$(include_str!(concat!("../twins/", $part, ".wgsl"))),+],
        }
    };
}

/// What all twins begin with.
const COMMON: &str = include_str!("../twins/common.wgsl");

/// The twins of all scenes.
pub const TWINS: [Twin; 17] = [
    twin!("levels", "chladni", [("color_scale", 0.4)], "levels"),
    twin!("logcontours", "charges", [], "logcontours"),
    twin!("bands", "zone-plate", [], "bands"),
    twin!("implicit", "folium", [], "implicit"),
    twin!("domain", "blaschke", [], "complex", "domain"),
    twin!("checker", "confocal", [], "checker"),
    twin!("grid", "lambert", [], "complex", "grid"),
    twin!("sphere", "doyle-mcmullen", [], "complex", "sphere"),
    twin!("slices", "multipole", [], "slices"),
    twin!("surface", "cayley", [], "surface"),
    twin!("nested", "schwarz-family", [], "shells", "nested"),
    twin!("cutaway", "neovius", [], "shells", "cutaway"),
    twin!(
        "volume",
        "orbital",
        [("color_scale", 8.0)],
        "medium",
        "volume"
    ),
    twin!(
        "volumecut",
        "resonance",
        [("color_scale", 0.4)],
        "medium",
        "volumecut"
    ),
    twin!("scatter", "cloud", [], "scatter"),
    twin!("additive", "hologram", [], "additive"),
    twin!("glow", "ember", [], "glow"),
];

impl Twin {
    /// The whole text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = COMMON.to_owned();
        for part in self.parts {
            text += part;
        }
        text
    }

    /// The twin's module.
    ///
    /// # Panics
    /// It is no valid WGSL.
    #[must_use]
    pub fn module(&self) -> (Module, ModuleInfo) {
        parsed(self.scene, &self.text())
    }

    /// The picture that the compiler makes a module of.
    #[must_use]
    pub fn still(&self, size: Size, precision: Precision) -> Still {
        let mut still = Still::in_precision(self.program, size, 1, precision);
        for setting in &mut still.settings {
            let wanted = self.automatic.iter().find(|a| a.0 == setting.spec.name);
            if let Some(&(_, value)) = wanted {
                setting.value.x = value;
            }
        }
        still
    }
}

/// The module of a text.
///
/// # Panics
/// It is no valid WGSL.
#[must_use]
pub fn parsed(name: &str, text: &str) -> (Module, ModuleInfo) {
    let module = naga::front::wgsl::parse_str(text)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(text)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(text)));
    (module, info)
}

/// How far a picture is from the reference.
#[derive(Clone, Copy, Debug)]
pub struct Off {
    /// Mean of FLIP.
    pub flip: f64,
    /// Root of the mean square of the difference of a channel, of 255.
    pub rms: f64,
    /// The share of pixels of which a channel is off by more than 8 of 255.
    pub share: f64,
}

impl fmt::Display for Off {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:.4}, {:.2}, {:.2} %",
            self.flip,
            self.rms,
            100.0 * self.share
        )
    }
}

impl Off {
    /// Of two pictures.
    ///
    /// # Errors
    /// Their sizes differ.
    pub fn new(truth: &Bitmap, test: &Bitmap) -> Result<Self, Error> {
        let flip = compare(truth, test, &mut |_, _| ())?.perceptual.mean;
        let (mut sum, mut many) = (0.0, 0);
        for (a, b) in truth.pixels().iter().zip(test.pixels()) {
            let off = [0, 1, 2].map(|k| f64::from(a[k].abs_diff(b[k])));
            sum += off.iter().map(|x| x * x).sum::<f64>();
            many += usize::from(off.iter().any(|&x| x > 8.0));
        }
        let pixels = truth.pixels().len().max(1) as f64;
        Ok(Self {
            flip,
            rms: (sum / (3.0 * pixels)).sqrt(),
            share: many as f64 / pixels,
        })
    }
}

/// What was measured of a twin.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Seconds of a frame: ours in `accurate`, in `fast`, and the twin's.
    pub seconds: [f64; 3],
    /// Medians of ratios of the turns: ours to the twin's, in `accurate` and in `fast`.
    pub ratios: [f64; 2],
    /// Distances from the reference: ours in `accurate`, in `fast`, the twin's.
    pub off: Option<[Off; 3]>,
    /// The reference, and the three pictures.
    pub pictures: Vec<(&'static str, Bitmap)>,
}

/// How to measure.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Pixels of a timed frame.
    pub size: Size,
    /// Pixels of the pictures that are compared with the reference.
    pub small: Size,
    /// Turns.
    pub turns: u32,
    /// Whether to compare with the reference, which takes its time.
    pub reference: bool,
    /// Whether our shaders read their settings, so that these could change, instead of being made for them.
    pub general: bool,
    /// WGSL of a scene that is measured in the place of `fast`, to find out what costs.
    pub instead: Option<String>,
}

/// Draws ours and the twin's in turns.
///
/// # Errors
/// The device's, and the executor's.
pub fn measure(twin: &Twin, gpu: &Gpu, plan: &Plan) -> Result<Measured, Error> {
    let precisions = [Precision::Accurate, Precision::Fast];
    let ours = precisions.map(|precision| twin.still(plan.size, precision));
    let canvas = Canvas::new(gpu, &ours[0])?;
    let scenes = ours.each_ref().map(|still| still.shader(plan.general));
    let (module, info) = twin.module();
    let second = match &plan.instead {
        Some(text) => {
            let (module, info) = parsed("--instead", text);
            canvas.stage(&module, &info)?
        }
        None => canvas.stage(&scenes[1].module, &scenes[1].info)?,
    };
    let stages = [
        canvas.stage(&scenes[0].module, &scenes[0].info)?,
        second,
        canvas.stage(&module, &info)?,
    ];
    let turns = canvas.turns(&stages, plan.turns)?;
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let of = |k: usize| median(turns.iter().map(|turn| turn[k]).collect());
    let ratio = |k: usize| median(turns.iter().map(|turn| turn[k] / turn[2]).collect());
    let (off, pictures) = if plan.reference {
        compared(twin, gpu, plan)?
    } else {
        (None, Vec::new())
    };
    Ok(Measured {
        seconds: [0, 1, 2].map(of),
        ratios: [ratio(0), ratio(1)],
        off,
        pictures,
    })
}

type Pictures = Vec<(&'static str, Bitmap)>;

/// The small pictures, and how far they are from the reference.
fn compared(twin: &Twin, gpu: &Gpu, plan: &Plan) -> Result<(Option<[Off; 3]>, Pictures), Error> {
    let ours = [Precision::Accurate, Precision::Fast].map(|p| twin.still(plan.small, p));
    let canvas = Canvas::new(gpu, &ours[0])?;
    let machine = Machine::Adapter(gpu.clone());
    let bitmap = |rows: Vec<u8>| Bitmap::from_rgba(plan.small, &rows);
    let (module, info) = twin.module();
    let drawn = [
        bitmap(ours[0].draw(&machine, Pipeline::Compute)?)?,
        bitmap(ours[1].draw(&machine, Pipeline::Compute)?)?,
        bitmap(canvas.picture(&canvas.stage(&module, &info)?)?)?,
    ];
    let reference = Machine::Processor(Arithmetic::Reference);
    let truth = bitmap(ours[0].draw(&reference, Pipeline::Compute)?)?;
    let off = [
        Off::new(&truth, &drawn[0])?,
        Off::new(&truth, &drawn[1])?,
        Off::new(&truth, &drawn[2])?,
    ];
    let names = ["accurate", "fast", "twin"];
    let mut pictures = vec![("reference", truth)];
    pictures.extend(names.into_iter().zip(drawn));
    Ok((Some(off), pictures))
}
