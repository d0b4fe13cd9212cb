//! What was measured, as tables.

use pullback_compiler::table::Gpu as Form;

use super::bounds::{Bound, declared, violations};
use super::evaluators::Machine;
use super::formulas::{MOST, Table};
use super::measure::{Errors, Metric, measure};
use super::subjects::Subject;
use super::sweep::sweep;
use super::tables::Domain;

/// A table of words, and what is wrong with what it says.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Titles of the columns.
    pub titles: Vec<&'static str>,
    /// Cells.
    pub rows: Vec<Vec<String>>,
    /// Bounds that were broken, and what could not be measured.
    pub broken: Vec<String>,
}

impl Report {
    /// As columns of text, or as a table of Markdown.
    #[must_use]
    pub fn text(&self, markdown: bool) -> String {
        let titles: Vec<String> = self.titles.iter().map(|t| (*t).to_owned()).collect();
        if markdown {
            let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
            let rule = vec!["---".to_owned(); titles.len()];
            let rows = self.rows.iter().map(|r| line(r));
            return line(&titles) + &line(&rule) + &rows.collect::<String>();
        }
        let all: Vec<&Vec<String>> = std::iter::once(&titles).chain(&self.rows).collect();
        let width = |k: usize| all.iter().map(|r| r[k].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..titles.len()).map(width).collect();
        let line = |cells: &Vec<String>| {
            let cells: Vec<String> = cells
                .iter()
                .zip(&widths)
                .map(|(c, w)| format!("{c:w$}"))
                .collect();
            cells.join("  ").trim_end().to_owned() + "\n"
        };
        all.into_iter().map(line).collect()
    }
}

/// Every function on a machine, and by the built-ins on `builtins` beside it.
#[must_use]
pub fn functions(subjects: &[Subject], machine: &Machine, builtins: Option<&Machine>) -> Report {
    let mut report = Report {
        titles: vec!["function", "value: max", "99 %", "derivative: max", "99 %"],
        ..Report::default()
    };
    if builtins.is_some() {
        report.titles.push("built-in: max");
    }
    report.titles.push("worst argument of the value");
    for subject in subjects {
        let name = match subject.domain {
            Domain::Real => subject.word.to_owned(),
            Domain::Complex => format!("{} (complex)", subject.word),
        };
        let measured = match machine {
            Machine::Reference => measure(subject, machine),
            Machine::Gpu(..) => sweep(subject).and_then(|swept| measure(&swept, machine)),
        };
        let (measured, bounds) = match (measured, declared(subject, machine)) {
            (Ok(measured), Ok(bounds)) => (measured, bounds),
            (Err(reason), _) | (_, Err(reason)) => {
                report.broken.push(format!("{name}: {reason}"));
                continue;
            }
        };
        let wrong = violations(&measured, &bounds, false);
        report
            .broken
            .extend(wrong.into_iter().map(|v| format!("{name}: {v}")));
        let mut cells = vec![name];
        cells.extend(pair(&measured.value, Some(bounds.value)));
        match &measured.derivative {
            Some(derivative) if derivative[0].count() > 0 => {
                cells.extend(pair(derivative, bounds.derivative));
            }
            _ => cells.extend(["-".to_owned(), "-".to_owned()]),
        }
        if let Some(builtins) = builtins {
            cells.push(builtin(subject, builtins));
        }
        cells.push(argument(
            &chosen(&measured.value, Some(bounds.value)).0.worst,
        ));
        report.rows.push(cells);
    }
    report
}

fn chosen(errors: &[Errors; 3], bound: Option<Bound>) -> (&Errors, Metric) {
    let metric = bound.map_or(Metric::Component, |b| b.metric);
    let place = Metric::ALL.iter().position(|m| *m == metric).unwrap_or(0);
    (&errors[place], metric)
}

fn pair(errors: &[Errors; 3], bound: Option<Bound>) -> [String; 2] {
    let (errors, metric) = chosen(errors, bound);
    let largest = format!("{} {}", ulps(errors.max()), metric.word());
    [largest.trim_end().to_owned(), ulps(errors.percentile())]
}

/// The error of the built-in function of WGSL, where the function has one; results of the wrong class are counted.
fn builtin(subject: &Subject, builtins: &Machine) -> String {
    let has = matches!(subject.row.gpu, Form::Library(_, Some(_)));
    if !has || subject.domain == Domain::Complex {
        return "-".to_owned();
    }
    match measure(subject, builtins) {
        Ok(measured) => {
            let errors = &measured.value[0];
            let wrong = errors.wrong.len();
            let note = if wrong > 0 {
                format!(", {wrong} wrong")
            } else {
                String::new()
            };
            format!("{}{note}", ulps(errors.max()))
        }
        Err(_) => "fails".to_owned(),
    }
}

/// Three digits.
fn ulps(error: f64) -> String {
    match error {
        0.0 => "0".to_owned(),
        e if e < 99.95 => format!("{e:.2}"),
        e if e < 1e6 => format!("{e:.0}"),
        e => format!("{e:.0e}"),
    }
}

/// The argument of a case in words.
fn argument(case: &str) -> String {
    let between = case
        .split_once(" at ")
        .and_then(|(_, rest)| rest.split_once(": "));
    between.map_or(String::new(), |(at, _)| at.replace("[]", ""))
}

/// Error factors of formulas.
#[must_use]
pub fn formulas(tables: &[Table], machine: &Machine) -> Report {
    let mut report = Report {
        titles: vec!["formula", "rows", "value: K", "derivative: K"],
        ..Report::default()
    };
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
                report.rows.push(vec![
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

/// Errors of every function in every metric, for the table of bounds: `function domain`, then for value and
/// derivative the largest error by component, by norm and by unit.
#[must_use]
pub fn raw(subjects: &[Subject], machine: &Machine) -> String {
    let mut out = String::new();
    for subject in subjects {
        let swept = match machine {
            Machine::Reference => Ok(subject.clone()),
            Machine::Gpu(..) => sweep(subject),
        };
        let Ok(measured) = swept.and_then(|s| measure(&s, machine)) else {
            continue;
        };
        let mut cells = vec![subject.word.to_owned(), subject.domain.to_string()];
        for errors in [Some(&measured.value), measured.derivative.as_ref()] {
            match errors {
                Some(errors) if errors[0].count() > 0 => {
                    cells.extend(errors.iter().map(|e| format!("{:.4}", e.max())));
                }
                _ => cells.extend(["-", "-", "-"].map(str::to_owned)),
            }
        }
        out.push_str(&(cells.join("\t") + "\n"));
    }
    out
}
