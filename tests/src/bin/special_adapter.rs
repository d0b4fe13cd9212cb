//! Special functions on an adapter against tables of 60 digits, in one tier. The executable carries all that it needs.

use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use clap::Parser;
use pullback_compiler::lower::Precision;
use pullback_compiler::table::excess;
use pullback_runtime::{AdapterChoice, Error, Gpu};
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::accuracy::formulas::{MOST, Table, special};
use pullback_tests::special::{MOST_DOUBLE, MOST_EXTENDED};

/// The largest error of each special function on an adapter, as a multiple of the scale of its table. The exit code is 1
/// where one is above what is declared, or was not reached in time.
#[derive(Parser)]
struct Options {
    /// `auto`, `gpu`, `software`, or part of an adapter's name
    #[arg(long, default_value = "auto")]
    adapter: String,
    /// The tier
    #[arg(long, default_value = "accurate", value_parser = ["accurate", "extended", "double"])]
    precision: String,
    /// Only functions whose name contains this
    #[arg(long, default_value = "")]
    only: String,
    /// After this time no further function is begun
    #[arg(long, default_value_t = 50)]
    seconds: u64,
    /// Functions that are compiled and run at the same time
    #[arg(long, default_value_t = 4)]
    threads: usize,
}

impl Options {
    fn precision(&self) -> (Precision, f64) {
        match self.precision.as_str() {
            "extended" => (Precision::Extended, MOST_EXTENDED),
            "double" => (Precision::Double, MOST_DOUBLE),
            _ => (Precision::Accurate, MOST),
        }
    }
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
    let gpu = Gpu::open(&options.adapter.parse::<AdapterChoice>().unwrap_or_default())?;
    println!("{}, {}\n", gpu.adapter(), options.precision);
    let mut tables = special();
    tables.retain(|table| table.name.contains(&options.only));
    let (start, limit) = (Instant::now(), Duration::from_secs(options.seconds));
    let (next, wrong) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..options.threads.max(1) {
            scope.spawn(|| {
                while let Some(table) = tables.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let verdict = if start.elapsed() < limit {
                        judge(table, &gpu, options)
                    } else {
                        Err("no time is left".to_owned())
                    };
                    if let Err(reason) = verdict
                        && let Ok(mut wrong) = wrong.lock()
                    {
                        wrong.push(format!("{}: {reason}", table.name));
                    }
                }
            });
        }
    });
    let wrong = wrong.into_inner().unwrap_or_default();
    println!(
        "\n{} functions in {:.0} s, {} above what is declared or not judged",
        tables.len(),
        start.elapsed().as_secs_f64(),
        wrong.len()
    );
    for line in &wrong {
        println!("{line}");
    }
    Ok(wrong.is_empty())
}

/// Prints the factors of value and derivative; what is wrong in words.
fn judge(table: &Table, gpu: &Gpu, options: &Options) -> Result<(), String> {
    let (precision, most) = options.precision();
    let most = most.max(MOST * excess(table.name).0);
    let begun = Instant::now();
    let factors = table.measure(&Machine::Gpu(Box::new(gpu.clone()), precision))?;
    println!(
        "{}: {:.2}, {:.2} of {most}, {:.1} s",
        table.name,
        factors.value,
        factors.derivative,
        begun.elapsed().as_secs_f64()
    );
    if let Some(first) = factors.wrong.first() {
        return Err(first.clone());
    }
    if factors.rows < 8 {
        return Err(format!("only {} rows were judged", factors.rows));
    }
    if factors.value.max(factors.derivative) > most {
        return Err(format!("above {most}: {}", factors.worst));
    }
    Ok(())
}
