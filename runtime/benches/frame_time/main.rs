//! Frame time of compiled scenes against hand-written twins of the same pictures, in one run: the twin has the same
//! template, but its functions are written by hand with built-in functions, and its derivatives are finite
//! differences.
//!
//! `cargo bench -p pullback-runtime --bench frame_time -- [--adapter NAME] [--size WxH] [--samples N]
//! [--only NAME] [--pictures FOLDER] [--markdown]`
//!
//! The executable carries all that it needs. Shaders take turns, frame by frame. Times are medians; ratios are medians
//! of the ratios in each turn, so that other work on the machine counts little. On hardware the device's timestamps are
//! read, on software adapters the clock of the machine.

mod cases;
mod compare;
mod stage;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use pullback_compiler::lower::Tier;
use pullback_runtime::image_file::{Metadata, write_png};
use pullback_runtime::{AdapterChoice, Error, Gpu, Pipeline, Size};

use cases::{CASES, Case, Prepared, TWIN};
use compare::Difference;
use stage::{Canvas, Stage};

const PIPELINES: [(Pipeline, &str); 2] = [
    (Pipeline::Compute, "compute"),
    (Pipeline::Fragment, "fragment"),
];

/// A timed submission on hardware should take this long at least, so that a clock's tick and a launch do not count.
const SHORTEST: f64 = 2e-3;
/// Before it counts, every pipeline draws for this long, so that the device is at its working clock.
const WARM_UP: Duration = Duration::from_millis(150);

#[derive(Debug)]
struct Options {
    adapter: AdapterChoice,
    size: [u32; 2],
    samples: usize,
    only: Option<String>,
    pictures: Option<PathBuf>,
    markdown: bool,
}

impl Options {
    fn read() -> Result<Self, String> {
        let mut options = Self {
            adapter: AdapterChoice::Auto,
            size: [1280, 720],
            samples: 15,
            only: None,
            pictures: None,
            markdown: false,
        };
        let mut arguments = std::env::args().skip(1);
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
            match argument.as_str() {
                "--adapter" => match value()?.parse() {
                    Ok(choice) => options.adapter = choice,
                    Err(never) => match never {},
                },
                "--size" => options.size = size(&value()?).ok_or("a size is like 1280x720")?,
                "--samples" => {
                    options.samples = value()?.parse().map_err(|_| "--samples needs a number")?
                }
                "--only" => options.only = Some(value()?),
                "--pictures" => options.pictures = Some(value()?.into()),
                "--markdown" => options.markdown = true,
                // from cargo
                "--bench" => {}
                other => return Err(format!("unknown argument {other}")),
            }
        }
        options.samples = options.samples.max(1);
        Ok(options)
    }
}

fn size(text: &str) -> Option<[u32; 2]> {
    let (width, height) = text.split_once('x')?;
    let sides = [width.parse().ok()?, height.parse().ok()?];
    sides
        .iter()
        .all(|s| (1..=8192).contains(s))
        .then_some(sides)
}

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
    let gpu = Gpu::open(&options.adapter).map_err(|e| e.to_string())?;
    let [width, height] = options.size;
    println!("adapter: {}", gpu.adapter());
    println!(
        "{width}x{height}, 1 sample a pixel, median of {} frames\n",
        options.samples
    );
    let chosen = |case: &&Case| {
        options
            .only
            .as_ref()
            .is_none_or(|only| case.name.contains(only.as_str()))
    };
    let mut frames = Table::new(options.markdown, &FRAME_COLUMNS);
    let mut pictures = Table::new(options.markdown, &PICTURE_COLUMNS);
    let mut clock = false;
    for case in CASES.iter().filter(chosen) {
        eprintln!("{}", case.name);
        let prepared = case.prepare().map_err(|e| format!("{}: {e}", case.name))?;
        let canvas =
            Canvas::new(&gpu, &prepared.uniforms, options.size).map_err(|e| e.to_string())?;
        clock = canvas.has_clock();
        measure(
            case,
            &prepared,
            &canvas,
            options,
            &mut frames,
            &mut pictures,
        )
        .map_err(|e| format!("{}: {e}", case.name))?;
    }
    let source = if clock {
        "timestamps of the device"
    } else {
        "wall time of a submission"
    };
    println!("Frame time ({source})\n");
    frames.print();
    println!("\nDifference of the pictures, 8-bit sRGB, compute\n");
    pictures.print();
    Ok(())
}

const FRAME_COLUMNS: [&str; 10] = [
    "formula",
    "scene",
    "pipeline",
    "accurate, ms",
    "fast, ms",
    "twin, ms",
    "accurate / twin",
    "fast / twin",
    "signs / twin",
    "pipeline made in, ms: accurate, fast, twin",
];

const PICTURE_COLUMNS: [&str; 6] = [
    "formula",
    "compared",
    "max",
    "mean",
    "pixels off by > 2",
    "PSNR, dB",
];

