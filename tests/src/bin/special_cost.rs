//! What each function that is defined in the language costs: size of its module, time from text to WGSL, and of a frame on an
//! adapter; and the tables of docs/special.md. The executable carries all that it needs.

#[path = "special_cost/frames.rs"]
mod frames;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Target, compile};
use pullback_runtime::{Error, Size};
use pullback_tests::special::{SpecialFormula, functions_of, special_formulas};
use pullback_tests::special_cost::{Cost, Costs, between, milliseconds, rows};
use pullback_tests::special_record::wanted;

/// The marks around the table in the document.
const COST: [&str; 2] = [
    "<!-- cost of special functions, by the command above -->\n",
    "<!-- end of the cost -->\n",
];
/// Those around the frames on a software adapter.
const FRAMES: [&str; 2] = [
    "<!-- frames of special functions, by the command above -->\n",
    "<!-- end of the frames -->\n",
];
/// Turns of the compiler.
const TIMES: usize = 9;

/// Measures what functions cost into a file, and makes tables from it.
#[derive(Parser)]
struct Options {
    /// Times frames on this adapter: `auto`, `gpu`, `software`, or part of its name
    #[arg(long)]
    adapter: Option<String>,
    /// Width and height of a frame of 2×2 samples a pixel
    #[arg(long, default_value = "1280x720", value_parser = size)]
    size: Size,
    /// Only these functions, with commas between: the one of this name, or else all whose names contain it
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
    /// Times the way from text to WGSL
    #[arg(long)]
    compile: bool,
    /// Measurements: a line for each as soon as it is there. What the file has is not measured again
    #[arg(long)]
    results: Option<PathBuf>,
    /// After this time it ends, whatever a driver still does
    #[arg(long, default_value_t = 540)]
    seconds: u64,
    /// Shaders that are compiled at the same time; frames are timed one after the other, while nothing else runs
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// A page whose tables are made anew from sizes and from the results; what is not in these stays as it is on the page
    #[arg(long)]
    markdown: Option<PathBuf>,
    /// Times one function for the process that started this one
    #[arg(long, hide = true)]
    child: Option<String>,
}

fn size(text: &str) -> Result<Size, String> {
    let sides = text.split_once('x').and_then(|(width, height)| {
        Some(Size {
            width: width.parse().ok()?,
            height: height.parse().ok()?,
        })
    });
    sides.ok_or_else(|| "write WxH, such as 1280x720".to_owned())
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

fn run(options: &Options) -> Result<(), Error> {
    let mut formulas = special_formulas();
    if let Some(name) = &options.child {
        let formula = formulas.iter().find(|formula| formula.name == name);
        return formula.map_or(Ok(()), |formula| frames::child(options, formula));
    }
    let names: Vec<&str> = formulas.iter().map(|formula| formula.name).collect();
    let chosen = wanted(&names, &options.only);
    formulas.retain(|formula| chosen.contains(formula.name));
    let mut costs = Costs::read(options.results.as_deref())?;
    if options.compile {
        for formula in &formulas {
            let seconds = compile_time(formula);
            println!("{}: {} ms to WGSL", formula.name, milliseconds(seconds));
            costs.add(formula.name, Cost::Compiled, Ok(seconds))?;
        }
    }
    if let Some(adapter) = &options.adapter {
        frames::measure(options, adapter, &formulas, &mut costs)?;
    }
    match &options.markdown {
        Some(path) => write_tables(path, &costs),
        None => Ok(()),
    }
}

/// The median of some turns, in seconds.
fn compile_time(formula: &SpecialFormula) -> f64 {
    let time = |_| {
        let start = Instant::now();
        let text = emit(formula, EmitWhat::Value, Precision::Accurate);
        let taken = start.elapsed();
        assert!(!text.is_empty(), "{}", formula.text);
        taken.as_secs_f64()
    };
    median((0..TIMES).map(time).collect())
}

fn emit(formula: &SpecialFormula, what: EmitWhat, precision: Precision) -> String {
    let program = compile(&formula.text).program;
    let text = program.and_then(|p| p.emit(0, what, Target::Wgsl, precision).ok());
    text.and_then(|t| String::from_utf8(t).ok())
        .unwrap_or_default()
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_unstable_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or_default()
}

fn write_tables(path: &Path, costs: &Costs) -> Result<(), Error> {
    let page = std::fs::read_to_string(path)?;
    let page = replaced(&page, COST, |old| cost_table(old, costs))?;
    let page = replaced(&page, FRAMES, |old| frame_table(old, costs))?;
    Ok(std::fs::write(path, page)?)
}

fn replaced(page: &str, marks: [&str; 2], table: impl Fn(&str) -> String) -> Result<String, Error> {
    let [before, old, after] = between(page, marks)?;
    let [begin, end] = marks;
    Ok(format!("{before}{begin}{}\n{end}{after}", table(old)))
}

/// Sizes as they are now; times from the results, or else those of the old table.
fn cost_table(old: &str, costs: &Costs) -> String {
    let old = rows(old);
    let mut table = "\n| function | functions in the module | WGSL, KB | with derivative, KB | `double`, KB | compiled in, ms | \
                     frame, ms |\n| --- | --- | --- | --- | --- | --- | --- |\n"
        .to_owned();
    let mut compiled = Vec::new();
    for formula in special_formulas() {
        let name = formula.name;
        let kept = |k: usize| old.get(name).and_then(|row| row.get(k).cloned());
        let time = |cost, k| match costs.of(name, cost) {
            Some(Ok(seconds)) => milliseconds(*seconds),
            Some(Err(reason)) => reason.clone(),
            None => kept(k).unwrap_or_default(),
        };
        let value = emit(&formula, EmitWhat::Value, Precision::Accurate);
        let slope = emit(&formula, EmitWhat::Derivative, Precision::Accurate);
        let double = emit(&formula, EmitWhat::Value, Precision::Double);
        let to_wgsl = time(Cost::Compiled, 5);
        compiled.extend(to_wgsl.parse::<f64>());
        table += &format!(
            "| `{name}` | {} | {:.1} | {:.1} | {:.1} | {to_wgsl} | {} |\n",
            functions_of(&value).len(),
            kilobytes(&value),
            kilobytes(&slope),
            kilobytes(&double),
            time(Cost::Frame, 6)
        );
    }
    let last = median(compiled);
    table + &format!("\nMedian of all: {last:.2}.\n")
}

/// Frames of the software adapter, the shortest first.
fn frame_table(old: &str, costs: &Costs) -> String {
    let old = rows(old);
    let shown = |formula: &SpecialFormula| {
        let found = match costs.of(formula.name, Cost::SoftwareFrame) {
            Some(Ok(seconds)) => format!("{seconds:.2}"),
            Some(Err(reason)) => reason.clone(),
            None => old.get(formula.name)?.get(1)?.clone(),
        };
        Some((found.parse().unwrap_or(f64::INFINITY), formula.name, found))
    };
    let mut frames: Vec<(f64, &str, String)> =
        special_formulas().iter().filter_map(shown).collect();
    frames.sort_by(|a, b| a.0.total_cmp(&b.0));
    let row = |(_, name, time): &(f64, &str, String)| format!("| `{name}` | {time} |\n");
    let lines: String = frames.iter().map(row).collect();
    format!("\n| function | frame, s |\n| --- | --- |\n{lines}")
}

fn kilobytes(text: &str) -> f64 {
    f64::from(u32::try_from(text.len()).unwrap_or(u32::MAX)) / 1000.0
}
