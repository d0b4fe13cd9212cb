//! `pullback diff`

mod drawing;
mod report;
mod threshold;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use pullback_runtime::difference::{self, Bitmap, PIXELS_PER_DEGREE};
use pullback_runtime::render::MAX_SAMPLES;
use pullback_runtime::{Metadata, Size};

use super::failure::Failure;
use super::progress::Progress;
use super::render::{name, point, positive, size};
use super::{Console, Rules, Settings, Which};
pub(super) use drawing::Side;
use report::Report;
use threshold::Threshold;

pub(super) const EXIT_CODES: &str = "\
Exit codes:
  0  success
  1  the formula or program has errors, or a --threshold is exceeded
  2  the command line is wrong
  3  no graphics device, or it failed
  4  a file or stream could not be read or written";

/// Arguments of `pullback diff`.
#[derive(Debug, Args)]
pub(super) struct DiffArguments {
    /// A PNG to compare with; or, where it is alone, a file or formula to be drawn twice, - is the standard input
    #[arg(value_name = "A.png|FILE|FORMULA", allow_hyphen_values = true)]
    first: OsString,
    /// The PNG that is compared with it
    #[arg(value_name = "B.png", conflicts_with_all = ["a", "b"])]
    second: Option<PathBuf>,
    /// The file for a heat map of what is seen of the differences, a PNG
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// What draws the first picture: an adapter as of `render --adapter`, and a precision behind a colon
    #[arg(long, value_name = "ADAPTER[:PRECISION]", default_value = "auto")]
    a: Side,
    /// What draws the second picture
    #[arg(long, value_name = "ADAPTER[:PRECISION]", default_value = "reference")]
    b: Side,
    #[command(flatten)]
    framing: Framing,
    #[command(flatten)]
    settings: Settings,
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    rules: Rules,
    /// Fail where a number is beyond a limit: flip=0.01 or psnr=40; docs/diff.md lists the names
    #[arg(long, value_name = "NAME=LIMIT")]
    threshold: Vec<Threshold>,
    /// How the numbers are written
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// What is drawn of a program.
#[derive(Debug, Args)]
struct Framing {
    /// Width and height of the pictures in pixels
    #[arg(long, default_value = "600x450", value_name = "WxH", value_parser = size)]
    size: Size,
    /// Supersamples per axis of a pixel
    #[arg(long, default_value_t = 2, value_name = "N",
          value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    samples: u32,
    /// World coordinates of the centre
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    center: Option<[f64; 2]>,
    /// Height of the view in world units
    #[arg(long, value_name = "H", value_parser = positive, allow_hyphen_values = true)]
    height: Option<f64>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    /// A table for people
    Text,
    /// For programs: one object
    Json,
}

/// A picture, and what to call it.
struct Named {
    picture: Bitmap,
    name: String,
}

/// Compares two pictures.
pub(super) fn run(arguments: &DiffArguments, console: &Console) -> Result<(), Failure> {
    let [a, b] = match &arguments.second {
        Some(second) => [read(Path::new(&arguments.first))?, read(second)?],
        None => drawing::both(arguments, console)?,
    };
    let mut progress = Progress::new(console);
    let found = difference::compare(&a.picture, &b.picture, &mut |done, total| {
        progress.update(done, total);
    })
    .map_err(Failure::writing("pictures"))?;
    progress.finish();
    if let Some(path) = &arguments.output {
        let shown = name(path);
        let written = found.perceptual.write_heat_map(path, &metadata());
        written.map_err(Failure::writing(&shown))?;
        console.note(&format!("{shown}: magma, black where nothing is seen"));
    }
    let report = Report::new(&a.name, &b.name, &found, &arguments.threshold);
    match arguments.format {
        Format::Text => report.tell(),
        Format::Json => report.write_json(),
    }
    .map_err(Failure::stdout)?;
    let exceeded = report.exceeded();
    for message in &exceeded {
        console.error(message);
    }
    if exceeded.is_empty() {
        Ok(())
    } else {
        Err(Failure::Program)
    }
}

fn read(path: &Path) -> Result<Named, Failure> {
    let name = path.display().to_string();
    match Bitmap::read_png(path) {
        Ok(picture) => Ok(Named { picture, name }),
        Err(error) => Err(Failure::Io { what: name, error }),
    }
}

/// What the heat map says of itself.
fn metadata() -> Metadata {
    Metadata(vec![
        (
            "Software",
            format!("pullback {}", env!("CARGO_PKG_VERSION")),
        ),
        (
            "Comment",
            format!("FLIP at {PIXELS_PER_DEGREE:.2} pixels per degree; magma from 0 to 1"),
        ),
    ])
}
