//! Forms of the exact steps of pairs: which are exact on an adapter, and what they cost.
//!
//! `cargo bench -p pullback-runtime --bench exact_steps -- [--adapter NAME] [--threads N] [--steps N] [--samples N]
//! [--markdown]`
//!
//! The executable carries all that it needs. First table: share of wrong results among 2^20 rows. Second table: time of
//! z² + c, complex, from 0, in f32, in pairs with each form, and in native f64; the forms take turns, and ratios are
//! medians of the ratios in each turn, so that other work on the machine counts little. A form that is not exact has no
//! price: what it computes is something else.

mod forms;
mod table;

use std::process::ExitCode;
use std::time::Instant;

use pullback_runtime::kernel::{Contraction, Job, Kernel};
use pullback_runtime::{AdapterChoice, Error, Gpu};

use forms::Form;
use table::Table;

/// Rows whose results are checked.
const ROWS: u32 = 1 << 20;
/// A timed submission should take this long at least, so that a launch does not count.
const SHORTEST: f64 = 30e-3;

#[derive(Debug)]
struct Options {
    adapter: AdapterChoice,
    /// Threads of the recurrence.
    threads: Option<u32>,
    /// Steps of the recurrence.
    steps: u32,
    samples: usize,
    markdown: bool,
}

impl Options {
    fn read() -> Result<Self, String> {
        let mut options = Self {
            adapter: AdapterChoice::Auto,
            threads: None,
            steps: 2000,
            samples: 9,
            markdown: false,
        };
        let mut arguments = std::env::args().skip(1);
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
            match argument.as_str() {
                // From `cargo bench`.
                "--bench" => {}
                "--adapter" => {
                    let Ok(adapter) = value()?.parse();
                    options.adapter = adapter;
                }
                "--threads" => options.threads = Some(number(&value()?)?),
                "--steps" => options.steps = number(&value()?)?,
                "--samples" => options.samples = number(&value()?)?.max(1) as usize,
                "--markdown" => options.markdown = true,
                _ => return Err(format!("unknown argument {argument}")),
            }
        }
        Ok(options)
    }
}

fn number(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| format!("not a number: {text}"))
}

fn main() -> ExitCode {
    let done = Options::read().and_then(|options| run(&options).map_err(|e| e.to_string()));
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), Error> {
    let gpu = Gpu::open(&options.adapter)?;
    println!("{}\n", gpu.adapter());
    let forms = forms::offered(&gpu);
    let mut exact = Vec::new();
    let mut table = Table::new(&[
        "form",
        "TwoSum",
        "of a product",
        "TwoProd",
        "TwoSum of errors",
    ]);
    for form in forms {
        let wrong = wrong(&gpu, &form)?;
        let share = |count: u32| format!("{:.4} %", 100.0 * f64::from(count) / f64::from(ROWS));
        let mut cells = vec![form.name.clone()];
        cells.extend(wrong.map(share));
        table.row(&cells);
        if wrong == [0; 4] {
            exact.push(form);
        }
    }
    println!(
        "Wrong results of {ROWS}:\n\n{}",
        table.print(options.markdown)
    );
    price(&gpu, &exact, options)
}

/// Numbers of wrong results.
fn wrong(gpu: &Gpu, form: &Form) -> Result<[u32; 4], Error> {
    let text = format!("{}{}", form.steps, include_str!("steps.wgsl"));
    let kernel = Kernel::new(gpu, &text, form.contraction)?;
    let rows = pairs(ROWS, -8..8, true);
    let words: Vec<u32> = rows.iter().flatten().map(|x| x.to_bits()).collect();
    let results = kernel.run(ROWS, &words, 8 * ROWS as usize)?;
    let mut wrong = [0; 4];
    for (&[a, b], result) in rows.iter().zip(results.as_chunks::<8>().0) {
        let p = a * b;
        let sum = |a: f32, b: f32| (a + b, f64::from(a) + f64::from(b));
        let product = (p, f64::from(a) * f64::from(b));
        let error = |(rounded, exact): (f32, f64)| (exact - f64::from(rounded)) as f32;
        let of_errors = sum(error(sum(a, b)), error(product));
        for (k, (rounded, exact)) in [sum(a, b), sum(p, b), product, of_errors]
            .into_iter()
            .enumerate()
        {
            let [high, low] = [result[2 * k], result[2 * k + 1]].map(f32::from_bits);
            // Exact in f64: the parts and the sum have fewer than 53 bits between them.
            let right = high == rounded && f64::from(low) == exact - f64::from(rounded);
            wrong[k] += u32::from(!right);
        }
    }
    Ok(wrong)
}

