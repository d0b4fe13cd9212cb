//! `pullback check`

use std::io::{self, Write};

use clap::Args;
use pullback_compiler::lower::Precision;

use super::failure::Failure;
use super::source::Source;
use super::{Console, Input};

/// Arguments of `pullback check`.
#[derive(Debug, Args)]
pub(super) struct CheckArguments {
    #[command(flatten)]
    input: Input,
}

/// Compiles everything that the program shows, and says so.
pub(super) fn run(arguments: &CheckArguments, console: &Console) -> Result<(), Failure> {
    let source = Source::open(&arguments.input, console)?;
    let mut failed = false;
    let mut scenes = Vec::new();
    for (index, picture) in source.program.pictures().iter().enumerate() {
        let made = source.expect(
            source.program.scene_module(index, Precision::Accurate),
            console,
        );
        failed |= made.is_err();
        scenes.push(picture.scene.name);
    }
    if failed {
        return Err(Failure::Program);
    }
    let mut summary = format!("{}: ok", source.name);
    if source.warnings > 0 {
        summary += &format!(
            ", {} warning{}",
            source.warnings,
            if source.warnings == 1 { "" } else { "s" }
        );
    }
    if !scenes.is_empty() {
        summary += &format!(", shows {}", scenes.join(", "));
    }
    writeln!(io::stdout(), "{summary}").map_err(Failure::stdout)
}
