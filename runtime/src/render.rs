//! Pictures: a scene's shader module run over every pixel, tile by tile.

mod compute;
mod fragment;
mod sums;

use std::io;
use std::time::Instant;

use pullback_compiler::lower::Format;
use pullback_compiler::{SceneModule, SettingValue};

use crate::clock::Clock;
use crate::probe::turns;
use crate::tiles::{self, Budget, Pending, Tile};
use crate::uniforms::{self, MAX_PARAMS, ViewUniform, WideWords};
use crate::{Error, Gpu, buffers, shader};

use compute::ComputeStage;
use fragment::FragmentStage;
use sums::SumStage;

/// Largest width and height of a picture.
pub const MAX_SIDE: u32 = 16384;
/// Most supersamples per axis.
pub const MAX_SAMPLES: u32 = 16;

/// Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// The part of the world that a picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// World coordinates of the centre.
    pub center: [f64; 2],
    /// World units from the bottom to the top edge.
    pub height: f64,
}

/// Which shader stage computes the pixels, and in what form. The picture is the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pipeline {
    /// A compute shader: fast on data-centre GPUs too.
    #[default]
    Compute,
    /// A fragment shader, as in a web page or a game.
    Fragment,
    /// A compute shader whose pixels are linear rgb and alpha, four `f32` each, not clamped.
    Linear,
}

impl Pipeline {
    /// Bytes of a pixel in the rows that a [`RowSink`] gets.
    #[must_use]
    pub fn bytes_per_pixel(self) -> usize {
        match self {
            Self::Compute | Self::Fragment => 4,
            Self::Linear => 16,
        }
    }
}

/// One picture to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame<'a> {
    /// What is seen.
    pub view: View,
    /// Values of the program's parameters in order.
    pub params: &'a [f64],
    /// Bytes of the scene's settings, from [`SceneModule::pack_settings`].
    pub settings: &'a [u8],
    /// The whole image.
    pub size: Size,
    /// Supersamples per axis, from 1 to [`MAX_SAMPLES`].
    pub samples: u32,
    /// The animation clock in seconds.
    pub time: f64,
    /// The stage that does it.
    pub pipeline: Pipeline,
}

/// Least number of representable points of the plane from one pixel to the next, along each axis, for which a picture
/// counts as resolved: with two, the error of a pixel's point is a quarter of a pixel.
const POINTS_PER_PIXEL: f64 = 2.0;

impl Frame<'_> {
    /// World units per pixel.
    #[must_use]
    pub fn pixel(&self) -> f64 {
        self.view.height / f64::from(self.size.height)
    }

    /// Samples of a pixel.
    pub(crate) fn samples_of_pixel(&self) -> u32 {
        self.samples * self.samples
    }

    /// Says what is wrong with the frame, whatever the scene.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a frame outside of the limits.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let invalid = |reason: String| Err(Error::Invalid { reason });
        let Size { width, height } = self.size;
        if width == 0 || height == 0 || width > MAX_SIDE || height > MAX_SIDE {
            return invalid(format!(
                "a picture of {width}x{height} pixels: each side must be 1 to {MAX_SIDE}"
            ));
        }
        if self.samples == 0 || self.samples > MAX_SAMPLES {
            return invalid(format!(
                "{} samples per axis: must be 1 to {MAX_SAMPLES}",
                self.samples
            ));
        }
        if self.params.len() > MAX_PARAMS {
            return invalid(format!(
                "{} parameters: at most {MAX_PARAMS}",
                self.params.len()
            ));
        }
        let pixel = self.pixel() as f32;
        if !(pixel.is_normal() && pixel > 0.0) {
            return invalid(format!(
                "a view of height {}: must be a positive number within single precision",
                self.view.height
            ));
        }
        if !self.view.center.iter().all(|c| (*c as f32).is_finite()) {
            return invalid("the centre of the view must be finite in single precision".into());
        }
        Ok(())
    }

    /// Whether a format tells the points of neighbouring pixels apart, everywhere in the view.
    #[must_use]
    pub fn is_resolved(&self, format: Format) -> bool {
        let pixel = self.pixel();
        let half = [self.size.width, self.size.height].map(|side| 0.5 * f64::from(side) * pixel);
        let reach = (0..2).map(|k| self.view.center[k].abs() + half[k]);
        let spacing =
            |reach: f64| reach.log2().floor().exp2() * 0.5f64.powi(format.bits() as i32 - 1);
        reach
            .into_iter()
            .all(|reach| pixel >= POINTS_PER_PIXEL * spacing(reach))
    }
}

