//! three.js itself, in Chromium: the emitted chunk in a `ShaderMaterial` on WebGL 2, and the emitted node functions in a material of
//! its WebGPU renderer. The script `pullback` gets the package `three`.

use pullback_compiler::{Emission, EmitWhat, Target, What};
use pullback_runtime::validators::browser::{Silence, Site, ask};
use pullback_runtime::validators::three;

use crate::program;

const PAGE: &str = include_str!("three/page.html");
/// Points on a side of the picture.
const SIDE: usize = 16;
/// Largest error of a number, relative to it or to 1: what single precision leaves of these formulas.
const MOST: f64 = 4e-6;

const PROGRAMS: [&str; 8] = [
    "f(x, y) = sin(2x) cos(y)",
    "param k = 2 in 0..5\nwave(x, y) = sin(k x) cos(y)",
    "f(x, y) = exp(-x²) y",
    "ring(x, y) = hypot(x, y) - 1",
    "cubic(x, y) = x³ y + y²",
    "harmonics(x, y) = sum(j in 1..8, sin(j x)/j) - y",
    "param k = 1.5\nparam c = 0.25\nmixed(x, y) = k log(1 + x² + c) + √(y² + 1)",
    "f(x, y) = gamma(x + 3) + erf(y)",
];

/// The page, with the emitted modules as the files that it imports.
fn site(renderer: &str) -> Result<Site, Silence> {
    let mut files = three()?;
    let mut jobs = Vec::new();
    for (k, text) in PROGRAMS.iter().enumerate() {
        let program = program(text, text);
        let emitted = |target| {
            let emitted = program.emit_all(&Emission::new(EmitWhat::Gradient, target));
            emitted.unwrap_or_else(|problems| panic!("{text}: {problems:?}"))
        };
        let [chunk, nodes] = [emitted(Target::Three), emitted(Target::Tsl)];
        let call = chunk.functions[0].name.clone();
        let parameters: Vec<f64> = program.params().iter().map(|p| p.default).collect();
        jobs.push(format!(
            "{{chunk: '/chunk_{k}.js', nodes: '/nodes_{k}.js', name: '{}', call: '{call}', parameters: {parameters:?}}}",
            call.trim_end_matches("_gradient"),
        ));
        files.insert(format!("chunk_{k}.js"), chunk.bytes);
        files.insert(format!("nodes_{k}.js"), nodes.bytes);
    }
    let page = PAGE
        .replace("JOBS", &format!("[{}]", jobs.join(", ")))
        .replace("RENDERER", renderer);
    Ok(Site { page, files })
}

/// Draws all programs, and compares each number with the evaluator's.
#[allow(clippy::print_stderr, reason = "a test that is skipped says so")]
fn judged(renderer: &str) {
    let answer = match site(renderer).and_then(|site| ask(&site)) {
        Ok(answer) => answer,
        Err(Silence::Missing(what)) => {
            eprintln!("skipped: {what}");
            return;
        }
        Err(Silence::Failed(why)) => panic!("{why}"),
    };
    let lines: Vec<&str> = answer.split('\u{1e}').collect();
    assert_eq!(lines.len(), PROGRAMS.len(), "{answer}");
    let mut worst = 0.0_f64;
    for (text, line) in PROGRAMS.iter().zip(lines) {
        let program = program(text, text);
        let params: Vec<f64> = program.params().iter().map(|p| p.default).collect();
        let mut evaluator = program.evaluator(0, What::Gradient).expect("a gradient");
        let numbers: Vec<f64> = line
            .split_whitespace()
            .map(|n| n.parse().unwrap_or_else(|_| panic!("{text}: {line}")))
            .collect();
        assert_eq!(numbers.len(), 4 * SIDE * SIDE, "{text}");
        let mut seen = vec![false; SIDE * SIDE];
        for pixel in numbers.chunks_exact(4) {
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "the pixel tells which it is by a small whole number"
            )]
            let at = pixel[3] as usize;
            seen[at] = true;
            #[allow(clippy::cast_precision_loss, reason = "places of pixels")]
            let place = |k: usize| (k as f64 + 0.5) / 4.0 - 2.0;
            let mut wanted = [0.0; 3];
            let point = [place(at % SIDE), place(at / SIDE)];
            evaluator.eval(&params, 0.0, 0.0, &point, &mut wanted);
            wanted.rotate_left(1);
            for (is, should) in pixel.iter().zip(wanted) {
                let off = (is - should).abs() / should.abs().max(1.0);
                worst = worst.max(off);
                assert!(
                    off <= MOST,
                    "{text} at {point:?}: {pixel:?}, not {wanted:?}"
                );
            }
        }
        assert!(seen.iter().all(|&s| s), "{text}: not all points are there");
    }
    eprintln!(
        "three.js, {renderer}: {} functions, at most {worst:.1e} off",
        PROGRAMS.len()
    );
}

#[test]
fn a_chunk_computes_what_it_should_in_three_js() {
    judged("chunks");
}

#[test]
fn node_functions_compute_what_they_should_in_three_js() {
    judged("nodes");
}
