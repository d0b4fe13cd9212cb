//! A whole program written by hand for each scene, beside what the compiler makes: how long a frame takes, and how far it is
//! from the f64 reference.

use std::fmt;

use naga::Module;
use naga::valid::ModuleInfo;
use pullback_compiler::SettingValue;

use super::canvas::{Canvas, Stage};
use super::statistics::median;
use super::wgsl::{parsed, validated};
use crate::Error;
use crate::difference::{Bitmap, compare};

/// A scene's twin, and the program whose picture it is.
#[derive(Clone, Copy, Debug)]
pub struct Twin {
    /// The scene.
    pub scene: &'static str,
    /// The file of the gallery.
    pub formula: &'static str,
    /// Its text.
    pub program: &'static str,
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
            program: include_str!(concat!("../../../docs/gallery/", $formula, ".pull")),
            automatic: &$automatic,
            parts: &[$(include_str!(concat!("twins/", $part, ".wgsl"))),+],
        }
    };
}

/// What all twins begin with.
const COMMON: &str = include_str!("twins/common.wgsl");

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
    /// # Errors
    /// It is no valid WGSL.
    pub fn module(&self) -> Result<(Module, ModuleInfo), Error> {
        module(&self.text())
    }

    /// Gives settings that are automatic the values that the twin has.
    pub fn fill_in(&self, settings: &mut [SettingValue]) {
        for setting in settings {
            let wanted = self.automatic.iter().find(|a| a.0 == setting.spec.name);
            if let Some(&(_, value)) = wanted {
                setting.value.x = value;
            }
        }
    }
}

/// The module of a text.
///
/// # Errors
/// It is no valid WGSL.
pub fn module(text: &str) -> Result<(Module, ModuleInfo), Error> {
    let module = parsed(text)?;
    let info = validated(&module)?;
    Ok((module, info))
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
            many += u64::from(off.iter().any(|&x| x > 8.0));
        }
        let pixels = truth.pixels().len().max(1) as f64;
        Ok(Self {
            flip,
            rms: (sum / (3.0 * pixels)).sqrt(),
            share: many as f64 / pixels,
        })
    }
}

/// Times of a frame.
#[derive(Clone, Copy, Debug)]
pub struct Times {
    /// Seconds of ours in `accurate`, in `fast`, and of the twin's.
    pub seconds: [f64; 3],
    /// Medians of ratios of the turns: ours to the twin's, in `accurate` and in `fast`, and the latter to the twin without
    /// checks of its loops.
    pub ratios: [f64; 3],
}

/// The twin as wgpu loads a text, and loaded as ours are, without checks of its loops.
///
/// # Errors
/// The device's, or it is no valid WGSL.
pub fn twin_stages(canvas: &Canvas, twin: &Twin) -> Result<[Stage; 2], Error> {
    let (module, info) = twin.module()?;
    Ok([
        canvas.stage_checked(&module)?,
        canvas.stage(&module, &info)?,
    ])
}

/// Draws ours in `accurate` and in `fast`, and the twin's, with and without checks of its loops, in turns.
///
/// # Errors
/// The device's.
pub fn times(canvas: &Canvas, stages: &[Stage; 4], turns: u32) -> Result<Times, Error> {
    let turns = canvas.turns(stages, turns)?;
    let of = |number: &dyn Fn(&[f64; 4]) -> f64| {
        let all: Vec<f64> = turns.iter().map(number).collect();
        median(&all)
    };
    Ok(Times {
        seconds: [0, 1, 2].map(|k| of(&|turn| turn[k])),
        ratios: [[0, 2], [1, 2], [1, 3]].map(|[k, other]| of(&|turn| turn[k] / turn[other])),
    })
}
