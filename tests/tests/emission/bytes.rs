//! What changes the bytes of a module, and what does not.

use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Target};
use pullback_tests::corpus::gallery;

use crate::{emit, program};

#[test]
fn parameters_settings_and_ranges_change_no_module() {
    let module = |text: &str| {
        let program = program(text, text);
        emit(
            text,
            &program,
            EmitWhat::Scene,
            Target::Wgsl,
            Precision::Accurate,
        )
    };
    let base = module("param k = 1 in 0..2\nf(x, y) = sin(k x) y\nshow levels(f)");
    let other = module(
        "param k = 1.5 in -3..7\nf(x, y) = sin(k x) y\nshow levels(f) { height = 3, palette = paper }",
    );
    assert!(
        base == other,
        "a parameter's value or a setting is in the module"
    );
    let third = module("param k = 1 in 0..2\nf(x, y) = sin(2 k x) y\nshow levels(f)");
    assert!(base != third);
}

#[test]
fn the_same_text_gives_the_same_bytes() {
    for source in gallery().iter().take(6) {
        for target in Target::LANGUAGES {
            let bytes = || {
                let program = program(&source.name, &source.text);
                emit(
                    &source.name,
                    &program,
                    EmitWhat::Scene,
                    target,
                    Precision::Accurate,
                )
            };
            assert!(bytes() == bytes(), "{} in {}", source.name, target.name());
        }
    }
}
