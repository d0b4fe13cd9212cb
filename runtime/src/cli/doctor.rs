//! `pullback doctor`

mod report;
mod words;

use std::io::{self, Write};
use std::time::Instant;

use clap::{Args, ValueEnum};
use pullback_compiler::What;
use pullback_compiler::lower::Precision;
use pullback_runtime::device;
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::{Capabilities, Error, Gpu, GpuEvaluator};

use super::Console;
use super::failure::Failure;
use report::{AdapterReport, Report, Trial};

/// Rows of the trial.
const ROWS: usize = 1 << 16;

/// Arguments of `pullback doctor`.
#[derive(Debug, Args)]
pub(super) struct DoctorArguments {
    /// Try the arithmetic of the adapters anew, whatever is known of them
    #[arg(long)]
    refresh: bool,
    /// How to write what is found
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people
    Human,
    /// For programs
    Json,
}

/// Says what there is, tries it, and says what is missing.
pub(super) fn run(arguments: &DoctorArguments, _console: &Console) -> Result<(), Failure> {
    let adapters = device::adapters();
    let reports = adapters
        .iter()
        .map(|adapter| AdapterReport::new(adapter, trial(adapter, arguments.refresh)))
        .collect();
    let report = Report::new(reports);
    let text = match arguments.format {
        Format::Human => words::text(&report),
        Format::Json => report.json(),
    };
    io::stdout()
        .write_all(text.as_bytes())
        .map_err(Failure::stdout)?;
    if !report.works() {
        return Err(Failure::Device(Error::NoAdapter {
            wanted: pullback_runtime::AdapterChoice::Auto,
            found: adapters.iter().map(device::summary).collect(),
        }));
    }
    Ok(())
}

/// Evaluates a formula on the adapter, compares, and tries the adapter's arithmetic.
fn trial(adapter: &wgpu::Adapter, refresh: bool) -> Result<Trial, Error> {
    let invalid = |reason: &str| Error::Invalid {
        reason: reason.into(),
    };
    let program = pullback_compiler::compile("x*y + 1")
        .program
        .ok_or_else(|| invalid("the trial formula does not compile"))?;
    let module = program
        .eval_module(0, What::Value, Precision::Accurate)
        .map_err(|_| invalid("the trial formula does not compile"))?;
    let start = Instant::now();
    let gpu = Gpu::from_adapter(adapter)?;
    let mut evaluator = GpuEvaluator::new(&gpu, &module)?;
    let ready_ms = milliseconds(start);
    let start = Instant::now();
    let rows: Vec<f32> = (0..2 * ROWS).map(|i| (i % 1024) as f32).collect();
    let mut results = Vec::new();
    evaluator.eval(Surroundings::default(), ROWS, &rows, &mut results)?;
    let rows_ms = milliseconds(start);
    let right = results.len() == ROWS
        && rows
            .as_chunks::<2>()
            .0
            .iter()
            .zip(&results)
            .all(|([x, y], result)| x * y + 1.0 == *result);
    if !right {
        return Err(invalid("the results are wrong"));
    }
    let start = Instant::now();
    let capabilities = if refresh {
        Capabilities::refresh(&gpu)?
    } else {
        Capabilities::of(&gpu)?
    };
    Ok(Trial {
        rows: ROWS,
        ready_ms,
        rows_ms,
        probe_ms: milliseconds(start),
        capabilities,
    })
}

fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
