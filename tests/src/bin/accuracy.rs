//! Measures how accurate every function and formula is on an adapter, and prints tables. All data is in the binary.

use std::process::ExitCode;

use clap::Parser;
use pullback_compiler::lower::Precision;
use pullback_runtime::{AdapterChoice, Gpu};
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::accuracy::formulas::{gallery, library};
use pullback_tests::accuracy::report::{Report, formulas, functions, raw};
use pullback_tests::accuracy::subjects::subjects;

/// Errors of every function in units in the last place, and of every formula of the gallery in units of the errors
/// of its roundings, against references of high precision.
#[derive(Parser)]
struct Options {
    /// `auto`, `gpu`, `software`, or part of an adapter's name; `reference` for the f64 evaluator
    #[arg(long, default_value = "auto")]
    adapter: String,
    /// Prints tables of Markdown
    #[arg(long)]
    markdown: bool,
    /// Prints the largest errors by component, by norm and by unit, from which bounds are declared
    #[arg(long)]
    raw: bool,
}

fn main() -> ExitCode {
    let options = Options::parse();
    let (machine, builtins) = if options.adapter == "reference" {
        (Machine::Reference, None)
    } else {
        let choice: AdapterChoice = options.adapter.parse().unwrap_or_default();
        match Gpu::open(&choice) {
            Ok(gpu) => {
                println!("{}\n", gpu.adapter());
                let gpu = Box::new(gpu);
                let builtins = Machine::Gpu(gpu.clone(), Precision::Fast);
                (Machine::Gpu(gpu, Precision::Accurate), Some(builtins))
            }
            Err(error) => {
                eprintln!("{error}");
                return ExitCode::FAILURE;
            }
        }
    };
    if options.raw {
        print!("{}", raw(&subjects(), &machine));
        return ExitCode::SUCCESS;
    }
    let reports = [
        (
            "Functions, in ulp",
            functions(&subjects(), &machine, builtins.as_ref()),
        ),
        ("Gallery", formulas(&gallery(), &machine)),
        ("Vectors and the library", formulas(&library(), &machine)),
    ];
    for (title, report) in &reports {
        let mark = if options.markdown { "#### " } else { "" };
        println!("{mark}{title}\n\n{}", report.text(options.markdown));
    }
    verdict(reports.iter().map(|(_, report)| report))
}

fn verdict<'a>(reports: impl Iterator<Item = &'a Report>) -> ExitCode {
    let broken: Vec<&String> = reports.flat_map(|r| &r.broken).collect();
    if broken.is_empty() {
        println!("Every bound holds.");
        return ExitCode::SUCCESS;
    }
    println!("{} bounds do not hold:", broken.len());
    for line in broken {
        println!("- {line}");
    }
    ExitCode::FAILURE
}
