//! `pullback doctor`

use std::io::{self, Write};
use std::time::Instant;

use pullback_compiler::What;
use pullback_compiler::lower::Precision;
use pullback_runtime::device::{self, AdapterSummary};
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::probe::{self, Arithmetic};
use pullback_runtime::{Error, Gpu, GpuEvaluator};

use super::Console;
use super::failure::{Failure, INSTALL_SOFTWARE};

/// Features that make a difference to us, and what they are good for.
const FEATURES: [(&str, wgpu::Features, &str); 4] = [
    (
        "SHADER_F64",
        wgpu::Features::SHADER_F64,
        "native double precision",
    ),
    (
        "TIMESTAMP_QUERY",
        wgpu::Features::TIMESTAMP_QUERY,
        "timing on the device",
    ),
    ("SUBGROUP", wgpu::Features::SUBGROUP, "subgroup operations"),
    (
        "PASSTHROUGH_SHADERS",
        wgpu::Features::PASSTHROUGH_SHADERS,
        "shaders decorated by us",
    ),
];
/// Rows of the trial.
const ROWS: usize = 1 << 16;

/// Says what there is, tries it, and says what is missing.
pub(super) fn run(_console: &Console) -> Result<(), Failure> {
    let mut text = format!(
        "pullback {} on {} {}\n\n",
        env!("CARGO_PKG_VERSION"),
        std::env::consts::OS,
        std::env::consts::ARCH
    );
    let adapters = device::adapters();
    let mut working = Vec::new();
    for (i, adapter) in adapters.iter().enumerate() {
        let summary = device::summary(adapter);
        text += &format!("adapter {}: {}\n", i + 1, summary.name);
        text += &facts(adapter, &summary);
        match trial(adapter) {
            Ok(lines) => {
                text += &lines;
                text.push('\n');
                working.push(summary);
            }
            Err(error) => text += &format!("  test       FAILED: {error}\n\n"),
        }
    }
    text += &advice(adapters.len(), &working);
    io::stdout()
        .write_all(text.as_bytes())
        .map_err(Failure::stdout)?;
    if working.is_empty() {
        return Err(Failure::Device(Error::NoAdapter {
            wanted: pullback_runtime::AdapterChoice::Auto,
            found: adapters.iter().map(device::summary).collect(),
        }));
    }
    Ok(())
}

fn facts(adapter: &wgpu::Adapter, summary: &AdapterSummary) -> String {
    let limits = adapter.limits();
    let mebibytes = |bytes: u64| bytes >> 20;
    let mut text = format!(
        "  kind       {}\n  interface  {}\n  driver     {}\n",
        summary.kind_words(),
        summary.backend,
        summary.driver
    );
    text += &format!(
        "  limits     buffer {} MiB, storage binding {} MiB, texture side {}, workgroups {}\n",
        mebibytes(limits.max_buffer_size),
        mebibytes(limits.max_storage_buffer_binding_size),
        limits.max_texture_dimension_2d,
        limits.max_compute_workgroups_per_dimension
    );
    for (name, feature, meaning) in FEATURES {
        let answer = if adapter.features().contains(feature) {
            "yes"
        } else {
            "no "
        };
        text += &format!("  feature    {answer} {name} ({meaning})\n");
    }
    text
}

/// Evaluates a formula on the adapter, compares, and tries the adapter's arithmetic.
fn trial(adapter: &wgpu::Adapter) -> Result<String, Error> {
    let invalid = |reason: &str| Error::Invalid {
        reason: reason.into(),
    };
    let program = pullback_compiler::compile("x*y + 1")
        .program
        .ok_or_else(|| invalid("the trial formula does not compile"))?;
    let module = program
        .eval_module(0, What::Value, Precision::Accurate)
        .map_err(|_| invalid("the trial formula does not compile"))?;
    let start = Instant::now();
    let gpu = Gpu::from_adapter(adapter)?;
    let mut evaluator = GpuEvaluator::new(&gpu, &module)?;
    let ready = start.elapsed();
    let start = Instant::now();
    let rows: Vec<f32> = (0..2 * ROWS).map(|i| (i % 1024) as f32).collect();
    let mut results = Vec::new();
    evaluator.eval(Surroundings::default(), ROWS, &rows, &mut results)?;
    let elapsed = start.elapsed();
    let right = results.len() == ROWS
        && rows
            .as_chunks::<2>()
            .0
            .iter()
            .zip(&results)
            .all(|([x, y], result)| x * y + 1.0 == *result);
    if !right {
        return Err(invalid("the results are wrong"));
    }
    Ok(format!(
        "  test       ok, ready in {:.0} ms, {ROWS} rows in {:.1} ms\n{}",
        ready.as_secs_f64() * 1e3,
        elapsed.as_secs_f64() * 1e3,
        habits(&probe::arithmetic(&gpu)?)
    ))
}

/// The adapter's arithmetic in words.
fn habits(found: &Arithmetic) -> String {
    let exact = |share: f64| {
        if share == 0.0 {
            "exact".to_owned()
        } else {
            format!("wrong for {:.1} %", 100.0 * share)
        }
    };
    let yes = |kept: bool, habit: &'static str, vice: &'static str| if kept { habit } else { vice };
    format!(
        "  sums       TwoSum as written {}, with hidden steps {}\n  \
           products   TwoProd by fma {}, by splitting with hidden steps {}\n  \
           rounding   division within {:.2} ulp, square root within {:.2} ulp\n  \
           special    subnormals {}, NaN {}, infinity {}\n",
        exact(found.two_sum),
        exact(found.two_sum_opaque),
        exact(found.two_prod_fma),
        exact(found.two_prod_split),
        found.division_ulp,
        found.sqrt_ulp,
        yes(found.subnormals, "kept", "flushed to zero"),
        yes(found.nan, "unequal to itself", "taken for equal to itself"),
        yes(found.infinity, "of 1/0", "not of 1/0"),
    )
}

fn advice(found: usize, working: &[AdapterSummary]) -> String {
    let mut text = String::new();
    match working.first() {
        Some(best) => text += &format!("pictures are drawn by {best}\n"),
        None if found == 0 => text += "there is no graphics adapter\n",
        None => text += "no graphics adapter works\n",
    }
    if !working.iter().any(|adapter| !adapter.is_software()) {
        text += "no hardware adapter: if this machine has a GPU, install its vendor's driver with Vulkan\n";
        if cfg!(target_os = "linux") {
            text += "  (NVIDIA in a container: the graphics capability, and libvulkan1; AMD and Intel: mesa-vulkan-drivers)\n";
        }
    }
    if !working.iter().any(AdapterSummary::is_software) {
        text += &format!("no software adapter: {INSTALL_SOFTWARE}\n");
    }
    text
}
