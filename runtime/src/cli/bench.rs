//! `pullback bench`: what programs cost, from their text to their picture, and whether that has changed.

mod base;
mod compared;
mod dots;
mod instructions;
mod large;
mod parts;
mod peers;
mod programs;
mod report;
mod table;
mod tables;
mod tiers;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use pullback_compiler::lower::Precision;
use pullback_runtime::bench::{STAGES, calibration, stages};
use pullback_runtime::{Capabilities, Gpu, Renderer, Size, atomic_file};

use super::failure::Failure;
use super::progress::Progress;
use super::render::{name, positive, size};
use super::subject::Subject;
use super::{Adapter, Console, gallery};
use base::{Case, Run};

/// Turns at most, and at least.
const TURNS: usize = 25;
const FEWEST: usize = 8;
/// Shortest submission that is timed by a device, in seconds.
const LONG: f64 = 2e-3;

/// Arguments of `pullback bench`.
#[derive(Debug, Args)]
pub(super) struct BenchArguments {
    /// Programs, and folders of them; without any, the examples that this program carries
    #[arg(value_name = "FOLDER|FILE")]
    inputs: Vec<PathBuf>,
    /// Seconds that all turns may take
    #[arg(long, default_value = "60", value_name = "SECONDS", value_parser = positive)]
    budget: f64,
    /// Width and height of the pictures in pixels, one sample each
    #[arg(long, default_value = "640x480", value_name = "WxH", value_parser = size)]
    size: Size,
    /// The compiler alone, without an adapter
    #[arg(long)]
    no_pictures: bool,
    /// Count the compiler's instructions for each program, too: by perf, or else by valgrind, which takes seconds for each
    #[arg(long, conflicts_with_all = ["tables", "peer"])]
    instructions: bool,
    #[command(flatten)]
    device: Adapter,
    /// The file for the times, to be compared with later, .json
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The times of an earlier run: says what is slower or faster beyond doubt
    #[arg(long, value_name = "FILE")]
    compare: Option<PathBuf>,
    /// With --compare, fail where something is slower by more than so many percent beyond doubt
    #[arg(long, value_name = "PERCENT", requires = "compare", value_parser = positive)]
    fail_above: Option<f64>,
    /// Write the tables of the documentation for this adapter, with their charts and all of them on one page, into a folder
    /// instead; what is there goes on where it ended
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["output", "compare", "no_pictures"])]
    tables: Option<PathBuf>,
    /// With --tables, only this one; may be given often [default: all]
    #[arg(long, value_enum, value_name = "TABLE", requires = "tables")]
    only: Vec<parts::Part>,
    /// Time other programs that derive, integrate and evaluate, where they are installed, beside this one; fidget is built by
    /// cargo in the folder for caches
    #[arg(long, conflicts_with_all = ["output", "compare", "tables"])]
    peer: bool,
    /// A model of the plane in the text format of fidget, .vm, that is drawn by both
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    /// Where the pictures that are drawn beside other programs are kept
    #[arg(long, value_name = "FOLDER", requires = "model")]
    pictures: Option<PathBuf>,
}

/// Times everything in turns.
pub(super) fn run(arguments: &BenchArguments, console: &Console) -> Result<(), Failure> {
    if let Some(folder) = &arguments.tables {
        return tables::run(arguments, folder, console);
    }
    if arguments.peer {
        return peers::run(arguments, console);
    }
    let base = arguments.compare.as_deref().map(Run::read).transpose()?;
    let subjects = gallery::subjects(&arguments.inputs, arguments.size, console)?;
    let gpu = if arguments.no_pictures {
        None
    } else {
        Some(super::open(&arguments.device.adapter, console)?)
    };
    let budget = Duration::try_from_secs_f64(arguments.budget).unwrap_or(Duration::MAX / 4);
    let texts: Vec<String> = subjects.iter().map(|s| s.source.text.clone()).collect();
    let mut run = timed(
        subjects,
        gpu.as_ref(),
        arguments.size,
        (budget, FEWEST),
        console,
    )?;
    if arguments.instructions {
        count(&mut run, &texts, console)?;
    }
    table::tell(&run).map_err(Failure::stdout)?;
    if let Some(path) = &arguments.output {
        atomic_file::write_text(path, &run.to_json()).map_err(|error| Failure::Io {
            what: name(path),
            error,
        })?;
        console.note(&format!(
            "{}: the times of {} turns",
            name(path),
            run.calibration.len()
        ));
    }
    let Some(base) = base else { return Ok(()) };
    let slower = table::compare(&base, &run, arguments.fail_above).map_err(Failure::stdout)?;
    if slower == 0 {
        return Ok(());
    }
    console.error(&format!(
        "{slower} times are greater by more than --fail-above"
    ));
    Err(Failure::Program)
}

