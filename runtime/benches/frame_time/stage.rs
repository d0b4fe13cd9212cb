//! Drawing the same picture again and again on a device, timed.

use std::sync::mpsc;
use std::time::Instant;

use naga::Module;
use naga::valid::ModuleInfo;
use pullback_runtime::{Error, Gpu, Pipeline, shader};

use pullback_compiler::lower::{Format, Tier};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// What the uniforms of a picture hold.
pub struct Uniforms {
    pub settings: Vec<u8>,
    pub params: Vec<f64>,
    pub center: [f64; 2],
    pub height: f64,
}

/// What all shaders of a picture share: uniforms and targets.
pub struct Canvas {
    gpu: Gpu,
    width: u32,
    height: u32,
    uniforms: [wgpu::Buffer; 3],
    pairs: wgpu::Buffer,
    doubles: wgpu::Buffer,
    mesh: wgpu::Buffer,
    image: wgpu::Buffer,
    target: wgpu::Texture,
    clock: Option<Clock>,
}

/// Timestamps of the device.
struct Clock {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    readable: wgpu::Buffer,
    seconds: f64,
}

/// A shader as a pipeline of one kind.
pub struct Stage {
    pass: Pass,
    bindings: wgpu::BindGroup,
    /// Seconds that the driver took to make the pipeline.
    pub built: f64,
}

#[derive(Clone)]
enum Pass {
    Compute(wgpu::ComputePipeline),
    Fragment(wgpu::RenderPipeline),
}

