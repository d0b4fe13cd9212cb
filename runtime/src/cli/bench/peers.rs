//! `pullback bench --peer`: other programs at the same formulas, where they are installed.

mod compiled;
mod fidget;
mod model;
mod pictures;

use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Program, Target, What, compile};
use pullback_runtime::Gpu;
use pullback_runtime::bench::median;
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::executor::{Arithmetic, Rows};

use super::BenchArguments;
use crate::cli::Console;
use crate::cli::failure::Failure;

/// What asks the peers, for a Python 3.
const SCRIPT: &str = include_str!("peers/peers.py");
/// Longest time that a program is given.
const PATIENCE: Duration = Duration::from_secs(1200);
/// Turns of ours.
const TURNS: usize = 9;
/// Points in a batch.
const POINTS: usize = 1 << 14;

/// A formula in three languages.
struct Formula {
    name: &'static str,
    names: &'static str,
    ours: &'static str,
    sympy: &'static str,
    slang: &'static str,
}

const fn formula([name, names, ours, sympy, slang]: [&'static str; 5]) -> Formula {
    Formula {
        name,
        names,
        ours,
        sympy,
        slang,
    }
}

const FORMULAS: [Formula; 6] = [
    formula([
        "peaks",
        "x y",
        "3(1 - x)^2 exp(-x^2 - (y + 1)^2) - 10(x/5 - x^3 - y^5) exp(-x^2 - y^2) - exp(-(x + 1)^2 - y^2)/3",
        "3*(1 - x)**2*exp(-x**2 - (y + 1)**2) - 10*(x/5 - x**3 - y**5)*exp(-x**2 - y**2) - exp(-(x + 1)**2 - y**2)/3",
        "3*(1-x)*(1-x)*exp(-x*x-(y+1)*(y+1)) - 10*(x/5-x*x*x-y*y*y*y*y)*exp(-x*x-y*y) - exp(-(x+1)*(x+1)-y*y)/3",
    ]),
    formula([
        "gyroid",
        "x y z",
        "sin(x) cos(y) + sin(y) cos(z) + sin(z) cos(x)",
        "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)",
        "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)",
    ]),
    formula([
        "heart",
        "x y z",
        "(x^2 + 2.25y^2 + z^2 - 1)^3 - x^2 z^3 - 0.1125 y^2 z^3",
        "(x**2 + 2.25*y**2 + z**2 - 1)**3 - x**2*z**3 - 0.1125*y**2*z**3",
        "(x*x+2.25*y*y+z*z-1)*(x*x+2.25*y*y+z*z-1)*(x*x+2.25*y*y+z*z-1) - x*x*z*z*z - 0.1125*y*y*z*z*z",
    ]),
    formula([
        "sphere",
        "x y z",
        "sqrt(x^2 + y^2 + z^2) - 1",
        "sqrt(x**2 + y**2 + z**2) - 1",
        "sqrt(x*x + y*y + z*z) - 1",
    ]),
    formula([
        "gaussian",
        "x y z",
        "exp(-(x^2 + y^2 + z^2))",
        "exp(-(x**2 + y**2 + z**2))",
        "exp(-(x*x + y*y + z*z))",
    ]),
    formula([
        "airlight",
        "x y z",
        "1/(x^2 + y^2 + z^2 + 1)",
        "1/(x**2 + y**2 + z**2 + 1)",
        "1/(x*x + y*y + z*z + 1)",
    ]),
];

/// What is timed, in the words of the script.
const TIMED: [&str; 5] = [
    "gradient, made",
    "integral on a ray, made",
    "text to SPIR-V",
    "value and gradient, a point",
    PICTURE,
];

/// The last of them: whole pictures, which have formulas of their own.
const PICTURE: &str = "picture";

/// What executes our own formulas on the processor: the executor, and C by the compiler of the system.
const COMPILED: &str = "pullback, in C";

/// Prints the table.
pub(super) fn run(arguments: &BenchArguments, console: &Console) -> Result<(), Failure> {
    let gpu = match arguments.model {
        Some(_) => Some(super::super::open(&arguments.device.adapter, console)?),
        None => None,
    };
    let text = table(arguments, gpu.as_ref(), console)?;
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(Failure::stdout)
}

/// Seconds, or why there are none, of what is timed of a formula by a program.
type Cells = BTreeMap<(&'static str, String, String), String>;

/// What programs have told.
#[derive(Default)]
struct Told {
    cells: Cells,
    peers: Vec<String>,
    missing: Vec<String>,
}

impl Told {
    fn put(&mut self, what: &'static str, name: &str, peer: &str, time: Option<f64>) {
        let shown = time.map_or_else(|| "none".to_owned(), |s| seconds(&s.to_string()));
        self.cell(what, name, peer, shown);
    }

    fn cell(&mut self, what: &'static str, name: &str, peer: &str, shown: String) {
        self.cells
            .insert((what, name.to_owned(), peer.to_owned()), shown);
        if !self.peers.iter().any(|known| known == peer) {
            self.peers.push(peer.to_owned());
        }
    }

    /// Takes lines of peer, version, what is timed, name and result, with tabs between.
    fn lines(&mut self, answer: &str) {
        for line in answer.lines() {
            let words: Vec<&str> = line.split('\t').collect();
            let &[peer, version, what, name, result] = words.as_slice() else {
                continue;
            };
            if version == "missing" {
                self.missing.push(format!("{peer} is missing here."));
                continue;
            }
            if let Some(what) = TIMED.iter().find(|timed| **timed == what) {
                self.cell(what, name, &format!("{peer} {version}"), seconds(result));
            }
        }
    }
}

/// The table in Markdown, with a line for each peer that is missing.
pub(super) fn table(
    arguments: &BenchArguments,
    gpu: Option<&Gpu>,
    console: &Console,
) -> Result<String, Failure> {
    let mut told = Told::default();
    for formula in &FORMULAS {
        own(formula, &mut told)?;
    }
    match python() {
        Ok(answer) => told.lines(&answer),
        Err(reason) => {
            for peer in ["SymPy", "mpmath", "Slang"] {
                told.missing
                    .push(format!("{peer} is missing here: {reason}."));
            }
        }
    }
    let fidget = fidget::program(console).and_then(|program| {
        told.lines(&fidget::formulas(&program)?);
        Ok(program)
    });
    match (&fidget, &arguments.model, gpu) {
        (Err(reason), ..) => told
            .missing
            .push(format!("fidget is missing here: {reason}.")),
        (Ok(program), Some(model), Some(gpu)) => drawn(
            program,
            model,
            arguments.pictures.as_deref(),
            gpu,
            &mut told,
            console,
        )?,
        _ => {}
    }
    Ok(written(&told.cells, &told.peers, &told.missing))
}

/// Both pictures by fidget and by us.
fn drawn(
    fidget: &Path,
    model: &Path,
    folder: Option<&Path>,
    gpu: &Gpu,
    told: &mut Told,
    console: &Console,
) -> Result<(), Failure> {
    let io = |error| Failure::Io {
        what: "pictures".to_owned(),
        error,
    };
    let temporary = tempfile::tempdir().map_err(io)?;
    let folder = folder.unwrap_or(temporary.path());
    std::fs::create_dir_all(folder).map_err(io)?;
    let program = pictures::program(model)?;
    std::fs::copy(model, folder.join("model.vm")).map_err(io)?;
    let times = pictures::ours(&program, gpu, folder, console)?;
    for (name, time) in ["model", "gyroid"].into_iter().zip(times) {
        told.put(PICTURE, name, "pullback", Some(time));
    }
    match fidget::pictures(fidget, folder) {
        Ok(answer) => {
            told.lines(&answer);
            let file = std::fs::read(folder.join("model.pgm")).map_err(io)?;
            let [differing, count] = pictures::differing(&program, gpu, &file)?;
            told.missing.push(format!(
                "Of {count} pixels of the model {differing} are inside for one program alone."
            ));
        }
        Err(reason) => told.missing.push(reason),
    }
    Ok(())
}

fn written(cells: &Cells, peers: &[String], missing: &[String]) -> String {
    let mut text = format!(
        "| timed | formula | {} |\n| --- | --- |{}\n",
        peers.join(" | "),
        " ---: |".repeat(peers.len())
    );
    for what in TIMED {
        let names: Vec<&str> = match what {
            PICTURE => vec!["model", "gyroid"],
            _ => FORMULAS.iter().map(|formula| formula.name).collect(),
        };
        for name in names {
            let cell = |peer: &String| {
                let found = cells.get(&(what, name.to_owned(), peer.clone()));
                found.map_or("", String::as_str)
            };
            let row: Vec<&str> = peers.iter().map(cell).collect();
            if row.iter().any(|cell| !cell.is_empty()) {
                text += &format!("| {what} | {name} | {} |\n", row.join(" | "));
            }
        }
    }
    for line in missing {
        text += &format!("\n{line}\n");
    }
    text
}

/// Seconds in a unit that suits them; words as they are.
fn seconds(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(s) if s >= 1.0 => format!("{s:.2} s"),
        Ok(s) if s >= 1e-3 => format!("{:.2} ms", 1e3 * s),
        Ok(s) if s >= 1e-6 => format!("{:.2} µs", 1e6 * s),
        Ok(s) => format!("{:.2} ns", 1e9 * s),
        Err(_) => text.replace('|', "/"),
    }
}

/// Our own times.
fn own(formula: &Formula, told: &mut Told) -> Result<(), Failure> {
    let arguments = formula.names.replace(' ', ", ");
    let text = format!("f({arguments}) = {}", formula.ours);
    let derived = timed(|| Some(program(&text)?.evaluator(0, What::Gradient).is_ok()));
    let emitted = |what, target| {
        timed(|| {
            Some(
                program(&text)?
                    .emit(0, what, target, Precision::Accurate)
                    .is_ok(),
            )
        })
    };
    let mut put = |what, time| told.put(what, formula.name, "pullback", time);
    put(TIMED[0], derived);
    // a ray is one of space
    if formula.names == "x y z" {
        put(TIMED[1], emitted(EmitWhat::Integral, Target::Wgsl));
    }
    put(TIMED[2], emitted(EmitWhat::Gradient, Target::Spirv));
    put(TIMED[3], per_point(formula, &text)?);
    let compiled = program(&text).and_then(|made| compiled::per_point(&made, formula.names));
    if let Some(time) = compiled {
        told.put(TIMED[3], formula.name, COMPILED, Some(time));
    }
    Ok(())
}

fn program(text: &str) -> Option<Program> {
    compile(text).program
}

/// The median of some turns of what succeeds; nothing where it does not.
fn timed(mut work: impl FnMut() -> Option<bool>) -> Option<f64> {
    let mut times = Vec::with_capacity(TURNS);
    for _ in 0..=TURNS {
        let start = Instant::now();
        if work() != Some(true) {
            return None;
        }
        times.push(start.elapsed().as_secs_f64());
    }
    // tables that are made once are no part of it
    Some(median(&times[1..]))
}

/// Seconds of a point's value and gradient in f64 by the executor, of a batch on all cores.
fn per_point(formula: &Formula, text: &str) -> Result<Option<f64>, Failure> {
    let Some(program) = program(text) else {
        return Ok(None);
    };
    let Ok(module) = program.eval_module(0, What::Gradient, Precision::Double) else {
        return Ok(None);
    };
    let rows = Rows::new(&module, Arithmetic::Reference)?;
    let columns = formula.names.split(' ').count();
    let points: Vec<f64> = (0..POINTS * columns)
        .map(|k| (k as f64 * 0.618_033_988).fract() - 0.5)
        .collect();
    Ok(timed(|| {
        let done = rows.eval(Surroundings::default(), POINTS, &points, &mut Vec::new());
        Some(done.is_ok())
    })
    .map(|seconds| seconds / POINTS as f64))
}

/// What the peers in Python say; why nothing where there is no Python.
fn python() -> Result<String, String> {
    let line = |f: &Formula| format!("{}\t{}\t{}\t{}\n", f.name, f.names, f.sympy, f.slang);
    let input: String = FORMULAS.iter().map(line).collect();
    answer(Command::new("python3").args(["-c", SCRIPT]), &input)
}

/// What a program writes, given a text; why it fails.
fn answer(command: &mut Command, input: &str) -> Result<String, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(|error| format!("{name}: {error}"))?;
    if let Some(mut to) = child.stdin.take() {
        // who does not read says nothing
        let _ = to.write_all(input.as_bytes());
    }
    let mut output = child.stdout.take();
    let reader = thread::spawn(move || {
        let mut text = Vec::new();
        if let Some(output) = &mut output {
            let _ = output.read_to_end(&mut text);
        }
        String::from_utf8_lossy(&text).into_owned()
    });
    wait(&mut child);
    let text = reader.join().unwrap_or_default();
    match child.wait() {
        Ok(status) if status.success() || !text.is_empty() => Ok(text),
        Ok(status) => Err(format!("{name}: {status}")),
        Err(error) => Err(format!("{name}: {error}")),
    }
}