/// Counts instructions for the texts of the programs of a run.
fn count(run: &mut Run, texts: &[String], console: &Console) -> Result<(), Failure> {
    let counter = instructions::Counter::new()?;
    console.note(&format!("instructions are counted by {}", counter.name()));
    let mut progress = Progress::new(console);
    let total = texts.len() as u64;
    for ((done, program), text) in (1..).zip(&mut run.pictures).zip(texts) {
        program.instructions = counter.count(text);
        progress.update(done, total);
    }
    progress.finish();
    Ok(())
}

/// Times programs in turns, until the budget is spent, but so many turns at least.
fn timed(
    subjects: Vec<Subject>,
    gpu: Option<&Gpu>,
    size: Size,
    (budget, fewest): (Duration, usize),
    console: &Console,
) -> Result<Run, Failure> {
    let mut benches: Vec<Bench> = Vec::new();
    for subject in subjects {
        benches.push(Bench::new(subject, gpu, console)?);
    }
    // tables that the compiler makes once are no part of what a program costs
    for bench in &mut benches {
        bench.turn()?;
    }
    let mut run = Run::new(gpu, size, &benches);
    let start = Instant::now();
    let mut progress = Progress::new(console);
    for turn in 0..TURNS {
        if turn >= fewest && start.elapsed() > budget {
            break;
        }
        run.calibration.push(calibration());
        for (k, bench) in benches.iter_mut().enumerate() {
            let done = (turn * run.pictures.len() + k) as u64;
            progress.update(done, (TURNS * run.pictures.len()) as u64);
            let times = bench.turn()?;
            run.pictures[k].add(times);
        }
    }
    progress.finish();
    run.memory(gpu);
    Ok(run)
}

/// A program that is timed.
struct Bench {
    subject: Subject,
    renderer: Option<Renderer>,
    /// Bytes of its settings.
    settings: Vec<u8>,
    /// Pictures of a submission.
    repeats: u32,
    by_device: bool,
}

impl Bench {
    fn new(subject: Subject, gpu: Option<&Gpu>, console: &Console) -> Result<Self, Failure> {
        let mut out = Self {
            settings: Vec::new(),
            renderer: None,
            repeats: 1,
            by_device: false,
            subject,
        };
        let Some(gpu) = gpu else { return Ok(out) };
        let tier = Capabilities::tier(gpu, Precision::Accurate)?;
        let scene = out.subject.scene(tier, console)?;
        out.settings = scene.pack_settings(&out.subject.settings);
        let mut renderer = Renderer::for_settings(gpu, &scene, &out.subject.settings, 1)?;
        let frame = out.subject.single(&out.settings);
        renderer.render(&frame, &mut Vec::new())?;
        if let Some(seconds) = renderer.device_time(&frame, 1)? {
            out.by_device = true;
            out.repeats = (LONG / seconds.max(1e-6)).ceil().clamp(1.0, 64.0) as u32;
        }
        out.renderer = Some(renderer);
        Ok(out)
    }

    /// Seconds of the stages, and of a picture.
    fn turn(&mut self) -> Result<Vec<f64>, Failure> {
        let settings = &self.subject.settings;
        let tier = Precision::Accurate.into();
        let mut times = stages(&self.subject.source.text, settings, tier)?.to_vec();
        if let Some(renderer) = &mut self.renderer {
            let frame = self.subject.single(&self.settings);
            let start = Instant::now();
            let by_device = match self.by_device {
                true => renderer.device_time(&frame, self.repeats)?,
                false => None,
            };
            times.push(match by_device {
                Some(seconds) => seconds,
                None => {
                    renderer.render(&frame, &mut Vec::new())?;
                    start.elapsed().as_secs_f64()
                }
            });
        }
        Ok(times)
    }
}

/// The names of a program's times.
fn names(with_picture: bool) -> Vec<&'static str> {
    let mut all = STAGES.to_vec();
    all.extend(with_picture.then_some("picture"));
    all
}

impl Run {
    fn new(gpu: Option<&Gpu>, size: Size, benches: &[Bench]) -> Self {
        let case = |name: &str| Case {
            name: name.to_owned(),
            seconds: Vec::new(),
        };
        let pictures = benches.iter().map(|bench| base::Program {
            name: bench.subject.source.stem.clone(),
            times: names(gpu.is_some()).into_iter().map(case).collect(),
            instructions: None,
        });
        Self {
            version: base::VERSION,
            adapter: gpu.map(|gpu| gpu.adapter().to_string()),
            width: size.width,
            height: size.height,
            calibration: Vec::new(),
            pictures: pictures.collect(),
            peak_host_bytes: None,
            device_bytes: None,
        }
    }

    /// Notes what memory was taken.
    fn memory(&mut self, gpu: Option<&Gpu>) {
        self.peak_host_bytes = peak_memory();
        let report = gpu.and_then(|gpu| gpu.device().generate_allocator_report());
        self.device_bytes = report.map(|report| report.total_reserved_bytes);
    }
}

/// The most memory that this process has had, where the system tells it.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}

fn mebibytes(bytes: u64) -> f64 {
    bytes as f64 / f64::from(1 << 20)
}
