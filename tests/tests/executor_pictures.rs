//! Pictures of the executor beside those of the software adapter: the same shader, so the same picture.

use std::sync::atomic::AtomicBool;

use pullback_compiler::compile;
use pullback_compiler::lower::Precision;
use pullback_compiler::scene::Space;
use pullback_runtime::executor::{Arithmetic, Painter};
use pullback_runtime::{Frame, Pipeline, Renderer, Size, View, fill_in_scale};
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::corpus::gallery;

/// What a channel may be off by, of 255: half for rounding, half for the dither's threshold, and one for the adapter's
/// built-in functions in the curves of the colours, which have no declared error.
const MOST: u8 = 2;

/// One of each scene, with and without loops and complex numbers.
const NAMES: [&str; 5] = ["chladni", "cells", "mandelbrot", "rational", "cayley"];

const SIZE: Size = Size {
    width: 33,
    height: 20,
};

#[test]
fn the_same_shader_gives_the_same_picture() {
    let Some(gpu) = suite_gpu() else { return };
    for source in gallery()
        .iter()
        .filter(|s| NAMES.contains(&s.name.as_str()))
    {
        let program = compile(&source.text).program.expect("the gallery compiles");
        let picture = &program.pictures()[0];
        let params: Vec<f64> = program.params().iter().map(|p| p.default).collect();
        let center = picture.setting("center").unwrap_or_default();
        let height = picture.setting("height").map_or(2.0, |height| height.x);
        let view = match picture.scene.space {
            Space::Space => View {
                center: [0.0, 0.0],
                height: 2.0,
            },
            _ => View {
                center: [center.x, center.y],
                height,
            },
        };
        let mut settings = picture.settings.clone();
        fill_in_scale(&mut settings, picture, &view, SIZE, &params, 0.0);
        let Ok(scene) = program.scene_module(0, Precision::Accurate) else {
            panic!("{} has no scene", source.name);
        };
        let bytes = scene.pack_settings(&settings);
        let frame = Frame {
            view,
            params: &params,
            settings: &bytes,
            size: SIZE,
            samples: 1,
            time: 0.0,
            pipeline: Pipeline::Compute,
        };
        let mut on_device = Vec::new();
        let mut renderer = Renderer::new(&gpu, &scene).expect("a renderer");
        renderer.render(&frame, &mut on_device).expect("a picture");
        let mut found = Vec::new();
        let painter =
            Painter::new(&scene, Arithmetic::Ieee32, Pipeline::Compute).expect("a painter");
        let never = AtomicBool::new(false);
        painter
            .render(&frame, &settings, &never, &mut found)
            .expect("a picture");
        assert_eq!(found.len(), on_device.len());
        let off = found.iter().zip(&on_device).map(|(a, b)| a.abs_diff(*b));
        let most = off.clone().max().unwrap_or(0);
        let exact = off.filter(|&off| off == 0).count();
        println!(
            "{}: {exact} of {} bytes are the same",
            source.name,
            found.len()
        );
        assert!(most <= MOST, "{}: off by {most}", source.name);
        let distinct: std::collections::BTreeSet<_> = found.chunks(4).collect();
        assert!(
            distinct.len() >= 8,
            "{}: {} colours",
            source.name,
            distinct.len()
        );
    }
}
