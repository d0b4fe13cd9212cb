//! Pictures of programs at their own settings, on an adapter or by the executor.

use std::sync::atomic::AtomicBool;

use pullback_compiler::lower::Precision;
use pullback_compiler::scene::Space;
use pullback_compiler::{Program, SceneModule, SettingValue, compile};
use pullback_runtime::executor::{Arithmetic, Painter};
use pullback_runtime::{Error, Frame, Gpu, Pipeline, Renderer, Size, View, fill_in_scale};

/// The first picture of a program, ready to be drawn.
#[derive(Debug)]
pub struct Still {
    /// The program.
    pub program: Program,
    /// Settings, automatic ones filled in.
    pub settings: Vec<SettingValue>,
    /// The program's parameters.
    pub params: Vec<f64>,
    /// What is seen.
    pub view: View,
    /// Width and height.
    pub size: Size,
    /// Supersamples per axis.
    pub samples: u32,
    /// The module.
    pub scene: SceneModule,
}

/// What draws.
#[derive(Clone, Debug)]
pub enum Machine {
    /// An adapter.
    Adapter(Gpu),
    /// The processor.
    Processor(Arithmetic),
}

impl Still {
    /// Compiles a program, in the default precision.
    ///
    /// # Panics
    /// It does not compile.
    #[must_use]
    pub fn new(source: &str, size: Size, samples: u32) -> Self {
        Self::in_precision(source, size, samples, Precision::Accurate)
    }

    /// Compiles a program.
    ///
    /// # Panics
    /// It does not compile.
    #[must_use]
    pub fn in_precision(source: &str, size: Size, samples: u32, precision: Precision) -> Self {
        let compiled = compile(source);
        let Some(program) = compiled.program else {
            panic!("{source}: {:?}", compiled.diagnostics);
        };
        let picture = &program.pictures()[0];
        let params: Vec<f64> = program.params().iter().map(|p| p.default).collect();
        let center = picture.setting("center").unwrap_or_default();
        let height = picture.setting("height").map_or(2.0, |height| height.x);
        let view = match picture.scene.space {
            Space::Space => View {
                center: [0.0, 0.0],
                height: 2.0,
            },
            Space::Plane | Space::Complex => View {
                center: [center.x, center.y],
                height,
            },
        };
        let mut settings = picture.settings.clone();
        fill_in_scale(&mut settings, picture, &view, size, &params, 0.0);
        let scene = program
            .scene_module(0, precision)
            .unwrap_or_else(|problems| panic!("{source}: {problems:?}"));
        Self {
            settings,
            params,
            view,
            size,
            samples,
            scene,
            program,
        }
    }

    /// The shader for its settings, or, if it is to be `general`, for any.
    ///
    /// # Panics
    /// There is a mistake in the compiler.
    #[must_use]
    pub fn shader(&self, general: bool) -> SceneModule {
        if general {
            return self.scene.clone();
        }
        self.scene
            .specialised(&self.settings, self.samples)
            .expect("a module for settings")
    }

    /// The frame of a pipeline, with the bytes of the scene's settings.
    #[must_use]
    pub fn frame<'a>(&'a self, settings: &'a [u8], pipeline: Pipeline) -> Frame<'a> {
        Frame {
            view: self.view,
            params: &self.params,
            settings,
            size: self.size,
            samples: self.samples,
            time: 0.0,
            pipeline,
        }
    }

    /// Draws it in the form of a pipeline.
    ///
    /// # Errors
    /// The machine's.
    pub fn draw(&self, machine: &Machine, pipeline: Pipeline) -> Result<Vec<u8>, Error> {
        let bytes = self.scene.pack_settings(&self.settings);
        let frame = self.frame(&bytes, pipeline);
        let mut rows = Vec::new();
        match machine {
            Machine::Adapter(gpu) => {
                Renderer::for_settings(gpu, &self.scene, &self.settings, self.samples)?
                    .render(&frame, &mut rows)?;
            }
            Machine::Processor(arithmetic) => {
                let painter = Painter::new(&self.scene, *arithmetic, pipeline)?;
                let never = AtomicBool::new(false);
                painter.render(&frame, &self.settings, &never, &mut rows)?;
            }
        }
        Ok(rows)
    }
}
