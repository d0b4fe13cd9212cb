//! The findings as text.

use std::io::{self, Write};

use pullback_runtime::measure::{Row, SEEN, Time};

use super::{Findings, numbers};

/// Writes a table and what follows from it to the standard output.
pub(super) fn tell(findings: &Findings) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    for line in head(findings) {
        writeln!(out, "{line}")?;
    }
    let rows = &findings.report.rows;
    let width = width(rows);
    writeln!(
        out,
        "\n    {:<width$}  {:>9} {:>13}  {:>8} {:>7}  {:>8} {:>8} {:>7}",
        "choice", "ms", "middle half", "light", "99.9 %", "seen", "±", "99.9 %"
    )?;
    for (number, row) in (1..).zip(rows) {
        let mark = if row.on_front { '*' } else { ' ' };
        writeln!(
            out,
            "{number:>2} {mark}{:<width$}  {}",
            row.name,
            measured(row)
        )?;
    }
    writeln!(out, "\n* nothing else is as fast and as accurate")?;
    for sentence in sentences(findings) {
        writeln!(out, "{sentence}")?;
    }
    for sentence in numbers::second_run(findings.report) {
        writeln!(out, "{sentence}")?;
    }
    let caption = numbers::caption(findings.report);
    if !caption.is_empty() {
        writeln!(out)?;
    }
    for line in caption.into_iter().chain(numbers::lines(rows)) {
        writeln!(out, "{line}")?;
    }
    out.flush()
}

/// Characters of the longest name of a choice.
pub(super) fn width(rows: &[Row]) -> usize {
    let lengths = rows.iter().map(|row| row.name.chars().count());
    lengths.max().unwrap_or(0).max(6)
}

/// What was measured and against what, a sentence a line.
pub(super) fn head(findings: &Findings) -> Vec<String> {
    let report = findings.report;
    let [known, all] = report.pixels;
    let clock = if report
        .rows
        .iter()
        .any(|r| r.time.is_some_and(|t| t.by_device))
    {
        "the device's clock; pictures that take longer than 0.25 s by ours, with the way back of their pixels"
    } else {
        "our clock, from the call until the pixels are here"
    };
    let share = if known == all {
        "all of its pixels".to_owned()
    } else {
        format!("{known} of its {all} pixels, in squares spread over it")
    };
    let steps = if report.more_steps {
        "eight times the steps, "
    } else {
        ""
    };
    let mut lines = vec![
        format!("{} on {}", findings.title, findings.adapter),
        format!(
            "{}x{} pixels in linear light, by {clock}",
            findings.size.width, findings.size.height
        ),
        format!(
            "truth: f64 on the processor, {steps}{0}x{0} samples, at {share}",
            report.true_samples
        ),
    ];
    if let Some(own) = report.own {
        lines.push(format!(
            "with half of that the truth itself is off by {} (mean FLIP)",
            brief(own.seen.mean)
        ));
    }
    lines
}

fn measured(row: &Row) -> String {
    let time = row
        .time
        .map_or_else(|| format!("{:>9} {:>13}", "-", ""), |t| times(&t));
    let error = row.error.map_or_else(String::new, |e| {
        format!(
            "{:>8} {:>7}  {:>8} {:>8} {:>7}",
            brief(e.light.mean),
            brief(e.light.p999),
            brief(e.seen.mean),
            brief(e.doubt),
            brief(e.seen.p999)
        )
    });
    let note = row
        .note
        .as_ref()
        .map_or_else(String::new, |note| format!("  {note}"));
    format!("{time}  {error}{note}").trim_end().to_owned()
}

fn times(time: &Time) -> String {
    let ms = |seconds: f64| brief(1e3 * seconds);
    let spread = format!("{}–{}", ms(time.low), ms(time.high));
    format!("{:>9} {spread:>13}", ms(time.median))
}

/// Three digits.
pub(super) fn brief(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0".to_owned()
    } else if !x.is_finite() {
        "?".to_owned()
    } else if size >= 100.0 {
        format!("{x:.0}")
    } else if size >= 10.0 {
        format!("{x:.1}")
    } else if size >= 1.0 {
        format!("{x:.2}")
    } else if size >= 0.001 {
        format!("{x:.4}")
    } else {
        format!("{x:.1e}")
    }
}

/// What to choose.
pub(super) fn sentences(findings: &Findings) -> Vec<String> {
    let report = findings.report;
    let name = |k: usize| report.rows.get(k).map_or("", |row| row.name.as_str());
    let time = |k: usize| {
        report
            .rows
            .get(k)
            .and_then(|row| row.time)
            .map(|t| t.median)
    };
    let against = |k: usize| match (time(k), time(0)) {
        (Some(here), Some(default)) if k != 0 && default > 0.0 => {
            format!(" ({:.2} of the default's time)", here / default)
        }
        _ => String::new(),
    };
    let mut out = Vec::new();
    out.push(match report.advice.unseen {
        Some(k) => format!(
            "For a picture that cannot be told from the truth, take: {}{}.",
            name(k),
            against(k)
        ),
        None if !report.is_enough() => format!(
            "The truth is known at {} pixels, too few to say what cannot be told from it: give more --budget.",
            report.pixels[0]
        ),
        None => format!(
            "No choice gives a picture that cannot be told from the truth (99.9 % of its pixels below a FLIP of {SEEN})."
        ),
    });
    out.push(match report.advice.half {
        Some(k) => format!(
            "For half the time at most, take: {}{}.",
            name(k),
            against(k)
        ),
        None => "No choice takes half the time of the default.".to_owned(),
    });
    if let Some(default) = report
        .rows
        .first()
        .filter(|row| row.error.is_some() && row.time.is_some())
    {
        out.push(if default.on_front {
            "The default is on the front: nothing is as fast and as accurate.".to_owned()
        } else {
            "The default is not on the front: something is as fast and as accurate, or better."
                .to_owned()
        });
    }
    out
}

#[cfg(test)]
mod tests {
    use super::brief;

    #[test]
    fn numbers_are_brief() {
        let written = [0.0, 123.4, 12.34, 1.234, 0.1234, 1.2e-5, f64::INFINITY].map(brief);
        assert_eq!(
            written,
            ["0", "123", "12.3", "1.23", "0.1234", "1.2e-5", "?"]
        );
    }
}
