//! Error factors of formulas, as tables.

use pullback_runtime::accuracy::report::Table as Words;

use super::evaluators::Machine;
use super::formulas::{MOST, Table};

/// A table of words, and what is wrong with what it says.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// The table.
    pub table: Words,
    /// Bounds that were broken, and what could not be measured.
    pub broken: Vec<String>,
}

/// Error factors of formulas.
#[must_use]
pub fn formulas(tables: &[Table], machine: &Machine) -> Report {
    let mut report = Report::default();
    report.table.titles = vec!["formula", "rows", "value: K", "derivative: K"];
    for table in tables {
        let text = table.source.trim_end();
        let name = if text.contains('\n') {
            table.name
        } else {
            text
        }
        .replace('|', "\\|");
        match table.measure(machine) {
            Err(reason) => report.broken.push(format!("{name}: {reason}")),
            Ok(factors) => {
                if factors.value.max(factors.derivative) > MOST {
                    report
                        .broken
                        .push(format!("{name}: K is above {MOST}: {}", factors.worst));
                }
                report
                    .broken
                    .extend(factors.wrong.iter().map(|w| format!("{name}: {w}")));
                report.table.rows.push(vec![
                    name,
                    factors.rows.to_string(),
                    format!("{:.2}", factors.value),
                    format!("{:.2}", factors.derivative),
                ]);
            }
        }
    }
    report
}
