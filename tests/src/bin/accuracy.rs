//! Measures how accurate every formula of the gallery and of the library is on an adapter, and prints tables. All data is
//! in the binary. Single functions are judged by `pullback accuracy`.

use std::process::ExitCode;

use clap::Parser;
use pullback_compiler::lower::Precision;
use pullback_runtime::accuracy::report::Style;
use pullback_runtime::{AdapterChoice, Gpu};
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::accuracy::formulas::{gallery, library};
use pullback_tests::accuracy::report::{Report, formulas};

/// Errors of every formula of the gallery and of the library, in units of the errors of its roundings, against
/// references of high precision.
#[derive(Parser)]
struct Options {
    /// `auto`, `gpu`, `software`, or part of an adapter's name; `reference` for the f64 evaluator
    #[arg(long, default_value = "auto")]
    adapter: String,
    /// Prints tables of Markdown
    #[arg(long)]
    markdown: bool,
}

fn main() -> ExitCode {
    let options = Options::parse();
    let machine = if options.adapter == "reference" {
        Machine::Reference
    } else {
        let choice: AdapterChoice = options.adapter.parse().unwrap_or_default();
        match Gpu::open(&choice) {
            Ok(gpu) => {
                println!("{}\n", gpu.adapter());
                Machine::Gpu(Box::new(gpu), Precision::Accurate)
            }
            Err(error) => {
                eprintln!("{error}");
                return ExitCode::FAILURE;
            }
        }
    };
    let reports = [
        ("Gallery", formulas(&gallery(), &machine)),
        ("Vectors and the library", formulas(&library(), &machine)),
    ];
    let (mark, style) = if options.markdown {
        ("#### ", Style::Markdown)
    } else {
        ("", Style::Text)
    };
    for (title, report) in &reports {
        println!("{mark}{title}\n\n{}", report.table.text(style));
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
