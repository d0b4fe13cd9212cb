//! Tables of what was lost.

use std::fmt::Write as _;

use pullback_compiler::lower::Precision;

use super::measure::{Loss, Row, Way};

/// A word for each way, in the order of [`Way::ALL`]; `+` is with rewrites.
pub const WORDS: [&str; 8] = [
    "fast",
    "fast+",
    "accurate",
    "accurate+",
    "extended",
    "extended+",
    "double",
    "double+",
];

/// How a table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// In columns.
    Text,
    /// As a table of Markdown.
    Markdown,
    /// One line a row, with tabs.
    Tabs,
}

/// Median, mean and count of some losses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// How many.
    pub count: usize,
    /// Half of them lose at most this much.
    pub median: f64,
    /// Their mean.
    pub mean: f64,
}

/// The summary of numbers.
#[must_use]
pub fn summary(numbers: impl Iterator<Item = f64>) -> Summary {
    let mut sorted: Vec<f64> = numbers.collect();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len();
    if count == 0 {
        return Summary::default();
    }
    Summary {
        count,
        median: f64::midpoint(sorted[(count - 1) / 2], sorted[count / 2]),
        mean: sorted.iter().sum::<f64>() / count as f64,
    }
}

/// Bits of each way over the rows, by a measure.
fn summaries<'r>(
    rows: impl Iterator<Item = &'r Row<'r>> + Clone,
    of: impl Fn(Loss) -> f64,
) -> [Option<Summary>; 8] {
    std::array::from_fn(|way| {
        let summary = summary(rows.clone().filter_map(|r| r.losses[way]).map(&of));
        (summary.count > 0).then_some(summary)
    })
}

/// The summary tables: all, and those on which cancellation dominates.
#[must_use]
pub fn totals(rows: &[Row], markdown: bool) -> String {
    let style = if markdown {
        Style::Markdown
    } else {
        Style::Text
    };
    let mut out = String::new();
    let cancelling = rows.iter().filter(|r| r.benchmark.cancels());
    let sets: [(&str, Vec<&Row>); 2] = [
        ("All expressions", rows.iter().collect()),
        ("Where cancellation dominates", cancelling.collect()),
    ];
    for (title, set) in sets {
        let _ = writeln!(out, "{title}: {}\n", set.len());
        let mut lines = vec![header(&["bits", "measure"])];
        let single = summaries(set.iter().copied(), |loss| loss.single);
        let own = summaries(set.iter().copied(), |loss| loss.own);
        for (name, measure, sums) in [
            ("median", "as f32", &single),
            ("mean", "as f32", &single),
            ("median", "own format", &own),
            ("mean", "own format", &own),
        ] {
            let mut line = vec![name.to_owned(), measure.to_owned()];
            line.extend(sums.iter().map(|s| {
                s.map_or("-".to_owned(), |s| {
                    format!("{:.2}", if name == "mean" { s.mean } else { s.median })
                })
            }));
            lines.push(line);
        }
        out += &table(&lines, style);
        out.push('\n');
    }
    out + &comparison(rows)
}

/// What rewrites do to each tier.
#[must_use]
pub fn comparison(rows: &[Row]) -> String {
    let mut out = String::new();
    let changed = rows.iter().filter(|r| r.rewrites > 0).count();
    let _ = writeln!(out, "Rewritten: {changed}");
    for precision in Precision::ALL {
        let counts: Vec<String> = [NOISE, 0.1, LISTED]
            .iter()
            .map(|&more| format!("{} by {more}", worsened(rows, precision, more).len()))
            .collect();
        let worse = worsened(rows, precision, LISTED);
        let both = |row: &&Row| row.loss(precision, false).is_some();
        if !rows.iter().any(|r| both(&r)) {
            continue;
        }
        let _ = writeln!(
            out,
            "Worse by rewrites in `{}`, in bits: {}",
            format!("{precision:?}").to_lowercase(),
            counts.join(", ")
        );
        for (row, before, after) in worse {
            let _ = writeln!(out, "- {}: {before:.3} to {after:.3}", row.benchmark.id);
        }
    }
    out
}

/// What a tier may lose by rewrites, in bits, and still be said to be as good: a point of a benchmark's 64 that rounds to
/// the neighbour costs 1/64.
pub const NOISE: f64 = 0.25;

/// Rows worse by this much are listed, to be read.
const LISTED: f64 = 0.05;

/// Rows that a tier computes worse with rewrites by more than some bits, with the bits before and after, in the format of
/// the tier.
#[must_use]
pub fn worsened<'r, 'b>(
    rows: &'r [Row<'b>],
    precision: Precision,
    more: f64,
) -> Vec<(&'r Row<'b>, f64, f64)> {
    rows.iter()
        .filter_map(|row| {
            let before = row.loss(precision, false)?.own;
            let after = row.loss(precision, true)?.own;
            (after > before + more).then_some((row, before, after))
        })
        .collect()
}

