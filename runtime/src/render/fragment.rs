//! Tiles by the fragment entry point, into a texture.

use super::{Recorded, Stage, Uniforms, input_layout};
use crate::buffers::Growing;
use crate::tiles::Tile;
use crate::{Error, Gpu};

/// What `fragment_main` writes; the encoding to sRGB is the shader's.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Pipeline, texture and buffer of the fragment path.
#[derive(Debug)]
pub(super) struct FragmentStage {
    pipeline: wgpu::RenderPipeline,
    bindings: wgpu::BindGroup,
    target: Option<wgpu::Texture>,
    readable: Growing,
    max_pixels: u64,
    max_side: u32,
}

impl FragmentStage {
    pub(super) fn new(
        gpu: &Gpu,
        shader: &wgpu::ShaderModule,
        uniforms: &Uniforms,
    ) -> Result<Self, Error> {
        let device = gpu.device();
        let limits = device.limits();
        gpu.guarded("compiling the render pipeline", || {
            let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("fragment"),
                entries: &input_layout(wgpu::ShaderStages::FRAGMENT),
            });
            let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("fragment"),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
            let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("fragment"),
                layout: Some(&pipeline_layout),
                vertex: wgpu::VertexState {
                    module: shader,
                    entry_point: Some("vertex_main"),
                    compilation_options: Default::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: shader,
                    entry_point: Some("fragment_main"),
                    compilation_options: Default::default(),
                    targets: &[Some(FORMAT.into())],
                }),
                multiview_mask: None,
                cache: None,
            });
            let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("fragment"),
                layout: &layout,
                entries: &uniforms.entries(),
            });
            Self {
                pipeline,
                bindings,
                target: None,
                readable: Growing::readable(),
                // Rows in the buffer are padded to 64 pixels.
                max_pixels: limits.max_buffer_size / 4 / 8,
                max_side: limits.max_texture_dimension_2d,
            }
        })
    }

    /// A texture that holds the tile; it only ever grows.
    fn target(&mut self, gpu: &Gpu, tile: Tile) -> Result<wgpu::Texture, Error> {
        let (mut width, mut height) = (tile.width, tile.height);
        if let Some(target) = &self.target {
            if target.width() >= width && target.height() >= height {
                return Ok(target.clone());
            }
            // Growing to the union of all shapes would waste memory on a wide tile after a tall one.
            if u64::from(width.max(target.width())) * u64::from(height.max(target.height()))
                <= 2 * tile.pixels()
            {
                width = width.max(target.width());
                height = height.max(target.height());
            }
        }
        self.target = None;
        let made = gpu.guarded("allocation", || {
            gpu.device().create_texture(&wgpu::TextureDescriptor {
                label: Some("tile"),
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
            })
        })?;
        self.target = Some(made.clone());
        Ok(made)
    }
}

impl Stage for FragmentStage {
    fn max_pixels(&self) -> u64 {
        self.max_pixels
    }

    fn max_side(&self) -> u32 {
        self.max_side
    }

    fn record(&mut self, gpu: &Gpu, _uniforms: &Uniforms, tile: Tile) -> Result<Recorded, Error> {
        let stride = (tile.width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let bytes = u64::from(stride) * u64::from(tile.height);
        let target = self.target(gpu, tile)?;
        let (readable, _) = self.readable.at_least(gpu, bytes)?;
        let encoder = gpu.guarded("recording", || {
            let view = target.create_view(&Default::default());
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some("tile"),
                    color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                        view: &view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations {
                            load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                            store: wgpu::StoreOp::Store,
                        },
                    })],
                    ..Default::default()
                });
                pass.set_viewport(0.0, 0.0, tile.width as f32, tile.height as f32, 0.0, 1.0);
                pass.set_scissor_rect(0, 0, tile.width, tile.height);
                pass.set_pipeline(&self.pipeline);
                pass.set_bind_group(0, &self.bindings, &[]);
                pass.draw(0..3, 0..1);
            }
            encoder.copy_texture_to_buffer(
                target.as_image_copy(),
                wgpu::TexelCopyBufferInfo {
                    buffer: &readable,
                    layout: wgpu::TexelCopyBufferLayout {
                        offset: 0,
                        bytes_per_row: Some(stride),
                        rows_per_image: None,
                    },
                },
                wgpu::Extent3d {
                    width: tile.width,
                    height: tile.height,
                    depth_or_array_layers: 1,
                },
            );
            encoder
        })?;
        Ok(Recorded {
            encoder,
            readable,
            bytes,
            stride: stride as usize,
        })
    }
}
