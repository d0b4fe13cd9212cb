//! Several pictures as a table in Markdown, one line each.

use std::io::{self, Write};
use std::path::Path;

use pullback_runtime::Size;
use pullback_runtime::measure::Report;

use super::table::brief;

/// Writes the head of the table.
pub(super) fn head(adapter: &str, size: Size) -> io::Result<()> {
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "{adapter}\n\n{}x{} pixels in linear light; times of the choices are relative to the default's\n",
        size.width, size.height
    )?;
    writeln!(
        out,
        "| picture | default, ms | its error | not to be told from the truth | time | error | at most half the time | time | error |\n\
         | --- | ---: | ---: | --- | ---: | ---: | --- | ---: | ---: |"
    )
}

/// Writes the line of one picture.
pub(super) fn row(name: &str, report: &Report) -> io::Result<()> {
    let stem = Path::new(name)
        .file_stem()
        .map_or(name.into(), |s| s.to_string_lossy());
    let time = |k: usize| {
        report
            .rows
            .get(k)
            .and_then(|row| row.time)
            .map(|t| t.median)
    };
    let error = |k: usize| {
        report
            .rows
            .get(k)
            .and_then(|row| row.error)
            .map(|e| e.seen.mean)
    };
    let number = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), brief);
    let choice = |k: Option<usize>| match k {
        Some(k) => {
            let ratio = time(k).zip(time(0)).map(|(here, default)| here / default);
            format!(
                "{} | {} | {}",
                report.rows[k].name,
                number(ratio),
                number(error(k))
            )
        }
        None => "none | |".to_owned(),
    };
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "| {stem} | {} | {} | {} | {} |",
        number(time(0).map(|seconds| 1e3 * seconds)),
        number(error(0)),
        choice(report.advice.unseen),
        choice(report.advice.half)
    )
}
