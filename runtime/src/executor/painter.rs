//! Pictures on the processor: a scene's `compute_main` or `linear_main` for every pixel, tile by tile, on all cores.

use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::available_parallelism;

use pullback_compiler::lower::Format;
use pullback_compiler::scene::setting_component;
use pullback_compiler::{SceneModule, SettingValue};

use super::fault::Fault;
use super::lanes::LANES;
use super::machine::{Limits, MAX_STEPS, Machine};
use super::program::{Component, Contraction, Options, Program, Start, Watched};
use super::{Arithmetic, Observer};
use crate::Error;
use crate::pool::spread;
use crate::render::{Frame, Pipeline, RowSink, Size};
use crate::tiles::Tile;
use crate::uniforms::WideWords;

/// Side of a workgroup of `compute_main`, which is a group of lanes.
const SIDE: u32 = 8;
const _: () = assert!((SIDE * SIDE) as usize == LANES);
/// Side of a tile.
const TILE: u32 = 32;
/// Most pixels that are worked off before their rows are handed over.
const BAND: u32 = 1 << 22;

/// A rectangle of pixels of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Column of its left edge.
    pub x: u32,
    /// Row of its top edge.
    pub y: u32,
    /// Columns and rows.
    pub size: Size,
}

impl From<Window> for Tile {
    fn from(window: Window) -> Self {
        Self {
            x: window.x,
            y: window.y,
            width: window.size.width,
            height: window.size.height,
        }
    }
}

/// A scene's picture, to be computed on the processor.
#[derive(Debug)]
pub struct Painter {
    program: Program,
    format: Format,
    /// Words of a pixel in `image`.
    words: usize,
    /// Steps that the loops of one sample of a pixel may take in all.
    pub steps: u64,
    /// The storage `mesh` of a scene that has one.
    mesh: Vec<u64>,
}

impl Painter {
    /// Translates the scene for pixels in the form of a pipeline; both forms of 8 bits are one here.
    ///
    /// # Errors
    /// [`Error::Executor`] if it holds what none of our scenes does.
    pub fn new(
        scene: &SceneModule,
        arithmetic: Arithmetic,
        pipeline: Pipeline,
    ) -> Result<Self, Error> {
        let entry = match pipeline {
            Pipeline::Linear => "linear_main",
            Pipeline::Compute | Pipeline::Fragment => "compute_main",
        };
        Ok(Self {
            words: pipeline.bytes_per_pixel() / 4,
            ..Self::start(
                scene,
                Start::EntryPoint(entry),
                arithmetic,
                Watched::Nothing,
            )?
        })
    }

    /// Translates the scene to be asked for what it computes on the way to a point of the picture: [`Self::trace`].
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn watched(
        scene: &SceneModule,
        arithmetic: Arithmetic,
        watched: Watched,
    ) -> Result<Self, Error> {
        Self::start(scene, Start::Function("shade"), arithmetic, watched)
    }

    /// Translates the scene to be asked for colours at points of the picture: [`Self::shade`].
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn shader(scene: &SceneModule, arithmetic: Arithmetic) -> Result<Self, Error> {
        Self::start(
            scene,
            Start::Function("shade"),
            arithmetic,
            Watched::Nothing,
        )
    }

    fn start(
        scene: &SceneModule,
        start: Start,
        arithmetic: Arithmetic,
        watched: Watched,
    ) -> Result<Self, Error> {
        let format = scene.tier.precision.format();
        let options = Options {
            arithmetic,
            contraction: Contraction::None,
            format,
            watched,
        };
        Ok(Self {
            program: Program::new(&scene.module, &scene.info, start, options)?,
            format,
            words: 1,
            steps: MAX_STEPS,
            mesh: scene
                .mesh
                .as_flattened()
                .iter()
                .map(|&w| w.into())
                .collect(),
        })
    }

    /// The program that is run.
    #[must_use]
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// Bytes that every core needs.
    #[must_use]
    pub fn bytes(&self) -> usize {
        Machine::new(&self.program).bytes()
    }

    /// Draws the picture and hands its rows to `sink`, until `cancel` is set.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a frame outside of the limits, [`Error::Io`] from the sink, and [`Error::Executor`].
    pub fn render(
        &self,
        frame: &Frame,
        settings: &[SettingValue],
        cancel: &AtomicBool,
        sink: &mut dyn RowSink,
    ) -> Result<(), Error> {
        frame.check()?;
        let (width, height) = (frame.size.width, frame.size.height);
        let total = u64::from(width) * u64::from(height);
        let rows = (BAND / width).max(TILE) / TILE * TILE;
        let mut done = 0;
        for top in (0..height).step_by(rows as usize) {
            let band = Tile {
                x: 0,
                y: top,
                width,
                height: rows.min(height - top),
            };
            let pixels = self.band(frame, settings, band, cancel, &mut |pixels| {
                done += pixels;
                sink.progress(done, total);
            })?;
            sink.rows(&pixels)?;
        }
        Ok(())
    }

