//! Views of falling width around points where a field has detail at every scale, and where each tier stops being true.
//!
//! The true values come from `tests/oracle/deep_zoom.py`, with 60 digits.

use std::fmt::Write as _;

use pullback_compiler::lower::Precision;
use pullback_compiler::{Program, compile};
use pullback_runtime::auto::{self, Outcome, Sample, Scenery, Subject};
use pullback_runtime::{Frame, Gpu, Pipeline, Size, View};

use crate::corpus::{read, root};

/// A field with its centre.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Its name in the table.
    pub name: &'static str,
    /// Its program.
    pub text: &'static str,
    /// Where the views are centred.
    pub center: [f64; 2],
}

/// The fields of the table.
pub const FIELDS: [Field; 3] = [
    Field {
        name: "mandelbrot",
        text: "f(x, y) = log(|r.z| log|r.z| / |r.d|)
  where c = x + i y,
        r = iterate(500, z = 0, d = 0, (z² + c, 2z d + 1) until |z| > 1000)
show levels(f) { color_scale = 4, spacing = 0.5, palette = sequential }",
        center: [-0.101_096_363_845_622_16, 0.956_286_510_809_141_5],
    },
    Field {
        name: "ripples",
        text: "f(x, y) = sin(3 log((x - 1/3)² + (y - 1/7)²))
show levels(f) { color_scale = 1, spacing = 0.25 }",
        center: [1.0 / 3.0, 1.0 / 7.0],
    },
    Field {
        name: "sweep",
        text: "f(x, y) = sin(1/(x² + y²))
show levels(f) { color_scale = 1, spacing = 0.25 }",
        center: [0.004, 0.001],
    },
];

/// Pixels of the pictures whose lines are judged.
const SIZE: Size = Size {
    width: 640,
    height: 480,
};

/// One view of a field with true values in it.
#[derive(Clone, Debug)]
pub struct Zoom {
    /// World units from the left to the right edge.
    pub width: f64,
    samples: Vec<Sample>,
    truth: Vec<f64>,
}

impl Zoom {
    /// World units from the bottom to the top edge.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.width * f64::from(SIZE.height) / f64::from(SIZE.width)
    }
}

/// The views of a field in the table, the widest first.
#[must_use]
pub fn zooms(field: &Field) -> Vec<Zoom> {
    let text = read(&root().join("tests/data/deep_zoom.tsv"));
    let mut out: Vec<Zoom> = Vec::new();
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        let mut columns = line.split('\t');
        if columns.next() != Some(field.name) {
            continue;
        }
        let numbers: Vec<f64> = columns.map(|c| c.parse().expect("a number")).collect();
        let &[width, x, y, value, dx, dy] = numbers.as_slice() else {
            panic!("a row of the table: {line}");
        };
        if out.last().is_none_or(|zoom| zoom.width != width) {
            out.push(Zoom {
                width,
                samples: Vec::new(),
                truth: Vec::new(),
            });
        }
        let zoom = out.last_mut().expect("just pushed");
        zoom.samples.push(Sample {
            point: [field.center[0] + x, field.center[1] + y, 0.0],
            footprint: width / f64::from(SIZE.width),
            subject: Subject::Picture,
        });
        zoom.truth.extend([value, dx, dy]);
    }
    out
}

/// The program of a field.
#[must_use]
pub fn program(field: &Field) -> Program {
    compile(field.text).program.expect("a field compiles")
}

/// What comes of a tier in a view.
#[must_use]
pub fn outcome(
    gpu: &Gpu,
    field: &Field,
    program: &Program,
    zoom: &Zoom,
    precision: Precision,
) -> Outcome {
    let frame = Frame {
        view: View {
            center: field.center,
            height: zoom.height(),
        },
        params: &[],
        settings: &[],
        size: SIZE,
        samples: 1,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let scenery = Scenery {
        program,
        picture: 0,
        settings: &program.pictures()[0].settings,
        frame: &frame,
    };
    auto::compare(gpu, &scenery, precision, &zoom.samples, &zoom.truth)
        .unwrap_or_else(|problem| panic!("{}: {problem:?}", field.name))
}

/// The width of the last view down to which a tier is true in all, if it is in the first.
#[must_use]
pub fn last_true_width(gpu: &Gpu, field: &Field, precision: Precision) -> Option<f64> {
    let program = program(field);
    zooms(field)
        .iter()
        .take_while(|zoom| {
            matches!(
                outcome(gpu, field, &program, zoom, precision),
                Outcome::Same(_)
            )
        })
        .last()
        .map(|zoom| zoom.width)
}

/// A table of what comes of every tier in every view: the share of samples that differ visibly.
#[must_use]
pub fn table(gpu: &Gpu) -> String {
    let mut out = String::from("| field | width |");
    for precision in Precision::ALL {
        let _ = write!(out, " {} |", precision.name());
    }
    out.push_str("\n| --- | --- | --- | --- | --- | --- |\n");
    for field in &FIELDS {
        let program = program(field);
        for zoom in zooms(field) {
            let _ = write!(out, "| {} | {:e} |", field.name, zoom.width);
            for precision in Precision::ALL {
                let seen = match outcome(gpu, field, &program, &zoom, precision) {
                    Outcome::NotOffered => "not offered".to_owned(),
                    Outcome::Unresolved => "unresolved".to_owned(),
                    Outcome::Same(_) => "true".to_owned(),
                    Outcome::Differs { count, .. } => {
                        format!("{} % differ", 100 * count / zoom.samples.len())
                    }
                };
                let _ = write!(out, " {seen} |");
            }
            out.push('\n');
        }
    }
    out
}
