//! The times of a run as text, and what has changed.

use std::io::{self, Write};

use pullback_runtime::bench::median;

use super::base::{Program, Run};
use super::mebibytes;

/// Writes milliseconds of every stage and picture, medians of the turns.
pub(super) fn tell(run: &Run) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    let names: Vec<&str> = run
        .pictures
        .first()
        .map(|program| {
            program
                .times
                .iter()
                .map(|case| case.name.as_str())
                .collect()
        })
        .unwrap_or_default();
    writeln!(
        out,
        "{}, {}x{}, {} turns; milliseconds, medians\n",
        run.adapter.as_deref().unwrap_or("the compiler alone"),
        run.width,
        run.height,
        run.calibration.len()
    )?;
    let width = run
        .pictures
        .iter()
        .map(|p| p.name.chars().count())
        .max()
        .unwrap_or(0)
        .max(6);
    write!(out, "{:<width$}", "")?;
    for name in &names {
        write!(out, " {name:>9}")?;
    }
    writeln!(out, " {:>9}", "compiled")?;
    for program in &run.pictures {
        line(
            &mut out,
            &program.name,
            width,
            &program
                .times
                .iter()
                .map(|c| median(&c.seconds))
                .collect::<Vec<_>>(),
        )?;
    }
    let all = |name: &str| {
        let one = |p: &Program| p.time(name).map(|case| median(&case.seconds));
        median(&run.pictures.iter().filter_map(one).collect::<Vec<_>>())
    };
    let medians: Vec<f64> = names.iter().map(|name| all(name)).collect();
    line(&mut out, "median", width, &medians)?;
    counts(&mut out, run, width)?;
    if let Some(bytes) = run.peak_host_bytes {
        writeln!(
            out,
            "\nmost memory of this process: {:.0} MiB",
            mebibytes(bytes)
        )?;
    }
    if let Some(bytes) = run.device_bytes {
        writeln!(
            out,
            "memory reserved on the device: {:.0} MiB",
            mebibytes(bytes)
        )?;
    }
    out.flush()
}

/// Instructions of the compiler, where they were counted.
fn counts(out: &mut dyn Write, run: &Run, width: usize) -> io::Result<()> {
    let counted = |p: &'_ Program| p.instructions.map(|count| (p.name.clone(), count));
    let all: Vec<(String, u64)> = run.pictures.iter().filter_map(counted).collect();
    if all.is_empty() {
        return Ok(());
    }
    writeln!(out, "\nmillions of instructions from the text to SPIR-V\n")?;
    for (name, count) in all {
        writeln!(out, "{name:<width$} {:>9.3}", 1e-6 * count as f64)?;
    }
    Ok(())
}

/// A line of milliseconds; the last column is the sum of the stages.
fn line(out: &mut dyn Write, name: &str, width: usize, seconds: &[f64]) -> io::Result<()> {
    write!(out, "{name:<width$}")?;
    for time in seconds {
        write!(out, " {:>9.3}", 1e3 * time)?;
    }
    let stages = pullback_runtime::bench::STAGES.len();
    writeln!(
        out,
        " {:>9.3}",
        1e3 * seconds.iter().take(stages).sum::<f64>()
    )
}

/// Writes what is slower or faster beyond doubt; gives how many are slower by more than so many percent.
pub(super) fn compare(base: &Run, run: &Run, fail_above: Option<f64>) -> io::Result<usize> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    let mut found = run.against(base);
    if base.adapter != run.adapter || (base.width, base.height) != (run.width, run.height) {
        writeln!(
            out,
            "\nThe earlier run had another adapter or size: pictures are left out."
        )?;
        found.retain(|(name, _)| !name.ends_with(" picture"));
    }
    found.sort_by(|a, b| b.1.value.total_cmp(&a.1.value));
    let total = found.len();
    let doubtless = |[low, high]: [f64; 2]| low > 1.0 || high < 1.0;
    let changed: Vec<_> = found
        .iter()
        .filter(|(_, ratio)| doubtless(ratio.range))
        .collect();
    writeln!(
        out,
        "\nAgainst the earlier run, by the speed that the machine had in each turn: {} of {total} times changed beyond doubt.",
        changed.len()
    )?;
    for (name, ratio) in &changed {
        let [low, high] = ratio.range;
        let word = if ratio.value > 1.0 {
            "slower"
        } else {
            "faster"
        };
        writeln!(
            out,
            "  {name:<32} {:.3}  ({low:.3} to {high:.3})  {word}",
            ratio.value
        )?;
    }
    out.flush()?;
    let limit = fail_above.map_or(f64::INFINITY, |percent| 1.0 + percent / 100.0);
    Ok(changed
        .iter()
        .filter(|(_, ratio)| ratio.range[0] > limit)
        .count())
}
