//! Closed forms of integrals along rays against the march, and against the rule of Gauss and Legendre, that are as
//! right: a table in Markdown. The executable carries all that it needs.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use pullback_runtime::{AdapterChoice, Error, Gpu};
use pullback_tests::marches::densities::{DENSITIES, Density};
use pullback_tests::marches::{FLOOR, FRAME, Measured, Plan, Rival, fineness, measure};

/// The marks around the table in the document.
const BEGIN: &str = concat!(
    "<!-- speed: `cargo run -p pullback-tests --bin marches -- --adapter software --markdown ",
    "docs/integrals.md` -->\n"
);
const END: &str = "<!-- end of the speed -->\n";

/// Frame times of closed forms of integrals against those of a march and of Gauss quadrature at equal error.
#[derive(Parser)]
struct Options {
    /// `auto`, `gpu`, `software`, or part of an adapter's name
    #[arg(long, default_value = "auto")]
    adapter: String,
    /// A file whose text between the marks of the table is replaced, beside what is printed
    #[arg(long)]
    markdown: Option<PathBuf>,
    /// Only densities whose name contains this
    #[arg(long, default_value = "")]
    only: String,
    /// Errors are taken on every so manyth pixel of every so manyth row
    #[arg(long, default_value = "10", value_parser = ["5", "10", "20", "40"])]
    stride: String,
    /// March and Gauss quadrature need not be better than this part of the integral of |f|
    #[arg(long, default_value_t = FLOOR)]
    floor: f64,
    /// Seconds of timed turns of a density
    #[arg(long, default_value_t = 2.0)]
    seconds: f64,
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
    let page = match &options.markdown {
        Some(path) => Some((path, std::fs::read_to_string(path)?)),
        None => None,
    };
    let gpu = Gpu::open(&options.adapter.parse::<AdapterChoice>().unwrap_or_default())?;
    let plan = Plan {
        stride: options.stride.parse().unwrap_or(10),
        floor: options.floor,
        seconds: options.seconds,
    };
    let mut table = format!(
        "\n{}, {}x{} rays:\n\n\
         | density | formula | error | time, ms | steps | error | march | nodes | error | Gauss |\n\
         | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
        gpu.adapter().name,
        fineness(&gpu) * FRAME.width,
        fineness(&gpu) * FRAME.height
    );
    print!("{table}");
    for density in DENSITIES.iter().filter(|d| d.name.contains(&options.only)) {
        let row = row(density, &measure(density, &gpu, &plan)?);
        print!("{row}");
        table += &row;
    }
    page.map_or(Ok(()), |(path, page)| replace(path, &page, &table))
}

fn row(density: &Density, measured: &Measured) -> String {
    format!(
        "| {} | `{}` | {:.0e} | {:.3} | {} | {} |\n",
        density.name,
        density.formula,
        measured.error,
        measured.seconds * 1e3,
        told(&measured.march),
        told(&measured.gauss)
    )
}

/// Order, error and ratio of times; order and ratio are lower bounds where the error was not reached.
fn told(rival: &Rival) -> String {
    let over = if rival.reached { "" } else { "> " };
    let digits = usize::from(rival.ratio < 10.0);
    format!(
        "{over}{} | {:.0e} | {over}{:.*}",
        rival.order, rival.error, digits, rival.ratio
    )
}

/// Writes the table between the marks.
fn replace(path: &Path, page: &str, table: &str) -> Result<(), Error> {
    let between = page.split_once(BEGIN).and_then(|(before, rest)| {
        let (_, after) = rest.split_once(END)?;
        Some((before, after))
    });
    let Some((before, after)) = between else {
        return Err(Error::Invalid {
            reason: format!("{}: no marks of the table", path.display()),
        });
    };
    Ok(std::fs::write(
        path,
        format!("{before}{BEGIN}{table}\n{END}{after}"),
    )?)
}