fn measure(
    case: &Case,
    prepared: &Prepared,
    canvas: &Canvas,
    options: &Options,
    frames: &mut Table,
    pictures: &mut Table,
) -> Result<(), Error> {
    let names: Vec<&str> = prepared.shaders.iter().map(|s| s.name).collect();
    let place = |name: &str| names.iter().position(|n| *n == name);
    for (pipeline, pipeline_name) in PIPELINES {
        let stages: Vec<Stage> = prepared
            .shaders
            .iter()
            .map(|shader| canvas.stage(&shader.module, &shader.info, Tier::default(), pipeline))
            .collect::<Result<_, _>>()?;
        let drawn: Vec<Vec<u8>> = stages
            .iter()
            .map(|stage| canvas.picture(stage))
            .collect::<Result<_, _>>()?;
        if pipeline == Pipeline::Compute {
            compare_all(case, &names, &drawn, pictures);
            if let Some(folder) = &options.pictures {
                write_all(folder, case.name, options.size, &names, &drawn)?;
            }
        }
        let times = times(canvas, &stages, options.samples)?;
        let of = |name| place(name).map(|k| &times[k]);
        let built: Vec<String> = stages
            .iter()
            .take(3)
            .map(|stage| format!("{:.0}", stage.built * 1e3))
            .collect();
        let ratio = |name| match (of(name), of(TWIN)) {
            (Some(ours), Some(twin)) => {
                let turns = ours.iter().zip(twin).map(|(ours, twin)| ours / twin);
                format!("{:.2}", median(turns.collect()))
            }
            _ => String::new(),
        };
        let milliseconds =
            |name| of(name).map_or(String::new(), |t| significant(median(t.clone()) * 1e3));
        frames.row(vec![
            case.name.into(),
            prepared.scene.into(),
            pipeline_name.into(),
            milliseconds("accurate"),
            milliseconds("fast"),
            milliseconds(TWIN),
            ratio("accurate"),
            ratio("fast"),
            ratio("signs"),
            built.join(", "),
        ]);
    }
    Ok(())
}

fn significant(x: f64) -> String {
    let digits = if x >= 100.0 {
        0
    } else if x >= 10.0 {
        1
    } else if x >= 1.0 {
        2
    } else {
        4
    };
    format!("{x:.digits$}")
}

/// Seconds a frame of each stage in each turn.
fn times(canvas: &Canvas, stages: &[Stage], samples: usize) -> Result<Vec<Vec<f64>>, Error> {
    let mut repeats = Vec::new();
    for stage in stages {
        let start = Instant::now();
        let mut once = canvas.time(stage, 1)?;
        while start.elapsed() < WARM_UP {
            once = canvas.time(stage, 1)?;
        }
        let enough = if canvas.has_clock() {
            (SHORTEST / once.max(1e-6)).ceil()
        } else {
            1.0
        };
        repeats.push(enough.clamp(1.0, 64.0) as u32);
    }
    let mut all = vec![Vec::new(); stages.len()];
    for _ in 0..samples {
        for ((stage, &repeats), times) in stages.iter().zip(&repeats).zip(&mut all) {
            times.push(canvas.time(stage, repeats)?);
        }
    }
    Ok(all)
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Ours against the twins, and our two precisions against each other: what the latter do not show is the work of
/// finite differences and of the twin's arithmetic.
fn compare_all(case: &Case, names: &[&str], drawn: &[Vec<u8>], pictures: &mut Table) {
    for (k, name) in names.iter().enumerate().skip(1) {
        let difference = Difference::of(&drawn[0], &drawn[k]);
        pictures.row(vec![
            case.name.into(),
            format!("{} – {name}", names[0]),
            difference.max.to_string(),
            format!("{:.3}", difference.mean),
            format!("{:.3} %", 100.0 * difference.share),
            format!("{:.1}", difference.psnr),
        ]);
    }
}

/// Each picture, and its difference from the first.
fn write_all(
    folder: &Path,
    case: &str,
    [width, height]: [u32; 2],
    names: &[&str],
    drawn: &[Vec<u8>],
) -> Result<(), Error> {
    std::fs::create_dir_all(folder)?;
    let write = |name: String, pixels: &[u8]| {
        let path = folder.join(format!("{case}-{name}.png"));
        write_png(
            &path,
            Size { width, height },
            &Metadata::default(),
            |sink| Ok(sink.rows(pixels)?),
        )
    };
    for (name, pixels) in names.iter().zip(drawn) {
        write((*name).to_owned(), pixels)?;
        write(
            format!("{name}-difference"),
            &compare::picture(&drawn[0], pixels),
        )?;
    }
    Ok(())
}

/// Rows of text under a heading.
struct Table {
    markdown: bool,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn new(markdown: bool, columns: &[&str]) -> Self {
        Self {
            markdown,
            rows: vec![columns.iter().map(|c| (*c).to_owned()).collect()],
        }
    }

    fn row(&mut self, cells: Vec<String>) {
        self.rows.push(cells);
    }

    fn print(&self) {
        let columns = self.rows[0].len();
        let widths: Vec<usize> = (0..columns)
            .map(|k| {
                self.rows
                    .iter()
                    .map(|row| row[k].chars().count())
                    .max()
                    .unwrap_or(0)
            })
            .collect();
        for (line, row) in self.rows.iter().enumerate() {
            if self.markdown {
                println!("| {} |", row.join(" | "));
                if line == 0 {
                    println!("|{}", " --- |".repeat(columns));
                }
            } else {
                let cells: Vec<String> = row
                    .iter()
                    .zip(&widths)
                    .map(|(cell, width)| format!("{cell:<width$}"))
                    .collect();
                println!("{}", cells.join("  ").trim_end());
            }
        }
    }
}
