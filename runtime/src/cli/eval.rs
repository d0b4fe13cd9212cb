//! `pullback eval`

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Write};

use clap::{Args, ValueEnum};
use pullback_compiler::{Evaluator, What};
use pullback_runtime::GpuEvaluator;
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::executor::{Arithmetic, Rows};
use pullback_runtime::rows::{self, Number, RowError, RowReader};

use super::failure::Failure;
use super::place::Computer;
use super::progress::Progress;
use super::source::Source;
use super::{Console, Device, Input, Numbers, Rules, Settings, Which, overrides};

/// Rows that are read, evaluated and written at a time.
const BATCH: usize = 1 << 17;
/// Bad rows that are told before the rest is left unread.
const MAX_ERRORS: usize = 20;

/// Arguments of `pullback eval`.
#[derive(Debug, Args)]
pub(super) struct EvalArguments {
    #[command(flatten)]
    input: Input,
    /// What to compute
    #[arg(long, value_enum, default_value_t = Part::Value)]
    what: Part,
    /// Who computes it
    #[arg(long, value_enum, default_value_t = Place::Gpu)]
    on: Place,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    rules: Rules,
    #[command(flatten)]
    which: Which,
    /// Rows of numbers, one column for each real argument, two for a complex one, three for a vec3; # comments;
    /// - is the standard input
    #[arg(long, value_name = "FILE")]
    points: Option<OsString>,
    #[command(flatten)]
    settings: Settings,
    /// The value of `pixel`
    #[arg(long, default_value_t = 0.0)]
    pixel: f64,
    #[command(flatten)]
    device: Device,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Part {
    /// The value
    Value,
    /// The value, then the gradient
    Gradient,
    /// The value, then the complex derivative
    Derivative,
    /// The value, then the gradient, then the second derivatives
    Hessian,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Place {
    /// The shader, on what --adapter names
    Gpu,
    /// The formula itself, without any shader, in double precision
    Reference,
}

/// Evaluates at each row.
pub(super) fn run(arguments: &EvalArguments, console: &Console) -> Result<(), Failure> {
    let stdin = Some(OsStr::new("-"));
    if arguments.points.as_deref() == stdin && arguments.input.input == "-" {
        return Err(Failure::usage(
            "the standard input cannot be both the program and the points",
        ));
    }
    let source = Source::open(&arguments.input, console)?.with_rewrites(arguments.rules);
    let what = match arguments.what {
        Part::Value => What::Value,
        Part::Gradient => What::Gradient,
        Part::Derivative => What::Derivative,
        Part::Hessian => What::Hessian,
    };
    let index = source.picture(arguments.which, console)?;
    let params = overrides::for_values(&arguments.settings.set, &source.program)?;
    let surroundings = Surroundings {
        params: &params,
        time: arguments.settings.time,
        pixel: arguments.pixel,
    };
    match arguments.on {
        Place::Reference => {
            let evaluator = source.expect(source.program.evaluator(index, what), console)?;
            let mut table = Table::open(arguments, evaluator.inputs())?;
            let mut machine = Reference {
                evaluator,
                surroundings,
            };
            table.run(&mut machine, console)
        }
        Place::Gpu => {
            let settings = &source.program.pictures()[index].settings;
            let wanted = arguments.numbers.without_view(settings)?;
            let computer = Computer::open(&arguments.device.adapter, console)?;
            let tier = computer.tier(arguments.numbers.precision, Some(wanted))?;
            let module = source.program.eval_module(index, what, tier);
            let module = source.expect(module, console)?;
            let mut table = Table::open(arguments, &module.inputs)?;
            let gpu = match &computer {
                Computer::Adapter(gpu) => gpu,
                Computer::Processor(arithmetic) => {
                    let mut machine = OnProcessor {
                        rows: Rows::new(&module, *arithmetic)?,
                        outputs: module.outputs.len(),
                        surroundings,
                    };
                    let narrow = !module.tier.precision.format().is_wide();
                    let done = if narrow && *arithmetic == Arithmetic::Ieee32 {
                        table.run(&mut Narrow(machine), console)
                    } else {
                        table.run(&mut machine, console)
                    };
                    return done.map_err(|failure| source.blamed(failure, console));
                }
            };
            let evaluator = GpuEvaluator::new(gpu, &module)?;
            if module.tier.precision.format().is_wide() {
                let mut machine = WideOnDevice {
                    evaluator,
                    surroundings,
                };
                return table.run(&mut machine, console);
            }
            let mut machine = OnDevice {
                evaluator,
                surroundings,
            };
            table.run(&mut machine, console)
        }
    }
}

/// Something that evaluates rows.
trait Machine {
    type Number: Number;
    fn outputs(&self) -> usize;
    fn eval(
        &mut self,
        count: usize,
        rows: &[Self::Number],
        results: &mut Vec<Self::Number>,
    ) -> Result<(), Failure>;
}

struct Reference<'a> {
    evaluator: Evaluator,
    surroundings: Surroundings<'a>,
}

impl Machine for Reference<'_> {
    type Number = f64;

