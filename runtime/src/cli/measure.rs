//! `pullback measure`

mod chart;
mod html;
mod json;
mod numbers;
pub(super) mod summary;
mod table;

use std::ffi::{OsStr, OsString};
use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, ValueEnum};
use pullback_compiler::SettingValue;
use pullback_compiler::lower::Tier;
use pullback_runtime::measure::{self, Choice, Job, Report};
use pullback_runtime::render::MAX_SAMPLES;
use pullback_runtime::{AdapterChoice, Gpu, Size, atomic_file, fill_in_scale};

use super::failure::Failure;
use super::place::Computer;
use super::progress::Progress;
use super::render::{name, point, positive, size};
use super::subject::{Subject, Wanted};
use super::{
    Adapter, Assignment, Console, Input, Numbers, Rules, Settings, Which, mesh, overrides,
};

/// Arguments of `pullback measure`.
#[derive(Debug, Args)]
pub(super) struct MeasureArguments {
    /// A file (if it exists or ends in .pull), a formula, or - for the standard input; of several, a table with
    /// one line each. Before a formula that begins with a minus, write --
    #[arg(value_name = "FILE|FORMULA", required = true)]
    inputs: Vec<OsString>,
    /// A report with charts and pictures in one file that needs no other, .html; of several programs the table, .md, to
    /// which a run that was stopped adds what it lacks
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Seconds that a picture's choices may take in all, as far as single pictures allow
    #[arg(long, default_value = "60", value_name = "SECONDS", value_parser = positive)]
    budget: f64,
    /// Another choice to be measured, such as "steps=64 samples=3 precision=fast"; may be given often
    #[arg(long = "try", value_name = "NAME=VALUE …")]
    tries: Vec<String>,
    /// Width and height of the picture in pixels
    #[arg(long, default_value = "640x480", value_name = "WxH", value_parser = size)]
    size: Size,
    /// Supersamples per axis of a pixel of the default
    #[arg(long, default_value_t = 2, value_name = "N",
          value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES / 2)))]
    samples: u32,
    /// World coordinates of the centre
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    center: Option<[f64; 2]>,
    /// Height of the view in world units
    #[arg(long, value_name = "H", value_parser = positive, allow_hyphen_values = true)]
    height: Option<f64>,
    #[command(flatten)]
    settings: Settings,
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    device: Adapter,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    rules: Rules,
    /// How the findings are written
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    /// A table for people
    Text,
    /// For programs: one object
    Json,
}

/// What the outputs tell.
struct Findings<'a> {
    /// What was measured, and on what.
    title: &'a str,
    adapter: &'a str,
    size: Size,
    report: &'a Report,
}

/// Measures the choices of one picture, or of several.
pub(super) fn run(arguments: &MeasureArguments, console: &Console) -> Result<(), Failure> {
    if arguments.device.adapter == AdapterChoice::Named("reference".to_owned()) {
        return Err(Failure::usage_hint(
            "the f64 reference is what every choice is measured against",
            "leave --adapter out, or name the graphics adapter whose pictures are to be measured",
        ));
    }
    let gpu = super::open(&arguments.device.adapter, console)?;
    if let [input] = arguments.inputs.as_slice() {
        return one(arguments, input, &gpu, console);
    }
    if matches!(arguments.format, Format::Json) {
        return Err(Failure::usage_hint(
            "JSON is of one picture",
            "leave --format out, or measure one file at a time",
        ));
    }
    let head = summary::head(&gpu.adapter().to_string(), arguments.size);
    let mut table = summary::Table::open(head, arguments.output.as_deref())?;
    for input in &arguments.inputs {
        let label = summary::label(input);
        if table.has(&label) {
            console.note(&format!("{}: in the table", input.to_string_lossy()));
            continue;
        }
        let (_, report) = measured(arguments, input, &gpu, console)?;
        table.add(&summary::row(&label, &report))?;
    }
    Ok(())
}

/// The arguments by themselves.
#[derive(Debug, Parser)]
struct Alone {
    #[command(flatten)]
    arguments: MeasureArguments,
}

/// The line of a program's picture in a table of several, measured within so many seconds.
pub(super) fn line(
    label: &str,
    text: &str,
    size: Size,
    seconds: f64,
    gpu: &Gpu,
    console: &Console,
) -> Result<String, Failure> {
    let (size, seconds) = (
        format!("{}x{}", size.width, size.height),
        seconds.to_string(),
    );
    let words = ["measure", "--size", &size, "--budget", &seconds, "--", text];
    let alone = Alone::try_parse_from(words).map_err(|error| Failure::usage(error.to_string()))?;
    let (_, report) = measured(&alone.arguments, OsStr::new(text), gpu, console)?;
    Ok(summary::row(label, &report))
}

