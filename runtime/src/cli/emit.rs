//! `pullback emit`

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use pullback_compiler::lower::Precision;
use pullback_compiler::{Emission, EmitWhat, ParamsAs, Target};
use pullback_runtime::AtomicFile;
use pullback_runtime::validators::{Verdict, judge, judge_in_browser};

use super::failure::Failure;
use super::source::Source;
use super::{Console, Input, Numbers, Output, Rules, Which, render};

/// Arguments of `pullback emit`.
#[derive(Debug, Args)]
pub(super) struct EmitArguments {
    #[command(flatten)]
    input: Input,
    /// The language, or the program that the code is for
    #[arg(long, value_enum, default_value_t = Language::Wgsl)]
    target: Language,
    /// What to write: one or more, with commas between
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        default_value = "value",
        value_name = "WHAT,…"
    )]
    what: Vec<Part>,
    /// A name for the function, in the place of the formula's
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Other names for arguments and parameters
    #[arg(long, value_delimiter = ',', value_parser = renaming, value_name = "OLD=NEW,…")]
    rename: Vec<(String, String)>,
    /// How the functions get the program's parameters
    #[arg(long, value_enum, default_value_t = Parameters::Arguments)]
    params: Parameters,
    /// Write a scene for its settings and N samples per axis alone, which are then constants
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=16))]
    fixed: Option<u32>,
    /// Have the code judged by whichever compilers and validators are installed, and say which
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    rules: Rules,
    #[command(flatten)]
    output: Output,
}

fn renaming(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((from, to)) => Ok((from.trim().to_owned(), to.trim().to_owned())),
        None => Err(format!("`{text}` is not OLD=NEW")),
    }
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Language {
    /// WebGPU's language
    Wgsl,
    /// Functions for GLSL 3.30, GLSL ES 3.00 and later; a scene in GLSL 4.50
    Glsl,
    /// For DirectX, Unity, Unreal
    Hlsl,
    /// For Metal
    Msl,
    /// SPIR-V 1.3
    Spirv,
    /// C11
    C,
    /// WGSL to import with naga_oil, as in Bevy
    Bevy,
    /// An image shader for shadertoy.com
    Shadertoy,
    /// A shader for Godot 4
    Godot,
    /// A module with a GLSL chunk for three.js
    Three,
    /// A module with node functions for three.js on WebGPU
    Tsl,
}

