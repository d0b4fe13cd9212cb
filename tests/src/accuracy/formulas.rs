//! Formulas with tables that state their error scale: the gallery, and the library of the language.

use pullback_compiler::What;
use pullback_compiler::formula::Formula;
use pullback_compiler::types::Type;

use super::error::{Format, OVERFLOW};
use super::evaluators::{Machine, Point};
use super::subjects::formula;

/// Evaluates a formula at points: a row of numbers for each; what is wrong in words.
pub type Run<'a> = dyn FnMut(&Formula, What, &[Point]) -> Result<Vec<Vec<f64>>, String> + 'a;

/// A formula with its rows.
#[derive(Clone, Debug)]
pub struct Table {
    /// The function that it covers, or its name in the gallery.
    pub name: &'static str,
    /// The program.
    pub source: String,
    /// Names of the columns.
    columns: Vec<&'static str>,
    rows: Vec<Vec<&'static str>>,
}

/// The greatest error factor that any formula may have, on any machine.
pub const MOST: f64 = 2.0;

/// Error factors of a formula: the least K with |computed - reference| <= 2 K u scale + 2⁻¹²⁶.
#[derive(Clone, Debug, Default)]
pub struct Factors {
    /// Of the value.
    pub value: f64,
    /// Of the derivatives.
    pub derivative: f64,
    /// Rows that were judged.
    pub rows: usize,
    /// Where the greater of both was met, in words.
    pub worst: String,
    /// Rows that are no numbers, or numbers where there are none.
    pub wrong: Vec<String>,
}

macro_rules! gallery {
    ($($name:literal),* $(,)?) => {
        [$((
            $name,
            include_str!(concat!("../../../docs/gallery/", $name, ".pull")),
            include_str!(concat!("../../data/gallery/", $name, ".tsv")),
        )),*]
    };
}

const GALLERY: [(&str, &str, &str); 70] = gallery![
    "bessel",
    "harmonic",
    "charges",
    "confocal",
    "doyle-mcmullen",
    "folium",
    "lambert",
    "zone-plate",
    "barth-sextic",
    "bipolar",
    "blaschke",
    "branch-cut",
    "cardinal-sine",
    "cayley",
    "cells",
    "chladni",
    "chmutov",
    "clebsch",
    "cloud",
    "ding-dong",
    "dipole",
    "dome",
    "ember",
    "essential",
    "gyroid",
    "heart",
    "himmelblau",
    "helix",
    "hologram",
    "interference",
    "joukowski",
    "julia-set",
    "kifs",
    "kummer",
    "landscape",
    "lemniscate",
    "mandelbrot",
    "mandelbulb",
    "mist",
    "multipole",
    "neovius",
    "newton",
    "newton-basins",
    "norms",
    "orbit-trap",
    "orbital",
    "parabolic",
    "peaks",
    "pebble",
    "rainbow-tunnel",
    "rational",
    "resonance",
    "saddle",
    "schwarz-family",
    "schwarz-p",
    "shadow",
    "sin-rings",
    "smooth-union",
    "sparks",
    "spiral",
    "sponge",
    "spotlight",
    "square-wave",
    "steiner",
    "tangent",
    "tangent-weave",
    "tanglecube",
    "torus",
    "twirl",
    "z-to-z",
];

const LIBRARY: &str = concat!(
    include_str!("../../data/functions/library.txt"),
    include_str!("../../data/functions/shapes.txt"),
    include_str!("../../data/functions/noise.txt"),
    include_str!("../../data/functions/light.txt"),
);

const SPECIAL: &str = concat!(
    include_str!("../../data/functions/special.txt"),
    include_str!("../../data/functions/special_bessel.txt"),
    include_str!("../../data/functions/elliptic.txt"),
);

/// The formulas of the gallery.
#[must_use]
pub fn gallery() -> Vec<Table> {
    let table = |&(name, source, text): &(&'static str, &'static str, &'static str)| {
        let mut lines = text.lines().skip(1);
        let columns = columns(lines.next().unwrap_or(""));
        let rows = lines.map(|line| line.split('\t').collect()).collect();
        Table {
            name,
            source: source.to_owned(),
            columns,
            rows,
        }
    };
    GALLERY.iter().map(table).collect()
}

/// Formulas that cover the library of the language, and the functions on vectors.
#[must_use]
pub fn library() -> Vec<Table> {
    sections(LIBRARY)
}

