//! Compares the golden pictures with those of a machine, and prints how they differ. The files, `docs/gallery` and
//! `tests/data/goldens`, are those of the tree it was compiled in, or of the current folder.

use std::process::ExitCode;

use clap::Parser;
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::{AdapterChoice, Gpu};
use pullback_tests::goldens::{self, CAP};
use pullback_tests::stills::Machine;

/// Differences of the golden pictures from those of a machine. The exit code is 1 where one is above the cap.
#[derive(Parser)]
struct Options {
    /// `auto`, `gpu`, `software`, or part of an adapter's name; `reference` or `ieee32` for the processor
    #[arg(long, default_value = "auto")]
    adapter: String,
    /// Only pictures whose name contains this
    #[arg(long, default_value = "")]
    only: String,
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

fn run(options: &Options) -> Result<bool, pullback_runtime::Error> {
    let machine = match options.adapter.as_str() {
        "reference" => Machine::Processor(Arithmetic::Reference),
        "ieee32" => Machine::Processor(Arithmetic::Ieee32),
        name => {
            let gpu = Gpu::open(&name.parse::<AdapterChoice>().unwrap_or_default())?;
            println!("{}\n", gpu.adapter());
            Machine::Adapter(gpu)
        }
    };
    println!("| picture | mean of FLIP | 99.9 % | greatest |\n| --- | --- | --- | --- |");
    let mut holds = true;
    for golden in goldens::all() {
        if !golden.name.contains(&options.only) {
            continue;
        }
        let picture = golden.draw(&golden.stills(|_| ()), &machine)?;
        let eye = golden.difference(&picture)?.perceptual;
        let verdict = if eye.mean > CAP {
            " **above the cap**"
        } else {
            ""
        };
        println!(
            "| {} | {:.6}{verdict} | {:.4} | {:.4} |",
            golden.name, eye.mean, eye.p999, eye.max
        );
        holds &= eye.mean <= CAP;
    }
    println!("\nThe cap of the mean is {CAP}.");
    Ok(holds)
}
