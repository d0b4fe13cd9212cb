//! The same pictures by fidget and by us: a model of the plane, and a gyroid.

use std::path::Path;
use std::time::Instant;

use pullback_compiler::lower::Precision;
use pullback_compiler::{What, compile};
use pullback_runtime::bench::median;
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::{Error, Gpu, GpuEvaluator, Metadata, Renderer, Size, image_file};

use super::model;
use crate::cli::Console;
use crate::cli::failure::Failure;
use crate::cli::render::name;
use crate::cli::source::{Source, Text};
use crate::cli::subject::Subject;

/// Pixels of a side, as of fidget's.
const SIDE: u32 = 1024;
/// Turns of a picture.
const TURNS: usize = 5;
/// The part of a gyroid in a ball, as fidget has it.
const GYROID: &str = "f(x, y, z) = max(sin(8x) cos(8y) + sin(8y) cos(8z) + sin(8z) cos(8x), x² + y² + z² - 0.81)\n\
    show surface(f) { box = 1 }\n";

/// Our program of a model in fidget's text format.
pub(super) fn program(path: &Path) -> Result<String, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| Failure::Io {
        what: name(path),
        error,
    })?;
    model::program(&text).ok_or_else(|| {
        Failure::usage(format!(
            "{} is no model of fidget, or has operations of other kinds than lines of text have",
            name(path)
        ))
    })
}

/// Seconds of the model's picture and of the gyroid's, which are written into a folder.
pub(super) fn ours(
    program: &str,
    gpu: &Gpu,
    folder: &Path,
    console: &Console,
) -> Result<[f64; 2], Failure> {
    let model = format!("{program}\nshow implicit(f) {{ center = (0, 0), height = 2 }}\n");
    let drawn = |text: &str, stem: &str| drawn(text, gpu, &folder.join(stem), console);
    Ok([drawn(&model, "model")?, drawn(GYROID, "gyroid")?])
}

fn drawn(text: &str, gpu: &Gpu, path: &Path, console: &Console) -> Result<f64, Failure> {
    let text = Text {
        name: name(path),
        stem: String::new(),
        bytes: text.as_bytes().to_vec(),
    };
    let size = Size {
        width: SIDE,
        height: SIDE,
    };
    let subject = Subject::small(Source::compiled(text, console)?, size)?;
    let scene = subject.scene(Precision::Fast.into(), console)?;
    let settings = scene.pack_settings(&subject.settings);
    let mut renderer = Renderer::for_settings(gpu, &scene, &subject.settings, 1)?;
    let frame = subject.single(&settings);
    let mut pixels = Vec::new();
    renderer.render(&frame, &mut pixels)?;
    let mut times = Vec::new();
    for _ in 0..TURNS {
        let start = Instant::now();
        let by_device = renderer.device_time(&frame, 1)?;
        if by_device.is_none() {
            renderer.render(&frame, &mut Vec::new())?;
        }
        times.push(by_device.unwrap_or_else(|| start.elapsed().as_secs_f64()));
    }
    image_file::write_png(
        &path.with_extension("png"),
        size,
        &Metadata(Vec::new()),
        |sink| Ok(sink.rows(&pixels)?),
    )
    .map_err(Failure::writing("pictures"))?;
    Ok(median(&times))
}

/// How many pixels of fidget's picture of the model, a byte each behind a head, are inside where our value is not negative, or
/// the other way round; with how many there are.
pub(super) fn differing(program: &str, gpu: &Gpu, file: &[u8]) -> Result<[usize; 2], Failure> {
    let count = (SIDE * SIDE) as usize;
    let invalid = |reason: &str| Error::Invalid {
        reason: reason.to_owned(),
    };
    let start = file.len().checked_sub(count);
    let start = start.ok_or_else(|| invalid("fidget's picture is too short"))?;
    let made = compile(program).program;
    let made = made.ok_or_else(|| invalid("the model has errors"))?;
    let module = made
        .eval_module(0, What::Value, Precision::Accurate)
        .map_err(|_| invalid("the model has no value"))?;
    // fidget samples corners of pixels: columns from the left end, rows from the upper one
    let half = 0.5 * SIDE as f32;
    let places = (0..count).flat_map(|k| {
        let [x, y] = [k % SIDE as usize, k / SIDE as usize].map(|k| k as f32);
        [(x - half) / half, (half - 1.0 - y) / half]
    });
    let mut values = Vec::new();
    GpuEvaluator::new(gpu, &module)?.eval(
        Surroundings::default(),
        count,
        &places.collect::<Vec<f32>>(),
        &mut values,
    )?;
    let inside = values.iter().map(|&value| value < 0.0);
    let both = inside.zip(&file[start..]);
    let differing = both.filter(|&(inside, &byte)| inside != (byte > 0)).count();
    Ok([differing, count])
}
