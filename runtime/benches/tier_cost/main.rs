//! The price of precision: the frame time of every scene of the gallery in each tier, relative to `fast`.
//!
//! `cargo bench --workspace --bench tier_cost -- [--adapter NAME] [--size WxH] [--seconds S] [--threads N] [--only NAME]
//! [--gallery FOLDER] [--out FILE]`
//!
//! Prints a table in Markdown. Tiers take turns, frame by frame; a ratio is the median of the ratios in each turn, so
//! that other work on the machine counts little. On hardware the device's timestamps are read, on software adapters the
//! clock of the machine. Compute pipeline.
//!
//! A scene is drawn for `--seconds` at most, in as many turns as fit, three at least; where even those would take longer, the
//! picture is made smaller. Pipelines of wide formats take seconds to compile: `--threads` compile at once, each on a device
//! of its own, and draw one at a time. Each row is appended to the file of `--out` as soon as it is known, and what the
//! file has is not measured again.

#[path = "../frame_time/stage.rs"]
#[allow(
    dead_code,
    reason = "shared with another benchmark, which uses more of it"
)]
mod stage;

mod scene;
mod table;
mod times;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;

use pullback_runtime::{AdapterChoice, Gpu};

use scene::Scene;
use table::{Row, Table};

/// What was asked for.
struct Options {
    adapter: AdapterChoice,
    /// The largest picture.
    size: [u32; 2],
    /// Seconds that a scene is drawn.
    seconds: f64,
    threads: usize,
    only: String,
    gallery: PathBuf,
    out: Option<PathBuf>,
}

fn options() -> Result<Options, String> {
    let mut options = Options {
        adapter: AdapterChoice::Auto,
        size: [640, 360],
        seconds: 2.0,
        threads: 1,
        only: String::new(),
        gallery: Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/gallery"),
        out: None,
    };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        if argument == "--bench" {
            continue;
        }
        let value = arguments
            .next()
            .ok_or(format!("{argument} needs a value"))?;
        match argument.as_str() {
            "--adapter" => options.adapter = value.parse().unwrap_or_default(),
            "--size" => options.size = size(&value).ok_or("a size is like 640x360")?,
            "--seconds" => {
                options.seconds = value.parse().map_err(|_| "--seconds needs a number")?;
            }
            "--threads" => {
                options.threads = value.parse().map_err(|_| "--threads needs a number")?;
            }
            "--only" => options.only = value,
            "--gallery" => options.gallery = value.into(),
            "--out" => options.out = Some(value.into()),
            other => return Err(format!("unknown argument {other}")),
        }
    }
    Ok(options)
}

fn size(text: &str) -> Option<[u32; 2]> {
    let (width, height) = text.split_once('x')?;
    Some([width.parse().ok()?, height.parse().ok()?])
}

fn main() -> ExitCode {
    match options().and_then(|options| run(&options)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), String> {
    let devices: Vec<Gpu> = (0..options.threads.max(1))
        .map(|_| Gpu::open(&options.adapter).map_err(|e| e.to_string()))
        .collect::<Result<_, _>>()?;
    let adapter = devices[0].adapter().to_string();
    let [width, height] = options.size;
    println!("{adapter}, {width}x{height} or smaller\n");
    let table = Mutex::new(Table::open(options.out.as_deref(), &adapter)?);
    let known = |name: &str| table.lock().is_ok_and(|table| table.has(name));
    let mut scenes: Vec<_> = gallery(&options.gallery)?
        .into_iter()
        .filter(|(name, _)| name.contains(&options.only) && !known(name))
        .collect();
    scenes.reverse();
    let scenes = Mutex::new(scenes);
    let problems = Mutex::new(Vec::new());
    let turn = Mutex::new(());
    let work = |gpu: &Gpu| {
        while let Some((name, text)) = scenes.lock().ok().and_then(|mut list| list.pop()) {
            let done = measure(gpu, &name, &text, options, &turn)
                .and_then(|row| table.lock().map_err(|e| e.to_string())?.add(row));
            if let (Err(problem), Ok(mut problems)) = (done, problems.lock()) {
                problems.push(format!("{name}: {problem}"));
            }
        }
    };
    std::thread::scope(|scope| {
        for gpu in &devices {
            scope.spawn(|| work(gpu));
        }
    });
    println!(
        "{}",
        table
            .into_inner()
            .map_err(|e| e.to_string())?
            .markdown(&options.only)
    );
    match problems.into_inner().unwrap_or_default().as_slice() {
        [] => Ok(()),
        problems => Err(problems.join("\n")),
    }
}

/// Compiles a scene in every tier, and times it when it is its turn.
fn measure(
    gpu: &Gpu,
    name: &str,
    text: &str,
    options: &Options,
    turn: &Mutex<()>,
) -> Result<Row, String> {
    let scene = Scene::new(gpu, text)?;
    let _alone = turn.lock();
    let (size, times) = times::times(&scene, options.size, options.seconds)?;
    let row = Row {
        name: name.to_owned(),
        size,
        times,
        built: scene.built(),
    };
    eprintln!("{}", row.tabs());
    Ok(row)
}

/// Names and texts of the gallery, in order.
fn gallery(folder: &Path) -> Result<Vec<(String, String)>, String> {
    let wrong = |e: std::io::Error| format!("{}: {e}", folder.display());
    let mut out = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(wrong)? {
        let path = entry.map_err(wrong)?.path();
        if path.extension().is_some_and(|e| e == "pull") {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            out.push((
                name.into_owned(),
                std::fs::read_to_string(&path).map_err(wrong)?,
            ));
        }
    }
    out.sort();
    Ok(out)
}
