//! Tables as charts: a line for each row, a dot for each number, on a logarithmic axis.

use std::fmt::Write as _;

/// Lengths in pixels.
const WIDTH: f64 = 760.0;
const LEFT: f64 = 150.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 58.0;
const ROW: f64 = 15.0;
const BOTTOM: f64 = 34.0;
/// Colours that people of all kinds of sight tell apart (M. Okabe, K. Ito, "Color universal design", 2008).
const COLOURS: [&str; 4] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"];

/// A table in Markdown, and which of its columns are shown.
pub(super) struct Chart<'a> {
    pub(super) title: &'a str,
    /// What the axis is of.
    pub(super) axis: &'a str,
    /// Columns from 0, and their names.
    pub(super) columns: &'a [(usize, &'a str)],
}

impl Chart<'_> {
    /// The chart of the lines of a table that have numbers; nothing where there are none.
    pub(super) fn svg(&self, table: &str) -> Option<String> {
        let rows: Vec<(String, Vec<Option<f64>>)> =
            table.lines().filter_map(|line| self.row(line)).collect();
        let values = || rows.iter().flat_map(|(_, all)| all.iter().flatten());
        let (low, high) = values().fold((f64::INFINITY, 0.0_f64), |(low, high), &v| {
            (low.min(v), high.max(v))
        });
        if !low.is_finite() {
            return None;
        }
        let span = ((low / 1.2).log10(), (high * 1.2).log10());
        let height = TOP + ROW * rows.len() as f64 + BOTTOM;
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" height=\"{height}\" \
             font-family=\"system-ui, sans-serif\" font-size=\"11\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
             <text x=\"{LEFT}\" y=\"18\" font-size=\"14\">{}</text>\n",
            self.title
        );
        self.legend(&mut out);
        axis(&mut out, span, height);
        let _ = writeln!(
            out,
            "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text>",
            0.5 * (LEFT + WIDTH - RIGHT),
            height - 4.0,
            self.axis
        );
        for (k, (name, numbers)) in rows.iter().enumerate() {
            let y = TOP + ROW * (k as f64 + 0.5);
            let _ = writeln!(
                out,
                "<text x=\"{:.0}\" y=\"{:.1}\" text-anchor=\"end\">{name}</text>\
                 <line x1=\"{LEFT}\" x2=\"{:.0}\" y1=\"{y:.1}\" y2=\"{y:.1}\" stroke=\"#eeeeee\"/>",
                LEFT - 8.0,
                y + 4.0,
                WIDTH - RIGHT
            );
            for (number, colour) in numbers.iter().zip(COLOURS) {
                if let Some(number) = number {
                    let x = place(*number, span);
                    let _ = writeln!(
                        out,
                        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"{colour}\"/>"
                    );
                }
            }
        }
        Some(out + "</svg>\n")
    }

    /// The name and the numbers of a line; nothing of the head, and of a line without numbers.
    fn row(&self, line: &str) -> Option<(String, Vec<Option<f64>>)> {
        let cells: Vec<&str> = line
            .strip_prefix("| ")?
            .split(" |")
            .map(str::trim)
            .collect();
        let number = |&(k, _): &(usize, &str)| {
            let word = cells.get(k)?.split_whitespace().next()?;
            word.parse::<f64>()
                .ok()
                .filter(|x| *x > 0.0 && x.is_finite())
        };
        let numbers: Vec<Option<f64>> = self.columns.iter().map(number).collect();
        let name = cells.first()?.replace('&', "&amp;").replace('<', "&lt;");
        numbers
            .iter()
            .any(Option::is_some)
            .then_some((name, numbers))
    }

    fn legend(&self, out: &mut String) {
        let mut x = LEFT;
        for ((_, name), colour) in self.columns.iter().zip(COLOURS) {
            let _ = writeln!(
                out,
                "<circle cx=\"{:.0}\" cy=\"34\" r=\"3.5\" fill=\"{colour}\"/><text x=\"{:.0}\" y=\"38\">{name}</text>",
                x + 4.0,
                x + 12.0
            );
            x += 30.0 + 6.5 * name.chars().count() as f64;
        }
    }
}

/// Of a number on an axis between two powers of ten.
fn place(number: f64, (low, high): (f64, f64)) -> f64 {
    LEFT + (number.log10() - low) / (high - low) * (WIDTH - RIGHT - LEFT)
}

/// Lines at 1, 2 and 5 of each decade, at decades alone where those are many.
fn axis(out: &mut String, span: (f64, f64), height: f64) {
    let marks: &[f64] = if span.1 - span.0 > 3.0 {
        &[1.0]
    } else {
        &[1.0, 2.0, 5.0]
    };
    for decade in (span.0.floor() as i32)..=(span.1.ceil() as i32) {
        for mark in marks {
            let number = mark * 10f64.powi(decade);
            if !(span.0..=span.1).contains(&number.log10()) {
                continue;
            }
            let x = place(number, span);
            let bottom = height - BOTTOM;
            let label = if (1e-3..1e4).contains(&number) {
                format!("{number}")
            } else {
                format!("{number:e}")
            };
            let _ = writeln!(
                out,
                "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{TOP}\" y2=\"{bottom}\" stroke=\"#cccccc\"/>\
                 <text x=\"{x:.1}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"#444444\">{label}</text>",
                bottom + 14.0
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dots_stand_at_their_numbers() {
        let chart = Chart {
            title: "t",
            axis: "ms",
            columns: &[(1, "a"), (2, "b")],
        };
        let table = "head\n\n| name | a | b |\n| --- | --- | --- |\n| x<y | 1 (80×45) | 100 |\n| z | - | 10 |\n";
        let svg = chart.svg(table).unwrap();
        assert_eq!(svg.matches("r=\"3.5\"").count(), 2 + 3, "{svg}");
        assert!(svg.contains("x&lt;y") && !svg.contains(">name<"));
        let middle = place(10.0, ((1.0 / 1.2f64).log10(), 120f64.log10()));
        assert!((middle - 0.5 * (LEFT + WIDTH - RIGHT)).abs() < 1e-9);
        assert_eq!(chart.svg("| name | a | b |\n| x | - | - |\n"), None);
    }
}
