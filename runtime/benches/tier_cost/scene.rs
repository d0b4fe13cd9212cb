//! A scene of the gallery with its pipelines.

use pullback_compiler::lower::{Format, Precision};
use pullback_compiler::scene::Space;
use pullback_compiler::{Program, compile};
use pullback_runtime::{Capabilities, Gpu, Pipeline, Size, View, fill_in_scale};

use crate::stage::{Canvas, Stage, Uniforms};

/// Where pipelines are made; they are moved to a canvas of the right size afterwards.
const ANY_SIZE: [u32; 2] = [16, 9];

/// A scene with its pipelines, one for each tier that the adapter has.
pub struct Scene {
    gpu: Gpu,
    program: Program,
    /// For the layout of its settings, which is the same in every tier.
    module: pullback_compiler::SceneModule,
    stages: Vec<Option<(Format, Stage)>>,
}

impl Scene {
    /// Compiles every tier.
    pub fn new(gpu: &Gpu, text: &str) -> Result<Self, String> {
        let program = compile(text).program.ok_or("the formula has errors")?;
        let module = |precision| {
            let tier = Capabilities::tier(gpu, precision).map_err(|e| e.to_string())?;
            program
                .scene_module(0, tier)
                .map_err(|e| e[0].message.clone())
        };
        let first = module(Precision::Fast)?;
        let given = uniforms(&program, &first, ANY_SIZE);
        let canvas = Canvas::new(gpu, &given, ANY_SIZE).map_err(|e| e.to_string())?;
        let mut stages = Vec::new();
        for precision in Precision::ALL {
            if !gpu.has(precision) {
                stages.push(None);
                continue;
            }
            let scene = module(precision)?;
            let stage = canvas
                .stage(&scene.module, &scene.info, scene.tier, Pipeline::Compute)
                .map_err(|e| e.to_string())?;
            stages.push(Some((precision.format(), stage)));
        }
        Ok(Self {
            gpu: gpu.clone(),
            module: first,
            program,
            stages,
        })
    }

    /// The pipelines with a canvas of a size.
    pub fn sized(&self, size: [u32; 2]) -> Result<(Canvas, Vec<Option<Stage>>), String> {
        let given = uniforms(&self.program, &self.module, size);
        let canvas = Canvas::new(&self.gpu, &given, size).map_err(|e| e.to_string())?;
        let stages = self.stages.iter().map(|stage| {
            let moved = |(format, stage): &(Format, Stage)| canvas.moved(stage, *format);
            stage.as_ref().map(moved).transpose()
        });
        let stages = stages
            .collect::<Result<_, _>>()
            .map_err(|e| e.to_string())?;
        Ok((canvas, stages))
    }

    /// Seconds in which the driver made each pipeline.
    pub fn built(&self) -> Vec<Option<f64>> {
        let built = |stage: &Option<(Format, Stage)>| stage.as_ref().map(|(_, s)| s.built);
        self.stages.iter().map(built).collect()
    }
}

fn uniforms(
    program: &Program,
    scene: &pullback_compiler::SceneModule,
    [width, height]: [u32; 2],
) -> Uniforms {
    let picture = &program.pictures()[0];
    let params: Vec<f64> = program.params().iter().map(|p| p.default).collect();
    let plane = picture.scene.space != Space::Space;
    let [x, y, _] = picture.setting("center").unwrap_or_default().to_array();
    let view = View {
        center: if plane { [x, y] } else { [0.0; 2] },
        height: picture.setting("height").map_or(2.0, |h| h.x),
    };
    let mut settings = picture.settings.clone();
    fill_in_scale(
        &mut settings,
        picture,
        &view,
        Size { width, height },
        &params,
        0.0,
    );
    Uniforms {
        settings: scene.pack_settings(&settings),
        params,
        center: view.center,
        height: view.height,
    }
}
