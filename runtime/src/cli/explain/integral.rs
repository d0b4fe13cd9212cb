//! `pullback explain --what integral`

use std::io::{self, Write};

use pullback_compiler::Picture;
use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::{
    self, BOUNDED_NODES, Explanation, MAX_PANELS, NODES, PANELS, Record, Rest, SAMPLE, TOLERANCE,
};
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
    quadrature: Vec<Quadrature<'a>>,
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

/// A part that is integrated by nodes; `without` is what no bound is known of.
#[derive(Serialize)]
struct Quadrature<'a> {
    integrand: &'a str,
    nodes: usize,
    most_panels: u32,
    tolerance: Option<f64>,
    without: Option<&'a str>,
    ray: [f64; 8],
    panels: Option<f64>,
    error: Option<f64>,
}

fn quadrature(rest: &Rest) -> Quadrature<'_> {
    let is_bounded = rest.without.is_none();
    Quadrature {
        integrand: &rest.integrand,
        nodes: if is_bounded { BOUNDED_NODES } else { NODES },
        most_panels: if is_bounded { MAX_PANELS } else { PANELS },
        tolerance: is_bounded.then_some(TOLERANCE),
        without: rest.without.as_ref().map(|w| w.0.as_str()),
        ray: SAMPLE,
        panels: rest.along_sample.map(|s| s[0]),
        error: rest.along_sample.map(|s| s[1]),
    }
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
        writeln!(out, "\nwithout closed form")?;
    }
    for (text, problem) in &found.numerical {
        writeln!(out, "{}", indented(text))?;
        writeln!(out, "      {}", problem.reason.in_words())?;
    }
    for part in &found.rest {
        rest(out, part)?;
    }
    writeln!(
        out,
        "\ncompiled, {} operations\n{}",
        found.operations,
        indented(&found.compiled)
    )
}

/// How a part is integrated numerically: by a bound of its error, or by a fixed rule.
fn rest(out: &mut impl Write, part: &Rest) -> io::Result<()> {
    writeln!(out, "\nby nodes\n{}", indented(&part.integrand))?;
    if let Some((text, _)) = &part.without {
        return writeln!(
            out,
            "      no bound of its error is known, for want of one of {text}: {PANELS} panels of {NODES} \
             Gauss-Legendre nodes"
        );
    }
    writeln!(
        out,
        "      panels of {BOUNDED_NODES} Gauss-Legendre nodes, at most {MAX_PANELS}, each as short as the bound of its \
         error asks for: {TOLERANCE:e} of its length times the greatest |f|"
    )?;
    let Some([panels, bound]) = part.along_sample else {
        return Ok(());
    };
    let [ox, oy, oz, dx, dy, dz, a, b] = SAMPLE;
    writeln!(
        out,
        "      for o = ({ox}, {oy}, {oz}), d = ({dx}, {dy}, {dz}), t from {a} to {b}: {panels} panels, the error at most \
         {bound:.1e}"
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
        quadrature: found.rest.iter().map(quadrature).collect(),
        compiled: &found.compiled,
        operations: found.operations,
    };
    serde_json::to_writer_pretty(&mut *out, &report)?;
    writeln!(out)
}
