//! A compute shader that turns one array of words into another: what measurements are made with.
//!
//! The shader has an entry point `compute_main`, workgroups of 64, and these bindings:
//!
//! ```wgsl
//! @group(0) @binding(0) var<storage, read> rows: array<u32>;
//! @group(0) @binding(1) var<storage, read_write> results: array<u32>;
//! @group(0) @binding(2) var<uniform> batch: vec4u;  // invocations, a zero nobody knows, and two of the caller's
//! ```

use naga::Module;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use crate::buffers::{self, Growing};
use crate::{Error, Gpu, decorate, shader};

/// Invocations of a workgroup.
const WORKGROUP: u32 = 64;
/// The entry point.
const ENTRY: &str = "compute_main";

/// What the driver may do to the order of roundings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contraction {
    /// Whatever it likes.
    Allowed,
    /// Nothing: every floating-point instruction is decorated. Needs Vulkan and [`wgpu::Features::PASSTHROUGH_SHADERS`].
    Forbidden,
}

/// A shader on a device.
#[derive(Debug)]
pub struct Kernel {
    gpu: Gpu,
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

/// Arguments and room for results of a kernel, on the device.
#[derive(Debug)]
pub struct Job {
    invocations: u32,
    bytes: u64,
    results: wgpu::Buffer,
    bindings: wgpu::BindGroup,
}

impl Kernel {
    /// Loads a WGSL text onto the device.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the text is not a valid shader, and the device's.
    pub fn new(gpu: &Gpu, wgsl: &str, contraction: Contraction) -> Result<Self, Error> {
        let (module, info) = parse(wgsl)?;
        let shader = match contraction {
            Contraction::Allowed => shader::checked(gpu, module)?,
            Contraction::Forbidden => decorate::load(gpu, &module, &info)?,
        };
        let device = gpu.device();
        let (layout, pipeline) = gpu.guarded("compiling a kernel", || {
            let layout = device.create_bind_group_layout(&LAYOUT);
            let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("kernel"),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("kernel"),
                layout: Some(&pipeline_layout),
                module: &shader,
                entry_point: Some(ENTRY),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            });
            (layout, pipeline)
        })?;
        Ok(Self {
            gpu: gpu.clone(),
            pipeline,
            layout,
        })
    }

    /// Puts the arguments on the device, with room for `results` words.
    ///
    /// # Errors
    /// The device's.
    pub fn job(
        &self,
        invocations: u32,
        own: [u32; 2],
        rows: &[u32],
        results: usize,
    ) -> Result<Job, Error> {
        let gpu = &self.gpu;
        let bytes = results.max(1) as u64 * 4;
        // An empty array has a binding, too.
        let rows_bytes = rows.len().max(1) as u64 * 4;
        let (rows_buffer, _) = Growing::inputs().at_least(gpu, rows_bytes)?;
        let (results, _) = Growing::results().at_least(gpu, bytes)?;
        let batch = buffers::uniform(gpu, "batch", 16)?;
        let bindings = gpu.guarded("upload", || {
            let queue = gpu.queue();
            queue.write_buffer(&rows_buffer, 0, bytemuck::cast_slice(rows));
            let numbers = [invocations, 0, own[0], own[1]];
            queue.write_buffer(&batch, 0, bytemuck::cast_slice(&numbers));
            let entries = [&rows_buffer, &results, &batch];
            let entries: [_; 3] = std::array::from_fn(|k| wgpu::BindGroupEntry {
                binding: k as u32,
                resource: entries[k].as_entire_binding(),
            });
            gpu.device().create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("kernel"),
                layout: &self.layout,
                entries: &entries,
            })
        })?;
        Ok(Job {
            invocations,
            bytes,
            results,
            bindings,
        })
    }

    /// Does a job `times` times, and waits.
    ///
    /// # Errors
    /// The device's.
    pub fn repeat(&self, job: &Job, times: u32) -> Result<(), Error> {
        let submission = self.gpu.guarded("running a kernel", || {
            let mut encoder = self.encoder();
            self.record(&mut encoder, job, times);
            self.gpu.queue().submit([encoder.finish()])
        })?;
        self.gpu.wait("running a kernel", submission)
    }

    /// Does a job and gives its results.
    ///
    /// # Errors
    /// The device's.
    pub fn results(&self, job: &Job) -> Result<Vec<u32>, Error> {
        let (readable, _) = Growing::readable().at_least(&self.gpu, job.bytes)?;
        let encoder = self.gpu.guarded("running a kernel", || {
            let mut encoder = self.encoder();
            self.record(&mut encoder, job, 1);
            encoder.copy_buffer_to_buffer(&job.results, 0, &readable, 0, job.bytes);
            encoder
        })?;
        let during = "running a kernel";
        buffers::submit_and_read(&self.gpu, during, encoder, &readable, job.bytes, |seen| {
            let words = seen.as_chunks::<4>().0.iter();
            words.map(|&bytes| u32::from_le_bytes(bytes)).collect()
        })
    }

    /// Does a job that is wanted once, and gives its results: one row of results for each row of arguments.
    ///
    /// # Errors
    /// The device's.
    pub fn run(&self, invocations: u32, rows: &[u32], results: usize) -> Result<Vec<u32>, Error> {
        let job = self.job(invocations, [0; 2], rows, results)?;
        self.results(&job)
    }

    fn encoder(&self) -> wgpu::CommandEncoder {
        self.gpu
            .device()
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    fn record(&self, encoder: &mut wgpu::CommandEncoder, job: &Job, times: u32) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &job.bindings, &[]);
        for _ in 0..times {
            pass.dispatch_workgroups(job.invocations.div_ceil(WORKGROUP), 1, 1);
        }
    }
}

const LAYOUT: wgpu::BindGroupLayoutDescriptor = {
    use wgpu::BufferBindingType::{Storage, Uniform};
    wgpu::BindGroupLayoutDescriptor {
        label: Some("kernel"),
        entries: &[
            buffers::binding(0, Storage { read_only: true }),
            buffers::binding(1, Storage { read_only: false }),
            buffers::binding(2, Uniform),
        ],
    }
};

fn parse(wgsl: &str) -> Result<(Module, ModuleInfo), Error> {
    let broken = |reason: String| Error::Invalid {
        reason: format!("a kernel is not a valid shader: {reason}"),
    };
    let module =
        naga::front::wgsl::parse_str(wgsl).map_err(|error| broken(error.emit_to_string(wgsl)))?;
    let wanted = Capabilities::FLOAT64 | Capabilities::SHADER_INT64;
    let info = Validator::new(ValidationFlags::all(), wanted)
        .validate(&module)
        .map_err(|error| broken(error.emit_to_string(wgsl)))?;
    Ok((module, info))
}
