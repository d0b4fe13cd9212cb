//! `pullback fmt`

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use pullback_compiler::check::is_builtin_function;
use pullback_grammar::{Diagnostic, Parsed, format, parse, parse_bytes, same_tree};
use pullback_runtime::atomic_file::write_text;
use similar::TextDiff;

use super::Console;
use super::failure::Failure;
use super::source::Text;

/// Lines of a difference that are shown.
const SHOWN: usize = 20;

/// Arguments of `pullback fmt`.
#[derive(Debug, Args)]
pub(super) struct FmtArguments {
    /// The files; - is the standard input, which is formatted to the standard output, as it is where no file is named
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Change nothing; list the files that are not in the canonical format, and exit with 1 if there are any
    #[arg(long)]
    check: bool,
}

/// Formats every file; goes on behind one that cannot be formatted.
pub(super) fn run(arguments: &FmtArguments, console: &Console) -> Result<(), Failure> {
    let standard_input = [PathBuf::from("-")];
    let files = if arguments.files.is_empty() {
        if io::stdin().is_terminal() {
            return Err(Failure::usage_hint(
                "no files to format",
                "name files, or - for the standard input",
            ));
        }
        &standard_input[..]
    } else {
        &arguments.files
    };
    let mut code = 0;
    for path in files {
        if let Err(failure) = file(path, arguments.check, console) {
            code = code.max(failure.report(console));
        }
    }
    match code {
        0 => Ok(()),
        1 => Err(Failure::Program),
        _ => Err(Failure::Data),
    }
}

/// Formats or checks one file.
fn file(path: &Path, check: bool, console: &Console) -> Result<(), Failure> {
    let is_stream = path == Path::new("-");
    let text = if is_stream {
        Text::standard_input()?
    } else {
        Text::file(path)?
    };
    let Text { name, bytes, .. } = text;
    let (old, new) = formatted(&name, &bytes, console)?;
    let is_same = old == new;
    if check {
        if is_same {
            return Ok(());
        }
        console.note(&difference(&name, &old, &new));
        writeln!(io::stdout(), "{name}").map_err(Failure::stdout)?;
        return Err(Failure::Program);
    }
    if is_stream {
        return io::stdout()
            .write_all(new.as_bytes())
            .map_err(Failure::stdout);
    }
    if is_same {
        return Ok(());
    }
    write_text(path, &new).map_err(|error| Failure::Io {
        what: name.clone(),
        error,
    })?;
    console.note(&format!("{name}: formatted"));
    Ok(())
}

/// The text of a file and its canonical text, which has been read again: it has the same tree.
fn formatted(name: &str, bytes: &[u8], console: &Console) -> Result<(String, String), Failure> {
    let read = parse_bytes(bytes, &is_builtin_function);
    let old = String::from_utf8_lossy(bytes).into_owned();
    if read.has_errors() {
        let errors: Vec<Diagnostic> = read
            .diagnostics
            .into_iter()
            .filter(Diagnostic::is_error)
            .collect();
        console.diagnostics(&errors, name, &old);
        return Err(Failure::Program);
    }
    match format(&old, &is_builtin_function) {
        Some(new) if is_same_program(&read, &new) => Ok((old, new)),
        _ => Err(Failure::Unchanged { name: name.into() }),
    }
}

/// Whether a text reads as this tree, without an error.
fn is_same_program(read: &Parsed, new: &str) -> bool {
    let again = parse(new, &is_builtin_function);
    !again.has_errors() && same_tree(&read.file, &again.file)
}

/// What changes, in the unified format, the first lines of it.
fn difference(name: &str, old: &str, new: &str) -> String {
    let diff = TextDiff::from_lines(old, new);
    let text = diff
        .unified_diff()
        .context_radius(1)
        .header(name, "formatted")
        .to_string();
    let count = text.lines().count();
    let mut shown: Vec<&str> = text.lines().take(SHOWN).collect();
    let more = format!("… {} more lines", count.saturating_sub(SHOWN));
    if count > SHOWN {
        shown.push(&more);
    }
    shown.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_program_is_refused() {
        let read = parse("x + y 2y", &is_builtin_function);
        let read_well = parse("x + y", &is_builtin_function);
        assert!(read.has_errors() && !read_well.has_errors());
        assert!(is_same_program(&read_well, "x+\ny"));
        assert!(!is_same_program(&read_well, "x - y"));
        assert!(!is_same_program(&read_well, "x + y\na = 1"));
        assert!(!is_same_program(&read_well, "x + ("));
    }

    #[test]
    fn long_differences_are_cut() {
        let old = "x\n".repeat(100);
        let new = "y\n".repeat(100);
        let text = difference("a.pull", &old, &new);
        assert_eq!(text.lines().count(), SHOWN + 1);
        assert!(text.starts_with("--- a.pull\n"), "{text}");
        assert!(text.ends_with("more lines"), "{text}");
    }
}
