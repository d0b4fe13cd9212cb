//! A trace as a table.

use std::io::{self, Write};

use pullback_grammar::{Diagnostic, Span};
use pullback_runtime::trace::{Parting, Site, What};

use super::findings::{Findings, Pair};
use super::number;
use crate::cli::Console;

/// Longest part of a formula that is shown beside a value, in characters.
const SNIPPET: usize = 48;

/// Writes the table and the places where machines part to the standard output.
pub(super) fn tell(findings: &Findings, console: &Console) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    let picture = findings.subject.picture();
    writeln!(
        out,
        "{}, {} of {}, {}",
        findings.place,
        picture.scene.name,
        findings.subject.source.name,
        findings.precision.name()
    )?;
    if let Some(adapter) = &findings.adapter {
        writeln!(out, "gpu is {adapter}")?;
    }
    writeln!(out)?;
    let pairs = findings.pairs();
    lines(&mut out, findings, &pairs)?;
    for column in findings.columns {
        if column.trace.is_cut {
            writeln!(out, "\n{}: what came later was not kept", column.name)?;
        }
    }
    for pair in &pairs {
        writeln!(out)?;
        parting(&mut out, findings, pair, console)?;
    }
    out.flush()
}

/// One line of the table.
struct Line {
    head: String,
    cells: Vec<String>,
    snippet: String,
}

fn lines(out: &mut impl Write, findings: &Findings, pairs: &[Pair]) -> io::Result<()> {
    let mut title: Vec<String> = findings.columns.iter().map(|c| c.name.to_owned()).collect();
    title.extend(
        pairs
            .iter()
            .map(|pair| format!("{}-{}", pair.names[0], pair.names[1])),
    );
    let mut table = vec![Line {
        head: "value".into(),
        cells: title,
        snippet: "of".into(),
    }];
    let mut function = "";
    for row in findings.rows(pairs) {
        let site = &findings.sites[row.site];
        if site.function != function {
            function = &site.function;
            table.push(Line {
                head: function.to_owned(),
                cells: Vec::new(),
                snippet: String::new(),
            });
        }
        let many = row.values.iter().any(|values| values.len() > 1);
        for k in findings.shown(&row) {
            let mut cells: Vec<String> = Vec::new();
            for values in &row.values {
                let value = values.get(k);
                cells.push(value.map_or_else(String::new, |&v| number::written(site.shape, v)));
            }
            for pair in pairs {
                let ulps = findings.distance(&row, pair.columns, k);
                cells.push(ulps.map_or_else(String::new, number::units));
            }
            let count = if many {
                format!(" #{}", k + 1)
            } else {
                String::new()
            };
            table.push(Line {
                head: format!("  {}{count}", head(site)),
                cells,
                snippet: shortened(&findings.snippet(site)),
            });
        }
    }
    write_table(out, &table)
}

/// What to call a value: its name, or the operation.
fn head(site: &Site) -> String {
    let text = shortened(&site.text);
    match site.what {
        What::Operation => text,
        What::Condition => format!("if {text}"),
        What::Result if site.name.is_empty() || site.name.starts_with('.') => {
            format!("return{}", site.name)
        }
        _ => site.name.clone(),
    }
}

fn write_table(out: &mut impl Write, table: &[Line]) -> io::Result<()> {
    let wide = |text: &str| text.chars().count();
    let count = table.iter().map(|line| line.cells.len()).max().unwrap_or(0);
    let first = table.iter().map(|line| wide(&line.head)).max().unwrap_or(0);
    let widths: Vec<usize> = (0..count)
        .map(|k| {
            let cells = table.iter().filter_map(|line| line.cells.get(k));
            cells.map(|cell| wide(cell)).max().unwrap_or(0)
        })
        .collect();
    for line in table {
        let mut text = format!("{:first$}", line.head);
        for (cell, width) in line.cells.iter().zip(&widths) {
            text += &format!("  {cell:>width$}");
        }
        text += "  ";
        text += &line.snippet;
        writeln!(out, "{}", text.trim_end())?;
    }
    Ok(())
}

fn shortened(text: &str) -> String {
    if text.chars().count() <= SNIPPET {
        return text.to_owned();
    }
    let kept: String = text.chars().take(SNIPPET - 1).collect();
    format!("{kept}…")
}

/// Where two machines part: in words, and at its place in the text.
fn parting(
    out: &mut impl Write,
    findings: &Findings,
    pair: &Pair,
    console: &Console,
) -> io::Result<()> {
    let [a, b] = pair.names;
    let Some(parting) = pair.parting else {
        let ulps = findings.arguments.ulps;
        return writeln!(
            out,
            "{a} and {b} do not part: nothing that the result depends on differs by more than {ulps} ulp"
        );
    };
    let site = &findings.sites[parting.site()];
    let (message, label) = match parting {
        Parting::Value { values, ulps, .. } => {
            let [x, y] = values.map(|value| number::written(site.shape, value));
            (
                format!("{a} and {b} part at {}", described(site)),
                format!("{x} on {a}, {y} on {b}: {} ulp", number::units(ulps)),
            )
        }
        Parting::Way { .. } => (
            format!("{a} and {b} go different ways after {}", described(site)),
            "no value before differs by more than is allowed".into(),
        ),
    };
    let Some(span) = site.span.filter(|span| *span != Span::default()) else {
        return writeln!(out, "{message}\n  {label}");
    };
    let found = Diagnostic::warning("parting", span, message).with_label(label);
    let source = &findings.subject.source;
    let text = pullback_grammar::render(&[found], &source.name, &source.text, console.color);
    writeln!(out, "{}", text.trim_end_matches('\n'))
}

/// A site in words: `x * x in field_grad`.
pub(super) fn described(site: &Site) -> String {
    let what = match site.what {
        What::Operation => format!("`{}`", site.text),
        What::Condition => format!("the condition `{}`", site.text),
        What::Result => format!("the result `{}`", site.text),
        What::Argument => format!("the argument `{}`", site.name),
        What::Named | What::Variable => format!("`{} = {}`", site.name, site.text),
    };
    format!("{what} in {}", site.function)
}
