//! The findings for programs: `docs/schema/measure-1.json`.

use std::io::{self, Write};

use pullback_runtime::bench::Ratio;
use pullback_runtime::measure::{Again, Check, Judgement, Number, Row, SEEN, Spread, Time};
use serde::Serialize;

use super::Findings;

/// Version of the report: the number grows when a program that reads the older one would misread the newer.
const VERSION: u32 = 1;

#[derive(Serialize)]
struct Json<'a> {
    version: u32,
    input: &'a str,
    adapter: &'a str,
    width: u32,
    height: u32,
    truth: JsonTruth,
    unseen_flip: f64,
    choices: Vec<JsonRow<'a>>,
    advice: JsonAdvice,
    second_run: JsonAgain<'a>,
}

#[derive(Serialize)]
struct JsonTruth {
    samples: u32,
    pixels: u64,
    of_pixels: u64,
    own_error: Option<JsonError>,
}

#[derive(Serialize)]
struct JsonRow<'a> {
    name: &'a str,
    seconds: Option<JsonTime>,
    error: Option<JsonError>,
    numbers: Vec<JsonNumber>,
    on_front: bool,
    note: Option<&'a str>,
}

#[derive(Serialize)]
struct JsonTime {
    median: f64,
    low: f64,
    high: f64,
    turns: usize,
    clock: &'static str,
}

#[derive(Serialize)]
struct JsonError {
    light: JsonSpread,
    flip: JsonSpread,
    flip_standard_error: Option<f64>,
}

#[derive(Serialize)]
struct JsonSpread {
    mean: f64,
    p999: f64,
    max: f64,
}

#[derive(Serialize)]
struct JsonNumber {
    quantity: &'static str,
    unit: &'static str,
    error: JsonSpread,
    apart: f64,
    pixels: usize,
}

#[derive(Serialize)]
struct JsonAgain<'a> {
    elsewhere: bool,
    holds: Option<bool>,
    checks: Vec<JsonCheck>,
    note: Option<&'a str>,
}

#[derive(Serialize)]
struct JsonCheck {
    choice: usize,
    error: Option<JsonError>,
    allowed_flip: Option<f64>,
    error_holds: Option<bool>,
    times: Option<[JsonRatio; 2]>,
    time_holds: Option<bool>,
}

#[derive(Serialize)]
struct JsonRatio {
    value: f64,
    range: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct JsonAdvice {
    unseen: Option<usize>,
    half_the_time: Option<usize>,
}

/// Writes one object to the standard output.
pub(super) fn write(findings: &Findings) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    serde_json::to_writer_pretty(&mut out, &object(findings))?;
    writeln!(out)?;
    out.flush()
}

fn object<'a>(findings: &Findings<'a>) -> Json<'a> {
    let report = findings.report;
    Json {
        version: VERSION,
        input: findings.title,
        adapter: findings.adapter,
        width: findings.size.width,
        height: findings.size.height,
        truth: JsonTruth {
            samples: report.true_samples,
            pixels: report.pixels[0],
            of_pixels: report.pixels[1],
            own_error: report.own.map(error),
        },
        unseen_flip: SEEN,
        choices: report.rows.iter().map(row).collect(),
        advice: JsonAdvice {
            unseen: report.advice.unseen,
            half_the_time: report.advice.half,
        },
        second_run: again(&report.again),
    }
}

fn row(row: &Row) -> JsonRow<'_> {
    JsonRow {
        name: &row.name,
        seconds: row.time.map(time),
        error: row.error.map(error),
        numbers: row.numbers.iter().map(number).collect(),
        on_front: row.on_front,
        note: row.note.as_deref(),
    }
}

fn number(number: &Number) -> JsonNumber {
    JsonNumber {
        quantity: number.quantity.name(),
        unit: number.quantity.unit(),
        error: spread(number.error),
        apart: number.apart,
        pixels: number.pixels,
    }
}

fn again(again: &Again) -> JsonAgain<'_> {
    let is_known = again.checks.iter().any(|c| c.error_holds.is_some());
    JsonAgain {
        elsewhere: again.elsewhere,
        holds: is_known.then(|| again.checks.iter().all(Check::holds)),
        checks: again.checks.iter().map(check).collect(),
        note: again.note.as_deref(),
    }
}

fn check(check: &Check) -> JsonCheck {
    let ratio = |ratio: Ratio| JsonRatio {
        value: ratio.value,
        range: Some(ratio.range).filter(|range| range[1].is_finite()),
    };
    JsonCheck {
        choice: check.choice,
        error: check.error.map(error),
        allowed_flip: Some(check.allowed).filter(|x| x.is_finite()),
        error_holds: check.error_holds,
        times: check.times.map(|times| times.map(ratio)),
        time_holds: check.time_holds,
    }
}

fn time(time: Time) -> JsonTime {
    JsonTime {
        median: time.median,
        low: time.low,
        high: time.high,
        turns: time.turns,
        clock: if time.by_device { "device" } else { "wall" },
    }
}

fn error(judgement: Judgement) -> JsonError {
    JsonError {
        light: spread(judgement.light),
        flip: spread(judgement.seen),
        flip_standard_error: Some(judgement.doubt).filter(|x| x.is_finite()),
    }
}

fn spread(spread: Spread) -> JsonSpread {
    JsonSpread {
        mean: spread.mean,
        p999: spread.p999,
        max: spread.max,
    }
}
