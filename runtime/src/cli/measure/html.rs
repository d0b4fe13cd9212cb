//! The findings as one page that needs no other file.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use pullback_runtime::Error;
use pullback_runtime::difference::{Bitmap, heat_map};
use pullback_runtime::measure::{Report, Row};

use super::table::{brief, head, sentences};
use super::{Findings, chart, numbers};

const STYLE: &str = "body { font: 15px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; \
    color: #222 } table { border-collapse: collapse; font-variant-numeric: tabular-nums } td, th { padding: .15rem .6rem; \
    text-align: right; border-bottom: 1px solid #ddd } td.name, th.name { text-align: left } tr.front { font-weight: 600 } \
    tr.default { color: #b04a00 } figure { display: inline-block; margin: .5rem } img { max-width: 28rem; width: 100%; \
    image-rendering: pixelated } figcaption { color: #555 }";

/// The page.
pub(super) fn page(findings: &Findings) -> Result<String, Error> {
    let report = findings.report;
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>pullback measure: {0}</title>\n\
         <style>{STYLE}</style>\n<h1>Speed and accuracy of {0}</h1>\n",
        escaped(findings.title)
    );
    for line in head(findings) {
        let _ = writeln!(out, "<p>{}</p>", escaped(&line));
    }
    out += "<ul>\n";
    for sentence in sentences(findings) {
        let _ = writeln!(out, "<li>{}</li>", escaped(&sentence));
    }
    out += "</ul>\n";
    let second = numbers::second_run(report);
    if !second.is_empty() {
        out += "<h2>A second run</h2>\n<ul>\n";
    }
    for line in &second {
        let _ = writeln!(out, "<li>{}</li>", escaped(line.trim()));
    }
    if !second.is_empty() {
        out += "</ul>\n";
    }
    out += "<h2>Time against error</h2>\n";
    out += &chart::svg(&report.rows);
    out += "<p>Numbers are those of the table; blue is the front, of which nothing is beaten in both, orange the default.</p>\n";
    out += &table(&report.rows);
    out += &numbers_table(report);
    if let Some(shown) = &report.shown {
        let size = shown.truth.size();
        out += "<h2>Where they differ</h2>\n";
        out += &figure(&shown.truth, "the truth")?;
        out += &figure(&shown.default, "the default")?;
        let caption =
            "FLIP of the default: black is not to be seen, pale yellow as different as can be";
        out += &figure(&heat_map(size, &shown.seen)?, caption)?;
    }
    Ok(out + "</html>\n")
}

fn table(rows: &[Row]) -> String {
    let mut out = String::from(
        "<table>\n<tr><th></th><th class=\"name\">choice</th><th>ms</th><th>middle half</th><th>turns</th><th>light, mean</th>\
         <th>99.9 %</th><th>seen, mean</th><th>±</th><th>99.9 %</th><th>max</th></tr>\n",
    );
    for (number, row) in (1..).zip(rows) {
        let class = match (number, row.on_front) {
            (1, true) => "default front",
            (1, false) => "default",
            (_, true) => "front",
            _ => "",
        };
        let _ = write!(
            out,
            "<tr class=\"{class}\"><td>{number}</td><td class=\"name\">{}</td>",
            escaped(&row.name)
        );
        match row.time {
            Some(time) => {
                let ms = |seconds: f64| brief(1e3 * seconds);
                let _ = write!(
                    out,
                    "<td>{}</td><td>{}–{}</td><td>{}</td>",
                    ms(time.median),
                    ms(time.low),
                    ms(time.high),
                    time.turns
                );
            }
            None => out += "<td></td><td></td><td></td>",
        }
        match (row.error, &row.note) {
            (Some(e), _) => {
                let numbers = [
                    e.light.mean,
                    e.light.p999,
                    e.seen.mean,
                    e.doubt,
                    e.seen.p999,
                    e.seen.max,
                ];
                for number in numbers {
                    let _ = write!(out, "<td>{}</td>", brief(number));
                }
            }
            (None, note) => {
                let note = note.as_deref().unwrap_or_default();
                let _ = write!(
                    out,
                    "<td class=\"name\" colspan=\"6\">{}</td>",
                    escaped(note)
                );
            }
        }
        out += "</tr>\n";
    }
    out + "</table>\n"
}

/// Errors of numbers by themselves.
fn numbers_table(report: &Report) -> String {
    let mut out = String::new();
    let caption = numbers::caption(report);
    if caption.is_empty() {
        return out;
    }
    out += "<h2>Numbers</h2>\n";
    for line in caption {
        let _ = writeln!(out, "<p>{}</p>", escaped(&line));
    }
    let quantities = numbers::quantities(&report.rows);
    out += "<table>\n<tr><th></th><th class=\"name\">choice</th>";
    for &quantity in &quantities {
        let _ = write!(
            out,
            "<th>{}: 99.9 %</th><th>max</th>",
            escaped(&numbers::head(quantity))
        );
    }
    out += "<th>apart</th></tr>\n";
    for (k, row) in (1..).zip(&report.rows) {
        if row.numbers.is_empty() {
            continue;
        }
        let _ = write!(
            out,
            "<tr><td>{k}</td><td class=\"name\">{}</td>",
            escaped(&row.name)
        );
        for &quantity in &quantities {
            match numbers::number(row, quantity) {
                Some(n) => {
                    let (p999, max) = (brief(n.error.p999), brief(n.error.max));
                    let _ = write!(out, "<td>{p999}</td><td>{max}</td>");
                }
                None => out += "<td></td><td></td>",
            }
        }
        let _ = writeln!(out, "<td>{}</td></tr>", numbers::apart(row));
    }
    out + "</table>\n"
}

fn figure(picture: &Bitmap, caption: &str) -> Result<String, Error> {
    let bytes = STANDARD.encode(picture.png()?);
    Ok(format!(
        "<figure><img alt=\"{caption}\" src=\"data:image/png;base64,{bytes}\"><figcaption>{caption}</figcaption></figure>\n"
    ))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
