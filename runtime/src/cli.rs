//! Arguments, and what each command does.

mod accuracy;
mod animate;
mod bench;
mod check;
mod console;
mod diff;
mod doctor;
mod emit;
mod eval;
mod explain;
mod failure;
mod fmt;
mod functions;
mod gallery;
mod json;
mod measure;
mod mesh;
mod overrides;
mod place;
mod probe;
mod progress;
mod render;
mod scenes;
mod source;
mod spelling;
mod subject;

use std::ffi::OsString;
use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};
use pullback_compiler::SettingValue;
use pullback_compiler::lower::{self, Precision};
use pullback_compiler::stable::{RULES, Rewrites};
use pullback_runtime::{AdapterChoice, Capabilities, Gpu};

pub(crate) use console::Console;
use failure::Failure;
use overrides::Assignment;
use place::Place;

const EXIT_CODES: &str = "\
Exit codes:
  0  success
  1  the formula or program has errors
  2  the command line is wrong
  3  no graphics device, or it failed
  4  a file or stream could not be read or written";

/// From a formula to its picture, its derivatives and its shaders.
#[derive(Debug, Parser)]
#[command(name = "pullback", version, after_help = EXIT_CODES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Print nothing on the standard error but errors and warnings
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Draw the picture of a formula
    #[command(after_help = EXIT_CODES)]
    Render(render::RenderArguments),
    /// Write the shader of a formula in a language of your choice
    #[command(after_help = EXIT_CODES)]
    Emit(emit::EmitArguments),
    /// Look for errors
    #[command(after_help = EXIT_CODES)]
    Check(check::CheckArguments),
    /// Set programs in the canonical format
    #[command(after_help = EXIT_CODES)]
    Fmt(fmt::FmtArguments),
    /// Show a formula as it is compiled, and which rewrites keep it from losing digits
    #[command(after_help = EXIT_CODES)]
    Explain(explain::ExplainArguments),
    /// Evaluate a formula at points
    #[command(after_help = EXIT_CODES)]
    Eval(eval::EvalArguments),
    /// Draw many programs on one sheet
    #[command(after_help = EXIT_CODES)]
    Gallery(gallery::GalleryArguments),
    /// Compare two pictures, in numbers and to the eye
    #[command(after_help = diff::EXIT_CODES)]
    Diff(diff::DiffArguments),
    /// Measure what each choice between speed and accuracy costs and gives, for one picture
    #[command(after_help = EXIT_CODES)]
    Measure(measure::MeasureArguments),
    /// Time programs from their text to their picture, and compare with an earlier run
    #[command(after_help = EXIT_CODES)]
    Bench(bench::BenchArguments),
    /// Show what is computed on the way to a pixel, and where machines part
    #[command(after_help = EXIT_CODES)]
    Probe(probe::ProbeArguments),
    /// Say what this machine offers and what is missing
    #[command(after_help = EXIT_CODES)]
    Doctor(doctor::DoctorArguments),
    /// Measure how accurate every function is on this machine, and what it costs
    #[command(after_help = accuracy::EXIT_CODES)]
    Accuracy(accuracy::AccuracyArguments),
    /// List the functions of the language
    Functions(functions::FunctionsArguments),
    /// List the scenes with their settings
    Scenes(scenes::ScenesArguments),
}

/// What to work on.
#[derive(Debug, Args)]
struct Input {
    /// A file (if it exists or ends in .pull), a formula, or - for the standard input
    // So that `-x^2` is a formula.
    #[arg(value_name = "FILE|FORMULA", allow_hyphen_values = true)]
    input: OsString,
}

/// Which of the program's pictures, whose formula it is about.
#[derive(Clone, Copy, Debug, Args)]
struct Which {
    /// Which `show` of the program is meant, from 1
    #[arg(long, value_name = "N")]
    show: Option<usize>,
}

/// Values for the names of a program.
#[derive(Debug, Args)]
struct Settings {
    /// Give a parameter or a setting of the scene a value; numbers of a vector are separated by commas
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true)]
    set: Vec<Assignment>,
    /// The animation clock in seconds
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    time: f64,
    /// The solid of a scene with `shape = mesh`: a closed mesh in an .obj, .gltf or .glb file
    #[arg(long, value_name = "FILE")]
    mesh: Option<PathBuf>,
}

