//! What each function that is defined in the language costs: size of its module, time from text to WGSL, and of a picture
//! on an adapter. A table in Markdown. The executable carries all that it needs.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Parser;
use pullback_compiler::lower::Precision;
use pullback_compiler::table;
use pullback_compiler::{EmitWhat, Target, compile};
use pullback_runtime::{AdapterChoice, Error, Frame, Gpu, Pipeline, Renderer, Size};
use pullback_tests::special::{SpecialFormula, SpecialOptions, functions_of, special_formulas};
use pullback_tests::stills::Still;

/// The marks around the table in the document.
const BEGIN: &str = "<!-- cost of special functions, by the command above -->\n";
const END: &str = "<!-- end of the cost -->\n";
/// Those around the frames alone.
const FRAMES_BEGIN: &str = "<!-- frames of special functions, by the command above -->\n";
const FRAMES_END: &str = "<!-- end of the frames -->\n";
/// Turns of the compiler.
const TIMES: usize = 9;
/// Samples of a pixel on each axis.
const SAMPLES: u32 = 2;
/// Frames after one that does not count.
const FRAMES: u32 = 3;

/// Size of the module, and time from text to WGSL and of a frame, of each function that is defined in the language.
#[derive(Parser)]
struct Options {
    /// No frames are drawn without an adapter
    #[command(flatten)]
    of: SpecialOptions,
    /// Width and height of a frame of 2×2 samples a pixel
    #[arg(long, default_value = "1280x720")]
    size: String,
    /// Times of frames alone, in a table of their own
    #[arg(long, requires = "adapter")]
    frames: bool,
    /// A file whose text between the marks of the table is replaced, beside what is printed
    #[arg(long)]
    markdown: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn invalid(reason: String) -> Error {
    Error::Invalid { reason }
}

fn run(options: &Options) -> Result<(), Error> {
    let size = size(&options.size)?;
    let open = |name: &String| Gpu::open(&name.parse::<AdapterChoice>().unwrap_or_default());
    let gpu = options.of.adapter.as_ref().map(open).transpose()?;
    if let (true, Some(gpu)) = (options.frames, &gpu) {
        let table = frames(options, gpu, size)?;
        return match &options.markdown {
            Some(path) => replace(path, [FRAMES_BEGIN, FRAMES_END], &table),
            None => Ok(()),
        };
    }
    let mut table = head(gpu.as_ref(), size);
    print!("{table}");
    let mut all = Vec::new();
    for formula in special_formulas() {
        if !formula.name.contains(&options.of.only) {
            continue;
        }
        let compiled = median((0..TIMES).map(|_| time(&formula)).collect());
        let frame = gpu.as_ref().map(|gpu| frame(&formula, gpu, size));
        let row = row(&formula, compiled, frame.transpose()?);
        print!("{row}");
        table += &row;
        all.push(compiled);
    }
    let last = format!("\nMedian of all: {}.\n", milliseconds(median(all)));
    print!("{last}");
    table += &last;
    match &options.markdown {
        Some(path) => replace(path, [BEGIN, END], &table),
        None => Ok(()),
    }
}

/// A table of frames alone, begun with what costs the least by the operator table; where the device does not finish in its time the
/// table says so.
fn frames(options: &Options, gpu: &Gpu, size: Size) -> Result<String, Error> {
    let mut formulas = special_formulas();
    formulas.retain(|formula| formula.name.contains(&options.of.only));
    formulas.sort_by_key(|formula| table::row(formula.prim).cost.complex);
    let mut text = "\n| function | frame, s |\n| --- | --- |\n".to_owned();
    for formula in formulas {
        let row = match frame(&formula, gpu, size) {
            Ok(time) => format!("| `{}` | {:.2} |\n", formula.name, time.as_secs_f64()),
            Err(error) => format!("| `{}` | {error} |\n", formula.name),
        };
        print!("{row}");
        text += &row;
    }
    Ok(text)
}

fn size(text: &str) -> Result<Size, Error> {
    let sides = text
        .split_once('x')
        .and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    let (width, height) = sides.ok_or_else(|| invalid(format!("`{text}` is no size")))?;
    Ok(Size { width, height })
}

fn head(gpu: Option<&Gpu>, size: Size) -> String {
    let place = gpu.map_or_else(String::new, |gpu| {
        let Size { width, height } = size;
        format!(
            "\nFrames of {width}x{height} with 4 samples on {}.\n",
            gpu.adapter().name
        )
    });
    format!(
        "{place}\n| function | functions in the module | WGSL, KB | with derivative, KB | `double`, KB | compiled in, ms | frame, ms |\n\
         | --- | --- | --- | --- | --- | --- | --- |\n"
    )
}

fn row(formula: &SpecialFormula, compiled: Duration, frame: Option<Duration>) -> String {
    let value = emit(formula, EmitWhat::Value, Precision::Accurate);
    let slope = emit(formula, EmitWhat::Derivative, Precision::Accurate);
    let double = emit(formula, EmitWhat::Value, Precision::Double);
    format!(
        "| `{}` | {} | {:.1} | {:.1} | {:.1} | {} | {} |\n",
        formula.name,
        functions_of(&value).len(),
        kilobytes(&value),
        kilobytes(&slope),
        kilobytes(&double),
        milliseconds(compiled),
        frame.map_or_else(String::new, milliseconds)
    )
}

fn emit(formula: &SpecialFormula, what: EmitWhat, precision: Precision) -> String {
    let program = compile(&formula.text).program;
    let text = program.and_then(|p| p.emit(0, what, Target::Wgsl, precision).ok());
    text.and_then(|t| String::from_utf8(t).ok())
        .unwrap_or_default()
}

fn time(formula: &SpecialFormula) -> Duration {
    let start = Instant::now();
    let text = emit(formula, EmitWhat::Value, Precision::Accurate);
    let taken = start.elapsed();
    assert!(!text.is_empty(), "{}", formula.text);
    taken
}

/// A frame of the scene `domain`: by the device's timestamps, or on software by the clock.
fn frame(formula: &SpecialFormula, gpu: &Gpu, size: Size) -> Result<Duration, Error> {
    let still = Still::new(&formula.text, size, SAMPLES);
    let settings = still.scene.pack_settings(&still.settings);
    let frame = Frame {
        view: still.view,
        params: &still.params,
        settings: &settings,
        size,
        samples: SAMPLES,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let mut renderer = Renderer::for_settings(gpu, &still.scene, &still.settings, SAMPLES)?;
    let mut rows = Vec::new();
    // a software adapter compiles with its first work
    let small = Size {
        width: 32,
        height: 18,
    };
    let first = if gpu.adapter().is_software() {
        small
    } else {
        size
    };
    let warm = Frame {
        size: first,
        ..frame
    };
    renderer.render(&warm, &mut rows)?;
    if !gpu.adapter().is_software()
        && let Some(seconds) = renderer.device_time(&frame, FRAMES)?
    {
        return Ok(Duration::from_secs_f64(seconds));
    }
    rows.clear();
    let start = Instant::now();
    renderer.render(&frame, &mut rows)?;
    Ok(start.elapsed())
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    times.get(times.len() / 2).copied().unwrap_or_default()
}

fn kilobytes(text: &str) -> f64 {
    f64::from(u32::try_from(text.len()).unwrap_or(u32::MAX)) / 1000.0
}

/// Two digits behind the point of a small time.
fn milliseconds(time: Duration) -> String {
    let ms = time.as_secs_f64() * 1e3;
    format!("{ms:.*}", if ms < 10.0 { 2 } else { 0 })
}

/// Writes the table between the marks.
fn replace(path: &Path, [begin, end]: [&str; 2], table: &str) -> Result<(), Error> {
    let page = std::fs::read_to_string(path)?;
    let between = page.split_once(begin).and_then(|(before, rest)| {
        let (_, after) = rest.split_once(end)?;
        Some((before, after))
    });
    let (before, after) =
        between.ok_or_else(|| invalid(format!("{}: no marks of the table", path.display())))?;
    Ok(std::fs::write(
        path,
        format!("{before}{begin}{table}\n{end}{after}"),
    )?)
}