    /// Linear colours, with alpha, of the pixels of parts of the picture, each a row after the other, until `cancel` is set.
    /// Only of a painter for [`Pipeline::Linear`].
    ///
    /// # Errors
    /// As [`Self::render`].
    pub fn windows(
        &self,
        frame: &Frame,
        settings: &[SettingValue],
        windows: &[Window],
        cancel: &AtomicBool,
    ) -> Result<Vec<Vec<[f32; 4]>>, Error> {
        frame.check()?;
        let tiles: Vec<Tile> = windows.iter().map(|&window| window.into()).collect();
        let drawn = self.drawn(frame, settings, &tiles, cancel, &mut |_| ())?;
        let number = |word: &u64| f32::from_bits(*word as u32);
        let colour = |words: &[u64; 4]| words.each_ref().map(number);
        let colours = |words: &Vec<u64>| words.as_chunks().0.iter().map(colour).collect();
        Ok(drawn.iter().map(colours).collect())
    }

    fn band(
        &self,
        frame: &Frame,
        settings: &[SettingValue],
        band: Tile,
        cancel: &AtomicBool,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Vec<u8>, Error> {
        let tiles = tiles(band);
        let drawn = self.drawn(frame, settings, &tiles, cancel, progress)?;
        let mut pixels = vec![0; band.pixels() as usize * self.words * 4];
        for (tile, colours) in tiles.iter().zip(&drawn) {
            place(&mut pixels, band, *tile, (colours, self.words));
        }
        Ok(pixels)
    }

    /// Colours of the pixels of tiles, as `image` has them, by all cores; `progress` hears how many are new.
    fn drawn(
        &self,
        frame: &Frame,
        settings: &[SettingValue],
        tiles: &[Tile],
        cancel: &AtomicBool,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Vec<Vec<u64>>, Error> {
        let cores = available_parallelism().map_or(1, usize::from);
        let mut workers = Vec::new();
        for _ in 0..cores.min(tiles.len()) {
            workers.push(self.machine(frame, settings));
        }
        let failed = AtomicBool::new(false);
        let work = |machine: &mut Machine, tile: &Tile| {
            if cancel.load(Ordering::Relaxed) || failed.load(Ordering::Relaxed) {
                return Err(Fault::Cancelled);
            }
            let drawn = self.tile(machine, *tile, cancel);
            if drawn.is_err() {
                failed.store(true, Ordering::Relaxed);
            }
            drawn
        };
        let total: u64 = tiles.iter().map(|tile| tile.pixels()).sum();
        let mut finished = 0;
        let found = spread(workers, tiles, work, || {
            finished += 1;
            let count = tiles.len() as u64;
            progress(total * finished / count - total * (finished - 1) / count);
        });
        let mut fault = None;
        let mut drawn = Vec::with_capacity(tiles.len());
        for colours in found {
            match colours {
                Some(Ok(colours)) => drawn.push(colours),
                // what others met goes before their being stopped for it
                Some(Err(Fault::Cancelled)) => fault = fault.or(Some(Fault::Cancelled)),
                Some(Err(other)) => return Err(other.into()),
                None => return Err(Fault::unsupported("a picture of this kind").into()),
            }
        }
        fault.map_or(Ok(drawn), |fault| Err(fault.into()))
    }

    /// Colours of a tile's pixels, as `image` has them.
    fn tile(
        &self,
        machine: &mut Machine,
        tile: Tile,
        cancel: &AtomicBool,
    ) -> Result<Vec<u64>, Fault> {
        for component in &self.program.inputs {
            let value = match (component.path.as_str(), component.index) {
                ("view.tile", 0) => tile.x,
                ("view.tile", _) => tile.y,
                ("view.tile_size", 0) => tile.width,
                ("view.tile_size", _) => tile.height,
                _ => continue,
            };
            machine.set_uniform(component, component.encode(value.into()));
        }
        let image = self.program.buffer("image");
        if let Some(image) = image.and_then(|k| machine.buffer(k)) {
            image.clear();
            image.resize(tile.pixels() as usize * self.words, 0);
        }
        let limits = Limits {
            steps: self.steps,
            cancel: Some(cancel),
            ..Limits::default()
        };
        for y in (0..tile.height).step_by(SIDE as usize) {
            for x in (0..tile.width).step_by(SIDE as usize) {
                for (k, lane) in (0..SIDE * SIDE).zip(0..) {
                    machine.set_argument(0, lane, (x + k % SIDE).into());
                    machine.set_argument(1, lane, (y + k / SIDE).into());
                }
                machine.run(LANES, limits)?;
            }
        }
        let image = image.and_then(|k| machine.buffer(k));
        Ok(image.map(std::mem::take).unwrap_or_default())
    }

    /// Memory with everything in it that is the same for all tiles.
    fn machine(&self, frame: &Frame, settings: &[SettingValue]) -> Machine<'_> {
        let mut machine = Machine::new(&self.program);
        let inputs = Inputs::new(frame, settings, self.format);
        for component in &self.program.inputs {
            if let Some(value) = inputs.value(component) {
                machine.set_uniform(component, component.encode(value));
            }
        }
        if let Some(mesh) = self.program.buffer("mesh").and_then(|k| machine.buffer(k)) {
            mesh.clone_from(&self.mesh);
            mesh.resize(mesh.len().max(4), 0);
        }
        machine
    }

    /// Linear colours, with alpha, at points of the picture in pixels; y is down.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a frame outside of the limits, and [`Error::Executor`].
    pub fn shade(
        &self,
        frame: &Frame,
        settings: &[SettingValue],
        points: &[[f64; 2]],
    ) -> Result<Vec<[f64; 4]>, Error> {
        self.trace(frame, settings, points, &mut ())
    }

    /// [`Self::shade`], with an observer that sees what is computed on the way.
    ///
    /// # Errors
    /// As [`Self::shade`].
    pub fn trace(
        &self,
        frame: &Frame,
        settings: &[SettingValue],
        points: &[[f64; 2]],
        observer: &mut dyn Observer,
    ) -> Result<Vec<[f64; 4]>, Error> {
        frame.check()?;
        let mut machine = self.machine(frame, settings);
        let limits = Limits {
            steps: self.steps,
            cancel: None,
            ..Limits::default()
        };
        let mut colours = Vec::with_capacity(points.len());
        for group in points.chunks(LANES) {
            for (lane, point) in group.iter().enumerate() {
                for (k, component) in self.program.arguments.iter().enumerate().take(2) {
                    machine.set_argument(k, lane, component.encode(point[k]));
                }
            }
            machine.run_observed(group.len(), limits, observer)?;
            for lane in 0..group.len() {
                let mut colour = [f64::NAN; 4];
                for (k, component) in self.program.results.iter().enumerate().take(4) {
                    colour[k] = component.decode(machine.result(k, lane));
                }
                colours.push(colour);
            }
        }
        Ok(colours)
    }
}

/// The numbers of the uniforms of a scene.
struct Inputs<'a> {
    frame: &'a Frame<'a>,
    settings: &'a [SettingValue],
    wide: Box<WideWords>,
}