/// Where to compute.
#[derive(Debug, Args)]
struct Device {
    /// The graphics adapter: auto, gpu, software, or a part of its name; or the processor: reference (f64), ieee32 (exact
    /// single precision)
    #[arg(long, default_value = "auto", value_name = "NAME")]
    adapter: Place,
}

/// Which graphics adapter to use.
#[derive(Debug, Args)]
struct Adapter {
    /// The graphics adapter: auto, gpu, software, or a part of its name
    #[arg(long, default_value = "auto", value_name = "NAME")]
    adapter: AdapterChoice,
}

/// Where a result goes.
#[derive(Debug, Args)]
struct Output {
    /// The file to write; - is the standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// How numbers are computed in shaders.
#[derive(Clone, Copy, Debug, Args)]
struct Numbers {
    /// How numbers are computed in the shader [default: the program's setting `precision`, else accurate]
    #[arg(long, value_enum)]
    precision: Option<Tier>,
}

/// Which stability rewrites are done.
#[derive(Clone, Copy, Debug, Args)]
struct Rules {
    /// Rewrites that keep digits: on, off, or names with commas between; -NAME is all but that one (docs/rewrites.md)
    #[arg(long, default_value = "on", value_name = "on|off|NAME,…", value_parser = rewrites,
          allow_hyphen_values = true)]
    rewrites: Rewrites,
}

fn rewrites(text: &str) -> Result<Rewrites, String> {
    Rewrites::parse(text).map_err(|word| {
        let names = RULES.iter().map(|rule| rule.name);
        let mut message = format!("there is no rewrite `{word}`");
        if let Some(nearest) = spelling::nearest(word.trim_start_matches('-'), names) {
            message += &format!("; did you mean `{nearest}`?");
        }
        message
    })
}

/// A tier, or the choice of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Tier {
    /// Single precision with the functions of the graphics driver, of any error
    Fast,
    /// Single precision with our own functions, of declared error
    Accurate,
    /// Pairs of single-precision numbers: about 14 digits on every adapter
    Extended,
    /// Double precision, on adapters that have it
    Double,
    /// The cheapest of these whose error cannot be seen in the picture
    Auto,
}

impl Tier {
    /// The tier itself; none for the choice of one.
    fn precision(self) -> Option<Precision> {
        match self {
            Self::Fast => Some(Precision::Fast),
            Self::Accurate => Some(Precision::Accurate),
            Self::Extended => Some(Precision::Extended),
            Self::Double => Some(Precision::Double),
            Self::Auto => None,
        }
    }
}

impl Numbers {
    /// The tier for a picture with these settings: what the command line says, else the program. None for the choice
    /// of one.
    fn wanted(self, settings: &[SettingValue]) -> Option<Precision> {
        match self.precision {
            Some(tier) => tier.precision(),
            None => set_precision(settings),
        }
    }

    /// The tier where there is no view that a choice could be made for.
    fn without_view(self, settings: &[SettingValue]) -> Result<Precision, Failure> {
        self.wanted(settings).ok_or_else(|| {
            Failure::usage_hint(
                "`auto` chooses the precision for a picture, and there is none here",
                "give --precision accurate, or another",
            )
        })
    }
}

/// The tier that the settings name.
fn set_precision(settings: &[SettingValue]) -> Option<Precision> {
    let Some(setting) = settings.iter().find(|s| s.spec.name == "precision") else {
        return Some(Precision::default());
    };
    let word = setting.word()?;
    Precision::ALL.into_iter().find(|p| p.name() == word)
}

/// Opens the adapter, and says which it is.
fn open(choice: &AdapterChoice, console: &Console) -> Result<Gpu, Failure> {
    let gpu = Gpu::open(choice)?;
    console.note(&format!("adapter: {}", gpu.adapter()));
    Ok(gpu)
}

/// What numbers of a precision are computed with here.
fn tier(gpu: &Gpu, precision: Precision) -> Result<lower::Tier, Failure> {
    if !gpu.has(precision) {
        return Err(Failure::usage_hint(
            format!("{} has no double precision", gpu.adapter().name),
            "--precision extended runs on every adapter",
        ));
    }
    Ok(Capabilities::tier(gpu, precision)?)
}

