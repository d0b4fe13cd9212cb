//! Evaluation of rows of numbers, on the GPU and in `f64`.

use std::sync::OnceLock;

use naga::valid::ModuleInfo;
use naga::{Function, Module};

use super::demand::uniforms;
use super::evaluation::{Evaluation, What, evaluation, stable_evaluation};
use super::{ModuleError, validate};
use crate::eval::{Leaves, Tape};
use crate::formula::Formula;
use crate::ir::Ty;
use crate::link::{Linker, Provider, number_module, parse_wgsl};
use crate::lower::{
    Argument, Format, Interface, LowerError, NumberTypes, Output, Precision, Tier, lower,
};
use crate::reference::complex::complex;
use crate::table::Number;

/// Greatest number of columns of a row.
pub const MAX_COLUMNS: usize = 16;
/// Greatest number of columns of a result.
pub const MAX_RESULTS: usize = 40;

/// The text of the template that evaluates rows.
pub const TEMPLATE: &str = include_str!("../../shaders/eval.wgsl");

/// The text of the template that evaluates rows of pairs.
const PAIRS: &str = concat!(
    "alias real = vec2f;\n",
    include_str!("../../shaders/wide/eval.wgsl")
);

/// The text of the template that evaluates rows of doubles.
const DOUBLES: &str = concat!(
    "alias real = f64;\n",
    include_str!("../../shaders/wide/eval.wgsl")
);

/// The template for a format, parsed once per process.
fn template(format: Format) -> &'static Module {
    static MODULES: [OnceLock<Module>; 3] = [const { OnceLock::new() }; 3];
    let (place, text) = match format {
        Format::Single => (0, TEMPLATE),
        Format::Pair => (1, PAIRS),
        Format::Double => (2, DOUBLES),
    };
    MODULES[place].get_or_init(|| parse_wgsl(text).0)
}

/// A validated module that evaluates rows; its entry point is `compute_main`.
#[derive(Clone, Debug)]
pub struct EvalModule {
    /// The module.
    pub module: Module,
    /// What validation found out about it.
    pub info: ModuleInfo,
    /// Names of the columns of a row.
    pub inputs: Vec<String>,
    /// Names of the columns of a result.
    pub outputs: Vec<String>,
    /// What numbers are computed with. Its format is how rows and results are held: one `f32` a number, or two words in
    /// the wide formats.
    pub tier: Tier,
}

impl EvalModule {
    /// Compiles what is asked of a formula.
    ///
    /// # Errors
    /// It makes no sense for the formula, has too many columns, or cannot be computed on the GPU.
    pub fn new(formula: &Formula, what: What, tier: impl Into<Tier>) -> Result<Self, ModuleError> {
        let tier = tier.into();
        let precision = tier.precision;
        let evaluation = stable_evaluation(formula, what)?;
        let inputs = formula.columns();
        if inputs.len() > MAX_COLUMNS || evaluation.columns.len() > MAX_RESULTS {
            return Err(ModuleError::Lower(LowerError::Demand(format!(
                "at most {MAX_COLUMNS} columns in and {MAX_RESULTS} columns out"
            ))));
        }
        let format = precision.format();
        let mut linker = Linker::new(vec![template(format), number_module(tier)]);
        let outputs = evaluation.names.clone();
        let mut provider = Rows {
            formula,
            evaluation,
            precision,
        };
        linker.link_entry_points(0, &mut provider)?;
        let mut module = linker.out;
        naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
        let info = validate(&module, precision)?;
        Ok(Self {
            module,
            info,
            inputs,
            outputs,
            tier,
        })
    }
}

struct Rows<'f> {
    formula: &'f Formula,
    evaluation: Evaluation,
    precision: Precision,
}

