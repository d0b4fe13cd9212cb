//! `pullback gallery`: many programs on one sheet.

pub(in crate::cli) mod compare;

use std::path::{Path, PathBuf};

use clap::Args;
use pullback_runtime::{Frame, Metadata, Pipeline, Size, image_file};

use super::diff::Side;
use super::failure::Failure;
use super::place::Computer;
use super::progress::Progress;
use super::render::{self, Artist};
use super::source::{Source, Text};
use super::subject::Subject;
use super::{Console, Device, Numbers, Output};

/// The programs of docs/gallery: names, and texts.
const EXAMPLES: &[(&str, &str)] = &include!(concat!(env!("OUT_DIR"), "/gallery.rs"));

/// Pixels between pictures, and around them.
const GAP: u32 = 6;
/// Colour of the sheet.
const PAPER: [u8; 4] = [24, 25, 28, 255];

/// Arguments of `pullback gallery`.
#[derive(Debug, Args)]
pub(super) struct GalleryArguments {
    /// Programs, and folders of them; without any, the examples that this program carries
    #[arg(value_name = "FOLDER|FILE")]
    inputs: Vec<PathBuf>,
    #[command(flatten)]
    output: Output,
    /// Width and height of each picture in pixels
    #[arg(long, default_value = "240x180", value_name = "WxH", value_parser = render::size)]
    tile: Size,
    /// Pictures in a row [default: as many as make the sheet about as wide as it is high]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    columns: Option<u32>,
    #[command(flatten)]
    device: Device,
    #[command(flatten)]
    numbers: Numbers,
    /// Draw each picture on this, too, and write a table of how they differ instead of a sheet
    #[arg(long, value_name = "ADAPTER[:PRECISION]", conflicts_with_all = ["output", "columns"])]
    compare: Option<Side>,
    /// The file for the table in Markdown [default: the standard output]
    #[arg(long, value_name = "FILE", requires = "compare")]
    markdown: Option<PathBuf>,
    /// The file for the table in JSON
    #[arg(long, value_name = "FILE", requires = "compare")]
    json: Option<PathBuf>,
}

/// Draws all pictures of all programs, and writes the sheet. Those that cannot be drawn are told, and stay empty.
pub(super) fn run(arguments: &GalleryArguments, console: &Console) -> Result<(), Failure> {
    let subjects = compiled(&arguments.inputs, arguments.tile, console)?;
    if let Some(other) = &arguments.compare {
        return compare::run(arguments, other, &subjects, console);
    }
    let computer = Computer::open(&arguments.device.adapter, console)?;
    let mut sheet = Sheet::new(arguments, subjects.pictures.len() as u32)?;
    let mut progress = Progress::new(console);
    let mut failed = subjects.failed;
    for (place, subject) in (0..).zip(&subjects.pictures) {
        match draw(
            subject,
            &computer,
            arguments.numbers,
            Pipeline::Compute,
            console,
        ) {
            Ok(pixels) => sheet.place(place, &pixels),
            Err(failure) => {
                failure.report(console);
                console.warning(&format!("{} is not drawn", subject.source.name));
                failed += 1;
            }
        }
        progress.update(u64::from(place) + 1, subjects.pictures.len() as u64);
    }
    progress.finish();
    let path = arguments.output.output.clone();
    let path = path.unwrap_or_else(|| PathBuf::from("gallery.png"));
    let shown = render::name(&path);
    let metadata = Metadata(vec![(
        "Software",
        format!("pullback {}", env!("CARGO_PKG_VERSION")),
    )]);
    image_file::write_png(&path, sheet.size, &metadata, |sink| {
        Ok(sink.rows(&sheet.pixels)?)
    })
    .map_err(Failure::writing(&shown))?;
    console.note(&format!(
        "{shown}: {} pictures, {:.2} s",
        subjects.pictures.len(),
        progress.elapsed().as_secs_f64()
    ));
    if failed > 0 {
        Err(Failure::Program)
    } else {
        Ok(())
    }
}

/// What is to be drawn, and how many programs have errors, which have been told.
struct Subjects {
    pictures: Vec<Subject>,
    failed: usize,
}

