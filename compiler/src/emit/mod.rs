//! Formulas and scenes as text of shading languages.

mod build;
mod constants;
mod header;
mod host;
mod names;
mod parts;
pub mod print;
mod request;
mod restore;
mod text;

pub use request::{Emission, EmitWhat, Emitted, EmittedFunction, ParamsAs};
pub use restore::restore_operators;
pub use text::{Target, write};

use naga::Module;
use pullback_grammar::Diagnostic;

use crate::lower::{Format, LowerError, Precision, Tier};
use crate::module::{EvalModule, Evaluator, ModuleError, SceneModule, What};
use crate::program::{Picture, Program, SettingValue};
use build::BuiltModule;
use parts::Part;

impl Program {
    fn picture(&self, index: usize) -> Result<&Picture, Vec<Diagnostic>> {
        self.pictures().get(index).ok_or_else(|| {
            vec![Diagnostic::error(
                "no-picture",
                pullback_grammar::Span::default(),
                format!(
                    "there are {} pictures, not {}",
                    self.pictures().len(),
                    index + 1
                ),
            )]
        })
    }

    fn with_picture<T>(
        &self,
        index: usize,
        make: impl FnOnce(&Picture) -> Result<T, ModuleError>,
    ) -> Result<T, Vec<Diagnostic>> {
        let picture = self.picture(index)?;
        make(picture).map_err(|error| vec![error.diagnostic(&picture.formula)])
    }

    /// The scene's module with the formula in it.
    ///
    /// # Errors
    /// What the formula lacks for the scene, at its place.
    pub fn scene_module(
        &self,
        picture: usize,
        tier: impl Into<Tier>,
    ) -> Result<SceneModule, Vec<Diagnostic>> {
        self.with_picture(picture, |p| SceneModule::new(p, tier))
    }

    /// The scene's module where the picture's settings have other values than in the text: some of them decide what is compiled.
    ///
    /// # Errors
    /// As [`Self::scene_module`].
    pub fn scene_module_with(
        &self,
        picture: usize,
        settings: &[SettingValue],
        tier: impl Into<Tier>,
    ) -> Result<SceneModule, Vec<Diagnostic>> {
        self.with_picture(picture, |p| {
            let changed = Picture {
                settings: settings.to_vec(),
                ..p.clone()
            };
            SceneModule::new(&changed, tier)
        })
    }

    /// A module that evaluates rows of numbers.
    ///
    /// # Errors
    /// What the formula lacks, at its place.
    pub fn eval_module(
        &self,
        picture: usize,
        what: What,
        tier: impl Into<Tier>,
    ) -> Result<EvalModule, Vec<Diagnostic>> {
        self.with_picture(picture, |p| EvalModule::new(&p.formula, what, tier))
    }

    /// The `f64` reference for rows of numbers.
    ///
    /// # Errors
    /// What the formula lacks, at its place.
    pub fn evaluator(&self, picture: usize, what: What) -> Result<Evaluator, Vec<Diagnostic>> {
        self.with_picture(picture, |p| Evaluator::new(&p.formula, what))
    }

    /// Text (or words, for SPIR-V) of one function of the formula, or of its scene, in a shading language.
    ///
    /// # Errors
    /// What the formula lacks, at its place, or what the shading language cannot say.
    pub fn emit(
        &self,
        picture: usize,
        what: EmitWhat,
        target: Target,
        precision: Precision,
    ) -> Result<Vec<u8>, Vec<Diagnostic>> {
        let emission = Emission {
            picture,
            ..Emission::new(what, target).precision(precision)
        };
        Ok(self.emit_all(&emission)?.bytes)
    }

    /// Functions of the formula in one file, with the library functions that they call, or the whole scene.
    ///
    /// # Errors
    /// What the formula lacks, at its place, or what the language cannot say.
    pub fn emit_all(&self, emission: &Emission) -> Result<Emitted, Vec<Diagnostic>> {
        self.with_picture(emission.picture, |picture| self.emitted(picture, emission))
    }