/// Takes the rows of a picture from top to bottom.
pub trait RowSink {
    /// Takes whole rows, in the form of the frame's [`Pipeline`]: 8-bit sRGB with alpha, or linear `f32`.
    ///
    /// # Errors
    /// Whatever writing them meets; the picture is then given up.
    fn rows(&mut self, rgba: &[u8]) -> io::Result<()>;

    /// Hears that `done` of `total` pixels are computed.
    fn progress(&mut self, done: u64, total: u64) {
        let _ = (done, total);
    }
}

/// Collects the whole picture in memory.
impl RowSink for Vec<u8> {
    fn rows(&mut self, rgba: &[u8]) -> io::Result<()> {
        self.extend_from_slice(rgba);
        Ok(())
    }
}

/// A scene's shader on a device with its pipelines and buffers: change anything in the [`Frame`] and render again
/// without any compilation; anything but settings and samples, if it was made for some ([`Self::for_settings`]). The pipelines are made when first used.
#[derive(Debug)]
pub struct Renderer {
    gpu: Gpu,
    shader: wgpu::ShaderModule,
    format: Format,
    uniforms: Uniforms,
    /// The settings and the samples per axis that the module is made for, if it is made for some alone.
    fixed: Option<(Vec<u8>, u32)>,
    compute: Option<ComputeStage>,
    fragment: Option<FragmentStage>,
    linear: Option<ComputeStage>,
    sums: Option<SumStage>,
    /// Whether the module can add samples up. One that looks for something in a picture, and draws none, need not.
    adds_up: bool,
    /// Turns after which the adapter ends all loops of an invocation without an error, where it does.
    turns: Option<u32>,
    /// Samples of a pixel that a submission may have for that, as far as is known from pictures before.
    most: u32,
}

/// The buffers at bindings 0 to 4, which every tile reads.
#[derive(Debug)]
struct Uniforms {
    view: wgpu::Buffer,
    params: wgpu::Buffer,
    settings: wgpu::Buffer,
    wide: wgpu::Buffer,
    mesh: wgpu::Buffer,
}

impl Renderer {
    /// Loads the scene's module, that the compiler has validated, onto the device.
    ///
    /// # Errors
    /// [`Error::Device`] if the device does not take it.
    pub fn new(gpu: &Gpu, scene: &SceneModule) -> Result<Self, Error> {
        Ok(Self {
            gpu: gpu.clone(),
            shader: shader::load(gpu, &scene.module, &scene.info, scene.tier)?,
            format: scene.tier.precision.format(),
            uniforms: Uniforms {
                view: buffers::uniform(gpu, "view", size_of::<ViewUniform>())?,
                params: buffers::uniform(gpu, "params", size_of::<[f32; MAX_PARAMS]>())?,
                settings: buffers::uniform(gpu, "settings", scene.settings_size.max(16))?,
                wide: buffers::wide(gpu)?,
                mesh: buffers::mesh(gpu, &scene.mesh)?,
            },
            fixed: scene
                .made_for()
                .map(|(settings, samples)| (settings.to_vec(), samples)),
            compute: None,
            fragment: None,
            linear: None,
            sums: None,
            adds_up: ["sum_main", "encode_main"].iter().all(|name| {
                let mut entries = scene.module.entry_points.iter();
                entries.any(|entry| entry.name == *name)
            }),
            turns: turns::limit(gpu)?,
            most: u32::MAX,
        })
    }

