//! `pullback emit`

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use pullback_compiler::{EmitWhat, Target};
use pullback_runtime::AtomicFile;

use super::failure::Failure;
use super::source::Source;
use super::{Console, Input, Numbers, Output, Rules, Which, render};

/// Arguments of `pullback emit`.
#[derive(Debug, Args)]
pub(super) struct EmitArguments {
    #[command(flatten)]
    input: Input,
    /// The shading language
    #[arg(long, value_enum, default_value_t = Language::Wgsl)]
    target: Language,
    /// What to write
    #[arg(long, value_enum, default_value_t = Part::Value)]
    what: Part,
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    rules: Rules,
    #[command(flatten)]
    output: Output,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Language {
    Wgsl,
    Glsl,
    Hlsl,
    Msl,
    Spirv,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Part {
    /// The function alone
    Value,
    /// The function with its gradient
    Gradient,
    /// The function with its complex derivative
    Derivative,
    /// The integral of a function of space along a ray, from its origin and direction and both ends
    Integral,
    /// The part of the light that comes through the function as an extinction: exp(-τ) with that integral τ
    Transmittance,
    /// The part that does not come through, 1 - exp(-τ) without cancellation
    Opacity,
    /// The whole picture
    Scene,
}

/// Writes the shader.
pub(super) fn run(arguments: &EmitArguments, console: &Console) -> Result<(), Failure> {
    let path = arguments
        .output
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from("-"));
    if arguments.target == Language::Spirv && path == Path::new("-") && io::stdout().is_terminal() {
        return Err(Failure::usage_hint(
            "SPIR-V is binary, and the standard output is a terminal",
            "name a file with -o",
        ));
    }
    let source = Source::open(&arguments.input, console)?.with_rewrites(arguments.rules);
    let target = match arguments.target {
        Language::Wgsl => Target::Wgsl,
        Language::Glsl => Target::Glsl,
        Language::Hlsl => Target::Hlsl,
        Language::Msl => Target::Msl,
        Language::Spirv => Target::Spirv,
    };
    let what = match arguments.what {
        Part::Value => EmitWhat::Value,
        Part::Gradient => EmitWhat::Gradient,
        Part::Derivative => EmitWhat::Derivative,
        Part::Integral => EmitWhat::Integral,
        Part::Transmittance => EmitWhat::Transmittance,
        Part::Opacity => EmitWhat::Opacity,
        Part::Scene => EmitWhat::Scene,
    };
    let index = source.picture(arguments.which, console)?;
    let precision = arguments
        .numbers
        .without_view(&source.program.pictures()[index].settings)?;
    let made = source.program.emit(index, what, target, precision);
    let code = source.expect(made, console)?;
    let shown = render::name(&path);
    AtomicFile::create(&path)
        .and_then(|mut file| {
            file.write_all(&code)?;
            file.commit()
        })
        .map_err(|error| Failure::Io { what: shown, error })
}
