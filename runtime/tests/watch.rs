//! Pictures of numbers that scenes compute on the way, on the software adapter and on the processor, by closed forms.

use std::sync::atomic::AtomicBool;

use pullback_compiler::lower::Precision;
use pullback_compiler::{SceneModule, SettingValue, compile};
use pullback_runtime::executor::{Arithmetic, Window};
use pullback_runtime::trace::{GpuWatcher, Kept, Numbers, What, watch_on_cpu};
use pullback_runtime::{AdapterChoice, Frame, Gpu, Pipeline, Size, View};

const SIZE: Size = Size {
    width: 24,
    height: 16,
};

fn result(function: &'static str, name: &'static str, slot: usize, closes: bool) -> Kept {
    Kept {
        function,
        what: What::Result,
        name,
        slot,
        closes,
    }
}

/// A scene, its settings, and the height of its view.
fn scene(source: &str) -> (SceneModule, Vec<SettingValue>, f64) {
    let program = compile(source).program.unwrap();
    let picture = &program.pictures()[0];
    let height = picture.setting("height").map_or(2.0, |height| height.x);
    let settings = picture.settings.clone();
    (
        program.scene_module(0, Precision::Accurate).unwrap(),
        settings,
        height,
    )
}

/// The numbers of all pixels, in f64 on the processor and on the software adapter.
fn both(source: &str, kept: &[Kept]) -> [Numbers; 2] {
    let (scene, settings, height) = scene(source);
    let bytes = scene.pack_settings(&settings);
    let frame = Frame {
        view: View {
            center: [0.0, 0.0],
            height,
        },
        params: &[],
        settings: &bytes,
        size: SIZE,
        samples: 3,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let whole = Window {
        x: 0,
        y: 0,
        size: SIZE,
    };
    let never = AtomicBool::new(false);
    let arithmetic = Arithmetic::Reference;
    let here = watch_on_cpu(
        arithmetic,
        &scene,
        &frame,
        &settings,
        kept,
        &[whole],
        &never,
    );
    let gpu = Gpu::open(&AdapterChoice::Software).unwrap();
    let rows = GpuWatcher::new(&gpu, &scene, kept)
        .unwrap()
        .rows(&frame)
        .unwrap();
    let pixel = |bytes: &[u8; 16]| {
        [0, 4, 8, 12].map(|k| f64::from(f32::from_le_bytes(bytes[k..k + 4].try_into().unwrap())))
    };
    [
        here.unwrap().remove(0),
        rows.as_chunks().0.iter().map(pixel).collect(),
    ]
}

/// World coordinates of the middles of all pixels of a view around the origin.
fn middles(height: f64) -> Vec<[f64; 2]> {
    let pixel = height / f64::from(SIZE.height);
    let places = (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| [x, y]));
    let of = |[x, y]: [u32; 2]| {
        [
            (f64::from(x) + 0.5 - 0.5 * f64::from(SIZE.width)) * pixel,
            -(f64::from(y) + 0.5 - 0.5 * f64::from(SIZE.height)) * pixel,
        ]
    };
    places.map(of).collect()
}

#[test]
fn values_and_gradients_are_those_of_the_middles_of_pixels() {
    let kept = [result("field_grad", "", 0, true)];
    let source = "f(x, y) = x² - 3x y\nshow levels(f) { height = 4 }";
    for (numbers, error) in both(source, &kept).into_iter().zip([1e-12, 1e-5]) {
        for ([x, y], found) in middles(4.0).into_iter().zip(numbers) {
            let truth = [2.0 * x - 3.0 * y, -3.0 * x, x * x - 3.0 * x * y, 0.0];
            let near = |(a, b): (&f64, &f64)| (a - b).abs() <= error;
            assert!(
                truth.iter().zip(&found).all(near),
                "{x} {y}: {found:?} {truth:?}"
            );
        }
    }
}

#[test]
fn light_is_the_length_of_the_ray_in_a_box_of_density_one() {
    let kept = [result("radiance", "", 0, true)];
    // seen along x in parallel rays: two units long in the box, none beside it
    let source = "f(x, y, z) = 1\nshow additive(f) { box = (1, 1, 1), color = (1, 0.5, 0.25), pitch = 0, yaw = 0, \
                  projection = orthographic, extent = 4, tone = reinhard, exposure = 7 }";
    for numbers in both(source, &kept) {
        let lit = numbers.iter().filter(|n| n[0] > 0.0).count();
        // 8 by 8 pixels of 1/4
        assert_eq!(lit, 64, "{numbers:?}");
        for found in numbers.iter().filter(|n| n[0] > 0.0) {
            for (found, truth) in found.iter().zip([2.0, 1.0, 0.5]) {
                assert!((found - truth).abs() < 1e-5, "{found} {truth}");
            }
        }
    }
}

#[test]
fn depth_is_that_of_the_first_surface() {
    let kept = [
        result("march", ".t", 0, false),
        result("march", ".found", 1, true),
    ];
    let source = "f(x, y, z) = x² + y² + z² - 1\nshow surface(f) { box = (1.5, 1.5, 1.5), pitch = 0, yaw = 0, \
                  projection = orthographic, extent = 4 }";
    // the search for a root ends when it is as good as single precision
    for (numbers, error) in both(source, &kept).into_iter().zip([1e-7, 1e-5]) {
        let mut hits = 0;
        for ([x, y], found) in middles(4.0).into_iter().zip(numbers) {
            let under = 1.0 - x * x - y * y;
            if found[1] != 1.0 {
                assert!(under < 0.0, "{x} {y}");
                continue;
            }
            hits += 1;
            // from the face of the box
            let truth = 1.5 - under.sqrt();
            assert!(
                (found[0] - truth).abs() < error / under.sqrt(),
                "{x} {y}: {found:?} {truth}"
            );
        }
        assert!(hits > 40, "{hits}");
    }
}

#[test]
fn what_a_scene_does_not_have_is_refused() {
    let (scene, ..) = scene("f(x, y) = x\nshow levels(f)");
    let gpu = Gpu::open(&AdapterChoice::Software).unwrap();
    let refused = GpuWatcher::new(&gpu, &scene, &[result("march", ".t", 0, true)]);
    let message = refused.unwrap_err().to_string();
    assert!(message.contains("march"), "{message}");
}