/// Special functions that are defined in the language. Their scale is the goal: 8 u of the norm of a value, 32 u of that of a
/// derivative, and what a change of the argument by u makes.
#[must_use]
pub fn special() -> Vec<Table> {
    sections(SPECIAL)
}

fn sections(text: &'static str) -> Vec<Table> {
    let mut tables: Vec<Table> = Vec::new();
    for line in text.lines() {
        match (line.strip_prefix("# "), tables.last_mut()) {
            (Some(title), _) if title.contains(" | ") => {
                let (name, source) = title.split_once(" | ").unwrap_or((title, ""));
                let source = source.replace("f(x) =", "f(x: real) =") + "\n";
                tables.push(Table {
                    name,
                    source,
                    columns: Vec::new(),
                    rows: Vec::new(),
                });
            }
            (Some(_), Some(table)) => table.columns = columns(line),
            (None, Some(table)) => table.rows.push(line.split('\t').collect()),
            (_, None) => {}
        }
    }
    tables
}

fn columns(line: &'static str) -> Vec<&'static str> {
    line.trim_start_matches("# ").split('\t').collect()
}

/// A group of columns that make up one number, with the place of its scale.
struct Quantity {
    places: std::ops::Range<usize>,
    scale: usize,
}

impl Table {
    /// The table without the rows that have a note.
    #[must_use]
    pub fn without(mut self, note: &str) -> Self {
        self.rows
            .retain(|row| !row.last().is_some_and(|notes| notes.contains(note)));
        self
    }

    fn place(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|c| *c == name)
    }

    /// The columns from `first` on that a scale is stated for, in the order of the evaluators' results.
    fn quantities(&self) -> Vec<Quantity> {
        let scales = self.columns.iter().enumerate().filter_map(|(k, c)| {
            let name = c.strip_prefix("scale_")?;
            Some((k, name))
        });
        scales
            .map(|(scale, name)| {
                let re = self.place(&format!("{name}.re"));
                let first = re.or_else(|| self.place(name)).unwrap_or(0);
                let width = if re.is_some() { 2 } else { 1 };
                Quantity {
                    places: first..first + width,
                    scale,
                }
            })
            .collect()
    }

    /// Runs every row on a machine. Complex numbers are judged by norm: the scale is that of the whole number.
    ///
    /// # Errors
    /// The machine cannot evaluate it; in words.
    pub fn measure(&self, machine: &Machine) -> Result<Factors, String> {
        self.measure_by(machine.format(), &mut |formula, what, points| {
            machine.run(formula, what, points)
        })
    }

    /// The program with its constants as parameters, and what these are: tables of one function that differ in nothing else have
    /// one program. Orders and degrees stay constants.
    #[must_use]
    pub fn shared(&self) -> (String, Vec<f64>) {
        shared(&self.source)
    }

    /// A point for each row, with these values of the program's parameters.
    #[must_use]
    pub fn points(&self, params: &[f64]) -> Vec<Point> {
        let arity = self.arity().unwrap_or(0);
        let point = |row: &Vec<&str>| Point {
            args: row[..arity].iter().map(|c| number(c)).collect(),
            params: params.to_vec(),
        };
        self.rows.iter().map(point).collect()
    }

    /// Judges what a machine made of the rows: the value and then its derivatives.
    #[must_use]
    pub fn judge_rows(&self, results: &[Vec<f64>], format: Format) -> Factors {
        let mut factors = Factors::default();
        let arity = self.arity().unwrap_or(0);
        for (row, result) in self.rows.iter().zip(results) {
            self.judge(row, result, result, arity, format, &mut factors);
        }
        factors
    }

    /// How many columns are arguments.
    fn arity(&self) -> Option<usize> {
        self.place("f").or_else(|| self.place("f.re"))
    }

    /// [`Self::measure`] for whatever evaluates a formula, in this format.
    ///
    /// # Errors
    /// It cannot be evaluated; in words.
    pub fn measure_by(&self, format: Format, run: &mut Run) -> Result<Factors, String> {
        let (formula, params) = self.formula();
        let arity = self.arity().ok_or("no value column")?;
        let points = self.points(&params);
        let demand = demand(&formula);
        let values = run(&formula, What::Value, &points)?;
        let slopes = run(&formula, demand, &points)?;
        let mut factors = Factors::default();
        for ((row, value), slope) in self.rows.iter().zip(&values).zip(&slopes) {
            self.judge(row, value, slope, arity, format, &mut factors);
        }
        Ok(factors)
    }

    fn formula(&self) -> (Formula, Vec<f64>) {
        let params = pullback_compiler::compile(&self.source)
            .program
            .map(|p| p.params().iter().map(|p| p.default).collect())
            .unwrap_or_default();
        (formula(&self.source), params)
    }

    fn judge(
        &self,
        row: &[&'static str],
        value: &[f64],
        slopes: &[f64],
        arity: usize,
        format: Format,
        factors: &mut Factors,
    ) {
        let notes = row.last().copied().unwrap_or("");
        if notes.contains("coarse") || format != Format::Double && notes.contains("overflow") {
            return;
        }
        factors.rows += 1;
        for (k, quantity) in self.quantities().into_iter().enumerate() {
            let expected: Vec<f64> = quantity
                .places
                .clone()
                .map(|place| number(row[place]))
                .collect();
            if expected.iter().any(|e| e.is_nan() || e.abs() >= OVERFLOW) {
                continue;
            }
            let results = if k == 0 { value } else { slopes };
            let place = |k: usize| results.get(quantity.places.start - arity + k);
            let norm = (0..expected.len()).fold(0.0f64, |sum, k| {
                sum.hypot(place(k).map_or(0.0, |got| got - expected[k]))
            });
            let describe = || {
                format!(
                    "{} at {:?}: {results:?} for {expected:?}",
                    self.columns[quantity.places.start],
                    &row[..arity]
                )
            };
            let Some(factor) = factor(norm, number(row[quantity.scale]), format) else {
                factors.wrong.push(describe());
                continue;
            };
            if factor > factors.value.max(factors.derivative) {
                factors.worst = describe();
            }
            let slot = if k == 0 {
                &mut factors.value
            } else {
                &mut factors.derivative
            };
            *slot = slot.max(factor);
        }
    }
}

/// What gives the value of a formula and its derivatives.
#[must_use]
pub fn demand(formula: &Formula) -> What {
    if formula.inputs.iter().any(|i| i.ty == Type::Complex) {
        What::Derivative
    } else {
        What::Gradient
    }
}

/// Functions whose operands need not be whole numbers.
const CONTINUOUS: [&str; 6] = [
    "jacobi_",
    "weierstrass_",
    "hurwitz_",
    "hypergeometric",
    "euler_beta",
    "beta(",
];

fn shared(source: &str) -> (String, Vec<f64>) {
    let parts = source.split_once("= ");
    let Some((head, body)) = parts.filter(|(_, body)| {
        let inner = body.strip_prefix("diff(").unwrap_or(body);
        CONTINUOUS.iter().any(|name| inner.starts_with(name)) && !body.contains('/')
    }) else {
        return (source.to_owned(), Vec::new());
    };
    let complex = !head.contains("real");
    let (mut text, mut values) = (String::new(), Vec::new());
    let (mut rest, mut inside) = (body, false);
    while let Some(c) = rest.chars().next() {
        let starts = text.ends_with('(') || text.ends_with(' ');
        inside = text.ends_with("complex(") || inside && !text.ends_with(')');
        let end = rest.find([',', ')', '(']).unwrap_or(rest.len());
        if let Ok(value) = rest[..end].trim().parse::<f64>()
            && starts
        {
            let k = values.len();
            values.push(value);
            text += &if complex && !inside {
                values.push(0.0);
                format!("complex(p{k}, p{})", k + 1)
            } else {
                format!("p{k}")
            };
            rest = &rest[end..];
        } else {
            text.push(c);
            rest = &rest[c.len_utf8()..];
        }
    }
    let params: String = (0..values.len())
        .map(|k| format!("param p{k} = 0\n"))
        .collect();
    (format!("{params}{head}= {text}"), values)
}

/// The least K for an error; `None` for what no K allows.
pub(super) fn factor(error: f64, scale: f64, format: Format) -> Option<f64> {
    // scales are written with three digits; references with twenty, of which f64 keeps sixteen
    let (unit, slack) = match format {
        Format::Single => (2f64.powi(-24), f64::from(f32::MIN_POSITIVE)),
        Format::Pair => (2f64.powi(-48), f64::from(f32::MIN_POSITIVE)),
        Format::Double => (2f64.powi(-53), 1e-45),
    };
    let excess = error - slack;
    if excess.is_nan() || excess.is_infinite() {
        return None;
    }
    if excess <= 0.0 {
        return Some(0.0);
    }
    (scale > 0.0).then(|| excess / (2.0 * unit * scale))
}

pub(super) fn number(cell: &str) -> f64 {
    cell.parse()
        .unwrap_or_else(|_| panic!("`{cell}` is not a number"))
}
