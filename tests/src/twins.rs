//! Whole programs written by hand, one for each scene, beside what the compiler makes: how long a frame takes and how
//! far it is from the f64 reference.

mod count;

use std::ops::Deref;

use pullback_compiler::lower::Precision;
use pullback_runtime::bench;
pub use pullback_runtime::bench::canvas::{Canvas, Stage};
pub use pullback_runtime::bench::twins::Off;
use pullback_runtime::bench::twins::{Times, times, twin_stages};
use pullback_runtime::difference::Bitmap;
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::{Error, Gpu, Pipeline, Size};

use crate::stills::{Machine, Still};
pub use count::{Count, count};

/// A scene's twin, and the program whose picture it is.
#[derive(Clone, Copy, Debug)]
pub struct Twin(bench::twins::Twin);

impl Deref for Twin {
    type Target = bench::twins::Twin;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

/// The twins of all scenes.
pub const TWINS: [Twin; bench::twins::TWINS.len()] = {
    let mut all = [Twin(bench::twins::TWINS[0]); bench::twins::TWINS.len()];
    let mut k = 0;
    while k < all.len() {
        all[k] = Twin(bench::twins::TWINS[k]);
        k += 1;
    }
    all
};

impl Twin {
    /// The picture that the compiler makes a module of.
    ///
    /// # Panics
    /// The program does not compile.
    #[must_use]
    pub fn still(&self, size: Size, precision: Precision) -> Still {
        let mut still = Still::in_precision(self.program, size, 1, precision);
        self.fill_in(&mut still.settings);
        still
    }
}

/// What was measured of a twin.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Seconds of a frame: ours in `accurate`, in `fast`, and the twin's.
    pub seconds: [f64; 3],
    /// Medians of ratios of the turns: ours to the twin's, in `accurate` and in `fast`, and the latter to the twin without
    /// checks of its loops.
    pub ratios: [f64; 3],
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
    let settings = ours[0].scene.pack_settings(&ours[0].settings);
    let canvas = Canvas::new(gpu, &ours[0].frame(&settings, Pipeline::Compute))?;
    let scenes = ours.each_ref().map(|still| still.shader(plan.general));
    let second = match &plan.instead {
        Some(text) => {
            let (module, info) = bench::twins::module(text)?;
            canvas.stage(&module, &info)?
        }
        None => canvas.stage(&scenes[1].module, &scenes[1].info)?,
    };
    let first = canvas.stage(&scenes[0].module, &scenes[0].info)?;
    let [checked, unchecked] = twin_stages(&canvas, twin)?;
    let stages = [first, second, checked, unchecked];
    let Times { seconds, ratios } = times(&canvas, &stages, plan.turns)?;
    let (off, pictures) = if plan.reference {
        compared(twin, gpu, plan)?
    } else {
        (None, Vec::new())
    };
    Ok(Measured {
        seconds,
        ratios,
        off,
        pictures,
    })
}

type Pictures = Vec<(&'static str, Bitmap)>;

/// The small pictures, and how far they are from the reference.
fn compared(twin: &Twin, gpu: &Gpu, plan: &Plan) -> Result<(Option<[Off; 3]>, Pictures), Error> {
    let ours = [Precision::Accurate, Precision::Fast].map(|p| twin.still(plan.small, p));
    let settings = ours[0].scene.pack_settings(&ours[0].settings);
    let canvas = Canvas::new(gpu, &ours[0].frame(&settings, Pipeline::Compute))?;
    let machine = Machine::Adapter(gpu.clone());
    let bitmap = |rows: Vec<u8>| Bitmap::from_rgba(plan.small, &rows);
    let (module, info) = twin.module()?;
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