impl Canvas {
    pub fn new(gpu: &Gpu, given: &Uniforms, [width, height]: [u32; 2]) -> Result<Self, Error> {
        let device = gpu.device();
        let filled = |bytes: &[u8], usage: wgpu::BufferUsages| {
            let buffer = device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: bytes.len() as u64,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            gpu.queue().write_buffer(&buffer, 0, bytes);
            buffer
        };
        let uniform = |bytes: &[u8]| filled(bytes, wgpu::BufferUsages::UNIFORM);
        let [x, y] = given.center.map(|c| c as f32);
        let pixel = given.height / f64::from(height);
        let floats = |f: [f32; 4]| f.map(f32::to_bits);
        let head = floats([x, y, width as f32, height as f32]);
        let tile = floats([0.0, 0.0, pixel as f32, 0.0]);
        let view = [head, tile, [1, 0, width, height]].concat();
        let mut params = [0.0; 64];
        for (slot, &value) in params.iter_mut().zip(&given.params) {
            *slot = value as f32;
        }
        let wide = |format: Format| {
            let [x, y] = given.center;
            let mut numbers = vec![x, y, 0.0, pixel];
            numbers.extend(&given.params);
            numbers.resize(4 + 64, 0.0);
            let words: Vec<[u32; 2]> = numbers.into_iter().map(|n| format.words(n)).collect();
            filled(bytemuck::cast_slice(&words), wgpu::BufferUsages::STORAGE)
        };
        gpu.guarded("allocation", || Self {
            gpu: gpu.clone(),
            width,
            height,
            uniforms: [
                uniform(bytemuck::cast_slice(&view)),
                uniform(bytemuck::cast_slice(&params)),
                uniform(&given.settings),
            ],
            pairs: wide(Format::Pair),
            doubles: wide(Format::Double),
            // no scene of the gallery asks for one
            mesh: filled(&[0; 16], wgpu::BufferUsages::STORAGE),
            image: device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: u64::from(width) * u64::from(height) * 4,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            target: device.create_texture(&wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: FORMAT,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            }),
            clock: Clock::new(gpu),
        })
    }

    /// Whether times are the device's own.
    pub fn has_clock(&self) -> bool {
        self.clock.is_some()
    }

    /// Makes a pipeline.
    pub fn stage(
        &self,
        module: &Module,
        info: &ModuleInfo,
        tier: Tier,
        pipeline: Pipeline,
    ) -> Result<Stage, Error> {
        let format = tier.precision.format();
        let start = Instant::now();
        let shader = shader::load(&self.gpu, module, info, tier)?;
        let pass = self
            .gpu
            .guarded("compiling a pipeline", || match pipeline {
                Pipeline::Compute | Pipeline::Linear => Pass::Compute(self.compute(&shader)),
                Pipeline::Fragment => Pass::Fragment(self.fragment(&shader)),
            })?;
        let built = start.elapsed().as_secs_f64();
        let bindings = self.gpu.guarded("binding", || self.bind(&pass, format))?;
        Ok(Stage {
            pass,
            bindings,
            built,
        })
    }

    /// A pipeline that another canvas has made, for the uniforms and the size of this one.
    #[allow(
        dead_code,
        reason = "for the benchmark of tiers, which shares this file"
    )]
    pub fn moved(&self, stage: &Stage, format: Format) -> Result<Stage, Error> {
        let pass = stage.pass.clone();
        let bindings = self.gpu.guarded("binding", || self.bind(&pass, format))?;
        Ok(Stage {
            pass,
            bindings,
            built: stage.built,
        })
    }

    fn layout(&self, pipeline: Pipeline) -> wgpu::BindGroupLayout {
        let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty: wgpu::BindingType::Buffer {
                ty,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let stages = match pipeline {
            Pipeline::Compute | Pipeline::Linear => wgpu::ShaderStages::COMPUTE,
            Pipeline::Fragment => wgpu::ShaderStages::FRAGMENT,
        };
        let mut entries: Vec<_> = [0, 1, 2, 3, 4]
            .into_iter()
            .map(|k| {
                let ty = match k {
                    3 | 4 => wgpu::BufferBindingType::Storage { read_only: true },
                    _ => wgpu::BufferBindingType::Uniform,
                };
                entry(k, stages, ty)
            })
            .collect();
        if pipeline == Pipeline::Compute {
            entries.push(entry(
                5,
                stages,
                wgpu::BufferBindingType::Storage { read_only: false },
            ));
        }
        let descriptor = wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &entries,
        };
        self.gpu.device().create_bind_group_layout(&descriptor)
    }

    fn pipeline_layout(&self, pipeline: Pipeline) -> wgpu::PipelineLayout {
        self.gpu
            .device()
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: &[Some(&self.layout(pipeline))],
                immediate_size: 0,
            })
    }

    fn compute(&self, shader: &wgpu::ShaderModule) -> wgpu::ComputePipeline {
        self.gpu
            .device()
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: Some(&self.pipeline_layout(Pipeline::Compute)),
                module: shader,
                entry_point: Some("compute_main"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
    }

    fn fragment(&self, shader: &wgpu::ShaderModule) -> wgpu::RenderPipeline {
        self.gpu
            .device()
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: None,
                layout: Some(&self.pipeline_layout(Pipeline::Fragment)),
                vertex: wgpu::VertexState {
                    module: shader,
                    entry_point: Some("vertex_main"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: shader,
                    entry_point: Some("fragment_main"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(FORMAT.into())],
                }),
                multiview_mask: None,
                cache: None,
            })
    }

    fn bind(&self, pass: &Pass, format: Format) -> wgpu::BindGroup {
        let wide = match format {
            Format::Single | Format::Pair => &self.pairs,
            Format::Double => &self.doubles,
        };
        let mut buffers: Vec<(u32, &wgpu::Buffer)> = (0..).zip(&self.uniforms).collect();
        buffers.extend([(3, wide), (4, &self.mesh)]);
        let pipeline = match pass {
            Pass::Compute(_) => {
                buffers.push((5, &self.image));
                Pipeline::Compute
            }
            Pass::Fragment(_) => Pipeline::Fragment,
        };
        let entries: Vec<_> = buffers
            .into_iter()
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        self.gpu
            .device()
            .create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &self.layout(pipeline),
                entries: &entries,
            })
    }

    /// Draws the picture `repeats` times in one submission, and gives the seconds for one of them: by the device's
    /// clock, or else by ours from the submission to its end.
    pub fn time(&self, stage: &Stage, repeats: u32) -> Result<f64, Error> {
        let encoder = self
            .gpu
            .guarded("recording", || self.record(stage, repeats))?;
        let start = Instant::now();
        let submission = self.gpu.queue().submit([encoder.finish()]);
        self.gpu.wait("drawing", submission)?;
        let elapsed = start.elapsed().as_secs_f64();
        let total = match &self.clock {
            Some(clock) => clock.read(&self.gpu)?,
            None => elapsed,
        };
        Ok(total / f64::from(repeats))
    }

    fn record(&self, stage: &Stage, repeats: u32) -> wgpu::CommandEncoder {
        let mut encoder = self
            .gpu
            .device()
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        match &stage.pass {
            Pass::Compute(pipeline) => {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: None,
                    timestamp_writes: self.clock.as_ref().map(|clock| {
                        wgpu::ComputePassTimestampWrites {
                            query_set: &clock.queries,
                            beginning_of_pass_write_index: Some(0),
                            end_of_pass_write_index: Some(1),
                        }
                    }),
                });
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &stage.bindings, &[]);
                for _ in 0..repeats {
                    pass.dispatch_workgroups(self.width.div_ceil(8), self.height.div_ceil(8), 1);
                }
            }
            Pass::Fragment(pipeline) => {
                let view = self
                    .target
                    .create_view(&wgpu::TextureViewDescriptor::default());
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: None,
                    color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                        view: &view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations {
                            load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                            store: wgpu::StoreOp::Store,
                        },
                    })],
                    timestamp_writes: self.clock.as_ref().map(|clock| {
                        wgpu::RenderPassTimestampWrites {
                            query_set: &clock.queries,
                            beginning_of_pass_write_index: Some(0),
                            end_of_pass_write_index: Some(1),
                        }
                    }),
                    ..Default::default()
                });
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &stage.bindings, &[]);
                for _ in 0..repeats {
                    pass.draw(0..3, 0..1);
                }
            }
        }
        if let Some(clock) = &self.clock {
            encoder.resolve_query_set(&clock.queries, 0..2, &clock.resolved, 0);
            encoder.copy_buffer_to_buffer(&clock.resolved, 0, &clock.readable, 0, 16);
        }
        encoder
    }

    /// The picture as rgba.
    pub fn picture(&self, stage: &Stage) -> Result<Vec<u8>, Error> {
        let mut encoder = self.gpu.guarded("recording", || self.record(stage, 1))?;
        let row = self.width * 4;
        let stride = match stage.pass {
            Pass::Compute(_) => row,
            Pass::Fragment(_) => row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT),
        };
        let bytes = u64::from(stride) * u64::from(self.height);
        let readable = self.gpu.device().create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: bytes,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        match stage.pass {
            Pass::Compute(_) => encoder.copy_buffer_to_buffer(&self.image, 0, &readable, 0, bytes),
            Pass::Fragment(_) => encoder.copy_texture_to_buffer(
                self.target.as_image_copy(),
                wgpu::TexelCopyBufferInfo {
                    buffer: &readable,
                    layout: wgpu::TexelCopyBufferLayout {
                        offset: 0,
                        bytes_per_row: Some(stride),
                        rows_per_image: None,
                    },
                },
                self.target.size(),
            ),
        }
        self.gpu.queue().submit([encoder.finish()]);
        let padded = read(&self.gpu, &readable)?;
        Ok(padded
            .chunks(stride as usize)
            .flat_map(|line| &line[..row as usize])
            .copied()
            .collect())
    }
}

