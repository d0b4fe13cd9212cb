//! Emitted texts, read back.

use naga::ShaderStage;
use naga::valid::Capabilities;
use pullback_compiler::ir::Ty;
use pullback_compiler::lower::Precision;
use pullback_compiler::types::Type;
use pullback_compiler::{EmitWhat, Program, Target};

use crate::{emit, validate};

/// Reads an emitted text back where there is a reader, and checks its shape where there is none.
pub fn check_readable(name: &str, what: EmitWhat, target: Target, bytes: &[u8]) {
    let name = format!("{name}: {what:?} in {}", target.name());
    if target == Target::Spirv {
        let bytes = &without_linkage(bytes);
        let module = naga::front::spv::parse_u8_slice(bytes, &naga::front::spv::Options::default())
            .unwrap_or_else(|error| panic!("{name}: {error:?}"));
        validate(&name, &module, Capabilities::all());
        return;
    }
    let text = std::str::from_utf8(bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(text.contains("// pullback "), "{name}: no header");
    match target {
        Target::Wgsl => {
            let module = naga::front::wgsl::parse_str(text)
                .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(text)));
            validate(&name, &module, Capabilities::default());
        }
        Target::Glsl => {
            assert!(text.starts_with("#version"), "{name}");
            let module = naga::front::glsl::Frontend::default()
                .parse(
                    &naga::front::glsl::Options::from(ShaderStage::Fragment),
                    text,
                )
                .unwrap_or_else(|error| panic!("{name}: {}\n{text}", error.emit_to_string(text)));
            validate(&name, &module, Capabilities::all());
        }
        _ => check_shape(&name, text),
    }
}

/// A function by itself is a library, whose capability `Linkage` (5) naga writes but does not read.
fn without_linkage(bytes: &[u8]) -> Vec<u8> {
    const HEADER: usize = 20;
    let linkage: Vec<u8> = [0x0002_0011_u32, 5]
        .iter()
        .flat_map(|w| w.to_le_bytes())
        .collect();
    let (head, rest) = bytes.split_at(HEADER);
    match rest.chunks_exact(4).position(|w| w == &linkage[..4]) {
        // capabilities come first
        Some(_) => {
            let mut rest = rest.to_vec();
            let mut at = 0;
            while rest[at..].starts_with(&linkage[..4]) {
                if rest[at..].starts_with(&linkage) {
                    rest.drain(at..at + 8);
                } else {
                    at += 8;
                }
            }
            [head, &rest].concat()
        }
        None => bytes.to_vec(),
    }
}

/// Brackets that match, and no number that only naga can write.
fn check_shape(name: &str, text: &str) {
    let code: String = text
        .lines()
        .filter(|l| !l.trim_start().starts_with("//"))
        .collect();
    let mut open = Vec::new();
    for c in code.chars() {
        match c {
            '(' | '{' => open.push(c),
            ')' => assert_eq!(open.pop(), Some('('), "{name}"),
            '}' => assert_eq!(open.pop(), Some('{'), "{name}"),
            _ => {}
        }
    }
    assert!(open.is_empty(), "{name}");
}

/// Which forms a program has besides value and scene.
fn forms(program: &Program) -> Vec<EmitWhat> {
    let formula = &program.pictures()[0].formula;
    let scalars = formula.scalars();
    let mut out = vec![EmitWhat::Value, EmitWhat::Scene];
    if !scalars.contains(&Ty::Complex) && formula.ty == Type::Real && !scalars.is_empty() {
        out.push(EmitWhat::Gradient);
    }
    if scalars.len() == 1 && (scalars[0] == Ty::Complex || formula.ty == Type::Real) {
        out.push(EmitWhat::Derivative);
    }
    out
}

/// Emits all that a program has, in every language.
pub fn check_all(name: &str, program: &Program, precision: Precision) {
    for what in forms(program) {
        for target in Target::ALL {
            check_readable(
                name,
                what,
                target,
                &emit(name, program, what, target, precision),
            );
        }
    }
}
