//! The time that a dispatch takes, by the device's clock or by ours.

use std::sync::mpsc;
use std::time::Instant;

use pullback_compiler::EvalModule;
use pullback_compiler::lower::Format;

use crate::uniforms::{self, BatchUniform, MAX_PARAMS, WideWords};
use crate::{Error, Gpu, buffers, evaluate, shader};

/// Size of a workgroup of `compute_main`.
const WORKGROUP: u32 = 64;

/// Two timestamps of the device, around a pass.
#[derive(Debug)]
pub(super) struct Clock {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    readable: wgpu::Buffer,
    seconds: f64,
}

impl Clock {
    /// `None` where the device has none. Software adapters have one that says little; they are timed from outside.
    pub(super) fn new(gpu: &Gpu) -> Result<Option<Self>, Error> {
        let device = gpu.device();
        if gpu.adapter().is_software()
            || !device.features().contains(wgpu::Features::TIMESTAMP_QUERY)
        {
            return Ok(None);
        }
        let buffer = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps"),
                size: 16,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        gpu.guarded("allocation", || Self {
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            readable: buffer(wgpu::BufferUsages::MAP_READ),
            seconds: f64::from(gpu.queue().get_timestamp_period()) * 1e-9,
        })
        .map(Some)
    }

    /// Seconds between the two timestamps of the last submission.
    fn read(&self, gpu: &Gpu) -> Result<f64, Error> {
        let during = "reading timestamps";
        let failed = |reason: String| Error::Device { during, reason };
        let (sender, receiver) = mpsc::channel();
        let submission = gpu.guarded(during, || {
            let report = move |mapped| {
                let _ = sender.send(mapped);
            };
            self.readable.map_async(wgpu::MapMode::Read, .., report);
            gpu.queue().submit([])
        })?;
        gpu.wait(during, submission)?;
        receiver
            .try_recv()
            .map_err(|error| failed(error.to_string()))?
            .map_err(|error| failed(error.to_string()))?;
        let ticks = {
            let view = self
                .readable
                .slice(..)
                .get_mapped_range()
                .map_err(|error| failed(error.to_string()))?;
            let word = |k: usize| bytemuck::pod_read_unaligned::<u64>(&view[8 * k..8 * k + 8]);
            word(1).saturating_sub(word(0))
        };
        self.readable.unmap();
        Ok(ticks as f64 * self.seconds)
    }
}

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
                    timestamp_writes: self.clock.map(|clock| wgpu::ComputePassTimestampWrites {
                        query_set: &clock.queries,
                        beginning_of_pass_write_index: Some(0),
                        end_of_pass_write_index: Some(1),
                    }),
                });
                pass.set_pipeline(&self.pipeline);
                pass.set_bind_group(0, &self.bindings, &[]);
                pass.dispatch_workgroups(self.groups, 1, 1);
            }
            if let Some(clock) = self.clock {
                encoder.resolve_query_set(&clock.queries, 0..2, &clock.resolved, 0);
                encoder.copy_buffer_to_buffer(&clock.resolved, 0, &clock.readable, 0, 16);
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
