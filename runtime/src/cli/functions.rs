//! `pullback functions`

use std::io::{self, BufWriter, Write};

use clap::Args;
use pullback_compiler::{check, table};

use super::failure::Failure;

/// Arguments of `pullback functions`.
#[derive(Debug, Args)]
pub(super) struct FunctionsArguments {
    /// Write a Markdown table
    #[arg(long)]
    markdown: bool,
}

/// Lists every function and operator.
pub(super) fn run(arguments: &FunctionsArguments) -> Result<(), Failure> {
    let mut output = BufWriter::new(io::stdout().lock());
    list(&mut output, arguments.markdown)
        .and_then(|()| output.flush())
        .map_err(Failure::stdout)
}

/// A function or operator as people look it up.
struct Entry {
    usage: String,
    also: Vec<&'static str>,
    doc: String,
}

/// The operator table, then what the compiler builds from it, then what is written in the language itself.
fn entries() -> Vec<Entry> {
    let also = |names: &'static [&'static str]| names.iter().skip(1).copied().collect();
    let table = table::rows().iter().map(|row| Entry {
        usage: row.usage.to_owned(),
        also: also(row.names),
        doc: row.doc.to_owned(),
    });
    let built = check::builtins().iter().map(|builtin| Entry {
        usage: builtin.usage.to_owned(),
        also: also(builtin.names),
        doc: builtin.doc.to_owned(),
    });
    let library = check::library_functions().iter().map(|function| Entry {
        usage: function.usage.to_owned(),
        also: Vec::new(),
        doc: function.doc.to_owned(),
    });
    table.chain(built).chain(library).collect()
}

fn list(output: &mut dyn Write, markdown: bool) -> io::Result<()> {
    let entries = entries();
    if markdown {
        writeln!(output, "| written | also | meaning |\n| --- | --- | --- |")?;
        for Entry { usage, also, doc } in entries {
            let also: Vec<_> = also.iter().map(|name| format!("`{name}`")).collect();
            writeln!(
                output,
                "| `{}` | {} | {} |",
                usage.replace('|', "\\|"),
                also.join(", "),
                doc.replace('|', "\\|")
            )?;
        }
        return Ok(());
    }
    let lengths = entries.iter().map(|entry| entry.usage.chars().count());
    let width = lengths.max().unwrap_or(0);
    for Entry { usage, also, doc } in entries {
        write!(output, "{usage:width$}  {doc}")?;
        if !also.is_empty() {
            write!(output, " (also {})", also.join(", "))?;
        }
        writeln!(output)?;
    }
    Ok(())
}
