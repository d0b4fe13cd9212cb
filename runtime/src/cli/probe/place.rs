//! Where a program is traced, and how on each machine.

use std::fmt;

use pullback_compiler::lower::Tier;
use pullback_compiler::scene::Space;
use pullback_compiler::{EvalModule, SceneModule, What};
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::trace::{self, GpuTracer, Inputs, Recorders, Site, Trace, Traced};
use pullback_runtime::{Error, Gpu};

use super::{Column, Machine, ProbeArguments};
use crate::cli::Console;
use crate::cli::failure::Failure;
use crate::cli::subject::Subject;

/// What is traced.
#[derive(Clone, Copy, Debug)]
pub(super) enum Place<'a> {
    /// The whole scene, at the middle of a pixel.
    Pixel([u32; 2]),
    /// The formula with its derivatives, at a point.
    Point(&'a [f64]),
}

impl fmt::Display for Place<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Pixel([x, y]) => write!(f, "pixel {x},{y}"),
            Self::Point(point) => {
                let all: Vec<String> = point.iter().map(f64::to_string).collect();
                write!(f, "point {}", all.join(","))
            }
        }
    }
}

/// Places at which a traced scene may tell something on a software adapter, and on hardware.
const ON_SOFTWARE: u64 = 250;
const ON_HARDWARE: u64 = 1500;

/// How many places a traced scene may have on a device; as many as there are where none takes part.
pub(super) fn limit(gpu: Option<&Gpu>) -> Option<u64> {
    Some(if gpu?.adapter().is_software() {
        ON_SOFTWARE
    } else {
        ON_HARDWARE
    })
}

/// A compiled shader.
enum Shader {
    Scene(Box<SceneModule>, Vec<u8>),
    Evaluation(Box<EvalModule>),
}

impl Place<'_> {
    /// What each machine that is asked for computes, with the sites that it is told at.
    pub(super) fn columns(
        &self,
        arguments: &ProbeArguments,
        subject: &Subject,
        gpu: Option<&Gpu>,
        tier: Tier,
        console: &Console,
    ) -> Result<(Vec<Site>, Vec<Column>), Failure> {
        let shader = self.compile(subject, tier, console)?;
        let limit = limit(gpu);
        let silent = shader.traced(subject, Recorders::Silent, limit)?;
        let mut columns = Vec::new();
        for machine in Machine::ALL {
            if !arguments.computes(machine) {
                continue;
            }
            let trace = match (machine, gpu) {
                (Machine::Gpu, None) => continue,
                (Machine::Gpu, Some(gpu)) => self.on_gpu(&shader, subject, gpu)?,
                (Machine::Ieee32, _) => {
                    self.on_cpu(&shader, subject, &silent, Arithmetic::Ieee32)?
                }
                (Machine::Reference, _) => {
                    self.on_cpu(&shader, subject, &silent, Arithmetic::Reference)?
                }
            };
            columns.push(Column {
                name: machine.name(),
                trace,
            });
        }
        Ok((silent.sites, columns))
    }

    fn compile(&self, subject: &Subject, tier: Tier, console: &Console) -> Result<Shader, Failure> {
        let Self::Point(point) = *self else {
            let scene = subject.scene(tier, console)?;
            let bytes = scene.pack_settings(&subject.settings);
            return Ok(Shader::Scene(Box::new(scene), bytes));
        };
        let what = match subject.picture().scene.space {
            Space::Complex => What::Derivative,
            Space::Plane | Space::Space => What::Gradient,
        };
        let source = &subject.source;
        let module = source.program.eval_module(subject.index, what, tier);
        let module = source.expect(module, console)?;
        if point.len() != module.inputs.len() {
            let columns = module.inputs.join(",");
            return Err(Failure::usage_hint(
                format!(
                    "--at has {} numbers, and this formula takes others",
                    point.len()
                ),
                format!("it takes {columns}"),
            ));
        }
        Ok(Shader::Evaluation(Box::new(module)))
    }

    fn on_gpu(&self, shader: &Shader, subject: &Subject, gpu: &Gpu) -> Result<Trace, Error> {
        let inputs = match (self, shader) {
            (Self::Pixel(pixel), Shader::Scene(scene, bytes)) => {
                Inputs::pixel(&subject.frame(bytes), scene.tier, *pixel)?
            }
            (Self::Point(point), Shader::Evaluation(module)) => {
                Inputs::row(module, around(subject), point)?
            }
            _ => return Ok(Trace::default()),
        };
        let traced = shader.traced(subject, Recorders::Writing, limit(Some(gpu)))?;
        GpuTracer::new(gpu, &traced, &inputs)?.trace(&inputs)
    }

    fn on_cpu(
        &self,
        shader: &Shader,
        subject: &Subject,
        traced: &Traced,
        arithmetic: Arithmetic,
    ) -> Result<Trace, Error> {
        match (self, shader) {
            (Self::Pixel(pixel), Shader::Scene(scene, bytes)) => {
                let frame = subject.frame(bytes);
                let settings = &subject.settings;
                trace::pixel_on_cpu(arithmetic, scene, traced, &frame, settings, *pixel)
            }
            (Self::Point(point), Shader::Evaluation(module)) => {
                trace::row_on_cpu(arithmetic, module, traced, around(subject), point)
            }
            _ => Ok(Trace::default()),
        }
    }
}

impl Shader {
    fn traced(
        &self,
        subject: &Subject,
        recorders: Recorders,
        limit: Option<u64>,
    ) -> Result<Traced, Error> {
        let text = &subject.source.text;
        match self {
            Self::Scene(scene, _) => {
                trace::traced_scene(subject.picture(), scene, text, recorders, limit)
            }
            Self::Evaluation(module) => trace::traced_evaluation(module, text, recorders),
        }
    }
}

fn around(subject: &Subject) -> Surroundings<'_> {
    let frame = subject.frame(&[]);
    Surroundings {
        params: frame.params,
        time: frame.time,
        pixel: frame.pixel(),
    }
}
