//! Special functions on an adapter against tables of 60 digits, in every tier. The executable carries all that it needs.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, mpsc};
use std::time::{Duration, Instant};

use clap::Parser;
use pullback_compiler::lower::Precision;
use pullback_runtime::Error;
use pullback_tests::accuracy::formulas::{Table, special};
use pullback_tests::special_batches::{Batch, Judged, Place, batches};
use pullback_tests::special_record::{Record, wanted};

/// The largest error of each special function on an adapter, as a multiple of the scale of its table. The exit code is 1
/// where one is above what is declared, or was not judged in time.
#[derive(Parser)]
struct Options {
    /// `auto`, `gpu`, `software`, or part of an adapter's name; `ieee32` is the processor, by the shaders of the tiers, `left` and
    /// `right` the processor with products fused into sums
    #[arg(long, default_value = "auto")]
    adapter: String,
    /// Only these tables, with commas between: the table of this name, or else all whose names contain it
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
    /// Tiers, with commas between
    #[arg(long, default_value = "accurate,extended,double", value_delimiter = ',', value_parser = tier)]
    precision: Vec<Precision>,
    /// After this time it ends: what a driver still compiles is left out
    #[arg(long, default_value_t = 240)]
    seconds: u64,
    /// Functions that are compiled and run at the same time; as many as there are threads of the processor by default
    #[arg(long)]
    threads: Option<usize>,
    /// A file for the results, a line for each table and tier as soon as it is judged. What is in it already from this adapter
    /// is judged last
    #[arg(long)]
    results: Option<PathBuf>,
    /// Names of the tables, in the order in which they would be judged, and nothing else
    #[arg(long)]
    list: bool,
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

/// A batch in a tier.
type Task = (Batch, Precision);

fn run(options: &Options) -> Result<bool, Error> {
    let begun = Instant::now();
    let place = Place::open(&options.adapter)?;
    println!("{place}\n");
    let record = Record::read(options.results.as_deref(), &place.to_string())?;
    let mut tables = special();
    let names: Vec<&str> = tables.iter().map(|table| table.name).collect();
    let chosen = wanted(&names, &options.only);
    tables.retain(|table| chosen.contains(table.name));
    let tasks = in_order(tables, &options.precision, &record);
    if options.list {
        for (batch, tier) in &tasks {
            println!("{}: {}", tier.name(), batch.names().join(", "));
        }
        return Ok(true);
    }
    judge_all(options, place, tasks, &record, begun)
}

/// Every batch in every tier: those first that have tables of which the record knows nothing, tier by tier in turn, and of a tier
/// what a driver compiles in the shortest time, so that most is known when the time is over.
fn in_order(tables: Vec<Table>, tiers: &[Precision], record: &Record) -> Vec<Task> {
    let mut tasks = Vec::new();
    for &tier in tiers {
        let (judged, new): (Vec<Table>, Vec<Table>) = tables
            .iter()
            .cloned()
            .partition(|table| record.has(table.name, tier));
        for (seen, tables) in [(false, new), (true, judged)] {
            let mut of_tier = batches(tables);
            of_tier.sort_by_cached_key(|batch| batch.size(tier));
            let ranked = of_tier.into_iter().enumerate();
            tasks.extend(ranked.map(|(rank, batch)| ((seen, rank), (batch, tier))));
        }
    }
    tasks.sort_by_key(|(rank, _)| *rank);
    tasks.into_iter().map(|(_, task)| task).collect()
}

/// Judges until the time is over, and tells of each table at once.
fn judge_all(
    options: &Options,
    place: Place,
    tasks: Vec<Task>,
    record: &Record,
    begun: Instant,
) -> Result<bool, Error> {
    let limit = Duration::from_secs(options.seconds);
    let available = std::thread::available_parallelism().map_or(4, usize::from);
    let threads = options.threads.unwrap_or(available).max(1);
    let all: usize = tasks.iter().map(|(batch, _)| batch.names().len()).sum();
    let results = start(place, tasks, threads, begun + limit);
    let mut judged: Vec<Judged> = Vec::new();
    // no wait for a driver that compiles on: the process ends with the time
    while let Ok(batch) = results.recv_timeout(limit.saturating_sub(begun.elapsed())) {
        for j in &batch {
            println!("{j}");
        }
        record.add(&batch)?;
        judged.extend(batch);
    }
    let wrong: Vec<&Judged> = judged.iter().filter(|j| j.problem.is_some()).collect();
    println!(
        "\n{} of {all} tables and tiers in {:.0} s, {} above what is declared",
        judged.len(),
        begun.elapsed().as_secs_f64(),
        wrong.len()
    );
    for j in &wrong {
        let reason = j.problem.as_deref().unwrap_or("");
        println!("{}, {}: {reason}", j.name, j.precision.name());
    }
    Ok(wrong.is_empty() && judged.len() == all)
}

/// Threads that judge one task after another, and where their results arrive.
fn start(
    place: Place,
    tasks: Vec<Task>,
    threads: usize,
    end: Instant,
) -> mpsc::Receiver<Vec<Judged>> {
    let shared = Arc::new((place, tasks, AtomicUsize::new(0)));
    let (sender, results) = mpsc::channel();
    for _ in 0..threads {
        let (shared, sender) = (Arc::clone(&shared), sender.clone());
        std::thread::spawn(move || {
            let (place, tasks, next) = &*shared;
            while let Some((batch, tier)) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
                if Instant::now() >= end || sender.send(batch.judge(place, *tier)).is_err() {
                    break;
                }
            }
        });
    }
    results
}
