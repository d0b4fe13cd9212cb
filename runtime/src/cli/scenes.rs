//! `pullback scenes`

use std::io::{self, BufWriter, Write};

use clap::Args;

use super::failure::Failure;

/// Arguments of `pullback scenes`.
#[derive(Debug, Args)]
pub(super) struct ScenesArguments {
    /// Write Markdown tables
    #[arg(long)]
    markdown: bool,
}

/// Lists the scenes.
pub(super) fn run(arguments: &ScenesArguments) -> Result<(), Failure> {
    let mut output = BufWriter::new(io::stdout().lock());
    list(&mut output, arguments.markdown)
        .and_then(|()| output.flush())
        .map_err(Failure::stdout)
}

fn list(output: &mut dyn Write, markdown: bool) -> io::Result<()> {
    for (i, scene) in pullback_compiler::scenes().enumerate() {
        if i > 0 {
            writeln!(output)?;
        }
        if markdown {
            writeln!(output, "## {}\n\n{}\n", scene.name, scene.doc)?;
            writeln!(
                output,
                "| setting | default | range | meaning |\n| --- | --- | --- | --- |"
            )?;
            for spec in scene.settings {
                writeln!(
                    output,
                    "| `{}` | {} | {}..{} | {} |",
                    spec.name, spec.default, spec.lo, spec.hi, spec.doc
                )?;
            }
            continue;
        }
        writeln!(output, "{}: {}", scene.name, scene.doc)?;
        for spec in scene.settings {
            writeln!(
                output,
                "  {} = {} in {}..{}: {}",
                spec.name, spec.default, spec.lo, spec.hi, spec.doc
            )?;
        }
    }
    Ok(())
}