    fn outputs(&self) -> usize {
        self.evaluator.outputs().len()
    }

    fn eval(&mut self, count: usize, rows: &[f64], results: &mut Vec<f64>) -> Result<(), Failure> {
        let (inputs, outputs) = (self.evaluator.inputs().len(), self.outputs());
        let Surroundings {
            params,
            time,
            pixel,
        } = self.surroundings;
        results.resize(count * outputs, 0.0);
        for i in 0..count {
            let row = &rows[i * inputs..(i + 1) * inputs];
            let result = &mut results[i * outputs..(i + 1) * outputs];
            self.evaluator.eval(params, time, pixel, row, result);
        }
        Ok(())
    }
}

struct OnDevice<'a> {
    evaluator: GpuEvaluator,
    surroundings: Surroundings<'a>,
}

impl Machine for OnDevice<'_> {
    type Number = f32;

    fn outputs(&self) -> usize {
        self.evaluator.outputs().len()
    }

    fn eval(&mut self, count: usize, rows: &[f32], results: &mut Vec<f32>) -> Result<(), Failure> {
        Ok(self
            .evaluator
            .eval(self.surroundings, count, rows, results)?)
    }
}

struct WideOnDevice<'a> {
    evaluator: GpuEvaluator,
    surroundings: Surroundings<'a>,
}

impl Machine for WideOnDevice<'_> {
    type Number = f64;

    fn outputs(&self) -> usize {
        self.evaluator.outputs().len()
    }

    fn eval(&mut self, count: usize, rows: &[f64], results: &mut Vec<f64>) -> Result<(), Failure> {
        let surroundings = self.surroundings;
        Ok(self
            .evaluator
            .eval_exactly(surroundings, count, rows, results)?)
    }
}

struct OnProcessor<'a> {
    rows: Rows,
    outputs: usize,
    surroundings: Surroundings<'a>,
}

impl Machine for OnProcessor<'_> {
    type Number = f64;

    fn outputs(&self) -> usize {
        self.outputs
    }

    fn eval(&mut self, count: usize, rows: &[f64], results: &mut Vec<f64>) -> Result<(), Failure> {
        Ok(self.rows.eval(self.surroundings, count, rows, results)?)
    }
}

/// Numbers of single precision, read and written as such.
struct Narrow<'a>(OnProcessor<'a>);

impl Machine for Narrow<'_> {
    type Number = f32;

    fn outputs(&self) -> usize {
        self.0.outputs()
    }

    fn eval(&mut self, count: usize, rows: &[f32], results: &mut Vec<f32>) -> Result<(), Failure> {
        let rows: Vec<f64> = rows.iter().copied().map(f64::from).collect();
        let mut wide = Vec::new();
        self.0.eval(count, &rows, &mut wide)?;
        results.extend(wide.into_iter().map(|x| x as f32));
        Ok(())
    }
}