impl Clock {
    /// Software adapters have timestamps that say little; they are timed from outside.
    fn new(gpu: &Gpu) -> Option<Self> {
        let device = gpu.device();
        if gpu.adapter().is_software()
            || !device.features().contains(wgpu::Features::TIMESTAMP_QUERY)
        {
            return None;
        }
        let buffer = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: 16,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        Some(Self {
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: None,
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            readable: buffer(wgpu::BufferUsages::MAP_READ),
            seconds: f64::from(gpu.queue().get_timestamp_period()) * 1e-9,
        })
    }

    /// Seconds between the two timestamps of the last submission.
    fn read(&self, gpu: &Gpu) -> Result<f64, Error> {
        let bytes = read(gpu, &self.readable)?;
        let ticks: Vec<u64> = bytes
            .chunks_exact(8)
            .map(bytemuck::pod_read_unaligned)
            .collect();
        Ok(ticks[1].saturating_sub(ticks[0]) as f64 * self.seconds)
    }
}

/// Waits for the device, and copies the bytes of a buffer.
fn read(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Vec<u8>, Error> {
    let (sender, receiver) = mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |mapped| {
        let _ = sender.send(mapped);
    });
    let submission = gpu.queue().submit([]);
    gpu.wait("reading", submission)?;
    let failed = |reason: String| Error::Device {
        during: "reading",
        reason,
    };
    receiver
        .try_recv()
        .map_err(|e| failed(e.to_string()))?
        .map_err(|e| failed(e.to_string()))?;
    let view = buffer
        .slice(..)
        .get_mapped_range()
        .map_err(|e| failed(e.to_string()))?;
    let bytes = view.to_vec();
    drop(view);
    buffer.unmap();
    Ok(bytes)
}
