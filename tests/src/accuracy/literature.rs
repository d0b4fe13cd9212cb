//! Published formulas with tables that state their error scale, one program and one table each.
//!
//! Where rounding decides a comparison, such as whether an orbit has escaped, the table has a row for each outcome,
//! and either is right. Where an intermediate result leaves the range of a format, an infinity or a NaN is right,
//! and so is the number, but no other number.

use std::collections::BTreeMap;

use pullback_compiler::What;
use pullback_compiler::formula::Formula;
use pullback_compiler::types::Type;

use super::error::{Format, OVERFLOW};
use super::evaluators::{Machine, Point};
use super::formulas::{Factors, factor, number};
use crate::corpus;

const FOLDER: &str = "tests/data/literature";

/// A published formula with its references.
#[derive(Debug)]
pub struct Published {
    /// The name of its files.
    pub name: String,
    /// The program.
    pub source: String,
    quantities: Vec<Quantity>,
    cases: Vec<Case>,
}

/// A number of the table: the value, or a derivative.
#[derive(Debug)]
struct Quantity {
    name: String,
    /// Its columns.
    places: std::ops::Range<usize>,
    /// The column of its error scale.
    scale: usize,
}

/// A point, with the rows that are right there: the first in exact arithmetic, others by rounding.
#[derive(Debug)]
struct Case {
    args: Vec<f64>,
    rows: Vec<Vec<f64>>,
    notes: Vec<String>,
}

/// What is asked of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Order {
    Value,
    First,
    Second,
}

fn order(quantity: &str) -> Order {
    let variables = quantity.strip_prefix('d').unwrap_or("");
    match variables {
        "" => Order::Value,
        "zbar" => Order::First,
        _ if variables.len() == 1 => Order::First,
        _ => Order::Second,
    }
}

/// All published formulas.
///
/// # Panics
/// A program has no table, or a table is malformed.
#[must_use]
pub fn published() -> Vec<Published> {
    let mut tables: BTreeMap<String, String> = corpus::files(FOLDER, "tsv")
        .into_iter()
        .map(|file| (file.name, file.text))
        .collect();
    corpus::files(FOLDER, "pull")
        .into_iter()
        .map(|file| {
            let table = tables
                .remove(&file.name)
                .unwrap_or_else(|| panic!("{} has no table", file.name));
            Published::new(file.name, file.text, &table)
        })
        .collect()
}

impl Published {
    fn new(name: String, source: String, table: &str) -> Self {
        let mut lines = table.lines().skip(1);
        let columns: Vec<&str> = lines
            .next()
            .unwrap_or("")
            .trim_start_matches("# ")
            .split('\t')
            .collect();
        let place = |name: &str| columns.iter().position(|c| *c == name);
        let quantity = |(scale, column): (usize, &&str)| {
            let name = column.strip_prefix("scale_")?;
            let complex = place(&format!("{name}.re"));
            let first = complex.or_else(|| place(name))?;
            let width = 1 + usize::from(complex.is_some());
            Some(Quantity {
                name: name.to_owned(),
                places: first..first + width,
                scale,
            })
        };
        let quantities: Vec<Quantity> = columns.iter().enumerate().filter_map(quantity).collect();
        let arity = quantities.first().map_or(0, |q| q.places.start);
        let mut cases: Vec<Case> = Vec::new();
        for line in lines {
            let cells: Vec<&str> = line.split('\t').collect();
            assert_eq!(cells.len(), columns.len(), "{name}: {line}");
            let (notes, numbers) = cells.split_last().unwrap_or((&"", &[]));
            let numbers: Vec<f64> = numbers.iter().map(|c| number(c)).collect();
            let case = Case {
                args: numbers[..arity].to_vec(),
                rows: vec![numbers],
                notes: vec![(*notes).to_owned()],
            };
            match cases.last_mut() {
                Some(last) if notes.starts_with("other") => {
                    assert_eq!(last.args, case.args, "{name}: {line}");
                    last.rows.extend(case.rows);
                    last.notes.extend(case.notes);
                }
                _ => cases.push(case),
            }
        }
        Self {
            name,
            source,
            quantities,
            cases,
        }
    }

