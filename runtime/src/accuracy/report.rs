//! A survey in words: columns of text, Markdown, JSON, and a chart.

use pullback_compiler::table::Bound;

use super::error::{Format, Judge};
use super::measure::{Errors, Witness, in_metric};
use super::survey::{Finding, Survey, tier_name};

pub use super::chart::svg;
pub use super::json::json;

/// The share of cases whose largest error stands beside the largest of all.
pub const MOST_CASES: f64 = 0.999;

/// How a table of words is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Columns, padded with blanks.
    Text,
    /// A table of Markdown.
    Markdown,
}

/// A table of words.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Titles of the columns.
    pub titles: Vec<&'static str>,
    /// Cells.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// The table as text.
    #[must_use]
    pub fn text(&self, style: Style) -> String {
        let titles: Vec<String> = self.titles.iter().map(|t| (*t).to_owned()).collect();
        let all: Vec<&Vec<String>> = std::iter::once(&titles).chain(&self.rows).collect();
        if style == Style::Markdown {
            let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
            let rule = vec!["---".to_owned(); titles.len()];
            let rows = self.rows.iter().map(|r| line(r));
            return line(&titles) + &line(&rule) + &rows.collect::<String>();
        }
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

/// The survey as text or Markdown: what was done, the table, and the exceptions.
#[must_use]
pub fn text(survey: &Survey, style: Style) -> String {
    let mut out = head(survey);
    out += "\n";
    out += &table(survey).text(style);
    out += "\n";
    let verdict = match survey.exceptions.len() {
        0 => "Every declared bound holds.\n".to_owned(),
        1 => "1 exception:\n".to_owned(),
        n => format!("{n} exceptions:\n"),
    };
    out += &verdict;
    for exception in &survey.exceptions {
        out += &format!("- {exception}\n");
    }
    out
}

fn head(survey: &Survey) -> String {
    let mut out = String::new();
    if !survey.adapter.is_empty() {
        let clock = if survey.device_clock {
            "the device's timestamps"
        } else {
            "the clock of this program"
        };
        out += &format!("{}\nTimes are by {clock}. ", survey.adapter);
    }
    out += &format!(
        "Errors are in units of the number format: ulp of float32 (fast, accurate), 2⁻⁴⁸ of the result (extended), ulp of \
         float64 (double, reference); `norm`: of the greatest component, `unit`: of 1 where the result is smaller. Points: \
         the tables of references, and for tiers below float64 {} random ones.\n",
        survey.random_points
    );
    for allowance in &survey.allowances {
        out += &format!("Allowed for this adapter in {allowance}.\n");
    }
    out
}

/// One line for each function and tier.
#[must_use]
pub fn table(survey: &Survey) -> Table {
    let mut table = Table {
        titles: vec![
            "function",
            "tier",
            "value: max",
            "99.9 %",
            "bound",
            "bits",
            "derivative: max",
            "99.9 %",
            "bound",
            "cost",
            "worst argument of the value",
        ],
        rows: Vec::new(),
    };
    for row in &survey.rows {
        for finding in &row.findings {
            let declared = &finding.declared;
            let [of_value, of_derivative] = declared.metrics;
            let errors = in_metric(&finding.measured.value, of_value);
            let mut cells = vec![row.subject.name(), tier_name(finding.tier).to_owned()];
            cells.extend(quantity(errors, declared.value));
            cells.push(bits(finding.format, errors));
            cells.extend(match &finding.measured.derivative {
                Some(of) if of[0].count() > 0 => {
                    quantity(in_metric(of, of_derivative), declared.derivative)
                }
                _ => ["-", "-", "-"].map(str::to_owned),
            });
            cells.push(cost(finding));
            cells.push(argument(&errors.worst));
            table.rows.push(cells);
        }
    }
    table
}

fn quantity(errors: &Errors, bound: Option<Bound>) -> [String; 3] {
    let mut most = units(errors.max());
    if !errors.wrong.is_empty() {
        most += &format!(", {} wrong", errors.wrong.len());
    }
    [
        most,
        units(errors.quantile(MOST_CASES)),
        bound.map_or("-".to_owned(), |b| b.to_string()),
    ]
}

/// How many bits are right in the worst case.
fn bits(format: Format, errors: &Errors) -> String {
    if errors.wrong.is_empty() {
        format!("{:.1}", format.right_bits(errors.max()))
    } else {
        "0".to_owned()
    }
}

fn cost(finding: &Finding) -> String {
    let relative = finding.cost.and_then(|c| c.relative);
    relative.map_or("-".to_owned(), |r| format!("{r:.2}"))
}

/// Three digits.
#[must_use]
pub fn units(error: f64) -> String {
    match error {
        0.0 => "0".to_owned(),
        e if e < 0.005 => format!("{e:.0e}"),
        e if e < 99.95 => format!("{e:.2}"),
        e if e < 1e6 => format!("{e:.0}"),
        e => format!("{e:.0e}"),
    }
}

fn argument(worst: &Witness) -> String {
    let numbers: Vec<String> = worst.at.iter().map(|x| format!("{x:?}")).collect();
    numbers.join(", ")
}