    /// The module that [`Self::emit_all`] prints, with the names that its functions are to have.
    ///
    /// # Errors
    /// As [`Self::emit_all`].
    pub fn emitted_module(&self, emission: &Emission) -> Result<Module, Vec<Diagnostic>> {
        self.with_picture(emission.picture, |picture| {
            let (_, built) = self.built(picture, emission)?;
            Ok(built.module)
        })
    }

    fn built(
        &self,
        picture: &Picture,
        emission: &Emission,
    ) -> Result<(Vec<Part>, BuiltModule), ModuleError> {
        let wanted = emission.parts.iter().copied();
        let values = (emission.params == ParamsAs::Constants).then(|| self.params());
        let parts: Vec<Part> = wanted
            .map(|what| parts::part(picture, what, values))
            .collect::<Result<_, _>>()?;
        let built = build::build(self, &parts, emission)?;
        Ok((parts, built))
    }

    fn emitted(&self, picture: &Picture, emission: &Emission) -> Result<Emitted, ModuleError> {
        can_say(emission.target, emission.precision)?;
        if let Some(problem) = misnamed(emission) {
            return Err(demand(problem));
        }
        if emission.parts.contains(&EmitWhat::Scene) {
            return scene(picture, emission);
        }
        if emission.target.is_host() {
            return host::emitted(self, picture, emission);
        }
        let (parts, built) = self.built(picture, emission)?;
        text::functions(emission, &parts, &built)
    }
}

/// What is wrong with the names that were asked for.
fn misnamed(emission: &Emission) -> Option<String> {
    let is_name = |name: &str| {
        let latin = crate::lower::identifier(name);
        latin.starts_with(|c: char| c.is_ascii_alphabetic())
            && latin.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
    };
    let names = emission.renamed.iter().map(|(_, to)| to);
    let wrong = emission.name.iter().chain(names).find(|n| !is_name(n))?;
    Some(format!("`{wrong}` is no name"))
}

fn demand(message: impl Into<String>) -> ModuleError {
    ModuleError::Lower(LowerError::Demand(message.into()))
}

/// A whole scene, by naga's writers: it has entry points and buffers.
fn scene(picture: &Picture, emission: &Emission) -> Result<Emitted, ModuleError> {
    if emission.parts.len() > 1 {
        return Err(demand(
            "a scene is emitted alone, without further functions",
        ));
    }
    if !Target::LANGUAGES.contains(&emission.target) {
        return Err(demand(format!(
            "a scene is written in WGSL, GLSL, HLSL, MSL or SPIR-V, not for `{}`",
            emission.target.name()
        )));
    }
    let mut scene = SceneModule::new(picture, emission.precision)?;
    let mut head = format!("the scene `{}`", picture.scene.name);
    if let Some(samples) = emission.fixed_samples {
        scene = scene.specialised(&picture.settings, samples)?;
        head.push_str(&format!(
            " for its settings and {samples} samples per axis, which are constants"
        ));
    }
    let formula = crate::lower::identifier(&picture.formula.name);
    let mut ours: Vec<String> = crate::module::DEMANDS.map(str::to_owned).into();
    ours.push(formula);
    names::keep_names(&mut scene.module, &ours);
    let bytes = write(&scene.module, &scene.info, emission.target, &head);
    Ok(Emitted {
        bytes: bytes.map_err(ModuleError::Invalid)?,
        functions: Vec::new(),
    })
}

/// Fails where a shading language cannot say what a tier needs: 64-bit numbers, and their bits as integers.
fn can_say(target: Target, precision: Precision) -> Result<(), ModuleError> {
    if precision.format() != Format::Double || matches!(target, Target::Wgsl | Target::Spirv) {
        return Ok(());
    }
    Err(demand(
        "`double` is written as WGSL (with the f64 and u64 of wgpu) and as SPIR-V only; `extended` as any target",
    ))
}
