//! A survey as a picture: for each function the errors of its tiers on one logarithmic axis.
//!
//! Units differ between the formats, so the axis is the error as a share of the result. A dot is the largest error, a
//! bar on the line to it what 99.9 % of all cases do not exceed.

use pullback_compiler::lower::Precision;

use super::error::{Format, Judge};
use super::measure::in_metric;
use super::report::MOST_CASES;
use super::survey::{Finding, Row, Survey, tier_name};
use super::tables::Domain;

/// Decades of the axis: below is what is exact, above what is wrong altogether.
const LEAST: f64 = -18.0;
const MOST: f64 = 1.0;
/// Lengths in pixels.
const LABEL: f64 = 112.0;
const PLOT: f64 = 430.0;
const GAP: f64 = 40.0;
const MARGIN: f64 = 24.0;
const LINE: f64 = 19.0;
const HEAD: f64 = 128.0;
const FOOT: f64 = 30.0;

/// The colours of the tiers, apart also for the colour-blind (Okabe and Ito, "Color Universal Design", 2008).
fn color(tier: Option<Precision>) -> &'static str {
    match tier {
        None => "#555555",
        Some(Precision::Fast) => "#d55e00",
        Some(Precision::Accurate) => "#0072b2",
        Some(Precision::Extended) => "#009e73",
        Some(Precision::Double) => "#cc79a7",
    }
}

/// The chart: functions of reals in the left column, of complex numbers in the right one.
#[must_use]
pub fn svg(survey: &Survey) -> String {
    let columns: Vec<(&str, Vec<&Row>)> = [("real", Domain::Real), ("complex", Domain::Complex)]
        .into_iter()
        .map(|(title, domain)| {
            let rows = survey.rows.iter().filter(|r| r.subject.domain == domain);
            (title, rows.collect::<Vec<_>>())
        })
        .filter(|(_, rows)| !rows.is_empty())
        .collect();
    let count = columns.len().max(1) as f64;
    let lines = columns
        .iter()
        .map(|(_, rows)| rows.len())
        .max()
        .unwrap_or(0);
    let width = 2.0 * MARGIN + count * (LABEL + PLOT) + (count - 1.0) * GAP;
    let height = HEAD + lines as f64 * LINE + FOOT;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"'DejaVu Sans', Verdana, sans-serif\" font-size=\"11\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    out += &heading(survey);
    for (k, (title, rows)) in columns.iter().enumerate() {
        let left = MARGIN + k as f64 * (LABEL + PLOT + GAP) + LABEL;
        out += &axis(left, title, rows.len());
        for (line, row) in rows.iter().enumerate() {
            out += &errors(left, HEAD + (line as f64 + 0.5) * LINE, row);
        }
    }
    out + "</svg>\n"
}

fn heading(survey: &Survey) -> String {
    let title = if survey.adapter.is_empty() {
        "the f64 reference".to_owned()
    } else {
        short(&survey.adapter)
    };
    let mut out = format!(
        "<text x=\"{MARGIN}\" y=\"26\" font-size=\"15\" font-weight=\"bold\">Largest error of each function, as a share of \
         its result</text>\n<text x=\"{MARGIN}\" y=\"44\" fill=\"#444444\">{}</text>\n",
        escaped(&title)
    );
    let first = survey.rows.iter().max_by_key(|row| row.findings.len());
    let mut x = MARGIN + 5.0;
    for finding in first.map(|row| row.findings.as_slice()).unwrap_or_default() {
        let name = tier_name(finding.tier);
        out += &dot(x, 61.0, color(finding.tier));
        out += &format!("<text x=\"{}\" y=\"65\">{name}</text>\n", x + 9.0);
        x += 34.0 + 7.0 * name.len() as f64;
    }
    out + &format!(
        "<text x=\"{MARGIN}\" y=\"81\" font-size=\"10\" fill=\"#444444\">dot: largest error; bar: 99.9 % of all cases; cross: wrong class (NaN, infinity, sign)</text>\n"
    )
}

/// The device alone, where the driver repeats its name.
fn short(adapter: &str) -> String {
    adapter.chars().take(110).collect()
}

