//! Values of a function on the device, a batch of rows at a time.

use std::time::{Duration, Instant};

use pullback_compiler::EvalModule;
use pullback_compiler::lower::Format;

use crate::buffers::{self, Growing};
use crate::uniforms::{self, BatchUniform, MAX_PARAMS, WideWords};
use crate::{Error, Gpu, shader};

/// Size of a workgroup of `compute_main`.
const WORKGROUP: u64 = 64;
/// Rows in the first submission, from which the time of the others is foreseen.
const FIRST: u64 = 1 << 12;
/// Most rows in a submission.
const MOST: u64 = 1 << 20;
/// What a submission should take.
const AIM: Duration = Duration::from_millis(100);

/// Everything but the rows that a function's value depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surroundings<'a> {
    /// Values of the program's parameters in order.
    pub params: &'a [f64],
    /// The animation clock in seconds.
    pub time: f64,
    /// The footprint of a pixel in world units.
    pub pixel: f64,
}

/// A function's evaluation shader on a device.
#[derive(Debug)]
pub struct GpuEvaluator {
    gpu: Gpu,
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    inputs: Vec<String>,
    outputs: Vec<String>,
    format: Format,
    rows: Growing,
    results: Growing,
    readable: Growing,
    params: wgpu::Buffer,
    batch: wgpu::Buffer,
    wide: wgpu::Buffer,
    bindings: Option<wgpu::BindGroup>,
    /// Rows that the next submission may have.
    budget: u64,
}

/// The bindings of an evaluation shader, of any format: rows, parameters, results, the words of wide numbers, the batch.
pub(crate) const LAYOUT: wgpu::BindGroupLayoutDescriptor = {
    use wgpu::BufferBindingType::{Storage, Uniform};
    wgpu::BindGroupLayoutDescriptor {
        label: Some("evaluate"),
        entries: &[
            buffers::binding(0, Storage { read_only: true }),
            buffers::binding(1, Uniform),
            buffers::binding(2, Storage { read_only: false }),
            buffers::binding(3, Storage { read_only: true }),
            buffers::binding(4, Uniform),
        ],
    }
};

