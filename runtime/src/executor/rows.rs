//! Values of a function on the processor, row by row: an evaluation module's `compute_main`.

use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::available_parallelism;

use pullback_compiler::EvalModule;
use pullback_compiler::lower::Format;

use super::fault::Fault;
use super::lanes::LANES;
use super::machine::{Limits, MAX_STEPS, Machine};
use super::painter::wide_word;
use super::program::{Buffer, Contraction, Options, Program, Start, Watched};
use super::{Arithmetic, Observer};
use crate::Error;
use crate::evaluate::Surroundings;
use crate::pool::spread;
use crate::uniforms::WideWords;

/// Rows of a task.
const TASK: usize = 64 * LANES;

/// A function, to be evaluated on the processor.
#[derive(Debug)]
pub struct Rows {
    program: Program,
    format: Format,
    columns: usize,
    outputs: usize,
    /// Steps that the loops of one row may take in all.
    pub steps: u64,
}

impl Rows {
    /// Translates the module.
    ///
    /// # Errors
    /// [`Error::Executor`] if it holds what none of our modules does.
    pub fn new(module: &EvalModule, arithmetic: Arithmetic) -> Result<Self, Error> {
        Self::start(module, arithmetic, Contraction::None, Watched::Nothing)
    }

    /// Translates the module for [`Arithmetic::Ieee32`], with products fused into sums as a driver may.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn contracted(module: &EvalModule, contraction: Contraction) -> Result<Self, Error> {
        let arithmetic = Arithmetic::Ieee32;
        Self::start(module, arithmetic, contraction, Watched::Nothing)
    }

    /// Translates the module to be asked for what it computes on the way: [`Self::trace`].
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn watched(
        module: &EvalModule,
        arithmetic: Arithmetic,
        watched: Watched,
    ) -> Result<Self, Error> {
        Self::start(module, arithmetic, Contraction::None, watched)
    }

    fn start(
        module: &EvalModule,
        arithmetic: Arithmetic,
        contraction: Contraction,
        watched: Watched,
    ) -> Result<Self, Error> {
        let format = module.tier.precision.format();
        let options = Options {
            arithmetic,
            contraction,
            format,
            watched,
        };
        let start = Start::EntryPoint("compute_main");
        Ok(Self {
            program: Program::new(&module.module, &module.info, start, options)?,
            format,
            columns: module.inputs.len(),
            outputs: module.outputs.len(),
            steps: MAX_STEPS,
        })
    }

    /// The program that is run.
    #[must_use]
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// Evaluates `count` rows, one after another in `rows`, and appends their results to `results`. Numbers are rounded to
    /// the arithmetic.
    ///
    /// # Errors
    /// [`Error::Invalid`] if `rows` is not `count` rows long, and [`Error::Executor`].
    pub fn eval(
        &self,
        surroundings: Surroundings,
        count: usize,
        rows: &[f64],
        results: &mut Vec<f64>,
    ) -> Result<(), Error> {
        self.check(count, rows)?;
        let tasks: Vec<_> = (0..count).step_by(TASK).collect();
        let failed = AtomicBool::new(false);
        let part = |machine: &mut Machine, &start: &usize| {
            if failed.load(Ordering::Relaxed) {
                return Err(Fault::Cancelled);
            }
            let end = (start + TASK).min(count);
            let numbers = &rows[start * self.columns..end * self.columns];
            let values = self.task(machine, end - start, numbers, &mut ());
            if values.is_err() {
                failed.store(true, Ordering::Relaxed);
            }
            values
        };
        let mut machine = self.machine(surroundings);
        if let [start] = tasks.as_slice() {
            results.extend(part(&mut machine, start)?);
            return Ok(());
        }
        let cores = available_parallelism().map_or(1, usize::from);
        let machines = (0..cores.min(tasks.len())).map(|_| self.machine(surroundings));
        let mut stopped = None;
        for values in spread(machines.collect(), &tasks, part, || ()) {
            match values.ok_or_else(|| Fault::unsupported("a function of this kind"))? {
                Ok(values) => results.extend(values),
                // what another task met goes before its being stopped for it
                Err(Fault::Cancelled) => stopped = Some(Fault::Cancelled),
                Err(fault) => return Err(fault.into()),
            }
        }
        stopped.map_or(Ok(()), |fault| Err(fault.into()))
    }

    /// Evaluates one row, with an observer that sees what is computed on the way.
    ///
    /// # Errors
    /// As [`Self::eval`].
    pub fn trace(
        &self,
        surroundings: Surroundings,
        row: &[f64],
        observer: &mut dyn Observer,
    ) -> Result<Vec<f64>, Error> {
        self.check(1, row)?;
        let mut machine = self.machine(surroundings);
        Ok(self.task(&mut machine, 1, row, observer)?)
    }

    fn check(&self, count: usize, rows: &[f64]) -> Result<(), Error> {
        if count.checked_mul(self.columns) == Some(rows.len()) {
            return Ok(());
        }
        let (numbers, columns) = (rows.len(), self.columns);
        let reason = format!("{numbers} numbers for {count} rows of {columns}");
        Err(Error::Invalid { reason })
    }

    fn machine(&self, surroundings: Surroundings) -> Machine<'_> {
        let Surroundings {
            params,
            time,
            pixel,
        } = surroundings;
        let wide = WideWords::new(self.format, [0.0; 2], time, pixel, params);
        let mut machine = Machine::new(&self.program);
        for component in &self.program.inputs {
            let value = match component.path.as_str() {
                "batch.time" => Some(time),
                "batch.pixel" => Some(pixel),
                "batch.columns" => Some(self.columns as f64),
                "batch.results" => Some(self.outputs as f64),
                "params" => params.get(component.index).copied(),
                path => wide_word(&wide, path, component.index),
            };
            machine.set_uniform(component, component.encode(value.unwrap_or(0.0)));
        }
        machine
    }

    fn task(
        &self,
        machine: &mut Machine,
        count: usize,
        rows: &[f64],
        observer: &mut dyn Observer,
    ) -> Result<Vec<f64>, Fault> {
        for component in &self.program.inputs {
            if component.path == "batch.count" {
                machine.set_uniform(component, count as u64);
            }
        }
        let (rows_at, results_at) = (self.program.buffer("rows"), self.program.buffer("results"));
        if let Some(k) = rows_at
            && let Some(words) = machine.buffer(k)
        {
            words.clear();
            self.write(&self.program.buffers[k], rows, words);
        }
        if let Some(words) = results_at.and_then(|k| machine.buffer(k)) {
            words.clear();
            words.resize(count * self.outputs * self.words(), 0);
        }
        let never = AtomicBool::new(false);
        let limits = Limits {
            steps: self.steps,
            cancel: Some(&never),
            ..Limits::default()
        };
        for start in (0..count).step_by(LANES) {
            let lanes = LANES.min(count - start);
            for lane in 0..lanes {
                machine.set_argument(0, lane, (start + lane) as u64);
                machine.set_argument(1, lane, 0);
            }
            machine.run_observed(lanes, limits, observer)?;
        }
        let Some(k) = results_at else {
            return Ok(Vec::new());
        };
        let words = machine.buffer(k).map(std::mem::take).unwrap_or_default();
        Ok(self.read(&self.program.buffers[k], &words))
    }

    /// Words that hold a number in the buffers.
    fn words(&self) -> usize {
        if self.format.is_wide() { 2 } else { 1 }
    }

    fn write(&self, buffer: &Buffer, rows: &[f64], words: &mut Vec<u64>) {
        if self.format.is_wide() {
            words.extend(
                rows.iter()
                    .flat_map(|&x| self.format.words(x).map(u64::from)),
            );
        } else {
            words.extend(rows.iter().map(|&x| buffer.encode(x)));
        }
    }

    fn read(&self, buffer: &Buffer, words: &[u64]) -> Vec<f64> {
        if !self.format.is_wide() {
            return words.iter().map(|&word| buffer.decode(word)).collect();
        }
        let numbers = words.as_chunks::<2>().0.iter();
        numbers
            .map(|words| self.format.from_words(words.map(|word| word as u32)))
            .collect()
    }
}