/// Numbers with all their bits in use, of sizes from 2^range.
fn pairs(count: u32, exponents: std::ops::Range<i32>, signed: bool) -> Vec<[f32; 2]> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        // Xorshift (G. Marsaglia, "Xorshift RNGs", 2003).
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 32) as u32
    };
    let mut one = || {
        let significand = 1.0 + (next() >> 9) as f32 / (1u32 << 23) as f32;
        let exponent = exponents.start + (next() % exponents.len() as u32) as i32;
        let sign = if signed && next() & 1 == 1 { -1.0 } else { 1.0 };
        sign * significand * 2f32.powi(exponent)
    };
    (0..count).map(|_| [one(), one()]).collect()
}

/// A format that the recurrence is computed in.
struct Contender {
    name: String,
    kernel: Kernel,
    job: Job,
    repeats: u32,
    error: f64,
    seconds: Vec<f64>,
}

fn price(gpu: &Gpu, exact: &[Form], options: &Options) -> Result<(), Error> {
    let default = if gpu.adapter().is_software() {
        1 << 12
    } else {
        1 << 20
    };
    let threads = options.threads.unwrap_or(default);
    let mut contenders = Vec::new();
    for (name, text, contraction) in forms::formats(gpu, exact) {
        contenders.push(contender(
            gpu,
            name,
            &text,
            contraction,
            threads,
            options.steps,
        )?);
    }
    for _ in 0..options.samples {
        for contender in &mut contenders {
            let start = Instant::now();
            contender.kernel.repeat(&contender.job, contender.repeats)?;
            let each = start.elapsed().as_secs_f64() / f64::from(contender.repeats);
            contender.seconds.push(each);
        }
    }
    let mut table = Table::new(&["format", "ms", "× f32", "error"]);
    let base = contenders[0].seconds.clone();
    for contender in &contenders {
        let ratios = contender.seconds.iter().zip(&base).map(|(a, b)| a / b);
        table.row(&[
            contender.name.clone(),
            format!("{:.3}", 1e3 * median(contender.seconds.iter().copied())),
            format!("{:.2}", median(ratios)),
            format!("{:.1e}", contender.error),
        ]);
    }
    println!(
        "z² + c, {} steps, {threads} threads, medians of {}; error is the largest of the last z against f64 on the CPU:\n\n{}",
        options.steps,
        options.samples,
        table.print(options.markdown)
    );
    Ok(())
}

fn contender(
    gpu: &Gpu,
    name: String,
    format: &str,
    contraction: Contraction,
    threads: u32,
    steps: u32,
) -> Result<Contender, Error> {
    let text = format!("{format}{}", include_str!("recurrence.wgsl"));
    let kernel = Kernel::new(gpu, &text, contraction)?;
    // Inside the main cardioid, so that z stays small.
    let rows = pairs(threads, -4..-3, true);
    let words: Vec<u32> = rows.iter().flatten().map(|x| x.to_bits()).collect();
    let job = kernel.job(threads, [steps, 0], &words, 4 * threads as usize)?;
    let results = kernel.results(&job)?;
    let error = rows
        .iter()
        .zip(results.as_chunks::<4>().0)
        .take(1024)
        .map(|(&c, result)| {
            let [re, re_low, im, im_low] = result.map(|word| f64::from(f32::from_bits(word)));
            let [x, y] = last(c.map(f64::from), steps);
            (re + re_low - x).abs().max((im + im_low - y).abs())
        })
        .fold(0.0, f64::max);
    let start = Instant::now();
    kernel.repeat(&job, 1)?;
    let once = start.elapsed().as_secs_f64();
    let repeats = (SHORTEST / once).ceil().clamp(1.0, 1000.0) as u32;
    Ok(Contender {
        name,
        kernel,
        job,
        repeats,
        error,
        seconds: Vec::new(),
    })
}

/// The last z, in f64.
fn last([a, b]: [f64; 2], steps: u32) -> [f64; 2] {
    (0..steps).fold([0.0, 0.0], |[x, y], _| [x * x - y * y + a, 2.0 * x * y + b])
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
