//! Drawing modules of one picture again and again, timed.

use std::sync::mpsc;
use std::time::{Duration, Instant};

use naga::Module;
use naga::valid::ModuleInfo;
use pullback_compiler::lower::{Format, Tier};

use crate::clock::Clock;
use crate::{Error, Frame, Gpu, shader};

/// A timed submission on hardware takes this long at least, so that a clock's tick and a launch do not count.
const SHORTEST: f64 = 2e-3;
/// Every pipeline draws for this long before it counts, so that the device is at its working clock.
const WARM_UP: Duration = Duration::from_millis(150);
/// What is dispatched.
const ENTRY: &str = "compute_main";

/// What all modules of a picture share.
#[derive(Debug)]
pub struct Canvas {
    gpu: Gpu,
    size: [u32; 2],
    /// Bindings 0 to 3, and the image.
    buffers: [wgpu::Buffer; 6],
    readable: wgpu::Buffer,
    clock: Option<Clock>,
}

/// A module as a pipeline, with its bindings.
#[derive(Debug)]
pub struct Stage {
    pipeline: wgpu::ComputePipeline,
    bindings: wgpu::BindGroup,
    /// Width and height of a workgroup.
    workgroup: [u32; 2],
}

impl Canvas {
    /// Puts the uniforms of a picture on the device: one sample a pixel, the clock at 0, no mesh.
    ///
    /// # Errors
    /// The device's.
    pub fn new(gpu: &Gpu, frame: &Frame) -> Result<Self, Error> {
        let (width, height) = (frame.size.width, frame.size.height);
        let pixel = frame.pixel();
        let mut params = [0.0f32; 64];
        for (slot, &value) in params.iter_mut().zip(frame.params) {
            *slot = value as f32;
        }
        let bytes =
            |words: Vec<u32>| -> Vec<u8> { words.into_iter().flat_map(u32::to_le_bytes).collect() };
        let [x, y] = frame.view.center.map(|c| (c as f32).to_bits());
        let [w, h] = [width, height].map(|side| (side as f32).to_bits());
        let step = (pixel as f32).to_bits();
        let view = vec![x, y, w, h, 0, 0, step, 0, 1, 0, width, height];
        let mut wide = vec![frame.view.center[0], frame.view.center[1], 0.0, pixel];
        wide.extend(frame.params);
        wide.resize(4 + 64, 0.0);
        let wide: Vec<u32> = wide
            .into_iter()
            .flat_map(|number| Format::Single.words(number))
            .collect();
        let params: Vec<u32> = params.iter().map(|p| p.to_bits()).collect();
        let uniform = wgpu::BufferUsages::UNIFORM;
        let image = u64::from(width) * u64::from(height) * 4;
        let clock = Clock::new(gpu)?;
        gpu.guarded("allocation", || Self {
            size: [width, height],
            buffers: [
                filled(gpu, &bytes(view), uniform),
                filled(gpu, &bytes(params), uniform),
                filled(gpu, frame.settings, uniform),
                filled(gpu, &bytes(wide), wgpu::BufferUsages::STORAGE),
                // a scene without a mesh
                filled(gpu, &[0; 16], wgpu::BufferUsages::STORAGE),
                empty(
                    gpu,
                    image,
                    wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                ),
            ],
            readable: empty(
                gpu,
                image,
                wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            ),
            clock,
            gpu: gpu.clone(),
        })
    }

    /// Whether times are the device's own.
    #[must_use]
    pub fn has_clock(&self) -> bool {
        self.clock.is_some()
    }

    /// Makes the pipeline of a module of ours, loaded as a scene's is.
    ///
    /// # Errors
    /// The device's.
    pub fn stage(&self, module: &Module, info: &ModuleInfo) -> Result<Stage, Error> {
        let shader = shader::load(&self.gpu, module, info, Tier::default())?;
        self.stage_of(&shader, module)
    }

    /// Makes the pipeline of a module that someone has written, loaded as wgpu loads such, with every check.
    ///
    /// # Errors
    /// The device's.
    pub fn stage_checked(&self, module: &Module) -> Result<Stage, Error> {
        let shader = shader::checked(&self.gpu, module.clone())?;
        self.stage_of(&shader, module)
    }

