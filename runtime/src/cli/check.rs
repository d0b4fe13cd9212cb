//! `pullback check`

use std::ffi::{OsStr, OsString};
use std::io::{self, Write};

use clap::{Args, ValueEnum};
use pullback_compiler::Program;
use pullback_compiler::lower::Precision;
use pullback_compiler::program::Outline;
use pullback_grammar::Diagnostic;

use super::failure::Failure;
use super::json::{FileReport, Report};
use super::source::Text;
use super::{Console, Input};

/// Arguments of `pullback check`.
#[derive(Debug, Args)]
pub(super) struct CheckArguments {
    #[command(flatten)]
    input: Input,
    /// More of them
    #[arg(value_name = "FILE|FORMULA")]
    more: Vec<OsString>,
    /// How to tell what is found
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people, on the standard error
    Human,
    /// For programs, on the standard output: one object, described in docs/diagnostics.md
    Json,
}

/// Compiles everything that the programs show, and says so.
pub(super) fn run(arguments: &CheckArguments, console: &Console) -> Result<(), Failure> {
    let inputs = || std::iter::once(&arguments.input.input).chain(&arguments.more);
    if inputs().filter(|input| *input == "-").count() > 1 {
        return Err(Failure::usage("the standard input can be read only once"));
    }
    let mut code = 0;
    let mut reports = Vec::new();
    for input in inputs() {
        let checked = match Checked::read(input) {
            Ok(checked) => checked,
            Err(failure) => {
                code = code.max(failure.report(console));
                continue;
            }
        };
        if checked.has_errors() {
            code = code.max(1);
        }
        match arguments.format {
            Format::Human => checked.tell(console)?,
            Format::Json => reports.push(checked.report()),
        }
    }
    if arguments.format == Format::Json {
        write_json(&Report::new(reports)).map_err(Failure::stdout)?;
    }
    match code {
        0 => Ok(()),
        1 => Err(Failure::Program),
        _ => Err(Failure::Data),
    }
}

fn write_json(report: &Report) -> io::Result<()> {
    let mut output = io::BufWriter::new(io::stdout().lock());
    serde_json::to_writer_pretty(&mut output, report)?;
    writeln!(output)?;
    output.flush()
}

/// An input with everything that was found in it.
struct Checked {
    name: String,
    text: String,
    diagnostics: Vec<Diagnostic>,
    outline: Outline,
    program: Option<Program>,
}

impl Checked {
    /// Compiles a program with the shaders of all its pictures.
    fn read(input: &OsStr) -> Result<Self, Failure> {
        let Text { name, bytes, .. } = Text::read(input)?;
        let compilation = pullback_compiler::compile_bytes(&bytes);
        let mut diagnostics = compilation.diagnostics;
        if let Some(program) = &compilation.program {
            for index in 0..program.pictures().len() {
                let made = program.scene_module(index, Precision::Accurate);
                diagnostics.extend(made.err().into_iter().flatten());
            }
        }
        Ok(Self {
            name,
            text: String::from_utf8_lossy(&bytes).into_owned(),
            diagnostics,
            outline: compilation.outline,
            program: compilation.program,
        })
    }

    fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// Tells people what was found, and what a program without errors shows.
    fn tell(&self, console: &Console) -> Result<(), Failure> {
        console.diagnostics(&self.diagnostics, &self.name, &self.text);
        if self.has_errors() {
            return Ok(());
        }
        let mut summary = format!("{}: ok", self.name);
        let warnings = self.diagnostics.len();
        if warnings > 0 {
            summary += &format!(
                ", {warnings} warning{}",
                if warnings == 1 { "" } else { "s" }
            );
        }
        let pictures = self.program.as_ref().map(Program::pictures);
        let scenes: Vec<&str> = pictures
            .unwrap_or_default()
            .iter()
            .map(|p| p.scene.name)
            .collect();
        if !scenes.is_empty() {
            summary += &format!(", shows {}", scenes.join(", "));
        }
        writeln!(io::stdout(), "{summary}").map_err(Failure::stdout)
    }

    fn report(&self) -> FileReport {
        FileReport::new(
            &self.name,
            &self.text,
            &self.diagnostics,
            &self.outline,
            self.program.as_ref(),
        )
    }
}