/// Until it ends, or for so long.
fn wait(child: &mut Child) {
    let start = Instant::now();
    while matches!(child.try_wait(), Ok(None)) {
        if start.elapsed() > PATIENCE {
            let _ = child.kill();
            let _ = child.wait();
            return;
        }
        thread::sleep(Duration::from_millis(20));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_formulas_are_our_own_language() {
        let mut told = Told::default();
        for formula in &FORMULAS {
            own(formula, &mut told).unwrap();
        }
        for formula in &FORMULAS {
            for what in TIMED.into_iter().filter(|&what| what != PICTURE) {
                let key = (what, formula.name.to_owned(), "pullback".to_owned());
                // a ray is one of space
                let asked = formula.names == "x y z" || what != TIMED[1];
                let found = told.cells.get(&key).map(String::as_str);
                assert_eq!(found.is_some(), asked, "{what} of {}", formula.name);
                assert_ne!(found, Some("none"), "{what} of {}", formula.name);
            }
        }
    }

    #[test]
    fn a_peer_that_is_missing_is_named() {
        let text = written(
            &Cells::new(),
            &["pullback".to_owned()],
            &["Slang is missing here.".to_owned()],
        );
        assert!(text.ends_with("Slang is missing here.\n"), "{text}");
        assert_eq!(seconds("0.00251"), "2.51 ms");
        assert_eq!(seconds("more than 20 s"), "more than 20 s");
    }
}
