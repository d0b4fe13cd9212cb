//! One picture of a program, ready to be drawn on any machine.

use std::path::PathBuf;

use pullback_compiler::lower::{self, Precision};
use pullback_compiler::{Picture, SceneModule, SettingValue};
use pullback_runtime::auto::{Scenery, Trier};
use pullback_runtime::{Frame, Pipeline, Size, View, fill_in_scale};

use super::failure::Failure;
use super::mesh;
use super::place::Computer;
use super::source::Source;
use super::{Console, Input, Numbers, Rules, Settings, Which, overrides, render};

/// What the command line says of the picture.
pub(super) struct Wanted<'a> {
    pub(super) input: &'a Input,
    pub(super) which: Which,
    pub(super) rules: Rules,
    pub(super) settings: &'a Settings,
    pub(super) center: Option<[f64; 2]>,
    pub(super) height: Option<f64>,
    pub(super) size: Size,
    pub(super) samples: u32,
}

/// A picture with everything but the machine and the tier.
pub(super) struct Subject {
    pub(super) source: Source,
    pub(super) index: usize,
    pub(super) settings: Vec<SettingValue>,
    pub(super) params: Vec<f64>,
    view: View,
    size: Size,
    samples: u32,
    time: f64,
    mesh: Option<PathBuf>,
}

impl Subject {
    /// Reads and compiles the program, and tells its diagnostics.
    pub(super) fn open(wanted: &Wanted, console: &Console) -> Result<Self, Failure> {
        let source = Source::open(wanted.input, console)?.with_rewrites(wanted.rules);
        let index = source.picture(wanted.which, console)?;
        let picture = &source.program.pictures()[index];
        let (params, mut settings) =
            overrides::for_picture(&wanted.settings.set, &source.program, picture)?;
        let view = render::view(wanted.center, wanted.height, picture, &settings)?;
        let time = wanted.settings.time;
        fill_in_scale(&mut settings, picture, &view, wanted.size, &params, time);
        Ok(Self {
            index,
            settings,
            params,
            view,
            size: wanted.size,
            samples: wanted.samples,
            time,
            mesh: wanted.settings.mesh.clone(),
            source,
        })
    }

    /// The first picture of a program as it is, with one sample at each place of a grid of two by two in a pixel.
    pub(super) fn small(source: Source, size: Size) -> Result<Self, Failure> {
        let picture = &source.program.pictures()[0];
        let (params, mut settings) = overrides::for_picture(&[], &source.program, picture)?;
        let view = render::view(None, None, picture, &settings)?;
        fill_in_scale(&mut settings, picture, &view, size, &params, 0.0);
        Ok(Self {
            index: 0,
            settings,
            params,
            view,
            size,
            samples: 2,
            time: 0.0,
            mesh: None,
            source,
        })
    }

    pub(super) fn picture(&self) -> &Picture {
        &self.source.program.pictures()[self.index]
    }

    /// The frame, with the bytes of the scene's settings.
    pub(super) fn frame<'a>(&'a self, settings: &'a [u8]) -> Frame<'a> {
        Frame {
            view: self.view,
            params: &self.params,
            settings,
            size: self.size,
            samples: self.samples,
            time: self.time,
            pipeline: Pipeline::Compute,
        }
    }

    /// The frame with one sample a pixel.
    pub(super) fn single<'a>(&'a self, settings: &'a [u8]) -> Frame<'a> {
        Frame {
            samples: 1,
            ..self.frame(settings)
        }
    }

    /// The tier to draw with on what the tiers can be tried on.
    pub(super) fn precision(
        &self,
        numbers: Numbers,
        on: Trier,
        console: &Console,
    ) -> Result<Precision, Failure> {
        if let Some(precision) = numbers.wanted(&self.settings) {
            return Ok(precision);
        }
        let scenery = Scenery {
            program: &self.source.program,
            picture: self.index,
            settings: &self.settings,
            frame: &self.frame(&[]),
        };
        render::chosen(on, &scenery, &self.source, console)
    }

    /// The tier to draw with on whatever computes.
    pub(super) fn tier(
        &self,
        numbers: Numbers,
        computer: &Computer,
        console: &Console,
    ) -> Result<lower::Tier, Failure> {
        let wanted = match computer.trier() {
            Some(on) => Some(self.precision(numbers, on, console)?),
            None => numbers.wanted(&self.settings),
        };
        computer.tier(numbers.precision, wanted)
    }

    /// The scene's shader.
    pub(super) fn scene(
        &self,
        tier: lower::Tier,
        console: &Console,
    ) -> Result<SceneModule, Failure> {
        let made = self
            .source
            .program
            .scene_module_with(self.index, &self.settings, tier);
        let mut scene = self.source.expect(made, console)?;
        mesh::furnish(&mut scene, &self.settings, self.mesh.as_deref())?;
        Ok(scene)
    }
}
