//! The wide tiers through the whole compiler: every formula of the gallery compiles in every tier, and deep in a zoom
//! each tier is true as far as it should be.

use std::sync::OnceLock;

use pullback_compiler::lower::{Exactness, Precision, Tier};
use pullback_compiler::{EmitWhat, Program, Target, What, compile};
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::{
    AdapterChoice, Capabilities, Frame, Gpu, GpuEvaluator, Pipeline, Renderer, Size, View,
    executor::Arithmetic,
};
use pullback_tests::corpus::gallery;
use pullback_tests::deep_zoom::{FIELDS, last_true_width};
use pullback_tests::stills::{Machine, Still};

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

/// The tiers of pairs that are exact on the software adapter, the one that is exact everywhere first.
fn exact_tiers() -> Vec<Tier> {
    let found = Capabilities::of(software()).expect("findings");
    let exact = Exactness::ALL
        .into_iter()
        .filter(|&form| found.is_exact(form));
    exact
        .map(|exactness| Tier {
            exactness,
            ..Precision::Extended.into()
        })
        .collect()
}

#[test]
fn extended_takes_the_fastest_exact_form() {
    let tier = Capabilities::tier(software(), Precision::Extended).expect("a tier");
    let exact = exact_tiers();
    assert_eq!(exact[0].exactness, Exactness::Dekker);
    assert!(exact.contains(&tier), "{tier:?}");
    assert!(tier.is_decorated() || exact.iter().all(|exact| !exact.is_decorated()));
}

/// Every form of the exact steps gives the same numbers, but for how roundings of low words fall.
#[test]
fn exact_forms_agree() {
    // a compiler that must not contract may still simplify what constants divide
    let text = "f(x, y) = exp(x/50) sin(y) + x^3 - y^2/(x - 7.3) + (1/cbrt(y^2 + 2))^2/3 + sqrt(2)/(x^2 + 1)";
    let program = compile(text).program.expect("it compiles");
    let rows: Vec<f64> = (0..2000)
        .map(|k| f64::from(k % 101) * 0.37 - 18.1 + f64::from(k) * 1e-9)
        .collect();
    let values: Vec<Vec<f64>> = exact_tiers()
        .into_iter()
        .map(|tier| evaluate(&program, tier, &rows))
        .collect();
    assert!(values.len() >= 2, "the software adapter takes decorations");
    // terms are up to 7000, and so are the roundings
    let allowed = 8.0 * 7000.0 * 2f64.powi(-48);
    for other in &values[1..] {
        for (a, b) in values[0].iter().zip(other) {
            assert!((a - b).abs() <= allowed, "{a} and {b}");
        }
    }
    // not what rounding to single precision would give
    assert!(values[0].iter().any(|&v| v != f64::from(v as f32)));
}

fn evaluate(program: &Program, tier: Tier, rows: &[f64]) -> Vec<f64> {
    let module = program.eval_module(0, What::Value, tier).expect("a module");
    let mut evaluator = GpuEvaluator::new(software(), &module).expect("an evaluator");
    let mut out = Vec::new();
    evaluator
        .eval_exactly(Surroundings::default(), rows.len() / 2, rows, &mut out)
        .expect("values");
    out
}

/// The shorter hash of `fast` has the digits of the other, also left of 0 and from one cell to the next.
#[test]
fn noise_is_the_same_in_fast() {
    let text = "f(x, y) = noise((x, y, x - y)) + noise((x y, 7 x)) + fbm((y, x, 2 x), 3)";
    let program = compile(text).program.expect("it compiles");
    let rows: Vec<f64> = (0..4000)
        .map(|k| f64::from(k % 211) * 0.1875 - 19.5 + f64::from(k % 7))
        .collect();
    let of = |precision: Precision| evaluate(&program, precision.into(), &rows);
    let (accurate, fast) = (of(Precision::Accurate), of(Precision::Fast));
    for (a, b) in accurate.iter().zip(&fast) {
        assert!((a - b).abs() <= 2e-5, "{a} and {b}");
    }
    let spread = accurate.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
    assert!(spread > 0.5, "{spread}");
}

