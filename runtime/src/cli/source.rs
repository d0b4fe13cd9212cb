//! The program on the command line: read, compiled, its diagnostics told.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use pullback_compiler::Program;
use pullback_grammar::ast::MAX_SOURCE_BYTES;
use pullback_grammar::{Diagnostic, Span};
use pullback_runtime::Error;

use super::failure::Failure;
use super::{Console, Input, Rules, Which};

/// A program and the text that it comes from.
pub(super) struct Source {
    /// What to call it in messages.
    pub(super) name: String,
    /// Its text; what is not UTF-8 is replaced.
    pub(super) text: String,
    /// For the name of an output file: that of the input without folder and ending.
    pub(super) stem: String,
    /// The meaning.
    pub(super) program: Program,
}

impl Source {
    /// Reads and compiles the input, and tells its diagnostics.
    ///
    /// A program with errors is a [`Failure::Program`].
    pub(super) fn open(input: &Input, console: &Console) -> Result<Self, Failure> {
        Self::compiled(Text::read(&input.input)?, console)
    }

    /// Compiles what has been read, and tells its diagnostics.
    ///
    /// A program with errors is a [`Failure::Program`].
    pub(super) fn compiled(text: Text, console: &Console) -> Result<Self, Failure> {
        let Text { name, stem, bytes } = text;
        let compilation = pullback_compiler::compile_bytes(&bytes);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        console.diagnostics(&compilation.diagnostics, &name, &text);
        let errors = count(&compilation.diagnostics);
        match compilation.program {
            Some(program) if errors == 0 => Ok(Self {
                name,
                text,
                stem,
                program,
            }),
            _ => Err(Failure::Program),
        }
    }

    /// The program with these stability rewrites.
    pub(super) fn with_rewrites(mut self, rules: Rules) -> Self {
        self.program = self.program.with_rewrites(rules.rewrites);
        self
    }

    /// Index of the picture that is meant; the first if none is named.
    pub(super) fn picture(&self, which: Which, console: &Console) -> Result<usize, Failure> {
        let count = self.program.pictures().len();
        match which.show {
            None => {
                if count > 1 {
                    console.note(&format!(
                        "taking the first of {count} pictures; choose with --show"
                    ));
                }
                Ok(0)
            }
            Some(n) if (1..=count).contains(&n) => Ok(n - 1),
            Some(n) => Err(Failure::usage(format!(
                "--show {n}: this program has {count} picture{}",
                if count == 1 { "" } else { "s" }
            ))),
        }
    }

    /// Passes on what a later stage of the compiler made, or tells its diagnostics.
    pub(super) fn expect<T>(
        &self,
        made: Result<T, Vec<Diagnostic>>,
        console: &Console,
    ) -> Result<T, Failure> {
        made.map_err(|diagnostics| {
            console.diagnostics(&diagnostics, &self.name, &self.text);
            Failure::Program
        })
    }

    /// A failure while the program ran; one that a loop of the text is to blame for is told at its place.
    pub(super) fn blamed(&self, failure: Failure, console: &Console) -> Failure {
        let Failure::Device(Error::Executor(fault)) = &failure else {
            return failure;
        };
        let Some(place) = fault.in_formula() else {
            return failure;
        };
        let span = Span::new(place.start as u32, place.end as u32);
        let told = Diagnostic::error("too-many-steps", span, fault.to_string())
            .with_label("this loop takes most of them");
        console.diagnostics(&[told], &self.name, &self.text);
        Failure::Program
    }
}

fn count(diagnostics: &[Diagnostic]) -> usize {
    diagnostics.iter().filter(|d| d.is_error()).count()
}

/// An input as it was read.
pub(super) struct Text {
    /// What to call it in messages.
    pub(super) name: String,
    /// For the name of an output file: that of the input without folder and ending.
    pub(super) stem: String,
    /// What it holds, which may be no text.
    pub(super) bytes: Vec<u8>,
}

impl Text {
    /// Reads a file, the standard input for `-`, or takes the argument itself for a formula.
    pub(super) fn read(input: &OsStr) -> Result<Self, Failure> {
        if input == "-" {
            return Self::standard_input();
        }
        let path = Path::new(input);
        if is_file(path) {
            return Self::file(path);
        }
        Ok(Self {
            name: "formula".into(),
            stem: "pullback".into(),
            bytes: input.as_encoded_bytes().to_vec(),
        })
    }

    /// Reads the standard input.
    pub(super) fn standard_input() -> Result<Self, Failure> {
        let bytes = limited(io::stdin()).map_err(|error| Failure::Io {
            what: "standard input".into(),
            error,
        })?;
        Ok(Self {
            name: "standard input".into(),
            stem: "pullback".into(),
            bytes,
        })
    }

    /// Reads a file.
    pub(super) fn file(path: &Path) -> Result<Self, Failure> {
        let name = path.to_string_lossy().into_owned();
        let bytes = File::open(path)
            .and_then(limited)
            .map_err(|error| Failure::Io {
                what: name.clone(),
                error,
            })?;
        let stem = path.file_stem().map_or_else(
            || "pullback".into(),
            |stem| stem.to_string_lossy().into_owned(),
        );
        Ok(Self { name, stem, bytes })
    }
}

/// Whether an argument names a file: it exists, or says that it should. A folder counts if it is written like one,
/// because `e` may be a folder here and is a formula.
fn is_file(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "pull")
        || path.is_file()
        || (path.is_dir() && path.components().count() > 1)
}

/// No more than shows the compiler that it is too much.
fn limited(input: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    input
        .take(MAX_SOURCE_BYTES as u64 + 1)
        .read_to_end(&mut bytes)?;
    Ok(bytes)
}
