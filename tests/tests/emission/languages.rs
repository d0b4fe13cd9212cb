//! Every formula in every shading language.

use std::io::Write as _;
use std::process::{Command, Stdio};

use pullback_compiler::lower::Precision;
use pullback_compiler::table;
use pullback_compiler::types::Type;
use pullback_compiler::{EmitWhat, Target};
use pullback_tests::corpus::gallery;

use crate::readable::{PARTS, check_parts};
use crate::{emit, program};

#[test]
fn the_gallery_in_every_language() {
    for source in gallery() {
        check_parts(
            &source.name,
            &program(&source.name, &source.text),
            Precision::Accurate,
            &PARTS,
        );
    }
}

#[test]
fn the_gallery_with_the_built_ins() {
    for source in gallery().iter().step_by(4) {
        check_parts(
            &source.name,
            &program(&source.name, &source.text),
            Precision::Fast,
            &PARTS,
        );
    }
}

/// A formula for every function of the operator table, on reals and on complex numbers, and for every operator.
fn functions() -> Vec<String> {
    let mut out: Vec<String> = [
        "x + y",
        "x - y",
        "x y",
        "x / y",
        "x^y",
        "x^3",
        "x^-2",
        "-x + y",
        "√x + y",
        "x! + y",
        "|x| + y",
        "if x < y then x else y",
        "if x <= y and not (x == 1) or y != 2 then x else y",
        "{ x < 0: -x, x < y: x^2 }",
        "if true then x else y",
        "x time + pixel y",
        "(x + i y)^(y + i x)",
        "re((x + i y)!)",
        "im(conj(x + i y)) + y",
        "abs((x + i y)^-3)",
        "if x + i y == 1 then x else y",
    ]
    .map(|body| format!("f(x, y) = {body}"))
    .into();
    for row in table::rows() {
        let Some(name) = row.names.first() else {
            continue;
        };
        if matches!(row.derivative, table::Derivative::Missing) {
            // of these only the value can be had, which the accuracy suites emit
            continue;
        }
        let arguments = |names: [&str; 4]| names[..row.typing.arity().min(4)].join(", ");
        if row.real.is_some() || row.is_defined(false) {
            out.push(format!(
                "f(x, y) = {name}({}) + y",
                arguments(["x", "y", "x + y", "x y"])
            ));
        }
        if row.complex.is_some() || row.is_defined(true) {
            out.push(format!(
                "f(z) = {name}({})",
                arguments(["z", "z^2", "z + 1", "z/2"])
            ));
        }
    }
    for function in pullback_compiler::check::library_functions() {
        let argument = |(k, ty): (usize, &Option<Type>)| match ty {
            Some(Type::Vector(n)) => format!(
                "vec{n}({}{})",
                ["x", "y", "x + y"][k % 3],
                ", y, 1, x".get(..3 * (usize::from(*n) - 1)).unwrap_or("")
            ),
            Some(Type::Complex) => format!("({} + i y)", ["x", "y"][k % 2]),
            _ => format!("({} + {k})", ["x", "y", "x + y"][k % 3]),
        };
        let arguments: Vec<String> = function.types.iter().enumerate().map(argument).collect();
        let call = format!("{}({})", function.name, arguments.join(", "));
        out.push(format!("f(x, y) = length({call}) + y"));
    }
    out.extend(
        [
            "length(p)",
            "distance(p, (1, 2, 3))",
            "dot(p, p.zyx)",
            "cross(p, (1, 2, 3)).y",
            "normalize(p).z",
            "rotate(p.xy, p.z).x",
            "|vec4(p, 1)|",
            "length(vec2(p.x) + p.zz)",
            "length(sin(p) p^2 / (1, 2, 3))",
        ]
        .map(|body| format!("f(p: vec3) = {body}")),
    );
    out
}

#[test]
fn every_function_in_every_language() {
    let all = functions();
    assert!(all.len() > 100, "{} formulas", all.len());
    for (k, text) in all.iter().enumerate() {
        // a scene holds the same functions, beside the template that the gallery has been through
        let count = if k % 8 == 0 {
            PARTS.len()
        } else {
            PARTS.len() - 1
        };
        check_parts(
            text,
            &program(text, text),
            Precision::Accurate,
            &PARTS[..count],
        );
    }
}

/// `spirv-val` on a module; an error message, or nothing where all is well.
fn spirv_val(bytes: &[u8]) -> std::io::Result<String> {
    let mut child = Command::new("spirv-val")
        .args(["--target-env", "vulkan1.1", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    child
        .stdin
        .take()
        .map_or(Ok(()), |mut input| input.write_all(bytes))?;
    let output = child.wait_with_output()?;
    let text = String::from_utf8_lossy(&output.stderr).into_owned()
        + &String::from_utf8_lossy(&output.stdout);
    Ok(if output.status.success() {
        String::new()
    } else {
        text + "failed"
    })
}

#[test]
#[allow(clippy::print_stderr, reason = "a test that is skipped says so")]
fn spirv_satisfies_khronos_validator() {
    if Command::new("spirv-val").arg("--version").output().is_err() {
        eprintln!("skipped: spirv-val is not installed (Debian: spirv-tools)");
        return;
    }
    for source in gallery() {
        let program = program(&source.name, &source.text);
        // a function by itself has no entry point, which only kernels and libraries may; so whole scenes
        let bytes = emit(
            &source.name,
            &program,
            EmitWhat::Scene,
            Target::Spirv,
            Precision::Accurate,
        );
        let problem = spirv_val(&bytes).expect("spirv-val runs");
        assert!(problem.is_empty(), "{}: {problem}", source.name);
    }
}
