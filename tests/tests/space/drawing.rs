//! Pictures of programs on the software adapter.

use pullback_compiler::lower::Precision;
use pullback_compiler::{Picture as Shown, SceneModule};
use pullback_runtime::{Frame, Gpu, Pipeline, Renderer, Size, View, fill_in_scale};
use pullback_tests::accuracy::evaluators::suite_gpu;

use crate::colour::{Rgb, decoded};

/// A picture with its sRGB pixels.
pub struct Picture {
    size: [u32; 2],
    rows: Vec<u8>,
}

impl Picture {
    /// Bytes of a pixel.
    pub fn bytes(&self, x: u32, y: u32) -> [u8; 3] {
        let at = 4 * (y * self.size[0] + x) as usize;
        [0, 1, 2].map(|k| self.rows[at + k])
    }

    /// sRGB of a pixel, 0..1.
    pub fn srgb(&self, x: u32, y: u32) -> Rgb {
        self.bytes(x, y).map(|b| f64::from(b) / 255.0)
    }

    /// Linear light of a pixel.
    pub fn linear(&self, x: u32, y: u32) -> Rgb {
        self.srgb(x, y).map(decoded)
    }
}

/// The device of the suite; `None` where there is none and that is allowed.
pub fn device() -> Option<Gpu> {
    suite_gpu()
}

/// Draws the first picture of a program.
pub fn draw(gpu: &Gpu, source: &str, size: [u32; 2], samples: u32, time: f64) -> Picture {
    let rows = rendered(gpu, source, size, samples, time, Pipeline::Compute);
    Picture { size, rows }
}

/// Linear light of each pixel of the first picture of a program, row by row, as the shader computes it.
pub fn draw_linear(gpu: &Gpu, source: &str, size: [u32; 2], samples: u32) -> Vec<Rgb> {
    linear(&rendered(gpu, source, size, samples, 0.0, Pipeline::Linear))
}

/// [`draw_linear`] of a scene with a mesh.
pub fn draw_mesh(gpu: &Gpu, source: &str, size: [u32; 2], mesh: Vec<[u32; 4]>) -> Vec<Rgb> {
    linear(&rendered_mesh(
        gpu,
        source,
        size,
        1,
        (0.0, Pipeline::Linear),
        mesh,
    ))
}

fn linear(rows: &[u8]) -> Vec<Rgb> {
    let number = |at: &[u8]| f64::from(f32::from_le_bytes([at[0], at[1], at[2], at[3]]));
    rows.chunks_exact(16)
        .map(|pixel| [0, 4, 8].map(|at| number(&pixel[at..at + 4])))
        .collect()
}

fn rendered(
    gpu: &Gpu,
    source: &str,
    size: [u32; 2],
    samples: u32,
    time: f64,
    pipeline: Pipeline,
) -> Vec<u8> {
    rendered_mesh(gpu, source, size, samples, (time, pipeline), Vec::new())
}

fn rendered_mesh(
    gpu: &Gpu,
    source: &str,
    size: [u32; 2],
    samples: u32,
    (time, pipeline): (f64, Pipeline),
    mesh: Vec<[u32; 4]>,
) -> Vec<u8> {
    let compiled = pullback_compiler::compile(source);
    let program = compiled
        .program
        .unwrap_or_else(|| panic!("{source}: {:?}", compiled.diagnostics));
    let picture = &program.pictures()[0];
    let mut scene = program
        .scene_module(0, Precision::Accurate)
        .expect("a scene");
    scene.mesh = mesh;
    rendered_scene(gpu, &scene, picture, size, samples, (time, pipeline))
}

/// Linear light of each pixel of a scene with the settings of a picture.
pub fn draw_scene(gpu: &Gpu, scene: &SceneModule, picture: &Shown, size: [u32; 2]) -> Vec<Rgb> {
    linear(&rendered_scene(
        gpu,
        scene,
        picture,
        size,
        1,
        (0.0, Pipeline::Linear),
    ))
}

fn rendered_scene(
    gpu: &Gpu,
    scene: &SceneModule,
    picture: &Shown,
    size: [u32; 2],
    samples: u32,
    (time, pipeline): (f64, Pipeline),
) -> Vec<u8> {
    let view = View {
        center: [0.0; 2],
        height: 2.0,
    };
    let pixels = Size {
        width: size[0],
        height: size[1],
    };
    let mut settings = picture.settings.clone();
    fill_in_scale(&mut settings, picture, &view, pixels, &[], time);
    let frame = Frame {
        view,
        params: &[],
        settings: &scene.pack_settings(&settings),
        size: pixels,
        samples,
        time,
        pipeline,
    };
    let mut rows = Vec::new();
    Renderer::new(gpu, scene)
        .and_then(|mut r| r.render(&frame, &mut rows))
        .expect("a picture");
    rows
}
