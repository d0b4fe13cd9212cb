//! Looks for texts that the parser or the compiler does not answer as it must.
//!
//!     cargo run --release -p pullback-tests --no-default-features --bin fuzz -- parse|compile|fmt
//!         [--seconds 600] [--seed 1] [--failures 1] [--last FILE] [--text FILE]
//!
//! Mutates every program that we have. What must hold is in `pullback_tests::holds`: no panic, places inside of the
//! text, an error where there is no program, printing and formatting that change nothing (`fmt`: nor the values), an
//! answer within `LIMIT` and `MEMORY`. A text that breaks this is made as small as it can be and printed, and the exit
//! code is 1; after `--failures` of them the fuzzer stops. At the end the text that took the most memory is printed.
//! `--last` keeps each text in a file before it is tried, for a stack overflow that ends the process; `--text` tries
//! the text of a file alone.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use cpu_time::ThreadTime;
use peak_alloc::PeakAlloc;
use pullback_tests::corpus::all_programs;
use pullback_tests::mutate::{Random, mutated, smallest};
use pullback_tests::{formatting, holds};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Longest time for one text, of the processor: other work on the machine does not count.
const LIMIT: Duration = Duration::from_secs(5);

/// Most memory for one text, in bytes beyond what was taken before. A graph of the greatest size takes about 670 MiB.
const MEMORY: usize = 1 << 30;

/// Longest time in which a text that fails is made smaller.
const SHRINKING: Duration = Duration::from_secs(20);

/// Smallest stack that threads have by default.
const STACK: usize = 2 << 20;

#[derive(Clone, Copy, PartialEq)]
enum Target {
    Parse,
    Compile,
    Format,
}

#[derive(Clone)]
struct Options {
    target: Target,
    seconds: u64,
    seed: u64,
    failures: usize,
    last: Option<String>,
    text: Option<String>,
}

fn options() -> Option<Options> {
    let mut arguments = std::env::args().skip(1);
    let target = match arguments.next()?.as_str() {
        "parse" => Target::Parse,
        "compile" => Target::Compile,
        "fmt" => Target::Format,
        _ => return None,
    };
    let mut out = Options {
        target,
        seconds: 600,
        seed: 1,
        failures: 1,
        last: None,
        text: None,
    };
    while let Some(name) = arguments.next() {
        let value = arguments.next()?;
        match name.as_str() {
            "--seconds" => out.seconds = value.parse().ok()?,
            "--seed" => out.seed = value.parse().ok()?,
            "--failures" => out.failures = value.parse().ok()?,
            "--last" => out.last = Some(value),
            "--text" => out.text = Some(value),
            _ => return None,
        }
    }
    Some(out)
}

/// What is wrong with the answer to a text, if anything; and the bytes that it took at its greatest.
fn try_text(target: Target, bytes: &[u8], modules: bool) -> (Option<String>, usize) {
    let start = ThreadTime::now();
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let result = catch_unwind(AssertUnwindSafe(|| match target {
        Target::Parse => holds::parsing(bytes),
        Target::Compile => holds::compiling(bytes, modules),
        Target::Format => match std::str::from_utf8(bytes) {
            Ok(text) => formatting::tree(text).and_then(|()| formatting::evaluation(text)),
            Err(_) => Ok(()),
        },
    }));
    let memory = ALLOCATOR.peak_usage().saturating_sub(before);
    let took = start.elapsed();
    let problem = match result {
        Err(_) => Some("a panic".into()),
        Ok(Err(problem)) => Some(problem),
        Ok(Ok(())) if took > LIMIT => Some(format!("takes {took:?}")),
        Ok(Ok(())) if memory > MEMORY => Some(format!("takes {} MiB", memory >> 20)),
        Ok(Ok(())) => None,
    };
    (problem, memory)
}

/// What came of it.
#[derive(Default)]
struct Outcome {
    /// Number of texts tried.
    count: u64,
    /// Number of texts that failed.
    failures: usize,
    /// The text that took the most memory, and the bytes that it took.
    greatest: (Vec<u8>, usize),
}

/// Tries the text of a file.
fn run_alone(options: &Options, file: &str) -> Outcome {
    let bytes = std::fs::read(file).unwrap_or_default();
    let (problem, memory) = try_text(options.target, &bytes, true);
    if let Some(problem) = &problem {
        tell(options.target, &bytes, problem);
    }
    Outcome {
        count: 1,
        failures: usize::from(problem.is_some()),
        greatest: (bytes, memory),
    }
}

/// Prints a text that failed, as small as it can be made, and why.
fn tell(target: Target, bytes: &[u8], problem: &str) {
    // the same problem: what is said before the texts in it
    let kind = |problem: &str| {
        problem
            .split(['\n', ':', '{', '"'])
            .next()
            .map(str::to_owned)
    };
    let start = Instant::now();
    let small = smallest(bytes, |smaller| {
        let again = (start.elapsed() < SHRINKING).then(|| try_text(target, smaller, true).0);
        again
            .flatten()
            .is_some_and(|again| kind(&again) == kind(problem))
    });
    let (again, _) = try_text(target, &small, true);
    let problem = again.as_deref().unwrap_or(problem);
    let text = String::from_utf8_lossy(&small);
    println!("failed: {problem}\n---\n{text}\n---\n{small:?}");
}

/// Runs until the time is over, or to the last failure.
fn run(options: &Options) -> Outcome {
    if let Some(file) = &options.text {
        return run_alone(options, file);
    }
    let corpus = all_programs();
    let mut random = Random::new(options.seed);
    let start = Instant::now();
    let mut outcome = Outcome::default();
    let mut minute = 1;
    while start.elapsed().as_secs() < options.seconds {
        let bytes = mutated(&corpus, &mut random);
        if let Some(file) = &options.last {
            let _ = std::fs::write(file, &bytes);
        }
        let (problem, memory) = try_text(options.target, &bytes, outcome.count % 50 == 0);
        if memory > outcome.greatest.1 {
            outcome.greatest = (bytes.clone(), memory);
        }
        if let Some(problem) = problem {
            tell(options.target, &bytes, &problem);
            outcome.failures += 1;
            if outcome.failures >= options.failures {
                break;
            }
        }
        outcome.count += 1;
        if start.elapsed().as_secs() >= 60 * minute {
            println!("{minute} min: {} texts", outcome.count);
            minute += 1;
        }
    }
    outcome
}

/// Tells what came of it.
fn report(outcome: &Outcome) -> ExitCode {
    println!("{} texts", outcome.count);
    let (bytes, memory) = &outcome.greatest;
    println!(
        "worst memory: {:.1} MiB by input\n---\n{}\n---",
        *memory as f64 / f64::from(1 << 20),
        String::from_utf8_lossy(bytes)
    );
    if outcome.failures == 0 {
        ExitCode::SUCCESS
    } else {
        println!("{} failed", outcome.failures);
        ExitCode::FAILURE
    }
}

fn main() -> ExitCode {
    let Some(options) = options() else {
        eprintln!(
            "usage: fuzz parse|compile|fmt [--seconds 600] [--seed 1] [--failures 1] [--last FILE] [--text FILE]"
        );
        return ExitCode::from(2);
    };
    let worker = std::thread::Builder::new()
        .stack_size(STACK)
        .spawn(move || run(&options));
    match worker.map(std::thread::JoinHandle::join) {
        Ok(Ok(outcome)) => report(&outcome),
        _ => {
            eprintln!("the fuzzer itself failed");
            ExitCode::from(2)
        }
    }
}
