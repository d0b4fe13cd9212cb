//! Measures the bits that each tier loses on the benchmark expressions of FPBench and Herbie, and prints tables.

use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use clap::Parser;
use pullback_compiler::lower::Precision;
use pullback_runtime::executor::Contraction;
use pullback_runtime::{AdapterChoice, Gpu};
use pullback_tests::benchmarks::data::{Benchmark, COLLECTIONS, collection};
use pullback_tests::benchmarks::dense;
use pullback_tests::benchmarks::measure::{Machine, Way, measure_all};
use pullback_tests::benchmarks::report::{Style, details, json, telling, totals, ways};
use pullback_tests::benchmarks::store::Store;

/// The error in bits of each tier on the benchmark expressions of FPBench and Herbie, over float32 points of their stated
/// domains, against exact values of 200 bits and more.
///
/// A result's error is log2(1 + float32 numbers between it and the right one), 32 for a NaN; a benchmark's is the mean over
/// its points. The wide tiers are also judged in their own format: pairs in units of 2^-48 of the value (48 at most), doubles
/// by the float64 numbers between (64 at most). `+` marks stability rewrites.
///
/// Cancellation is said to dominate where the expression as it is written loses at least 4 bits when every operation is
/// correctly rounded to 24 bits and exponents have no bounds: neither an adapter nor a rewrite nor an overflow has a part in
/// that. The column `24 bits` shows it.
#[derive(Parser)]
struct Options {
    /// `auto`, `gpu`, `software`, or part of an adapter's name; `reference` for the f64 evaluator; `ieee32`
    /// for exact single precision on the processor, `contracted-left` and `contracted-right` with products fused into sums as
    /// drivers do, of two the left or the right one: only tier `accurate`
    #[arg(long, default_value = "auto")]
    adapter: String,
    /// Only these tiers
    #[arg(long, value_delimiter = ',', default_values = ["fast", "accurate", "extended", "double"])]
    tiers: Vec<String>,
    /// Only with rewrites in the wide tiers, whose shaders take seconds to compile
    #[arg(long)]
    brief: bool,
    /// Threads, each with a device of its own
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// A file that keeps what was measured: a run that was stopped goes on, and one after a change measures what has changed
    #[arg(long)]
    store: Option<PathBuf>,
    /// Only benchmarks whose name (collection/file/place) contains one of these
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
    /// Only benchmarks on which cancellation dominates
    #[arg(long)]
    cancelling: bool,
    /// Prints so many rows, those first in which rewrites gain the most
    #[arg(long)]
    telling: Option<usize>,
    /// Prints tables of Markdown
    #[arg(long)]
    markdown: bool,
    /// Prints a line with tabs for each benchmark, and nothing else
    #[arg(long)]
    tabs: bool,
    /// Prints JSON, and nothing else
    #[arg(long)]
    json: bool,
    /// Compares `accurate` with and without rewrites at 4,096 points of each formula, and prints nothing else
    #[arg(long)]
    dense: bool,
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), String> {
    let machines = machines(options)?;
    let tiers = tiers(&options.tiers)?;
    let is_wanted = |way: &Way| {
        let wide = matches!(way.precision, Precision::Extended | Precision::Double);
        way.rewrites || !wide || !options.brief
    };
    let ways: Vec<Way> = ways(&tiers).into_iter().filter(is_wanted).collect();
    let store = match &options.store {
        Some(path) => Store::open(path)?,
        None => Store::default(),
    };
    let (mut fits, mut unfit) = (Vec::new(), Vec::new());
    for name in COLLECTIONS {
        let (some, others) = collection(name)?;
        fits.extend(some);
        unfit.extend(others);
    }
    let is_named = |b: &Benchmark| {
        options.only.is_empty() || options.only.iter().any(|word| b.id.contains(word))
    };
    let wanted = |b: &&Benchmark| is_named(b) && (!options.cancelling || b.cancels());
    let asked: Vec<&Benchmark> = fits.iter().filter(wanted).collect();
    let start = Instant::now();
    let progress = |done: usize| {
        if done.is_multiple_of(20) || done == asked.len() {
            let seconds = start.elapsed().as_secs();
            // where nobody reads it, it is no matter
            let _ = writeln!(std::io::stderr(), "{done} of {}, {seconds} s", asked.len());
        }
    };
    if options.dense {
        return dense_table(&asked, &machines, &progress);
    }
    let mut rows = Vec::new();
    let mut refused = Vec::new();
    for row in measure_all(&asked, &machines, &ways, &store, &progress) {
        match row {
            Ok(row) => {
                refused.extend(row.refused.iter().cloned());
                rows.push(row);
            }
            Err(problem) => refused.push(problem),
        }
    }
    for problem in &refused {
        eprintln!("{problem}");
    }
    if options.json {
        print!("{}", json(&rows));
    } else if options.tabs {
        print!("{}", details(&rows, Style::Tabs));
    } else {
        let style = if options.markdown {
            Style::Markdown
        } else {
            Style::Text
        };
        println!("{}", totals(&rows, options.markdown));
        match options.telling {
            None => println!("{}", details(&rows, style)),
            Some(most) => {
                let some: Vec<_> = telling(&rows).into_iter().take(most).cloned().collect();
                println!("{}", details(&some, style));
            }
        }
        println!("Not measured: {}", unfit.len());
        for other in &unfit {
            println!("- {} ({}): {}", other.id, other.name, other.reason);
        }
    }
    match refused.len() {
        0 => Ok(()),
        n => Err(format!("{n} measurements were refused")),
    }
}

