//! What is declared about errors, in Markdown.

use std::io::{self, Write};

use pullback_compiler::table::{self, Bound, Bounds};

use super::bounds::TIERS;

/// The bounds of functions of the shader library, then those of functions that are defined in the language.
pub(super) fn write(output: &mut dyn Write) -> io::Result<()> {
    library(output)?;
    special(output)
}

fn library(output: &mut dyn Write) -> io::Result<()> {
    writeln!(
        output,
        "\n## Declared errors\n\nThe largest error of a value / of a derivative, in ulp of float32 (`accurate`), 2⁻⁴⁸ of the result \
         (`extended`) and ulp of float64\n(`double`), of each component; norm: of the greatest component, unit: of 1 where the \
         result is smaller.\n"
    )?;
    let tiers: Vec<String> = TIERS.map(|tier| format!("`{}`", tier.name())).to_vec();
    writeln!(output, "| function | of | {} |", tiers.join(" | "))?;
    writeln!(output, "| --- | --- | --- | --- | --- |")?;
    for bounds in table::bounds() {
        let cells = TIERS.map(|tier| pair(bounds, tier));
        let domain = if bounds.complex { "complex" } else { "real" };
        writeln!(
            output,
            "| `{}` | {domain} | {} |",
            bounds.word,
            cells.join(" | ")
        )?;
    }
    Ok(())
}

fn pair(bounds: &Bounds, tier: pullback_compiler::lower::Precision) -> String {
    let cell = |bound: Option<Bound>| bound.map_or_else(|| "none".to_owned(), |b| b.to_string());
    let (value, derivative) = (bounds.value(Some(tier)), bounds.derivative(Some(tier)));
    format!("{} / {}", cell(value), cell(derivative))
}

fn special(output: &mut dyn Write) -> io::Result<()> {
    writeln!(
        output,
        "\n## Declared errors of special functions\n\nPictures of them, and where they are singular: \
         [special-functions.md](special-functions.md); what they cost: [special.md](special.md).\n\nFunctions that are defined in the language may be off by 16 u of the norm of \
         the result and what changes of the arguments by 2 u\nmove, u = 2⁻²⁴, in `accurate` (10⁻⁶ of the norm); by four times that in \
         units of 2⁻⁴⁸ in `extended`, and sixteen times that in units of\n2⁻⁵³ in `double` (3 · 10⁻¹⁴ of the norm). Derivatives by four \
         times as much, second derivatives by parameters by four times that. No function\nhas more. The suite `special` holds them \
         to it, on an adapter the program `special_adapter`."
    )
}
