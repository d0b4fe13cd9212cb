use std::sync::atomic::AtomicBool;

use super::*;
use crate::AdapterChoice;
use crate::executor::{Arithmetic, Painter};
use pullback_compiler::lower::Precision;

const SIZE: Size = Size {
    width: 213,
    height: 117,
};

/// The scene of a formula, and the bytes of its settings.
fn scene(formula: &str) -> (SceneModule, Vec<u8>) {
    let program = pullback_compiler::compile(formula).program.unwrap();
    match program.scene_module(0, Precision::Accurate) {
        Ok(scene) => {
            let settings = scene.pack_settings(&program.pictures()[0].settings);
            (scene, settings)
        }
        Err(diagnostics) => panic!("{diagnostics:?}"),
    }
}

fn frame(settings: &[u8], pipeline: Pipeline) -> Frame<'_> {
    Frame {
        view: View {
            center: [0.0, 0.0],
            height: 8.0,
        },
        params: &[],
        settings,
        size: SIZE,
        samples: 2,
        time: 0.0,
        pipeline,
    }
}

/// A software adapter, if there is one: the same results everywhere.
fn software() -> Option<Gpu> {
    Gpu::open(&AdapterChoice::Software).ok()
}

#[test]
fn both_pipelines_and_any_tiles_give_one_picture() {
    let Some(gpu) = software() else { return };
    let (scene, settings) = scene("x^2 + y^2");
    let mut renderer = Renderer::new(&gpu, &scene).unwrap();
    let mut pictures = Vec::new();
    for pipeline in [Pipeline::Compute, Pipeline::Fragment] {
        for (max_pixels, max_side) in [(u64::MAX, 8192), (1000, 8192), (u64::MAX, 64), (1, 8)] {
            let budget = Budget::new(2, max_pixels, max_side);
            let mut rows = Vec::new();
            renderer
                .render_within(&frame(&settings, pipeline), budget, &mut rows)
                .unwrap();
            assert_eq!(rows.len(), 213 * 117 * 4);
            pictures.push(rows);
        }
    }
    for picture in &pictures[1..] {
        assert!(*picture == pictures[0]);
    }
    let distinct: std::collections::HashSet<_> = pictures[0].as_chunks::<4>().0.iter().collect();
    assert!(distinct.len() > 20, "{} colours", distinct.len());
}

/// However the samples of a pixel are spread over submissions.
#[test]
fn samples_add_up_to_one_picture() {
    let Some(gpu) = software() else { return };
    let formula = "sin(3 x) cos(2 y) + z/2\nshow volume(f) { steps = 20 }";
    let (scene, settings) = scene(&format!("f(x, y, z) = {formula}"));
    let mut renderer = Renderer::new(&gpu, &scene).unwrap();
    renderer.turns = None;
    let mut draw = |pipeline, samples, budget| {
        let frame = Frame {
            samples,
            size: Size {
                width: 60,
                height: 50,
            },
            ..frame(&settings, pipeline)
        };
        let mut rows = Vec::new();
        renderer.render_within(&frame, budget, &mut rows).unwrap();
        rows
    };
    for samples in [2, 3, 5] {
        let whole = Budget::new(samples, u64::MAX, 8192);
        let expected = draw(Pipeline::Compute, samples, whole);
        let linear = draw(Pipeline::Linear, samples, whole);
        let distinct: std::collections::HashSet<_> = expected.as_chunks::<4>().0.iter().collect();
        assert!(distinct.len() > 20, "{} colours", distinct.len());
        for most in [1, 2, 7] {
            let budget = whole.with_most(most);
            let found = draw(Pipeline::Compute, samples, budget);
            for (found, expected) in found.iter().zip(&expected) {
                // the dither may tell sums apart that differ by a rounding
                assert!(found.abs_diff(*expected) <= 1, "{found} {expected}");
            }
            let same = found.iter().zip(&expected).filter(|(a, b)| a == b).count();
            assert!(
                same * 1000 >= found.len() * 999,
                "{same} of {}",
                found.len()
            );
            let found = draw(Pipeline::Linear, samples, budget);
            let values = |bytes: &[u8]| -> Vec<f32> {
                let words = bytes.as_chunks::<4>().0.iter();
                words.map(|word| f32::from_le_bytes(*word)).collect()
            };
            for (found, expected) in values(&found).into_iter().zip(values(&linear)) {
                assert!((found - expected).abs() <= 2e-6, "{found} {expected}");
            }
        }
    }
}

/// A formula that makes so many turns, and whose value tells whether it has made them.
fn looping(turns: u32) -> String {
    let sum = format!("sum(k in 1..{turns}, 1 + 1e-30 x k)/{turns}");
    format!("f(x, y) = {sum}\nshow levels(f) {{ color_scale = 1 }}")
}