/// Prints how the formulas do with and without rewrites at many points; some that are worse are an error.
fn dense_table(
    asked: &[&Benchmark],
    machines: &[Machine],
    progress: &(impl Fn(usize) + Sync),
) -> Result<(), String> {
    let next = AtomicUsize::new(0);
    let found = Mutex::new((Vec::new(), Vec::new()));
    let work = |machine: &Machine| {
        while let Some(benchmark) = asked.get(next.fetch_add(1, Ordering::Relaxed)) {
            let pair = dense::rewritten(benchmark, machine);
            let Ok(mut found) = found.lock() else { return };
            match pair {
                Ok(pair) => found.0.extend(pair),
                Err(problem) => found.1.push(problem),
            }
            progress(next.load(Ordering::Relaxed));
        }
    };
    std::thread::scope(|scope| {
        for machine in machines {
            scope.spawn(|| work(machine));
        }
    });
    let (pairs, refused) = found.into_inner().map_err(|e| e.to_string())?;
    print!("{}", dense::table(&pairs));
    let worse = pairs.iter().filter(|p| p.is_worse()).count();
    match (refused.as_slice(), worse) {
        ([], 0) => Ok(()),
        ([], _) => Err(format!("rewrites make {worse} formulas worse")),
        (refused, _) => Err(refused.join("\n")),
    }
}

/// One machine for each thread.
fn machines(options: &Options) -> Result<Vec<Machine>, String> {
    if options.adapter == "reference" {
        let one = |_| Machine::Reference;
        return Ok((0..options.threads.max(1)).map(one).collect());
    }
    let contraction = match options.adapter.as_str() {
        "ieee32" => Some(Contraction::None),
        "contracted-left" => Some(Contraction::Left),
        "contracted-right" => Some(Contraction::Right),
        _ => None,
    };
    if let Some(contraction) = contraction {
        let one = |_| Machine::Contracted(contraction);
        return Ok((0..options.threads.max(1)).map(one).collect());
    }
    let choice: AdapterChoice = options.adapter.parse().unwrap_or_default();
    let open = |_| -> Result<Machine, String> {
        let gpu = Gpu::open(&choice).map_err(|e| e.to_string())?;
        Ok(Machine::Gpu(Box::new(gpu)))
    };
    let machines: Vec<Machine> = (0..options.threads.max(1))
        .map(open)
        .collect::<Result<_, _>>()?;
    if let Some(Machine::Gpu(gpu)) = machines.first() {
        eprintln!("{}", gpu.adapter());
    }
    Ok(machines)
}

fn tiers(words: &[String]) -> Result<Vec<Precision>, String> {
    words
        .iter()
        .map(|word| match word.as_str() {
            "fast" => Ok(Precision::Fast),
            "accurate" => Ok(Precision::Accurate),
            "extended" => Ok(Precision::Extended),
            "double" => Ok(Precision::Double),
            _ => Err(format!("no tier `{word}`")),
        })
        .collect()
}
