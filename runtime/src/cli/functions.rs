//! `pullback functions`

use std::io::{self, BufWriter, Write};

use clap::Args;

use super::failure::Failure;

/// Arguments of `pullback functions`.
#[derive(Debug, Args)]
pub(super) struct FunctionsArguments {
    /// Write a Markdown table
    #[arg(long)]
    markdown: bool,
}

/// Lists the operator table.
pub(super) fn run(arguments: &FunctionsArguments) -> Result<(), Failure> {
    let mut output = BufWriter::new(io::stdout().lock());
    list(&mut output, arguments.markdown)
        .and_then(|()| output.flush())
        .map_err(Failure::stdout)
}

fn list(output: &mut dyn Write, markdown: bool) -> io::Result<()> {
    // Operators that are only signs have no name to look up, but a usage.
    let rows: Vec<_> = pullback_compiler::functions().collect();
    if markdown {
        writeln!(output, "| written | also | meaning |\n| --- | --- | --- |")?;
        for row in rows {
            let also: Vec<_> = also(row.names).map(|name| format!("`{name}`")).collect();
            writeln!(
                output,
                "| `{}` | {} | {} |",
                row.usage.replace('|', "\\|"),
                also.join(", "),
                row.doc.replace('|', "\\|")
            )?;
        }
        return Ok(());
    }
    let lengths = rows.iter().map(|row| row.usage.chars().count());
    let width = lengths.max().unwrap_or(0);
    for row in rows {
        write!(output, "{:width$}  {}", row.usage, row.doc)?;
        let also: Vec<_> = also(row.names).collect();
        if !also.is_empty() {
            write!(output, " (also {})", also.join(", "))?;
        }
        writeln!(output)?;
    }
    Ok(())
}

/// Names but the usual one.
fn also<'a>(names: &'a [&'a str]) -> impl Iterator<Item = &'a str> {
    names.iter().skip(1).copied()
}
