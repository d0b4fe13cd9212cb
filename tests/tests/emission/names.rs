//! The user's names in what is emitted.

use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Target, compile};

use crate::readable::{PARTS, check_parts, check_readable};
use crate::{emit, program};

#[test]
fn names_of_the_user_survive() {
    let wgsl = |text: &str| {
        let program = program(text, text);
        let bytes = emit(
            text,
            &program,
            EmitWhat::Value,
            Target::Wgsl,
            Precision::Accurate,
        );
        check_readable(text, EmitWhat::Value, Target::Wgsl, &bytes);
        String::from_utf8(bytes).expect("text")
    };
    let check = |text: &str, words: &[&str]| {
        let out = wgsl(text);
        for word in words {
            let is_word = |c: char| !(c.is_alphanumeric() || c == '_');
            let found = out.split(is_word).any(|w| w.trim_end_matches('_') == *word);
            assert!(found, "no `{word}` in\n{out}");
        }
    };
    check(
        "param speed = 2 in 0..4\nwave(x, y) = a sin(b) b where a = 1 - x² speed, b = x y + 2\nshow levels(wave)",
        &["wave", "x", "y", "speed", "a", "b"],
    );
    check(
        "f(x, y) = (α + θ₁)^2 where α = x + 2y, θ₁ = x - 3y",
        &["alpha", "theta1"],
    );
    // words that mean something in a shading language
    check(
        "f(x, y) = (float + texture) fn where float = 2 x + y, texture = x/y, fn = x y + 1",
        &["float", "texture", "fn"],
    );
    check(
        "f(u, v) = select vec where select = u sin(v), vec = v²",
        &["u", "v", "select", "vec"],
    );
    check("main(x, y) = sin(x) y", &["main"]);
    check("vec2f(x, y) = sin(x) y", &["x", "y"]);
}

#[test]
fn names_of_the_user_break_no_language() {
    let words = [
        "main",
        "float",
        "vec3f",
        "array",
        "struct",
        "fn",
        "let",
        "var",
        "loop",
        "return",
        "half",
        "texture",
        "sampler",
        "kernel",
        "device",
        "constant",
        "metal",
        "int",
        "float4",
        "uniform",
        "in",
        "out",
        "view",
        "params",
        "settings",
        "shade",
        "field",
        "image",
        "discard",
        "gl_FragCoord",
        "_",
        "__x",
        "real_sin",
        "self",
        "matrix",
        "precision",
        "lowp",
        "register",
        "cbuffer",
        "nullptr",
        "template",
        "class",
        "Jet",
    ];
    for word in words.iter().filter(|w| !["in"].contains(w)) {
        for text in [
            format!("{word}(x, y) = sin(x) y"),
            format!("f(x, y) = {word} y + {word}² where {word} = sin(x)"),
            format!("param {word} = 1\nf(x, y) = sin({word} x) y"),
            format!("f({word}, b) = sin({word}) b"),
        ] {
            if compile(&text).program.is_some() {
                check_parts(&text, &program(&text, &text), Precision::Accurate, &PARTS);
            } else {
                // `_` alone and words of the language may be refused, but not silently
                assert!(!compile(&text).diagnostics.is_empty(), "{text}");
            }
        }
    }
}
