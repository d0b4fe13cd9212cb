//! Our formulas in C, compiled by the compiler of the system: the value and the gradient of a point.

use std::process::Command;

use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Program, Target};
use pullback_runtime::bench::median;

use super::{POINTS, answer};

/// Seconds of a point's value and gradient; nothing where there is no compiler.
pub(super) fn per_point(program: &Program, names: &str) -> Option<f64> {
    let emitted = program
        .emit(0, EmitWhat::Gradient, Target::C, Precision::Fast)
        .ok()?;
    let folder = tempfile::tempdir().ok()?;
    let [source, built] = ["unit.c", "unit"].map(|name| folder.path().join(name));
    let text = String::from_utf8(emitted).ok()? + &driver(names);
    std::fs::write(&source, text).ok()?;
    let mut cc = Command::new("cc");
    cc.args(["-O3", "-march=native", "-ffp-contract=off", "-w"])
        .arg(&source)
        .arg("-o")
        .arg(&built)
        .arg("-lm");
    answer(&mut cc, "").ok()?;
    let text = answer(&mut Command::new(&built), "").ok()?;
    let times: Vec<f64> = text.lines().filter_map(|line| line.parse().ok()).collect();
    // the first turn warms up
    let times = times.get(1..).filter(|times| !times.is_empty())?;
    Some(median(times) / POINTS as f64)
}

/// Calls the function for a batch of points, in turns, and writes their seconds.
fn driver(names: &str) -> String {
    let count = names.split(' ').count();
    let places: Vec<String> = (0..count)
        .map(|k| format!("points[{count} * k + {k}]"))
        .collect();
    let parts = ["x", "y", "z", "w"];
    let sum: Vec<String> = parts[..=count]
        .iter()
        .map(|part| format!("v.{part}"))
        .collect();
    format!(
        "
#include <stdio.h>
#include <time.h>

static float points[{count} * {POINTS}], results[{POINTS}];

int main(void) {{
    for (int k = 0; k < {count} * {POINTS}; k++) {{
        points[k] = (float)(fmod(k * 0.618033988, 1.0) - 0.5);
    }}
    float all = 0.0f;
    for (int turn = 0; turn < 10; turn++) {{
        struct timespec from, to;
        clock_gettime(CLOCK_MONOTONIC, &from);
        for (int k = 0; k < {POINTS}; k++) {{
            vec{} v = f_gradient({});
            results[k] = {};
        }}
        clock_gettime(CLOCK_MONOTONIC, &to);
        all += results[turn];
        printf(\"%.9e\\n\", (double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec));
    }}
    return all == 123.0f;
}}
",
        count + 1,
        places.join(", "),
        sum.join(" + ")
    )
}
