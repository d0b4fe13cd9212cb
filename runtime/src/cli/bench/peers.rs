//! `pullback bench --peer`: other programs at the same formulas, where they are installed.

use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Program, Target, What, compile};
use pullback_runtime::bench::median;
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::executor::{Arithmetic, Rows};

use super::BenchArguments;
use crate::cli::Console;
use crate::cli::failure::Failure;

/// What asks the peers, for a Python 3.
const SCRIPT: &str = include_str!("peers.py");
/// Longest time that they are given together.
const PATIENCE: Duration = Duration::from_secs(400);
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
const TIMED: [&str; 4] = [
    "gradient, made",
    "integral on a ray, made",
    "text to SPIR-V",
    "value and gradient, a point",
];

/// Prints the table.
pub(super) fn run(_: &BenchArguments, console: &Console) -> Result<(), Failure> {
    let text = table(console)?;
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(Failure::stdout)
}

/// Seconds, or why there are none, of what is timed of a formula by a program.
type Cells = BTreeMap<(&'static str, String, String), String>;

/// The table in Markdown, with a line for each peer that is missing.
pub(super) fn table(console: &Console) -> Result<String, Failure> {
    let mut cells = Cells::new();
    for formula in &FORMULAS {
        own(formula, &mut cells)?;
    }
    let answer = asked().unwrap_or_else(|reason| {
        console.warning(&reason);
        ["SymPy", "mpmath", "Slang", "fidget"]
            .map(|peer| format!("{peer}\tmissing\t\t\t\n"))
            .concat()
    });
    let mut peers = vec!["pullback".to_owned()];
    let mut missing = Vec::new();
    for line in answer.lines() {
        let words: Vec<&str> = line.split('\t').collect();
        let &[peer, version, what, name, result] = words.as_slice() else {
            continue;
        };
        if version == "missing" {
            missing.push(peer.to_owned());
            continue;
        }
        let peer = format!("{peer} {version}");
        let Some(what) = TIMED.iter().find(|timed| **timed == what) else {
            continue;
        };
        cells.insert((what, name.to_owned(), peer.clone()), seconds(result));
        if !peers.contains(&peer) {
            peers.push(peer);
        }
    }
    Ok(written(&cells, &peers, &missing))
}

fn written(cells: &Cells, peers: &[String], missing: &[String]) -> String {
    let mut text = format!(
        "| timed | formula | {} |\n| --- | --- |{}\n",
        peers.join(" | "),
        " ---: |".repeat(peers.len())
    );
    for what in TIMED {
        for formula in &FORMULAS {
            if what == TIMED[1] && formula.names != "x y z" {
                continue;
            }
            let cell = |peer: &String| {
                let found = cells.get(&(what, formula.name.to_owned(), peer.clone()));
                found.map_or("", String::as_str)
            };
            let row: Vec<&str> = peers.iter().map(cell).collect();
            text += &format!("| {what} | {} | {} |\n", formula.name, row.join(" | "));
        }
    }
    for peer in missing {
        text += &format!("\n{peer} is missing here.\n");
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
fn own(formula: &Formula, cells: &mut Cells) -> Result<(), Failure> {
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
    let integrated = match formula.names {
        "x y z" => emitted(EmitWhat::Integral, Target::Wgsl),
        _ => None,
    };
    let written = emitted(EmitWhat::Gradient, Target::Spirv);
    let times = [derived, integrated, written, per_point(formula, &text)?];
    for (what, time) in TIMED.into_iter().zip(times) {
        if what == TIMED[1] && formula.names != "x y z" {
            continue;
        }
        let shown = time.map_or_else(|| "none".to_owned(), |s| seconds(&s.to_string()));
        cells.insert(
            (what, formula.name.to_owned(), "pullback".to_owned()),
            shown,
        );
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

/// What the script says; why nothing where there is no Python.
fn asked() -> Result<String, String> {
    let absent = |error: std::io::Error| format!("no peer can be asked: python3: {error}");
    let mut child = Command::new("python3")
        .args(["-c", SCRIPT])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(absent)?;
    if let Some(mut input) = child.stdin.take() {
        for Formula {
            name,
            names,
            sympy,
            slang,
            ..
        } in &FORMULAS
        {
            // who does not read says nothing
            let _ = writeln!(input, "{name}\t{names}\t{sympy}\t{slang}");
        }
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
    Ok(reader.join().unwrap_or_default())
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
        let mut cells = Cells::new();
        for formula in &FORMULAS {
            own(formula, &mut cells).unwrap();
        }
        for formula in &FORMULAS {
            for what in TIMED {
                let key = (what, formula.name.to_owned(), "pullback".to_owned());
                // a ray is one of space
                let asked = formula.names == "x y z" || what != TIMED[1];
                let found = cells.get(&key).map(String::as_str);
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
            &["Slang".to_owned()],
        );
        assert!(text.ends_with("Slang is missing here.\n"), "{text}");
        assert_eq!(seconds("0.00251"), "2.51 ms");
        assert_eq!(seconds("more than 20 s"), "more than 20 s");
    }
}
