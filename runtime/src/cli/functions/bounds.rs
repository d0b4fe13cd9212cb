//! The bounds of all functions in columns.

use std::io::{self, Write};

use pullback_compiler::lower::Precision;
use pullback_compiler::table::{Bound, Bounds};

use super::Entry;

/// Tiers with bounds.
pub(super) const TIERS: [Precision; 3] =
    [Precision::Accurate, Precision::Extended, Precision::Double];

/// The largest errors of value and derivative in each tier.
pub(super) fn write(output: &mut dyn Write, entries: &[Entry]) -> io::Result<()> {
    writeln!(
        output,
        "The largest error of a value, then that of a derivative, in each tier that promises any. Units are ulp of \
         float32 (accurate), 2⁻⁴⁸ of the result (extended) and ulp of float64 (double), of each component; `norm`: of the \
         greatest component, `unit`: of 1 where the result is smaller.\n"
    )?;
    let all: Vec<&Bounds> = entries
        .iter()
        .flat_map(|e| e.bounds.iter().copied())
        .collect();
    let name = |bounds: &Bounds| match bounds.complex {
        true => format!("{} (complex)", bounds.word),
        false => bounds.word.to_owned(),
    };
    let width = all.iter().map(|b| name(b).len()).max().unwrap_or(0);
    write!(output, "{:width$}", "function")?;
    for tier in TIERS {
        write!(output, "  {:23}", tier.name())?;
    }
    writeln!(output)?;
    for bounds in all {
        write!(output, "{:width$}", name(bounds))?;
        for tier in TIERS {
            let cells = [bounds.value(Some(tier)), bounds.derivative(Some(tier))].map(cell);
            write!(output, "  {:11} {:11}", cells[0], cells[1])?;
        }
        writeln!(output)?;
    }
    Ok(())
}

fn cell(bound: Option<Bound>) -> String {
    bound.map_or_else(|| "-".to_owned(), |bound| bound.to_string())
}