/// Where the rows come from.
enum Table {
    /// The one row of a function without arguments.
    Single,
    /// A file or the standard input.
    Text {
        name: String,
        reader: RowReader<Box<dyn BufRead>>,
    },
}

impl Table {
    fn open(arguments: &EvalArguments, inputs: &[String]) -> Result<Self, Failure> {
        let Some(points) = &arguments.points else {
            if inputs.is_empty() {
                return Ok(Self::Single);
            }
            let columns = inputs.join(", ");
            return Err(Failure::usage_hint(
                format!("no points to evaluate at; a row has {columns}"),
                "give --points FILE, or --points - and rows on the standard input",
            ));
        };
        if inputs.is_empty() {
            return Err(Failure::usage(
                "this function has no arguments: leave --points out",
            ));
        }
        let (name, input): (String, Box<dyn BufRead>) = if points == "-" {
            (
                "standard input".into(),
                Box::new(BufReader::new(io::stdin())),
            )
        } else {
            let name = points.to_string_lossy().into_owned();
            match File::open(points) {
                Ok(file) => (name, Box::new(BufReader::with_capacity(1 << 18, file))),
                Err(error) => return Err(Failure::Io { what: name, error }),
            }
        };
        Ok(Self::Text {
            name,
            reader: RowReader::new(input, inputs.len()),
        })
    }

    fn run<M: Machine>(&mut self, machine: &mut M, console: &Console) -> Result<(), Failure> {
        let mut output = BufWriter::with_capacity(1 << 18, io::stdout().lock());
        let mut results = Vec::new();
        match self {
            Self::Single => {
                machine.eval(1, &[], &mut results)?;
                rows::write_rows(&mut output, machine.outputs(), &results)
                    .map_err(Failure::stdout)?;
            }
            Self::Text { name, reader } => {
                let mut progress = Progress::new(console);
                let mut rows = Vec::new();
                let mut done = 0;
                loop {
                    rows.clear();
                    results.clear();
                    let mut errors = Vec::new();
                    let count = reader
                        .read(BATCH, &mut rows, &mut errors)
                        .map_err(|error| reading(name, error))?;
                    if !errors.is_empty() {
                        drop(output);
                        return Err(report(name, reader, errors, &mut rows, console));
                    }
                    if count == 0 {
                        break;
                    }
                    machine.eval(count, &rows, &mut results)?;
                    rows::write_rows(&mut output, machine.outputs(), &results)
                        .map_err(Failure::stdout)?;
                    done += count as u64;
                    progress.update(done, 0);
                }
                progress.finish();
                match reader.overflows() {
                    0 => {}
                    n => console.warning(&format!(
                        "{name}: {n} number{} beyond the format, taken as infinite",
                        if n == 1 { "" } else { "s" }
                    )),
                }
            }
        }
        output.flush().map_err(Failure::stdout)
    }
}

fn reading(name: &str, error: io::Error) -> Failure {
    Failure::Io {
        what: name.to_owned(),
        error,
    }
}

/// Tells the bad row and those after it.
fn report<T: Number>(
    name: &str,
    reader: &mut RowReader<Box<dyn BufRead>>,
    mut errors: Vec<RowError>,
    rows: &mut Vec<T>,
    console: &Console,
) -> Failure {
    while errors.len() < MAX_ERRORS {
        rows.clear();
        let before = errors.len();
        match reader.read(BATCH, rows, &mut errors) {
            Ok(0) if errors.len() == before => break,
            Ok(_) => {}
            Err(error) => return reading(name, error),
        }
    }
    for error in &errors {
        console.error(&format!("{name}: {error}"));
    }
    if errors.len() >= MAX_ERRORS {
        console.note("the rest was not read");
    }
    Failure::Data
}
