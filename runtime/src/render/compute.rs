//! Tiles by a compute entry point, into a storage buffer.

use super::{Pipeline, Recorded, Stage, Uniforms, input_layout};
use crate::buffers::Growing;
use crate::clock::Clock;
use crate::tiles::Tile;
use crate::{Error, Gpu};

/// Width and height of a workgroup of the entry points. A subgroup of 32 is 8 x 4 pixels; groups of 64 invocations would
/// begin more slowly than short shaders end.
const WORKGROUP: [u32; 2] = [8, 16];

/// Workgroups that cover a tile.
pub(super) fn groups(tile: &Tile) -> [u32; 2] {
    [
        tile.width.div_ceil(WORKGROUP[0]),
        tile.height.div_ceil(WORKGROUP[1]),
    ]
}

/// Pipeline and buffers of the compute path.
#[derive(Debug)]
pub(super) struct ComputeStage {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
    image: Growing,
    readable: Growing,
    bindings: Option<wgpu::BindGroup>,
    bytes_per_pixel: u64,
    max_pixels: u64,
    max_side: u32,
}

impl ComputeStage {
    pub(super) fn new(
        gpu: &Gpu,
        shader: &wgpu::ShaderModule,
        pipeline: Pipeline,
    ) -> Result<Self, Error> {
        let device = gpu.device();
        let stages = wgpu::ShaderStages::COMPUTE;
        let inputs = input_layout(stages);
        let image = wgpu::BindGroupLayoutEntry {
            binding: 5,
            visibility: stages,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: false },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let limits = device.limits();
        let bytes_per_pixel = pipeline.bytes_per_pixel() as u64;
        let entry = match pipeline {
            Pipeline::Linear => "linear_main",
            Pipeline::Compute | Pipeline::Fragment => "compute_main",
        };
        gpu.guarded("compiling the compute pipeline", || {
            let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("compute"),
                entries: &[&inputs[..], &[image]].concat(),
            });
            let pipeline = self::pipeline(gpu, shader, &layout, entry);
            Self {
                layout,
                pipeline,
                image: Growing::results(),
                readable: Growing::readable(),
                bindings: None,
                bytes_per_pixel,
                max_pixels: limits
                    .max_storage_buffer_binding_size
                    .min(limits.max_buffer_size)
                    / bytes_per_pixel,
                max_side: limits
                    .max_compute_workgroups_per_dimension
                    .saturating_mul(WORKGROUP[0]),
            }
        })
    }
}

/// The pipeline of an entry point.
pub(super) fn pipeline(
    gpu: &Gpu,
    shader: &wgpu::ShaderModule,
    layout: &wgpu::BindGroupLayout,
    entry: &str,
) -> wgpu::ComputePipeline {
    let device = gpu.device();
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(entry),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry),
        layout: Some(&pipeline_layout),
        module: shader,
        entry_point: Some(entry),
        compilation_options: wgpu::PipelineCompilationOptions {
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        },
        cache: None,
    })
}

impl Stage for ComputeStage {
    fn max_pixels(&self) -> u64 {
        self.max_pixels
    }

    fn max_side(&self) -> u32 {
        self.max_side
    }

    fn record(&mut self, gpu: &Gpu, uniforms: &Uniforms, tile: Tile) -> Result<Recorded, Error> {
        let bytes = tile.pixels() * self.bytes_per_pixel;
        let (readable, _) = self.readable.at_least(gpu, bytes)?;
        let (mut encoder, image) = self.pass(gpu, uniforms, tile, 1, None)?;
        gpu.guarded("recording", || {
            encoder.copy_buffer_to_buffer(&image, 0, &readable, 0, bytes);
        })?;
        Ok(Recorded {
            encoder,
            readable,
            bytes,
            stride: tile.width as usize * self.bytes_per_pixel as usize,
        })
    }
}

impl ComputeStage {
    /// The pass over a tile, so many times, with the clock's readings around it, and the buffer that it fills.
    pub(super) fn pass(
        &mut self,
        gpu: &Gpu,
        uniforms: &Uniforms,
        tile: Tile,
        repeats: u32,
        clock: Option<&Clock>,
    ) -> Result<(wgpu::CommandEncoder, wgpu::Buffer), Error> {
        let bytes = tile.pixels() * self.bytes_per_pixel;
        let (image, new) = self.image.at_least(gpu, bytes)?;
        if new {
            self.bindings = None;
        }
        let device = gpu.device();
        let encoder = gpu.guarded("recording", || {
            let bindings = self.bindings.get_or_insert_with(|| {
                let mut entries = uniforms.entries().to_vec();
                entries.push(wgpu::BindGroupEntry {
                    binding: 5,
                    resource: image.as_entire_binding(),
                });
                device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("compute"),
                    layout: &self.layout,
                    entries: &entries,
                })
            });
            let mut encoder = device.create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some("compute"),
                    timestamp_writes: clock.map(Clock::around),
                });
                pass.set_pipeline(&self.pipeline);
                pass.set_bind_group(0, &*bindings, &[]);
                let [x, y] = groups(&tile);
                for _ in 0..repeats {
                    pass.dispatch_workgroups(x, y, 1);
                }
            }
            if let Some(clock) = clock {
                clock.resolve(&mut encoder);
            }
            encoder
        })?;
        Ok((encoder, image))
    }
}
