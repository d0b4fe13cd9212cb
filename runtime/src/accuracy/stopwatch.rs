//! The time that a dispatch takes, by the device's clock or by ours.

use std::time::Instant;

use pullback_compiler::EvalModule;
use pullback_compiler::lower::Format;

use crate::clock::Clock;
use crate::uniforms::{self, BatchUniform, MAX_PARAMS, WideWords};
use crate::{Error, Gpu, buffers, evaluate, shader};

/// Size of a workgroup of `compute_main`.
const WORKGROUP: u32 = 64;

/// An evaluation shader with rows to evaluate, ready to be timed.
#[derive(Debug)]
pub(super) struct Timed<'g> {
    gpu: &'g Gpu,
    clock: Option<&'g Clock>,
    pipeline: wgpu::ComputePipeline,
    bindings: wgpu::BindGroup,
    format: Format,
    params: wgpu::Buffer,
    wide: wgpu::Buffer,
    groups: u32,
}

impl<'g> Timed<'g> {
    pub(super) fn new(
        gpu: &'g Gpu,
        clock: Option<&'g Clock>,
        module: &EvalModule,
        rows: &[u8],
        count: u32,
    ) -> Result<Self, Error> {
        let shader = shader::load(gpu, &module.module, &module.info, module.tier)?;
        let device = gpu.device();
        let buffer = |label, size: usize, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: size as u64,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let params = buffers::uniform(gpu, "params", size_of::<[f32; MAX_PARAMS]>())?;
        let batch = buffers::uniform(gpu, "batch", size_of::<BatchUniform>())?;
        let wide = buffers::wide(gpu)?;
        let (pipeline, bindings) = gpu.guarded("compiling the timed pipeline", || {
            let layout = device.create_bind_group_layout(&evaluate::LAYOUT);
            let around = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("timed"),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("timed"),
                layout: Some(&around),
                module: &shader,
                entry_point: Some("compute_main"),
                compilation_options: Default::default(),
                cache: None,
            });
            let storage = wgpu::BufferUsages::STORAGE;
            let inputs = buffer("inputs", rows.len(), storage);
            let results = buffer(
                "results",
                count as usize * module.outputs.len() * 8,
                storage,
            );
            gpu.queue().write_buffer(&inputs, 0, rows);
            let head = BatchUniform {
                count,
                zero: 0,
                time: 0.0,
                pixel: 0.0,
                columns: module.inputs.len() as u32,
                results: module.outputs.len() as u32,
            };
            gpu.queue()
                .write_buffer(&batch, 0, bytemuck::bytes_of(&head));
            let all = [&inputs, &params, &results, &wide, &batch];
            let entries: Vec<_> = (0..)
                .zip(all)
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("timed"),
                layout: &layout,
                entries: &entries,
            });
            (pipeline, bindings)
        })?;
        Ok(Self {
            gpu,
            clock,
            pipeline,
            bindings,
            format: module.tier.precision.format(),
            params,
            wide,
            groups: count.div_ceil(WORKGROUP),
        })
    }

    /// Seconds for all rows with these parameters.
    pub(super) fn seconds(&self, params: &[f64]) -> Result<f64, Error> {
        let gpu = self.gpu;
        let encoder = gpu.guarded("recording", || {
            let wide = WideWords::new(self.format, [0.0; 2], 0.0, 0.0, params);
            let params = uniforms::params(params);
            let queue = gpu.queue();
            queue.write_buffer(&self.params, 0, bytemuck::bytes_of(&params));
            queue.write_buffer(&self.wide, 0, bytemuck::bytes_of(&wide));
            // what was written must not be part of the time
            gpu.queue().submit([]);
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some("timed"),
                    timestamp_writes: self.clock.map(Clock::around),
                });
                pass.set_pipeline(&self.pipeline);
                pass.set_bind_group(0, &self.bindings, &[]);
                pass.dispatch_workgroups(self.groups, 1, 1);
            }
            if let Some(clock) = self.clock {
                clock.resolve(&mut encoder);
            }
            encoder
        })?;
        let start = Instant::now();
        let submission = gpu.guarded("timing", || gpu.queue().submit([encoder.finish()]))?;
        gpu.wait("timing", submission)?;
        let elapsed = start.elapsed().as_secs_f64();
        match self.clock {
            Some(clock) => clock.read(gpu),
            None => Ok(elapsed),
        }
    }
}
