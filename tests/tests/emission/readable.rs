//! Emitted texts, read back.

use naga::ShaderStage;
use naga::valid::Capabilities;
use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Program, Target};

use crate::validate;

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
            let whole = if text.starts_with("#version") {
                text.to_owned()
            } else {
                // functions for other programs: with an entry point around them
                format!("#version 450 core\n{text}\nvoid main() {{}}\n")
            };
            let options = naga::front::glsl::Options::from(ShaderStage::Fragment);
            let module = naga::front::glsl::Frontend::default()
                .parse(&options, &whole)
                .unwrap_or_else(|error| {
                    panic!("{name}: {}\n{whole}", error.emit_to_string(&whole))
                });
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

/// What is read back of every program; the suite of validators has all parts and hosts.
pub const PARTS: [EmitWhat; 4] = [
    EmitWhat::Value,
    EmitWhat::Gradient,
    EmitWhat::Derivative,
    EmitWhat::Scene,
];

/// Emits those of the parts that a program has, in every language; what it lacks is refused with a reason. Gives how many it has.
pub fn check_parts(
    name: &str,
    program: &Program,
    precision: Precision,
    parts: &[EmitWhat],
) -> usize {
    let mut made = 0;
    // told where a function has none by what is given to it
    let mut lacks_derivative = false;
    for &what in parts {
        let wgsl = program.emit(0, what, Target::Wgsl, precision);
        let is_there = wgsl.is_ok();
        made += usize::from(is_there);
        if let Ok(bytes) = &wgsl {
            check_readable(name, what, Target::Wgsl, bytes);
        }
        lacks_derivative |=
            wgsl.is_err_and(|problems| problems.iter().any(|p| p.code == "no-derivative"));
        let others = Target::LANGUAGES.into_iter();
        let mut targets: Vec<Target> = others.filter(|&t| t != Target::Wgsl).collect();
        if what != EmitWhat::Scene {
            targets.push(Target::C);
        }
        for target in targets {
            match program.emit(0, what, target, precision) {
                Ok(bytes) => check_readable(name, what, target, &bytes),
                // a mistake of ours is no reason to lack a part
                Err(problems) if !is_there => assert!(
                    problems.iter().all(|p| !p.code.starts_with("internal")),
                    "{name}: {problems:?}"
                ),
                Err(problems) => panic!("{name}: {what:?} in {}: {problems:?}", target.name()),
            }
        }
    }
    let has_scene = parts.contains(&EmitWhat::Scene);
    let least = 1 + usize::from(!lacks_derivative && has_scene);
    assert!(made >= least, "{name}: only {made} parts");
    made
}