#[test]
fn loops_that_the_adapter_would_end_are_spread_or_refused() {
    let Some(gpu) = software() else { return };
    let Some(limit) = turns::limit(&gpu).unwrap() else {
        return;
    };
    let draw = |turns: u32, samples: u32, pipeline| {
        let (scene, settings) = scene(&looping(turns));
        let frame = Frame {
            samples,
            size: Size {
                width: 16,
                height: 8,
            },
            ..frame(&settings, pipeline)
        };
        let mut rows = Vec::new();
        Renderer::new(&gpu, &scene)?.render(&frame, &mut rows)?;
        Ok::<_, Error>(rows)
    };
    for pipeline in [Pipeline::Compute, Pipeline::Fragment, Pipeline::Linear] {
        // all samples together make more turns than the adapter allows, one does not
        let right = draw(limit / 100, 1, pipeline).unwrap();
        let spread = draw(limit / 3, 3, pipeline).unwrap();
        let value = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        if pipeline == Pipeline::Linear {
            assert!((value(&right) - value(&spread)).abs() < 1e-3);
        } else {
            let off = right.iter().zip(&spread).map(|(a, b)| a.abs_diff(*b));
            assert!(off.max() <= Some(1));
        }
        let refused = draw(limit + 10, 1, pipeline);
        assert!(matches!(refused, Err(Error::Turns { .. })), "{refused:?}");
    }
}

#[test]
fn linear_light_is_what_the_picture_is_made_of() {
    let Some(gpu) = software() else { return };
    let (scene, settings) = scene("x^2 - y^2");
    let mut renderer = Renderer::new(&gpu, &scene).unwrap();
    let (mut encoded, mut linear) = (Vec::new(), Vec::new());
    let render = &mut |pipeline, rows: &mut Vec<u8>| {
        renderer.render(&frame(&settings, pipeline), rows).unwrap();
    };
    render(Pipeline::Compute, &mut encoded);
    render(Pipeline::Linear, &mut linear);
    assert_eq!(linear.len(), 4 * encoded.len());
    for (byte, word) in encoded.iter().zip(linear.as_chunks::<4>().0) {
        // its inverse (IEC 61966-2-1): the byte may be half a step off, and the dither as much
        let light = |byte: f32| match (byte / 255.0).clamp(0.0, 1.0) {
            low if low <= 0.04045 => low / 12.92,
            high => ((high + 0.055) / 1.055).powf(2.4),
        };
        let (value, byte) = (f32::from_le_bytes(*word).clamp(0.0, 1.0), f32::from(*byte));
        let (low, high) = (light(byte - 1.01), light(byte + 1.01));
        assert!((low..=high).contains(&value), "{value} {byte}");
    }
}

#[test]
fn the_processor_gives_the_same_linear_light() {
    let Some(gpu) = software() else { return };
    let (scene, settings) = scene("x^2 - y^2");
    let program = pullback_compiler::compile("x^2 - y^2").program.unwrap();
    let frame = frame(&settings, Pipeline::Linear);
    let (mut found, mut expected) = (Vec::new(), Vec::new());
    let mut renderer = Renderer::new(&gpu, &scene).unwrap();
    renderer.render(&frame, &mut found).unwrap();
    Painter::new(&scene, Arithmetic::Reference, Pipeline::Linear)
        .unwrap()
        .render(
            &frame,
            &program.pictures()[0].settings,
            &AtomicBool::new(false),
            &mut expected,
        )
        .unwrap();
    let words = |bytes: &[u8]| -> Vec<f32> {
        let words = bytes.as_chunks::<4>().0;
        words.iter().map(|word| f32::from_le_bytes(*word)).collect()
    };
    for (found, expected) in words(&found).into_iter().zip(words(&expected)) {
        assert!((found - expected).abs() < 1e-4, "{found} {expected}");
    }
    assert_eq!(found.len(), expected.len());
}

#[test]
fn a_frame_outside_of_the_limits_is_refused() {
    let Some(gpu) = software() else { return };
    let (scene, settings) = scene("x + y");
    let mut renderer = Renderer::new(&gpu, &scene).unwrap();
    let good = frame(&settings, Pipeline::Compute);
    let many = [0.0; 65];
    let size = |width, height| Size { width, height };
    let bad = [
        Frame {
            size: size(0, 5),
            ..good.clone()
        },
        Frame {
            size: size(5, MAX_SIDE + 1),
            ..good.clone()
        },
        Frame {
            samples: 0,
            ..good.clone()
        },
        Frame {
            samples: MAX_SAMPLES + 1,
            ..good.clone()
        },
        Frame {
            params: &many,
            ..good.clone()
        },
        Frame {
            settings: &[0; 4096],
            ..good.clone()
        },
        Frame {
            settings: &[0; 3],
            ..good.clone()
        },
        Frame {
            view: View {
                center: [0.0; 2],
                height: 0.0,
            },
            ..good.clone()
        },
        Frame {
            view: View {
                center: [0.0; 2],
                height: f64::NAN,
            },
            ..good.clone()
        },
        Frame {
            view: View {
                center: [1e300, 0.0],
                height: 1.0,
            },
            ..good.clone()
        },
    ];
    for frame in bad {
        let refused = renderer.render(&frame, &mut Vec::new());
        assert!(matches!(refused, Err(Error::Invalid { .. })), "{refused:?}");
    }
    assert!(renderer.render(&good, &mut Vec::new()).is_ok());
}

#[test]
fn a_failing_sink_ends_the_picture() {
    struct Full;
    impl RowSink for Full {
        fn rows(&mut self, _: &[u8]) -> io::Result<()> {
            Err(io::ErrorKind::StorageFull.into())
        }
    }
    let Some(gpu) = software() else { return };
    let (scene, settings) = scene("x + y");
    let mut renderer = Renderer::new(&gpu, &scene).unwrap();
    let failed = renderer.render(&frame(&settings, Pipeline::Compute), &mut Full);
    assert!(matches!(failed, Err(Error::Io(_))), "{failed:?}");
}