impl Arguments {
    /// Reads the process's arguments; tells what is wrong with them and exits if they cannot be read.
    pub(crate) fn read() -> Self {
        let arguments: Vec<OsString> = std::env::args_os().collect();
        let mut command = Self::command();
        // A formula may begin with a hyphen, so clap would take a misspelt option for one.
        if let Some(message) = unknown_option(&command, &arguments) {
            command.error(ErrorKind::UnknownArgument, message).exit();
        }
        Self::parse_from(arguments)
    }
}

/// What is wrong with the first `--option` that no command knows, if there is one.
fn unknown_option(command: &clap::Command, arguments: &[OsString]) -> Option<String> {
    let commands = command.get_subcommands().chain([command]);
    let mut known: Vec<&str> = commands
        .flat_map(clap::Command::get_arguments)
        .filter_map(clap::Arg::get_long)
        .collect();
    known.extend(["help", "version"]);
    let unknown = arguments
        .iter()
        .skip(1)
        .map(|argument| argument.to_string_lossy())
        .take_while(|argument| argument != "--")
        .find_map(|argument| {
            let name = argument.strip_prefix("--")?.split('=').next()?.to_owned();
            (!known.contains(&name.as_str())).then_some(name)
        })?;
    let mut message = format!("unexpected argument '--{unknown}' found");
    if let Some(nearest) = spelling::nearest(&unknown, known) {
        message += &format!("\n\n  tip: a similar argument exists: '--{nearest}'");
    }
    Some(message)
}

/// Runs the command; returns the exit code.
pub(crate) fn run(arguments: Arguments, console: &Console) -> u8 {
    let done = match arguments.command {
        Command::Render(arguments) => render::run(&arguments, console),
        Command::Emit(arguments) => emit::run(&arguments, console),
        Command::Check(arguments) => check::run(&arguments, console),
        Command::Fmt(arguments) => fmt::run(&arguments, console),
        Command::Explain(arguments) => explain::run(&arguments, console),
        Command::Eval(arguments) => eval::run(&arguments, console),
        Command::Gallery(arguments) => gallery::run(&arguments, console),
        Command::Diff(arguments) => diff::run(&arguments, console),
        Command::Measure(arguments) => measure::run(&arguments, console),
        Command::Bench(arguments) => bench::run(&arguments, console),
        Command::Probe(arguments) => probe::run(&arguments, console),
        Command::Doctor(arguments) => doctor::run(&arguments, console),
        Command::Accuracy(arguments) => accuracy::run(&arguments, console),
        Command::Functions(arguments) => functions::run(&arguments),
        Command::Scenes(arguments) => scenes::run(&arguments),
    };
    match done {
        Ok(()) => 0,
        Err(failure) => failure.report(console),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(line: &str) -> Result<Arguments, clap::Error> {
        Arguments::try_parse_from(line.split(' '))
    }

    #[test]
    fn the_definition_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn a_formula_may_begin_with_a_hyphen() {
        let check = |line: &str, expected: &str| {
            let Command::Render(read) = parse(line).unwrap().command else {
                panic!("{line}");
            };
            assert_eq!(read.input.input, expected, "{line}");
        };
        check("pullback render -x^2 -o a.png", "-x^2");
        check("pullback render -o a.png -x^2", "-x^2");
        check("pullback render --center -1,-2 -x", "-x");
        check("pullback render -", "-");
        check("pullback render -- --x", "--x");
    }

    #[test]
    fn misspelt_options() {
        let check = |line: &str, expected: Option<&str>| {
            let arguments: Vec<OsString> = line.split(' ').map(OsString::from).collect();
            let found = unknown_option(&Arguments::command(), &arguments);
            assert_eq!(found.is_some(), expected.is_some(), "{line}");
            if let (Some(found), Some(expected)) = (found, expected) {
                assert!(found.contains(expected), "{found}");
            }
        };
        check("pullback render --sixe 3 x", Some("'--size'"));
        check("pullback render --size=3x3 x --set k=1", None);
        check("pullback --help", None);
        check("pullback eval x --zzzzzz=1", Some("--zzzzzz"));
        check("pullback eval -- --x", None);
    }
}
