//! Several pictures as a table in Markdown, one line each.

use std::ffi::OsStr;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use pullback_runtime::measure::Report;
use pullback_runtime::{Size, atomic_file};

use super::table::brief;
use crate::cli::failure::Failure;
use crate::cli::render::name;

/// The table, as it grows: on the standard output, and in a file if there is one.
pub(in crate::cli) struct Table {
    text: String,
    file: Option<PathBuf>,
}

impl Table {
    /// With the lines that the file has, if it was begun with the same head.
    pub(in crate::cli) fn open(head: String, file: Option<&Path>) -> Result<Self, Failure> {
        let mut text = head;
        if let Some(path) = file {
            match std::fs::read_to_string(path) {
                Ok(found) if found.starts_with(&text) => text = found,
                Ok(_) => {
                    return Err(Failure::usage_hint(
                        format!("{} is no table of this adapter and size", name(path)),
                        "name another file, or remove it",
                    ));
                }
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => {
                    return Err(Failure::Io {
                        what: name(path),
                        error,
                    });
                }
            }
        }
        print(&text).map_err(Failure::stdout)?;
        Ok(Self {
            text,
            file: file.map(Path::to_owned),
        })
    }

    /// Whether it has the line of a program with this label.
    pub(in crate::cli) fn has(&self, label: &str) -> bool {
        let first = format!("| {label} |");
        self.text.lines().any(|line| line.starts_with(&first))
    }

    /// All of it.
    pub(in crate::cli) fn text(&self) -> &str {
        &self.text
    }

    /// Adds a line.
    pub(in crate::cli) fn add(&mut self, row: &str) -> Result<(), Failure> {
        self.text += row;
        print(row).map_err(Failure::stdout)?;
        let Some(path) = &self.file else {
            return Ok(());
        };
        atomic_file::write_text(path, &self.text).map_err(|error| Failure::Io {
            what: name(path),
            error,
        })
    }
}

fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()
}

/// What a line calls a program: a file by its name without folder and ending, a formula by its text.
pub(super) fn label(input: &OsStr) -> String {
    let path = Path::new(input);
    let is_file = path.extension().is_some_and(|ending| ending == "pull") || path.exists();
    let shown = if is_file { path.file_stem() } else { None };
    let shown = shown.unwrap_or(input).to_string_lossy();
    shown.replace('|', "\\|").replace('\n', " ")
}

/// The head of the table.
pub(in crate::cli) fn head(adapter: &str, size: Size) -> String {
    format!(
        "{adapter}\n\n{}x{} pixels in linear light; times of the choices are relative to the default's\n\n\
         | picture | default, ms | its error | not to be told from the truth | time | error | at most half the time | time | error |\n\
         | --- | ---: | ---: | --- | ---: | ---: | --- | ---: | ---: |\n",
        size.width, size.height
    )
}

/// The line of one picture.
pub(super) fn row(label: &str, report: &Report) -> String {
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
    format!(
        "| {} | {} | {} | {} | {} |\n",
        label,
        number(time(0).map(|seconds| 1e3 * seconds)),
        number(error(0)),
        choice(report.advice.unseen),
        choice(report.advice.half)
    )
}
