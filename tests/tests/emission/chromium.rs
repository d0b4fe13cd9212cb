//! Emitted WGSL and GLSL, compiled and run in Chromium, against the tables of the gallery: WebGPU and WebGL 2 on the browser's
//! own software adapter, so that it needs no GPU. Tint and ANGLE, which compile them, share nothing with naga.

use std::time::Instant;

use pullback_compiler::{Target, What};
use pullback_runtime::validators::browser::{Silence, Site, ask, browser};
use pullback_tests::accuracy::error::Format;
use pullback_tests::accuracy::formulas::{MOST, gallery};

use crate::jobs::Job;

const PAGE: &str = include_str!("chromium.html");

/// One line of the browser for each job.
fn run(jobs: &[Job], interface: &str) -> Result<Vec<String>, Silence> {
    let scripts: Vec<String> = jobs.iter().map(Job::script).collect();
    let page = PAGE
        .replace("JOBS", &format!("[{}]", scripts.join(",\n")))
        .replace("INTERFACE", interface);
    let answer = ask(&Site {
        page,
        ..Site::default()
    })?;
    let lines = answer.split('\u{1e}');
    Ok(lines.map(|line| line.trim().to_owned()).collect())
}

/// The rows of all tables, by a browser's interface.
#[allow(clippy::print_stderr, reason = "a test that is skipped says so")]
fn judged(target: Target, interface: &str) {
    if browser().is_none() {
        eprintln!("skipped: Chromium is not installed (Debian: chromium)");
        return;
    }
    // the browser's adapter takes subnormal numbers for 0, as both standards allow, and so what is made of them
    let started = Instant::now();
    let tables: Vec<_> = gallery()
        .into_iter()
        .map(|table| table.without("underflow"))
        .collect();
    let (mut jobs, mut found) = (Vec::new(), Vec::new());
    for table in &tables {
        // what is asked is known only to the table: the second question brings the derivative with it
        let told = table.measure_by(Format::Single, &mut |formula, what, points| {
            if what != What::Value {
                jobs.push(Job::new(&table.source, formula, what, points, target)?);
            }
            Ok(vec![vec![0.0; 64]; points.len()])
        });
        told.unwrap_or_else(|reason| panic!("{}: {reason}", table.name));
    }
    let emitted = started.elapsed();
    let answers = match run(&jobs, interface) {
        Ok(answers) => answers,
        Err(Silence::Missing(what)) => {
            eprintln!("skipped: {what}");
            return;
        }
        Err(Silence::Failed(why)) => panic!("{why}"),
    };
    assert_eq!(answers.len(), jobs.len());
    let (mut judged, mut worst) = (0, 0.0f64);
    for ((table, job), answer) in tables.iter().zip(&jobs).zip(&answers) {
        let factors = table.measure_by(Format::Single, &mut |formula, what, _| {
            job.rows(formula, what, answer)
        });
        match factors {
            Err(reason) => found.push(format!("{}: {reason}", table.name)),
            Ok(factors) => {
                judged += factors.rows;
                let most = factors.value.max(factors.derivative);
                worst = worst.max(most);
                if most > MOST {
                    found.push(format!(
                        "{}: K = {most:.2}, not {MOST}: {}",
                        table.name, factors.worst
                    ));
                }
                found.extend(factors.wrong.iter().map(|w| format!("{}: {w}", table.name)));
            }
        }
    }
    eprintln!(
        "{interface}: {} formulas, {judged} rows, at most K = {worst:.2}, in {:.0?}, {emitted:.0?} of them emitting",
        jobs.len(),
        started.elapsed()
    );
    assert!(
        found.is_empty(),
        "{} violations\n{}",
        found.len(),
        found.join("\n")
    );
    assert!(judged > 4000, "{judged} rows");
}

#[test]
fn emitted_wgsl_runs_in_chromium() {
    judged(Target::Wgsl, "webgpu");
}

#[test]
fn emitted_glsl_runs_in_chromium() {
    judged(Target::Glsl, "webgl2");
}
