//! Special functions on an adapter against tables of 60 digits, in every tier. The executable carries all that it needs.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use clap::Parser;
use pullback_compiler::lower::Precision;
use pullback_runtime::Error;
use pullback_tests::accuracy::formulas::special;
use pullback_tests::special::SpecialOptions;
use pullback_tests::special_batches::{Batch, Judged, Place, batches};

/// The largest error of each special function on an adapter, as a multiple of the scale of its table. The exit code is 1
/// where one is above what is declared, or was not reached in time.
#[derive(Parser)]
struct Options {
    /// The adapter may be `ieee32`, too: the processor, by the shaders of the tiers; `left` and `right` with products fused into sums
    #[command(flatten)]
    of: SpecialOptions,
    /// Tiers, with commas between
    #[arg(long, default_value = "accurate,extended,double", value_delimiter = ',', value_parser = tier)]
    precision: Vec<Precision>,
    /// After this time no further function is begun
    #[arg(long, default_value_t = 240)]
    seconds: u64,
    /// Functions that are compiled and run at the same time; as many as there are threads of the processor by default
    #[arg(long)]
    threads: Option<usize>,
    /// A file for the results: a line for each table and tier, with tabs between
    #[arg(long)]
    results: Option<PathBuf>,
}

fn tier(name: &str) -> Result<Precision, String> {
    let tiers = [Precision::Accurate, Precision::Extended, Precision::Double];
    let found = tiers.into_iter().find(|tier| tier.name() == name);
    found.ok_or_else(|| "accurate, extended or double".to_owned())
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<bool, Error> {
    let place = Place::open(options.of.adapter.as_deref().unwrap_or("auto"))?;
    println!("{place}\n");
    let mut tables = special();
    tables.retain(|table| table.name.contains(&options.of.only));
    let batches = batches(tables);
    let begun = Instant::now();
    let all = judge_all(options, &place, &tasks(&batches, &options.precision));
    let wrong: Vec<&Judged> = all.iter().filter(|j| j.problem.is_some()).collect();
    println!(
        "\n{} shaders for {} tables and tiers in {:.0} s, {} above what is declared or not judged",
        batches.len() * options.precision.len(),
        all.len(),
        begun.elapsed().as_secs_f64(),
        wrong.len()
    );
    for judged in &wrong {
        let reason = judged.problem.as_deref().unwrap_or("");
        println!("{}, {}: {reason}", judged.name, judged.precision.name());
    }
    if let Some(path) = &options.results {
        std::fs::write(path, lines(&all))?;
    }
    Ok(wrong.is_empty())
}

/// Every batch in every tier, what a driver compiles longest first.
fn tasks<'a>(batches: &'a [Batch], tiers: &[Precision]) -> Vec<(&'a Batch, Precision)> {
    let mut tasks: Vec<_> = batches
        .iter()
        .flat_map(|batch| tiers.iter().map(move |&tier| (batch, tier)))
        .collect();
    tasks.sort_by_cached_key(|(batch, tier)| std::cmp::Reverse(batch.size(*tier)));
    tasks
}

fn judge_all(options: &Options, place: &Place, tasks: &[(&Batch, Precision)]) -> Vec<Judged> {
    let (begun, limit) = (Instant::now(), Duration::from_secs(options.seconds));
    let available = std::thread::available_parallelism().map_or(4, usize::from);
    let (next, all) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..options.threads.unwrap_or(available).max(1) {
            scope.spawn(|| {
                while let Some((batch, tier)) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let judged = if begun.elapsed() < limit {
                        batch.judge(place, *tier)
                    } else {
                        batch.unreached(*tier, limit)
                    };
                    print!("{}", told(&judged));
                    if let Ok(mut all) = all.lock() {
                        all.extend(judged);
                    }
                }
            });
        }
    });
    all.into_inner().unwrap_or_default()
}

fn told(judged: &[Judged]) -> String {
    let mut text = String::new();
    for j in judged {
        let (value, slope) = (j.factors.value, j.factors.derivative);
        let _ = writeln!(
            text,
            "{}, {}: {value:.2}, {slope:.2} of {}, {:.1} s{}",
            j.name,
            j.precision.name(),
            j.most,
            j.seconds,
            if j.problem.is_some() { " WRONG" } else { "" }
        );
    }
    text
}

fn lines(all: &[Judged]) -> String {
    let head = [
        "table",
        "tier",
        "value",
        "derivative",
        "declared",
        "rows",
        "seconds",
        "problem",
        "worst",
    ];
    let mut text = head.join("\t") + "\n";
    for j in all {
        let plain = |words: &str| words.replace(['\t', '\n'], " ");
        let cells = [
            j.name.to_owned(),
            j.precision.name().to_owned(),
            j.factors.value.to_string(),
            j.factors.derivative.to_string(),
            j.most.to_string(),
            j.factors.rows.to_string(),
            format!("{:.2}", j.seconds),
            plain(j.problem.as_deref().unwrap_or("")),
            plain(&j.factors.worst),
        ];
        text += &(cells.join("\t") + "\n");
    }
    text
}
