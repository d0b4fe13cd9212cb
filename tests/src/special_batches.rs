//! Tables of special functions that share a shader, so that a device compiles each function once in a tier.

use std::collections::BTreeMap;
use std::time::Instant;

use pullback_compiler::formula::Formula;
use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, EvalModule, Target, compile};
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::executor::{Contraction, Rows};
use pullback_runtime::{AdapterChoice, Error, Gpu};

use crate::accuracy::evaluators::{Machine, Point};
use crate::accuracy::formulas::{Factors, MOST, Table, demand};
use crate::accuracy::subjects::formula;
use crate::special::{MOST_DOUBLE, MOST_EXTENDED};

/// Who computes.
#[derive(Debug)]
pub enum Place {
    /// A device.
    Device(Box<Gpu>),
    /// The processor, by the shader in exact arithmetic, or with products fused into sums as a driver may.
    Processor(Contraction),
}

impl Place {
    /// `ieee32`, `left` and `right` are the processor, the last two with the products fused that stand on that side.
    ///
    /// # Errors
    /// There is no such adapter.
    pub fn open(name: &str) -> Result<Self, Error> {
        Ok(match name {
            "ieee32" => Self::Processor(Contraction::None),
            "left" => Self::Processor(Contraction::Left),
            "right" => Self::Processor(Contraction::Right),
            _ => {
                let choice = name.parse::<AdapterChoice>().unwrap_or_default();
                Self::Device(Box::new(Gpu::open(&choice)?))
            }
        })
    }

    fn run(
        &self,
        formula: &Formula,
        precision: Precision,
        points: &[Point],
    ) -> Result<Vec<Vec<f64>>, String> {
        let what = demand(formula);
        match self {
            Self::Device(gpu) => Machine::Gpu(gpu.clone(), precision).run(formula, what, points),
            Self::Processor(contraction) => {
                let module =
                    EvalModule::new(formula, what, precision).map_err(|e| format!("{e:?}"))?;
                let rows = Rows::contracted(&module, *contraction).map_err(|e| e.to_string())?;
                on_processor(&rows, module.outputs.len(), points).map_err(|e| e.to_string())
            }
        }
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Device(gpu) => gpu.adapter().fmt(f),
            Self::Processor(contraction) => write!(f, "processor, contraction: {contraction:?}"),
        }
    }
}

fn on_processor(rows: &Rows, width: usize, points: &[Point]) -> Result<Vec<Vec<f64>>, Error> {
    let mut out = Vec::new();
    for run in points.chunk_by(|a, b| a.params == b.params) {
        let numbers: Vec<f64> = run.iter().flat_map(|p| p.args.iter().copied()).collect();
        let surroundings = Surroundings {
            params: &run[0].params,
            ..Surroundings::default()
        };
        let mut results = Vec::new();
        rows.eval(surroundings, run.len(), &numbers, &mut results)?;
        out.extend(results.chunks(width).map(<[f64]>::to_vec));
    }
    Ok(out)
}

/// The greatest error factor that is declared of any table in a tier.
#[must_use]
pub fn most(precision: Precision) -> f64 {
    match precision {
        Precision::Extended => MOST_EXTENDED,
        Precision::Double => MOST_DOUBLE,
        _ => MOST,
    }
}

/// Tables with one program, whose parameters are their constants.
#[derive(Debug)]
pub struct Batch {
    source: String,
    tables: Vec<(Table, Vec<f64>)>,
}

/// What became of a table.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The table's name.
    pub name: &'static str,
    /// The tier.
    pub precision: Precision,
    /// The errors.
    pub factors: Factors,
    /// The greatest factor that is declared.
    pub most: f64,
    /// What is wrong, in words.
    pub problem: Option<String>,
    /// For the whole of its batch.
    pub seconds: f64,
}

/// The tables, those of one program together.
#[must_use]
pub fn batches(tables: Vec<Table>) -> Vec<Batch> {
    let mut all: BTreeMap<String, Vec<(Table, Vec<f64>)>> = BTreeMap::new();
    for table in tables {
        let (source, params) = table.shared();
        all.entry(source).or_default().push((table, params));
    }
    let batch = |(source, tables)| Batch { source, tables };
    all.into_iter().map(batch).collect()
}

impl std::fmt::Display for Judged {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (name, tier) = (self.name, self.precision.name());
        let (value, slope) = (self.factors.value, self.factors.derivative);
        write!(
            f,
            "{name}, {tier}: {value:.2}, {slope:.2} of {}, {:.1} s",
            self.most, self.seconds
        )?;
        f.write_str(if self.problem.is_some() { " WRONG" } else { "" })
    }
}

impl Batch {
    /// The names of its tables.
    #[must_use]
    pub fn names(&self) -> Vec<&'static str> {
        self.tables.iter().map(|(table, _)| table.name).collect()
    }

    /// The length of its shader's text in a tier, which tells how long a driver compiles.
    #[must_use]
    pub fn size(&self, precision: Precision) -> usize {
        let what = if self.source.contains("real") {
            EmitWhat::Gradient
        } else {
            EmitWhat::Derivative
        };
        let program = compile(&self.source).program;
        let text = program.and_then(|p| p.emit(0, what, Target::Wgsl, precision).ok());
        text.map_or(0, |text| text.len())
    }

    /// Runs all tables by one shader, and judges them.
    #[must_use]
    pub fn judge(&self, place: &Place, precision: Precision) -> Vec<Judged> {
        let begun = Instant::now();
        let points: Vec<_> = self
            .tables
            .iter()
            .flat_map(|(table, params)| table.points(params))
            .collect();
        let formula = formula(&self.source);
        let results = place.run(&formula, precision, &points);
        let seconds = begun.elapsed().as_secs_f64();
        let mut rest = results.as_deref().unwrap_or_default();
        let each = |(table, params): &(Table, Vec<f64>)| {
            let count = table.points(params).len().min(rest.len());
            let (own, after) = rest.split_at(count);
            rest = after;
            let factors = table.judge_rows(own, precision.format());
            let most = most(precision);
            Judged {
                name: table.name,
                precision,
                problem: match &results {
                    Err(reason) => Some(reason.clone()),
                    Ok(_) => problem(&factors, most),
                },
                factors,
                most,
                seconds,
            }
        };
        self.tables.iter().map(each).collect()
    }
}

fn problem(factors: &Factors, most: f64) -> Option<String> {
    if let Some(first) = factors.wrong.first() {
        return Some(first.clone());
    }
    if factors.rows < 8 {
        return Some(format!("only {} rows were judged", factors.rows));
    }
    let above = factors.value.max(factors.derivative) > most;
    above.then(|| format!("above {most}: {}", factors.worst))
}