    /// Loads the scene for pictures with these settings and samples per axis alone: they become constants of the shader, which is smaller and faster.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn for_settings(
        gpu: &Gpu,
        scene: &SceneModule,
        settings: &[SettingValue],
        samples: u32,
    ) -> Result<Self, Error> {
        let specialised = scene.specialised(settings, samples).map_err(|error| {
            let reason = format!("the scene cannot be made for its settings: {error:?}");
            Error::Invalid { reason }
        })?;
        Self::new(gpu, &specialised)
    }

    /// The device.
    #[must_use]
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Draws the picture and hands its rows to `sink`.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a frame outside of the limits, [`Error::Io`] from the sink, and the device's errors.
    pub fn render(&mut self, frame: &Frame, sink: &mut dyn RowSink) -> Result<(), Error> {
        self.check(frame)?;
        let budget = self.budget(frame)?;
        self.render_within(frame, budget, sink)
    }

    /// Seconds for a picture by the device's own clock, the mean of `repeats` in one submission; `None` where it has none,
    /// where the whole picture does not fit one pass, or where its loops might end early. What is drawn is not read: a caller
    /// knows from [`Self::render`] that a picture is short enough for a submission.
    ///
    /// # Errors
    /// As [`Self::render`].
    pub fn device_time(&mut self, frame: &Frame, repeats: u32) -> Result<Option<f64>, Error> {
        self.check(frame)?;
        let gpu = self.gpu.clone();
        let Some(clock) = Clock::new(&gpu)?.filter(|_| self.turns.is_none()) else {
            return Ok(None);
        };
        self.upload(frame)?;
        let Size { width, height } = frame.size;
        let tile = Tile {
            x: 0,
            y: 0,
            width,
            height,
        };
        let view = view_uniform(frame, tile);
        gpu.guarded("upload", || {
            let queue = gpu.queue();
            queue.write_buffer(&self.uniforms.view, 0, bytemuck::bytes_of(&view));
            queue.submit([]);
        })?;
        let uniforms = self.uniforms.share();
        let (slot, pipeline) = match frame.pipeline {
            Pipeline::Linear => (&mut self.linear, Pipeline::Linear),
            Pipeline::Compute | Pipeline::Fragment => (&mut self.compute, Pipeline::Compute),
        };
        let stage = match slot {
            Some(stage) => stage,
            empty => empty.insert(ComputeStage::new(&gpu, &self.shader, pipeline)?),
        };
        let fits = tile.pixels() <= stage.max_pixels() && width.max(height) <= stage.max_side();
        if !fits {
            return Ok(None);
        }
        let (encoder, _) = stage.pass(&gpu, &uniforms, tile, repeats, Some(&clock))?;
        let submission = gpu.guarded("timing", || gpu.queue().submit([encoder.finish()]))?;
        gpu.wait("timing", submission)?;
        Ok(Some(clock.read(&gpu)? / f64::from(repeats.max(1))))
    }

    fn budget(&mut self, frame: &Frame) -> Result<Budget, Error> {
        let (most, software) = (self.most, self.gpu.adapter().is_software());
        let sums = sums::max_pixels(&self.gpu);
        let stage = self.stage(frame.pipeline)?;
        let (pixels, side) = (stage.max_pixels().min(sums), stage.max_side());
        let budget = Budget::new(frame.samples, pixels, side).with_most(most);
        Ok(if software {
            budget
        } else {
            budget.filling(frame.size)
        })
    }

    fn render_within(
        &mut self,
        frame: &Frame,
        mut budget: Budget,
        sink: &mut dyn RowSink,
    ) -> Result<(), Error> {
        self.upload(frame)?;
        let Size { width, height } = frame.size;
        let total = u64::from(width) * u64::from(height);
        let first = tiles::probe(width, height, frame.samples);
        // Twice: the first run of a pipeline may still compile.
        for _ in 0..2 {
            self.tile(frame, first, &mut budget, |_, _| ())?;
        }
        let mut band = Vec::new();
        let pixel = frame.pipeline.bytes_per_pixel();
        let mut done = 0;
        let mut top = 0;
        while top < height {
            let rows = tiles::band_height(width, height - top, &budget);
            band.resize(width as usize * rows as usize * pixel, 0);
            let mut pending = Pending::new(Tile {
                x: 0,
                y: top,
                width,
                height: rows,
            });
            while let Some(tile) = pending.next(&budget) {
                self.tile(frame, tile, &mut budget, |bytes, stride| {
                    let line = width as usize * pixel;
                    place(&mut band, line, pixel, (tile, top), bytes, stride);
                })?;
                done += tile.pixels();
                sink.progress(done, total);
            }
            sink.rows(&band)?;
            top += rows;
        }
        Ok(())
    }

    fn check(&self, frame: &Frame) -> Result<(), Error> {
        frame.check()?;
        let settings = frame.settings.len();
        if settings as u64 > self.uniforms.settings.size() || !settings.is_multiple_of(4) {
            let reason = format!(
                "{settings} bytes of settings for a scene that has {}",
                self.uniforms.settings.size()
            );
            return Err(Error::Invalid { reason });
        }
        let is_other = |(settings, samples): &(Vec<u8>, u32)| {
            settings != frame.settings || *samples != frame.samples
        };
        if self.fixed.as_ref().is_some_and(is_other) {
            let reason = "the scene was made for other settings or samples".to_owned();
            return Err(Error::Invalid { reason });
        }
        Ok(())
    }

    /// Writes what is the same for all tiles.
    fn upload(&self, frame: &Frame) -> Result<(), Error> {
        let View { center, height } = frame.view;
        let pixel = height / f64::from(frame.size.height);
        let wide = WideWords::new(self.format, center, frame.time, pixel, frame.params);
        self.gpu.guarded("upload", || {
            let queue = self.gpu.queue();
            let params = uniforms::params(frame.params);
            queue.write_buffer(&self.uniforms.params, 0, bytemuck::bytes_of(&params));
            queue.write_buffer(&self.uniforms.settings, 0, frame.settings);
            queue.write_buffer(&self.uniforms.wide, 0, bytemuck::bytes_of(&wide));
        })
    }

    /// The stage, made if this is its first use.
    fn stage(&mut self, pipeline: Pipeline) -> Result<&mut dyn Stage, Error> {
        let (gpu, shader, uniforms) = (&self.gpu, &self.shader, &self.uniforms);
        Ok(match pipeline {
            Pipeline::Linear => match &mut self.linear {
                Some(stage) => stage,
                empty => empty.insert(ComputeStage::new(gpu, shader, pipeline)?),
            },
            Pipeline::Compute => match &mut self.compute {
                Some(stage) => stage,
                empty => empty.insert(ComputeStage::new(gpu, shader, pipeline)?),
            },
            Pipeline::Fragment => match &mut self.fragment {
                Some(stage) => stage,
                empty => empty.insert(FragmentStage::new(gpu, shader, uniforms)?),
            },
        })
    }

    /// Computes one tile, shows its bytes, with the number of bytes from row to row, to `look`, and learns what it costs.
    fn tile(
        &mut self,
        frame: &Frame,
        tile: Tile,
        budget: &mut Budget,
        look: impl FnOnce(&[u8], usize),
    ) -> Result<(), Error> {
        let view = view_uniform(frame, tile);
        self.gpu.guarded("upload", || {
            let queue = self.gpu.queue();
            queue.write_buffer(&self.uniforms.view, 0, bytemuck::bytes_of(&view));
        })?;
        // Only sums tell whether loops have ended early.
        let whole = self.turns.is_none() && budget.share(tile) == frame.samples_of_pixel();
        if whole || !self.adds_up {
            self.whole_tile(frame, tile, budget, look)
        } else {
            self.tile_in_parts(frame, tile, budget, look)
        }
    }

    /// All samples in one submission.
    fn whole_tile(
        &mut self,
        frame: &Frame,
        tile: Tile,
        budget: &mut Budget,
        look: impl FnOnce(&[u8], usize),
    ) -> Result<(), Error> {
        let start = Instant::now();
        let gpu = self.gpu.clone();
        // The uniforms are cheap handles; the stage borrows the renderer.
        let uniforms = self.uniforms.share();
        let Recorded {
            encoder,
            readable,
            bytes,
            stride,
        } = self.stage(frame.pipeline)?.record(&gpu, &uniforms, tile)?;
        buffers::submit_and_read(&gpu, "rendering", encoder, &readable, bytes, |pixels| {
            look(pixels, stride);
        })?;
        budget.learn(tile, frame.samples_of_pixel(), start.elapsed());
        Ok(())
    }

    /// Some samples in each submission; fewer, if otherwise loops end early.
    fn tile_in_parts(
        &mut self,
        frame: &Frame,
        tile: Tile,
        budget: &mut Budget,
        look: impl FnOnce(&[u8], usize),
    ) -> Result<(), Error> {
        let gpu = self.gpu.clone();
        let stage = match &mut self.sums {
            Some(stage) => stage,
            empty => empty.insert(SumStage::new(&gpu, &self.shader)?),
        };
        loop {
            let sums = stage.draw(&self.uniforms, frame, tile, budget)?;
            if let Some(rows) = sums.rows {
                look(
                    &rows,
                    tile.width as usize * frame.pipeline.bytes_per_pixel(),
                );
                return Ok(());
            }
            if sums.largest_part == 1 {
                return Err(Error::Turns {
                    adapter: gpu.adapter().name.clone(),
                    turns: self.turns.unwrap_or_default(),
                });
            }
            self.most = sums.largest_part / 2;
            *budget = budget.with_most(self.most);
        }
    }
}