/// Measures one picture, and tells all that was found.
fn one(
    arguments: &MeasureArguments,
    input: &OsStr,
    gpu: &Gpu,
    console: &Console,
) -> Result<(), Failure> {
    let (title, report) = measured(arguments, input, gpu, console)?;
    let findings = Findings {
        title: &title,
        adapter: &gpu.adapter().to_string(),
        size: arguments.size,
        report: &report,
    };
    match arguments.format {
        Format::Text => table::tell(&findings),
        Format::Json => json::write(&findings),
    }
    .map_err(Failure::stdout)?;
    if let Some(path) = &arguments.output {
        let text = html::page(&findings).map_err(Failure::writing(&name(path)))?;
        atomic_file::write_text(path, &text).map_err(|error| Failure::Io {
            what: name(path),
            error,
        })?;
        console.note(&format!("{}: the report", name(path)));
    }
    Ok(())
}

/// The name of a program, and what its picture's choices cost and give.
fn measured(
    arguments: &MeasureArguments,
    input: &OsStr,
    gpu: &Gpu,
    console: &Console,
) -> Result<(String, Report), Failure> {
    let subject = Subject::open(
        &Wanted {
            input: &Input {
                input: input.to_owned(),
            },
            which: arguments.which,
            rules: arguments.rules,
            settings: &arguments.settings,
            center: arguments.center,
            height: arguments.height,
            size: arguments.size,
            samples: arguments.samples,
        },
        console,
    )?;
    let computer = Computer::Adapter(gpu.clone());
    let tier = subject.tier(arguments.numbers, &computer, console)?;
    let default = Choice {
        changes: Vec::new(),
        precision: tier.precision,
        settings: subject.settings.clone(),
        samples: arguments.samples,
    };
    let mut choices = measure::choices(subject.picture(), &default, &measure::tiers(gpu));
    for text in &arguments.tries {
        choices.push(tried(text, &default, arguments, &subject)?);
    }
    let scene = |settings: &[SettingValue], tier: Tier| made(&subject, arguments, settings, tier);
    // what is wrong with the program is told in its place before anything is measured
    subject.scene(tier, console)?;
    let job = Job {
        gpu,
        picture: subject.picture(),
        frame: subject.frame(&[]),
        choices: &choices,
        scene: &scene,
        budget: Duration::try_from_secs_f64(arguments.budget).unwrap_or(Duration::MAX / 4),
    };
    let mut progress = Progress::new(console);
    let report = measure::run(&job, &mut |_, done, total| progress.update(done, total));
    progress.finish();
    let report = report.map_err(Failure::writing("measurement"))?;
    Ok((subject.source.name.clone(), report))
}

/// The scene's shader for other settings; what is wrong in one line.
fn made(
    subject: &Subject,
    arguments: &MeasureArguments,
    settings: &[SettingValue],
    tier: Tier,
) -> Result<pullback_compiler::SceneModule, String> {
    let program = &subject.source.program;
    let mut scene = program
        .scene_module_with(subject.index, settings, tier)
        .map_err(|found| found.first().map_or(String::new(), |d| d.message.clone()))?;
    mesh::furnish(&mut scene, settings, arguments.settings.mesh.as_deref())
        .map_err(|_| "the mesh cannot be read".to_owned())?;
    Ok(scene)
}

/// A choice of the user's own.
fn tried(
    text: &str,
    default: &Choice,
    arguments: &MeasureArguments,
    subject: &Subject,
) -> Result<Choice, Failure> {
    let mut out = default.clone();
    let mut all: Vec<Assignment> = arguments.settings.set.clone();
    for word in text.split_whitespace() {
        out.changes.push(word.replacen('=', " = ", 1));
        if let Some(number) = word.strip_prefix("samples=") {
            out.samples = samples(number)?;
        } else if let Some(tier) = word.strip_prefix("precision=") {
            out.precision = precision(tier)?;
        } else {
            all.push(
                word.parse()
                    .map_err(|error| Failure::usage(format!("--try {text}: {error}")))?,
            );
        }
    }
    let (program, picture) = (&subject.source.program, subject.picture());
    let (params, mut settings) = overrides::for_picture(&all, program, picture)?;
    if params != subject.params {
        return Err(Failure::usage_hint(
            format!("--try {text}: a parameter changes what is shown"),
            "give it with --set, for all choices",
        ));
    }
    let frame = subject.frame(&[]);
    fill_in_scale(
        &mut settings,
        picture,
        &frame.view,
        frame.size,
        &params,
        frame.time,
    );
    out.settings = settings;
    Ok(out)
}

fn samples(text: &str) -> Result<u32, Failure> {
    let number = text
        .parse()
        .ok()
        .filter(|n| (1..=MAX_SAMPLES / 2).contains(n));
    number.ok_or_else(|| {
        Failure::usage(format!(
            "samples={text}: must be a whole number from 1 to {}",
            MAX_SAMPLES / 2
        ))
    })
}

fn precision(text: &str) -> Result<pullback_compiler::lower::Precision, Failure> {
    let tier = super::Tier::from_str(text, false)
        .ok()
        .and_then(super::Tier::precision);
    tier.ok_or_else(|| {
        Failure::usage(format!(
            "precision={text}: there are fast, accurate, extended and double"
        ))
    })
}
