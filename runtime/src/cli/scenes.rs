//! `pullback scenes`

use std::io::{self, BufWriter, Write};

use clap::Args;
use pullback_compiler::SettingValue;
use pullback_compiler::scene::{SettingKind, SettingSpec, scenes};

use super::failure::Failure;
use super::render;

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
    for (i, scene) in scenes().iter().enumerate() {
        if i > 0 {
            writeln!(output)?;
        }
        if markdown {
            writeln!(output, "## {}\n\n{}\n", scene.name, scene.doc)?;
            writeln!(output, "| setting | default | values | meaning |")?;
            writeln!(output, "| --- | --- | --- | --- |")?;
            for spec in scene.settings {
                let (default, values) = (default(spec), values(spec));
                let doc = spec.doc.replace('|', "\\|");
                writeln!(output, "| `{}` | {default} | {values} | {doc} |", spec.name)?;
            }
            continue;
        }
        writeln!(output, "{}: {}", scene.name, scene.doc)?;
        for spec in scene.settings {
            let (default, values) = (default(spec), values(spec));
            writeln!(
                output,
                "  {} = {default}  {}; {values}",
                spec.name, spec.doc
            )?;
        }
    }
    Ok(())
}

fn default(spec: &'static SettingSpec) -> String {
    render::written(&SettingValue {
        spec,
        value: spec.default,
    })
}

/// What a setting may be, in words.
fn values(spec: &SettingSpec) -> String {
    let kind = match spec.kind {
        SettingKind::Choice(words) => return words.join(" or "),
        SettingKind::Function => return "name of a function".to_owned(),
        SettingKind::Real => "number",
        SettingKind::Integer => "whole number",
        SettingKind::Vec2 => "2 numbers",
        SettingKind::Vec3 => "3 numbers",
    };
    let (lo, hi) = spec.range;
    match (lo.is_finite(), hi.is_finite()) {
        // Bounds like 1e-30 only say that zero is excluded.
        (true, true) if lo > 0.0 && lo < 1e-20 && hi > 1e20 => format!("positive {kind}"),
        (true, true) => format!("{kind} in {lo}..{hi}"),
        (true, false) if lo > 0.0 && lo < 1e-20 => format!("positive {kind}"),
        (true, false) => format!("{kind} from {lo}"),
        (false, true) => format!("{kind} up to {hi}"),
        (false, false) => kind.to_owned(),
    }
}
