//! Scenes that are made for their settings draw what scenes draw that read them.

use std::sync::atomic::AtomicBool;

use naga::Module;
use proptest::prelude::*;
use pullback_compiler::SceneModule;
use pullback_compiler::lower::Precision;
use pullback_compiler::scene::{SettingKind, SettingSpec};
use pullback_runtime::executor::{Arithmetic, Painter};
use pullback_runtime::{Error, Frame, Pipeline, Renderer, Size};
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::corpus::gallery;
use pullback_tests::stills::Still;

const SIZE: Size = Size {
    width: 7,
    height: 5,
};

/// Pictures whose clouds take an executor in a debug build minutes.
const SLOW: [&str; 1] = ["cloud"];

/// The pixels, not rounded to bytes, in IEEE arithmetic, where nothing is fused or reordered.
fn drawn(still: &Still, scene: &SceneModule) -> Vec<u8> {
    let bytes = scene.pack_settings(&still.settings);
    let frame = Frame {
        view: still.view,
        params: &still.params,
        settings: &bytes,
        size: still.size,
        samples: 1,
        time: 0.0,
        pipeline: Pipeline::Linear,
    };
    let painter = Painter::new(scene, Arithmetic::Ieee32, Pipeline::Linear).expect("a painter");
    let never = AtomicBool::new(false);
    let mut pixels = Vec::new();
    painter
        .render(&frame, &still.settings, &never, &mut pixels)
        .expect("a picture");
    pixels
}

#[test]
fn every_picture_is_the_same_to_the_last_bit() {
    for source in gallery() {
        if SLOW.contains(&source.name.as_str()) {
            continue;
        }
        let still = Still::new(&source.text, SIZE, 1);
        let [general, made] = [true, false].map(|general| still.shader(general));
        assert!(
            drawn(&still, &general) == drawn(&still, &made),
            "{}: another picture",
            source.name
        );
    }
}

/// Expressions of all functions.
fn size(module: &Module) -> usize {
    let functions = module.functions.iter().map(|(_, f)| f);
    let entries = module.entry_points.iter().map(|e| &e.function);
    functions.chain(entries).map(|f| f.expressions.len()).sum()
}

#[test]
fn what_settings_rule_out_is_left_out() {
    for source in gallery() {
        let still = Still::new(&source.text, SIZE, 1);
        let [general, made] = [true, false].map(|general| still.shader(general).module);
        let [before, after] = [&general, &made].map(size);
        println!("{}: {before} expressions, {after}", source.name);
        assert!(after < before, "{}: {before}, {after}", source.name);
        let reads = |module: &Module| {
            let mut globals = module.global_variables.iter();
            globals.any(|(_, g)| g.name.as_deref() == Some("settings"))
        };
        let has_table = still.settings.iter().any(|s| s.spec.name == "palette");
        assert!(has_table || !reads(&made), "{} reads settings", source.name);
    }
}

/// What draws a key is there if one is drawn.
#[test]
fn a_key_is_there_if_it_is_drawn() {
    let has_key = |key: &str| {
        let text = format!("f(z) = z^2\nshow domain(f) {{ key = {key} }}\n");
        let module = Still::new(&text, SIZE, 1).shader(false).module;
        let mut functions = module.functions.iter();
        functions.any(|(_, f)| f.name.as_deref() == Some("key_jet"))
    };
    assert!(!has_key("0"));
    assert!(has_key("0.2"));
}

#[test]
fn a_shader_for_some_settings_refuses_others() {
    let Some(gpu) = suite_gpu() else { return };
    let still = Still::new("f(x, y) = x y\nshow levels(f)\n", SIZE, 1);
    let mut renderer = Renderer::for_settings(&gpu, &still.scene, &still.settings, 1).expect("one");
    let mut draw = |settings: &[u8]| {
        let frame = Frame {
            view: still.view,
            params: &[],
            settings,
            size: SIZE,
            samples: 1,
            time: 0.0,
            pipeline: Pipeline::Compute,
        };
        renderer.render(&frame, &mut Vec::new())
    };
    let mut bytes = still.scene.pack_settings(&still.settings);
    draw(&bytes).expect("a picture");
    bytes[0] ^= 1;
    let refused = draw(&bytes);
    assert!(matches!(refused, Err(Error::Invalid { .. })), "{refused:?}");
}

/// A value in the range of a setting, from three numbers in 0..1.
fn any_value(spec: &SettingSpec, at: [f64; 3]) -> [f64; 3] {
    let (low, high) = match spec.kind {
        #[allow(clippy::cast_precision_loss, reason = "a short list")]
        SettingKind::Choice(words) => (0.0, words.len() as f64 - 1.0),
        _ => (spec.range.0.max(-1e3), spec.range.1.min(1e3)),
    };
    let whole = matches!(spec.kind, SettingKind::Choice(_) | SettingKind::Integer);
    at.map(|u| low + u * (high - low))
        .map(|value| if whole { value.round() } else { value })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Whatever the settings are, the module is valid; some of them at the ends of their ranges.
    #[test]
    fn every_setting_gives_a_valid_module(
        seeds in prop::collection::vec(prop::array::uniform3(prop_oneof![Just(0.0), Just(1.0), 0.0..1.0]), 64)
    ) {
        for source in gallery().iter().step_by(5) {
            let still = Still::in_precision(&source.text, SIZE, 1, Precision::Fast);
            let mut settings = still.settings.clone();
            for (setting, &at) in settings.iter_mut().zip(&seeds) {
                let [x, y, z] = any_value(setting.spec, at);
                (setting.value.x, setting.value.y, setting.value.z) = (x, y, z);
            }
            let made = still.scene.specialised(&settings, 2);
            prop_assert!(made.is_ok(), "{}: {:?}", source.name, made.err());
        }
    }
}