fn axis(left: f64, title: &str, lines: usize) -> String {
    let bottom = HEAD + lines as f64 * LINE;
    let mut out = format!(
        "<text x=\"{}\" y=\"{}\" font-weight=\"bold\" text-anchor=\"end\">{title}</text>\n",
        left - 10.0,
        HEAD - 25.0
    );
    for line in (1..lines).step_by(2) {
        out += &format!(
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{LINE}\" fill=\"#f4f4f4\"/>\n",
            left - LABEL,
            HEAD + line as f64 * LINE,
            LABEL + PLOT
        );
    }
    let mut tick = LEAST;
    while tick <= MOST {
        let x = place(left, tick);
        out += &format!(
            "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{HEAD}\" y2=\"{bottom}\" stroke=\"#dddddd\"/>\n"
        );
        let label = if tick == LEAST {
            "exact".to_owned()
        } else if tick == 0.0 {
            "1".to_owned()
        } else {
            format!("10<tspan dy=\"-4\" font-size=\"8\">{tick}</tspan>")
        };
        for y in [HEAD - 8.0, bottom + 16.0] {
            out += &format!(
                "<text x=\"{x:.1}\" y=\"{y}\" text-anchor=\"middle\" fill=\"#444444\">{label}</text>\n"
            );
        }
        tick += 3.0;
    }
    // one ulp of each format, between 2⁻ᵖ and 2¹⁻ᵖ of a number
    for (format, name, anchor) in [
        (Format::Single, "ulp of f32", "middle"),
        (Format::Pair, "2⁻⁴⁸", "start"),
        (Format::Double, "ulp of f64", "end"),
    ] {
        let x = place(left, share(format).log10());
        out += &format!(
            "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{}\" y2=\"{bottom}\" stroke=\"#888888\" stroke-dasharray=\"2 3\"/>\n\
             <text x=\"{x:.1}\" y=\"{}\" font-size=\"9\" text-anchor=\"{anchor}\" fill=\"#666666\">{name}</text>\n",
            HEAD - 22.0,
            HEAD - 25.0
        );
    }
    out
}

/// The size of a unit as a share of a number just above a power of two.
fn share(format: Format) -> f64 {
    format.unit(1.0)
}

fn place(left: f64, exponent: f64) -> f64 {
    let within = exponent.clamp(LEAST, MOST);
    left + (within - LEAST) / (MOST - LEAST) * PLOT
}

/// One line: the name, and for each tier a dot, one beside another in height so that equal errors are all seen.
fn errors(left: f64, y: f64, row: &Row) -> String {
    let mut out = format!(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n",
        left - 10.0,
        y + 4.0,
        escaped(row.subject.word)
    );
    let count = row.findings.len() as f64;
    for (k, finding) in row.findings.iter().enumerate() {
        let offset = (k as f64 - (count - 1.0) / 2.0) * 3.4;
        out += &mark(left, y + offset, row, finding);
    }
    out
}

fn mark(left: f64, y: f64, row: &Row, finding: &Finding) -> String {
    let errors = in_metric(&finding.measured.value, finding.declared.metrics[0]);
    let wrong = !errors.wrong.is_empty();
    let exponent = |units: f64| {
        if units == 0.0 {
            LEAST
        } else {
            (units * share(finding.format)).log10()
        }
    };
    let most = if wrong { MOST } else { exponent(errors.max()) };
    let (x, bar) = (
        place(left, most),
        place(left, exponent(errors.quantile(MOST_CASES))),
    );
    let paint = color(finding.tier);
    let what = format!(
        "{}, {}: {} units, 99.9 %: {}{}",
        row.subject.name(),
        tier_name(finding.tier),
        super::report::units(errors.max()),
        super::report::units(errors.quantile(MOST_CASES)),
        if wrong {
            format!(", {} of the wrong class", errors.wrong.len())
        } else {
            String::new()
        }
    );
    let mut out = format!("<g><title>{}</title>", escaped(&what));
    if x - bar > 2.0 {
        out += &format!(
            "<line x1=\"{bar:.1}\" x2=\"{x:.1}\" y1=\"{y:.1}\" y2=\"{y:.1}\" stroke=\"{paint}\" stroke-opacity=\"0.45\"/>"
        );
        out += &format!(
            "<line x1=\"{bar:.1}\" x2=\"{bar:.1}\" y1=\"{:.1}\" y2=\"{:.1}\" stroke=\"{paint}\" stroke-width=\"1.5\"/>",
            y - 3.0,
            y + 3.0
        );
    }
    if wrong {
        // a cross: no number says how wrong a NaN is
        let (a, b) = (x - 3.0, x + 3.0);
        out += &format!(
            "<path d=\"M{a:.1} {:.1}L{b:.1} {:.1}M{a:.1} {:.1}L{b:.1} {:.1}\" stroke=\"{paint}\" stroke-width=\"1.6\"/>",
            y - 3.0,
            y + 3.0,
            y + 3.0,
            y - 3.0
        );
    } else {
        out += &dot(x, y, paint);
    }
    out + "</g>\n"
}

fn dot(x: f64, y: f64, paint: &str) -> String {
    format!(
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{paint}\" stroke=\"#ffffff\" stroke-width=\"0.6\"/>"
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
