//! Laws that are known beforehand, found again in pictures of the executor.

use pullback_compiler::What;
use pullback_compiler::lower::Precision;
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::executor::{Arithmetic, Rows};
use pullback_runtime::{Pipeline, Size};
use pullback_tests::stills::{Machine, Still};

/// Linear red, green and blue of all pixels, in f64 on the processor.
fn light(source: &str) -> Vec<f32> {
    let size = Size {
        width: 24,
        height: 18,
    };
    let machine = Machine::Processor(Arithmetic::Reference);
    let rows = Still::new(source, size, 1)
        .draw(&machine, Pipeline::Linear)
        .unwrap();
    let pixels = rows.as_chunks::<16>().0.iter();
    let number = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().unwrap());
    let rgb = |pixel: &[u8; 16]| [0, 4, 8].map(|k| number(&pixel[k..k + 4]));
    pixels.flat_map(rgb).collect()
}

fn distance(a: &[f32], b: &[f32]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(a, b)| f64::from((a - b).abs())).sum();
    sum / a.len() as f64
}

/// A glowing cloud, by points in the middles of so many stretches.
fn cloud(density: &str, steps: u32) -> String {
    format!(
        "f(x, y, z) = {density}\n\
         show volume(f) {{ box = (3, 3, 3), steps = {steps}, steps_by = samples, jitter = 0, signs = positive, power = 1, \
         density = 0.2, color_scale = 1, tone = none, edge_width = 0, lighting = 0 }}"
    )
}

/// Mean errors with 8, 16, 32 and 64 stretches.
fn errors(density: &str) -> [f64; 4] {
    let truth = light(&cloud(density, 4096));
    [8, 16, 32, 64].map(|steps| distance(&light(&cloud(density, steps)), &truth))
}

#[test]
fn a_sum_at_midpoints_is_of_order_two() {
    // cut off by the box, so that the derivative along the ray is not the same at both ends
    let errors = errors("1.2 + sin(3x + y)");
    assert!(errors[0] > 1e-4, "{errors:?}");
    for pair in errors.windows(2).skip(1) {
        let gain = pair[0] / pair[1];
        assert!((3.4..4.8).contains(&gain), "{errors:?}");
    }
}

#[test]
fn a_sum_at_midpoints_of_what_fades_at_both_ends_is_better_than_any_order() {
    // the terms of the Euler-Maclaurin formula are differences of derivatives at the ends, which are the same here
    let errors = errors("exp(-3(x² + 2y² + z²)) (1.2 + sin(3x))");
    let gains = errors.windows(2).map(|pair| pair[0] / pair[1]);
    let gains: Vec<f64> = gains.collect();
    assert!(
        gains[0] > 5.0 && gains[1] > 100.0 && gains[2] > 100.0,
        "{errors:?}"
    );
}

/// How many abscissae of the columns a tier tells apart, evaluated as a scene's formula is.
fn distinct(still: &Still, precision: Precision) -> usize {
    let module = still
        .program
        .eval_module(0, What::Value, precision)
        .unwrap();
    let rows = Rows::new(&module, Arithmetic::Ieee32).unwrap();
    let pixel = still.view.height / f64::from(still.size.height);
    let middle = 0.5 * f64::from(still.size.width) - 0.5;
    let column = |k: u32| [still.view.center[0] + (f64::from(k) - middle) * pixel, 0.0];
    let places: Vec<f64> = (0..still.size.width).flat_map(column).collect();
    let surroundings = Surroundings {
        params: &[],
        time: 0.0,
        pixel,
    };
    let mut values = Vec::new();
    let count = still.size.width as usize;
    rows.eval(surroundings, count, &places, &mut values)
        .unwrap();
    values.dedup();
    values.len()
}

#[test]
fn positions_of_single_precision_limit_the_zoom_where_they_must() {
    // around 1 a picture of 1920 columns and a width of 1e-4 has 1,259 numbers of binary32 to choose from
    let width: f64 = 1e-4;
    let below = (0.5 * width / f64::from(f32::EPSILON / 2.0)).round();
    let above = (0.5 * width / f64::from(f32::EPSILON)).round();
    let text = "f(x, y) = x\nshow levels(f) { center = (1, 0), height = 5.625e-5 }";
    let still = Still::new(
        text,
        Size {
            width: 1920,
            height: 1080,
        },
        1,
    );
    let columns = |precision| distinct(&still, precision);
    let single = columns(Precision::Accurate) as f64;
    assert!((single - (below + above)).abs() <= 2.0, "{single}");
    // pairs and doubles tell all columns apart
    assert_eq!(columns(Precision::Extended), 1920);
    assert_eq!(columns(Precision::Double), 1920);
    let frame = |height: f64| pullback_runtime::Frame {
        view: pullback_runtime::View {
            center: [1.0, 0.0],
            height,
        },
        params: &[],
        settings: &[],
        size: still.size,
        samples: 1,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let format = still.scene.tier.precision.format();
    // two numbers a pixel are asked for: the greatest spacing in view is 2⁻²³
    let least = 2.0 * f64::from(f32::EPSILON) * 1080.0;
    assert!(!frame(0.9 * least).is_resolved(format));
    assert!(frame(1.1 * least).is_resolved(format));
}
