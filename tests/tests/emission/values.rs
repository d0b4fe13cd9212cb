//! Emitted C, compiled and run, against the tables of the gallery: the same bounds that hold for a graphics device.

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

use pullback_compiler::formula::Formula;
use pullback_compiler::lower::Precision;
use pullback_compiler::types::Type;
use pullback_compiler::{Emission, EmitWhat, Target, What, compile};
use pullback_tests::accuracy::error::Format;
use pullback_tests::accuracy::evaluators::Point;
use pullback_tests::accuracy::formulas::{MOST, gallery};

/// The program that prints what the function gives at each point, one line each.
fn main_program(
    formula: &Formula,
    name: &str,
    signature: &str,
    points: &[Point],
    params: usize,
) -> String {
    let mut out = String::from("\n#include <stdio.h>\n#include <string.h>\n\nint main(void) {\n");
    let result = signature.split(' ').next().unwrap_or("float");
    for point in points {
        let mut arguments = Vec::new();
        let mut at = 0;
        let mut float = || {
            #[allow(
                clippy::cast_possible_truncation,
                reason = "a number as the function takes it"
            )]
            let value = point.args[at] as f32;
            at += 1;
            if value.is_finite() {
                format!("{value:?}f")
            } else {
                format!("({}1.0f / 0.0f)", if value < 0.0 { "-" } else { "" })
            }
        };
        for input in &formula.inputs {
            arguments.push(match input.ty {
                Type::Complex => format!("(vec2){{{}, {}}}", float(), float()),
                Type::Vector(n) => {
                    let parts: Vec<String> = (0..n).map(|_| float()).collect();
                    format!("(vec{n}){{{}}}", parts.join(", "))
                }
                _ => float(),
            });
        }
        let taken = signature.matches(',').count() + 1;
        if taken > arguments.len() {
            for value in point.params.iter().take(params) {
                #[allow(
                    clippy::cast_possible_truncation,
                    reason = "a number as the function takes it"
                )]
                let value = *value as f32;
                arguments.push(format!("{value:?}f"));
            }
        }
        while arguments.len() < taken {
            // the clock stands still, and tables know no pixel
            arguments.push("0.0f".to_owned());
        }
        let _ = writeln!(
            out,
            "    {{\n        {result} r = {name}({});\n        float v[sizeof r / 4];\n        \
             memcpy(v, &r, sizeof r);\n        for (unsigned k = 0; k < sizeof r / 4; k++) {{\n            \
             printf(\"%.9g \", v[k]);\n        }}\n        printf(\"\\n\");\n    }}",
            arguments.join(", ")
        );
    }
    out.push_str("    return 0;\n}\n");
    out
}

/// Compiles a file of C and gives what the program prints.
fn compiled(text: &str, folder: &Path) -> Result<String, String> {
    let (source, program) = (folder.join("function.c"), folder.join("function"));
    std::fs::write(&source, text).map_err(|e| e.to_string())?;
    let output = Command::new("cc")
        .args(["-std=c11", "-O1", "-ffp-contract=off", "-o"])
        .arg(&program)
        .arg(&source)
        .arg("-lm")
        .output()
        .map_err(|e| e.to_string())?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    let output = Command::new(&program).output().map_err(|e| e.to_string())?;
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Evaluates a formula of a program by emitted C.
fn run(
    source: &str,
    formula: &Formula,
    what: What,
    points: &[Point],
    folder: &Path,
    precision: Precision,
) -> Result<Vec<Vec<f64>>, String> {
    let program = compile(source).program.ok_or("no program")?;
    let part = match what {
        What::Gradient => EmitWhat::Gradient,
        What::Derivative => EmitWhat::Derivative,
        _ => EmitWhat::Value,
    };
    let emission = Emission::new(part, Target::C).precision(precision);
    let emitted = program
        .emit_all(&emission)
        .map_err(|problems| format!("{problems:?}"))?;
    let function = &emitted.functions[0];
    let text = String::from_utf8_lossy(&emitted.bytes).into_owned()
        + &main_program(
            formula,
            &function.name,
            &function.signature,
            points,
            program.params().len(),
        );
    let printed = compiled(&text, folder)?;
    let rows = printed.lines().map(|line| {
        let mut row: Vec<f64> = line
            .split_whitespace()
            // the nearest number of single precision is what was printed
            .map(|n| f64::from(n.parse::<f32>().unwrap_or(f32::NAN)))
            .collect();
        // the function has the value behind the derivatives, the tables before them
        if part == EmitWhat::Gradient && formula.ty == Type::Real && row.len() <= 4 {
            row.rotate_right(1);
        }
        row
    });
    Ok(rows.collect())
}

/// Runs every table of the gallery. Factors are of the least that single precision can do; `most` is the largest that may be.
fn judged(precision: Precision, most: f64, step: usize) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut found = Vec::new();
    let (mut judged, mut worst) = (0, 0.0_f64);
    for table in gallery().iter().step_by(step) {
        let factors = table.measure_by(Format::Single, &mut |formula, what, points| {
            run(
                &table.source,
                formula,
                what,
                points,
                folder.path(),
                precision,
            )
        });
        match factors {
            Err(reason) => found.push(format!("{}: {reason}", table.name)),
            Ok(factors) => {
                judged += factors.rows;
                println!(
                    "{}: K = {:.2}, {:.2}",
                    table.name, factors.value, factors.derivative
                );
                let largest = factors.value.max(factors.derivative);
                worst = worst.max(largest);
                if largest > most {
                    found.push(format!(
                        "{}: K = {largest:.2}, not {most}: {}",
                        table.name, factors.worst
                    ));
                }
                found.extend(factors.wrong.iter().map(|w| format!("{}: {w}", table.name)));
            }
        }
    }
    println!("{judged} rows, at most K = {worst:.2}");
    assert!(
        found.is_empty(),
        "{} violations\n{}",
        found.len(),
        found.join("\n")
    );
    assert!(judged > 1500 / step, "{judged} rows");
}

#[test]
fn emitted_c_is_as_good_as_its_roundings() {
    judged(Precision::Accurate, MOST, 1);
}

#[test]
fn emitted_c_of_pairs_is_better() {
    // what is left are the roundings of the results
    judged(Precision::Extended, 1.0, 3);
}
