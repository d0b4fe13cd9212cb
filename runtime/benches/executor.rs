//! Times of the gallery's pictures on the processor, beside the software adapter's for the same pictures in the same run,
//! with the memory that each core needs, the most that the process took, and how much the pictures differ.
//!
//! `cargo bench --workspace --bench executor -- [--size N] [--samples N] [--only NAME,NAME] [--alone] [--write]`
//!
//! `--only` measures the pictures in whose names one of these is, `--alone` leaves the adapter out, and `--write` puts the table
//! of a whole run into `docs/executor.md`. Where the system tells it, the time is that of the processor divided by the cores, which
//! other work on the machine does not lengthen; else that of the clock.

use std::path::Path;
use std::process::ExitCode;
use std::sync::OnceLock;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use pullback_compiler::lower::Precision;
use pullback_compiler::scene::Space;
use pullback_compiler::{Picture, Program, SceneModule, SettingValue, compile};
use pullback_runtime::executor::{Arithmetic, Painter};
use pullback_runtime::{AdapterChoice, Frame, Gpu, Pipeline, Renderer, Size, View, fill_in_scale};

struct Options {
    side: u32,
    samples: u32,
    only: Vec<String>,
    alone: bool,
    write: bool,
}

impl Options {
    fn read() -> Result<Self, String> {
        let mut options = Self {
            side: 512,
            samples: 1,
            only: Vec::new(),
            alone: false,
            write: false,
        };
        let mut arguments = std::env::args().skip(1);
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
            let number = |text: String| {
                text.parse::<u32>()
                    .map_err(|_| format!("{text} is no number"))
            };
            match argument.as_str() {
                "--size" => options.side = number(value()?)?,
                "--samples" => options.samples = number(value()?)?,
                "--only" => options.only.extend(value()?.split(',').map(str::to_owned)),
                "--alone" => options.alone = true,
                "--write" => options.write = true,
                // from cargo
                "--bench" => {}
                other => return Err(format!("unknown argument {other}")),
            }
        }
        let whole = options.only.is_empty() && !options.alone;
        if options.write && !(whole && (options.side, options.samples) == (512, 1)) {
            return Err("--write is for whole runs".to_owned());
        }
        Ok(options)
    }

    /// Whether a picture is asked for.
    fn wants(&self, name: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|part| name.contains(part))
    }
}

/// The head of the table, as `docs/executor.md` has it.
const HEAD: &str = "| Picture | `reference` | `ieee32` | software adapter | KiB a core | \
    pixels off by more than 2 of 255: `reference`, `ieee32` |";
const RULE: &str = "| --- | --- | --- | --- | --- | --- |";

fn main() -> ExitCode {
    match Options::read().and_then(|options| run(&options)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), String> {
    let gpu = (!options.alone)
        .then(|| Gpu::open(&AdapterChoice::Software).map_err(|e| e.to_string()))
        .transpose()?;
    if let Some(gpu) = &gpu {
        println!("adapter: {}", gpu.adapter());
    }
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    println!(
        "{0}x{0}, {1} samples a pixel, {cores} cores\n",
        options.side,
        options.samples * options.samples
    );
    println!("{HEAD}\n{RULE}");
    let mut table = format!("{HEAD}\n{RULE}\n");
    let mut slowest = (0.0, String::new());
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/gallery");
    let entries = std::fs::read_dir(&folder).map_err(|e| e.to_string())?;
    let mut files: Vec<_> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    files.sort();
    for file in files
        .iter()
        .filter(|f| f.extension().is_some_and(|e| e == "pull"))
    {
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        if !options.wants(&name) {
            continue;
        }
        let text = std::fs::read_to_string(file).map_err(|e| e.to_string())?;
        let program = compile(&text).program.ok_or(format!("{name} has errors"))?;
        let (seconds, row) = row(&program, options, gpu.as_ref())?;
        println!("| {name} {row} |");
        table += &format!("| {name} {row} |\n");
        if seconds > slowest.0 {
            slowest = (seconds, name.into_owned());
        }
    }
    println!(
        "\nslowest in `reference`: {}, {:.2} s",
        slowest.1, slowest.0
    );
    if options.write {
        write(&table)?;
    }
    if let Some(kib) = most_memory() {
        println!("\nmost memory of the whole run: {} MiB", kib / 1024);
    }
    Ok(())
}

/// Puts the table in the place of that of `docs/executor.md`.
fn write(table: &str) -> Result<(), String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/executor.md");
    let text = std::fs::read_to_string(&path).map_err(|e| e.to_string())?;
    let start = text
        .find(HEAD)
        .ok_or("docs/executor.md has no such table")?;
    let end = text[start..].find("\n\n").ok_or("the table has no end")? + start + 1;
    let text = format!("{}{table}{}", &text[..start], &text[end..]);
    std::fs::write(&path, text).map_err(|e| e.to_string())
}

