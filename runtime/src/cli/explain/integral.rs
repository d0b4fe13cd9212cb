//! `pullback explain --what integral`

use std::io::{self, Write};

use pullback_compiler::Picture;
use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::{self, Explanation, Record};
use serde::Serialize;

use super::super::Console;
use super::super::failure::Failure;
use super::super::source::Source;
use super::{Format, VERSION, indented};

#[derive(Serialize)]
struct Report<'a> {
    version: u32,
    file: &'a str,
    name: &'a str,
    pieces: bool,
    parts: Vec<Part<'a>>,
    numerical: Vec<Numerical<'a>>,
    compiled: &'a str,
    operations: u32,
}

#[derive(Serialize)]
struct Part<'a> {
    integrand: &'a str,
    conditions: &'a [String],
    rule: &'static str,
    equation: &'static str,
    bound: &'static str,
    source: &'static str,
}

#[derive(Serialize)]
struct Numerical<'a> {
    integrand: &'a str,
    start: u32,
    end: u32,
    proven: bool,
    reason: String,
}

/// Explains the integral of a picture's formula along a ray.
pub(super) fn run(
    source: &Source,
    picture: &Picture,
    params: &[String],
    format: Format,
    console: &Console,
) -> Result<(), Failure> {
    let formula = &picture.formula;
    let made = integrate::explain(formula, params)
        .map_err(|problem| vec![problem.diagnostic(formula.span)]);
    let found = source.expect(made, console)?;
    let mut out = io::BufWriter::new(io::stdout().lock());
    match format {
        Format::Human => tell(&mut out, formula, &found),
        Format::Json => write_json(&mut out, &source.name, formula, &found),
    }
    .and_then(|()| out.flush())
    .map_err(Failure::stdout)
}

fn tell(out: &mut impl Write, formula: &Formula, found: &Explanation) -> io::Result<()> {
    let name = &formula.name;
    writeln!(
        out,
        "∫ {name}(o + t d) dt from t = a to b, with m = (a + b)/2, h = (b - a)/2 and t = m + s"
    )?;
    if found.pieces {
        writeln!(
            out,
            "\ncut where conditions change; each piece has a middle and a half length of its own"
        )?;
    }
    writeln!(out, "\nterms")?;
    let mut told: Vec<&str> = Vec::new();
    for part in &found.parts {
        writeln!(out, "{}", indented(&part.integrand))?;
        for condition in &part.conditions {
            writeln!(out, "      where {condition}")?;
        }
        rule(out, part.rule, &mut told)?;
    }
    if !found.numerical.is_empty() {
        writeln!(
            out,
            "\nwithout closed form; 16 panels of 6 Gauss-Legendre nodes instead"
        )?;
    }
    for (text, problem) in &found.numerical {
        writeln!(out, "{}", indented(text))?;
        writeln!(out, "      {}", problem.reason.in_words())?;
    }
    writeln!(
        out,
        "\ncompiled, {} operations\n{}",
        found.operations,
        indented(&found.compiled)
    )
}

fn rule(
    out: &mut impl Write,
    record: &'static Record,
    told: &mut Vec<&'static str>,
) -> io::Result<()> {
    writeln!(out, "      by {}", record.name)?;
    if told.contains(&record.name) {
        return Ok(());
    }
    told.push(record.name);
    writeln!(out, "        {}", record.equation)?;
    writeln!(out, "        {}", record.bound)?;
    writeln!(out, "        {}", record.source)
}

fn write_json(
    out: &mut impl Write,
    file: &str,
    formula: &Formula,
    found: &Explanation,
) -> io::Result<()> {
    let report = Report {
        version: VERSION,
        file,
        name: &formula.name,
        pieces: found.pieces,
        parts: found
            .parts
            .iter()
            .map(|part| Part {
                integrand: &part.integrand,
                conditions: &part.conditions,
                rule: part.rule.name,
                equation: part.rule.equation,
                bound: part.rule.bound,
                source: part.rule.source,
            })
            .collect(),
        numerical: found
            .numerical
            .iter()
            .map(|(text, problem)| Numerical {
                integrand: text,
                start: problem.span.start,
                end: problem.span.end,
                proven: problem.reason.is_proven(),
                reason: problem.reason.in_words(),
            })
            .collect(),
        compiled: &found.compiled,
        operations: found.operations,
    };
    serde_json::to_writer_pretty(&mut *out, &report)?;
    writeln!(out)
}
