//! `pullback accuracy`

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use pullback_compiler::lower::Precision;
use pullback_compiler::table;
use pullback_runtime::accuracy::report::{self, Style};
use pullback_runtime::accuracy::subjects::{Subject, subjects};
use pullback_runtime::accuracy::survey::{Plan, Survey, survey};
use pullback_runtime::{Error, Gpu, atomic_file};

use super::failure::Failure;
use super::progress::Progress;
use super::{Adapter, Console, open, spelling};

pub(super) const EXIT_CODES: &str = "\
Exit codes:
  0  every declared bound holds
  1  a declared bound does not hold on this adapter
  2  the command line is wrong
  3  no graphics device, or it failed
  4  a file or stream could not be written";

/// Arguments of `pullback accuracy`.
#[derive(Debug, Args)]
pub(super) struct AccuracyArguments {
    /// Names of functions, as `pullback functions` lists them; all if none is given
    #[arg(value_name = "FUNCTION")]
    functions: Vec<String>,
    /// Tiers, separated by commas [default: every tier that the adapter has]
    #[arg(long, value_enum, value_delimiter = ',')]
    precision: Vec<Judged>,
    #[command(flatten)]
    device: Adapter,
    /// How the table is written
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// The file for the table; - is the standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
    /// A file for a chart of all errors
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Fewer points and shorter timings
    #[arg(long)]
    quick: bool,
    /// How many functions are compiled at once [default: the processor's cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=64))]
    threads: Option<u16>,
}

/// What can be judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Judged {
    /// The functions of the graphics driver
    Fast,
    /// Our functions in single precision
    Accurate,
    /// Our functions on pairs of single-precision numbers
    Extended,
    /// Our functions in double precision
    Double,
    /// The evaluator of this program, in double precision on the processor
    Reference,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    /// Columns
    Text,
    /// A table of Markdown
    Markdown,
    /// For programs
    Json,
}

impl Judged {
    fn tier(self) -> Option<Precision> {
        match self {
            Self::Fast => Some(Precision::Fast),
            Self::Accurate => Some(Precision::Accurate),
            Self::Extended => Some(Precision::Extended),
            Self::Double => Some(Precision::Double),
            Self::Reference => None,
        }
    }
}

/// Measures, and writes what was found.
pub(super) fn run(arguments: &AccuracyArguments, console: &Console) -> Result<(), Failure> {
    let all = subjects().map_err(damaged)?;
    let subjects = chosen(all, &arguments.functions)?;
    let asked = &arguments.precision;
    let on_cpu = !asked.is_empty() && asked.iter().all(|judged| *judged == Judged::Reference);
    let gpus = if on_cpu {
        Vec::new()
    } else {
        devices(arguments, console)?
    };
    let plan = Plan {
        subjects,
        tiers: tiers(asked, gpus.first(), console)?,
        quick: arguments.quick,
    };
    let mut progress = Progress::new(console);
    let found = survey(&gpus, &plan, &mut |done, total| {
        progress.update(done as u64, total as u64);
    })?;
    progress.finish();
    write(arguments, &found)?;
    match found.exceptions.len() {
        0 => Ok(()),
        n => {
            let s = if n == 1 { "" } else { "s" };
            console.error(&format!("{n} exception{s} to the declared bounds"));
            Err(Failure::Program)
        }
    }
}

/// The adapter opened once for each thread: devices have compilers of their own.
fn devices(arguments: &AccuracyArguments, console: &Console) -> Result<Vec<Gpu>, Failure> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = arguments.threads.map_or(cores.min(16), usize::from);
    let mut gpus = vec![open(&arguments.device.adapter, console)?];
    while gpus.len() < threads {
        gpus.push(Gpu::open(&arguments.device.adapter)?);
    }
    Ok(gpus)
}

/// The tiers that are asked for, each once.
fn tiers(
    asked: &[Judged],
    gpu: Option<&Gpu>,
    console: &Console,
) -> Result<Vec<Option<Precision>>, Failure> {
    let mut tiers: Vec<Option<Precision>> = Vec::new();
    for judged in asked {
        if let (Some(tier), Some(gpu)) = (judged.tier(), gpu) {
            super::tier(gpu, tier)?;
        }
        if !tiers.contains(&judged.tier()) {
            tiers.push(judged.tier());
        }
    }
    if let (true, Some(gpu)) = (asked.is_empty(), gpu) {
        let (has, lacks): (Vec<_>, Vec<_>) = Precision::ALL.into_iter().partition(|t| gpu.has(*t));
        for tier in lacks {
            console.note(&format!("this adapter does not have `{}`", tier.name()));
        }
        tiers = has.into_iter().map(Some).collect();
    }
    Ok(tiers)
}

/// The functions with these names; all where there are none.
fn chosen(all: Vec<Subject>, names: &[String]) -> Result<Vec<Subject>, Failure> {
    if names.is_empty() {
        return Ok(all);
    }
    let fits = |subject: &Subject, name: &str| {
        subject.word == name || subject.row.names.contains(&name) || subject.row.sign() == name
    };
    for name in names {
        if !all.iter().any(|subject| fits(subject, name)) {
            let known = all.iter().map(|subject| subject.word);
            let hint = match spelling::nearest(name, known) {
                Some(nearest) => format!("did you mean `{nearest}`?"),
                None => "`pullback functions` lists the functions".to_owned(),
            };
            let elsewhere = table::by_name(name).is_some();
            let reason = if elsewhere {
                format!("`{name}` has no references of its own")
            } else {
                format!("there is no function `{name}`")
            };
            return Err(Failure::usage_hint(reason, hint));
        }
    }
    let kept = |subject: &Subject| names.iter().any(|name| fits(subject, name));
    Ok(all.into_iter().filter(kept).collect())
}

fn write(arguments: &AccuracyArguments, found: &Survey) -> Result<(), Failure> {
    let text = match arguments.format {
        Format::Text => report::text(found, Style::Text),
        Format::Markdown => report::text(found, Style::Markdown),
        Format::Json => report::json(found).map_err(|error| damaged(error.to_string()))?,
    };
    put(&arguments.output, &text)?;
    match &arguments.svg {
        Some(path) => put(path, &report::svg(found)),
        None => Ok(()),
    }
}

fn put(path: &Path, text: &str) -> Result<(), Failure> {
    let what = if path == Path::new("-") {
        "standard output".to_owned()
    } else {
        path.to_string_lossy().into_owned()
    };
    atomic_file::write_text(path, text).map_err(|error| Failure::Io { what, error })
}

fn damaged(reason: String) -> Failure {
    Failure::Device(Error::Invalid { reason })
}
