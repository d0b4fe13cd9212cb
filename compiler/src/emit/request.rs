//! What is asked for when code is emitted, and what comes of it.

use super::Target;
use crate::lower::Precision;

/// A function that is emitted, or the whole scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum EmitWhat {
    /// A function for the value.
    Value,
    /// A function for the partial derivatives and the value.
    Gradient,
    /// A function for the partial derivatives alone.
    Partials,
    /// A function for the value and the derivative along a direction that is given with the point.
    Directional,
    /// A function for the value and the derivative by one variable.
    Derivative,
    /// A function for the value, the first and the second partial derivatives.
    Hessian,
    /// A function for the integral along a ray o + t d from t = a to t = b.
    Integral,
    /// The same along a ray whose origin was moved in a wider format, which takes what its numbers were rounded by, too
    /// ([`crate::integrate::shifted_field_integral`]).
    ShiftedIntegral,
    /// A function for the part of the light that comes through f as an extinction, exp(-τ) with that integral τ.
    Transmittance,
    /// A function for the part that does not, 1 - exp(-τ) without cancellation: times a colour, what a medium emits that glows as
    /// it absorbs.
    Opacity,
    /// The whole scene.
    Scene,
}

impl EmitWhat {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Value,
        Self::Gradient,
        Self::Partials,
        Self::Directional,
        Self::Derivative,
        Self::Hessian,
        Self::Integral,
        Self::ShiftedIntegral,
        Self::Transmittance,
        Self::Opacity,
        Self::Scene,
    ];

    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Value => "value",
            Self::Gradient => "gradient",
            Self::Partials => "partials",
            Self::Directional => "directional",
            Self::Derivative => "derivative",
            Self::Hessian => "hessian",
            Self::Integral => "integral",
            Self::ShiftedIntegral => "shifted-integral",
            Self::Transmittance => "transmittance",
            Self::Opacity => "opacity",
            Self::Scene => "scene",
        }
    }

    /// What is set behind the formula's name for the name of the function.
    pub(super) fn suffix(self) -> &'static str {
        match self {
            Self::Value => "",
            Self::Gradient => "_gradient",
            Self::Partials => "_partials",
            Self::Directional => "_along",
            Self::Derivative => "_derivative",
            Self::Hessian => "_hessian",
            Self::Integral => "_integral",
            Self::ShiftedIntegral => "_shifted_integral",
            Self::Transmittance => "_transmittance",
            Self::Opacity => "_opacity",
            Self::Scene => "_scene",
        }
    }
}

/// How the emitted functions get the program's parameters, the clock and the footprint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ParamsAs {
    /// As arguments behind the point.
    #[default]
    Arguments,
    /// From a uniform of the module: in WGSL a structure `params`, in GLSL one uniform each, in HLSL a constant buffer. In MSL and
    /// C, which have none, a structure is the last argument.
    Uniform,
    /// As constants: the parameters' values in the program. The clock and the footprint stay arguments.
    Constants,
}

/// What is to be emitted. Made by [`Emission::new`] and changed by the methods, or by its fields.
///
/// ```
/// use pullback_compiler::{EmitWhat, Emission, Target, compile};
///
/// let program = compile("param k = 2 in 0..5\nf(x, y) = sin(k x) y").program.expect("no errors");
/// let emission = Emission::new(EmitWhat::Value, Target::C)
///     .and(EmitWhat::Gradient)
///     .named("wave");
/// let emitted = program.emit_all(&emission).expect("both exist");
/// assert_eq!(emitted.functions[1].signature, "vec3 wave_gradient(float x, float y, float k)");
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Emission {
    /// Which picture of the program, from 0.
    pub picture: usize,
    /// The functions, in one module; a scene stands alone.
    pub parts: Vec<EmitWhat>,
    /// The language.
    pub target: Target,
    /// What the numbers are computed with.
    pub precision: Precision,
    /// Where parameters come from.
    pub params: ParamsAs,
    /// A name in the place of the formula's.
    pub name: Option<String>,
    /// Other names for arguments and parameters: the name in the program, then the new one.
    pub renamed: Vec<(String, String)>,
    /// Samples per axis of a scene that is made for its settings alone, which are then constants; `None` keeps them uniforms.
    pub fixed_samples: Option<u32>,
    /// The program's text, for the head of the file.
    pub source: Option<String>,
    /// The command that emits this again, for the head of the file.
    pub command: Option<String>,
}

impl Emission {
    /// One function of the program's first picture, in single precision with declared errors.
    #[must_use]
    pub fn new(what: EmitWhat, target: Target) -> Self {
        Self {
            picture: 0,
            parts: vec![what],
            target,
            precision: Precision::default(),
            params: ParamsAs::default(),
            name: None,
            renamed: Vec::new(),
            fixed_samples: None,
            source: None,
            command: None,
        }
    }

    /// One more function in the same module.
    #[must_use]
    pub fn and(mut self, what: EmitWhat) -> Self {
        if !self.parts.contains(&what) {
            self.parts.push(what);
        }
        self
    }

    /// Another name for the formula.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        self.name = Some(name.to_owned());
        self
    }

    /// Another name for an argument or a parameter.
    #[must_use]
    pub fn renamed(mut self, from: &str, to: &str) -> Self {
        self.renamed.push((from.to_owned(), to.to_owned()));
        self
    }

    /// Another place of the parameters.
    #[must_use]
    pub fn params(mut self, params: ParamsAs) -> Self {
        self.params = params;
        self
    }

    /// Another precision.
    #[must_use]
    pub fn precision(mut self, precision: Precision) -> Self {
        self.precision = precision;
        self
    }

    /// What the head of the file quotes: the program's text, and the command that makes the file.
    #[must_use]
    pub fn quoting(mut self, source: &str, command: &str) -> Self {
        self.source = Some(source.to_owned());
        self.command = Some(command.to_owned());
        self
    }

    /// The name that something of the program has in the emitted text, before the language makes it its own.
    pub(super) fn name_of(&self, name: &str) -> String {
        let found = self.renamed.iter().find(|(from, _)| from == name);
        let name = found.map_or(name, |(_, to)| to);
        crate::lower::identifier(name)
    }
}

/// Emitted code.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Emitted {
    /// The file: text, or words of SPIR-V.
    pub bytes: Vec<u8>,
    /// The functions that were asked for, in this order; none for a scene.
    pub functions: Vec<EmittedFunction>,
}

/// A function in emitted code.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct EmittedFunction {
    /// What it computes.
    pub what: EmitWhat,
    /// What it is called.
    pub name: String,
    /// Its declaration in the language; for SPIR-V, in WGSL.
    pub signature: String,
    /// What it returns, in words.
    pub returns: String,
}
