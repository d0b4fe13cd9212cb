//! A trace on a device.

use super::inputs::{Access, Inputs, ROOM, TRACE};
use super::{Trace, Traced};
use crate::buffers::{self, Growing};
use crate::{Error, Gpu, shader};

const DURING: &str = "tracing";

/// A traced shader on a device.
#[derive(Debug)]
pub struct GpuTracer<'t> {
    gpu: Gpu,
    traced: &'t Traced,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

impl<'t> GpuTracer<'t> {
    /// Loads a traced shader onto the device, for inputs of this layout.
    ///
    /// # Errors
    /// The device's.
    pub fn new(gpu: &Gpu, traced: &'t Traced, inputs: &Inputs) -> Result<Self, Error> {
        let (layout, pipeline) = pipeline(gpu, traced, inputs)?;
        Ok(Self {
            gpu: gpu.clone(),
            traced,
            layout,
            pipeline,
        })
    }

    /// Runs one invocation.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there is no buffer for the trace, and the device's.
    pub fn trace(&self, inputs: &Inputs) -> Result<Trace, Error> {
        let gpu = &self.gpu;
        let buffers = upload(gpu, inputs)?;
        let Some((_, trace)) = buffers.iter().find(|buffer| buffer.0 == TRACE) else {
            return Err(Error::Invalid {
                reason: "no buffer for the trace".into(),
            });
        };
        let bytes = trace.size();
        let (readable, _) = Growing::readable().at_least(gpu, bytes)?;
        let encoder = gpu.guarded(DURING, || {
            let entries: Vec<_> = buffers
                .iter()
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding: *binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            let bindings = gpu.device().create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(DURING),
                layout: &self.layout,
                entries: &entries,
            });
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(&self.pipeline);
                pass.set_bind_group(0, &bindings, &[]);
                pass.dispatch_workgroups(1, 1, 1);
            }
            encoder.copy_buffer_to_buffer(trace, 0, &readable, 0, bytes);
            encoder
        })?;
        buffers::submit_and_read(gpu, DURING, encoder, &readable, bytes, |seen| {
            let words = seen.as_chunks::<4>().0.iter();
            let words: Vec<u32> = words.map(|&word| u32::from_le_bytes(word)).collect();
            Trace::read(&self.traced.sites, &words, ROOM as usize)
        })
    }
}

fn upload(gpu: &Gpu, inputs: &Inputs) -> Result<Vec<(u32, wgpu::Buffer)>, Error> {
    gpu.guarded("upload", || {
        let made = inputs.buffers.iter().map(|input| {
            let usage = match input.access {
                Access::Uniform => wgpu::BufferUsages::UNIFORM,
                Access::Read => wgpu::BufferUsages::STORAGE,
                Access::ReadWrite => wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            };
            let buffer = gpu.device().create_buffer(&wgpu::BufferDescriptor {
                label: Some(DURING),
                // uniforms are structures, whose sizes are multiples of 16
                size: input.bytes.len().next_multiple_of(16).max(16) as u64,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            gpu.queue().write_buffer(&buffer, 0, &input.bytes);
            (input.binding, buffer)
        });
        made.collect()
    })
}

fn pipeline(
    gpu: &Gpu,
    traced: &Traced,
    inputs: &Inputs,
) -> Result<(wgpu::BindGroupLayout, wgpu::ComputePipeline), Error> {
    let shader = shader::load(gpu, &traced.module, &traced.info, inputs.tier)?;
    let device = gpu.device();
    let entries: Vec<_> = inputs
        .buffers
        .iter()
        .map(|input| {
            let ty = match input.access {
                Access::Uniform => wgpu::BufferBindingType::Uniform,
                Access::Read => wgpu::BufferBindingType::Storage { read_only: true },
                Access::ReadWrite => wgpu::BufferBindingType::Storage { read_only: false },
            };
            buffers::binding(input.binding, ty)
        })
        .collect();
    gpu.guarded("compiling a traced shader", || {
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(DURING),
            entries: &entries,
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(DURING),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(DURING),
            layout: Some(&pipeline_layout),
            module: &shader,
            entry_point: Some("compute_main"),
            compilation_options: Default::default(),
            cache: None,
        });
        (layout, pipeline)
    })
}
