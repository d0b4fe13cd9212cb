//! Tiles whose samples are computed in several submissions and added up in linear light.

use std::time::Instant;

use super::compute::{groups, pipeline};
use super::{Frame, Pipeline, Uniforms, input_layout};
use crate::buffers::{self, Growing};
use crate::tiles::{Budget, Tile};
use crate::{Error, Gpu};

/// Bytes of a pixel's sum.
const PIXEL: u64 = 16;
/// Bytes behind the last pixel: a word that tells whether a sum has gone wrong, and two for the samples that are to
/// be added.
const BEHIND: u64 = 16;

/// Most pixels in a tile.
pub(super) fn max_pixels(gpu: &Gpu) -> u64 {
    let limits = gpu.device().limits();
    let bytes = limits
        .max_storage_buffer_binding_size
        .min(limits.max_buffer_size);
    bytes.saturating_sub(BEHIND) / PIXEL
}

/// Pipelines and buffers.
#[derive(Debug)]
pub(super) struct SumStage {
    gpu: Gpu,
    shader: wgpu::ShaderModule,
    layout: wgpu::BindGroupLayout,
    sum: wgpu::ComputePipeline,
    /// Made when first used: linear light needs none.
    encode: Option<wgpu::ComputePipeline>,
    image: Growing,
    readable: Growing,
    bindings: Option<wgpu::BindGroup>,
}

/// What became of a tile.
pub(super) struct Drawn {
    /// Its rows, without gaps, in the form of the frame's pipeline; none where the adapter has ended loops early.
    pub rows: Option<Vec<u8>>,
    /// The most samples of a pixel that were in one submission.
    pub largest_part: u32,
}

impl SumStage {
    pub(super) fn new(gpu: &Gpu, shader: &wgpu::ShaderModule) -> Result<Self, Error> {
        let stages = wgpu::ShaderStages::COMPUTE;
        let inputs = input_layout(stages);
        let view = inputs[0];
        let image = wgpu::BindGroupLayoutEntry {
            binding: 5,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: false },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            ..view
        };
        let (layout, sum) = gpu.guarded("compiling the pipeline of sums", || {
            let descriptor = wgpu::BindGroupLayoutDescriptor {
                label: Some("sums"),
                entries: &[&inputs[..], &[image]].concat(),
            };
            let layout = gpu.device().create_bind_group_layout(&descriptor);
            let sum = pipeline(gpu, shader, &layout, "sum_main");
            (layout, sum)
        })?;
        Ok(Self {
            gpu: gpu.clone(),
            shader: shader.clone(),
            layout,
            sum,
            encode: None,
            image: Growing::sums(),
            readable: Growing::readable(),
            bindings: None,
        })
    }

    /// Computes a tile whose uniforms are in place, in as many submissions as the budget wants, which learns from each.
    pub(super) fn draw(
        &mut self,
        uniforms: &Uniforms,
        frame: &Frame,
        tile: Tile,
        budget: &mut Budget,
    ) -> Result<Drawn, Error> {
        let gpu = self.gpu.clone();
        let bytes = tile.pixels() * PIXEL + BEHIND;
        let (image, new) = self.image.at_least(&gpu, bytes)?;
        let (readable, _) = self.readable.at_least(&gpu, bytes)?;
        if new || self.bindings.is_none() {
            self.bindings = Some(self.bind(uniforms, &image)?);
        }
        let total = frame.samples_of_pixel();
        let (mut done, mut largest_part) = (0, 0);
        let rows = loop {
            let count = budget.share(tile).min(total - done);
            largest_part = largest_part.max(count);
            let start = Instant::now();
            let last = done + count == total;
            let mut encoder = self.record(&image, tile, (done, count))?;
            done += count;
            if last {
                self.finish(&mut encoder, frame, tile)?;
                encoder.copy_buffer_to_buffer(&image, 0, &readable, 0, bytes);
                let rows = buffers::submit_and_read(
                    &gpu,
                    "rendering",
                    encoder,
                    &readable,
                    bytes,
                    |words| rows(words, frame, tile),
                )?;
                budget.learn(tile, count, start.elapsed());
                break rows;
            }
            let submission = gpu.guarded("rendering", || gpu.queue().submit([encoder.finish()]))?;
            gpu.wait("rendering", submission)?;
            budget.learn(tile, count, start.elapsed());
        };
        Ok(Drawn { rows, largest_part })
    }

    /// Commands that add `count` samples of each pixel, from the `first` on.
    fn record(
        &mut self,
        image: &wgpu::Buffer,
        tile: Tile,
        (first, count): (u32, u32),
    ) -> Result<wgpu::CommandEncoder, Error> {
        self.gpu.guarded("recording", || {
            let verdict = tile.pixels() * PIXEL;
            let part = [first, first + count];
            let queue = self.gpu.queue();
            queue.write_buffer(image, verdict + 4, bytemuck::cast_slice(&part));
            let mut encoder = self
                .gpu
                .device()
                .create_command_encoder(&Default::default());
            if first == 0 {
                encoder.clear_buffer(image, 0, Some(verdict + 4));
            }
            self.pass(&mut encoder, &self.sum, tile);
            encoder
        })
    }

    /// Adds what makes 8 bits of sums.
    fn finish(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        frame: &Frame,
        tile: Tile,
    ) -> Result<(), Error> {
        if frame.pipeline == Pipeline::Linear {
            return Ok(());
        }
        let gpu = self.gpu.clone();
        gpu.guarded("compiling the pipeline of sums", || {
            let (shader, layout) = (&self.shader, &self.layout);
            let encode = || pipeline(&gpu, shader, layout, "encode_main");
            let encode = self.encode.get_or_insert_with(encode).clone();
            self.pass(encoder, &encode, tile);
        })
    }

    fn pass(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::ComputePipeline,
        tile: Tile,
    ) {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, self.bindings.as_ref(), &[]);
        let [x, y] = groups(&tile);
        pass.dispatch_workgroups(x, y, 1);
    }

    fn bind(&self, uniforms: &Uniforms, image: &wgpu::Buffer) -> Result<wgpu::BindGroup, Error> {
        let mut entries = uniforms.entries().to_vec();
        entries.push(wgpu::BindGroupEntry {
            binding: 5,
            resource: image.as_entire_binding(),
        });
        self.gpu.guarded("recording", || {
            let descriptor = wgpu::BindGroupDescriptor {
                label: Some("sums"),
                layout: &self.layout,
                entries: &entries,
            };
            self.gpu.device().create_bind_group(&descriptor)
        })
    }
}

/// The rows of a tile, from what `sum_main` and `encode_main` have written; none if loops have ended early.
fn rows(words: &[u8], frame: &Frame, tile: Tile) -> Option<Vec<u8>> {
    let (pixels, behind) = words.split_at((tile.pixels() * PIXEL) as usize);
    if behind.iter().take(4).any(|&byte| byte != 0) {
        return None;
    }
    if frame.pipeline != Pipeline::Linear {
        let pixels = pixels.as_chunks::<{ PIXEL as usize }>().0.iter();
        return Some(pixels.flat_map(|p| [p[0], p[1], p[2], p[3]]).collect());
    }
    // as the shader does
    let step = 1.0 / frame.samples as f32;
    let mean = |word: &[u8; 4]| (f32::from_le_bytes(*word) * (step * step)).to_le_bytes();
    Some(pixels.as_chunks::<4>().0.iter().flat_map(mean).collect())
}