    /// Whether the program has a loop.
    #[must_use]
    pub fn loops(&self) -> bool {
        let code = self.source.lines().filter(|line| !line.starts_with("//"));
        let words = ["sum(", "product(", "iterate("];
        code.into_iter()
            .any(|line| words.iter().any(|w| line.contains(w)))
    }

    /// Whether the program replaces components of a vector: `p.xy = …`.
    #[must_use]
    pub fn updates(&self) -> bool {
        let mut code = self.source.lines().filter(|line| !line.starts_with("//"));
        code.any(|line| {
            line.split(',').any(|part| {
                let name = part.split('=').next().unwrap_or("").trim();
                let name = name.rsplit(' ').next().unwrap_or("");
                let members = name.split_once('.').map_or("", |(_, members)| members);
                part.contains(" = ")
                    && !members.is_empty()
                    && members.chars().all(|c| "xyzw".contains(c))
            })
        })
    }

    /// Whether the table has second derivatives.
    #[must_use]
    pub fn second(&self) -> bool {
        self.quantities
            .iter()
            .any(|q| order(&q.name) == Order::Second)
    }

    /// Evaluates value and first derivatives at every point.
    ///
    /// # Errors
    /// The program does not compile, or the machine cannot evaluate it; in words.
    pub fn measure(&self, machine: &Machine) -> Result<Factors, String> {
        let (formula, params) = compiled(&self.source)?;
        let complex = formula.inputs.iter().any(|i| i.ty == Type::Complex);
        let demand = if complex {
            What::Derivative
        } else {
            What::Gradient
        };
        let results = machine.run(&formula, demand, &self.points(&params))?;
        let mut factors = self.judge(&results, Order::First, machine.format());
        if matches!(machine, Machine::Reference) {
            // the value without derivatives is another module
            let values = machine.run(&formula, What::Value, &self.points(&params))?;
            let alone = self.judge(&values, Order::Value, machine.format());
            factors.value = factors.value.max(alone.value);
            factors.wrong.extend(alone.wrong);
        }
        Ok(factors)
    }

    /// Evaluates the value and the pure second derivatives, as the language writes them.
    ///
    /// # Errors
    /// The program does not compile, or the machine cannot evaluate it; in words.
    pub fn measure_second(&self, machine: &Machine) -> Result<Factors, String> {
        let (formula, params) = compiled(&self.source)?;
        let points = self.points(&params);
        let mut results = machine.run(&formula, What::Value, &points)?;
        for variable in self.variables() {
            let (scene, inputs, call) = match formula.inputs.as_slice() {
                [z] if z.ty == Type::Complex => ("domain", "z: complex", "f(z)"),
                [p] if p.ty != Type::Real => ("surface", "x, y, z", "f((x, y, z))"),
                [_] => ("levels", "x, y", "f(x)"),
                [_, _] => ("levels", "x, y", "f(x, y)"),
                _ => ("surface", "x, y, z", "f(x, y, z)"),
            };
            let program = format!(
                "{}\nsecond({inputs}) = diff({call}, {variable}, 2)\nshow {scene}(second)\n",
                self.source
            );
            let (second, _) = compiled(&program)?;
            // a function of x alone is shown as one of the plane
            let width = second.columns().len();
            let mut points = points.clone();
            for point in &mut points {
                point.args.resize(width, 0.0);
            }
            let more = machine.run(&second, What::Value, &points)?;
            for (row, more) in results.iter_mut().zip(more) {
                row.extend(more);
            }
        }
        Ok(self.judge(&results, Order::Second, machine.format()))
    }

    /// The variables of the second derivatives.
    fn variables(&self) -> Vec<String> {
        let seconds = self
            .quantities
            .iter()
            .filter(|q| order(&q.name) == Order::Second);
        seconds.map(|q| q.name[1..2].to_owned()).collect()
    }

    fn points(&self, params: &[f64]) -> Vec<Point> {
        let point = |case: &Case| Point {
            args: case.args.clone(),
            params: params.to_vec(),
        };
        self.cases.iter().map(point).collect()
    }