impl Language {
    fn target(self) -> Target {
        match self {
            Self::Wgsl => Target::Wgsl,
            Self::Glsl => Target::Glsl,
            Self::Hlsl => Target::Hlsl,
            Self::Msl => Target::Msl,
            Self::Spirv => Target::Spirv,
            Self::C => Target::C,
            Self::Bevy => Target::Bevy,
            Self::Shadertoy => Target::Shadertoy,
            Self::Godot => Target::Godot,
            Self::Three => Target::Three,
            Self::Tsl => Target::Tsl,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Part {
    /// The function alone
    Value,
    /// The function with its gradient
    Gradient,
    /// The gradient alone
    Partials,
    /// The function with its derivative along a direction
    Directional,
    /// The function with its complex derivative
    Derivative,
    /// The function with its first and second derivatives
    Hessian,
    /// The integral of a function of space along a ray, from its origin and direction and both ends
    Integral,
    /// The same of a ray whose origin was moved, with what its numbers were rounded by
    ShiftedIntegral,
    /// The part of the light that comes through the function as an extinction: exp(-τ) with that integral τ
    Transmittance,
    /// The part that does not come through, 1 - exp(-τ) without cancellation
    Opacity,
    /// The whole picture
    Scene,
}

impl Part {
    fn what(self) -> EmitWhat {
        match self {
            Self::Value => EmitWhat::Value,
            Self::Gradient => EmitWhat::Gradient,
            Self::Partials => EmitWhat::Partials,
            Self::Directional => EmitWhat::Directional,
            Self::Derivative => EmitWhat::Derivative,
            Self::Hessian => EmitWhat::Hessian,
            Self::Integral => EmitWhat::Integral,
            Self::ShiftedIntegral => EmitWhat::ShiftedIntegral,
            Self::Transmittance => EmitWhat::Transmittance,
            Self::Opacity => EmitWhat::Opacity,
            Self::Scene => EmitWhat::Scene,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Parameters {
    /// As arguments behind the point
    Arguments,
    /// From a uniform; in MSL and C, a structure as the last argument
    Uniform,
    /// As constants, the parameters' values in the program
    Constants,
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
    let index = source.picture(arguments.which, console)?;
    let precision = arguments
        .numbers
        .without_view(&source.program.pictures()[index].settings)?;
    let emission = emission(arguments, &source, index, precision);
    let made = source.program.emit_all(&emission);
    let code = source.expect(made, console)?.bytes;
    if arguments.check {
        check(&code, &emission, console)?;
    }
    let shown = render::name(&path);
    AtomicFile::create(&path)
        .and_then(|mut file| {
            file.write_all(&code)?;
            file.commit()
        })
        .map_err(|error| Failure::Io { what: shown, error })
}

fn emission(
    arguments: &EmitArguments,
    source: &Source,
    picture: usize,
    precision: Precision,
) -> Emission {
    let mut parts = arguments.what.iter().map(|part| part.what());
    let first = parts.next().unwrap_or(EmitWhat::Value);
    let mut emission = Emission::new(first, arguments.target.target());
    for part in parts {
        emission = emission.and(part);
    }
    emission.picture = picture;
    emission.precision = precision;
    emission.params = match arguments.params {
        Parameters::Arguments => ParamsAs::Arguments,
        Parameters::Uniform => ParamsAs::Uniform,
        Parameters::Constants => ParamsAs::Constants,
    };
    emission.name.clone_from(&arguments.name);
    emission.renamed.clone_from(&arguments.rename);
    emission.fixed_samples = arguments.fixed;
    emission.quoting(&source.text, &command(arguments, &source.text))
}

/// The command that makes the file again.
fn command(arguments: &EmitArguments, text: &str) -> String {
    let input = arguments.input.input.to_string_lossy();
    let one_line = !text.trim().contains('\n');
    let mut words = vec!["pullback emit".to_owned()];
    words.push(match (&*input == text, one_line) {
        (true, true) => format!("'{input}'"),
        (true, false) => "PROGRAM".to_owned(),
        _ => input.into_owned(),
    });
    words.push(format!("--target {}", arguments.target.target().name()));
    let what: Vec<&str> = arguments.what.iter().map(|w| w.what().name()).collect();
    words.push(format!("--what {}", what.join(",")));
    if let Some(name) = &arguments.name {
        words.push(format!("--name {name}"));
    }
    if !arguments.rename.is_empty() {
        let pairs: Vec<String> = arguments
            .rename
            .iter()
            .map(|(a, b)| format!("{a}={b}"))
            .collect();
        words.push(format!("--rename {}", pairs.join(",")));
    }
    match arguments.params {
        Parameters::Arguments => {}
        Parameters::Uniform => words.push("--params uniform".to_owned()),
        Parameters::Constants => words.push("--params constants".to_owned()),
    }
    words.join(" ")
}

/// Has the code judged; fails where someone rejects it.
fn check(code: &[u8], emission: &Emission, console: &Console) -> Result<(), Failure> {
    let mut judgements = judge(code, emission.target, &emission.parts);
    judgements.extend(judge_in_browser(code, emission.target, &emission.parts));
    if judgements.is_empty() {
        console.note(&format!(
            "check: there is no judge here for `{}`",
            emission.target.name()
        ));
    }
    let mut rejected = false;
    for judgement in judgements {
        match judgement.verdict {
            Verdict::Accepted => console.note(&format!("check: accepted by {}", judgement.judge)),
            Verdict::Absent => console.note(&format!("check: not installed: {}", judgement.judge)),
            Verdict::Rejected(why) => {
                rejected = true;
                console.error(&format!("rejected by {}", judgement.judge));
                console.hint(why.trim_end());
            }
        }
    }
    if rejected {
        return Err(Failure::Program);
    }
    Ok(())
}
