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

/// Values of a formula of one picture at rows of numbers, in f64 by the reference.
fn values(source: &str, rows: impl Iterator<Item = Vec<f64>>) -> Vec<f64> {
    let program = pullback_compiler::compile(source).program.unwrap();
    let mut evaluator = program.evaluator(0, What::Value).unwrap();
    let mut out = [0.0];
    let value = |row: Vec<f64>| {
        evaluator.eval(&[], 0.0, 1.0, &row, &mut out);
        out[0]
    };
    rows.map(value).collect()
}

/// Fractional parts of the multiples of a number: evenly spread over [0, 1).
fn spread(count: u32, by: f64) -> impl Iterator<Item = f64> {
    (1..=count).map(move |k| (f64::from(k) * by).fract())
}

#[test]
fn marching_by_signs_misses_a_twelfth_of_the_squared_step_of_a_silhouette() {
    // of a unit sphere's disc: where the chord 2u, u² = 1 - b², is shorter than the step h, a march that begins anywhere
    // steps over it with probability 1 - 2u/h; over the disc that is h²/4 - h²/6
    const RAYS: u32 = 40_000;
    for h in [0.5, 0.25] {
        // how many samples of a ray with square b² of the distance from the middle are inside; the phase is y
        let count = (3.0 / h) as u32;
        let source = format!(
            "f(x, y) = sum(k in 0..{count}, if x + (-1.5 + {h} (k + y))^2 < 1 then 1 else 0)\nshow levels(f)"
        );
        let golden = 0.618_033_988_749_895;
        let plastic = 0.754_877_666_246_693;
        let rays = spread(RAYS, golden).zip(spread(RAYS, plastic));
        let found = values(&source, rays.map(|(square, phase)| vec![square, phase]));
        let missed = found.iter().filter(|inside| **inside == 0.0).count();
        let share = missed as f64 / f64::from(RAYS);
        let law = h * h / 12.0;
        // a count of chance events would spread by this, and these are evener
        let deviation = (law / f64::from(RAYS)).sqrt();
        assert!((share - law).abs() < 3.0 * deviation, "{h}: {share} {law}");
    }
}

#[test]
fn our_march_misses_less_of_the_silhouette_than_signs_do() {
    use pullback_runtime::executor::Window;
    use pullback_runtime::trace::{Kept, What as Told, watch_on_cpu};
    let size = Size {
        width: 160,
        height: 160,
    };
    let still = Still::new(
        "f(x, y, z) = x² + y² + z² - 1\nshow surface(f) { box = (1.5, 1.5, 1.5), steps = 13, pitch = 0, yaw = 0, \
         projection = orthographic, extent = 2.2, backdrop = plain }",
        size,
        1,
    );
    let bytes = still.scene.pack_settings(&still.settings);
    let frame = pullback_runtime::Frame {
        view: still.view,
        params: &[],
        settings: &bytes,
        size,
        samples: 1,
        time: 0.0,
        pipeline: Pipeline::Linear,
    };
    let kept = [Kept {
        function: "march",
        what: Told::Result,
        name: ".found",
        slot: 0,
        closes: true,
    }];
    let whole = Window { x: 0, y: 0, size };
    let never = std::sync::atomic::AtomicBool::new(false);
    let reference = Arithmetic::Reference;
    let found = watch_on_cpu(
        reference,
        &still.scene,
        &frame,
        &still.settings,
        &kept,
        &[whole],
        &never,
    );
    let found = &found.unwrap()[0];
    let places = (0..160).flat_map(|y| (0..160).map(move |x| [x, y]));
    let at = |k: i32| (f64::from(k) + 0.5 - 80.0) * 2.2 / 160.0;
    let disc: Vec<bool> = places.map(|[x, y]| at(x).hypot(at(y)) < 1.0).collect();
    let all = disc.iter().filter(|&&inside| inside).count();
    let missed = disc
        .iter()
        .zip(found)
        .filter(|(inside, found)| **inside && found[0] == 0.0);
    let share = missed.count() as f64 / all as f64;
    // steps of the diagonal of the box, 3√3
    let h = 3.0 * 3f64.sqrt() / 13.0;
    let law = h * h / 12.0;
    assert!(law > 0.01 && share < 0.1 * law, "{share} {law}");
}

/// Error of a rule for ∫₀¹ exp t dt with stretches of length h, which the language sums; `term` is of the stretch k.
fn rule(term: &str, count: u32) -> f64 {
    let text = format!(
        "h = 1/{count}\nf(x, y) = h sum(k in 0..{}, {term}) + 0 x y\nshow levels(f)",
        count - 1
    );
    values(&text, std::iter::once(vec![0.0, 0.0]))[0] - (1f64.exp() - 1.0)
}

#[test]
fn rules_of_sums_have_their_orders_and_constants() {
    // the first term of the Euler-Maclaurin formula of each: -h²/24, h²/12 and -h⁴/4320 times the difference of the first, and
    // of the third, derivatives at both ends (P. Davis, P. Rabinowitz, "Methods of Numerical Integration", 1984, 2.9)
    let ends = 1f64.exp() - 1.0;
    for (term, order, constant) in [
        ("exp((k + 0.5) h)", 2, -1.0 / 24.0),
        ("0.5 (exp(k h) + exp((k + 1) h))", 2, 1.0 / 12.0),
        (
            "0.5 (exp((k + 0.5 - 0.5/√3) h) + exp((k + 0.5 + 0.5/√3) h))",
            4,
            -1.0 / 4320.0,
        ),
    ] {
        for count in [8, 16] {
            let h = 1.0 / f64::from(count);
            let law = constant * ends * h.powi(order);
            let found = rule(term, count);
            // the next term is smaller by h²
            assert!(
                (found / law - 1.0).abs() < h * h,
                "{term}, {count}: {found} {law}"
            );
        }
    }
}

#[test]
fn a_gradient_costs_what_was_counted() {
    use naga::{BinaryOperator, Expression, MathFunction};
    use pullback_compiler::ir::cost;
    use pullback_compiler::module::evaluation;
    for source in [
        "f(x) = (x + 2) (x + 3) x",
        "f(x, y) = (x + 2) (y + 3) (x + y)",
        "f(x, y, z) = (x + 2) (y + 3) (z + 5) (x + y) (y + z)",
        "f(x, y, z) = (x + y + z) (x y + y z + z x) (x y z + 1)",
    ] {
        let text = source.to_owned();
        let program = pullback_compiler::compile(&text).program.unwrap();
        let formula = &program.pictures()[0].formula;
        for what in [What::Value, What::Gradient] {
            let counted = evaluation(formula, what).unwrap();
            let counted = cost(&counted.graph, &counted.roots).operations;
            let module = program.eval_module(0, what, Precision::Accurate).unwrap();
            let issued: u32 =
                module
                    .module
                    .functions
                    .iter()
                    .filter(|(_, f)| f.name.as_deref() == Some("evaluate"))
                    .flat_map(|(_, f)| f.expressions.iter().map(|(_, e)| e))
                    .map(|e| match e {
                        Expression::Binary {
                            op:
                                BinaryOperator::Add
                                | BinaryOperator::Subtract
                                | BinaryOperator::Multiply,
                            ..
                        } => 1,
                        // a product and a sum
                        Expression::Math {
                            fun: MathFunction::Fma,
                            ..
                        } => 2,
                        _ => 0,
                    })
                    .sum();
            assert_eq!(counted, issued, "{source} {what:?}");
        }
    }
}
