//! Pictures of programs on the suites' adapter, and what can be measured in them.

use std::f64::consts::TAU;

use pullback_compiler::compile;
use pullback_compiler::lower::Precision;
use pullback_runtime::{Frame, Gpu, Pipeline, Renderer, Size, View, fill_in_scale};

/// How a picture is taken.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// World coordinates of the centre.
    pub center: [f64; 2],
    /// World units from bottom to top.
    pub height: f64,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Supersamples per axis.
    pub samples: u32,
}

impl Camera {
    /// World units of a pixel.
    #[must_use]
    pub fn pixel(&self) -> f64 {
        self.height / f64::from(self.size[1])
    }

    /// World coordinates of a place in the picture, in pixels from its top left corner.
    #[must_use]
    pub fn world(&self, column: f64, row: f64) -> [f64; 2] {
        let [width, height] = self.size.map(f64::from);
        [
            self.center[0] + (column - 0.5 * width) * self.pixel(),
            self.center[1] - (row - 0.5 * height) * self.pixel(),
        ]
    }
}

/// A picture in linear light.
#[derive(Clone, Debug)]
pub struct Picture {
    /// How it was taken.
    pub camera: Camera,
    /// Linear rgb and alpha of every pixel.
    values: Vec<f32>,
}

impl Picture {
    /// Draws the program's first picture.
    ///
    /// # Panics
    /// It does not compile, or cannot be drawn.
    #[must_use]
    pub fn draw(gpu: &Gpu, source: &str, camera: Camera) -> Self {
        let compiled = compile(source);
        let Some(program) = compiled.program else {
            panic!("{source}: {:?}", compiled.diagnostics);
        };
        let picture = &program.pictures()[0];
        let scene = program
            .scene_module(0, Precision::Accurate)
            .unwrap_or_else(|problems| panic!("{source}: {problems:?}"));
        let [width, height] = camera.size;
        let (view, size) = (
            View {
                center: camera.center,
                height: camera.height,
            },
            Size { width, height },
        );
        let mut settings = picture.settings.clone();
        fill_in_scale(&mut settings, picture, &view, size, &[], 0.0);
        let packed = scene.pack_settings(&settings);
        let frame = Frame {
            view,
            params: &[],
            settings: &packed,
            size,
            samples: camera.samples,
            time: 0.0,
            pipeline: Pipeline::Linear,
        };
        let mut bytes = Vec::new();
        Renderer::new(gpu, &scene)
            .and_then(|mut renderer| renderer.render(&frame, &mut bytes))
            .unwrap_or_else(|error| panic!("{source}: {error}"));
        let words = bytes.as_chunks::<4>().0.iter();
        let values = words.map(|word| f32::from_ne_bytes(*word)).collect();
        Self { camera, values }
    }

    /// A pixel in linear light.
    #[must_use]
    pub fn linear(&self, column: u32, row: u32) -> [f64; 3] {
        let at = 4 * (row * self.camera.size[0] + column) as usize;
        [0, 1, 2].map(|k| f64::from(self.values[at + k]))
    }

    /// A pixel as it is displayed, each component 0 to 255, not rounded.
    #[must_use]
    pub fn displayed(&self, column: u32, row: u32) -> [f64; 3] {
        self.linear(column, row)
            .map(|c| 255.0 * encoded(c.clamp(0.0, 1.0)))
    }

    /// All pixels as they are displayed.
    pub fn pixels(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        let [width, height] = self.camera.size;
        (0..width * height).map(move |k| self.displayed(k % width, k / width))
    }
}

/// Linear light to sRGB (IEC 61966-2-1).
#[must_use]
pub fn encoded(c: f64) -> f64 {
    if c <= 0.003_130_8 {
        12.92 * c
    } else {
        1.055 * c.powf(1.0 / 2.4) - 0.055
    }
}

/// Hue in turns, 0 to 1, and value of a colour of full saturation in linear light, the hue being that of its encoded
/// components (A. R. Smith 1978).
#[must_use]
pub fn hue_and_value(linear: [f64; 3]) -> (f64, f64) {
    let value = linear.into_iter().fold(0.0, f64::max);
    let [r, g, b] = linear.map(|c| encoded((c / value).clamp(0.0, 1.0)));
    let hue = if r >= g && r >= b {
        (g - b).rem_euclid(6.0)
    } else if g >= b {
        2.0 + b - r
    } else {
        4.0 + r - g
    };
    (hue / 6.0, value)
}

/// The argument of a complex number in turns, 0 to 1.
#[must_use]
pub fn turns([re, im]: [f64; 2]) -> f64 {
    (im.atan2(re) / TAU).rem_euclid(1.0)
}

/// Distance of two numbers of turns on the circle.
#[must_use]
pub fn apart(a: f64, b: f64) -> f64 {
    let d = (a - b).rem_euclid(1.0);
    d.min(1.0 - d)
}

/// Numbers in [0, 1), the same in every run: multiples of the golden ratio.
#[derive(Clone, Debug, Default)]
pub struct Random(u32);

impl Random {
    /// The next one.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(2_654_435_769);
        let mut word = self.0;
        word = (word ^ word >> 16).wrapping_mul(0x85eb_ca6b);
        word = (word ^ word >> 13).wrapping_mul(0xc2b2_ae35);
        f64::from(word ^ word >> 16) / 4_294_967_296.0
    }

    /// A whole number from `low` up to, not including, `high`.
    pub fn between(&mut self, low: u32, high: u32) -> u32 {
        low + (self.unit() * f64::from(high - low)) as u32
    }
}
