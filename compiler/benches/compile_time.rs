//! Time of the last diagnostic of long texts, and what stability rewrites add to the time from text to module. Stages and their
//! growth are timed by `pullback bench`.
//!
//! `cargo bench --workspace --bench compile_time -- [diagnostics] [rewrites]`

use std::time::Instant;

use pullback_compiler::lower::Precision;
use pullback_compiler::stable::Rewrites;
use pullback_compiler::{SceneModule, compile};

fn main() {
    let mut gallery: Vec<(String, String)> = Vec::new();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/gallery");
    for entry in std::fs::read_dir(folder).expect("the gallery").flatten() {
        let path = entry.path();
        if path.extension().is_some_and(|e| e == "pull") {
            let name = path.file_stem().map(|s| s.to_string_lossy().into_owned());
            gallery.push((
                name.unwrap_or_default(),
                std::fs::read_to_string(&path).expect("a file"),
            ));
        }
    }
    gallery.sort();
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let tables = ["diagnostics", "rewrites"];
    let some = asked.iter().any(|word| tables.contains(&word.as_str()));
    let is_asked = |table: &str| !some || asked.iter().any(|word| word == table);
    if is_asked("diagnostics") {
        diagnostics_table();
    }
    if is_asked("rewrites") {
        rewrites_table(&gallery);
    }
}

/// Formulas on which rules act, and a long one, beside the gallery.
const REWRITTEN: [&str; 5] = [
    "f(x, y) = sqrt(x + 1) - sqrt(x) + y",
    "f(x, y) = (-y + sqrt(y^2 - 4 x))/(2 x)",
    "f(z) = (1 - cos(z))/z^2",
    "f(x, y) = log(exp(x) + exp(y))",
    "f(x, y) = log((1 - x)/(1 + x)) - (exp(y) - exp(-y))/2",
];

/// What rewrites add to the time from text to module: both take turns, and the best of each is compared, which other work on
/// the machine lengthens least.
fn rewrites_table(gallery: &[(String, String)]) {
    println!("\nText to validated module with rewrites and without, best of 31 turns\n");
    println!("| formula | with, µs | without, µs | ratio |");
    println!("| --- | ---: | ---: | ---: |");
    let long: Vec<String> = (1..200)
        .map(|k| format!("sin({k} x) sqrt(y + {k})"))
        .collect();
    let long = (
        "199 terms".to_owned(),
        format!("f(x, y) = {}", long.join(" - ")),
    );
    let own = REWRITTEN
        .iter()
        .map(|t| (format!("`{t}`"), (*t).to_owned()));
    let mut ratios = Vec::new();
    for (name, text) in gallery.iter().cloned().chain(own).chain([long]) {
        let [with, without, ratio] = with_and_without(&text, 31);
        println!("| {name} | {with:.0} | {without:.0} | {ratio:.2} |");
        if ratios.len() < gallery.len() {
            ratios.push(ratio);
        }
    }
    let most = ratios.iter().copied().fold(0.0, f64::max);
    let median = median(ratios);
    println!("\nRatio over the gallery: median {median:.2}, greatest {most:.2}");
}

/// Microseconds with rewrites, without, and the ratio.
fn with_and_without(text: &str, turns: usize) -> [f64; 3] {
    let time = |rewrites: Rewrites| {
        let start = Instant::now();
        let program = compile(text).program.expect("a program without errors");
        let program = program.with_rewrites(rewrites);
        let module = SceneModule::new(&program.pictures()[0], Precision::Accurate);
        std::hint::black_box(module).expect("a module");
        start.elapsed().as_secs_f64() * 1e6
    };
    let mut all: Vec<[f64; 2]> = (0..=turns)
        .map(|_| [time(Rewrites::ON), time(Rewrites::OFF)])
        .collect();
    // the first turn parses templates
    all.remove(0);
    let best = |k: usize| all.iter().map(|t| t[k]).fold(f64::INFINITY, f64::min);
    [best(0), best(1), best(0) / best(1)]
}

/// Texts of 1 MiB: how long until the last diagnostic of the whole compiler.
fn diagnostics_table() {
    println!("\n1 MiB of text to the last diagnostic, best of 7 runs\n");
    println!("| text | time, ms | diagnostics |");
    println!("| --- | ---: | ---: |");
    for (name, text) in large_texts() {
        let mut best = f64::INFINITY;
        let mut found = 0;
        for _ in 0..7 {
            let start = Instant::now();
            found = std::hint::black_box(compile(&text)).diagnostics.len();
            best = best.min(start.elapsed().as_secs_f64() * 1e3);
        }
        println!("| {name} | {best:.1} | {found} |");
    }
}

fn large_texts() -> Vec<(&'static str, String)> {
    const SIZE: usize = 1 << 20;
    let lines = |line: &dyn Fn(usize) -> String| {
        let mut text = "f(x, y) = x + y\n".to_owned();
        let mut k = 0;
        while text.len() < SIZE {
            text.push_str(&line(k));
            text.push('\n');
            k += 1;
        }
        text
    };
    let mut chain = "f(x, y) = x".to_owned();
    while chain.len() < SIZE {
        chain.push_str(" + sin(3 x y)^2/(1 + |x - y|)");
    }
    vec![
        (
            "functions that nothing uses",
            lines(&|k| format!("g{k}(x, y) = cos(k{k} x) + sin(y)^2/(1 + |x y|) where k{k} = {k}")),
        ),
        (
            "an unknown name in each line",
            lines(&|k| format!("g{k}(x, y) = cos(a{k} x) + sin(y)^2")),
        ),
        (
            "a wrong type in each line",
            lines(&|k| format!("g{k}(x, y) = (x, y) + (x, y, {k}) < 2")),
        ),
        (
            "a loop and a derivative in each line",
            lines(&|k| {
                format!(
                    "g{k}(x, y) = sum(j in 1..{}, sin(j x)/j) + diff(x^{} y, x)",
                    k % 50,
                    k % 9
                )
            }),
        ),
        (
            "a syntax error in each line",
            lines(&|k| format!("g{k}(x, y) = cos({k} x + * sin(y)")),
        ),
        ("one expression", chain),
    ]
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
