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
    let rows: Vec<_> = pullback_compiler::functions().collect();
    if markdown {
        writeln!(output, "| function | also | meaning |\n| --- | --- | --- |")?;
        for row in rows {
            let aliases: Vec<_> = row.aliases.iter().map(|name| format!("`{name}`")).collect();
            writeln!(
                output,
                "| `{}` | {} | {} |",
                row.signature.replace('|', "\\|"),
                aliases.join(", "),
                row.doc.replace('|', "\\|")
            )?;
        }
        return Ok(());
    }
    let width = rows
        .iter()
        .map(|row| row.signature.chars().count())
        .max()
        .unwrap_or(0);
    for row in rows {
        write!(output, "{:width$}  {}", row.signature, row.doc)?;
        if !row.aliases.is_empty() {
            write!(output, " (also {})", row.aliases.join(", "))?;
        }
        writeln!(output)?;
    }
    Ok(())
}
