//! The price of precision: the frame time of every scene of the gallery in each tier, relative to `fast`.
//!
//! `cargo bench -p pullback-runtime --bench tier_cost -- [--adapter NAME] [--size WxH] [--samples N] [--only NAME]
//! [--gallery FOLDER]`
//!
//! Prints a table in Markdown. Tiers take turns, frame by frame; a ratio is the median of the ratios in each turn, so
//! that other work on the machine counts little. On hardware the device's timestamps are read, on software adapters the
//! clock of the machine. Compute pipeline.

#[path = "../frame_time/stage.rs"]
#[allow(
    dead_code,
    reason = "shared with another benchmark, which uses more of it"
)]
mod stage;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use pullback_compiler::lower::Precision;
use pullback_compiler::scene::Space;
use pullback_compiler::{Program, compile};
use pullback_runtime::{AdapterChoice, Capabilities, Gpu, Pipeline, Size, View, fill_in_scale};

use stage::{Canvas, Stage, Uniforms};

/// A timed submission on hardware should take this long at least.
const SHORTEST: f64 = 2e-3;
/// Before it counts, every pipeline draws for this long.
const WARM_UP: Duration = Duration::from_millis(100);

struct Options {
    adapter: AdapterChoice,
    size: [u32; 2],
    samples: usize,
    only: String,
    gallery: PathBuf,
}

fn options() -> Result<Options, String> {
    let mut options = Options {
        adapter: AdapterChoice::Auto,
        size: [640, 360],
        samples: 9,
        only: String::new(),
        gallery: Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/gallery"),
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
            "--samples" => {
                options.samples = value.parse().map_err(|_| "--samples needs a number")?;
            }
            "--only" => options.only = value,
            "--gallery" => options.gallery = value.into(),
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
    let gpu = Gpu::open(&options.adapter).map_err(|e| e.to_string())?;
    let [width, height] = options.size;
    println!(
        "{}, {width}x{height}, median of {} frames\n",
        gpu.adapter(),
        options.samples
    );
    println!("| scene | fast, ms | accurate / fast | extended / fast | double / fast |");
    println!("| --- | --- | --- | --- | --- |");
    let mut all = vec![Vec::new(); Precision::ALL.len()];
    for (name, text) in gallery(&options.gallery)? {
        if !name.contains(&options.only) {
            continue;
        }
        let ratios = measure(&gpu, &text, options).map_err(|e| format!("{name}: {e}"))?;
        let shown: Vec<String> = ratios.iter().map(|r| cell(*r)).collect();
        println!("| {name} | {} |", shown.join(" | "));
        for (list, ratio) in all.iter_mut().zip(ratios) {
            list.extend(ratio);
        }
    }
    let medians: Vec<String> = all
        .into_iter()
        .skip(1)
        .map(|list| cell((!list.is_empty()).then(|| median(list))))
        .collect();
    println!("| **median** | | {} |", medians.join(" | "));
    Ok(())
}

fn cell(x: Option<f64>) -> String {
    x.map_or("-".to_owned(), |x| format!("{x:.3}"))
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

/// Milliseconds of a frame in `fast`, then the cost of the other tiers relative to it; none where the adapter does not
/// have a tier.
fn measure(gpu: &Gpu, text: &str, options: &Options) -> Result<Vec<Option<f64>>, String> {
    let program = compile(text).program.ok_or("the formula has errors")?;
    let mut stages = Vec::new();
    let mut canvas = None;
    for precision in Precision::ALL {
        if !gpu.has(precision) {
            stages.push(None);
            continue;
        }
        let tier = Capabilities::tier(gpu, precision).map_err(|e| e.to_string())?;
        let scene = program
            .scene_module(0, tier)
            .map_err(|e| e[0].message.clone())?;
        let canvas = match &canvas {
            Some(canvas) => canvas,
            None => {
                let uniforms = uniforms(&program, &scene, options.size);
                let made = Canvas::new(gpu, &uniforms, options.size).map_err(|e| e.to_string())?;
                canvas.insert(made)
            }
        };
        let stage = canvas.stage(&scene.module, &scene.info, scene.tier, Pipeline::Compute);
        stages.push(Some(stage.map_err(|e| e.to_string())?));
    }
    let canvas = canvas.ok_or("no tier")?;
    times(&canvas, &stages, options.samples)
}

fn uniforms(
    program: &Program,
    scene: &pullback_compiler::SceneModule,
    [width, height]: [u32; 2],
) -> Uniforms {
    let picture = &program.pictures()[0];
    let params: Vec<f64> = program.params().iter().map(|p| p.default).collect();
    let plane = picture.scene.space != Space::Space;
    let [x, y, _] = picture.setting("center").unwrap_or_default().to_array();
    let view = View {
        center: if plane { [x, y] } else { [0.0; 2] },
        height: picture.setting("height").map_or(2.0, |h| h.x),
    };
    let mut settings = picture.settings.clone();
    fill_in_scale(
        &mut settings,
        picture,
        &view,
        Size { width, height },
        &params,
        0.0,
    );
    Uniforms {
        settings: scene.pack_settings(&settings),
        params,
        center: view.center,
        height: view.height,
    }
}

fn times(
    canvas: &Canvas,
    stages: &[Option<Stage>],
    samples: usize,
) -> Result<Vec<Option<f64>>, String> {
    let time = |stage: &Stage, repeats| canvas.time(stage, repeats).map_err(|e| e.to_string());
    let mut repeats = Vec::new();
    for stage in stages {
        let Some(stage) = stage else {
            repeats.push(1);
            continue;
        };
        let start = Instant::now();
        let mut once = time(stage, 1)?;
        while start.elapsed() < WARM_UP {
            once = time(stage, 1)?;
        }
        let enough = if canvas.has_clock() {
            (SHORTEST / once.max(1e-6)).ceil()
        } else {
            1.0
        };
        repeats.push(enough.clamp(1.0, 64.0) as u32);
    }
    let mut all: Vec<Vec<f64>> = vec![Vec::new(); stages.len()];
    for _ in 0..samples {
        for ((stage, &repeats), times) in stages.iter().zip(&repeats).zip(&mut all) {
            if let Some(stage) = stage {
                times.push(time(stage, repeats)?);
            }
        }
    }
    let fast = all[0].clone();
    let ratio = |times: &Vec<f64>| {
        let ratios = times.iter().zip(&fast).map(|(ours, fast)| ours / fast);
        (!times.is_empty()).then(|| median(ratios.collect()))
    };
    let mut out: Vec<Option<f64>> = all.iter().map(ratio).collect();
    out[0] = Some(median(fast.clone()) * 1e3);
    Ok(out)
}

fn median(mut list: Vec<f64>) -> f64 {
    list.sort_by(f64::total_cmp);
    list[list.len() / 2]
}