impl GpuEvaluator {
    /// Loads the module onto the device.
    ///
    /// # Errors
    /// [`Error::Device`] if the device does not take it.
    pub fn new(gpu: &Gpu, module: &EvalModule) -> Result<Self, Error> {
        let shader = shader::load(gpu, &module.module, &module.info, module.tier)?;
        let device = gpu.device();
        let (layout, pipeline) = gpu.guarded("compiling the evaluation pipeline", || {
            let layout = device.create_bind_group_layout(&LAYOUT);
            let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("evaluate"),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("evaluate"),
                layout: Some(&pipeline_layout),
                module: &shader,
                entry_point: Some("compute_main"),
                compilation_options: Default::default(),
                cache: None,
            });
            (layout, pipeline)
        })?;
        Ok(Self {
            gpu: gpu.clone(),
            pipeline,
            layout,
            inputs: module.inputs.clone(),
            outputs: module.outputs.clone(),
            format: module.tier.precision.format(),
            rows: Growing::inputs(),
            results: Growing::results(),
            readable: Growing::readable(),
            params: buffers::uniform(gpu, "params", size_of::<[f32; MAX_PARAMS]>())?,
            batch: buffers::uniform(gpu, "batch", size_of::<BatchUniform>())?,
            wide: buffers::wide(gpu)?,
            bindings: None,
            budget: FIRST,
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

    /// Evaluates `count` rows, one after another in `rows`, and appends their results to `results`.
    ///
    /// # Errors
    /// [`Error::Invalid`] if `rows` is not `count` rows long or the module's format is wide, and the device's errors.
    pub fn eval(
        &mut self,
        surroundings: Surroundings,
        count: usize,
        rows: &[f32],
        results: &mut Vec<f32>,
    ) -> Result<(), Error> {
        if self.format.is_wide() {
            let reason = "rows of single precision for a shader of another format".into();
            return Err(Error::Invalid { reason });
        }
        let start = results.len();
        let mut words: Vec<u32> = bytemuck::cast_vec(std::mem::take(results));
        let done = self.eval_words(surroundings, count, bytemuck::cast_slice(rows), &mut words);
        *results = bytemuck::cast_vec(words);
        if done.is_err() {
            results.truncate(start);
        }
        done
    }

    /// [`Self::eval`] for any format: numbers are rounded to it, and results are given in all their digits.
    ///
    /// # Errors
    /// [`Error::Invalid`] if `rows` is not `count` rows long, and the device's errors.
    pub fn eval_exactly(
        &mut self,
        surroundings: Surroundings,
        count: usize,
        rows: &[f64],
        results: &mut Vec<f64>,
    ) -> Result<(), Error> {
        let format = self.format;
        let width = self.words();
        let mut words = Vec::with_capacity(rows.len() * width);
        for &x in rows {
            words.extend_from_slice(&format.words(x)[..width]);
        }
        let mut out = Vec::new();
        self.eval_words(surroundings, count, &words, &mut out)?;
        results.extend(out.chunks_exact(width).map(|number| {
            let second = number.get(1).copied().unwrap_or(0);
            format.from_words([number[0], second])
        }));
        Ok(())
    }

    /// Words that hold a number.
    fn words(&self) -> usize {
        if self.format.is_wide() { 2 } else { 1 }
    }

    fn eval_words(
        &mut self,
        surroundings: Surroundings,
        count: usize,
        rows: &[u32],
        results: &mut Vec<u32>,
    ) -> Result<(), Error> {
        let columns = self.inputs.len() * self.words();
        if count.checked_mul(columns) != Some(rows.len()) {
            return Err(Error::Invalid {
                reason: format!(
                    "{} numbers for {count} rows of {}",
                    rows.len() / self.words(),
                    self.inputs.len()
                ),
            });
        }
        self.upload(surroundings)?;
        results.reserve(count.saturating_mul(self.outputs.len() * self.words()));
        let mut done = 0;
        while done < count {
            let size = usize::try_from(self.budget.min(self.capacity())).unwrap_or(1);
            let next = (count - done).min(size.max(1));
            let start = Instant::now();
            let part = &rows[done * columns..(done + next) * columns];
            self.submit(surroundings, next, part, results)?;
            self.learn(next, start.elapsed());
            done += next;
        }
        Ok(())
    }

    /// Writes what is the same for all rows.
    fn upload(&self, surroundings: Surroundings) -> Result<(), Error> {
        let Surroundings {
            params,
            time,
            pixel,
        } = surroundings;
        let wide = WideWords::new(self.format, [0.0; 2], time, pixel, params);
        self.gpu.guarded("upload", || {
            let queue = self.gpu.queue();
            let params = uniforms::params(params);
            queue.write_buffer(&self.params, 0, bytemuck::bytes_of(&params));
            queue.write_buffer(&self.wide, 0, bytemuck::bytes_of(&wide));
        })
    }

    /// Rows for which the device has room.
    fn capacity(&self) -> u64 {
        let limits = self.gpu.device().limits();
        let bytes = limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size);
        let widest = (self.inputs.len().max(self.outputs.len()).max(1) * self.words()) as u64;
        let groups = u64::from(limits.max_compute_workgroups_per_dimension).pow(2);
        MOST.min(bytes / 4 / widest)
            .min(groups.saturating_mul(WORKGROUP))
    }

    fn learn(&mut self, rows: usize, elapsed: Duration) {
        let rows = rows as f64;
        let fair = rows * AIM.as_secs_f64() / elapsed.as_secs_f64().max(1e-9);
        // A short last batch says little about what long ones may be.
        let ceiling = (rows * 8.0).max(self.budget as f64);
        self.budget = fair.min(ceiling).clamp(WORKGROUP as f64, MOST as f64) as u64;
    }

    fn submit(
        &mut self,
        surroundings: Surroundings,
        count: usize,
        rows: &[u32],
        results: &mut Vec<u32>,
    ) -> Result<(), Error> {
        let gpu = self.gpu.clone();
        let wanted = count * self.outputs.len() * self.words();
        // A function of no arguments or results still has its bindings, with room for one number.
        let bytes = wanted.max(2) as u64 * 4;
        let (row_buffer, new_rows) = self.rows.at_least(&gpu, rows.len().max(2) as u64 * 4)?;
        let (result_buffer, new_results) = self.results.at_least(&gpu, bytes)?;
        let (readable, _) = self.readable.at_least(&gpu, bytes)?;
        if new_rows || new_results {
            self.bindings = None;
        }
        let batch = BatchUniform {
            count: u32::try_from(count).unwrap_or(u32::MAX),
            zero: 0,
            time: surroundings.time as f32,
            pixel: surroundings.pixel as f32,
            columns: u32::try_from(self.inputs.len()).unwrap_or(u32::MAX),
            results: u32::try_from(self.outputs.len()).unwrap_or(u32::MAX),
        };
        let groups = (count as u64).div_ceil(WORKGROUP);
        let widest = u64::from(gpu.device().limits().max_compute_workgroups_per_dimension);
        let lines = groups.div_ceil(widest);
        let line = groups.div_ceil(lines);
        let encoder = gpu.guarded("recording", || {
            let bindings = self.bindings.get_or_insert_with(|| {
                let all = [
                    &row_buffer,
                    &self.params,
                    &result_buffer,
                    &self.wide,
                    &self.batch,
                ];
                let entries: Vec<_> = (0..)
                    .zip(all)
                    .map(|(binding, buffer)| wgpu::BindGroupEntry {
                        binding,
                        resource: buffer.as_entire_binding(),
                    })
                    .collect();
                gpu.device().create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("evaluate"),
                    layout: &self.layout,
                    entries: &entries,
                })
            });
            let queue = gpu.queue();
            queue.write_buffer(&self.batch, 0, bytemuck::bytes_of(&batch));
            queue.write_buffer(&row_buffer, 0, bytemuck::cast_slice(rows));
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(&self.pipeline);
                pass.set_bind_group(0, &*bindings, &[]);
                pass.dispatch_workgroups(line as u32, lines as u32, 1);
            }
            encoder.copy_buffer_to_buffer(&result_buffer, 0, &readable, 0, bytes);
            encoder
        })?;
        buffers::submit_and_read(&gpu, "evaluation", encoder, &readable, bytes, |seen| {
            let numbers = seen
                .as_chunks::<4>()
                .0
                .iter()
                .map(|&b| u32::from_le_bytes(b));
            results.extend(numbers.take(wanted));
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::AdapterChoice;
    use pullback_compiler::What;
    use pullback_compiler::lower::Precision;

    fn evaluator(formula: &str) -> Option<GpuEvaluator> {
        let gpu = Gpu::open(&AdapterChoice::Software).ok()?;
        let program = pullback_compiler::compile(formula).program.unwrap();
        let Ok(module) = program.eval_module(0, What::Value, Precision::Accurate) else {
            panic!("{formula} does not compile");
        };
        Some(GpuEvaluator::new(&gpu, &module).unwrap())
    }

    #[test]
    fn batches_of_any_size_keep_the_order() {
        let Some(mut evaluator) = evaluator("x + 2.0*y") else {
            return;
        };
        for (count, budget) in [(0, 1), (1, 1), (1000, 7), (100_000, 64), (300_000, MOST)] {
            evaluator.budget = budget;
            let rows: Vec<f32> = (0..2 * count).map(|i| i as f32).collect();
            let mut results = vec![-1.0];
            evaluator
                .eval(Surroundings::default(), count, &rows, &mut results)
                .unwrap();
            assert_eq!(results.len(), count + 1);
            for (i, result) in results[1..].iter().enumerate() {
                assert_eq!(*result, (6 * i + 2) as f32);
            }
        }
    }

    #[test]
    fn rows_of_another_width_are_refused() {
        let Some(mut evaluator) = evaluator("x + y") else {
            return;
        };
        let refused = evaluator.eval(Surroundings::default(), 2, &[1.0; 3], &mut Vec::new());
        assert!(matches!(refused, Err(Error::Invalid { .. })));
    }
}
