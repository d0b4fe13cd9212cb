//! Looks for texts that the parser or the compiler does not answer as it must.
//!
//!     cargo run --release -p pullback-tests --no-default-features --bin fuzz -- parse|compile
//!         [--seconds 600] [--seed 1] [--last FILE]
//!
//! Mutates every program that we have. What must hold is in `pullback_tests::holds`: no panic, places inside of the
//! text, an error where there is no program, printing and formatting that change nothing, an answer within
//! `LIMIT`. The first text that breaks this is printed, and the exit code is 1. `--last` keeps each text in a file
//! before it is tried, for a stack overflow that ends the process.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use pullback_tests::corpus::all_programs;
use pullback_tests::holds;
use pullback_tests::mutate::{Random, mutated};

/// Longest time for one text.
const LIMIT: Duration = Duration::from_secs(5);

/// Smallest stack that threads have by default.
const STACK: usize = 2 << 20;

#[derive(Clone, Copy, PartialEq)]
enum Target {
    Parse,
    Compile,
}

#[derive(Clone)]
struct Options {
    target: Target,
    seconds: u64,
    seed: u64,
    last: Option<String>,
}

fn options() -> Option<Options> {
    let mut arguments = std::env::args().skip(1);
    let target = match arguments.next()?.as_str() {
        "parse" => Target::Parse,
        "compile" => Target::Compile,
        _ => return None,
    };
    let mut out = Options {
        target,
        seconds: 600,
        seed: 1,
        last: None,
    };
    while let Some(name) = arguments.next() {
        let value = arguments.next()?;
        match name.as_str() {
            "--seconds" => out.seconds = value.parse().ok()?,
            "--seed" => out.seed = value.parse().ok()?,
            "--last" => out.last = Some(value),
            _ => return None,
        }
    }
    Some(out)
}

/// What is wrong with the answer to a text, if anything.
fn try_text(target: Target, bytes: &[u8], modules: bool) -> Option<String> {
    let start = Instant::now();
    let result = catch_unwind(AssertUnwindSafe(|| match target {
        Target::Parse => holds::parsing(bytes),
        Target::Compile => holds::compiling(bytes, modules),
    }));
    let took = start.elapsed();
    match result {
        Err(_) => Some("a panic".into()),
        Ok(Err(problem)) => Some(problem),
        Ok(Ok(())) if took > LIMIT => Some(format!("takes {took:?}")),
        Ok(Ok(())) => None,
    }
}

/// Runs until the time is over; the number of texts tried, and the first that failed.
fn run(options: &Options) -> (u64, Option<(Vec<u8>, String)>) {
    let corpus = all_programs();
    let mut random = Random::new(options.seed);
    let start = Instant::now();
    let mut count = 0;
    let mut minute = 1;
    while start.elapsed().as_secs() < options.seconds {
        let bytes = mutated(&corpus, &mut random);
        if let Some(file) = &options.last {
            let _ = std::fs::write(file, &bytes);
        }
        if let Some(problem) = try_text(options.target, &bytes, count % 50 == 0) {
            return (count, Some((bytes, problem)));
        }
        count += 1;
        if start.elapsed().as_secs() >= 60 * minute {
            println!("{minute} min: {count} texts");
            minute += 1;
        }
    }
    (count, None)
}

fn main() -> ExitCode {
    let Some(options) = options() else {
        eprintln!("usage: fuzz parse|compile [--seconds 600] [--seed 1] [--last FILE]");
        return ExitCode::from(2);
    };
    let worker = std::thread::Builder::new()
        .stack_size(STACK)
        .spawn(move || run(&options));
    let Some((count, found)) = worker.ok().and_then(|worker| worker.join().ok()) else {
        eprintln!("the fuzzer itself failed");
        return ExitCode::from(2);
    };
    println!("{count} texts");
    match found {
        None => ExitCode::SUCCESS,
        Some((bytes, problem)) => {
            println!(
                "failed: {problem}\n---\n{}\n---\n{bytes:?}",
                String::from_utf8_lossy(&bytes)
            );
            ExitCode::FAILURE
        }
    }
}