/// The greatest resident memory of this process in KiB, from Linux.
fn most_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// Seconds in `reference`, and the columns.
fn row(program: &Program, options: &Options, gpu: Option<&Gpu>) -> Result<(f64, String), String> {
    let picture = &program.pictures()[0];
    let side = options.side;
    let size = Size {
        width: side,
        height: side,
    };
    let params: Vec<f64> = program.params().iter().map(|p| p.default).collect();
    let view = view(picture);
    let mut settings = picture.settings.clone();
    fill_in_scale(&mut settings, picture, &view, size, &params, 0.0);
    let frame = Frame {
        view,
        params: &params,
        settings: &[],
        size,
        samples: options.samples,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let scene = |precision| {
        program
            .scene_module(0, precision)
            .map_err(|e| format!("{e:?}"))
    };
    let (double, single) = (scene(Precision::Double)?, scene(Precision::Accurate)?);
    let reference = paint(&double, Arithmetic::Reference, &frame, &settings)?;
    let ieee = paint(&single, Arithmetic::Ieee32, &frame, &settings)?;
    let adapter = match gpu {
        Some(gpu) => {
            let bytes = single.pack_settings(&settings);
            let frame = Frame {
                settings: &bytes,
                ..frame
            };
            let mut renderer = Renderer::new(gpu, &single).map_err(|e| e.to_string())?;
            let mut pixels = Vec::new();
            // the first run compiles
            renderer
                .render(&frame, &mut pixels)
                .map_err(|e| e.to_string())?;
            pixels.clear();
            let start = seconds();
            renderer
                .render(&frame, &mut pixels)
                .map_err(|e| e.to_string())?;
            Some((seconds() - start, pixels))
        }
        None => None,
    };
    let off = adapter.as_ref().map_or(String::new(), |(_, pixels)| {
        format!(
            "{}, {}",
            different(&reference.1, pixels),
            different(&ieee.1, pixels)
        )
    });
    let columns = format!(
        "| {:.2} s | {:.2} s | {} | {} | {off}",
        reference.0,
        ieee.0,
        adapter.map_or(String::new(), |(seconds, _)| format!("{seconds:.2} s")),
        reference.2 / 1024,
    );
    Ok((reference.0, columns))
}

/// Seconds that this process has kept each core busy, in the mean; or those of the clock.
fn seconds() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    let clock = START.get_or_init(Instant::now).elapsed().as_secs_f64();
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    processor_seconds().map_or(clock, |busy| busy / cores as f64)
}

/// Time in user and system mode, from Linux, which counts it in hundredths.
fn processor_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    let (_, fields) = text.rsplit_once(')')?;
    let mut times = fields.split_whitespace().skip(11);
    let mut next = || times.next()?.parse::<f64>().ok();
    Some((next()? + next()?) / 100.0)
}

fn paint(
    scene: &SceneModule,
    arithmetic: Arithmetic,
    frame: &Frame,
    settings: &[SettingValue],
) -> Result<(f64, Vec<u8>, usize), String> {
    let painter = Painter::new(scene, arithmetic, Pipeline::Compute).map_err(|e| e.to_string())?;
    let mut pixels = Vec::new();
    let start = seconds();
    let never = AtomicBool::new(false);
    let drawn = painter.render(frame, settings, &never, &mut pixels);
    drawn.map_err(|e| e.to_string())?;
    Ok((seconds() - start, pixels, painter.bytes()))
}

/// Pixels of which a channel differs by more than 2.
fn different(a: &[u8], b: &[u8]) -> usize {
    let pixels = a.chunks_exact(4).zip(b.chunks_exact(4));
    pixels
        .filter(|(a, b)| a.iter().zip(*b).any(|(x, y)| x.abs_diff(*y) > 2))
        .count()
}

fn view(picture: &Picture) -> View {
    if picture.scene.space == Space::Space {
        return View {
            center: [0.0, 0.0],
            height: 2.0,
        };
    }
    let center = picture.setting("center").unwrap_or_default();
    View {
        center: [center.x, center.y],
        height: picture.setting("height").map_or(2.0, |height| height.x),
    }
}