impl Provider for Rows<'_> {
    fn provide(
        &mut self,
        name: &str,
        stub: &Function,
        linker: &mut Linker,
    ) -> Result<Option<Function>, LowerError> {
        if name != "evaluate" {
            return Ok(None);
        }
        let result = stub.result.as_ref().ok_or(LowerError::NoForm("rows"))?.ty;
        let numbers = NumberTypes::of(linker, self.precision.format())?;
        let mut parts = self.evaluation.columns.clone();
        parts.resize(MAX_RESULTS, Output::Zero(numbers.real));
        let interface = Interface {
            declaration: stub.clone(),
            inputs: row_inputs(self.formula),
            leaves: uniforms(linker, "batch", self.precision)?,
            output: Output::Compose(result, parts),
            precision: self.precision,
            wide: true,
        };
        lower(
            &self.evaluation.graph,
            &self.evaluation.roots,
            interface,
            linker,
        )
        .map(Some)
    }
}

/// Where each scalar input stands in a row: a complex one takes two columns.
fn row_inputs(formula: &Formula) -> Vec<Argument> {
    let mut column = 0;
    let mut out = Vec::new();
    for ty in formula.scalars() {
        if ty == Ty::Complex {
            out.push(Argument::Pair(0, column, column + 1));
            column += 2;
        } else {
            out.push(Argument::Component(0, column));
            column += 1;
        }
    }
    out
}

/// The `f64` reference for rows.
#[derive(Clone, Debug)]
pub struct Evaluator {
    tape: Tape,
    inputs: Vec<String>,
    outputs: Vec<String>,
    scalars: Vec<Ty>,
    columns: Vec<Output>,
    values: Vec<Number>,
}

impl Evaluator {
    /// Prepares what is asked of a formula.
    ///
    /// # Errors
    /// It makes no sense for the formula.
    pub fn new(formula: &Formula, what: What) -> Result<Self, ModuleError> {
        let evaluation = evaluation(formula, what)?;
        Ok(Self {
            tape: Tape::new(&evaluation.graph, &evaluation.roots),
            inputs: formula.columns(),
            outputs: evaluation.names,
            scalars: formula.scalars(),
            columns: evaluation.columns,
            values: Vec::new(),
        })
    }

    /// Names of the columns of a row.
    #[must_use]
    pub fn inputs(&self) -> &[String] {
        &self.inputs
    }

    /// Names of the columns of a result.
    #[must_use]
    pub fn outputs(&self) -> &[String] {
        &self.outputs
    }

    /// Evaluates one row: as many numbers as [`Self::inputs`] in, as many as [`Self::outputs`] out. Columns that
    /// are missing are NaN.
    pub fn eval(&mut self, params: &[f64], time: f64, pixel: f64, row: &[f64], out: &mut [f64]) {
        let mut columns = row.iter().copied().chain(std::iter::repeat(f64::NAN));
        let mut next = || columns.next().unwrap_or(f64::NAN);
        let inputs: smallvec::SmallVec<[Number; 4]> = self
            .scalars
            .iter()
            .map(|&ty| match ty {
                Ty::Complex => {
                    let re = next();
                    Number::Complex(complex(re, next()))
                }
                _ => Number::Real(next()),
            })
            .collect();
        let leaves = Leaves {
            inputs: &inputs,
            params,
            time,
            pixel,
        };
        self.values.clear();
        let values = &mut self.values;
        self.tape.run(&leaves, |value| values.push(value));
        for (slot, column) in out.iter_mut().zip(&self.columns) {
            *slot = column_value(column, values);
        }
    }
}

fn column_value(column: &Output, values: &[Number]) -> f64 {
    let (k, imaginary) = match column {
        Output::Node(k) | Output::Re(k) => (*k, false),
        Output::Im(k) => (*k, true),
        Output::Zero(_) | Output::Compose(..) | Output::Exponent(_) | Output::Scaled(..) => {
            return 0.0;
        }
    };
    match values.get(k) {
        Some(Number::Real(x)) => {
            if imaginary {
                0.0
            } else {
                *x
            }
        }
        Some(Number::Complex(z)) => {
            if imaginary {
                z.im
            } else {
                z.re
            }
        }
        Some(Number::Truth(t)) => f64::from(u8::from(*t)),
        None => f64::NAN,
    }
}
