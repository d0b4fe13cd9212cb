//! A trace for programs.

use std::io::{self, Write};

use pullback_runtime::trace::{Parting, Site, Value, What};
use serde::Serialize;

use super::findings::{Findings, Pair};
use super::number;
use crate::cli::json::{Place, Places};

/// Version of the report: the number grows when a program that reads the older one would misread the newer.
const VERSION: u32 = 1;

#[derive(Serialize)]
struct Report<'a> {
    version: u32,
    file: &'a str,
    scene: &'a str,
    place: &'a str,
    precision: &'a str,
    adapter: Option<&'a str>,
    machines: Vec<Machine<'a>>,
    values: Vec<Row<'a>>,
    partings: Vec<Parted<'a>>,
}

#[derive(Serialize)]
struct Machine<'a> {
    name: &'a str,
    events: usize,
    cut: bool,
}

/// A site.
#[derive(Serialize)]
pub(super) struct Told<'a> {
    function: &'a str,
    what: &'static str,
    name: &'a str,
    operation: &'a str,
    span: Option<Place>,
}

#[derive(Serialize)]
struct Row<'a> {
    #[serde(flatten)]
    site: Told<'a>,
    /// Number of values, by machine.
    counts: Vec<usize>,
    shown: Vec<Shown>,
}

#[derive(Serialize)]
struct Shown {
    /// Which of the values, from 0.
    index: usize,
    /// By machine; none where it has no such value.
    values: Vec<Option<Vec<Number>>>,
    /// Units in the last place between each machine and the next.
    ulps: Vec<Option<Number>>,
}

#[derive(Serialize)]
struct Parted<'a> {
    machines: [&'a str; 2],
    kind: &'static str,
    site: Option<Told<'a>>,
    values: Option<[Vec<Number>; 2]>,
    ulps: Option<Number>,
}

/// A number; JSON has no NaN and no infinity, which are strings.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Number {
    Finite(f64),
    Other(String),
}

impl From<f64> for Number {
    fn from(x: f64) -> Self {
        if x.is_finite() {
            Self::Finite(x)
        } else {
            Self::Other(number::real(x))
        }
    }
}

fn numbers(value: Value) -> Vec<Number> {
    value.numbers().iter().map(|&x| x.into()).collect()
}

/// A site, with its place in the text.
pub(super) fn told<'a>(site: &'a Site, places: &Places) -> Told<'a> {
    Told {
        function: &site.function,
        what: match site.what {
            What::Argument => "argument",
            What::Named => "value",
            What::Operation => "operation",
            What::Variable => "variable",
            What::Condition => "condition",
            What::Result => "result",
        },
        name: &site.name,
        operation: &site.text,
        span: site.span.map(|span| places.place(span)),
    }
}

/// Writes one object to the standard output.
pub(super) fn write(findings: &Findings) -> io::Result<()> {
    let places = Places::new(&findings.subject.source.text);
    let pairs = findings.pairs();
    let report = Report {
        version: VERSION,
        file: &findings.subject.source.name,
        scene: findings.subject.picture().scene.name,
        place: &findings.place,
        precision: findings.precision.name(),
        adapter: findings.adapter.as_deref(),
        machines: findings
            .columns
            .iter()
            .map(|column| Machine {
                name: column.name,
                events: column.trace.events.len(),
                cut: column.trace.is_cut,
            })
            .collect(),
        values: rows(findings, &pairs, &places),
        partings: pairs
            .iter()
            .map(|pair| parted(findings, pair, &places))
            .collect(),
    };
    put(&report)
}

/// Writes an object to the standard output.
pub(super) fn put(report: &impl Serialize) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    serde_json::to_writer_pretty(&mut out, report)?;
    writeln!(out)?;
    out.flush()
}

fn rows<'a>(findings: &'a Findings, pairs: &[Pair], places: &Places) -> Vec<Row<'a>> {
    let all = findings.rows(pairs).into_iter();
    all.map(|row| Row {
        site: told(&findings.sites[row.site], places),
        counts: row.values.iter().map(Vec::len).collect(),
        shown: findings
            .shown(&row)
            .into_iter()
            .map(|index| Shown {
                index,
                values: row
                    .values
                    .iter()
                    .map(|values| values.get(index).map(|&value| numbers(value)))
                    .collect(),
                ulps: pairs
                    .iter()
                    .map(|pair| findings.distance(&row, pair.columns, index))
                    .map(|ulps| ulps.map(Number::from))
                    .collect(),
            })
            .collect(),
    })
    .collect()
}

fn parted<'a>(findings: &'a Findings, pair: &Pair<'a>, places: &Places) -> Parted<'a> {
    let (kind, values, ulps) = match pair.parting {
        None => ("none", None, None),
        Some(Parting::Value { values, ulps, .. }) => {
            ("value", Some(values.map(numbers)), Some(ulps.into()))
        }
        Some(Parting::Way { .. }) => ("way", None, None),
    };
    Parted {
        machines: pair.names,
        kind,
        site: pair
            .parting
            .map(|parting| told(&findings.sites[parting.site()], places)),
        values,
        ulps,
    }
}