/// The first picture of every program in files and folders, or of the examples that this program carries; all must be right.
pub(super) fn subjects(
    inputs: &[PathBuf],
    size: Size,
    console: &Console,
) -> Result<Vec<Subject>, Failure> {
    let found = compiled(inputs, size, console)?;
    if found.failed > 0 {
        return Err(Failure::Program);
    }
    Ok(found.pictures)
}

fn compiled(inputs: &[PathBuf], size: Size, console: &Console) -> Result<Subjects, Failure> {
    let mut texts = Vec::new();
    for input in inputs {
        for path in programs(input)? {
            texts.push(Text::file(&path)?);
        }
    }
    if inputs.is_empty() {
        texts.extend(EXAMPLES.iter().map(|&(name, text)| Text {
            name: name.to_owned(),
            stem: name.to_owned(),
            bytes: text.as_bytes().to_vec(),
        }));
    }
    let mut found = Subjects {
        pictures: Vec::new(),
        failed: 0,
    };
    for text in texts {
        match Source::compiled(text, console) {
            Ok(source) => found.pictures.push(Subject::small(source, size)?),
            Err(Failure::Program) => found.failed += 1,
            Err(failure) => return Err(failure),
        }
    }
    if found.pictures.is_empty() && found.failed == 0 {
        return Err(Failure::usage_hint(
            "there is no program to draw",
            "name .pull files, or folders with some",
        ));
    }
    Ok(found)
}

/// The programs of a folder in the order of their names, or the file itself.
fn programs(input: &Path) -> Result<Vec<PathBuf>, Failure> {
    if !input.is_dir() {
        return Ok(vec![input.to_owned()]);
    }
    let unreadable = |error| Failure::Io {
        what: input.display().to_string(),
        error,
    };
    let mut paths = Vec::new();
    for entry in input.read_dir().map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.extension().is_some_and(|ending| ending == "pull") {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}

/// The pixels of a picture, in the form of a pipeline.
fn draw(
    subject: &Subject,
    computer: &Computer,
    numbers: Numbers,
    pipeline: Pipeline,
    console: &Console,
) -> Result<Vec<u8>, Failure> {
    let tier = subject.tier(numbers, computer, console)?;
    let scene = subject.scene(tier, console)?;
    let bytes = scene.pack_settings(&subject.settings);
    let frame = Frame {
        pipeline,
        ..subject.frame(&bytes)
    };
    let mut pixels = Vec::new();
    Artist::new(
        computer,
        &scene,
        frame.pipeline,
        Some((&subject.settings, frame.samples)),
    )?
    .render(&frame, &subject.settings, &mut pixels)
    .map_err(|error| subject.source.blamed(error.into(), console))?;
    Ok(pixels)
}

/// Pictures of one size in rows and columns.
struct Sheet {
    tile: Size,
    columns: u32,
    size: Size,
    pixels: Vec<u8>,
}

impl Sheet {
    fn new(arguments: &GalleryArguments, count: u32) -> Result<Self, Failure> {
        let tile = arguments.tile;
        let (width, height) = (tile.width + GAP, tile.height + GAP);
        let square = f64::from(count) * f64::from(height) / f64::from(width);
        let columns = arguments.columns.unwrap_or(square.sqrt().round() as u32);
        let columns = columns.clamp(1, count.max(1));
        let rows = count.div_ceil(columns).max(1);
        let size = Size {
            width: columns * width + GAP,
            height: rows * height + GAP,
        };
        let limit = render::MAX_SIDE;
        if size.width > limit || size.height > limit {
            return Err(Failure::usage_hint(
                format!(
                    "a sheet of {}x{} pixels: each side can be at most {limit}",
                    size.width, size.height
                ),
                "give a smaller --tile, or other --columns",
            ));
        }
        Ok(Self {
            tile,
            columns,
            size,
            pixels: PAPER.repeat(size.width as usize * size.height as usize),
        })
    }

    /// Puts a picture at its place, counted along the rows.
    fn place(&mut self, place: u32, picture: &[u8]) {
        let left = GAP + place % self.columns * (self.tile.width + GAP);
        let top = GAP + place / self.columns * (self.tile.height + GAP);
        let (line, stride) = (self.tile.width as usize * 4, self.size.width as usize * 4);
        let rows = self.pixels.chunks_exact_mut(stride).skip(top as usize);
        for (row, pixels) in rows.zip(picture.chunks_exact(line)) {
            row[left as usize * 4..][..line].copy_from_slice(pixels);
        }
    }
}
