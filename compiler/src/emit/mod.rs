//! Formulas and scenes as text of shading languages.

mod function;
mod names;
mod text;

pub use text::{Target, write};

use pullback_grammar::Diagnostic;
use smallvec::smallvec;

use crate::formula::Formula;
use crate::integrate::{Otherwise, field_integral};
use crate::ir::Prim;
use crate::lower::{Format, LowerError, Precision, Tier};
use crate::module::{EvalModule, Evaluator, ModuleError, SceneModule, What};
use crate::program::{Picture, Program, SettingValue};

/// What is emitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EmitWhat {
    /// A function for the value.
    Value,
    /// A function for the partial derivatives and the value.
    Gradient,
    /// A function for the value and the derivative by one variable.
    Derivative,
    /// A function for the integral along a ray o + t d from t = a to t = b.
    Integral,
    /// A function for the part of the light that comes through f as an extinction, exp(-τ) with that integral τ.
    Transmittance,
    /// A function for the part that does not, 1 - exp(-τ) without cancellation: times a colour, what a medium emits that glows as
    /// it absorbs.
    Opacity,
    /// The whole scene.
    Scene,
}

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

    /// Text (or words, for SPIR-V) of the formula or its scene in a shading language.
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
        self.with_picture(picture, |p| {
            can_say(target, precision)?;
            let (mut module, info, header) = match what {
                EmitWhat::Integral | EmitWhat::Transmittance | EmitWhat::Opacity => {
                    self.integral_function(p, what, precision, target)?
                }
                EmitWhat::Scene => {
                    let scene = SceneModule::new(p, precision)?;
                    (
                        scene.module,
                        scene.info,
                        format!("the scene `{}`", p.scene.name),
                    )
                }
                EmitWhat::Value => {
                    function::standalone(self, &p.formula, What::Value, precision, target)?
                }
                EmitWhat::Gradient => {
                    function::standalone(self, &p.formula, What::Gradient, precision, target)?
                }
                EmitWhat::Derivative => {
                    function::standalone(self, &p.formula, What::Derivative, precision, target)?
                }
            };
            let name = &p.formula.name;
            names::keep_names(&mut module, &function::generated_names(name));
            write(&module, &info, target, &header).map_err(ModuleError::Invalid)
        })
    }

    /// A function for the integral of a picture's formula along a ray or what hangs on it, and what is said of it.
    fn integral_function(
        &self,
        picture: &Picture,
        what: EmitWhat,
        precision: Precision,
        target: Target,
    ) -> Result<(naga::Module, naga::valid::ModuleInfo, String), ModuleError> {
        let formula = &picture.formula;
        let made =
            field_integral(formula, Otherwise::Quadrature).map_err(LowerError::NoIntegral)?;
        let is_closed = made.integral.numerical.is_empty();
        let integral = of_depth(made.into_formula(formula), formula, what);
        let (module, info, header) =
            function::standalone(self, &integral, What::Value, precision, target)?;
        let of = match what {
            EmitWhat::Transmittance => "transmittance exp(-τ) of the integral τ",
            EmitWhat::Opacity => "opacity 1 - exp(-τ) of the integral τ",
            _ => "integral",
        };
        let kind = if is_closed {
            "in closed form"
        } else {
            "in part by quadrature"
        };
        Ok((
            module,
            info,
            format!("{header}, the {of} along o + t d from a to b, {kind}"),
        ))
    }
}

/// An optical depth, or the transmittance or the opacity of it.
fn of_depth(mut depth: Formula, of: &Formula, what: EmitWhat) -> Formula {
    let &[value] = depth.value.as_slice() else {
        return depth;
    };
    let g = &mut depth.graph;
    let turned = g.neg(value);
    let (value, name) = match what {
        EmitWhat::Transmittance => (g.apply(Prim::Exp, &[turned]), "transmittance"),
        EmitWhat::Opacity => {
            let change = g.apply(Prim::Expm1, &[turned]);
            (g.neg(change), "opacity")
        }
        _ => return depth,
    };
    depth.value = smallvec![value];
    depth.name = format!("{}_{name}", of.name);
    depth
}

/// Fails where a shading language cannot say what a tier needs: 64-bit numbers, and their bits as integers.
fn can_say(target: Target, precision: Precision) -> Result<(), ModuleError> {
    if precision.format() != Format::Double || matches!(target, Target::Wgsl | Target::Spirv) {
        return Ok(());
    }
    Err(ModuleError::Lower(LowerError::Demand(
        "`double` is written as WGSL (with the f64 and u64 of wgpu) and as SPIR-V only; `extended` as any target"
            .to_owned(),
    )))
}