fn header(first: &[&str]) -> Vec<String> {
    first
        .iter()
        .chain(&WORDS)
        .map(|&word| word.to_owned())
        .collect()
}

/// One line for each row: its bits in every way as `f32`, and in the tier's own format for the wide ones.
#[must_use]
pub fn details(rows: &[Row], style: Style) -> String {
    let mut head = header(&["id", "points", "24 bits"]);
    head.extend(WORDS[4..].iter().map(|w| format!("{w} own")));
    head.push("formula".to_owned());
    let mut lines = vec![head];
    for row in rows {
        let b = row.benchmark;
        let mut line = vec![
            b.id.clone(),
            b.points.len().to_string(),
            format!("{:.2}", b.plain),
        ];
        let number = |loss: Option<f64>| loss.map_or("-".to_owned(), |x| format!("{x:.2}"));
        line.extend(row.losses.iter().map(|l| number(l.map(|l| l.single))));
        line.extend(row.losses[4..].iter().map(|l| number(l.map(|l| l.own))));
        line.push(match style {
            Style::Markdown => format!("`{}`", shortened(&b.program).replace('|', "\\|")),
            _ => shortened(&b.program),
        });
        lines.push(line);
    }
    table(&lines, style)
}

fn shortened(program: &str) -> String {
    const MOST: usize = 120;
    if program.chars().count() <= MOST {
        return program.to_owned();
    }
    program.chars().take(MOST - 1).chain(['…']).collect()
}

fn table(lines: &[Vec<String>], style: Style) -> String {
    let mut out = String::new();
    if style == Style::Text {
        let columns = lines.iter().map(Vec::len).max().unwrap_or(0);
        let width = |k: usize| {
            lines
                .iter()
                .filter_map(|l| l.get(k))
                .map(|s| s.chars().count())
                .max()
        };
        let widths: Vec<usize> = (0..columns).map(|k| width(k).unwrap_or(0)).collect();
        for line in lines {
            let cells: Vec<String> = line
                .iter()
                .zip(&widths)
                .map(|(cell, &width)| format!("{cell:<width$}"))
                .collect();
            let _ = writeln!(out, "{}", cells.join("  ").trim_end());
        }
        return out;
    }
    for (k, line) in lines.iter().enumerate() {
        if style == Style::Tabs {
            let _ = writeln!(out, "{}{}", if k == 0 { "# " } else { "" }, line.join("\t"));
            continue;
        }
        let _ = writeln!(out, "| {} |", line.join(" | "));
        if k == 0 {
            let _ = writeln!(out, "|{}", " --- |".repeat(line.len()));
        }
    }
    out
}

/// Everything as JSON, one object a benchmark.
#[must_use]
pub fn json(rows: &[Row]) -> String {
    let objects: Vec<String> = rows.iter().map(object).collect();
    format!("[\n{}\n]\n", objects.join(",\n"))
}

fn object(row: &Row) -> String {
    let b = row.benchmark;
    let ways: Vec<String> = WORDS
        .iter()
        .zip(&row.losses)
        .filter_map(|(word, loss)| {
            let loss = loss.as_ref()?;
            Some(format!(
                "{}: {{\"single\": {}, \"own\": {}}}",
                quoted(word),
                loss.single,
                loss.own
            ))
        })
        .collect();
    format!(
        "  {{\"id\": {}, \"name\": {}, \"precondition\": {}, \"program\": {}, \"points\": {}, \"plain\": {}, \
         \"rewrites\": {}, \"bits\": {{{}}}}}",
        quoted(&b.id),
        quoted(&b.name),
        quoted(&b.precondition),
        quoted(&b.program),
        b.points.len(),
        b.plain,
        row.rewrites,
        ways.join(", ")
    )
}

fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if u32::from(c) < 0x20 => {
                let _ = write!(out, "\\u{:04x}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// The rows by how much rewrites help `accurate`, or by what it loses where they have no part; the most telling first.
#[must_use]
pub fn telling<'r, 'b>(rows: &'r [Row<'b>]) -> Vec<&'r Row<'b>> {
    let gain = |row: &Row| {
        let loss = |on| row.loss(Precision::Accurate, on).map_or(0.0, |l| l.single);
        loss(false) - loss(true)
    };
    let mut sorted: Vec<&Row> = rows.iter().collect();
    sorted.sort_by(|a, b| {
        gain(b)
            .total_cmp(&gain(a))
            .then(b.benchmark.plain.total_cmp(&a.benchmark.plain))
    });
    sorted
}

/// The ways that a list of tiers means, each as written and with rewrites.
#[must_use]
pub fn ways(tiers: &[Precision]) -> Vec<Way> {
    Way::ALL
        .into_iter()
        .filter(|way| tiers.contains(&way.precision))
        .collect()
}
