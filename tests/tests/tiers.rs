//! The wide tiers through the whole compiler: every formula of the gallery compiles in every tier, and deep in a zoom
//! each tier is true as far as it should be.

use std::sync::OnceLock;

use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Target, compile};
use pullback_runtime::{AdapterChoice, Gpu};
use pullback_tests::corpus::gallery;
use pullback_tests::deep_zoom::{FIELDS, last_true_width};

fn software() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| Gpu::open(&AdapterChoice::Software).expect("the software adapter"))
}

#[test]
fn every_scene_of_the_gallery_compiles_in_every_tier() {
    for source in gallery() {
        let program = compile(&source.text).program.expect("the gallery compiles");
        for precision in Precision::ALL {
            if let Err(problems) = program.scene_module(0, precision) {
                panic!("{} in {}: {problems:?}", source.name, precision.name());
            }
        }
    }
}

#[test]
fn functions_are_emitted_in_every_tier() {
    let program = compile("f(x, y) = sin(x) atan2(y, x) + x^3")
        .program
        .expect("it compiles");
    let emit = |target, precision| program.emit(0, EmitWhat::Gradient, target, precision);
    for target in [
        Target::Wgsl,
        Target::Spirv,
        Target::Glsl,
        Target::Hlsl,
        Target::Msl,
    ] {
        assert!(emit(target, Precision::Extended).is_ok(), "{target:?}");
    }
    assert!(emit(Target::Wgsl, Precision::Double).is_ok());
    assert!(emit(Target::Spirv, Precision::Double).is_ok());
    let problems = emit(Target::Msl, Precision::Double).expect_err("no doubles in MSL");
    assert_eq!(problems[0].code, "wrong-demand");
}

/// A formula keeps the centre of its view in all digits of the tier: the widths down to which the pictures of
/// `tests/oracle/deep_zoom.py` cannot be told from the true ones. Single precision has 24 bits, a pair 48, a double 53.
#[test]
fn deep_zooms_are_true_as_far_as_the_digits_go() {
    let wanted = [
        (Precision::Accurate, 1e-3),
        (Precision::Extended, 1e-10),
        (Precision::Double, 1e-11),
    ];
    for field in &FIELDS {
        for (precision, width) in wanted {
            let found = last_true_width(software(), field, precision);
            assert!(
                found.is_some_and(|found| found <= width * 1.001),
                "{} in {}: true down to {found:?}",
                field.name,
                precision.name()
            );
        }
    }
}