impl Uniforms {
    fn share(&self) -> Self {
        Self {
            view: self.view.clone(),
            params: self.params.clone(),
            settings: self.settings.clone(),
            wide: self.wide.clone(),
            mesh: self.mesh.clone(),
        }
    }

    /// Bindings 0 to 4.
    fn entries(&self) -> [wgpu::BindGroupEntry<'_>; 5] {
        let buffers = [
            (0, &self.view),
            (1, &self.params),
            (2, &self.settings),
            (3, &self.wide),
            (4, &self.mesh),
        ];
        buffers.map(|(binding, buffer)| wgpu::BindGroupEntry {
            binding,
            resource: buffer.as_entire_binding(),
        })
    }
}

/// A way of computing tiles.
trait Stage {
    /// Most pixels in a tile.
    fn max_pixels(&self) -> u64;
    /// Longest side of a tile.
    fn max_side(&self) -> u32;
    /// Records the work for a tile whose uniforms are in place.
    fn record(&mut self, gpu: &Gpu, uniforms: &Uniforms, tile: Tile) -> Result<Recorded, Error>;
}

/// A tile's commands, and where its pixels will be.
struct Recorded {
    encoder: wgpu::CommandEncoder,
    readable: wgpu::Buffer,
    /// How much of `readable` is used.
    bytes: u64,
    /// From row to row.
    stride: usize,
}