/// What integrals keep of their roundings is for the tiers that have bounds.
#[test]
fn fast_takes_no_rests() {
    let text = "f(x, y, z) = sin(9 z - 2.5) + (x^2 + y^2 - 1)^2";
    let program = compile(text).program.expect("it compiles");
    let emitted = |precision: Precision| {
        let bytes = program.emit(0, EmitWhat::Integral, Target::Wgsl, precision);
        String::from_utf8(bytes.expect("an integral")).expect("text")
    };
    assert!(emitted(Precision::Accurate).contains("_rest("));
    assert!(!emitted(Precision::Fast).contains("_rest("));
}

/// Red, green, blue and alpha of all pixels, linear.
fn light(source: &str, precision: Precision, machine: &Machine) -> Vec<f32> {
    let size = Size {
        width: 32,
        height: 24,
    };
    let still = Still::in_precision(source, size, 1, precision);
    let rows = still.draw(machine, Pipeline::Linear).expect("a picture");
    let numbers = rows.as_chunks::<4>().0.iter();
    numbers.map(|bytes| f32::from_le_bytes(*bytes)).collect()
}

/// Scenes are in float32, but of doubles beyond its range they take a power of two apart: of large values, of tiny ones, and of
/// derivatives that are beyond it where the value is not.
#[test]
fn double_draws_what_single_precision_cannot_hold() {
    let gpu = Machine::Adapter(software().clone());
    let apart = |a: &[f32], b: &[f32]| {
        let all = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        all.fold(0.0, f32::max)
    };
    let domain = |f: &str, modulus: &str| {
        let look = "height = 6, fade_octaves = 200, phase_lines = 8";
        format!("f(z) = {f}\nshow domain(f) {{ modulus = {modulus}, {look} }}")
    };
    // the reference takes numbers below 2^-126 for zeros, and so gets all values times 2^100
    let tiny = ["z^60", "exp(25 z)", "conj(z)^2 exp(25 z)"].map(|f| {
        let truth = domain(&format!("2^100 ({f})"), "1267650600228229401496703205376");
        (domain(f, "1"), truth)
    });
    let large = [
        "f(z) = z^100 - z\nshow sphere(f) { pitch = -80, fade_octaves = 300 }",
        "f(z) = exp(20 (z + 4.2))\nshow grid(f) { height = 6, shape = polar, fade_octaves = 200 }",
    ];
    let large = large.map(|source| (source.to_owned(), source.to_owned()));
    for (source, truth) in tiny.into_iter().chain(large) {
        let reference = Machine::Processor(Arithmetic::Reference);
        let truth = light(&truth, Precision::Accurate, &reference);
        let double = apart(&truth, &light(&source, Precision::Double, &gpu));
        assert!(double < 1.0 / 255.0, "{source}: {double}");
        let single = apart(&truth, &light(&source, Precision::Accurate, &gpu));
        assert!(single > 10.0 / 255.0, "{source}: {single} in accurate");
    }
}

/// Decorated shaders go past wgpu, so both stages and all bindings are tried.
#[test]
fn pictures_are_the_same_in_every_exact_form_and_stage() {
    let program = compile("param a = 0.3\nf(z) = z^3 - 1 + a z")
        .program
        .expect("it compiles");
    let mut pictures = Vec::new();
    for tier in exact_tiers() {
        let scene = program.scene_module(0, tier).expect("a scene");
        let settings = scene.pack_settings(&program.pictures()[0].settings);
        let mut renderer = Renderer::new(software(), &scene).expect("a renderer");
        for pipeline in [Pipeline::Compute, Pipeline::Fragment] {
            let frame = Frame {
                view: View {
                    center: [0.1, -0.2],
                    height: 3.0,
                },
                params: &[0.7],
                settings: &settings,
                size: Size {
                    width: 61,
                    height: 47,
                },
                samples: 1,
                time: 0.0,
                pipeline,
            };
            let mut pixels = Vec::new();
            renderer.render(&frame, &mut pixels).expect("a picture");
            pictures.push(pixels);
        }
    }
    let first = &pictures[0];
    let colours: std::collections::BTreeSet<_> = first.as_chunks::<4>().0.iter().collect();
    assert!(
        colours.len() > 100,
        "a picture of {} colours",
        colours.len()
    );
    assert!(pictures.iter().all(|picture| picture == first));
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