    fn judge(&self, results: &[Vec<f64>], order: Order, format: Format) -> Factors {
        let mut factors = Factors::default();
        for (case, result) in self.cases.iter().zip(results) {
            if !case.judged(format) {
                continue;
            }
            factors.rows += 1;
            // the row that fits best
            let rows = case.rows.iter().zip(&case.notes);
            let open =
                rows.filter(|(_, note)| format == Format::Single || note.as_str() != "other");
            let outcomes = open.map(|(row, _)| self.row(case, row, result, order, format));
            let size = |f: &Factors| {
                if f.wrong.is_empty() {
                    f.value.max(f.derivative)
                } else {
                    f64::INFINITY
                }
            };
            let Some(best) = outcomes.min_by(|a, b| size(a).total_cmp(&size(b))) else {
                continue;
            };
            if size(&best) > factors.value.max(factors.derivative) {
                factors.worst.clone_from(&best.worst);
            }
            factors.value = factors.value.max(best.value);
            factors.derivative = factors.derivative.max(best.derivative);
            factors.wrong.extend(best.wrong);
        }
        factors
    }

    /// The errors of one row. `results` begin with the value, and go on with the derivatives of the order.
    fn row(
        &self,
        case: &Case,
        row: &[f64],
        results: &[f64],
        asked: Order,
        format: Format,
    ) -> Factors {
        let mut factors = Factors::default();
        let mut at = 0;
        for quantity in &self.quantities {
            let kind = order(&quantity.name);
            if kind != Order::Value && kind != asked {
                continue;
            }
            let width = quantity.places.len();
            let got = results.get(at..at + width).unwrap_or(&[]);
            at += width;
            let expected = &row[quantity.places.clone()];
            if expected.iter().any(|e| e.is_nan()) {
                continue;
            }
            let lost = got.len() == width && got.iter().any(|v| !v.is_finite());
            if lost && case.overflows(kind, format) {
                continue;
            }
            let describe = || {
                format!(
                    "{} at {:?}: {got:?} for {expected:?}",
                    quantity.name, case.args
                )
            };
            let limit = match format {
                Format::Single | Format::Pair => OVERFLOW,
                Format::Double => f64::INFINITY,
            };
            let beyond = expected.iter().any(|e| e.abs() >= limit);
            if case.coarse(format) && !beyond {
                continue;
            }
            let norm = expected
                .iter()
                .zip(got)
                .fold(0.0f64, |sum, (e, v)| sum.hypot(v - e));
            let found = if got.len() < width || beyond {
                None
            } else {
                factor(norm, row[quantity.scale], format)
            };
            let Some(found) = found else {
                factors.wrong.push(describe());
                continue;
            };
            if found > factors.value.max(factors.derivative) {
                factors.worst = describe();
            }
            let slot = if kind == Order::Value {
                &mut factors.value
            } else {
                &mut factors.derivative
            };
            *slot = slot.max(found);
        }
        factors
    }
}

impl Case {
    /// Whether anything can be said of the results: at least that they leave the range of the format.
    fn judged(&self, format: Format) -> bool {
        !self.coarse(format) || self.overflows(Order::First, format)
    }

    /// Whether the first-order bound means nothing in a format.
    fn coarse(&self, format: Format) -> bool {
        let coarse =
            |note: &str| note == "coarse64" || note == "coarse" && format == Format::Single;
        self.notes[0].split(',').any(coarse)
    }

    /// Whether an intermediate result of a value or derivative leaves the range of a format.
    fn overflows(&self, kind: Order, format: Format) -> bool {
        self.notes[0].split(',').any(|note| {
            let of_value = note.strip_prefix("slope-");
            let word = of_value.unwrap_or(note);
            let here = of_value.is_none() || kind != Order::Value;
            here && (word == "overflow64" || word == "overflow" && format == Format::Single)
        })
    }
}

/// The formula that a program shows, and the defaults of its parameters.
fn compiled(source: &str) -> Result<(Formula, Vec<f64>), String> {
    let compilation = pullback_compiler::compile(source);
    let Some(program) = compilation.program else {
        let found = pullback_grammar::render(&compilation.diagnostics, "program", source, false);
        return Err(found);
    };
    let picture = program.pictures().first().ok_or("nothing is shown")?;
    let params = program.params().iter().map(|p| p.default).collect();
    Ok((picture.formula.clone(), params))
}