/// Layout of bindings 0 to 4, the last two of them storage. Decorated modules need numbers without gaps.
fn input_layout(visibility: wgpu::ShaderStages) -> [wgpu::BindGroupLayoutEntry; 5] {
    [0, 1, 2, 3, 4].map(|binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty: wgpu::BindingType::Buffer {
            ty: match binding {
                3 | 4 => wgpu::BufferBindingType::Storage { read_only: true },
                _ => wgpu::BufferBindingType::Uniform,
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    })
}

pub(crate) fn view_uniform(frame: &Frame, tile: Tile) -> ViewUniform {
    ViewUniform {
        center: frame.view.center.map(|c| c as f32),
        size: [frame.size.width as f32, frame.size.height as f32],
        tile: [tile.x as f32, tile.y as f32],
        pixel: (frame.view.height / f64::from(frame.size.height)) as f32,
        time: frame.time as f32,
        samples: frame.samples,
        zero: 0,
        tile_size: [tile.width, tile.height],
    }
}

/// Copies a tile's rows, which are `stride` bytes apart, into the band that begins at row `top` and has `line` bytes in a
/// row, `pixel` in a pixel.
fn place(
    band: &mut [u8],
    line: usize,
    pixel: usize,
    (tile, top): (Tile, u32),
    bytes: &[u8],
    stride: usize,
) {
    let row = tile.width as usize * pixel;
    let left = tile.x as usize * pixel;
    let lines = band.chunks_exact_mut(line).skip((tile.y - top) as usize);
    for (line, pixels) in lines.zip(bytes.chunks(stride)).take(tile.height as usize) {
        line[left..left + row].copy_from_slice(&pixels[..row]);
    }
}

#[cfg(test)]
mod tests;