impl<'a> Inputs<'a> {
    fn new(frame: &'a Frame, settings: &'a [SettingValue], format: Format) -> Self {
        let (center, pixel) = (frame.view.center, frame.pixel());
        let wide = WideWords::new(format, center, frame.time, pixel, frame.params);
        Self {
            frame,
            settings,
            wide: Box::new(wide),
        }
    }

    fn value(&self, component: &Component) -> Option<f64> {
        let (frame, k) = (self.frame, component.index);
        if let Some(path) = component.path.strip_prefix("settings.") {
            // of a structure within, the last name is the setting's
            let name = path.rsplit('.').next().unwrap_or(path);
            return setting_component(self.settings, name, k);
        }
        let size = [frame.size.width, frame.size.height];
        Some(match component.path.as_str() {
            "view.center" => *frame.view.center.get(k)?,
            "view.size" => f64::from(*size.get(k)?),
            "view.tile" | "view.zero" => 0.0,
            "view.tile_size" => f64::from(*size.get(k)?),
            "view.pixel" => frame.pixel(),
            "view.time" => frame.time,
            "view.samples" => f64::from(frame.samples),
            "params" => frame.params.get(k).copied().unwrap_or(0.0),
            path => return wide_word(&self.wide, path, k),
        })
    }
}

/// A word of the storage `wide`.
pub(super) fn wide_word(wide: &WideWords, path: &str, k: usize) -> Option<f64> {
    let words = match path {
        "wide.center" => wide.center.as_flattened(),
        "wide.clock" => wide.clock.as_flattened(),
        "wide.params" => wide.params.as_flattened(),
        _ => return None,
    };
    words.get(k).copied().map(f64::from)
}

fn tiles(band: Tile) -> Vec<Tile> {
    let mut tiles = Vec::new();
    for y in (0..band.height).step_by(TILE as usize) {
        for x in (0..band.width).step_by(TILE as usize) {
            tiles.push(Tile {
                x,
                y: band.y + y,
                width: TILE.min(band.width - x),
                height: TILE.min(band.height - y),
            });
        }
    }
    tiles
}

/// Copies a tile's colours, of so many words each, into the bytes of a band.
fn place(pixels: &mut [u8], band: Tile, tile: Tile, (colours, words): (&[u64], usize)) {
    let stride = band.width as usize * words * 4;
    let lines = colours.chunks(tile.width as usize * words);
    for (line, row) in lines.zip((tile.y - band.y) as usize..) {
        let start = row * stride + tile.x as usize * words * 4;
        for (pixel, &colour) in pixels[start..].chunks_exact_mut(4).zip(line) {
            pixel.copy_from_slice(&(colour as u32).to_le_bytes());
        }
    }
}
