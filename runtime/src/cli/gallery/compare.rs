//! `pullback gallery --compare`: every picture as two computers draw it, and how far they are apart.

use std::io::{self, Write};
use std::path::Path;

use pullback_compiler::lower::Precision;
use pullback_runtime::atomic_file::write_text;
use pullback_runtime::difference::{Bitmap, Light, PIXELS_PER_DEGREE, Perceptual};
use pullback_runtime::{Pipeline, Size};
use serde::Serialize;

use super::{GalleryArguments, Subjects, draw};
use crate::cli::diff::Side;
use crate::cli::failure::Failure;
use crate::cli::place::Computer;
use crate::cli::progress::Progress;
use crate::cli::subject::Subject;
use crate::cli::{Console, Numbers};

/// Version of the report: the number grows when a program that reads the older one would misread the newer.
const VERSION: u32 = 1;

/// A picture, and how far its two drawings are apart.
pub(in crate::cli) struct Row {
    name: String,
    scene: &'static str,
    light: Light,
    seen: Perceptual,
}

/// Draws every picture twice, and writes the tables. Those that cannot be drawn are told, and left out.
pub(super) fn run(
    arguments: &GalleryArguments,
    other: &Side,
    subjects: &Subjects,
    console: &Console,
) -> Result<(), Failure> {
    let a = (
        Computer::open(&arguments.device.adapter, console)?,
        arguments.numbers,
    );
    let numbers = Numbers {
        precision: other.precision,
    };
    let b = (Computer::open(&other.place, console)?, numbers);
    let mut progress = Progress::new(console);
    let mut rows = Vec::new();
    let mut failed = subjects.failed;
    for (k, subject) in (1..).zip(&subjects.pictures) {
        match Row::new(subject, [&a, &b], console) {
            Ok(row) => rows.push(row),
            Err(failure) => {
                failure.report(console);
                console.warning(&format!("{} is not compared", subject.source.name));
                failed += 1;
            }
        }
        progress.update(k, subjects.pictures.len() as u64);
    }
    progress.finish();
    let report = Report {
        names: [told(&a), told(&b)],
        arguments,
        rows,
    };
    report.write()?;
    if failed > 0 {
        Err(Failure::Program)
    } else {
        Ok(())
    }
}

/// What draws, and in which precision.
pub(in crate::cli) fn told((computer, numbers): &(Computer, Numbers)) -> String {
    match numbers.precision {
        Some(tier) => {
            let name = tier.precision().map_or("auto", Precision::name);
            format!("{computer}, in {name}")
        }
        None => computer.to_string(),
    }
}

fn compared(
    subject: &Subject,
    computers: [&(Computer, Numbers); 2],
    console: &Console,
) -> Result<(Light, Perceptual), Failure> {
    let size = subject.frame(&[]).size;
    let [truth, test] = computers.map(|(computer, numbers)| -> Result<Vec<[f32; 4]>, Failure> {
        let bytes = draw(subject, computer, *numbers, Pipeline::Linear, console)?;
        let pixels = bytes.as_chunks::<16>().0.iter();
        let number = |pixel: &[u8; 16], k: usize| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|j| pixel[4 * k + j]);
            f32::from_le_bytes([a, b, c, d])
        };
        Ok(pixels.map(|p| [0, 1, 2, 3].map(|k| number(p, k))).collect())
    });
    let (truth, test) = (truth?, test?);
    let seen = Perceptual::new(
        &Bitmap::from_linear(size, &truth)?,
        &Bitmap::from_linear(size, &test)?,
        &mut |_, _| {},
    );
    let seen = seen.map_err(Failure::writing("pictures"))?;
    Ok((Light::apart(&truth, &test), seen))
}

/// The head of the table of two computers.
pub(in crate::cli) fn head([a, b]: &[String; 2], size: Size) -> String {
    format!(
        "{a}, and {b}; {}x{} pixels, four samples each.\n\n\
         | Picture | Scene | Off by more than 1/255 | 99.9 % below | Greatest | FLIP, mean | FLIP, greatest | At |\n\
         | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        size.width, size.height
    )
}

impl Row {
    /// A picture, drawn by two computers.
    pub(in crate::cli) fn new(
        subject: &Subject,
        computers: [&(Computer, Numbers); 2],
        console: &Console,
    ) -> Result<Self, Failure> {
        let (light, seen) = compared(subject, computers, console)?;
        Ok(Self {
            name: subject.source.stem.clone(),
            scene: subject.picture().scene.name,
            light,
            seen,
        })
    }

    /// Its line of the table.
    pub(in crate::cli) fn line(&self) -> String {
        let Self {
            name,
            scene,
            light,
            seen,
        } = self;
        let [x, y] = seen.worst;
        let place = if seen.max > 0.0 {
            format!("{x},{y}")
        } else {
            String::new()
        };
        format!(
            "| {name} | {scene} | {:.3} % | {:.1e} | {:.1e} | {:.6} | {:.4} | {place} |\n",
            100.0 * light.share,
            light.p999,
            light.max,
            seen.mean,
            seen.max
        )
    }
}

struct Report<'a> {
    names: [String; 2],
    arguments: &'a GalleryArguments,
    rows: Vec<Row>,
}

impl Report<'_> {
    fn write(&self) -> Result<(), Failure> {
        let GalleryArguments { markdown, json, .. } = self.arguments;
        if let Some(path) = markdown {
            put(path, &self.markdown())?;
        }
        if let Some(path) = json {
            put(path, &self.json())?;
        }
        if markdown.is_none() && json.is_none() {
            let mut out = io::stdout().lock();
            let written = out.write_all(self.markdown().as_bytes());
            written
                .and_then(|()| out.flush())
                .map_err(Failure::stdout)?;
        }
        Ok(())
    }

    fn markdown(&self) -> String {
        let mut text = head(&self.names, self.arguments.tile);
        for row in &self.rows {
            text += &row.line();
        }
        text
    }

    fn json(&self) -> String {
        let [a, b] = self.names.each_ref().map(String::as_str);
        let size = self.arguments.tile;
        let report = Json {
            version: VERSION,
            a,
            b,
            width: size.width,
            height: size.height,
            pixels_per_degree: PIXELS_PER_DEGREE.into(),
            pictures: self.rows.iter().map(JsonRow::new).collect(),
        };
        let mut text = serde_json::to_string_pretty(&report).unwrap_or_default();
        text.push('\n');
        text
    }
}

fn put(path: &Path, text: &str) -> Result<(), Failure> {
    write_text(path, text).map_err(|error| Failure::Io {
        what: path.display().to_string(),
        error,
    })
}

#[derive(Serialize)]
struct Json<'a> {
    version: u32,
    a: &'a str,
    b: &'a str,
    width: u32,
    height: u32,
    pixels_per_degree: f64,
    pictures: Vec<JsonRow<'a>>,
}

#[derive(Serialize)]
struct JsonRow<'a> {
    name: &'a str,
    scene: &'a str,
    over_255: f64,
    p999: f64,
    max: f64,
    flip_mean: f64,
    flip_max: f64,
    worst_pixel: [u32; 2],
}

impl<'a> JsonRow<'a> {
    fn new(row: &'a Row) -> Self {
        let Row { light, seen, .. } = row;
        Self {
            name: &row.name,
            scene: row.scene,
            over_255: light.share,
            p999: light.p999,
            max: light.max,
            flip_mean: seen.mean,
            flip_max: seen.max,
            worst_pixel: seen.worst,
        }
    }
}
