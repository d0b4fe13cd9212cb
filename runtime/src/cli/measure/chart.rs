//! Time against error, both logarithmic.

use std::fmt::Write as _;

use pullback_runtime::measure::Row;

/// Lengths in pixels.
const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 440.0;
const LEFT: f64 = 72.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 20.0;
const BOTTOM: f64 = 52.0;
/// What an error of zero is drawn as, below the least other one.
const NOTHING: f64 = 0.3;

/// The chart of the rows that have both, with their numbers in the table.
pub(super) fn svg(rows: &[Row]) -> String {
    let points: Vec<Point> = (1..)
        .zip(rows)
        .filter_map(|(number, row)| Point::new(number, row))
        .collect();
    if points.is_empty() {
        return "<p>Nothing was both drawn and timed.</p>\n".to_owned();
    }
    let x = Axis::of(points.iter().map(|p| p.time), LEFT, WIDTH - RIGHT);
    let least = points
        .iter()
        .map(|p| p.error)
        .filter(|&e| e > 0.0)
        .fold(f64::INFINITY, f64::min);
    let floor = NOTHING * if least.is_finite() { least } else { 1e-6 };
    let height = |p: &Point| p.error.max(floor);
    let y = Axis::of(points.iter().map(height), HEIGHT - BOTTOM, TOP);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" \
         font-family=\"system-ui, sans-serif\" font-size=\"12\">\n"
    );
    grid(&mut out, &x, &y);
    let mut front: Vec<&Point> = points.iter().filter(|p| p.on_front).collect();
    front.sort_by(|a, b| a.time.total_cmp(&b.time));
    let line: Vec<String> = front
        .iter()
        .map(|p| format!("{:.1},{:.1}", x.place(p.time), y.place(height(p))))
        .collect();
    let _ = writeln!(
        out,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.5\"/>",
        line.join(" ")
    );
    for point in &points {
        let (cx, cy) = (x.place(point.time), y.place(height(point)));
        let colour = match (point.number, point.on_front) {
            (1, _) => "#d55e00",
            (_, true) => "#0072b2",
            _ => "#888888",
        };
        let _ = writeln!(
            out,
            "<circle cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"4.5\" fill=\"{colour}\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" fill=\"{colour}\">{}</text>",
            cx + 7.0,
            cy - 5.0,
            point.number
        );
    }
    out + "</svg>\n"
}

struct Point {
    number: usize,
    time: f64,
    error: f64,
    on_front: bool,
}

impl Point {
    fn new(number: usize, row: &Row) -> Option<Self> {
        Some(Self {
            number,
            time: 1e3 * row.time?.median,
            error: row.error?.seen.mean,
            on_front: row.on_front,
        })
    }
}

/// A logarithmic axis between two places.
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    fn of(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let logs = values.filter(|v| *v > 0.0).map(f64::log10);
        let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
        let (low, high) = if low.is_finite() {
            (low, high)
        } else {
            (0.0, 0.0)
        };
        // a little room, and half a decade at least
        let room = (0.08 * (high - low))
            .max(0.25 - 0.5 * (high - low))
            .max(0.05);
        Self {
            low: low - room,
            high: high + room,
            from,
            to,
        }
    }

    fn place(&self, value: f64) -> f64 {
        let share = (value.log10() - self.low) / (self.high - self.low);
        self.from + share * (self.to - self.from)
    }

    /// Round values with their places: 1, 2 and 5 of each decade.
    fn ticks(&self) -> Vec<(f64, String)> {
        let decades = (self.low.floor() as i32)..=(self.high.ceil() as i32);
        let values = decades.flat_map(|n| [1.0, 2.0, 5.0].map(|m| m * 10f64.powi(n)));
        let inside = values.filter(|v| (self.low..=self.high).contains(&v.log10()));
        let all: Vec<f64> = inside.collect();
        let sparse = all.len() > 12;
        let is_decade = |v: f64| (v.log10() - v.log10().round()).abs() < 1e-9;
        let kept = all.into_iter().filter(|&v| !sparse || is_decade(v));
        kept.map(|v| (self.place(v), super::table::brief(v)))
            .collect()
    }
}

fn grid(out: &mut String, x: &Axis, y: &Axis) {
    for (place, label) in x.ticks() {
        let _ = writeln!(
            out,
            "<line x1=\"{place:.1}\" x2=\"{place:.1}\" y1=\"{TOP}\" y2=\"{0}\" stroke=\"#dddddd\"/>\
             <text x=\"{place:.1}\" y=\"{1}\" text-anchor=\"middle\" fill=\"#444444\">{label}</text>",
            HEIGHT - BOTTOM,
            HEIGHT - BOTTOM + 18.0
        );
    }
    for (place, label) in y.ticks() {
        let _ = writeln!(
            out,
            "<line x1=\"{LEFT}\" x2=\"{0}\" y1=\"{place:.1}\" y2=\"{place:.1}\" stroke=\"#dddddd\"/>\
             <text x=\"{1}\" y=\"{2:.1}\" text-anchor=\"end\" fill=\"#444444\">{label}</text>",
            WIDTH - RIGHT,
            LEFT - 8.0,
            place + 4.0
        );
    }
    let _ = writeln!(
        out,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">milliseconds a picture</text>\
         <text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">mean error (FLIP)</text>",
        0.5 * (LEFT + WIDTH - RIGHT),
        HEIGHT - 12.0,
        0.5 * (TOP + HEIGHT - BOTTOM)
    );
}