    fn stage_of(&self, shader: &wgpu::ShaderModule, module: &Module) -> Result<Stage, Error> {
        // a module that does not use a buffer has no place for it
        let used: Vec<u32> = module
            .global_variables
            .iter()
            .filter_map(|(_, global)| Some(global.binding?.binding))
            .filter(|&binding| binding < 6)
            .collect();
        let workgroup = module
            .entry_points
            .iter()
            .find(|entry| entry.name == ENTRY)
            .map_or([1; 2], |entry| {
                [entry.workgroup_size[0], entry.workgroup_size[1]]
            });
        let device = self.gpu.device();
        self.gpu.guarded("compiling a pipeline", || {
            let layout_entry = |binding| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer {
                    ty: match binding {
                        3 | 4 => wgpu::BufferBindingType::Storage { read_only: true },
                        5 => wgpu::BufferBindingType::Storage { read_only: false },
                        _ => wgpu::BufferBindingType::Uniform,
                    },
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            };
            let entries: Vec<_> = used.iter().map(|&b| layout_entry(b)).collect();
            let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: None,
                entries: &entries,
            });
            let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: Some(&pipeline_layout),
                module: shader,
                entry_point: Some(ENTRY),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            });
            let resource = |binding: u32| wgpu::BindGroupEntry {
                binding,
                resource: self.buffers[binding as usize].as_entire_binding(),
            };
            let entries: Vec<_> = used.iter().map(|&b| resource(b)).collect();
            let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &layout,
                entries: &entries,
            });
            Stage {
                pipeline,
                bindings,
                workgroup,
            }
        })
    }

    /// Seconds of a frame of each stage, in turns.
    ///
    /// # Errors
    /// The device's.
    pub fn turns<const N: usize>(
        &self,
        stages: &[Stage; N],
        turns: u32,
    ) -> Result<Vec<[f64; N]>, Error> {
        let mut repeats = [1; N];
        for (stage, repeats) in stages.iter().zip(&mut repeats) {
            let start = Instant::now();
            let mut once = self.time(stage, 1)?;
            while self.has_clock() && start.elapsed() < WARM_UP {
                once = self.time(stage, 1)?;
            }
            if self.has_clock() {
                *repeats = (SHORTEST / once.max(1e-7)).ceil().clamp(1.0, 2000.0) as u32;
            }
        }
        let mut all = Vec::new();
        for _ in 0..turns.max(1) {
            let mut turn = [0.0; N];
            for ((time, stage), &repeats) in turn.iter_mut().zip(stages).zip(&repeats) {
                *time = self.time(stage, repeats)?;
            }
            all.push(turn);
        }
        Ok(all)
    }

    /// Seconds of a frame: by the device's clock, or else by ours from the submission to its end.
    fn time(&self, stage: &Stage, repeats: u32) -> Result<f64, Error> {
        let encoder = self
            .gpu
            .guarded("recording", || self.record(stage, repeats))?;
        let start = Instant::now();
        let submission = self
            .gpu
            .guarded("drawing", || self.gpu.queue().submit([encoder.finish()]))?;
        self.gpu.wait("drawing", submission)?;
        let total = match &self.clock {
            Some(clock) => clock.read(&self.gpu)?,
            None => start.elapsed().as_secs_f64(),
        };
        Ok(total / f64::from(repeats))
    }

    fn record(&self, stage: &Stage, repeats: u32) -> wgpu::CommandEncoder {
        let mut encoder = self
            .gpu
            .device()
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: None,
                timestamp_writes: self.clock.as_ref().map(Clock::around),
            });
            pass.set_pipeline(&stage.pipeline);
            pass.set_bind_group(0, &stage.bindings, &[]);
            let [x, y] = [0, 1].map(|k| self.size[k].div_ceil(stage.workgroup[k]));
            for _ in 0..repeats {
                pass.dispatch_workgroups(x, y, 1);
            }
        }
        if let Some(clock) = &self.clock {
            clock.resolve(&mut encoder);
        }
        encoder
    }

    /// The picture as rgba.
    ///
    /// # Errors
    /// The device's.
    pub fn picture(&self, stage: &Stage) -> Result<Vec<u8>, Error> {
        let mut encoder = self.gpu.guarded("recording", || self.record(stage, 1))?;
        let bytes = self.readable.size();
        encoder.copy_buffer_to_buffer(&self.buffers[5], 0, &self.readable, 0, bytes);
        self.gpu
            .guarded("drawing", || self.gpu.queue().submit([encoder.finish()]))?;
        self.read()
    }

    /// Waits for the device, and copies the image.
    fn read(&self) -> Result<Vec<u8>, Error> {
        let during = "reading";
        let failed = |reason: String| Error::Device { during, reason };
        let (sender, receiver) = mpsc::channel();
        let submission = self.gpu.guarded(during, || {
            self.readable
                .map_async(wgpu::MapMode::Read, .., move |mapped| {
                    // nobody waits any more where the device has failed
                    let _ = sender.send(mapped);
                });
            self.gpu.queue().submit([])
        })?;
        self.gpu.wait(during, submission)?;
        receiver
            .try_recv()
            .map_err(|error| failed(error.to_string()))?
            .map_err(|error| failed(error.to_string()))?;
        let seen = self
            .readable
            .slice(..)
            .get_mapped_range()
            .map_err(|error| failed(error.to_string()))?
            .to_vec();
        self.readable.unmap();
        Ok(seen)
    }
}

fn filled(gpu: &Gpu, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    let buffer = empty(
        gpu,
        bytes.len() as u64,
        usage | wgpu::BufferUsages::COPY_DST,
    );
    gpu.queue().write_buffer(&buffer, 0, bytes);
    buffer
}

fn empty(gpu: &Gpu, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size,
        usage,
        mapped_at_creation: false,
    })
}
